"""What stands behind a disagreement: the same point run again with other numerical choices."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from jdsmc import Estimate

from ..store import obtain
from .data import Measurements, SteadyQuantity, Term, at_point, estimate_in, measured_collisions
from .measured import STEADY
from .systems import FAST, variations

PAPER_PARTICLES = 10_000
PAPER_COLLISIONS = 50.0
"""N of the paper, and about the collisions per particle its averages can cover (Figs. 4 to 13)."""

REPEATED: dict[str, SteadyQuantity] = STEADY | {
    f"crossing_{key}": SteadyQuantity(
        (Term("ehs", 0.7, FAST, name), Term("ihs", 0.7, FAST, name)), lambda x, y: x - y
    )
    for key, name in (("a2", "a2"), ("cubed", "relative_speed_cubed"))
}
"""What `evidence` repeats for each quoted number; for a crossing, EHS minus IHS at α = 0.7."""


def evidence(
    data: Measurements, quantity: SteadyQuantity, folder: Path, fresh: bool
) -> dict[str, Estimate]:
    """The quantity from the main runs, and with another seed, 4 N, and half the time step."""
    found = {"as above": quantity.of(data.lookup)}
    for label in ("again", "4N", "half step"):

        def lookup(term: Term, label=label) -> Estimate:
            case = variations(data.steady_case(term.gas), term.restitution, term.shear_rate)[label]
            root = obtain(case, folder, fresh).to_xarray().to_dataset()
            return estimate_in(at_point(root, term.restitution, term.shear_rate), term)

        found[label] = quantity.of(lookup)
    return found


def repeatable(keys: Iterable[str]) -> list[str]:
    """Those of the quoted numbers that `evidence` can repeat."""
    return [key for key in keys if key in REPEATED]


def paper_error(data: Measurements, quantity: SteadyQuantity) -> float:
    """Standard error that one run of the paper's size would have for a quantity: ours, scaled."""
    error = quantity.of(data.lookup).error
    effort = []
    for term in quantity.terms:
        case, result = data.steady_case(term.gas), data.results[f"steady_{term.gas}"]
        place = (
            case.restitution.index(term.restitution),
            case.shear_rate.index(term.shear_rate),
        )
        size = case.options["n_particles"] * case.options["n_realizations"]
        effort.append(size * float(measured_collisions(result)[place]))
    return error * float(np.sqrt(np.mean(effort) / (PAPER_PARTICLES * PAPER_COLLISIONS)))


LAYERS, LAYER_PARTICLES = 50, 200
"""The paper's inhomogeneous runs: N = 1e4 in M = 50 layers (section IV A)."""


def layer_temperature(homogeneous: Estimate) -> Estimate:
    """T_s expected from the candidates of eq. (4.13a), N_I² instead of N_I(N_I - 1) a layer.

    With a fluctuating N_I (binomial, mean n) the collision rate is too high by 1 + (1 - 1/M)/n,
    and T_s ∝ (a τ0)² falls with its square.
    """
    excess = 1.0 + (1.0 - 1.0 / LAYERS) / LAYER_PARTICLES
    return Estimate(homogeneous.value / excess**2, homogeneous.error / excess**2)


def implied_by_shares(shares: tuple[float, float], equilibrium) -> list[Estimate]:
    """R_0 and R_1 that the paper's own shares of 51% and 42% imply, with their rounding."""
    return [Estimate(s / e, 0.005 / e) for s, e in zip(shares, equilibrium, strict=False)]
