"""Data frames and CSV files: one row a point, or a place, and nothing twice."""

import csv

import numpy as np
import pytest
import xarray as xr

from jdsmc.results.result import Result


def swept(name, unit, values):
    return (name, values, {"long_name": name, "units": unit})


@pytest.fixture
def result():
    """Two restitutions, three fields; a number, four shares, a profile of ten layers; a series."""
    coords = {
        "restitution": swept("restitution", "1", [0.5, 0.7]),
        "field": swept("field", "1", [0.1, 0.2, 0.3]),
    }
    dims, rng = ("restitution", "field"), np.random.default_rng(1)
    shapes = {"a2": (), "speed_ratio": ("speed_class",), "density": ("z",)}
    sizes = {"speed_class": 4, "z": 10}
    data = xr.Dataset(coords=coords | {"z": np.linspace(0.05, 0.95, 10)})
    for suffix in ("", "_error"):
        for name, own in shapes.items():
            shape = (2, 3, *(sizes[d] for d in own))
            data[name + suffix] = ((*dims, *own), rng.random(shape))
    data["box"] = (dims, rng.random((2, 3)))
    data.attrs["swept"] = " ".join(dims)
    series = xr.Dataset(coords=coords)
    series["temperature"] = ((*dims, "sample"), rng.random((2, 3, 5)))
    series = series.assign_coords(time=((*dims, "sample"), rng.random((2, 3, 5))))
    return Result(xr.DataTree.from_dict({"/": data, "/series": series}))


def test_steady_values(result):
    """A row a point of the sweep; errors beside values; few places are columns; no profile."""
    table, steady = result.to_dataframe(), result.steady
    assert len(table) == 6 and not table[["restitution", "field"]].duplicated().any()
    names = ["restitution", "field", "a2", "a2_error", "speed_ratio_1", "speed_ratio_1_error"]
    assert list(table)[:6] == names and "density" not in table and "z" not in table
    for _, row in table.iterrows():
        here = steady.sel(restitution=row["restitution"], field=row["field"])
        assert row["a2"] == here["a2"] and row["box"] == here["box"]
        assert row["speed_ratio_3_error"] == here["speed_ratio_error"].values[2]


@pytest.mark.parametrize(
    "along, place, name, length", [("z", "z", "density", 10), ("sample", "time", "temperature", 5)]
)
def test_along(result, along, place, name, length):
    """A row for every point and place; what does not change along it is left out."""
    table = result.to_dataframe(along)
    group = result.steady if along == "z" else result.series
    assert len(table) == 6 * length and "a2" not in table and "box" not in table
    dims = ("restitution", "field", along)
    np.testing.assert_array_equal(table[name], group[name].transpose(*dims).values.ravel())
    where = group[place].broadcast_like(group[name]).transpose(*dims)
    np.testing.assert_array_equal(table[place], where.values.ravel())


def test_one_point(result):
    """One row, and none of the numbers that are no longer swept."""
    table = result.at(restitution=0.5, field=0.2).to_dataframe()
    assert len(table) == 1 and "restitution" not in table


def test_unknown_dimension(result):
    with pytest.raises(KeyError, match=r"nothing lies along 'y'; there are .*sample"):
        result.to_dataframe("y")


def test_csv(result, tmp_path):
    """All digits come back."""
    path = result.to_csv(tmp_path / "x.csv", along="z")
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    table = result.to_dataframe("z")
    for name in table:
        assert [float(row[name]) for row in rows] == list(table[name])
    with pytest.raises(FileExistsError):
        result.to_csv(path)
