"""The detector of the steady state on histories made up to be steady, slow, or never steady."""

from typing import Any, ClassVar, NamedTuple

import numpy as np
import pytest

import jdsmc
from jdsmc import AbstractGas, ElasticHardSpheres, InelasticHardSpheres, Observable, sweep
from jdsmc.running.history import History
from jdsmc.running.steady import SAFETY, TOLERANCE, SteadyTracker, left_over
from jdsmc.scenarios import AbstractScene, Options, ShearedSlab, UniformShear
from jdsmc.scenarios.approach import UNKNOWN, Approach
from jdsmc.theory.bgk_shear_flow import steady_state

OPTIONS = Options.checked(1024, 0.05, "strang", "float32", 16)
POINTS, REALIZATIONS, RECORDS = 40, 8, 8
NOISE_TIME = 5.0
"""Correlation time of the noise; one record is one collision per particle, here and below."""


def noise(seed, records, time=NOISE_TIME, start=1.0):
    """AR(1) series (points, realizations, records) of unit variance, `start` times it at first."""
    rng = np.random.default_rng(seed)
    fresh = rng.normal(size=(records, POINTS, REALIZATIONS))
    keep = np.exp(-1 / time)
    series = [start * fresh[0]]
    for x in fresh[1:]:
        series.append(keep * series[-1] + np.sqrt(1 - keep**2) * x)
    return np.moveaxis(series, 0, 2)


def changes(history, point, early, start):
    """What `assemble.steady_changes` would say of the mean temperature."""
    before = history.point(point, early, start)["temperature"]
    after = history.point(point, start, history.length)["temperature"]
    error = [np.std(x, ddof=1) / np.sqrt(REALIZATIONS) for x in (after - before, after)]
    return {"T": np.mean(after - before)}, {"T": error[0]}, {"T": error[1]}


class MadeUp(AbstractScene):
    """A scene whose temperatures are made up."""

    gas: AbstractGas
    reports: ClassVar = (Observable("temperature", "temperature"),)
    monitored: ClassVar = ("temperature",)

    def initial(self, key, options):
        raise NotImplementedError

    def advance(self, key, state, options):
        raise NotImplementedError

    def averages(self, record):
        return {"temperature": record.temperature}

    def observables(self, means):
        return means


class Tally(NamedTuple):
    """A tally of one collision per particle and record."""

    accepted: np.ndarray
    energy_lost: np.ndarray
    excess: np.ndarray


class Shown(NamedTuple):
    """Records of a chunk."""

    temperature: np.ndarray
    tally: Tally
    elapsed: np.ndarray


def follow(temperature, approach, each=lambda history, tracker: None):
    """A tracker that was shown these temperatures, chunk by chunk, as a run would."""
    history = History([MadeUp(InelasticHardSpheres(1.0))] * len(temperature), 1, 8)
    tracker = SteadyTracker([approach] * len(temperature), ("temperature",), changes)
    for first in range(0, temperature.shape[2] - RECORDS + 1, RECORDS):
        shown = temperature[:, :, first : first + RECORDS]
        one = np.ones_like(shown)
        record: Any = Shown(shown, Tally(one, one, 0 * one), one)
        history.append(record, None)
        tracker.update(history)
        each(history, tracker)
    return history, tracker


def settled_points(history, tracker):
    """The points that may be printed, and the bias of each mean over its own standard error."""
    for point in range(POINTS):
        if tracker._settled(history, point):
            yield point, tracker.start[point]


def test_stationary_noise_is_steady():
    """Measuring starts after three slow times, but for tests that see a drift by chance.

    That chance is 0.1 % for each of the 12 tests of the measurement: 0.5 of 40 points. More than 5
    have probability 1e-5.
    """
    history, tracker = follow(1 + 0.05 * noise(1, 400), Approach(NOISE_TIME))
    assert tracker.all_measuring
    assert np.min(tracker.start) == 24  # the first chunk that ends after 3 x 1.2 x 5 = 18
    assert np.sum(tracker.start > 24) <= 5
    assert len(list(settled_points(history, tracker))) >= POINTS - 1


def test_stationary_noise_is_steady_without_knowing():
    """The run is 40 correlation times in its last half at the end: most points have settled."""
    history, tracker = follow(1 + 0.05 * noise(1, 400), UNKNOWN)
    assert np.min(tracker.start[tracker.start >= 0]) >= 20  # half of the least of 40
    assert len(list(settled_points(history, tracker))) >= 0.8 * POINTS


@pytest.mark.parametrize(
    ("approach", "first"),
    [
        pytest.param(Approach(30.0), 1.0, id="known-far"),
        pytest.param(Approach(30.0), 0.1, id="known-near"),
        pytest.param(UNKNOWN, 1.0, id="unknown-far", marks=pytest.mark.slow),
        pytest.param(UNKNOWN, 0.1, id="unknown-near"),
    ],
)
def test_slow_approach_is_not_measured(approach, first):
    """T = 1 + D exp(-s/30) with noise as slow that starts from nothing, as that of an energy does.

    Known: the bias (the mean of the exponential) is below TOLERANCE of the error (σ√(2τ/L)/√R, or
    the whole scatter if L < 2τ) but for the estimate of the error from 8 realizations, known to
    25 %: twice that is 4 of these deviations. Unknown: among 40 points looked at 100 times and
    more, none is off by 2 errors.
    """
    records, time, sigma = 1200 if approach.certain else 3000, 30.0, 0.02
    rest = first * np.exp(-np.arange(records) / time)
    bias = []

    def look(history, tracker):
        if history.length % 128:
            return
        for _, start in settled_points(history, tracker):
            length = history.length - start
            error = sigma * np.sqrt(min(1.0, 2 * time / length) / REALIZATIONS)
            bias.append(np.mean(rest[start : history.length]) / error)

    temperature = 1 + rest + sigma * noise(2, records, time, start=0.0)
    history, tracker = follow(temperature, approach, look)
    assert np.max(bias) < (2 * TOLERANCE if approach.certain else 2.0)
    # Not by throwing away most of the run: 30 log(50) = 117 is where the rest is as the noise.
    settled = list(settled_points(history, tracker))
    assert len(settled) >= (0.9 if approach.certain else 0.6) * POINTS
    assert np.max(tracker.start) < (500 if approach.certain else records)


@pytest.mark.parametrize("first", [15.0, 7.5])
def test_share_left_over(first):
    """Of a pure exponential the change between the windows tells what the late one is still off."""
    s, slow = np.arange(0.0, 90.0, 0.01), 7.0
    x = np.exp(-s / slow)
    early, late = np.mean(x[(s >= first) & (s < 30)]), np.mean(x[s >= 30])
    # The sums are Riemann's, with an error of 0.01/2/7 each.
    assert left_over(first, 30.0, 90.0, slow) == pytest.approx(late / (early - late), rel=2e-3)


def test_a_window_too_short_to_tell_settles_nothing():
    """Changes that are no numbers (a fit to too few records), beside an error that is one."""
    temperature = 1 + 0.05 * noise(1, 400)

    def told(history, point, early, start):
        change, uncertainty, error = changes(history, point, early, start)
        return (change | {"T": np.nan}, uncertainty, error)

    history, tracker = follow(temperature, Approach(NOISE_TIME))
    assert tracker._settled(history, 0)
    tracker._drift = told
    assert not tracker._settled(history, 0)


def test_drift_is_never_steady():
    """A drift of 1 % a collision: what was measured is dropped again and again.

    Over 100 collisions the drift is 20 deviations of the noise, so a window kept at the end is
    shorter than that.
    """
    records = 400
    temperature = 1 + 0.01 * np.arange(records) + 0.05 * noise(3, records)
    for approach in (Approach(2.0), UNKNOWN):
        _, tracker = follow(temperature, approach)
        kept = np.where(tracker.start >= 0, records - tracker.start, 0)
        assert np.max(kept) < 100


def test_slow_drift_is_dropped():
    """0.1 % a collision is not seen before it has grown: then it is, over and over."""
    starts = []
    records = 600
    temperature = 1 + 0.001 * np.arange(records) + 0.05 * noise(4, records)
    follow(temperature, Approach(2.0), lambda _, tracker: starts.append(tracker.start.copy()))
    drops = np.sum(np.diff(starts, axis=0) > 0, axis=0)
    assert np.min(drops) >= 3
    assert np.min(starts[-1]) > records / 2


def test_points_are_judged_apart():
    """One steady and one drifting point: only the first is measured from the start."""
    temperature = 1 + 0.05 * noise(5, 320)
    temperature[1:] += 0.02 * np.arange(320)
    history, tracker = follow(temperature, Approach(2.0))
    assert 0 <= tracker.start[0] < 100
    assert np.all((tracker.start[1:] < 0) | (tracker.start[1:] > 200))
    assert not np.any(tracker.settled(history)[1:])


def test_confirm_drops_a_quarter():
    """A jump in the first quarter of a measurement is found and cut off; the rest is kept."""
    temperature = 1 + 0.01 * noise(6, 80)
    temperature[:, :, :16] += 0.5
    history, tracker = follow(temperature, Approach(2.0))
    tracker.start[:] = 0
    assert not tracker.confirm(history, 0)
    assert tracker.start[0] == 20
    assert tracker.confirm(history, 0)
    assert tracker.start[0] == 20


def test_records_too_long_to_compare_put_the_test_off():
    """Records of 12 collisions: the quarters of a short run cannot be told apart, nor divided."""
    history = History([MadeUp(InelasticHardSpheres(1.0))], 1, 8)
    tracker = SteadyTracker([UNKNOWN], ("temperature",))
    rng = np.random.default_rng(3)
    for number in range(1, 65):
        shown = 1 + 0.01 * rng.normal(size=(1, REALIZATIONS, 1))
        tally = Tally(12.0 * np.ones_like(shown), shown, 0 * shown)
        record: Any = Shown(shown, tally, np.ones_like(shown))
        history.append(record, None)
        tracker.update(history)
        assert number >= 32 or not tracker.all_measuring  # 16 blocks in the last half
    assert tracker.all_measuring


# Whole runs against the truth T_s/T0 = a²/(0.5013 (1-α²)) near the elastic limit

LIMIT = 0.5013


def run(scene, **options):
    options = {
        "n_particles": 256,
        "rtol": 0.02,
        "steps_per_record": 64,
        "progress": False,
    } | options
    return jdsmc.run(scene, **options)


@pytest.mark.parametrize(
    ("gas", "seed"),
    [
        (InelasticHardSpheres, 0),
        pytest.param(InelasticHardSpheres, 1, marks=pytest.mark.slow),
        (ElasticHardSpheres, 2),
    ],
)
def test_temperature_near_the_elastic_limit(gas, seed):
    """Started at 0.44 T_s, which takes 75 collisions to e-fold.

    Five errors, and 3 % for terms of order 1-α and 1/N (1 % each).
    """
    alpha, shear_rate = 0.99, 0.15
    result = run(UniformShear(gas(alpha), shear_rate), seed=seed)
    truth = shear_rate**2 / (LIMIT * (1 - alpha**2))
    value, error = result["temperature"]
    assert abs(value - truth) < 5 * error + 0.03 * truth
    assert error < 0.05 * truth
    warm_up = result.to_xarray()["steady_from_collisions"]
    assert warm_up > 3 * SAFETY * 1.5 / (1 - alpha**2)


def test_a_budget_below_the_warm_up_is_refused_at_once():
    """α = 0.9999 takes 7500 collisions to e-fold: nothing is run."""
    with pytest.raises(jdsmc.NotSteadyError, match=r"warm-up takes 2\d{4}, .* 7\.5e\+03") as caught:
        run(UniformShear(InelasticHardSpheres(0.9999), 0.01))
    assert caught.value.result is None


def test_a_budget_too_small_for_the_error_is_refused():
    """T_s = 0.9 T0: of the 10 %, 5 % are left after the least warm-up, and the error is 0.9 %."""
    with pytest.raises(jdsmc.NotSteadyError, match="Raise budget") as caught:
        run(UniformShear(InelasticHardSpheres(0.99), 0.0947), n_particles=1024, budget=320.0)
    assert not caught.value.result.is_steady


def test_short_runs_print_nothing_steady():
    """A given time that is shorter than the approach leaves a series without steady values."""
    result = run(UniformShear(InelasticHardSpheres(0.99), 0.15), collisions=100.0)
    assert not result.is_steady
    with pytest.raises(KeyError, match="no steady values"):
        result["temperature"]


def one(scene):
    """The scene as a run sees it, with plain numbers."""
    return sweep.points(scene)[0][0]


def test_slow_times():
    """Closed forms: 3/2(1-α²) near the elastic limit, and the slab's diffusion added to it."""
    alpha = 0.999
    for gas in (InelasticHardSpheres(alpha), ElasticHardSpheres(alpha)):
        approach = one(UniformShear(gas, 0.001)).approach(OPTIONS)
        assert approach.collisions == pytest.approx(1.5 / (1 - alpha**2), rel=5 * (1 - alpha))
        ratio = LIMIT * (1 - alpha**2) / 0.001**2  # T0/T_s
        assert approach.distance == pytest.approx(np.log(ratio - 1), abs=0.01)
    slab = one(ShearedSlab(InelasticHardSpheres(alpha), 0.001, 10.0)).approach(OPTIONS)
    assert slab.collisions == pytest.approx(1.5 / (1 - alpha**2) + 3.0, rel=5 * (1 - alpha))


class OwnShear(UniformShear):
    """A user's scene that does not say how slow it is."""

    def approach(self, options):
        return UNKNOWN


def test_unknown_slow_time_near_the_elastic_limit():
    """The run itself must tell; bounds as above."""
    alpha, shear_rate = 0.97, 0.25
    truth = float(steady_state(alpha, shear_rate).temperature)
    for seed in range(2):
        result = run(OwnShear(InelasticHardSpheres(alpha), shear_rate), seed=seed, rtol=0.1)
        value, error = result["temperature"]
        assert abs(value - truth) < 5 * error + 0.03 * truth
