r"""The Boltzmann equation of a granular gas solved, without simulation: cooling and Navier-Stokes.

Inelastic hard spheres in three dimensions, definitions of Montanero, Santos and Garzo, Physica A
376, 75 (2007). The cooling state f0 and the first-order distributions are expanded in `order`
Laguerre functions each, and their equations projected on the same functions; all collision
integrals are exact but for rounding. The parts:

    laguerre_basis        the functions, and why they can hold the exponential tail of f0
    collision_integrals   bilinear and linearised collision operators between them
    cooling_expansion     f0, nonlinear, by Newton's method
    chapman_enskog        heat flux and stress, linear

The only approximation is the finite order. The error that is left is stated with every result as
`truncation`: the largest change from about two thirds of the order (two lower orders, lest one be
right by chance) to the whole, plus an allowance for rounding. It is on the safe side: at the
default order the true errors, for restitutions from 0.3 to 1, are below a tenth of it, that is
2e-7 for the coefficients and a3, 1e-9 for a2 and the cooling rate, 2e-6 for b'_2, 4e-5 for b'_3.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import lru_cache
from operator import index
from typing import Any, TypeVar

import numpy as np

from .chapman_enskog import heat_flux_response, stress_response
from .cooling_expansion import CoolingExpansion, solve_cooling

ORDER = 24
LOWEST_ORDER, HIGHEST_ORDER = 12, 48  # Gauss rules lose digits beyond 48
LOWEST_RESTITUTION = 0.3
ROUNDING = 1e-10  # relative; orders 40 and 48 differ by less wherever they have converged
STEP = 0.004  # of the derivative in alpha
Truncation = dict[str, float | tuple[float, ...]]


@dataclass(frozen=True)
class CoolingState:
    """The homogeneous cooling state (2.8).

    `cooling_rate` is zeta tau with tau = lambda/sqrt(2T/m); `a2` = 4 <c^4>/15 - 1 (2.13) and `a3` =
    1 + 3 a2 - 8 <c^6>/105 are the Sonine coefficients of Eq. (2.9). `truncation` has the error of
    each by its name.
    """

    restitution: float
    cooling_rate: float
    a2: float
    a3: float
    truncation: Truncation


@dataclass(frozen=True)
class NavierStokes:
    """Cooling state and transport coefficients, the latter over elastic first Sonine values.

    The first three as in `CoolingState`; `modified_conductivity` kappa'/kappa0, `conductivity`
    kappa/kappa0, `density_coefficient` n mu/(T kappa0) and `viscosity` eta/eta0, with kappa0 and
    eta0 of `jdsmc.theory.transport`; `sonine` is (b'_1, b'_2, b'_3) (3.10). `truncation` has the
    error of each by its name, three for `sonine`.
    """

    restitution: float
    cooling_rate: float
    a2: float
    a3: float
    modified_conductivity: float
    conductivity: float
    density_coefficient: float
    viscosity: float
    sonine: tuple[float, float, float]
    truncation: Truncation


Theory = TypeVar("Theory", CoolingState, NavierStokes)


def cooling_state(restitution: float, *, order: int = ORDER) -> CoolingState:
    """Cumulants and cooling rate of the homogeneous cooling state.

    Arguments: `restitution` alpha in [0.3, 1], one number; `order` of the expansion, an integer in
    12 ... 48. ValueError outside these. Results are kept; a new one takes a tenth of a second.
    """
    alpha, order = _checked_restitution(restitution), _checked_order(order)
    return _with_truncation(CoolingState, alpha, order)


def navier_stokes(restitution: float, *, order: int = ORDER) -> NavierStokes:
    """Navier-Stokes transport coefficients; arguments and errors as for `cooling_state`.

    A new value takes half a second at the default order, and ten seconds at order 48.
    """
    alpha, order = _checked_restitution(restitution), _checked_order(order)
    return _with_truncation(NavierStokes, alpha, order)


def derivative(theory: Callable[..., Theory], restitution: float, *, order: int = ORDER) -> Theory:
    """d/d(restitution) of every value of `cooling_state` or `navier_stokes`, in the same form.

    `theory` is one of these two functions; the field `restitution` keeps alpha. The solution is
    analytic in alpha, beyond 1 too: central differences of fourth order serve up to both ends.
    `truncation` comes from the orders of the expansion as for the values; what the differences
    themselves add is below 1e-6.
    """
    kinds: dict[Callable, Any] = {cooling_state: CoolingState, navier_stokes: NavierStokes}
    if theory not in kinds:
        raise ValueError("theory must be cooling_state or navier_stokes of this module.")
    alpha, order = _checked_restitution(restitution), _checked_order(order)

    def slopes(order: int):
        steps = ((-2, 1 / 12), (-1, -2 / 3), (1, 2 / 3), (2, -1 / 12))
        rows = [
            factor / STEP * _values(kinds[theory], alpha + number * STEP, order)
            for number, factor in steps
        ]
        return np.sum(rows, axis=0)

    fewer = [slopes(number) for number in _lower(order)]
    return _assembled(kinds[theory], alpha, slopes(order), fewer, ROUNDING / STEP)


def _with_truncation(kind: type[Theory], alpha: float, order: int) -> Theory:
    fewer = [_values(kind, alpha, number) for number in _lower(order)]
    return _assembled(kind, alpha, _values(kind, alpha, order), fewer, ROUNDING)


def _lower(order: int) -> tuple[int, int]:
    return 2 * order // 3, 2 * order // 3 - 2


def _assembled(
    kind: type[Theory], alpha: float, values: np.ndarray, fewer: list, rounding: float
) -> Theory:
    """`kind` from its values, in the order of its fields, and the `fewer` of lower orders."""
    errors = np.max(np.abs(values - np.array(fewer)), axis=0) + rounding * np.maximum(
        1.0, np.abs(values)
    )
    names = [field.name for field in fields(kind)][1:-1]
    named, named_errors = {}, {}
    for place, name in enumerate(names):
        several = slice(place, None) if name == "sonine" else place
        for target, source in ((named, values), (named_errors, errors)):
            item = source[several].tolist()
            target[name] = tuple(item) if name == "sonine" else item
    return kind(restitution=alpha, truncation=named_errors, **named)


def _values(kind: type, alpha: float, order: int) -> np.ndarray:
    """All values of one expansion in the order of the fields of `kind`."""
    cooling = _cooling(alpha, order)
    a2 = 4 / 15 * cooling.moment(2) - 1
    a3 = 1 + 3 * a2 - 8 / 105 * cooling.moment(3)
    state = [cooling.rate, a2, a3]
    return np.array(state if kind is CoolingState else [*state, *_coefficients(alpha, order)])


@lru_cache(maxsize=256)
def _cooling(alpha: float, order: int) -> CoolingExpansion:
    return solve_cooling(alpha, order)


@lru_cache(maxsize=256)
def _coefficients(alpha: float, order: int) -> tuple[float, ...]:
    cooling = _cooling(alpha, order)
    heat = heat_flux_response(alpha, cooling)
    return (
        float(heat["modified_conductivity"]),
        float(heat["conductivity"]),
        float(heat["density_coefficient"]),
        stress_response(alpha, cooling),
        *map(float, heat["sonine"]),
    )


def _checked_restitution(restitution: float) -> float:
    try:
        alpha = float(restitution) if np.ndim(restitution) == 0 else None
    except (TypeError, ValueError):
        alpha = None
    if alpha is None:
        raise TypeError(f"restitution must be one number in [0.3, 1], got {restitution!r}.")
    if not LOWEST_RESTITUTION <= alpha <= 1:
        raise ValueError(f"restitution must lie in [0.3, 1], got {restitution}.")
    return alpha


def _checked_order(order: int) -> int:
    try:
        value = index(order)
    except TypeError:
        value = 0
    if not LOWEST_ORDER <= value <= HIGHEST_ORDER:
        raise ValueError(
            f"order must be an integer in {LOWEST_ORDER} ... {HIGHEST_ORDER}, got {order!r}."
        )
    return value
