"""Polynomials of a velocity that share the symmetry of a distribution.

A function of the basis is a product of powers of a few factors, v_x, v_y and v_z² for a sheared
gas; it is named by its powers, (1, 1, 0) is v_x v_y.
"""

import itertools
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from typing import Any, NamedTuple

import jax.numpy as jnp
import numpy as np

from ..types import Particles
from .heat import HeatMoments
from .moments import Moments, temperature

Powers = tuple[int, ...]


class Symmetry(NamedTuple):
    """Which polynomials a distribution has.

    `factors` of a velocity, their degrees, and of how many components each is made (a factor of
    degree 2 is the sum of their squares); `even`: only even total degrees; `rows`: largest
    degree of the averages that are followed; `squares`: powers whose sum is V²; `moments`: the
    moments of `measure.moments` from the averages of the polynomials; `images`: signs of the
    components of velocities that are as likely as one, itself included.
    """

    factors: Callable[[Particles], tuple]
    degrees: tuple[int, ...]
    components: tuple[int, ...]
    even: bool
    rows: int
    squares: tuple[Powers, ...]
    moments: Callable[["Averages", int], Any]
    images: tuple[tuple[int, ...], ...]

    def degree(self, powers: Powers) -> int:
        """Of one polynomial in the velocity."""
        return sum(n * d for n, d in zip(powers, self.degrees, strict=True))

    def basis(self, degree: int) -> list[Powers]:
        """Every polynomial from the first to that degree, low degrees first."""
        return list(_basis(self, degree))

    def _holds(self, powers: Powers, degree: int) -> bool:
        own = self.degree(powers)
        return 1 <= own <= degree and not (self.even and own % 2)

    def laplacian(self, powers: Powers) -> list[tuple[int, Powers]]:
        """∇² of one polynomial in the velocity: factors, and polynomials of a lower degree."""
        found = []
        for k, (n, degree, size) in enumerate(
            zip(powers, self.degrees, self.components, strict=True)
        ):
            factor = n * (n - 1) if degree == 1 else 2 * n * (2 * n + size - 2)
            if factor:
                lower = n - 2 if degree == 1 else n - 1
                found.append((factor, (*powers[:k], lower, *powers[k + 1 :])))
        return found

    def values(self, velocity: Particles, basis: list[Powers]) -> list:
        """The polynomials of every particle, one array each."""
        found = {(0,) * len(self.degrees): jnp.ones_like(velocity[0])}
        factors = self.factors(velocity)

        def value(powers: Powers):
            if powers not in found:
                place = next(k for k, n in enumerate(powers) if n)
                lower = (*powers[:place], powers[place] - 1, *powers[place + 1 :])
                found[powers] = value(lower) * factors[place]
            return found[powers]

        return [value(powers) for powers in basis]


@cache
def _basis(symmetry: Symmetry, degree: int) -> tuple[Powers, ...]:
    most = [range(degree // d + 1) for d in symmetry.degrees]
    every = [powers for powers in itertools.product(*most) if symmetry._holds(powers, degree)]
    return tuple(sorted(every, key=lambda powers: (symmetry.degree(powers), powers)))


class Averages(Mapping):
    """Averages by the powers of their polynomial; 1 for the constant, 0 where a power is negative.

    Arguments: the basis, arrays (polynomials, ...), and averages of other names.
    """

    def __init__(self, basis: list[Powers], values, others: dict | None = None):
        self._known: dict = dict(zip(basis, values, strict=True)) | (others or {})

    def __getitem__(self, powers):
        if isinstance(powers, tuple) and powers not in self._known:
            if min(powers) < 0:
                return 0.0
            if not any(powers):
                return 1.0
        return self._known[powers]

    def __iter__(self) -> Iterator:
        return iter(self._known)

    def __len__(self) -> int:
        return len(self._known)


def _sheared_moments(mean: Averages, dimension: int) -> Moments:
    xx, yy, zz, xy = mean[2, 0, 0], mean[0, 2, 0], mean[0, 0, 1], mean[1, 1, 0]
    fourth = _power(mean, [(2, 0, 0), (0, 2, 0), (0, 0, 1)], 2)
    sixth = _power(mean, [(2, 0, 0), (0, 2, 0), (0, 0, 1)], 3)
    return _moments(xx, yy, zz, xy, fourth, sixth, mean)


def _axial_moments(mean: Averages, dimension: int) -> HeatMoments:
    squares = [(2, 0), (0, 1)]
    across = 0.5 * mean[0, 1]
    even = [_power(mean, squares, n) for n in (2, 3)]
    flux = [_power(mean, squares, n, (1, 0)) for n in (1, 2, 3)]
    marginal = [mean[2 * n + 1, 0] for n in (1, 2, 3)]
    whole = _moments(mean[2, 0], across, across, 0.0 * across, even[0], even[1], mean)
    odd = {"flux": np.stack(flux, -1), "marginal": np.stack(marginal, -1)}
    return on_host(HeatMoments, isotropic=whole, **odd)


def _isotropic_moments(mean: Averages, dimension: int) -> Moments:
    one = mean[1,] / dimension
    zz = one if dimension == 3 else None
    return _moments(one, one, zz, 0.0 * one, mean[2,], mean[3,], mean)


def _power(mean: Averages, squares: list[Powers], exponent: int, times: Powers = ()) -> Any:
    """⟨φ V^{2n}⟩ from the averages of polynomials: the product written out."""
    total = 0.0
    for chosen in itertools.product(squares, repeat=exponent):
        every = (*chosen, times) if times else chosen
        total = total + mean[tuple(sum(n) for n in zip(*every, strict=True))]
    return total


def _moments(xx, yy, zz, xy, fourth, sixth, mean: Averages) -> Moments:
    """As `measure.moments`; the speed classes, which no polynomial has, are NaN."""
    thermal = 2.0 * temperature(on_host(Moments, xx=xx, yy=yy, zz=zz))
    high = {"fourth": fourth / thermal**2, "sixth": sixth / thermal**3}
    high["cubed"] = mean["cubed"] / thermal**1.5
    classes = np.full((*np.shape(xx), 4), np.nan)
    return on_host(Moments, xx=xx, yy=yy, zz=zz, xy=xy, **high, classes=classes)


def on_host(kind: type, **fields) -> Any:
    """A module of arrays as a run brings them to the host: NumPy, with leading axes."""
    made = object.__new__(kind)
    for name, value in fields.items():
        object.__setattr__(made, name, value)
    return made


def _sheared_factors(velocity: Particles) -> tuple:
    return velocity[0], velocity[1], velocity[2] * velocity[2]


def _axial_factors(velocity: Particles) -> tuple:
    return velocity[0], velocity[1] * velocity[1] + velocity[2] * velocity[2]


def _isotropic_factors(velocity: Particles) -> tuple:
    return (sum(v * v for v in velocity),)


SHEARED = Symmetry(
    *(_sheared_factors, (1, 1, 2), (1, 1, 1), True, 6),
    *(((2, 0, 0), (0, 2, 0), (0, 0, 1)), _sheared_moments),
    ((1, 1, 1), (-1, -1, -1)),
)
"""Even in v_z, and under reversal of the velocity: v_x^i v_y^j (v_z²)^l with i + j even."""

AXIAL = Symmetry(
    *(_axial_factors, (1, 2), (1, 2), False, 7),
    *(((2, 0), (0, 1)), _axial_moments),
    ((1, 1, 1), (1, -1, -1)),
)
"""About the x axis: v_x^i (v_y² + v_z²)^j."""

ISOTROPIC = Symmetry(
    *(_isotropic_factors, (2,), (3,), True, 6),
    *(((1,),), _isotropic_moments),
    ((1, 1, 1), (-1, -1, -1)),
)
"""V^{2n}."""
