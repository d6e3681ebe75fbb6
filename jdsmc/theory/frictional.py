r"""Navier-Stokes coefficients of elastic hard spheres under a drag, without simulation.

The gas of Astillero and Santos, eq. (2.20): d_t f + v.grad f - (zeta/2) d/dV.(V f) = beta J[f, f],
zeta = d zeta0(n, T) of eq. (2.16), J elastic. Left alone it is Maxwellian and cools as the
inelastic gas does, since the drag only rescales velocities. At first order in the gradients

    d_t f1 -> -zeta T d/dT f1 = (zeta/2) d/dV.(V f1) + shift,

and the first part cancels the drag on f1: what is left of the equations of `chapman_enskog` are the
collisions and the shifts,

    (beta L - zeta/2) A = A_source,    beta L B = B_source + zeta A,
    beta L A' = A'_source,             (beta L + zeta/2) C = C_source,

with L and the sources of elastic spheres. So beta times each coefficient depends on x = d (1 -
alpha^2)/beta alone, and beta kappa' is that of elastic spheres. First Sonine approximation: kappa ~
1/(beta nu_kappa - zeta/2), eta ~ 1/(beta nu_eta + zeta/2).
"""

from functools import lru_cache
from typing import Any

import scipy

from ..units import COOLING
from .boltzmann import navier_stokes
from .chapman_enskog import heat_flux_response, stress_response
from .cooling_expansion import CoolingExpansion, solve_cooling

ORDER = 16
"""Of the expansion; elastic spheres converge faster than inelastic ones (1e-7)."""

COEFFICIENTS = ("modified_conductivity", "conductivity", "density_coefficient", "viscosity")


@lru_cache(maxsize=1)
def _elastic() -> CoolingExpansion:
    return solve_cooling(1.0, ORDER)


def coefficients(drag_over_rate: float) -> dict[str, float]:
    """beta kappa'/kappa0, beta kappa/kappa0, beta n mu/(T kappa0) and beta eta/eta0 at x >= 0.

    Argument: x = d (1 - alpha^2)/beta. kappa diverges where zeta = 2 beta nu_kappa, near x = 3.2.
    ValueError for a negative x.
    """
    if drag_over_rate < 0:
        raise ValueError(f"drag_over_rate = {drag_over_rate:g} is outside the range [0, inf).")
    return _heat(drag_over_rate) | {"viscosity": _viscosity(drag_over_rate)}


def _heat(x: float) -> dict[str, float]:
    found = heat_flux_response(1.0, _elastic(), COOLING * x)
    return {name: float(found[name]) for name in COEFFICIENTS[:3]}


def _viscosity(x: float) -> float:
    return stress_response(1.0, _elastic(), COOLING * x)


def rate_factor(restitution: float, name: str) -> float:
    """beta of the elastic gas that has the coefficient of inelastic spheres; d = 1.

    Arguments: alpha in [0.3, 1]; one of `COEFFICIENTS` but the density coefficient, which is zero
    without drag. ValueError for others; exact up to the truncation of `boltzmann.navier_stokes`.
    """
    if name not in COEFFICIENTS or name == "density_coefficient":
        raise ValueError(f"name = {name!r} is none of {', '.join(COEFFICIENTS[:2])}, viscosity.")
    wanted = float(vars(navier_stokes(restitution))[name])
    loss = 1.0 - restitution**2

    def miss(beta: float) -> float:
        x = loss / beta
        return (_viscosity(x) if name == "viscosity" else _heat(x)[name]) / beta - wanted

    found: Any = scipy.optimize.brentq(miss, 0.35, 1.5, xtol=1e-8)
    return float(found)
