"""Estimates: how they are printed, and arithmetic that propagates their errors."""

import pickle
import subprocess
import sys

import numpy as np
import pytest

from jdsmc import Estimate, combine
from jdsmc.estimate import format_estimate
from jdsmc.stats import jackknife

REALIZATIONS = 8


@pytest.mark.parametrize(
    "value, error, text",
    [
        (0.33251, 0.00042, "0.33251(42)"),
        (-1.5, 0.25, "-1.50(25)"),
        (2.0, 0.0999, "2.00(10)"),  # rounds up to one digit more
        (2.0, 0.996, "2.0(10)"),
        (21.2, 9.96, "21(10)"),
        (1234.5, 99.7, "1234(100)"),
        (1234.5, 120.0, "1234(120)"),
        (305.6, 1.0, "305.6(10)"),
        (0.5, 0.0, "0.5"),
        (1 - 1e-15, 4e-16, "1"),  # rounding of what is conserved
        (2.0, 3e-6, "2.0000000(30)"),
        (0.5, np.nan, "0.5(nan)"),
        (np.nan, np.nan, "nan"),
    ],
)
def test_format(value, error, text):
    """The error in units of the last digits."""
    assert format_estimate(value, error) == text
    assert str(Estimate(value, error)) == text


def measured(run, functions, seed=1, shape=()):
    """Estimates of functions of two correlated averages over the realizations of one run."""
    rng = np.random.default_rng(seed)
    common = rng.normal(size=(REALIZATIONS, *shape))
    x = 3.0 + 0.15 * (common + 0.3 * rng.normal(size=common.shape))
    y = 2.0 + 0.10 * (common + 0.3 * rng.normal(size=common.shape))
    names = {str(k): f for k, f in enumerate(functions)}
    value, error, left_out = jackknife(
        {"x": x, "y": y}, lambda m: {k: f(m["x"], m["y"]) for k, f in names.items()}, axis=0
    )
    return [Estimate(value[k], error[k], {run: left_out[k]}) for k in names]


def x_of(x, y):
    return x


def y_of(x, y):
    return y


def test_nothing_is_left_of_a_difference_with_itself():
    """Exactly zero, with no error; so it is for numbers of unknown origin and for arrays."""
    (a,), (many,) = measured("run", [x_of]), measured("run", [x_of], shape=(3,))
    for one in (a, many, Estimate(1.0, 0.1), Estimate(np.ones(3), np.full(3, 0.1))):
        value, error = one - one
        assert np.all(value == 0.0) and np.all(error == 0.0)
        value, error = one / one
        assert np.all(value == 1.0) and np.all(error == 0.0)


def test_what_one_run_measures_is_correlated():
    """The same numbers said to be of two runs: the error of the difference is then larger.

    Var(x - y) = Var x + Var y - 2 Cov; here the correlation is 1/(1 + 0.09), or near it.
    """
    a, b = measured("run", [x_of, y_of])
    (other,) = measured("other run", [lambda x, y: y])
    assert other.value == b.value and other.error == pytest.approx(b.error, rel=1e-12)
    together, apart = (a - b).error, (a - other).error
    assert together < 0.6 * apart
    assert apart == pytest.approx(np.hypot(a.error, b.error), rel=1e-12)
    assert (a + b).error > 1.2 * apart


FUNCTIONS = {
    "difference": (lambda x, y: x - y, lambda a, b: a - b),
    "ratio": (lambda x, y: x / y, lambda a, b: a / b),
    "product": (lambda x, y: x * y, lambda a, b: a * b),
    "powers": (lambda x, y: x**2 / y**3, lambda a, b: a**2 / b**3),
    "numbers": (lambda x, y: 1.0 - 2.0 / (3.0 * x + y), lambda a, b: 1.0 - 2.0 / (3.0 * a + b)),
    "signs": (lambda x, y: abs(-x) - y, lambda a, b: abs(-a) - b),
    "map": (lambda x, y: np.log(x) + y, lambda a, b: a.map(np.log) + b),
    "combine": (np.hypot, lambda a, b: combine(np.hypot, a, b)),
}


@pytest.mark.parametrize("shape", [(), (3,)])
@pytest.mark.parametrize("name", FUNCTIONS)
def test_arithmetic_is_a_jackknife(name, shape):
    """Of estimates of one run: value and error of the function taken at once, to rounding."""
    at_once, stepwise = FUNCTIONS[name]
    (expected,) = measured("run", [at_once], shape=shape)
    found = stepwise(*measured("run", [x_of, y_of], shape=shape))
    np.testing.assert_allclose(found.value, expected.value, rtol=1e-12)
    np.testing.assert_allclose(found.error, expected.error, rtol=1e-9)


def test_different_runs_add_in_quadrature():
    """Exactly for a sum; a sum of three runs too, and of numbers of unknown origin."""
    (a,), (b,), (c,) = (measured(f"run {k}", [x_of], seed=k) for k in (1, 2, 3))
    assert (a - b).error == pytest.approx(np.hypot(a.error, b.error), rel=1e-12)
    total = combine(lambda x, y, z: x + 2.0 * y - z, a, b, c)
    exact = np.sqrt(a.error**2 + 4.0 * b.error**2 + c.error**2)
    assert total.error == pytest.approx(exact, rel=1e-12)
    assert total.value == a.value + 2.0 * b.value - c.value
    plain = Estimate(1.0, 0.3) - Estimate(2.0, 0.4)
    assert plain.error == pytest.approx(0.5, rel=1e-12)
    # what shares one of its runs is correlated through that one only
    assert ((a + b) - b).error == pytest.approx(a.error, rel=1e-9)


def test_elements_of_one_gas_are_correlated():
    """Two classes of one gas are as correlated as two averages; of two gases they are not."""
    a, b = measured("run", [x_of, y_of])
    left_out = {"run": np.stack([one._left_out["run"] for one in (a, b)], axis=-1)}
    both = ([a.value, b.value], [a.error, b.error])
    profile = Estimate(*map(np.array, both), left_out, points=np.zeros(2, int))
    assert (profile[0] - profile[1]).error == pytest.approx((a - b).error, rel=1e-12)
    assert (profile[0] - a).error == pytest.approx(0.0, abs=1e-15)  # the same run
    sweep = Estimate(*map(np.array, both), left_out)
    apart = (sweep[0] - sweep[1]).error
    assert apart == pytest.approx(np.hypot(a.error, b.error), rel=1e-12)


def test_points_of_a_sweep_are_independent():
    (sweep,) = measured("run", [x_of], shape=(2,))
    first, second = sweep[0], sweep[1]
    assert (first.value, first.error) == (sweep.value[0], sweep.error[0])
    assert (first - second).error == pytest.approx(np.hypot(*sweep.error), rel=1e-12)
    assert (first - sweep[0]).error == 0.0


def test_windows_that_do_not_match():
    """Eight realizations against four of one run: they cannot be paired."""
    (a,) = measured("run", [x_of])
    short = Estimate(1.0, 0.1, {"run": np.ones(4)})
    with pytest.raises(ValueError, match="different windows of one run"):
        a - short


def test_powers():
    """d(x^p) = p x^{p-1} dx and d(b^x) = b^x ln b dx, of small errors."""
    x = Estimate(1.5, 1e-6)
    assert (x**3).error == pytest.approx(3 * 1.5**2 * 1e-6, rel=1e-5)
    assert (2**x).value == pytest.approx(2**1.5)
    assert (2**x).error == pytest.approx(2**1.5 * np.log(2.0) * 1e-6, rel=1e-5)


def test_distance():
    """In standard errors, from a number or from another estimate."""
    assert Estimate(1.3, 0.1).distance(1.0) == pytest.approx(3.0, rel=1e-9)
    assert Estimate(1.0, 0.3).distance(Estimate(2.0, 0.4)) == pytest.approx(-2.0, rel=1e-9)


def test_intervals_hold_the_truth():
    """Of 4000 runs of 8 realizations 95% of the intervals hold the true ratio; two standard
    errors hold 91%. The noise of the count is 0.35%, the ratio's curvature 0.2%.
    """
    rng = np.random.default_rng(2)
    x, y = 3.0 + 0.15 * rng.normal(size=(2, REALIZATIONS, 4000))
    value, error, left_out = jackknife(
        {"x": x, "y": y}, lambda m: {"ratio": m["x"] / m["y"]}, axis=0
    )
    ratio = Estimate(value["ratio"], error["ratio"], {"run": left_out["ratio"]})
    np.testing.assert_array_equal(ratio.degrees_of_freedom, REALIZATIONS - 1)
    low, high = ratio.interval(0.95)
    assert np.mean((low < 1.0) & (high > 1.0)) == pytest.approx(0.95, abs=0.012)
    assert np.mean(np.abs(ratio.value - 1.0) < 2 * ratio.error) < 0.93
    with pytest.raises(ValueError, match="level = 1 is outside"):
        ratio.interval(1.0)


def test_degrees_of_freedom_of_several_runs():
    """Welch and Satterthwaite: two equal errors of 7 have 14 together; one that is given is known,
    and its interval is the normal one. They follow an element and arithmetic.
    """
    (a,), (b,) = (measured(f"run {k}", [x_of], seed=k) for k in (1, 2))
    scaled = b * (a.error / b.error)
    assert (a - b).degrees_of_freedom < (a - scaled).degrees_of_freedom + 1e-9
    assert (a - scaled).degrees_of_freedom == pytest.approx(14.0, rel=1e-9)
    assert (a - a).degrees_of_freedom == 7.0 == (2.0 * a).degrees_of_freedom
    (sweep,) = measured("run", [x_of], shape=(3,))
    assert sweep[1].degrees_of_freedom == 7.0
    known = Estimate(1.0, 0.1)
    assert known.degrees_of_freedom == np.inf
    assert known.interval(0.95) == pytest.approx((1 - 0.19600, 1 + 0.19600), abs=1e-5)


def test_taken_apart_and_shown():
    value, error = Estimate(0.33251, 0.00042)
    assert (value, error) == (0.33251, 0.00042)
    assert float(Estimate(0.5, 0.1)) == 0.5
    assert f"{Estimate(0.33251, 0.00042):.3f}" == "0.333 ± 0.000"
    assert f"{Estimate(0.33251, 0.00042)}" == "0.33251(42)"
    assert repr(Estimate(0.33251, 0.00042)) == "Estimate(0.33251(42))"
    assert str(Estimate(np.array([1.0, 2.0]), np.array([0.1, 0.2]))) == "1.00(10)\n2.00(20)"


def test_error_that_is_none():
    """A value whose error is not known says so; a negative one is refused."""
    assert str(Estimate(1.0, np.nan)) == "1(nan)"
    assert str(Estimate(np.nan, np.nan)) == "nan"
    with pytest.raises(ValueError, match=r"error = -0.1 is outside the allowed range \[0, inf\)"):
        Estimate(1.0, -0.1)


def test_mean_and_sum_of_a_sweep():
    """Elements are independent: errors add in squares; of one gas they are one error."""
    swept = Estimate(np.array([1.0, 2.0]), np.array([0.3, 0.4]))
    for found in (np.sum(swept), swept.sum(axis=0)):
        assert (found.value, found.error) == (pytest.approx(3.0), pytest.approx(0.5))
    assert np.mean(swept).error == pytest.approx(0.25)
    profile = Estimate(np.array([1.0, 2.0]), np.array([0.3, 0.4]), points=np.zeros(2, int))
    assert np.sum(profile).error == pytest.approx(0.7)
    rows = Estimate(np.ones((2, 3)), np.full((2, 3), 0.1))
    assert rows.sum(axis=1).value == pytest.approx([3.0, 3.0])
    assert rows.mean(axis=0).error == pytest.approx(np.full(3, 0.1 / np.sqrt(2)))


def test_a_sweep_beside_one_of_its_points():
    """Nothing is left of a point less itself; the others are independent of it."""
    (sweep,) = measured("run", [x_of], shape=(2, 3))
    value, error = sweep - sweep[0, 1]
    assert value[0, 1] == 0.0 == error[0, 1]
    others = np.arange(6).reshape(2, 3) != 1
    apart = np.hypot(sweep.error, sweep.error[0, 1])
    np.testing.assert_allclose(error[others], apart[others], rtol=1e-12)
    for one, same in ((sweep[0][1], sweep[0, 1]), (sweep[:, 1][0], sweep[0, 1])):
        assert (one - same).error == 0.0
    assert (sweep[0] - sweep[0, :]).error == pytest.approx(np.zeros(3), abs=1e-15)


def test_a_number_that_all_elements_share():
    """(x1 + c) + (x2 + c): the error of c counts twice, whole; of x and c in either order."""
    (sweep,), (other,) = measured("run", [x_of], shape=(2,)), measured("other", [x_of], seed=5)
    expected = np.sqrt(np.sum(sweep.error**2) + 4.0 * other.error**2)
    for found in (sweep + other, other + sweep):
        assert found.sum().error == pytest.approx(expected, rel=1e-12)
        assert (found[0] - found[1]).error == pytest.approx(np.hypot(*sweep.error), rel=1e-12)


def test_a_function_that_mixes_points():
    """Their errors add in squares, exactly for a sum."""
    (sweep,) = measured("run", [x_of], shape=(4,))
    total = combine(np.sum, sweep)
    assert total.error == pytest.approx(np.sqrt(np.sum(sweep.error**2)), rel=1e-12)
    assert total.error == pytest.approx(sweep.sum().error, rel=1e-12)


def test_numbers_of_two_processes_are_independent():
    """What is pickled in one process is not taken for another's of the same count."""
    script = "import pickle, sys, jdsmc; pickle.dump(jdsmc.Estimate(1.0, 0.1), sys.stdout.buffer)"
    command = [sys.executable, "-c", script]
    made = [pickle.loads(subprocess.check_output(command)) for _ in range(2)]
    assert (made[0] - made[1]).error == pytest.approx(np.sqrt(2.0) * 0.1, rel=1e-12)
