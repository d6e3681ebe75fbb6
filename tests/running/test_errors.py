"""The printed error is the larger of two: from realizations, and from blocks of them."""

import numpy as np
import pytest

from jdsmc import FaultError, InelasticHardSpheres
from jdsmc.running.estimates import check_leading_axes, printed_estimates
from jdsmc.running.history import History
from tests.running.test_steady import MadeUp, Shown, Tally

REALIZATIONS, RECORDS = 8, 64


def history_of(temperature) -> History:
    """One point that was seen to have these temperatures (realizations, records)."""
    made = History([MadeUp(InelasticHardSpheres(1.0))], 1, 8)
    ones = np.ones((1, *temperature.shape))
    made.append(Shown(temperature[None], Tally(ones, 0.0 * ones, 0.0 * ones), ones), None)
    return made


def test_realizations_that_agree_by_chance_have_the_error_of_their_blocks():
    """Realizations of equal means whose four blocks scatter by one: error 1/√32 (of 31 blocks)."""
    rng = np.random.default_rng(0)
    blocks = rng.normal(size=(REALIZATIONS, 4))
    blocks -= blocks.mean(axis=1, keepdims=True)
    found = history_of(3.0 + np.repeat(blocks, RECORDS // 4, axis=1))
    value, error, _ = printed_estimates(found, 0, 0)
    assert value["temperature"] == pytest.approx(3.0)  # rounding
    expected = np.sqrt(np.sum(blocks**2) / 31 / 32)
    assert error["temperature"] == pytest.approx(expected, rel=1e-9)  # jackknife of a mean: exact


def test_the_error_of_estimates_is_the_printed_one():
    """Values with one realization left out scatter as much as is printed, whatever decided."""
    rng = np.random.default_rng(1)
    for _ in range(5):
        found = history_of(rng.normal(3.0, 1.0, (REALIZATIONS, RECORDS)))
        value, error, left_out = printed_estimates(found, 0, 0)
        scatter = np.sqrt((REALIZATIONS - 1) * np.var(left_out["temperature"]))
        assert scatter == pytest.approx(error["temperature"], rel=1e-9)  # rounding
        assert np.mean(left_out["temperature"]) == pytest.approx(value["temperature"])


def test_no_value_is_five_errors_off():
    """Of 600 means of independent records. Realizations alone let one be, by Student's t."""
    rng = np.random.default_rng(2)
    scores = []
    for _ in range(600):
        value, error, _ = printed_estimates(history_of(rng.normal(size=(8, 16))), 0, 0)
        scores.append(float(value["temperature"] / error["temperature"]))
    scores = np.abs(scores)
    assert np.max(scores) < 5.0
    # the larger of two is larger than one: 95.0% within two, 91.4% of realizations alone
    assert 0.93 < np.mean(scores < 2.0) < 0.97


class Centred(MadeUp):
    """Subtracts the mean over all of an axis, whatever that is."""

    def observables(self, means):
        return {"temperature": means["temperature"] - np.mean(means["temperature"])}


def test_observables_that_mix_realizations_are_refused():
    """Leave-one-out values are found in one call: what does not keep them apart is told."""
    means = {"temperature": np.arange(8.0)}
    check_leading_axes(MadeUp(InelasticHardSpheres(1.0)), means)
    with pytest.raises(FaultError, match="must take averages with leading axes"):
        check_leading_axes(Centred(InelasticHardSpheres(1.0)), means)
