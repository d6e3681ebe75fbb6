"""What a run returns: estimates, datasets, files and pictures of them."""

import h5py
import matplotlib.pyplot as plt
import numpy as np
import pytest
import xarray as xr

import jdsmc
from jdsmc.files.writable import check_writable
from jdsmc.results.join import join_gases
from jdsmc.results.result import Result
from jdsmc.scenarios import UniformShear


def simulate(restitution=0.7, gas=jdsmc.InelasticHardSpheres, shear_rate=4.0, **options):
    """A small run that is steady after a second; groups of four gases, compiled once."""
    steps = {"time_step": 0.1, "steps_per_record": 8}
    options = {"n_particles": 512, "n_realizations": 8, "rtol": 0.1} | steps | options
    return jdsmc.run(UniformShear(gas(restitution), shear_rate), progress=False, **options)


@pytest.fixture(scope="module")
def steady():
    return simulate()


@pytest.fixture(scope="module")
def sweep():
    return simulate([0.6, 0.8])


@pytest.fixture(scope="module")
def transient():
    return simulate(collisions=2.0)


def test_estimates(steady, sweep):
    """A float for one gas, an array for a sweep; every observable that `run` can aim at."""
    value, error = steady["shear_stress"]
    assert isinstance(value, float) and isinstance(error, float)
    assert steady["shear_stress"].error == error
    assert 0 < error < 0.1 * value
    assert steady.is_steady
    for name in (one.name for one in UniformShear.reports):
        size = (4,) if name == "speed_ratio" else ()
        assert np.shape(steady[name].value) == np.shape(steady[name].error) == size
        assert np.shape(sweep[name].value) == np.shape(sweep[name].error) == (2, *size)
        assert np.all(np.asarray(steady[name].error) >= 0)
    assert len(str(sweep["a2"]).splitlines()) == 2


def test_unknown_observable(steady):
    with pytest.raises(KeyError, match=r"no observable 'a17'; there are .*shear_stress"):
        steady["a17"]
    with pytest.raises(KeyError, match="no observable 'restitution'"):
        steady["restitution"]


def test_a_result_is_a_mapping(steady, transient):
    """Names of what has a steady value: in it, listed, counted; parameters are not among them."""
    names = list(steady)
    assert set(names) == {one.name for one in UniformShear.reports} and len(steady) == len(names)
    assert "temperature" in steady and all(name in steady for name in names)
    for other in ("a17", "restitution", "temperature_error", "steady_from_time", 3):
        assert other not in steady
    assert dict(zip(names, (steady[n] for n in names), strict=True)).keys() == set(names)
    assert list(transient) == [] and len(transient) == 0 and "temperature" not in transient


def test_errors_propagate(steady, sweep):
    """Within one run through its realizations; -P_xy/nT = η* a* holds in every average.

    Its error is zero but where an error of blocks is printed, to which values left out are spread,
    for each observable by itself: some tens of percent of the error at most.
    """
    stress, viscosity = steady["shear_stress"], steady["reduced_viscosity"]
    rate = steady["reduced_shear_rate"]
    value, error = stress - viscosity * rate
    assert abs(value) < 1e-12 and error < 0.5 * stress.error
    assert (stress - stress).error == 0.0
    points = sweep["temperature"]
    difference = points[1] - points[0]
    assert difference.error == pytest.approx(np.hypot(*points.error), rel=1e-12)
    one, other = sweep.at(restitution=0.6), sweep.at(restitution=0.8)
    assert (other["temperature"] - one["temperature"]).error == pytest.approx(difference.error)
    assert (one["shear_stress"] - one["shear_stress"]).error == 0.0
    again = simulate(seed=1)["temperature"]
    apart = (again - steady["temperature"]).error
    assert apart == pytest.approx(np.hypot(again.error, steady["temperature"].error), rel=1e-12)


def test_one_point_of_a_sweep(sweep):
    """The numbers of that point; what was not swept or not run is refused."""
    one = sweep.at(restitution=0.8)
    assert one.dims == () and sweep.dims == ("restitution",)
    assert one.attrs["parameter_restitution"] == 0.8
    for name in sweep:
        np.testing.assert_array_equal(one[name].value, sweep[name].value[1])
        np.testing.assert_array_equal(one[name].error, sweep[name].error[1])
    assert one.series["temperature"].dims == ("sample",)
    for odd in ("x", None, slice(None), [0.6, 0.8], True):
        with pytest.raises(KeyError, match=r"is not one of the values run, 0\.6, 0\.8"):
            sweep.at(restitution=odd)
    with pytest.raises(KeyError, match=r"restitution = 0\.7 was not run; there are 0\.6, 0\.8"):
        sweep.at(restitution=0.7)
    with pytest.raises(KeyError, match="shear_rate was not swept; swept: restitution"):
        sweep.at(shear_rate=4.0)


def test_parts_are_parts_of_one_run():
    """However a point is picked, nothing is left of its difference with itself; and what two of its
    observables have in common is known.
    """
    whole = simulate([0.6, 0.8], shear_rate=[3.0, 4.0])
    x, y = whole["pressure_xx"], whole["pressure_yy"]
    there = {"restitution": 0.6, "shear_rate": 4.0}
    parts = [whole.at(**there), whole.at(shear_rate=4.0).at(restitution=0.6)]
    together = (x - y)[0, 1]
    for part in parts:
        assert (part["pressure_xx"] - x[0, 1]).error == 0.0 == (part["pressure_xx"] - x[0][1]).error
        found = part["pressure_xx"] - y[0, 1]
        assert (found.value, found.error) == pytest.approx((together.value, together.error))
    row = whole.at(restitution=0.6)["pressure_xx"]
    assert np.all((row - x[0]).error == 0.0) and (row[1] - parts[0]["pressure_xx"]).error == 0.0
    assert (row[0] - row[1]).error == pytest.approx(np.hypot(*row.error))  # two gases


def test_the_nearest_of_near_points():
    close = simulate([0.7, 0.7 * (1 + 3e-7), 0.9], collisions=2.0)
    for k, value in enumerate(close.steady["restitution"].values):
        found = close.at(restitution=value).series["temperature"]
        assert np.array_equal(found, close.series["temperature"][k])
    with pytest.raises(KeyError, match="was not run"):
        close.at(restitution=0.7001)


def test_no_steady_values(transient):
    assert not transient.is_steady
    with pytest.raises(KeyError, match=r"no steady values: the asked time .*result\.series"):
        transient["shear_stress"]
    with pytest.raises(KeyError, match="no velocity distributions"):
        _ = transient.distribution
    assert "No steady values" in transient.table()
    assert "No steady values" in repr(transient)


def test_tree(sweep):
    """Steady values over the swept dimensions at the root; series and distributions in groups."""
    tree = sweep.to_xarray()
    assert isinstance(tree, xr.DataTree)
    assert tree["shear_stress"].dims == ("restitution",)
    np.testing.assert_array_equal(tree["restitution"], [0.6, 0.8])
    assert sweep.series["shear_stress"].dims == ("restitution", "sample")
    assert sweep.series["time"].dims == ("restitution", "sample")
    assert sweep.distribution["speed"].dims == ("restitution", "speed_bin")
    for data in (tree.to_dataset(), sweep.series, sweep.distribution):
        for name in data.data_vars:
            if str(name).startswith(("steady_from", "degrees_of")) or str(name).endswith("_error"):
                continue
            assert data[f"{name}_error"].dims == data[name].dims
            assert data[name].attrs["units"] and data[name].attrs["long_name"]
            assert data[f"{name}_error"].attrs["long_name"].startswith("standard error of")


def test_distributions_are_normalized(steady):
    """They integrate to one but for rounding: no particle is beyond 10 thermal speeds."""
    data = steady.distribution
    assert float(data["speed"].sum()) * 0.1 == pytest.approx(1, abs=1e-6)
    for name in ("marginal_x", "marginal_y"):
        # Both halves of the velocities are counted, each a marginal of a half of the particles.
        assert float(data[name].sum()) * 0.1 == pytest.approx(0.5, abs=1e-6)


def test_attributes(steady):
    """All that is needed to repeat the run."""
    expected = {
        "scene": "UniformShear",
        "gas_model": "InelasticHardSpheres",
        "parameter_restitution": 0.7,
        "parameter_shear_rate": 4.0,
        "n_particles": 512,
        "n_realizations": 8,
        "seed": 0,
        "time_step": 0.1,
        "splitting": "strang",
        "dtype": "float32",
        "rtol": 0.1,
    }
    assert steady.attrs.items() >= expected.items()
    names = ("jdsmc", "jax", "numpy", "python")
    assert all(steady.attrs[f"{name}_version"] for name in names)
    assert steady.attrs["commit"] == "unknown" or len(steady.attrs["commit"]) >= 40


@pytest.mark.parametrize("which", ["steady", "sweep", "transient"])
def test_file(which, request, tmp_path):
    """What is loaded is what was saved, bit for bit, attributes included."""
    result = request.getfixturevalue(which)
    path = result.save(tmp_path / "shear.h5")
    loaded = jdsmc.load(str(path))
    xr.testing.assert_identical(
        loaded.to_xarray().to_dataset().drop_attrs(), result.to_xarray().to_dataset().drop_attrs()
    )
    xr.testing.assert_identical(loaded.series, result.series)
    assert loaded.attrs.keys() == result.attrs.keys()
    for name, value in result.attrs.items():
        np.testing.assert_array_equal(loaded.attrs[name], value)
    assert loaded.table() == result.table()


def test_file_is_plain_netcdf(sweep, tmp_path):
    """The line of the manual, and h5py for those without xarray."""
    path = sweep.save(tmp_path / "sweep.h5")
    with xr.open_dataset(path, engine="h5netcdf") as data:
        np.testing.assert_array_equal(data["shear_stress"], sweep["shear_stress"].value)
        np.testing.assert_array_equal(data["shear_stress_error"], sweep["shear_stress"].error)
        np.testing.assert_array_equal(data.attrs["parameter_restitution"], [0.6, 0.8])
    with xr.open_dataset(path, engine="h5netcdf", group="series") as series:
        assert series["temperature"].dims == ("restitution", "sample")
    with h5py.File(path) as file:
        assert file["shear_stress"].shape == (2,) and file.attrs["seed"] == 0


def test_files_are_not_replaced(steady, tmp_path):
    path = tmp_path / "shear.h5"
    path.write_text("precious")
    with pytest.raises(FileExistsError, match=r"shear\.h5 exists"):
        steady.save(path)
    assert path.read_text() == "precious"
    steady.save(path, overwrite=True)
    assert tuple(jdsmc.load(path)["a2"]) == tuple(steady["a2"])


def test_missing_folder(steady, tmp_path):
    with pytest.raises(FileNotFoundError, match=r"folder .*nowhere"):
        steady.save(tmp_path / "nowhere" / "shear.h5")


def test_unwritable_file(steady, tmp_path, monkeypatch):
    """As for a user who may not write there (root, who may, runs the tests in containers)."""

    def refuse(*_, **__):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("pathlib.Path.open", refuse)
    with pytest.raises(PermissionError, match=r"cannot write .*shear\.h5: Permission denied"):
        steady.save(tmp_path / "shear.h5")
    assert not list(tmp_path.iterdir())


def test_looking_whether_a_file_is_writable_leaves_nothing(tmp_path):
    check_writable(tmp_path / "shear.h5")
    assert not list(tmp_path.iterdir())
    (tmp_path / "old.h5").write_text("old")
    check_writable(tmp_path / "old.h5", overwrite=True)
    assert (tmp_path / "old.h5").read_text() == "old"


def test_files_that_are_not_ours(tmp_path):
    with pytest.raises(FileNotFoundError, match=r"no file .*missing\.h5"):
        jdsmc.load(tmp_path / "missing.h5")
    text, other = tmp_path / "text.h5", tmp_path / "other.h5"
    text.write_text("not HDF5")
    xr.Dataset({"x": 1.0}).to_netcdf(other, engine="h5netcdf")
    for path in (text, other):
        with pytest.raises(ValueError, match=f"{path.name} (is|was) not"):
            jdsmc.load(path)


def test_plots(steady, sweep, transient, tmp_path):
    """Of one gas and of fixed times against time; of a sweep against restitution."""
    for result, label in (
        (steady, "collisions per particle s"),
        (transient, "collisions per particle s"),
        (sweep, "α"),
    ):
        path = tmp_path / "picture.png"
        figure = result.plot(path)
        assert label in [panel.get_xlabel() for panel in figure.axes]
        assert all(panel.lines or panel.collections for panel in figure.axes)
        assert path.read_bytes().startswith(b"\x89PNG")
        plt.close(figure)


def test_a_sweep_over_one_value_is_drawn(tmp_path):
    """As that point: also beside a number with several values, and without steady values."""
    for name, options in {
        "one": {"restitution": [0.7]},
        "both": {"restitution": [0.7], "shear_rate": [4.0]},
        "beside": {"restitution": [0.7], "shear_rate": [3.0, 4.0]},
        "short": {"restitution": [0.7], "collisions": 2.0},
    }.items():
        figure = simulate(**options).plot(tmp_path / f"{name}.png")
        assert (tmp_path / f"{name}.png").exists() and figure.axes


def test_table(steady, sweep):
    lines = steady.table().splitlines()
    row = next(line for line in lines if line.startswith("shear stress"))
    assert str(steady["shear_stress"]) in row
    assert lines[-1] == f"Ended because {steady.attrs['stopped']}."
    assert "restitution" in sweep.table().splitlines()[0]


def test_joined_gases(sweep, tmp_path):
    """Series of different lengths are padded; what ended each gas is kept; it can be drawn."""
    longer = simulate([0.6, 0.8], collisions=150.0, seed=1)
    joined = join_gases({"ihs": sweep, "ehs": longer})
    np.testing.assert_array_equal(joined["a2"].value[0], sweep["a2"].value)
    np.testing.assert_array_equal(joined["a2"].value[1], longer["a2"].value)
    assert joined.to_xarray()["a2"].dims == ("gas", "restitution")
    series = joined.series["temperature"]
    assert series.sizes["sample"] == longer.series.sizes["sample"] > sweep.series.sizes["sample"]
    assert np.all(np.isnan(series.sel(gas="ihs")[:, -1])) and np.all(series.sel(gas="ehs") > 0)
    assert joined.attrs["stopped_ihs"] == sweep.attrs["stopped"]
    assert joined.attrs["stopped_ehs"] == longer.attrs["stopped"]
    assert sweep.attrs["stopped"] in joined.table()
    plt.close(joined.plot(tmp_path / "joined.png"))
    assert jdsmc.load(joined.save(tmp_path / "joined.h5")).table() == joined.table()


def test_joined_with_a_gas_that_was_not_steady(steady, transient):
    """Its values are missing, not made up; without any, the table says why."""
    joined = join_gases({"ihs": steady, "ehs": transient})
    assert joined["a2"].value[0] == steady["a2"].value
    assert np.isnan(joined["a2"].value[1])
    neither = join_gases({"ihs": transient, "ehs": transient})
    assert not neither.is_steady
    assert "the asked time was simulated" in neither.table()
    plt.close(neither.plot())
    assert isinstance(neither, Result)
