"""Runs as a user makes them: when they stop, and what they measure."""

import io

import numpy as np
import pytest
from scipy import stats

from jdsmc.running.session import Session

from .small import scene, simulate

# When a run ends


def test_until_precise():
    """The error reported is the one that was asked, of the observable that was named."""
    lengths = []
    for name, rtol in (("shear_stress", 0.03), ("temperature", 0.1), ("temperature", 0.004)):
        result = simulate(observable=name, rtol=rtol)
        assert result[name].error <= rtol * result[name].value
        assert f"{name} is known to" in result.attrs["stopped"]
        assert f"(asked {rtol:g})" in result.attrs["stopped"]
        lengths.append(result.series.sizes["sample"])
    assert lengths[2] > lengths[1]


def test_a_precision_for_each_observable():
    """Each is as precise as it was asked to be, and the file says what was asked."""
    names, asked = ("shear_stress", "a2"), (0.02, 0.3)
    result = simulate(observable=names, rtol=asked)
    for name, share in zip(names, asked, strict=True):
        assert result[name].error <= share * abs(result[name].value)
    assert tuple(result.attrs["rtol"]) == asked
    assert result["a2"].error > 0.02 * abs(result["a2"].value)  # else one number would do


@pytest.mark.parametrize("worst", [0, 1])
def test_until_every_point_is_precise(worst, monkeypatch):
    """In a sweep the worst point decides."""

    def errors(self, point, estimates):
        return {"shear_stress": 0.5 if point == worst else 1e-9}

    monkeypatch.setattr(Session, "_relative_errors", errors)
    result = simulate(scene([0.5, 0.6]), rtol=0.02, budget=40.0)
    assert result.attrs["stopped"].startswith("the budget of 40 collisions")
    assert "known to 0.5, asked 0.02" in result.attrs["stopped"]


def test_until_the_budget_ends():
    result = simulate(rtol=1e-5, budget=120.0)
    assert "the budget of 120 collisions per particle ended" in result.attrs["stopped"]
    assert "asked 1e-05" in result.attrs["stopped"]
    assert result.is_steady
    # Less than the longest chunk more: 64 steps of κ ≤ 1/2 candidates for each particle.
    assert 120 - 4 < float(result.series["collisions"][-1]) < 120 + 16


def test_for_a_time():
    result = simulate(duration=3.0)
    assert "the asked time was simulated, too short for steady values" in result.attrs["stopped"]
    assert "slow relaxation taking" in result.attrs["stopped"]
    # Past it by less than one chunk, 64 steps of at most 0.1 τ0; a sample tells its start.
    assert 3.0 - 0.8 <= float(result.series["time"][-1]) < 3.0 + 6.4


def test_for_a_number_of_collisions():
    """Counted at the point that has made fewest: here the less dissipative, hotter gas is ahead."""
    result = simulate(scene([0.5, 0.9]), collisions=20.0)
    last = result.series["collisions"][:, -1].values
    assert last[1] > last[0]
    assert 20 - 2 < last[0] < 20 + 16


def test_progress_bar(monkeypatch):
    """On a terminal: the phases, and what is asked."""
    terminal = io.StringIO()
    terminal.isatty = lambda: True
    monkeypatch.setattr("sys.stderr", terminal)
    simulate(rtol=0.1, progress=True)
    text = terminal.getvalue()
    assert "warming up" in text and "measuring" in text and "shear_stress" in text
    simulate(duration=1.0, progress=True)
    assert "running 100%" in terminal.getvalue().removeprefix(text)


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


def test_initial_state_and_parameters_of_a_sweep():
    """At t = 0 T = T0 exactly and a* = a τ_η: every point has its own parameters."""
    result = simulate(scene([0.6, 0.9], [0.5, 2.0]), duration=1.0)
    series = result.series
    assert series["temperature"].dims == ("restitution", "shear_rate", "sample")
    np.testing.assert_allclose(series["temperature"][..., 0], 1, rtol=1e-6)
    expected = [[0.5, 2.0]] * 2 * np.array(1.016 * 5 * np.sqrt(np.pi) / 8)
    np.testing.assert_allclose(series["reduced_shear_rate"][..., 0], expected, rtol=1e-6)
    late = series["temperature"][..., -1]
    assert np.all(np.diff(late, axis=0) > 0), "less dissipation, hotter"
    assert np.all(np.diff(late, axis=1) > 0), "more shear, hotter"


GASES, PARTICLES = 60, 128

NUMBER = np.arange(1, GASES + 1)
"""Equal gases have equal random numbers: those below differ by a few units of float32, whose effect
on any average is 1e-5 at most."""


def normal(value, exact, error):
    """z-scores of estimates from 8 realizations (Student's t, 7 degrees) as normal numbers."""
    return stats.norm.ppf(stats.t.cdf((value - exact) / error, 7))


def assert_normal(numbers, extra=0.0):
    """Mean and variance of n standard normal numbers: known to 1/√n and √(2/n); 4.5 of these."""
    n = np.size(numbers)
    assert abs(np.mean(numbers)) < 4.5 / np.sqrt(n)
    assert -4.5 * np.sqrt(2 / n) < np.var(numbers) - 1 < 4.5 * np.sqrt(2 / n) + extra


def test_error_bars_of_series():
    """z-scores of exactly known quantities in 60 independent gases, 8 realizations each.

    An elastic gas at rest has no stress, and a2 = 1/(1 + 2/(3(N-1))) - 1 (velocities uniform on the
    sphere of given energy). The four are uncorrelated. Gases or realizations that share random
    numbers fail: the mean varies as if there were one gas, or the variance is too large.
    """
    result = simulate(scene(1 - 1.2e-7 * NUMBER, 0.0), duration=1.0, n_particles=PARTICLES)
    a2 = 1 / (1 + 2 / (3 * (PARTICLES - 1))) - 1
    known = {"shear_stress": 0, "normal_stress_xy": 0, "normal_stress_zy": 0, "a2": a2}
    last = result.series.isel(sample=-1)
    scores = [normal(last[n].values, x, last[f"{n}_error"].values) for n, x in known.items()]
    assert_normal(scores)


def test_error_bars_of_steady_values():
    """60 sheared gases, as good as equal: their steady values scatter as the error bars say.

    The mean over the gases stands for the exact value, which takes 2 % from the variance. The
    correlation of the three is too weak to matter for the bounds.
    """
    result = simulate(scene(0.5 + 1e-6 * NUMBER), collisions=80.0, n_particles=PARTICLES)
    estimates = [result[name] for name in ("shear_stress", "temperature", "a2")]
    assert_normal([normal(value, np.mean(value), error) for value, error in estimates])


@pytest.mark.slow
def test_error_bars_of_runs_that_stop_when_precise():
    """200 runs; stopping when the error happens to be small may add 0.3 to the variance."""
    runs = [simulate(rtol=0.03, seed=seed) for seed in range(200)]
    for name in ("shear_stress", "temperature", "a2"):
        value, error = np.transpose([tuple(run[name]) for run in runs])
        assert_normal(normal(value, np.mean(value), error), extra=0.3)
