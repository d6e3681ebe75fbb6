"""The detector of the steady state on histories made up to be steady, slow, or never steady."""

from types import SimpleNamespace

import numpy as np

from jdsmc.history import History
from jdsmc.steady import SteadyTracker

POINTS, REALIZATIONS, RECORDS = 40, 8, 8
NOISE_TIME = 5.0
"""Correlation time of the noise; one record is one collision per particle, here and below."""


def noise(seed, records):
    """AR(1) series of unit variance (points, realizations, records)."""
    rng = np.random.default_rng(seed)
    fresh = rng.normal(size=(records, POINTS, REALIZATIONS))
    keep = np.exp(-1 / NOISE_TIME)
    series = [fresh[0]]
    for x in fresh[1:]:
        series.append(keep * series[-1] + np.sqrt(1 - keep**2) * x)
    return np.moveaxis(series, 0, 2)


def follow(temperature, each=lambda history, tracker: None):
    """A tracker that was shown these temperatures, chunk by chunk, as a run would."""
    history = History(1, 8, lambda record: {"temperature": record.temperature})
    tracker = SteadyTracker(len(temperature), ("temperature",))
    for first in range(0, temperature.shape[2] - RECORDS + 1, RECORDS):
        shown = temperature[:, :, first : first + RECORDS]
        one = np.ones_like(shown)
        tally = SimpleNamespace(accepted=one, energy_lost=one, excess=0 * one)
        record = SimpleNamespace(temperature=shown, tally=tally, elapsed=one)
        history.append(record, None)
        tracker.update(history)
        each(history, tracker)
    return history, tracker


def test_stationary_noise_is_steady():
    """Measuring starts at the first test, but for tests that see a drift by chance.

    That chance is 2 % for the warm-up and 0.1 % for each of the 12 tests of the measurement: 1.3 of
    40 points. More than 8 have probability 4e-6.
    """
    _, tracker = follow(1 + 0.05 * noise(1, 400))
    assert tracker.all_measuring
    assert np.min(tracker.start) == 16  # the first chunk that ends after FIRST_TEST
    assert np.sum(tracker.start > 16) <= 8


def test_slow_approach_is_not_measured():
    """T = 1 + exp(-s/30) with 2 % noise: what is left of it in the mean is below its error.

    The bias is known (the mean of the exponential), and so is the error of the mean of correlated
    noise: σ√(2τ/L)/√R. The bound is one error for every point and every length of measurement.
    """
    records = 640
    s, sigma = np.arange(records), 0.02
    rest = np.exp(-s / 30)
    bias = []

    def look(history, tracker):
        for start in tracker.start[tracker.start >= 0]:
            length = history.length - start
            if length >= 40:
                error = sigma * np.sqrt(2 * NOISE_TIME / length / REALIZATIONS)
                bias.append(np.mean(rest[start : history.length]) / error)

    _, tracker = follow(1 + rest + sigma * noise(2, records), look)
    assert tracker.all_measuring
    assert np.max(bias) < 1
    # Not by throwing away most of the run: 30 log(1/0.02) = 117 is where the rest is as the noise.
    assert np.max(tracker.start) < 500


def test_drift_is_never_steady():
    """A drift of 1 % a collision: no warm-up ends, or what was measured is dropped again and again.

    Over 100 collisions the drift is 20 deviations of the noise, so a window kept at the end is
    shorter than that.
    """
    records = 400
    _, tracker = follow(1 + 0.01 * np.arange(records) + 0.05 * noise(3, records))
    kept = np.where(tracker.start >= 0, records - tracker.start, 0)
    assert np.max(kept) < 100


def test_slow_drift_is_dropped():
    """0.1 % a collision is not seen before it has grown: then it is, over and over."""
    starts = []
    records = 600
    temperature = 1 + 0.001 * np.arange(records) + 0.05 * noise(4, records)
    follow(temperature, lambda history, tracker: starts.append(tracker.start.copy()))
    drops = np.sum(np.diff(starts, axis=0) > 0, axis=0)
    assert np.min(drops) >= 3
    assert np.min(starts[-1]) > records / 2


def test_points_are_judged_apart():
    """One steady and one drifting point: only the first is measured from the start."""
    temperature = 1 + 0.05 * noise(5, 320)
    temperature[1:] += 0.02 * np.arange(320)
    _, tracker = follow(temperature)
    assert 0 <= tracker.start[0] < 100
    assert np.all((tracker.start[1:] < 0) | (tracker.start[1:] > 200))


def test_confirm_drops_a_quarter():
    """A jump in the first quarter of a measurement is found and cut off; the rest is kept."""
    temperature = 1 + 0.01 * noise(6, 80)
    temperature[:, :, :16] += 0.5
    history, tracker = follow(temperature)
    tracker.start[:] = 0
    assert not tracker.confirm(history, 0)
    assert tracker.start[0] == 20
    assert tracker.confirm(history, 0)
    assert tracker.start[0] == 20


def test_records_too_long_to_compare_put_the_test_off():
    """One record of 12 collisions: its halves cannot be told apart, nor divided by no time."""
    history = History(1, 8, lambda record: {"temperature": record.temperature})
    tracker = SteadyTracker(1, ("temperature",))
    rng = np.random.default_rng(3)
    for number in range(1, 9):
        shown = 1 + 0.01 * rng.normal(size=(1, REALIZATIONS, 1))
        tally = SimpleNamespace(
            accepted=12.0 * np.ones_like(shown), energy_lost=shown, excess=0 * shown
        )
        record = SimpleNamespace(temperature=shown, tally=tally, elapsed=np.ones_like(shown))
        history.append(record, None)
        tracker.update(history)
        assert number > 3 or not tracker.all_measuring
    assert tracker.all_measuring
