"""Runs as a user makes them: when they stop, what they repeat, and how they fail."""

import importlib
import itertools
import logging
import os
import signal
import threading

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import xarray as xr
from scipy import stats

import jdsmc
from jdsmc import InelasticHardSpheres, engine, faults, random
from jdsmc.collide import collide
from jdsmc.engine import Engine
from jdsmc.history import History
from jdsmc.options import Options
from jdsmc.pairs import plan_pairs
from jdsmc.scenarios import UniformShear

from .gases import f32, maxwellian


def scene(restitution=0.7, shear_rate=4.0):
    return UniformShear(InelasticHardSpheres(restitution), shear_rate)


def simulate(what=None, **options):
    """Eight gases of 512 particles, so that most runs here share one compiled program."""
    what = scene() if what is None else what
    steps = {"time_step": 0.1, "steps_per_record": 8}
    options = {"n_particles": 512, "n_realizations": 8, "progress": False} | steps | options
    return jdsmc.run(what, **options)


def assert_same(one, other, rtol=0.0):
    """Steady values and series agree, to the last bit by default."""
    for a, b in ((one.to_xarray().to_dataset(), other.to_xarray().to_dataset()),):
        xr.testing.assert_allclose(a, b, rtol=rtol, atol=rtol)
    xr.testing.assert_allclose(one.series, other.series, rtol=rtol, atol=rtol)


# When a run ends


def test_until_precise():
    """The error reported is the one that was asked, of the observable that was named."""
    lengths = []
    for name, rtol in (("shear_stress", 0.03), ("temperature", 0.1), ("temperature", 0.01)):
        result = simulate(observable=name, rtol=rtol)
        assert result[name].error <= rtol * result[name].value
        assert f"{name} is known to" in result.attrs["stopped"]
        assert f"(asked {rtol:g})" in result.attrs["stopped"]
        lengths.append(result.series.sizes["sample"])
    assert lengths[2] > lengths[1]


@pytest.mark.parametrize("worst", [0, 1])
def test_until_every_point_is_precise(worst, monkeypatch):
    """In a sweep the worst point decides."""
    session = importlib.import_module("jdsmc.run").Session
    monkeypatch.setattr(session, "_relative_error", lambda self, p: 0.5 if p == worst else 1e-9)
    result = simulate(scene([0.5, 0.6]), n_realizations=4, rtol=0.02, budget=40.0)
    assert result.attrs["stopped"].startswith("the budget of 40 collisions")
    assert "known to 0.5, asked 0.02" in result.attrs["stopped"]


def test_until_the_budget_ends():
    result = simulate(rtol=1e-5, budget=60.0)
    assert "the budget of 60 collisions per particle ended" in result.attrs["stopped"]
    assert "asked 1e-05" in result.attrs["stopped"]
    assert result.is_steady
    # Less than the longest chunk more: 64 steps of κ ≤ 1/2 candidates for each particle.
    assert 60 - 4 < float(result.series["collisions"][-1]) < 60 + 16


def test_for_a_time():
    result = simulate(duration=3.0)
    assert result.attrs["stopped"] == "the asked time was simulated"
    # Past it by less than one chunk, 64 steps of at most 0.1 τ0; a sample tells its start.
    assert 3.0 - 0.8 <= float(result.series["time"][-1]) < 3.0 + 6.4


def test_for_a_number_of_collisions():
    """Counted at the point that has made fewest: here the less dissipative, hotter gas is ahead."""
    result = simulate(scene([0.5, 0.9]), n_realizations=4, collisions=20.0)
    last = result.series["collisions"][:, -1].values
    assert last[1] > last[0]
    assert 20 - 2 < last[0] < 20 + 16


def test_progress_bar(capfd):
    simulate(rtol=0.1, progress=True)
    text = capfd.readouterr().err
    assert "warming up" in text and "measuring" in text and "shear_stress" in text
    simulate(duration=1.0, progress=True)
    assert "running 100%" in capfd.readouterr().err


# What is measured


def test_warm_up_is_left_out():
    """α = 0.95 heats up to T = 300 T0 in about 100 collisions: none of them is in the mean.

    Against the last 350 collisions of an independent run, within 4 standard errors of the
    difference (Student's t with 7 degrees of freedom: probability 0.5 %, and the seed is fixed).
    A mean with the warm-up in it would be lower by a fifth, ten errors.
    """
    result = simulate(scene(0.95), rtol=0.02, observable="temperature")
    assert result.to_xarray()["steady_from_collisions"] > 60
    long = simulate(scene(0.95), collisions=550.0, seed=1)
    late = long.series["temperature"].values[long.series["collisions"].values > 200]
    assert long.to_xarray()["steady_from_collisions"] < 250  # its error is that of a like window
    value, error = result["temperature"]
    assert value - late.mean() == pytest.approx(
        0, abs=4 * np.hypot(error, long["temperature"].error)
    )
    assert long["temperature"].value == pytest.approx(late.mean(), rel=0.02)


def test_initial_state_and_parameters_of_a_sweep(monkeypatch):
    """At t = 0 T = T0 exactly and a* = a τ_η: every point has its own parameters."""
    monkeypatch.setattr(engine, "_cores", lambda: 4)  # sixteen gases, four at a time
    result = simulate(scene([0.6, 0.9], [0.5, 2.0]), n_realizations=4, duration=1.0)
    series = result.series
    assert series["temperature"].dims == ("restitution", "shear_rate", "sample")
    np.testing.assert_allclose(series["temperature"][..., 0], 1, rtol=1e-6)
    expected = [[0.5, 2.0]] * 2 * np.array(1.016 * 5 * np.sqrt(np.pi) / 8)
    np.testing.assert_allclose(series["reduced_shear_rate"][..., 0], expected, rtol=1e-6)
    late = series["temperature"][..., -1]
    assert np.all(np.diff(late, axis=0) > 0), "less dissipation, hotter"
    assert np.all(np.diff(late, axis=1) > 0), "more shear, hotter"


GASES, PARTICLES = 100, 128


def normal(value, exact, error):
    """z-scores of estimates from 8 realizations (Student's t, 7 degrees) as normal numbers."""
    return stats.norm.ppf(stats.t.cdf((value - exact) / error, 7))


def assert_normal(numbers, extra=0.0):
    """Mean and variance of n standard normal numbers: known to 1/√n and √(2/n); 4.5 of these."""
    n = np.size(numbers)
    assert abs(np.mean(numbers)) < 4.5 / np.sqrt(n)
    assert -4.5 * np.sqrt(2 / n) < np.var(numbers) - 1 < 4.5 * np.sqrt(2 / n) + extra


def test_error_bars_of_series():
    """z-scores of exactly known quantities in 100 independent gases, 8 realizations each.

    An elastic gas at rest has no stress, and a2 = 1/(1 + 2/(3(N-1))) - 1 (velocities uniform on the
    sphere of given energy). The four are uncorrelated. Gases or realizations that share random
    numbers fail: the mean varies as if there were one gas, or the variance is too large.
    """
    result = simulate(scene(np.ones(GASES), 0.0), duration=1.0, n_particles=PARTICLES)
    a2 = 1 / (1 + 2 / (3 * (PARTICLES - 1))) - 1
    known = {"shear_stress": 0, "normal_stress_xy": 0, "normal_stress_zy": 0, "a2": a2}
    last = result.series.isel(sample=-1)
    scores = [normal(last[n].values, x, last[f"{n}_error"].values) for n, x in known.items()]
    assert_normal(scores)


def test_error_bars_of_steady_values():
    """100 equal sheared gases: the scatter of their steady values is what the error bars say.

    The mean over the gases stands for the exact value, which takes 1 % from the variance. The
    correlation of the three is too weak to matter for the bounds.
    """
    result = simulate(scene(np.full(GASES, 0.5)), collisions=40.0, n_particles=PARTICLES)
    estimates = [result[name] for name in ("shear_stress", "temperature", "a2")]
    assert_normal([normal(value, np.mean(value), error) for value, error in estimates])


@pytest.mark.slow
def test_error_bars_of_runs_that_stop_when_precise():
    """200 runs; stopping when the error happens to be small may add 0.3 to the variance."""
    runs = [simulate(rtol=0.03, seed=seed) for seed in range(200)]
    for name in ("shear_stress", "temperature", "a2"):
        value, error = np.transpose([run[name] for run in runs])
        assert_normal(normal(value, np.mean(value), error), extra=0.3)


# What is repeated


def test_same_seed_same_numbers():
    one, other = simulate(rtol=0.1, seed=5), simulate(rtol=0.1, seed=5)
    assert_same(one, other)
    assert one.attrs == other.attrs
    xr.testing.assert_identical(one.distribution, other.distribution)


def test_another_seed_other_numbers():
    one, other = simulate(duration=1.0, seed=5), simulate(duration=1.0, seed=6)
    assert np.all(one.series["shear_stress"] != other.series["shear_stress"])


def test_a_point_does_not_depend_on_the_sweep(monkeypatch):
    """The first point of a sweep is the run of that gas alone: the same program, bit for bit."""
    sweep = simulate(scene([0.6, 0.9]), n_realizations=4, duration=1.0).series
    monkeypatch.setattr(engine, "_cores", lambda: 1)
    alone = simulate(scene(0.6), n_realizations=4, duration=1.0).series
    for name in ("temperature", "shear_stress", "collisions"):
        np.testing.assert_allclose(sweep[name][0], alone[name], rtol=1e-4, atol=1e-5)
        assert np.any(sweep[name][1] != alone[name])


def test_parts_do_not_matter(monkeypatch):
    """Twelve gases in three equal parts, or in two of different size (in one: the test above).

    Parts may be vectorized differently: equal to float32 rounding over one chunk (64 steps), in
    which it grows to 1e-5 at most.
    """
    results = []
    for edges in ((0, 4, 8, 12), (0, 8, 12), (0, 4, 12)):
        parts = [slice(a, b) for a, b in itertools.pairwise(edges)]
        monkeypatch.setattr(engine, "_cut", lambda size, parts=parts: parts)
        results.append(simulate(n_realizations=12, duration=1.0).series)
    for other in results[1:]:
        for name in ("temperature", "shear_stress", "collisions"):
            np.testing.assert_allclose(other[name], results[0][name], rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("size, cores", [(8, 2), (7, 3), (2, 4), (1, 1)])
def test_cut_covers_the_batch(size, cores, monkeypatch):
    monkeypatch.setattr(engine, "_cores", lambda: cores)
    parts = engine._cut(size)
    np.testing.assert_array_equal(np.concatenate([np.arange(size)[p] for p in parts]), range(size))
    assert len(parts) == min(size, cores)


def test_every_gas_has_its_own_key():
    """No key is shared by two gases of a sweep, nor by two seeds (2^64 keys: chance 1e-12)."""
    words = []
    for seed in (0, 1, 2**63):
        keys = engine._keys(seed, 40, 30)
        words += list(zip(np.asarray(keys.high), np.asarray(keys.low), strict=True))
    assert len(set(words)) == 3 * 40 * 30


def test_every_chunk_has_its_own_numbers():
    """The second chunk of a gas that is put back to its start differs from the first."""
    options = Options.checked(512, 0.1, "strang", "float32", 8, 8)
    gas = Engine(jdsmc.grid.flatten(scene())[0], 8, 0, options)
    start = gas._states
    first, _ = gas.advance()
    gas._states = start
    second, _ = gas.advance()
    np.testing.assert_array_equal(first.moments.xy[..., 0], second.moments.xy[..., 0])
    assert np.all(first.moments.xy[..., 1:] != second.moments.xy[..., 1:])


def test_values_compile_nothing(caplog):
    """Another seed, restitution, shear rate or length of the run is the same program."""
    simulate(duration=1.0)
    with jax.log_compiles(), caplog.at_level(logging.WARNING):
        simulate(scene(0.8, 2.0), seed=7, duration=8.0)
        simulate(scene(0.6, 3.0), rtol=0.1)
        simulate(scene([0.7, 0.8]), n_realizations=4, duration=1.0)
        assert not [r for r in caplog.records if "Compiling" in r.getMessage()]
        jax.jit(lambda x: x + 1)(1.0)
        assert [r for r in caplog.records if "Compiling" in r.getMessage()], "else blind"


# Precision and order of a step


@pytest.fixture
def x64():
    """Leaves the switch as it was."""
    before = jax.config.read("jax_enable_x64")
    yield
    jax.config.update("jax_enable_x64", before)


def test_dtypes(x64):
    """float64 is kept throughout, and so is float32 where float64 is enabled.

    The random words are the same, so the two differ by rounding as long as every collision is
    accepted in both: for this seed, over one chunk, by less than 1e-4.
    """
    single = simulate(duration=1.0).series
    jax.config.update("jax_enable_x64", True)
    for dtype in ("float64", "float32"):
        options = Options.checked(512, 0.1, "strang", dtype, 8, 8)
        one, key = engine._cast(scene(), options), random.key_from_seed(1)
        state = eqx.filter_eval_shape(one.initial, key, options)
        shapes = eqx.filter_eval_shape(one.advance, key, state, options)
        floating = [x.dtype for x in jax.tree.leaves(shapes) if x.dtype.kind == "f"]
        assert len(floating) > 10 and set(floating) == {jnp.dtype(dtype)}
    double = simulate(duration=1.0, dtype="float64").series
    common = min(double.sizes["sample"], single.sizes["sample"])  # the slowest clock ends either
    for name in ("temperature", "shear_stress"):
        ours, theirs = (run[name].values[:common] for run in (double, single))
        assert np.any(ours != theirs)
        np.testing.assert_allclose(ours, theirs, rtol=1e-4, atol=1e-4)


def test_float64_needs_x64():
    with pytest.raises(ValueError, match=r"dtype = .*float64.*jax_enable_x64"):
        simulate(dtype="float64")


def test_options_reach_the_engine(monkeypatch):
    seen = []
    monkeypatch.setattr(Engine, "__init__", lambda self, *given: seen.append(given) or 1 / 0)
    with pytest.raises(ZeroDivisionError):
        simulate(splitting="lie", time_step=0.05, steps_per_record=100, seed=3)
    ((_, realizations, seed, options),) = seen
    assert (realizations, seed) == (8, 3)
    assert (options.splitting, options.time_step) == ("lie", 0.05)
    assert (options.steps, options.records) == (100, 1)  # at least one record a chunk


# Bad input


@pytest.mark.parametrize(
    "options, words",
    [
        ({"n_particles": 0}, "n_particles = 0"),
        ({"n_particles": 10}, "n_particles = 10"),
        ({"n_realizations": 3}, r"n_realizations = 3 .*\[4, inf\)"),
        ({"seed": -1}, "seed = -1"),
        ({"seed": 2**64}, "seed = 18446744073709551616"),
        ({"duration": 0.0}, r"duration = 0 .*\(0, inf\)"),
        ({"duration": np.nan}, "duration = nan"),
        ({"collisions": -5.0}, "collisions = -5"),
        ({"duration": 1.0, "collisions": 1.0}, "duration or collisions, not both"),
        ({"rtol": 0.0}, r"rtol = 0 .*\(0, 1\]"),
        ({"rtol": 1.5}, "rtol = 1.5"),
        ({"budget": 0.0}, "budget = 0"),
        ({"time_step": 2.0}, "time_step = 2"),
        ({"observable": "viscosity"}, "observable = 'viscosity' .*reduced_viscosity"),
        ({"steps_per_record": 0}, "steps_per_record = 0"),
    ],
)
def test_bad_options(options, words, monkeypatch):
    """Refused before anything is computed."""
    monkeypatch.setattr(Engine, "advance", lambda self: pytest.fail("a chunk was computed"))
    with pytest.raises(ValueError, match=words):
        simulate(**options)


@pytest.mark.parametrize(
    "name", ["n_particles", "n_realizations", "seed", "duration", "rtol", "splitting", "dtype"]
)
def test_options_of_a_wrong_type(name):
    with pytest.raises((TypeError, ValueError), match=name):
        simulate(**{name: "much"})


@pytest.mark.parametrize("restitution, shear_rate", [(1.0, 4.0), (0.9, 0.0), ([0.9, 1.0], 4.0)])
def test_no_steady_state_to_wait_for(restitution, shear_rate):
    with pytest.raises(ValueError, match=r"no steady state .* give duration or collisions"):
        simulate(scene(restitution, shear_rate))


# Interruption


@pytest.fixture(autouse=True)
def usual_ctrl_c():
    """Ctrl-C as in a terminal: a background job of a shell starts with it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupt_at(monkeypatch, chunk, send):
    """Have Engine.advance send the signal of Ctrl-C while it computes this chunk."""
    advance = Engine.advance

    def patched(self):
        if self.chunks + 1 == chunk:
            send()
        return advance(self)

    monkeypatch.setattr(Engine, "advance", patched)


def test_ctrl_c(monkeypatch):
    """The chunk is finished, what was measured is returned, and Ctrl-C is as it was before."""
    interrupt_at(monkeypatch, 3, lambda: signal.raise_signal(signal.SIGINT))
    before = signal.getsignal(signal.SIGINT)
    result = simulate(collisions=1e6)
    assert result.attrs["stopped"].startswith("interrupted after")
    # three chunks of eight records, as far as the clocks of all realizations have come
    assert 2 * 8 < result.series.sizes["sample"] <= 3 * 8
    assert signal.getsignal(signal.SIGINT) is before
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_ctrl_c_from_outside():
    """The signal comes when it comes, while the main thread waits for XLA."""
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    result = simulate(rtol=1e-9, budget=1e9)
    assert result.attrs["stopped"].startswith("interrupted")
    assert result.is_steady, "by then it was: half a second is 300 collisions"


def test_second_ctrl_c_stops_at_once(monkeypatch):
    def twice():
        for _ in range(2):
            signal.raise_signal(signal.SIGINT)

    interrupt_at(monkeypatch, 3, twice)
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        simulate(collisions=1e6)
    assert signal.getsignal(signal.SIGINT) is before


def test_in_a_thread():
    """Only the main thread can handle signals: elsewhere a run works without."""
    results = []
    thread = threading.Thread(target=lambda: results.append(simulate(duration=1.0)))
    thread.start()
    thread.join()
    assert_same(results[0], simulate(duration=1.0))


# Faults


def test_not_steady():
    """The budget ends in the warm-up: what was measured comes with the error."""
    with pytest.raises(jdsmc.NotSteadyError, match=r"no steady state within 30 .*budget") as caught:
        simulate(scene(0.95), budget=30.0)
    result = caught.value.result
    assert not result.is_steady
    assert 20 < float(result.series["collisions"][-1]) < 50
    assert result.attrs["stopped"] == str(caught.value)


def spoiled(monkeypatch, spoil):
    """Have every engine start from states changed by `spoil`."""
    start = Engine.__init__

    def patched(self, *arguments):
        start(self, *arguments)
        self._states = [spoil(state) for state in self._states]

    monkeypatch.setattr(Engine, "__init__", patched)


@pytest.mark.parametrize("factor", [np.nan, 3e6])
def test_numbers_that_are_not_finite(factor, monkeypatch):
    """NaN, and ⟨V⁶⟩ = 7e38 above the largest float32."""
    spoiled(
        monkeypatch,
        lambda s: eqx.tree_at(lambda s: s.velocity, s, tuple(f32(factor) * v for v in s.velocity)),
    )
    with pytest.raises(jdsmc.FaultError, match=r"infinite or NaN .*reduce time_step") as caught:
        simulate(collisions=5.0)
    assert caught.value.result.attrs["stopped"].startswith("fault: Velocities became")


def check_tally(**changed):
    """The check of the first chunk of a run whose tally is changed; returns its collisions."""
    options = Options.checked(512, 0.1, "strang", "float32", 8, 8)
    flat, _ = jdsmc.grid.flatten(scene())
    record, sample = Engine(flat, 8, 0, options).advance()
    accepted = 10 * record.tally.accepted  # enough of them to judge
    tally = {"accepted": accepted} | {name: share * accepted for name, share in changed.items()}
    for name, values in tally.items():
        record = eqx.tree_at(lambda r, n=name: getattr(r.tally, n), record, values)
    history = History(512, 8)
    history.append(record, sample)
    faults.check(scene(), history, record)


def test_lost_collisions():
    """Counted: candidates without a slot where a step is longer than the waves were made for, and
    pairs that outrun a majorant of 1.5 v0. The longest step that fits loses none.
    """
    plan = plan_pairs(2**12, 0.1)
    velocity = maxwellian(1, Options.checked(2**12, 0.1, "strang", "float32", 8, 8))
    gas, key = InelasticHardSpheres(f32(0.7)), random.key_from_seed(1)
    step = eqx.filter_jit(lambda w, dt: collide(key, gas, plan, velocity, w, dt)[1])
    for majorant, hits, overflow, excess in ((6, 1, 0, 0), (6, 2, 1, 1), (1.5, 1, 0, 1)):
        duration = 0.9999 * hits * plan.largest_hits() * 2**0.5 / majorant
        tally = step(f32(majorant), f32(duration))
        assert (float(tally.overflow) > 0, float(tally.excess) > 0) == (overflow, excess)


@pytest.mark.parametrize("name, words", [("overflow", "had no slot"), ("excess", "above one")])
def test_lost_collisions_are_raised(name, words):
    """From 1e-4 of them on: a tenth of the precision asked by default."""
    check_tally(**{name: 0.99e-4})
    with pytest.raises(jdsmc.FaultError, match=rf"{words} .*reduce time_step"):
        check_tally(**{name: 1.01e-4})
