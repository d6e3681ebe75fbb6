"""The truth of `tests.blind_sensitivity`: `python -m tests.truth_sensitivity` (eight minutes).

d/dα of what a sheared gas reports from nothing but values: long independent runs at four
restitutions about each of three, and the slope of one polynomial through all of them in
θ = arccos α. Averages are smooth in it at both ends: in √(1-α²) = sin θ near the elastic limit and
in α = cos θ near zero. Degree 5 and 6 agree and leave chi² near its number of degrees of freedom;
√(1-α²) as the variable needs degree 8, and differences in it at α = 0.6 are 0.4% off. Each
value is kept in a file when it is known, so that a second call goes on where the first was ended.
"""

import json
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.scenarios import UniformShear
from jdsmc.scenarios.approach import slowest_rate
from jdsmc.units import COOLING

FILE = Path(__file__).with_name("truth_sensitivity.json")
RESTITUTIONS = (0.6, 0.75, 0.9)
OBSERVABLES = (
    *("shear_stress", "reduced_shear_rate", "normal_stress_xy", "normal_stress_zy"),
    *("pressure_yy", "a2"),
)
STEP = 0.07
PLACES = (-2, -1, 1, 2)
"""In √(1-α²): the points about each."""

DEGREE, MIDDLE = 6, 0.75
"""Of the polynomial, and the θ from which its powers are counted."""

OPTIONS = {"n_particles": 4096, "n_realizations": 32, "time_step": 0.05, "progress": False}
"""As many particles as the blind runs have: the same 1/N in both."""

COLLISIONS = 4000.0


def restitution(alpha: float, place: int) -> float:
    """α at u + place h."""
    return float(np.sqrt(1.0 - (np.sqrt(1.0 - alpha**2) + place * STEP) ** 2))


def values(alpha: float, seed: int) -> dict[str, list[float]]:
    """Steady values and their errors; the shear rate, which they do not depend on, keeps T0."""
    _, heat = slowest_rate(COOLING * (1.0 - alpha**2), 0.5 * (1.0 + alpha), 1.0)
    scene = UniformShear(InelasticHardSpheres(alpha), heat**-0.5)
    result = jdsmc.run(scene, collisions=COLLISIONS, seed=seed, **OPTIONS)
    return {name: [float(x) for x in result[name]] for name in OBSERVABLES}


def known() -> dict:
    """Values by "α, place"."""
    return json.loads(FILE.read_text()) if FILE.exists() else {}


def slopes() -> dict[str, dict[float, tuple[float, float]]]:
    """d/dα and one standard error by observable and restitution; errors scaled by chi²."""
    data, powers = known(), np.arange(DEGREE + 1)
    places = [(a, k) for a in RESTITUTIONS for k in PLACES]
    theta = np.arccos([restitution(*place) for place in places]) - MIDDLE
    found = {}
    for name in OBSERVABLES:
        value, error = np.array([data[f"{a}, {k}"][name] for a, k in places]).T
        design = theta[:, None] ** powers / error[:, None]
        covariance = np.linalg.inv(design.T @ design)
        fitted = covariance @ design.T @ (value / error)
        left = float(np.sum((value / error - design @ fitted) ** 2)) / (len(theta) - len(powers))
        found[name] = {}
        for alpha in RESTITUTIONS:
            along = powers[1:] * (np.arccos(alpha) - MIDDLE) ** (powers[1:] - 1.0)
            slope = -np.array([0.0, *along]) / np.sqrt(1.0 - alpha**2)
            doubt = np.sqrt(max(left, 1.0) * slope @ covariance @ slope)
            found[name][alpha] = float(slope @ fitted), float(doubt)
    return found


def main() -> None:
    """Run what the file lacks; print the slopes."""
    data = known()
    for at, alpha in enumerate(RESTITUTIONS):
        for k, place in enumerate(PLACES):
            key = f"{alpha}, {place}"
            if key not in data:
                data[key] = values(restitution(alpha, place), seed=5000 + 10 * at + k)
                FILE.write_text(json.dumps(data, indent=1) + "\n")
    for name, of in slopes().items():
        print(f"{name:20s}", *(f"{a}: {v:.5f}({e:.5f})  " for a, (v, e) in of.items()))


if __name__ == "__main__":
    main()
