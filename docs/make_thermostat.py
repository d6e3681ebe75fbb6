"""Measure a gas under white noise and write docs/thermostat.md: minutes of CPU time.

Run it as `python docs/make_thermostat.py` with the library installed.
"""

from itertools import pairwise
from math import sqrt
from pathlib import Path

import numpy as np

import jdsmc
from jdsmc import InelasticHardSpheres
from jdsmc.estimate import format_estimate
from jdsmc.scenarios import WhiteNoiseThermostat
from jdsmc.theory.cooling_expansion import solve_heated
from jdsmc.units import INITIAL_TEMPERATURE

HERE = Path(__file__).parent
PAGE, TEMPLATE = HERE / "thermostat.md", HERE / "thermostat.template.md"

NOISE = 0.2
CUMULANTS = (0.2, 0.5, 0.8)
TAILS = (0.1, 0.3, 0.5)
CLASSES = (2.0, 2.5, 3.0, 3.5)
"""Borders of C: fewer than one particle in 10^5 is beyond."""


def heated(alpha: float, rtol: float):
    """A run until a2 is known to `rtol`."""
    return jdsmc.run(
        WhiteNoiseThermostat(InelasticHardSpheres(alpha), NOISE),
        n_particles=20_480,
        n_realizations=16,
        rtol=rtol,
        budget=1e5,
        seed=1,
        progress=False,
    )


def published(alpha: float, d: int = 3) -> float:
    """a2 of van Noije and Ernst."""
    bottom = 73 + 56 * d - 24 * d * alpha - 105 * alpha + 30 * (1 - alpha) * alpha**2
    return 16 * (1 - alpha) * (1 - 2 * alpha**2) / bottom


def cumulant() -> str:
    """Rows: α, a2, published, Boltzmann equation."""
    rows = []
    for alpha in CUMULANTS:
        value, error = heated(alpha, 0.01)["a2"]
        theory = solve_heated(alpha, 16).moment(2) * 4.0 / 15.0 - 1.0
        parts = (f"{alpha:g}", format_estimate(value, error), f"{published(alpha):.5f}")
        rows.append(f"| {' | '.join(parts)} | {theory:.5f} |")
        print(rows[-1], flush=True)
    return "\n".join(rows)


def slope(result, low: float, high: float) -> tuple[float, float]:
    """-d ln f/d(C^{3/2}) and its error over classes of C, weighted by their errors."""
    found = result.distribution
    centre = found["speed_bin"].values
    here = (centre > low) & (centre < high)
    c, p, error = centre[here], found["speed"].values[here], found["speed_error"].values[here]
    weight = p / error
    design = np.stack([np.ones_like(c), -(c**1.5)], axis=1) * weight[:, None]
    covariance = np.linalg.inv(design.T @ design)
    fitted = covariance @ design.T @ (np.log(p / c**2) * weight)
    return float(fitted[1]), float(np.sqrt(covariance[1, 1]))


def tail() -> str:
    """A table: α, slopes over each class, A; a Maxwellian below."""
    borders = list(pairwise(CLASSES))
    heads = [f"C = {a:g} to {b:g}" for a, b in borders]
    rows = [f"| α | {' | '.join(heads)} | A |", "|---" * (len(heads) + 2) + "|"]
    for alpha in TAILS:
        result = heated(alpha, 0.004)
        temperature = float(result["temperature"].value)
        cooling = NOISE / INITIAL_TEMPERATURE / temperature**1.5
        published_slope = 2.0 / 3.0 * sqrt(4.0 / (sqrt(2.0) * cooling))
        cells = [format_estimate(*slope(result, a, b)) for a, b in borders]
        rows.append(f"| {alpha:g} | {' | '.join(cells)} | {published_slope:.3f} |")
        print(rows[-1], flush=True)
    gauss = [f"{(b**2 - a**2) / (b**1.5 - a**1.5):.3f}" for a, b in borders]
    rows.append(f"| Maxwellian | {' | '.join(gauss)} |  |")
    return "\n".join(rows)


def main() -> None:
    """The whole page."""
    text = TEMPLATE.read_text(encoding="utf-8")
    for name, part in {"CUMULANT": cumulant(), "TAIL": tail()}.items():
        text = text.replace(f"@{name}@", part)
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
