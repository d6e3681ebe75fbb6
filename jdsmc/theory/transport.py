r"""Navier-Stokes transport coefficients of a granular gas in first Sonine approximations.

Equation numbers are those of Montanero, Santos and Garzo, "First-order Chapman-Enskog velocity
distribution function in a granular gas", Physica A 376, 75 (2007), who use the theory of Brey,
Dufty, Kim and Santos, Phys. Rev. E 58, 4638 (1998). The heat flux and the stress are

    q = -kappa grad T - mu grad n                                                          (2.23)
      = -kappa' grad T - mu T^{-1/2} grad(n T^{1/2}),    kappa' = kappa - n mu/(2T)        (2.40)
    Pi_ij = -eta (d_i u_j + d_j u_i - (2/d) delta_ij div u),

and these forms of the coefficients are exact:

    kappa  = (d+2)/2 (nT/m) (1 + 2 a2) / (nu_kappa - 2 zeta)                               (2.41)
    kappa' = (d+2)/2 (nT/m) (1 + (3/2) a2) / (nu_kappa' - (3/2) zeta)                      (2.42)
    mu     = (2T/n) (kappa - kappa')                                                       (2.38)
    eta    = nT / (nu_eta - zeta/2),            nu_eta = int D_ij L C_ij / int D_ij C_ij,

with zeta from (2.14) and a2 from (2.16). The last, which the paper does not need, is the moment of
(L + (zeta/2) d/dV.V + zeta/2) C_ij = d(V_i f0)/dV_j - (delta_ij/d) d/dV.(V f0) with the tensor
D_ij = m (V_i V_j - V^2 delta_ij/d): docs/impulse_response.md derives the equation.

A first Sonine approximation inserts a trial function into the collision frequencies. Both kinds
follow from the change of S (2.26) and D in a collision, averaged over sigma^ with the weight
g^.sigma^ g. With G = (V1 + V2)/2, g = V1 - V2 and [..] = traceless part these are proportional to

    sum D: -(1+alpha) (2d+3-3 alpha) g [g g]
    sum S: -(1+alpha) g {(1/2) ((d+1) - (d+5) alpha) g^2 G + (2d+3-3 alpha) (G.g) g},

to be averaged over f0(V1) f0(V2) [1 + a2 L_2(c1^2)] times the trial function, to first order in a2:

* standard: Maxwellian weight, f_M (c^2 - (d+2)/2) c for the heat flux and f_M [c c] for the shear.
  The result for the heat flux is (2.46).
* modified: the cooling state's weight, f0 (c^2 - (1 + a2) (d+2)/2) c, which carries no momentum,
  and f0 [c c]. The idea is that of Garzo, Santos and Montanero, Physica A 376, 94 (2007), the
  paper's Ref. [28]; the numbers below were derived here. They change the terms in a2 only.

All integrals are Gaussian moments; tests/theory/test_transport.py evaluates them by quadrature.
"""

from dataclasses import dataclass

from numpy.typing import ArrayLike

from ..units import INITIAL_TEMPERATURE
from .homogeneous_cooling import (
    Floats,
    checked_dimension,
    checked_restitution,
    cooling_rate,
    effective_frequency,
    kurtosis,
)


@dataclass(frozen=True)
class TransportCoefficients:
    """Coefficients over the elastic first Sonine ones; fields have the shape of `restitution`.

    `conductivity` is kappa/kappa0 and `modified_conductivity` kappa'/kappa0 (2.47),
    `density_coefficient` n mu/(T kappa0), `viscosity` eta/eta0 with eta0 = nT/nu0. Elastic
    collisions have 1, 1, 0 and 1.
    """

    restitution: Floats
    conductivity: Floats
    modified_conductivity: Floats
    density_coefficient: Floats
    viscosity: Floats


def first_sonine(restitution: ArrayLike, dimension: int = 3) -> TransportCoefficients:
    """First Sonine approximation, Eqs. (2.41), (2.42), (2.38) with (2.46); eta: see the module.

    Arguments: `restitution` alpha in (0, 1], any shape; `dimension` an integer >= 2. ValueError
    outside these.
    """
    alpha, d = checked_restitution(restitution), checked_dimension(dimension)
    heat_excess = (4 + 5 * d - 3 * (4 - d) * alpha) / 512
    return _coefficients(alpha, d, heat_excess, shear_excess=-1 / 32)


def modified_first_sonine(restitution: ArrayLike, dimension: int = 3) -> TransportCoefficients:
    """First Sonine approximation weighted with the cooling state: see the module docstring.

    Arguments and errors as for `first_sonine`, which it equals at alpha = 1 and wherever a2 = 0.
    """
    alpha, d = checked_restitution(restitution), checked_dimension(dimension)
    heat_excess = (296 + 217 * d - 3 * (160 + 11 * d) * alpha) / 256
    return _coefficients(alpha, d, heat_excess, shear_excess=7 / 16)


def elastic_conductivity(dimension: int = 3) -> float:
    """kappa0 at T0, Eq. (2.47), in units of n lambda0 v0; it grows like sqrt(T).

    ValueError unless `dimension` is an integer >= 2. For spheres 75 sqrt(pi)/64.
    """
    d = checked_dimension(dimension)
    return d * (d + 2) / (2 * (d - 1)) * INITIAL_TEMPERATURE / effective_frequency(d)


def elastic_viscosity(dimension: int = 3) -> float:
    """eta0 = nT/nu0 at T0, in units of m n lambda0 v0; it grows like sqrt(T).

    ValueError unless `dimension` is an integer >= 2. For spheres 5 sqrt(pi)/16.
    """
    return INITIAL_TEMPERATURE / effective_frequency(dimension)


def elastic_sonine_coefficient(dimension: int = 3) -> float:
    """b_1 = b'_1 of the first Sonine approximation at alpha = 1, from Eqs. (2.45) and (2.47).

    With it b'_1 = (kappa'/kappa0) times this, at any alpha and exactly. ValueError unless
    `dimension` is an integer >= 2. For spheres 15 sqrt(pi)/16.
    """
    return 4 * elastic_conductivity(dimension) / (dimension + 2)


def _coefficients(
    alpha: Floats, d: int, heat_excess: Floats, shear_excess: float
) -> TransportCoefficients:
    """The exact forms of the module docstring, with collision frequencies linear in a2.

    `heat_excess` is the factor of a2 inside the brackets of Eq. (2.46), `shear_excess` the
    relative excess of nu_eta per a2. All frequencies below are in units of nu0.
    """
    a2 = kurtosis(alpha, d)
    cooling = cooling_rate(alpha, 1.0, d) / effective_frequency(d)
    elastic_part = (d - 1) / 2 + 3 / 16 * (d + 8) * (1 - alpha)
    heat_frequency = (1 + alpha) / d * (elastic_part + heat_excess * a2)
    shear_frequency = (1 + alpha) * (2 * d + 3 - 3 * alpha) / (4 * d) * (1 + shear_excess * a2)

    scale = (d - 1) / d  # nu0 kappa0 = scale^{-1} (d+2)/2 nT/m
    conductivity = scale * (1 + 2 * a2) / (heat_frequency - 2 * cooling)
    modified_conductivity = scale * (1 + 1.5 * a2) / (heat_frequency - 1.5 * cooling)
    return TransportCoefficients(
        restitution=alpha,
        conductivity=conductivity,
        modified_conductivity=modified_conductivity,
        density_coefficient=2 * (conductivity - modified_conductivity),
        viscosity=1 / (shear_frequency - cooling / 2),
    )
