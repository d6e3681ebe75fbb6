"""Does a hydrodynamic mode grow without bound, as beyond the limit of stability?"""

import numpy as np

from ..check import at_least, scalar
from ..units import INITIAL_TEMPERATURE as T0

STEP = 3.0
"""In τ0: longer than the stress remembers, so that the mode is a Markov chain at this step."""

SIGNIFICANCE = 3.0
LARGEST_ENERGY = 0.1


def runs_away(series, spacing, particles, temperature) -> bool:
    """True when modes grow, or have grown until they hold a good part of the gas's energy.

    Arguments:
        series: (realizations, modes, samples) complex ξ = Σ w_x exp(iky).
        spacing: time between samples, in τ0.
        particles: N, the real ones.
        temperature: measured T~, m v0² = 1 (T0 is 1/2), scalar or an array of any shape: its mean.
    Either of two signs is enough.
    1. Growth: in the regression ξ(s + 3τ0) = ρ ξ(s) + noise, over all modes and realizations, ρ
       exceeds 1 by three standard errors. A stationary mode has ρ = exp(-3τ0/τ) < 1 and so has one
       that still relaxes towards its stationary amplitude from below, because the noise does not
       know ξ(s): warming up is not taken for running away.
    2. Saturation: in a realization ⟨|ξ|²⟩ exceeds 0.1 N · N T~. A flow of amplitude u has
       ξ = N u/2, and this is 0.1 of the thermal energy; noise of a stable mode holds C(0)/N.
    A series that is not finite has run away too.
    """
    series = np.asarray(series)
    scalar("spacing", spacing, 0.0, np.inf)
    at_least("particles", particles, 1)
    if series.ndim != 3:
        raise ValueError("series must have the shape (realizations, modes, samples).")
    if not np.all(np.isfinite(series)):
        return True
    warm = float(np.mean(temperature))
    energy = np.mean(np.abs(series) ** 2, axis=(1, 2)) / (particles**2 * warm)
    return bool(np.any(energy > LARGEST_ENERGY) or growth_score(series, spacing, warm) > 0)


def growth_score(series, spacing, temperature) -> float:
    """(ρ - 1)/error - 3 of the regression over steps of 3 τ0; negative for a stable mode."""
    stride = max(1, int(np.ceil(STEP / (spacing * np.sqrt(temperature / T0)))))
    chain = series[..., ::stride]
    before, after = chain[..., :-1], chain[..., 1:]
    if before.shape[-1] < 2:
        raise ValueError(f"series must last longer than {3 * STEP:g} τ0 to tell growth.")
    power = np.sum(np.abs(before) ** 2)
    ratio = np.sum((after * np.conj(before)).real) / power
    rest = np.abs(after - ratio * before) ** 2
    # the error of a slope whose noise may grow with the mode (White 1980); Re: half of the noise
    error = np.sqrt(0.5 * np.sum(rest * np.abs(before) ** 2)) / power
    return float((ratio - 1.0) / max(error, 1e-12) - SIGNIFICANCE)
