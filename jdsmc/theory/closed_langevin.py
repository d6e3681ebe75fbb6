"""Closed forms for the hydrodynamic noise of a cooling gas of disks.

Frequencies are over nu0 = 2 sqrt(pi) n sigma sqrt(T / m), viscosities over the elastic one of the
first Sonine approximation, nu0 = n T / eta0. Equation numbers are those of Costantini and Puglisi,
Phys. Rev. E 82, 011305 (2010).
"""

from dataclasses import dataclass
from math import inf, pi

from jdsmc.check import scalar


@dataclass(frozen=True)
class TwoMomentLimit:
    """eta / eta0, eta1 / eta0 and eta1 / eta for k -> 0; `tail_` for white noise."""

    restitution: float
    viscosity_ratio: float
    noise_viscosity_ratio: float
    noise_over_viscosity: float
    tail_noise_viscosity_ratio: float
    tail_noise_over_viscosity: float


def two_moment_limit(restitution: float) -> TwoMomentLimit:
    """The limit k -> 0 from the moments c_x and c_x c_y over a Gaussian alone.

    Collisions make noise in the stress at the rate Gamma; the stress relaxes at nu_eta - zeta and
    filters it, while the mode itself grows at zeta / 2. Within 2.2% of `long_wave_limit` for eta,
    2% for the ratios and 3.5% for eta1 for restitution >= 0.7. ValueError unless it is in (0, 1].
    """
    alpha = _checked(restitution)
    relaxation = (1 + alpha) * (7 - 3 * alpha) / 8
    cooling = (1 - alpha**2) / 2
    noise = (1 + alpha) ** 2 * (1 + (1 - alpha) ** 2) / 4
    viscosity = 1 / (relaxation - cooling / 2)
    tail = noise / (relaxation - 1.5 * cooling)
    ratio = tail * (relaxation - cooling / 2) / (relaxation - cooling)
    return TwoMomentLimit(
        restitution=alpha,
        viscosity_ratio=viscosity,
        noise_viscosity_ratio=ratio * viscosity,
        noise_over_viscosity=ratio,
        tail_noise_viscosity_ratio=tail * viscosity,
        tail_noise_over_viscosity=tail,
    )


def sonine_kurtosis(restitution: float) -> float:
    """a2 of disks by the paper's Eq. (13), linear theory; up to 0.0045 above the exact one."""
    alpha = _checked(restitution)
    denominator = 57 - 25 * alpha + 30 * alpha**2 * (1 - alpha)
    return 16 * (1 - alpha) * (1 - 2 * alpha**2) / denominator


def sonine_viscosity(restitution: float) -> float:
    """eta / eta0 of the Navier-Stokes equations in the first Sonine approximation."""
    alpha = _checked(restitution)
    a2 = sonine_kurtosis(alpha)
    relaxation = (1 + alpha) * (7 - 3 * alpha) / 8 * (1 - a2 / 32)
    cooling = (1 - alpha**2) / 2 * (1 + 3 * a2 / 16)
    return 1 / (relaxation - cooling / 2)


def navier_stokes_limit(restitution: float) -> float:
    """The paper's largest stable size L_c = 2 pi sqrt(2 nu / zeta), as N n sigma^2.

    With the first Sonine viscosity and Eqs. (12), (13); infinite for elastic disks. The kinetic
    `stability_limit` is lower. ValueError unless restitution is in (0, 1].
    """
    alpha = _checked(restitution)
    if alpha == 1:
        return inf
    cooling = (1 - alpha**2) * (1 + 3 * sonine_kurtosis(alpha) / 16)
    return 4 * pi * sonine_viscosity(alpha) / cooling


def _checked(restitution: float) -> float:
    scalar("restitution", restitution, 0, 1)
    return float(restitution)
