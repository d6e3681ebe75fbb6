"""What `langevin` returns: numbers with their truncation, and C(s) on request.

Units: tau0 = lambda0 / v0 with lambda0 = 1 / (2 sqrt(2) n sigma). Equation numbers are those of
Costantini and Puglisi, Phys. Rev. E 82, 011305 (2010).
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from jdsmc.theory.mode_solution import Solution

Floats = NDArray[np.float64]
COLLISION_TIME = sqrt(8)  # 1 / (n sigma v0) in tau0


@dataclass(frozen=True)
class CoolingState:
    """Homogeneous cooling state of disks: f = Gaussian sum_p sonine_p L_p(c^2).

    `sonine` holds a_0 = 1, a_1 = 0, a2, ...; `cooling_rate` is zeta(T0) and `growth_rate` mu =
    zeta(T0) / 2, in 1/tau0. `truncation` is the difference from the Sonine order below, by name.
    """

    restitution: float
    sonine: Floats
    cooling_rate: float
    growth_rate: float
    truncation: Mapping[str, float]

    @property
    def a2(self) -> float:
        """<c^4> / 2 - 1."""
        return float(self.sonine[2])


@dataclass(frozen=True)
class LongWaveLimit:
    """eta / eta0, eta1 / eta0 and eta1 / eta for k -> 0; `tail_` with A in place of C(0).

    An inelastic gas does not show it: the mode is unstable there and the values are the analytic
    continuation of those of a stable gas. `truncation` by name, as in `TransverseMode`.
    """

    restitution: float
    viscosity_ratio: float
    noise_viscosity_ratio: float
    noise_over_viscosity: float
    tail_noise_viscosity_ratio: float
    tail_noise_over_viscosity: float
    truncation: Mapping[str, float]


@dataclass(frozen=True)
class TransverseMode:
    """The mode's stationary fluctuations, C(s) = <xi(s) xi*(0)> / (N T / m).

    `amplitude` C(0); `decay_rate` 1/tau in 1/tau0; `viscosity_ratio` (1/tau + mu) / (k^2 nu0),
    Eq. (10), `noise_viscosity_ratio` C(0) / (tau k^2 nu0), Eq. (11), `noise_over_viscosity` their
    ratio C(0) / (1 + mu tau); `tail_amplitude` A, and the last two with it in place of C(0).
    `wave_number` k lambda0, `growth_rate` mu in 1/tau0; `truncation` the error of each, by name.
    """

    restitution: float
    reduced_number: float
    degree: int
    wave_number: float
    growth_rate: float
    amplitude: float
    decay_rate: float
    viscosity_ratio: float
    noise_viscosity_ratio: float
    noise_over_viscosity: float
    tail_amplitude: float
    tail_noise_viscosity_ratio: float
    tail_noise_over_viscosity: float
    truncation: Mapping[str, float]
    _fine: Solution = field(repr=False)
    _coarse: Solution = field(repr=False)

    @property
    def decay_modes(self) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """Rates in 1/tau0 and weights: C(s) = Re sum weights exp(-rates s), largest weight first.

        Of the largest degree, not extrapolated. But for the first they stand for a continuum.
        """
        return self._fine.rates / COLLISION_TIME, self._fine.weights.copy()

    def autocorrelation(self, time: ArrayLike) -> Floats:
        """C(s) at the times `time` >= 0 in tau0, of any shape; of the largest degree.

        ValueError for negative or non-finite times.
        """
        return self._fine.autocorrelation(_checked_times(time))

    def autocorrelation_truncation(self, time: ArrayLike) -> Floats:
        """Size of the change of C(s) from the next smaller degree to the largest."""
        times = _checked_times(time)
        return np.abs(self._fine.autocorrelation(times) - self._coarse.autocorrelation(times))


def _checked_times(time: ArrayLike) -> Floats:
    times = np.asarray(time, dtype=float)
    if not np.all(np.isfinite(times) & (times >= 0)):
        raise ValueError("time must be finite and in the allowed range [0, inf).")
    return times / COLLISION_TIME
