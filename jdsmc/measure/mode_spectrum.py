"""Amplitude and decay rate of a fluctuating mode, from the periodograms of its time series.

The autocorrelation of a transverse mode starts with zero slope, because collisions conserve
momentum, and bends into an exponential tail. The model that is fitted has both properties:

    C(s) = [k2 exp(-κ s) - κ exp(-k2 s) cos(0.4 k2 s)] C(0) / (k2 - κ),

κ = 1/τ the rate of the tail and k2 that of the stress behind it. The cosine is an approximation
of the fast part, which in the linear Boltzmann-Langevin equation is a whole family of rates; the
0.4 was chosen there. The price of the approximation is held down by leaving out the frequencies
above 0.65/τ0: for 0.7 <= α <= 1 and N n σ² of 10 to 50 what is left of it is below a third of
the error bar of 1000 decay times, in every observable (below a fifth for 15 to 30). With a single
exponential in place of the cosine and all frequencies the viscosity came out 3 to 22 % too large.
"""

from typing import NamedTuple

import numpy as np

PHASE = 0.4
"""The fast part of C(s) is exp(-k2 s) cos(PHASE k2 s)."""

HIGHEST_FREQUENCY = 0.65
"""Frequencies that are used, in √(T/T0)/τ0 (that is 1.84 n σ √(2T/m))."""

STRESS_RATE = 1.0
"""Where k2 is expected, in √(T/T0)/τ0: the deterministic theory has 0.93 to 1.12 of it."""

STRESS_RATE_SPREAD = 0.4
"""Standard deviation of ln k2 before the data: three to five times that scatter."""

FASTEST_TAIL = 0.6
"""Largest κ/k2; beyond 0.7 the form is no autocorrelation, its spectrum becomes negative."""


class Spectrum(NamedTuple):
    """Periodograms of blocks and what is needed to fit them.

    `frequency` (frequencies,), in 1/τ0; `weight` (frequencies,): independent exponential variates
    behind each entry of an average over all blocks; `length`: samples per block; `spacing` in τ0.
    """

    frequency: np.ndarray
    weight: np.ndarray
    length: int
    spacing: float


def periodograms(blocks: np.ndarray, spacing: float, highest: float):
    """Spectrum and periodograms |Σ ξ exp(-iωs)|²/B of complex series, mean over modes and ±ω.

    Arguments:
        blocks: (blocks, modes, B) complex, uniformly sampled.
        spacing: time between samples.
        highest: frequencies above it are dropped; at least four are kept.
    Returns: the Spectrum and an array (blocks, frequencies).
    C(s) is real for a transverse mode, so that ω and -ω are equivalent and independent.
    """
    count, modes, length = blocks.shape
    power = np.mean(np.abs(np.fft.fft(blocks, axis=-1)) ** 2, axis=1) / length
    index = np.arange(length // 2 + 1)
    frequency = 2 * np.pi * index / (length * spacing)
    kept = index[: max(4, int(np.searchsorted(frequency, highest, side="right")))]
    alone = (kept == 0) | (2 * kept == length)
    both = 0.5 * (power[:, kept] + power[:, -kept])
    weight = count * modes * np.where(alone, 1.0, 2.0)
    return Spectrum(frequency[kept], weight, length, spacing), both


def expected_exponential(rate, spectrum: Spectrum):
    """Expected periodogram of a mode with C(s) = Re exp(-rate |s|), and its slope by ln |rate|.

    Σ_l Re(r^|l|) (1 - |l|/B) exp(-iωhl), r = exp(-rate h), |l| < B, summed in closed form: the
    aliasing by the sampling and the leakage of the finite record are in it exactly. `rate` is a
    real or a complex number with a positive real part. Both arrays have the shape (frequencies,).
    """
    turn = np.exp(1j * spectrum.frequency * spectrum.spacing)
    decay = rate * spectrum.spacing
    step, last = np.exp(-decay), np.exp(-decay * spectrum.length)
    share = (1.0 - last) / spectrum.length
    # of a real rate the two directions are complex conjugates of each other
    ways = (step * turn, step / turn) if np.iscomplexobj(rate) else (step * turn,)
    total, slope = np.zeros(turn.shape), np.zeros(turn.shape)
    for q in ways:
        inverse = 1.0 / (1.0 - q)
        ratio = q * inverse
        total += (inverse * (1.0 - share * ratio)).real
        change = inverse * (1.0 - share * (1.0 + 2.0 * ratio) + last)
        slope -= (decay * ratio * change).real
    return 2.0 / len(ways) * total - 1.0, 2.0 / len(ways) * slope


def expected(parameters: np.ndarray, spectrum: Spectrum):
    """Expected periodogram of the model at (ln C(0), ln κ, ln k2), and its slopes by them.

    Returns: arrays (frequencies,) and (3, frequencies).
    """
    amplitude, slow, fast = np.exp(parameters)
    tail, tail_slope = expected_exponential(slow, spectrum)
    start, start_slope = expected_exponential(fast * (1.0 + 1j * PHASE), spectrum)
    scale = amplitude / (fast - slow)
    model = scale * (fast * tail - slow * start)
    by_slow = scale * (fast * tail_slope - slow * start) + model * slow / (fast - slow)
    by_fast = scale * (fast * tail - slow * start_slope) - model * fast / (fast - slow)
    return model, np.array([model, by_slow, by_fast])


def model_autocorrelation(lag, amplitude: float, slow: float, fast: float) -> np.ndarray:
    """C(s) of the model, see the head of this file."""
    lag = np.abs(lag)
    start = np.exp(-fast * lag) * np.cos(PHASE * fast * lag)
    return amplitude * (fast * np.exp(-slow * lag) - slow * start) / (fast - slow)


def _likelihood(parameters, power, spectrum, prior):
    """Minus the logarithm of Whittle's likelihood times the prior; uphill gradient, information.

    Returns: a number, (3,) and the Fisher matrix (3, 3), all with the prior of ln k2.
    """
    model, slopes = expected(parameters, spectrum)
    slope = slopes / model
    excess = power / model
    distance = (parameters[2] - prior) / STRESS_RATE_SPREAD
    loss = np.sum(spectrum.weight * (np.log(model) + excess)) + 0.5 * distance**2
    gradient = slope @ (spectrum.weight * (excess - 1.0))
    fisher = (slope * spectrum.weight) @ slope.T
    gradient[2] -= distance / STRESS_RATE_SPREAD
    fisher[2, 2] += 1.0 / STRESS_RATE_SPREAD**2
    return loss, gradient, fisher


def _confined(parameters: np.ndarray, spectrum: Spectrum) -> np.ndarray:
    """The tail at most FASTEST_TAIL times as fast as the stress; no slower than 1000 records."""
    slowest = np.log(1e-3 / (spectrum.length * spectrum.spacing))
    slow = np.clip(parameters[1], slowest, parameters[2] + np.log(FASTEST_TAIL))
    return np.array([parameters[0], slow, parameters[2]])


def first_guess(power: np.ndarray, spectrum: Spectrum, stress_rate: float) -> np.ndarray:
    """Best of 40 decay rates, each with its best amplitude."""
    record = spectrum.length * spectrum.spacing
    trials = []
    for slow in np.geomspace(0.1 / record, 0.5 * stress_rate, 40):
        start = np.log([1.0, slow, stress_rate])
        model, _ = expected(start, spectrum)
        start[0] = np.log(np.average(power / model, weights=spectrum.weight))
        loss, _, _ = _likelihood(start, power, spectrum, start[2])
        trials.append((loss, start))
    return min(trials, key=lambda trial: trial[0])[1]


def fit(power: np.ndarray, spectrum: Spectrum, stress_rate: float, start=None) -> np.ndarray:
    """Most likely (ln C(0), ln κ, ln k2): Fisher scoring with halved steps.

    Arguments:
        power: (frequencies,) the average periodogram.
        stress_rate: where k2 is expected, in 1/τ0.
        start: parameters to begin with; without it a search over κ.
    """
    prior = np.log(stress_rate)
    at = first_guess(power, spectrum, stress_rate) if start is None else start
    loss, gradient, fisher = _likelihood(at, power, spectrum, prior)
    for _ in range(50):
        step = np.linalg.solve(fisher, gradient)
        step = step / max(1.0, np.max(np.abs(step)))
        for _ in range(20):
            trial = _confined(at + step, spectrum)
            lower, gradient, fisher = _likelihood(trial, power, spectrum, prior)
            if lower <= loss:
                break
            step = 0.5 * step
        else:
            return at
        moved = np.max(np.abs(trial - at))
        at, loss = trial, lower
        if moved < 1e-5:  # the next step would be smaller still: far below any error bar
            break
    return at
