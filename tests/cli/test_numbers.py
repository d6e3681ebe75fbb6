"""Texts as numbers."""

import numpy as np
import pytest

from jdsmc.cli.numbers import numbers, whole
from jdsmc.cli.spelling import spelled, symbols


@pytest.mark.parametrize(
    "text, values",
    [
        ("0.9", 0.9),
        ("1e-1", 0.1),
        ("0.5,0.7", [0.5, 0.7]),
        ("0.5:0.95:0.05", [0.5, 0.55, 0.6, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9, 0.95]),
        ("0.5:0.97:0.1", [0.5, 0.6, 0.7, 0.8, 0.9]),  # never past the last
        ("0:0.3:0.1", [0.0, 0.1, 0.2, 0.3]),  # reached in spite of rounding
        ("0.9:0.8:-0.05", [0.9, 0.85, 0.8]),
        ("0.7:0.7:0.1", [0.7]),
        ("0.1,0.5:0.6:0.1,0.9", [0.1, 0.5, 0.6, 0.9]),
    ],
)
def test_numbers(text, values):
    """Exactly the numbers that a person would write: the table and the file show them."""
    found = numbers("x", text)
    assert np.shape(found) == np.shape(values)
    np.testing.assert_array_equal(found, values)


@pytest.mark.parametrize(
    "text",
    [
        *("", ",", "0.5,", "half", "0.5;0.6", "1:2", "1:2:3:4", "1:2:0", "1:2:-1", "2:1:1"),
        *("0:inf:1", "0:1:nan", "nan:1:1", "0:1:1e-9"),
    ],
)
def test_what_is_no_range(text):
    with pytest.raises(ValueError, match=r"x = .* is not a number, a range first:last:step"):
        numbers("x", text)


def test_a_range_in_the_wrong_direction():
    """Both ways out are spelled, and both work."""
    with pytest.raises(ValueError, match=r"write 0.9:0.5:-0.1 or 0.5:0.9:0.1\."):
        numbers("restitution", "0.9:0.5:0.1")
    down, up = (numbers("restitution", text) for text in ("0.9:0.5:-0.1", "0.5:0.9:0.1"))
    np.testing.assert_array_equal(down, up[::-1])


def test_names_in_place_of_numbers():
    assert numbers("rate_factor", "linear", ("linear", "viscosity")) == "linear"
    with pytest.raises(ValueError, match=r"rate_factor = 'cubic' .* or one of linear, viscosity"):
        numbers("rate_factor", "cubic", ("linear", "viscosity"))


@pytest.mark.parametrize(
    "text, value", [("64", 64), ("1e4", 10_000), ("2.0", 2), ("18446744073709551615", 2**64 - 1)]
)
def test_whole(text, value):
    assert whole("particles", text) == value


@pytest.mark.parametrize("text", ["1000.5", "inf", "nan", "many", ""])
def test_what_is_not_whole(text):
    with pytest.raises(ValueError, match=r"particles = .* is not a"):
        whole("particles", text)


def test_spelling():
    """Greek letters by name, so that nothing is lost on a terminal without them."""
    assert spelled("κ'/κ0 in v0²/τ0, ⟨C⁴⟩ λ") == "kappa'/kappa0 in v02/tau0, ?C4? lambda"
    assert symbols("coefficient of normal restitution α; in (0, 1]") == ["alpha"]
    assert symbols("strength ξ² of the noise") == ["xi"]
    assert symbols("shear rate a") == ["a"]
    assert symbols("number of a pair") == []
