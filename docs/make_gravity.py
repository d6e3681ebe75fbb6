"""Measure conduction of Maxwell molecules under gravity and write docs/gravity.md: an hour of CPU.

Run it as `python docs/make_gravity.py` with the library installed. The run is kept beside
the page until that is written, and goes on where it was stopped.
"""

from pathlib import Path

import jdsmc
from jdsmc import MaxwellMolecules
from jdsmc.estimate import format_estimate
from jdsmc.results.gravity_effect import linear_response
from jdsmc.scenarios import FourierFlow

HERE = Path(__file__).parent
PAGE, TEMPLATE = HERE / "gravity.md", HERE / "gravity.template.md"

COLD, LENGTH, GRAVITY = 0.2, 20.0, [-0.024, 0.0, 0.024]
WINDOWS = (4.0, 6.0, 8.0)
"""λ0 over which the slope of T² is fitted."""

KNOWN = {"kappa_star": 1.0, "B": 46.0 / 5.0}
"""Tij, Garzó and Santos (1997), eq. (6) of the paper: exact to second order in g."""


def second_order(gradient: float) -> float:
    """C of the same equation."""
    return 24.0 / 5.0 + 503.7 * gradient**2


def measured(checkpoint: Path):
    """Three states side by side."""
    scene = FourierFlow(
        MaxwellMolecules(), COLD, gravity=GRAVITY, length=LENGTH, wall="bgk", layers=200
    )
    options = {"n_particles": 20_000, "duration": 8000.0, "steps_per_record": 8, "seed": 11}
    return jdsmc.run(scene, checkpoint=checkpoint, progress=False, **options)


def rows(result) -> str:
    """One line a window."""
    lines = []
    for window in WINDOWS:
        found = linear_response(result, window)
        gradient = float(found["reduced_gradient"].value)
        known = KNOWN | {"C": second_order(gradient)}
        cells = [f"{window:g}", format_estimate(*found["reduced_gradient"])]
        for name, exact in known.items():
            value, error = found[name]
            off = f"{(value - exact) / error:+.1f}"
            cells += [format_estimate(value, error), f"{exact:.4g}", off]
        lines.append(f"| {' | '.join(cells)} |")
        print(lines[-1], flush=True)
    return "\n".join(lines)


def main() -> None:
    """Write the page."""
    checkpoint = HERE / "gravity.h5"
    result = measured(checkpoint)
    text = TEMPLATE.read_text(encoding="utf-8").replace("@ROWS@", rows(result))
    PAGE.write_text(text, encoding="utf-8")
    checkpoint.unlink(missing_ok=True)


if __name__ == "__main__":
    main()
