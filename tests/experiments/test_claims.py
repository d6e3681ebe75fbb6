"""Numbers, fits and verdicts: exact where they can be."""

import numpy as np
import pytest

from experiments import claims, markdown
from experiments.numbers import Even, Fit, Span, mean, over_parts, stack, total, within
from jdsmc import Estimate


def test_a_fit_finds_the_limit():
    """An exact polynomial in ε², to rounding; the error is that of weighted least squares."""
    x, error = np.array([0.01, 0.02, 0.05, 0.1]), np.array([4.0, 2.0, 1.0, 0.5]) * 1e-3
    value = 1.2 + 7 * x**2 - 300 * x**4
    numbers = [Estimate(v, e) for v, e in zip(value, error, strict=True)]
    found = Even(x, numbers, (1, 2))
    np.testing.assert_allclose([float(t) for t in found.terms], [1.2, 7.0, -300.0], rtol=1e-9)
    assert float(found.excess(0.05)) == pytest.approx((value[2] - 1.2) / 1.2)
    constant = Fit(np.ones((4, 1)), numbers)
    assert float(constant.terms[0].error) == pytest.approx(np.sum(error**-2.0) ** -0.5)
    assert np.isnan(Even(x[:3], numbers[:3], (1, 2)).misfit)
    unsettled = Even([*x, 9.0], [*numbers, Estimate(np.nan, np.nan)], (1, 2))
    assert float(unsettled.limit.value) == pytest.approx(float(found.limit.value), rel=1e-12)


def test_terms_of_a_fit_are_correlated():
    """v + c x² at a measured point, of as many numbers as terms, has that point's error."""
    numbers = [Estimate(1.0, 0.1), Estimate(2.0, 0.3)]
    found = Even([1.0, 2.0], numbers, (1,))
    for x, one in zip((1.0, 2.0), numbers, strict=True):
        assert float(found.value(x).value) == pytest.approx(one.value)
        assert float(found.value(x).error) == pytest.approx(one.error)


def test_means_and_totals():
    parts = [Estimate(1.0, 0.3), Estimate(3.0, 0.4)]
    assert tuple(map(float, mean(parts))) == pytest.approx((2.0, 0.25))
    assert tuple(map(float, total(stack(parts)))) == pytest.approx((4.0, 0.5))


def test_over_parts_is_the_jackknife():
    """For a mean, the standard error; for a ratio, the linear propagation to second order.

    The parts scatter by 1%, so that what is left out is of relative order 1%.
    """
    values = 5.0 + 0.05 * np.random.default_rng(2).normal(size=(16, 2))
    found = over_parts(values)
    np.testing.assert_allclose(found.error, values.std(axis=0, ddof=1) / 4)
    ratio = over_parts(values, lambda m: m[0] / m[1])
    linear = (values[:, 0] - values[:, 1]) / 5.0
    assert float(ratio.error) == pytest.approx(linear.std(ddof=1) / 4, rel=0.05)


@pytest.mark.parametrize(
    ("measured", "holds", "text"),
    [
        (Estimate(10.0, 0.1), True, "agrees"),
        (Estimate(10.4, 0.1), True, "agrees"),  # 0.4 off, of which 0.25 is rounding: 1.5 errors
        (Estimate(10.5, 0.1), False, "**differs by 2.5 σ**"),
        (10.2, True, "agrees"),
        (10.3, False, "**differs**"),
        (Span(12.0, 10.2, 13.0, ""), True, "agrees"),
        (Span(12.0, 10.3, 13.0, ""), False, "**differs**"),
    ],
)
def test_a_number_is_compared_beyond_its_rounding(measured, holds, text):
    verdict = claims.judge(claims.Claim("k", "what", "where", 10.0, 0.25), measured)
    assert (verdict.holds, verdict.text) == (holds, text)


def test_a_sentence_holds_or_not_or_is_open():
    texts = [
        claims.judge(claims.Claim("k", "what", "where"), claims.Finding("seen", holds)).text
        for holds in (True, np.bool_(False), None)
    ]
    assert texts == ["holds", "**does not hold**", "not resolved"]


def test_signs():
    """Two errors decide; all must hold, and one that does not is enough."""
    signs = [claims.positive(Estimate(v, 1.0)) for v in (3.0, -3.0, 1.0)]
    assert signs == [True, False, None]
    assert claims.every(signs) is False
    assert claims.every([True, None]) is None and claims.every([True, True]) is True


@pytest.mark.parametrize(("value", "says"), [(0.0, "yes"), (0.25, "no"), (0.2, "not resolved")])
def test_within(value, says):
    assert within(Estimate(value, 0.02), 0.2) == says


def test_claims_are_read_as_written(tmp_path):
    path = tmp_path / "claims.txt"
    path.write_text("# Numbers\na | |x| of y | 4, Fig. 1 | 0.5 | 5e-3\n# Sentences\nb | so | 5\n")
    number, sentence = claims.Claim("a", "|x| of y", "4, Fig. 1", 0.5, 0.005), ("b", "so", "5")
    assert claims.read(path) == {"Numbers": [number], "Sentences": [claims.Claim(*sentence)]}
    verdict = claims.judge(number, Estimate(0.52, 0.01))
    assert claims.table([verdict])[2] == (
        "| \\|x\\| of y | 4, Fig. 1 | 0.5 ± 0.005 | 0.520(10) | agrees |"
    )


def test_markdown_cells_keep_their_bars():
    assert markdown.grid(["a"], [["|x|"]])[-1] == "| \\|x\\| |"
    assert markdown.score(3.5) == "**3.5**" and markdown.score(-1.0) == "-1.0"
