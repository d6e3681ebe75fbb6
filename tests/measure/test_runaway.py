"""Modes that grow without bound are told from noise next to the limit of stability."""

import numpy as np
import pytest

from jdsmc.measure.runaway import runs_away

from .mode_process import NEAR_THE_LIMIT

PARTICLES, T0 = 1000, 0.5


def _growing(rng, realizations, rate, duration, spacing=0.7, start=7.0):
    """Modes with dξ = rate ξ ds + noise of the strength of α = 0.8, N n σ² = 30."""
    samples = int(duration / spacing)
    shape = (samples, realizations, 2)
    noise = rng.normal(size=shape) + 1j * rng.normal(size=shape)
    series = np.sqrt(0.5 * PARTICLES * T0 * 0.2 * spacing) * noise
    series[0] = np.sqrt(0.5 * PARTICLES * T0 * start) * noise[0]
    for index in range(1, samples):
        series[index] += series[index - 1] * np.exp(rate * spacing)
    return np.moveaxis(series, 0, -1)


@pytest.mark.parametrize("spacing", [0.7, 14.5])
@pytest.mark.parametrize("decay_times", [1, 5])
def test_no_false_alarm_near_the_limit(spacing, decay_times):
    """τ = 73 τ0, C(0) = 7.8: none in 2000 runs was seen at any length; none of 100 here."""
    samples = int(decay_times / NEAR_THE_LIMIT.decay_rate / spacing) + 4
    for seed in range(100):
        rng = np.random.default_rng([seed, 1])
        series = NEAR_THE_LIMIT.sample(rng, (1, 2, samples), spacing)
        assert not runs_away(series, spacing, PARTICLES, T0)


@pytest.mark.parametrize("rate", [0.005, 0.03])
def test_growth_is_seen(rate):
    """Eight realizations for two growth times, C up to about 1000: every one of 20."""
    for seed in range(20):
        series = _growing(np.random.default_rng([seed, 2]), 8, rate, 2 / rate)
        assert runs_away(series, 0.7, PARTICLES, T0)


def test_warming_up_is_not_running_away():
    """C(s) that rises from 0 to its stationary value grows, but the modes forget: no alarm."""
    for seed in range(40):
        rng = np.random.default_rng([seed, 3])
        series = _growing(rng, 8, -0.0137, 50.0, start=0.1)
        early, late = (
            np.mean(np.abs(series[..., :20]) ** 2),
            np.mean(np.abs(series[..., -20:]) ** 2),
        )
        assert late > 2 * early
        assert not runs_away(series, 0.7, PARTICLES, T0)


def test_a_flow_that_has_saturated():
    """A constant flow of amplitude u = 0.7 √T... |ξ|² = N²u²/4 = 0.12 N² T: does not grow."""
    series = np.full((2, 1, 100), np.sqrt(0.12 * T0) * PARTICLES, dtype=complex)
    assert runs_away(series, 0.7, PARTICLES, T0)
    assert not runs_away(0.5 * series, 0.7, PARTICLES, T0)  # 0.03: below the threshold, no growth


def test_overflow():
    series = np.ones((1, 1, 50), dtype=complex)
    series[0, 0, -1] = np.inf
    assert runs_away(series, 0.7, PARTICLES, T0)


def test_bad_input():
    with pytest.raises(ValueError, match="shape"):
        runs_away(np.ones(10), 0.7, PARTICLES, T0)
    with pytest.raises(ValueError, match="last longer"):
        runs_away(np.ones((1, 1, 5), complex), 0.7, PARTICLES, T0)
