"""Error bars and drift tests on numbers whose distribution is known."""

import numpy as np
import pytest
from scipy import stats as reference

from jdsmc.stats import drift_significance, jackknife, variogram_ratio


def test_error_of_a_mean():
    """The jackknife of a mean is std/√R exactly: to rounding."""
    x = np.random.default_rng(1).normal(size=(3, 8, 5))
    value, error, left_out = jackknife({"x": x}, lambda m: {"x": m["x"]}, axis=1)
    np.testing.assert_allclose(value["x"], x.mean(axis=1), rtol=1e-12)
    np.testing.assert_allclose(error["x"], x.std(axis=1, ddof=1) / np.sqrt(8), rtol=1e-12)
    without_third = np.delete(x, 2, axis=1).mean(axis=1)
    np.testing.assert_allclose(left_out["x"][2], without_third, rtol=1e-12)


def test_error_of_a_ratio():
    """Against the delta method: they differ by the next order, the 5 % spread squared: 1 %."""
    rng = np.random.default_rng(2)
    common = rng.normal(size=8)
    x, y = 3 + 0.15 * (common + 0.3 * rng.normal(size=8)), 2 + 0.1 * common
    value, error, _ = jackknife({"x": x, "y": y}, lambda m: {"r": m["x"] / m["y"]}, axis=0)
    ratio = x.mean() / y.mean()
    delta = np.std((x - ratio * y) / y.mean(), ddof=1) / np.sqrt(8)
    apart = np.hypot(x.std() / x.mean(), y.std() / y.mean()) / np.sqrt(8) * ratio
    assert value["r"] == pytest.approx(ratio, rel=1e-12)
    assert error["r"] == pytest.approx(delta, rel=0.01)
    assert delta < 0.5 * apart  # the correlation matters here: errors taken apart would be wrong


def test_one_call_or_one_a_realization():
    """The same to the bit, of numbers and profiles, one of which does not depend on the run."""
    rng = np.random.default_rng(8)
    means = {"x": rng.normal(size=8), "y": rng.normal(size=8), "z": rng.normal(size=(8, 3))}

    def ratios(m):
        return {"r": m["x"] / m["y"], "p": m["z"] * np.asarray(m["x"])[..., None], "c": 2.0}

    for a, b in zip(
        jackknife(means, ratios, axis=0),
        jackknife(means, ratios, axis=0, leading=True),
        strict=True,
    ):
        for name in ("r", "p", "c"):
            np.testing.assert_array_equal(a[name], b[name])


def test_coverage():
    """z-scores of the ratio of two known means follow Student's t with R - 1 degrees of freedom.

    Through both distribution functions they become standard normal; over n = 4000 experiments
    their mean is known to 1/√n and their variance to √(2/n) = 0.022. Bound: 4.5 of these, plus
    0.02 in the variance for the curvature of the ratio (relative spread 0.03).
    """
    n, count = 4000, 8
    rng = np.random.default_rng(3)
    x, y = (m + 0.03 * m * rng.normal(size=(n, count)) for m in (2.0, 5.0))
    value, error, _ = jackknife({"x": x, "y": y}, lambda m: {"r": m["x"] / m["y"]}, axis=1)
    z = (value["r"] - 0.4) / error["r"]
    normal = reference.norm.ppf(reference.t.cdf(z, count - 1))
    assert abs(normal.mean()) < 4.5 / np.sqrt(n)
    assert abs(normal.var() - 1) < 4.5 * np.sqrt(2 / n) + 0.02


def test_significance_without_drift_is_uniform():
    """Kolmogorov-Smirnov over 4000 experiments: a true hypothesis is rejected once in 10⁴."""
    rng = np.random.default_rng(4)
    offset = 10 * rng.normal(size=(4000, 8))  # of a realization: common to both blocks
    early, late = (offset + rng.normal(size=(4000, 8)) for _ in range(2))
    assert reference.kstest(drift_significance(early, late), "uniform").pvalue > 1e-4


def test_significance_is_the_paired_t_test():
    rng = np.random.default_rng(5)
    early, late = rng.normal(size=(2, 3, 8)), rng.normal(size=(2, 3, 8))
    theirs = reference.ttest_rel(early, late, axis=1).pvalue
    np.testing.assert_allclose(drift_significance(early, late, axis=1), theirs, rtol=1e-9)


def test_significance_of_a_drift():
    """A drift of 10 standard errors and R = 8: the noncentral t has median 10.5, p = 2e-5.

    It is below 3 (p = 0.02) with probability 1e-7: none of 1000 experiments.
    """
    rng = np.random.default_rng(6)
    early, late = rng.normal(size=(1000, 8)), rng.normal(size=(1000, 8))
    p = drift_significance(early, late + 10 * np.sqrt(2 / 8))
    assert np.median(p) < 1e-4
    assert np.max(p) < 0.02


def test_constants_do_not_drift():
    """A conserved quantity has no spread: not a division by zero, and no evidence of drift."""
    assert drift_significance(np.ones(8), np.ones(8)) == 1.0


def test_variogram_ratio():
    """1 for independent blocks, 11/2 for means of a random walk, however far all of them drift.

    256 realizations of 16 blocks: (12 x 256) squares over a lag of four, each counted four times,
    leave 4 %; the bound is 4 of these.
    """
    rng = np.random.default_rng(7)
    white, steps = rng.normal(size=(256, 16)), rng.normal(size=(256, 16, 50))
    assert variogram_ratio(white) == pytest.approx(1.0, rel=0.16)
    walk = np.cumsum(steps.reshape(256, -1), axis=1).reshape(steps.shape).mean(axis=2)
    assert variogram_ratio(walk) == pytest.approx(5.5, rel=0.16)
    drift = np.arange(16.0) ** 2
    assert variogram_ratio(white + drift) == pytest.approx(variogram_ratio(white), rel=1e-9)
    assert variogram_ratio(np.ones((8, 16))) == 0.0


def test_leaving_out_the_one_that_counts():
    """One realization 10³⁰ times the others: left out, the mean of these is left, not 0."""
    values = np.array([1e30, 1.0, 2.0, 3.0])
    _, _, left_out = jackknife({"x": values}, lambda m: {"x": m["x"]}, axis=0)
    assert left_out["x"][0] == 2.0
    np.testing.assert_allclose(left_out["x"][1:], 1e30 / 3, rtol=1e-15)
