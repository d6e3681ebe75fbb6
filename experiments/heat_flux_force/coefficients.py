"""All Navier-Stokes coefficients from kicks: kick -> 0, half the time step, theory beside them."""

from typing import NamedTuple

from jdsmc import Estimate
from jdsmc.theory.transport import first_sonine, modified_first_sonine

from ..numbers import Even
from .cases import KICK_STEP
from .data import Heat, Pool
from .limits import CONDUCTIVITY, limit

NAMES = {
    "modified_conductivity": "κ'/κ0",
    "conductivity": "κ/κ0",
    "density_coefficient": "nμ/(Tκ0)",
    "viscosity": "η/η0",
}


class Coefficient(NamedTuple):
    """A coefficient at one restitution.

    `kicks`: at every kick, in the order of `kick_strengths`; `limit`: kick -> 0, with ε²;
    `excess`: the default kick's distance from it; `by_step`: at the default step minus at the short
    one; `tail`: the part of the integral that is extrapolated in time, at the default kick.
    """

    kicks: list[Estimate]
    limit: Estimate
    excess: Estimate
    by_step: Estimate | None
    tail: float
    theory: tuple[float, float]


def kick_strengths(data: Heat) -> list[float]:
    """Kicks that were run at the default time step; the first is the default kick."""
    return sorted(kick for kick, step, _ in data.size.kicks if step == KICK_STEP)


def kicked(data: Heat, kick: float, step: float = KICK_STEP) -> Pool:
    """The impulse response at a kick and a time step."""
    return data[f"kick_{kick:g}_dt{step:g}"]


def coefficient(data: Heat, name: str, restitution: float) -> Coefficient:
    """One coefficient with its checks."""
    strengths = kick_strengths(data)
    pools = [kicked(data, kick) for kick in strengths]
    kicks = [pool.value(name, restitution) for pool in pools]
    fitted = Even(strengths, kicks, (1,))
    by_step, short = None, min(step for _, step, _ in data.size.kicks)
    if short < KICK_STEP:
        other = kicked(data, strengths[0], short)
        by_step = kicks[0] - other.value(name, restitution)
    models = first_sonine(restitution), modified_first_sonine(restitution)
    return Coefficient(
        kicks,
        fitted.limit,
        fitted.value(strengths[0]) - fitted.limit,
        by_step,
        float(pools[0].value(f"{name}_tail", restitution).value),
        (float(getattr(models[0], name)), float(getattr(models[1], name))),
    )


def both_routes(data: Heat, restitution: float) -> tuple[Estimate, Estimate, float]:
    """κ' by impulse response and by the force, both extrapolated, and their difference over σ."""
    impulse = coefficient(data, CONDUCTIVITY.name, restitution).limit
    force = limit(data, CONDUCTIVITY, restitution).limit
    return impulse, force, float(impulse.distance(force))
