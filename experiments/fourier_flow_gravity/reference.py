"""Every number of the paper that is compared, and where it stands. The paper has no error bars."""

import numpy as np

from ..compare import Quoted
from .systems import COMBINATIONS, Combination

COLUMNS = ("z0", "mean_free_paths", "reduced_gravity", "kappa_star", "kappa_star_change")
"""Columns of tables 2 to 5 after g, by the names of `jdsmc.gravity_effect`."""

HALF_WIDTHS = {
    "z0": 0.025,
    "mean_free_paths": 0.05,
    "reduced_gravity": 0.0005,
    "kappa_star": 0.0005,
    "kappa_star_change": 0.0005,
}
"""Half a unit of the last digit; z0 is given in steps of 0.05, half a layer."""

TABLES = dict(
    zip(
        COMBINATIONS,
        (
            """
            -0.024 2.55 3.3 -0.095 0.903 -0.040
            -0.020 2.55 3.5 -0.079 0.905 -0.038
            -0.016 2.60 3.8 -0.063 0.906 -0.037
            -0.012 2.60 4.1 -0.048 0.917 -0.026
            -0.010 2.60 4.3 -0.040 0.921 -0.022
            -0.008 2.55 4.3 -0.032 0.927 -0.016
            -0.006 2.60 4.5 -0.025 0.934 -0.009
            -0.004 2.50 4.5 -0.017 0.939 -0.004
             0.000 2.70 5.0  0.000 0.943  0.000
             0.003 2.80 5.3  0.013 0.951  0.008
             0.006 2.85 5.6  0.028 0.969  0.026
             0.008 2.90 5.8  0.039 0.978  0.035
             0.010 3.20 6.3  0.052 0.986  0.043
            """,
            """
            -0.020 2.45 3.9 -0.068 0.908 -0.055
            -0.016 2.45 4.1 -0.055 0.921 -0.042
            -0.012 2.45 4.3 -0.042 0.934 -0.029
            -0.010 2.40 4.4 -0.035 0.940 -0.023
            -0.006 2.50 4.7 -0.022 0.949 -0.014
            -0.003 2.50 4.9 -0.011 0.955 -0.008
             0.000 2.50 5.0  0.000 0.963  0.000
             0.004 2.60 5.5  0.016 0.983  0.020
             0.008 2.60 5.5  0.032 0.988  0.025
             0.010 2.90 6.2  0.046 1.016  0.053
             0.012 3.00 6.4  0.058 1.036  0.073
             0.014 3.55 7.0  0.077 1.064  0.101
            """,
            """
            -0.024 2.00 3.1 -0.108 0.833 -0.066
            -0.020 2.00 3.4 -0.091 0.838 -0.061
            -0.016 2.00 3.6 -0.073 0.838 -0.061
            -0.014 2.00 3.8 -0.065 0.849 -0.050
            -0.012 1.95 3.9 -0.056 0.861 -0.038
            -0.008 2.00 4.3 -0.038 0.871 -0.028
            -0.004 2.00 4.6 -0.020 0.880 -0.019
             0.000 2.05 5.0  0.000 0.899  0.000
             0.004 2.15 5.5  0.022 0.917  0.018
             0.006 2.40 6.0  0.036 0.921  0.022
             0.008 2.70 6.5  0.052 0.930  0.031
             0.010 3.00 7.0  0.074 0.964  0.065
             0.011 3.50 7.5  0.092 0.994  0.095
            """,
            """
            -0.024 1.85 3.4 -0.088 0.837 -0.075
            -0.020 1.80 3.6 -0.075 0.851 -0.061
            -0.016 1.80 3.8 -0.061 0.864 -0.048
            -0.012 1.80 4.1 -0.047 0.879 -0.033
            -0.008 1.80 4.4 -0.032 0.888 -0.024
            -0.004 1.85 4.7 -0.016 0.890 -0.022
             0.000 1.90 5.0  0.000 0.912  0.000
             0.004 1.95 5.5  0.019 0.939  0.027
             0.006 2.00 5.7  0.030 0.943  0.031
             0.008 2.10 6.0  0.043 0.974  0.062
             0.010 2.20 6.3  0.058 0.992  0.080
             0.011 2.30 6.5  0.068 1.010  0.098
             0.012 2.70 7.1  0.084 1.047  0.135
            """,
        ),
        strict=True,
    )
)


def table(combination: Combination) -> dict[str, np.ndarray]:
    """One of tables 2 to 5: `gravity` and the columns of `COLUMNS`, arrays over its rows."""
    rows = np.array([line.split() for line in TABLES[combination].strip().splitlines()], float)
    return dict(zip(("gravity", *COLUMNS), rows.T, strict=True))


NUMBERS = (
    Quoted("gradient 0.05 maxwell", "ε0, T_- = 0.05, type I, g = 0", 0.33, 0.005, "4"),
    Quoted("gradient 0.05 bgk", "ε0, T_- = 0.05, type II, g = 0", 0.36, 0.005, "4"),
    Quoted("gradient 0.01 maxwell", "ε0, T_- = 0.01, type I, g = 0", 0.44, 0.005, "4"),
    Quoted("gradient 0.01 bgk", "ε0, T_- = 0.01, type II, g = 0", 0.48, 0.005, "4"),
    Quoted("response 0.05 bgk", "B, T_- = 0.05, type II", 2.25, 0.3, "4, Fig. 7"),
    Quoted("response 0.01 bgk", "B, T_- = 0.01, type II", 2.25, 0.3, "4, Fig. 7"),
    Quoted("jump cold -0.016", "T(0) - T_-, g = -0.016, T_- = 0.05, type II", 0.04, 0.005, "5"),
    Quoted("jump hot -0.016", "T_+ - T(L), g = -0.016, T_- = 0.05, type II", 0.04, 0.005, "5"),
    Quoted("jump cold 0.012", "T(0) - T_-, g = 0.012, T_- = 0.05, type II", 0.01, 0.005, "5"),
    Quoted("jump hot 0.012", "T_+ - T(L), g = 0.012, T_- = 0.05, type II", 0.20, 0.005, "5"),
    Quoted("density cold -0.016", "n near the cold wall, g = -0.016", 4.0, 0.5, "4, Fig. 5"),
    Quoted("density hot -0.016", "n near the hot wall, g = -0.016", 0.6, 0.05, "4, Fig. 5"),
    Quoted("density cold 0.012", "n near the cold wall, g = 0.012", 8.0, 0.5, "4, Fig. 5"),
    Quoted("density hot 0.012", "n near the hot wall, g = 0.012", 0.3, 0.05, "4, Fig. 5"),
    Quoted("crossing", "z/L where p and P_zz cross, T_- = 0.05, type II", 0.35, 0.1, "4, Fig. 4"),
)

THEORY = (Quoted("paths", "(λ/λ')² = (15 √π/16)², so that B' = 2.76 B", 2.76, 0.005, "4"),)
"""Numbers that are formulas, not measurements: compared with the formula."""

MISPRINTS = (
    ("section 4", "the last ε0 = 0.48 is said to belong to T_- = 0.05; table 5 has it for 0.01"),
    (
        "tables 2 to 5",
        "the column z0/L holds z0 in units of λ': z0/L would lie outside the slab, and 𝒩(z0) = 5 "
        "at z0 = 2.5 or so agrees with (32)",
    ),
    (
        "section 5",
        'the mean gradient "is larger for g > 0 than for g < 0" must read g < 0 than for g > 0: '
        "the same sentence has it increase when g decreases, as Fig. 2 shows",
    ),
    ("end of section 4", "the standard mean free path of hard spheres is (26), not (5)"),
    (
        "Figs. 2 to 6",
        "g = -0.008 (T_- = 0.05, type II) and g = 0.012 (T_- = 0.01, type I) are drawn but are in "
        "no table: there were at least 53 states",
    ),
)
"""Where the paper contradicts itself, and what was taken."""
