"""Fluctuating hydrodynamic modes: autocorrelation, decay rate, viscosity and noise, with errors.

Costantini & Puglisi, PRE 82, 011305: eqs. (8)-(11), for modes in the stationary representation.
Units: T0 = m v0²/2 with v0 = m = 1, lengths λ0 = 1/(2√2 n σ), times τ0 = λ0/v0; disks.
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from ..check import at_least, scalar
from ..stats import jackknife
from ..units import INITIAL_TEMPERATURE as T0
from .mode_spectrum import (
    FASTEST_TAIL,
    HIGHEST_FREQUENCY,
    STRESS_RATE,
    Spectrum,
    fit,
    periodograms,
)

ELASTIC_VISCOSITY = 1.0 / np.sqrt(np.pi)
"""ν_el = η0/(n m) of elastic disks at T0, first Sonine order, in λ0 v0."""

SHORTEST_RUN = 100.0
SHORTEST_BLOCK = 20.0
USUAL_BLOCK = 25.0
"""In decay times: below the first two the error bars are called doubtful; the third is cut."""

FEWEST_BLOCKS = 8
LONGEST_LAG = 5.0
"""C(s) is given up to this many decay times."""

FITTED = (
    "mode_decay_rate",
    "viscosity_ratio",
    "noise_viscosity_ratio",
    "noise_over_viscosity",
    "tail_amplitude",
    "tail_noise_viscosity_ratio",
    "tail_noise_over_viscosity",
)


@dataclass(frozen=True)
class ModeMeasurement:
    """What the modes of one wave number say.

    lag: (lags,) in τ0.
    autocorrelation, autocorrelation_error: (lags,) C(s)/(N T~/m) and one standard error.
    value, error: by name, `error` one standard error; NaN where C(s) has no exponential tail
        (a homogeneous DSMC, white noise), of all but C(0) and the temperature:
        mode_amplitude: C(0) = ⟨|ξ|²⟩/(N T~/m), the equal-time one.
        mode_decay_rate: 1/τ, in 1/τ0.
        viscosity_ratio: η/η0 = (1/τ + μ)/(k² ν_el(T~)), eq. (10).
        noise_viscosity_ratio: η1/η0 = C(0)/(τ k² ν_el(T~)), eq. (11).
        noise_over_viscosity: η1/η = C(0)/(1 + μτ).
        tail_amplitude: A of the tail A exp(-s/τ) of C(s); A > C(0).
        tail_noise_viscosity_ratio, tail_noise_over_viscosity: with A in place of C(0), what the
            noise would be if it were white.
        temperature: T~/T0.
    stress_rate: k2 of the fitted form, in 1/τ0.
    blocks, block_length: how many entered the jackknife, and their length over τ.
    run_length: time over τ, of all realizations together.
    warnings: why the error bars are doubtful; empty if they are not.
    """

    lag: np.ndarray
    autocorrelation: np.ndarray
    autocorrelation_error: np.ndarray
    value: dict[str, float]
    error: dict[str, float]
    stress_rate: float
    blocks: int
    block_length: float
    run_length: float
    warnings: tuple[str, ...]


def measure_modes(
    series,
    spacing,
    particles,
    temperature,
    growth_rate,
    wave_number,
    *,
    longest_lag=None,
    highest_frequency=HIGHEST_FREQUENCY,
) -> ModeMeasurement:
    """Estimate C(s), C(0), 1/τ, η, η1 from stationary series of equivalent modes.

    Arguments:
        series: (realizations, modes, samples) complex ξ = Σ w_x exp(iky), modes of equal |k|;
            in an elastic gas ⟨|ξ|²⟩ = N T.
        spacing: time between samples, in τ0.
        particles: N, the real ones.
        temperature: measured T~ (T0 is 1/2): one number, one per realization, or one per
            realization and sample.
        growth_rate: the imposed μ, in 1/τ0.
        wave_number: k, in 1/λ0.
        longest_lag: of C(s), in τ0; without it 5 decay times. Never more than half a block.
        highest_frequency: of the fit, in √(T~/T0)/τ0; lower for less bias and more noise, as in
            runs of 10⁴ decay times, or for N n σ² above 50.
    Raises: TypeError or ValueError for what is out of range, or too short to say anything.

    The rate is fitted to the periodograms of blocks of about 25 decay times by Whittle's
    likelihood (`mode_spectrum`); C(0) is the plain mean of |ξ|². Errors are by jackknife over the
    blocks of all realizations, refitted without each, so that the correlation of C(0) and τ is in
    those of their ratios. They are one standard error, without a factor of Student's t.
    """
    at_least("particles", particles, 1)
    scalar("growth_rate", 1.0 + growth_rate, 1.0 - 1e-12, np.inf)
    scalar("wave_number", wave_number, 0.0, np.inf)
    means, plan = block_means(series, spacing, temperature, highest_frequency)
    decay = float(np.exp(-plan.pooled[1]))
    lags = min(int((longest_lag or LONGEST_LAG * decay) / spacing) + 1, plan.spectrum.length // 2)
    means["correlation"] = means["correlation"][:, : max(2, lags)]

    def observables(mean):
        return mode_observables(mean, plan, particles, growth_rate, wave_number)

    value, error, _ = jackknife(means, observables, axis=0)
    if no_tail(plan.pooled):
        error |= dict.fromkeys(FITTED, np.nan)
    correlation, correlation_error = value.pop("autocorrelation"), error.pop("autocorrelation")
    blocks, length = len(means["power"]), plan.spectrum.length
    series = np.asarray(series)
    run, block = series.shape[0] * series.shape[2] * spacing / decay, length * spacing / decay
    return ModeMeasurement(
        lag=spacing * np.arange(correlation.size),
        autocorrelation=correlation,
        autocorrelation_error=correlation_error,
        value={name: float(number) for name, number in value.items()},
        error={name: float(number) for name, number in error.items()},
        stress_rate=float(np.exp(plan.pooled[2])),
        blocks=blocks,
        block_length=float(block),
        run_length=float(run),
        warnings=doubts(run, block, blocks, plan.pooled),
    )


class Plan(NamedTuple):
    """How series were cut: the spectrum of a block, √(T~/T0), parameters fitted to all of them."""

    spectrum: Spectrum
    pace: float
    pooled: np.ndarray


def block_means(
    series, spacing, temperature, highest_frequency=HIGHEST_FREQUENCY
) -> tuple[dict[str, np.ndarray], Plan]:
    """What adds up over blocks: `power`, `correlation`, `temperature`, arrays (blocks, ...).

    Arguments as of `measure_modes`. A block lasts about 25 decay times.
    """
    series = _checked_series(series)
    scalar("spacing", spacing, 0.0, np.inf)
    scalar("highest_frequency", highest_frequency, 0.0, np.inf)
    temperature = _per_sample(temperature, series)
    pace = float(np.sqrt(np.mean(temperature) / T0))
    highest = highest_frequency * pace
    start, length = _block_length(series, spacing, pace, highest)
    blocks, warm = cut(series, length), cut(temperature[:, None], length)
    spectrum, power = periodograms(blocks, spacing, highest)
    pooled = fit(np.mean(power, axis=0), spectrum, STRESS_RATE * pace, start)
    means = {
        "power": power,
        "correlation": _correlation(blocks, max(2, length // 2)),
        "temperature": np.mean(warm, axis=(1, 2)),
    }
    return means, Plan(spectrum, pace, pooled)


def mode_observables(mean: dict, plan: Plan, particles, growth_rate, wave_number) -> dict:
    """Everything of `ModeMeasurement.value`, and C(s), from an average of block means."""
    found = fit(mean["power"], plan.spectrum, STRESS_RATE * plan.pace, plan.pooled)
    norm = particles * mean["temperature"]
    result = _derived(found, mean["correlation"][0] / norm, growth_rate, wave_number, mean)
    return result | {"autocorrelation": mean["correlation"] / norm}


def _checked_series(series) -> np.ndarray:
    series = np.asarray(series)
    if series.ndim != 3 or series.dtype.kind not in "cf":
        raise TypeError("series must be a complex array (realizations, modes, samples).")
    if series.shape[0] * series.shape[1] == 0 or series.shape[2] < 16:
        raise ValueError(f"series has {series.shape[2]} samples of a mode; give at least 16.")
    if not np.all(np.isfinite(series)):
        raise ValueError("series must be finite: a mode has overflowed.")
    if not np.any(series):
        raise ValueError("series is zero everywhere; give modes that fluctuate.")
    return series.astype(complex)


def _per_sample(temperature, series) -> np.ndarray:
    """T~ as an array (realizations, samples)."""
    warm = np.asarray(temperature, dtype=float)
    realizations, _, samples = series.shape
    if warm.shape not in ((), (realizations,), (realizations, samples)):
        raise ValueError(
            f"temperature has shape {warm.shape}; give one number, one per realization or one per "
            f"realization and sample, ({realizations}, {samples})."
        )
    if not np.all((warm > 0) & np.isfinite(warm)):
        raise ValueError("temperature must be positive and finite.")
    return np.broadcast_to(warm if warm.ndim != 1 else warm[:, None], (realizations, samples))


def _block_length(series, spacing, pace, highest):
    """Parameters fitted to whole realizations, and the samples in a block of 25 decay times.

    At least two blocks of one realization, when there is no other: a jackknife needs them.
    """
    spectrum, power = periodograms(series, spacing, highest)
    start = fit(np.mean(power, axis=0), spectrum, STRESS_RATE * pace)
    realizations, _, samples = series.shape
    count = max(1, int(samples * spacing * np.exp(start[1]) / USUAL_BLOCK))
    count = min(count, samples // 16)
    if realizations * count == 1:
        count = 2
        if samples < 32:
            raise ValueError("series of one realization must have at least 32 samples.")
    return start, samples // count


def cut(series: np.ndarray, length: int) -> np.ndarray:
    """(realizations, modes, samples) to (blocks, modes, length), dropping the remainder."""
    realizations, modes, samples = series.shape
    count = samples // length
    whole = series[..., : count * length].reshape(realizations, modes, count, length)
    return np.swapaxes(whole, 1, 2).reshape(realizations * count, modes, length)


def _correlation(blocks: np.ndarray, lags: int) -> np.ndarray:
    """Mean of Re ξ(s+l) ξ*(s) over the pairs within each block and over modes: (blocks, lags)."""
    length = blocks.shape[-1]
    padded = np.fft.fft(blocks, n=2 * length, axis=-1)
    sums = np.fft.ifft(np.mean(np.abs(padded) ** 2, axis=1), axis=-1).real[:, :lags]
    return sums / (length - np.arange(lags))


def _derived(found, amplitude, growth_rate, wave_number, mean) -> dict:
    """Eqs. (9)-(11) from (ln C(0), ln κ, ln k2), the equal-time C(0) and the temperature."""
    _, rate, fast = np.exp(found)
    pace = np.sqrt(mean["temperature"] / T0)
    viscous = wave_number**2 * ELASTIC_VISCOSITY * pace
    tail = amplitude * fast / (fast - rate)
    return {
        "mode_amplitude": amplitude,
        "mode_decay_rate": rate,
        "viscosity_ratio": (rate + growth_rate) / viscous,
        "noise_viscosity_ratio": amplitude * rate / viscous,
        "noise_over_viscosity": amplitude * rate / (rate + growth_rate),
        "tail_amplitude": tail,
        "tail_noise_viscosity_ratio": tail * rate / viscous,
        "tail_noise_over_viscosity": tail * rate / (rate + growth_rate),
        "temperature": mean["temperature"] / T0,
    }


def no_tail(found) -> bool:
    """The fit lies at the edge of what it can describe."""
    return bool(found[1] > found[2] + np.log(0.99 * FASTEST_TAIL))


def doubts(run: float, block: float, blocks: int, pooled) -> tuple[str, ...]:
    """Sentences on what makes the error bars doubtful."""
    doubts = []
    if run < SHORTEST_RUN:
        doubts.append(
            f"The modes were followed for {run:.0f} decay times in all; error bars need "
            f"{SHORTEST_RUN:.0f}."
        )
    if block < SHORTEST_BLOCK:
        doubts.append(
            f"A block lasts {block:.1f} decay times; for independent blocks give realizations of "
            f"{SHORTEST_BLOCK:.0f} or more."
        )
    if blocks < FEWEST_BLOCKS:
        doubts.append(f"Only {blocks} blocks: the error bars are themselves uncertain.")
    if no_tail(pooled):
        doubts.append("The mode decays as fast as the stress behind it: no hydrodynamic tail.")
    return tuple(doubts)
