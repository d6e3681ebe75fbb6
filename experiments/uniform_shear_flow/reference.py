"""Every number the text of the paper quotes for the homogeneous problem, and where it stands.

`half_width` is half a unit of the last digit quoted ("about 12%": 0.5%; "about 40%", one digit:
5%); for a range it is half its length plus that. The paper gives no error bars.
"""

from ..compare import Quoted

NUMBERS = (
    Quoted("temperature", "T_s/T0, α = 0.9, a τ0 = 4", 147, 0.5, "V A, Fig. 4"),
    Quoted("shear_stress", "-P_xy/nT, α = 0.9", 0.33, 0.005, "V A, Fig. 4"),
    Quoted("normal_stress", "(P_xx-P_yy)/nT, α = 0.9", 0.24, 0.005, "V A, Fig. 4"),
    Quoted("ehs_temperature", "T_s/T0, α = 0.9, a τ0 = 4, EHS", 147, 0.5, "V A, Fig. 4"),
    Quoted("settling_s_09", "s to the steady state, α = 0.9, a τ0 = 4", 40, 5, "V B, Figs. 7, 9"),
    Quoted("settling_s_05", "s to the steady state, α = 0.5, a τ0 = 4", 20, 5, "V B, Fig. 8"),
    Quoted("settling_t_09", "t/τ0 to the steady state, α = 0.9, a τ0 = 4", 9, 0.5, "V B"),
    Quoted("settling_t_05", "t/τ0 to the steady state, α = 0.5, a τ0 = 4", 9, 0.5, "V B"),
    Quoted("slow_t_09", "t/τ0 to the steady state, α = 0.9, a τ0 = 0.1", 180, 25, "V B"),
    Quoted("slow_t_05", "t/τ0 to the steady state, α = 0.5, a τ0 = 0.1", 180, 25, "V B"),
    Quoted(
        "excess_temperature", "T_s of EHS over IHS, minus 1, α = 0.5", 0.12, 0.005, "V B, Fig. 8"
    ),
    Quoted("ratio_0", "R_0, α = 0.5", 1.18, 0.005, "V B, Fig. 13"),
    Quoted("ratio_1", "R_1, α = 0.5", 0.81, 0.005, "V B, Fig. 13"),
    Quoted("ratio_2", "R_2, α = 0.5", 1.39, 0.005, "V B, Fig. 13"),
    Quoted("ratio_3", "R_3, α = 0.5", 15, 0.5, "V B, Fig. 13"),
    Quoted("ratio_settling", "s for R_0, R_1, R_2 to settle, α = 0.5", 10, 5, "V B, Fig. 13"),
    Quoted("slow_share", "share with V < v0, α = 0.5", 0.51, 0.005, "V B"),
    Quoted("middle_share", "share with v0 < V < 2 v0, α = 0.5", 0.42, 0.005, "V B"),
    Quoted("least_thermal", "least share with V < 2 v0, s > 1, α = 0.5", 0.90, 0.005, "V B"),
    Quoted("most_thermal", "largest share with V < 2 v0, s > 1, α = 0.5", 0.93, 0.005, "V B"),
    Quoted("overpopulation", "overpopulation of V < v0, α = 0.5", 0.2, 0.05, "V B"),
    Quoted("underpopulation", "underpopulation of v0 < V < 2 v0, α = 0.5", 0.2, 0.05, "V B"),
    Quoted("delicate", "P_zz-P_yy of EHS below IHS, α = 0.5", 0.4, 0.05, "V C, Fig. 14"),
    Quoted(
        "delicate_measured",
        "P_zz-P_yy of EHS, measured drag, below IHS, α = 0.5",
        0.4,
        0.05,
        "V C, Fig. 14",
    ),
    Quoted("slope", "k in ⟨V12³⟩/⟨V12³⟩0 = 1 + k a2", 0.27, 0.005, "V C, Fig. 16"),
    Quoted("crossing_a2", "α where a2 of EHS and IHS cross", 0.7, 0.05, "V C, Fig. 16"),
    Quoted("crossing_cubed", "α where ⟨V12³⟩ of EHS and IHS cross", 0.7, 0.05, "V C, Fig. 16"),
    Quoted("exponent", "μ in ln F ~ -C^μ, α = 0.5", 1, 0.5, "V C, Fig. 18"),
)

THEORY = (
    Quoted("equilibrium_slow", "equilibrium share with V < v0", 0.428, 0.0005, "V B"),
    Quoted("equilibrium_middle", "equilibrium share with v0 < V < 2 v0", 0.526, 0.0005, "V B"),
    Quoted("equilibrium_thermal", "equilibrium share with V < 2 v0", 0.954, 0.0005, "V B"),
    Quoted("mean_free_time", "τ_mft/τ_η", 0.787, 0.0005, "below (5.2)"),
    Quoted("characteristic_time", "τ/τ_η", 0.888, 0.0005, "below (5.2)"),
    Quoted("viscosity_time", "τ_η/τ", 1.13, 0.005, "below (2.18)"),
    Quoted("newtonian_ihs", "Navier-Stokes η*, IHS, α = 0.5", 1.3, 0.05, "V B, Fig. 10"),
    Quoted("newtonian_ehs", "Navier-Stokes η*, EHS and BGK, α = 0.5", 1.1, 0.05, "V B, Fig. 10"),
)
"""Numbers that are formulas, not measurements: compared with the formula."""
