"""Runs made apart are one run: realizations by their seeds, points of a sweep by their values."""

import numpy as np
import pytest

import jdsmc
from jdsmc import InelasticHardSpheres, scenarios

SMALL = {"n_particles": 256, "progress": False}
ALPHA = [0.5, 0.6, 0.8]


def shear(restitution, seed=1, **options):
    scene = scenarios.UniformShear(InelasticHardSpheres(restitution), 4.0)
    return jdsmc.run(scene, seed=seed, **SMALL, **({"collisions": 100.0} | options))


@pytest.fixture(scope="module")
def sweep():
    return shear(ALPHA)


@pytest.fixture(scope="module")
def seeds(tmp_path_factory):
    """Two runs of other seeds and numbers of realizations, one of them from a file."""
    folder = tmp_path_factory.mktemp("merge")
    one, other = shear(0.6, seed=1), shear(0.6, seed=2, n_realizations=16)
    return one, jdsmc.load(other.save(folder / "other.h5"))


def test_pieces_of_a_sweep_are_the_sweep():
    """To the bit where they ran as long (a run of fixed collisions, until the slowest has them)."""

    def cooling(restitution):
        scene = scenarios.HomogeneousCooling(InelasticHardSpheres(restitution))
        return jdsmc.run(scene, collisions=63.0, seed=1, **SMALL)

    near = [0.8, 0.805, 0.81]  # they collide as often
    sweep, pieces = cooling(near), [cooling(near[1:]), cooling(near[0])]
    assert {one.attrs["n_records"] for one in pieces} == {sweep.attrs["n_records"]}
    joined = jdsmc.merge(pieces)
    whole, merged = sweep.to_xarray(), joined.to_xarray()
    assert set(whole.children) == set(merged.children)
    for name in ("/", *whole.children):
        assert merged[name].to_dataset().equals(whole[name].to_dataset()), name
    assert repr(joined.scene()) == repr(sweep.scene())
    assert joined.table() == sweep.table()
    for name in ("a2", "relative_speed_cubed"):
        assert tuple(joined.at(restitution=0.81)[name]) == tuple(sweep.at(restitution=0.81)[name])


def test_dimensions_are_in_the_order_of_the_scene():
    """As a sweep would have them, so that merged sweeps can be merged again."""
    runs = [
        jdsmc.run(
            scenarios.UniformShear(InelasticHardSpheres(ALPHA[:2]), rate),
            **{"collisions": 3.0, "seed": 1} | SMALL,
        )
        for rate in (4.0, 2.0)
    ]
    merged = jdsmc.merge(runs)
    assert merged.dims == ("restitution", "shear_rate")
    stress = merged.series["shear_stress"]
    assert stress.dims == ("restitution", "shear_rate", "sample")
    np.testing.assert_array_equal(merged.series["shear_rate"], [2.0, 4.0])
    ours = merged.series["shear_stress"].sel(shear_rate=4.0).values
    np.testing.assert_array_equal(ours, runs[0].series["shear_stress"][:, : ours.shape[1]].values)


def test_realizations_count_together():
    """Averages of 8 and 16 realizations, each counting the same; less noise.

    Long runs: what the balance is fitted to curves the mean by 0.2 errors after 100 collisions.
    """
    long = {"collisions": 240.0}
    seeds = shear(0.6, seed=1, **long), shear(0.6, seed=2, n_realizations=16, **long)
    merged = jdsmc.merge(seeds)
    assert merged.attrs["n_realizations"] == 24 and list(merged.attrs["seed"]) == [1, 2]
    for name in ("shear_stress", "temperature", "a2"):
        (a, ea), (b, eb), (value, error) = (r[name] for r in (*seeds, merged))
        # an observable is no average: the difference is of the order of its curvature, error²
        assert value == pytest.approx((8 * a + 16 * b) / 24, abs=0.1 * error)
        assert 0.5 * min(ea, eb) < error < max(ea, eb)
    assert merged.to_xarray()["averages"].sizes["realization"] == 24
    assert merged["a2"].degrees_of_freedom == 23


def test_merged_twice_is_merged_at_once(seeds):
    third = shear(0.6, seed=3)
    at_once = jdsmc.merge([*seeds, third])
    twice = jdsmc.merge([jdsmc.merge(seeds), third])
    for name in at_once:
        np.testing.assert_allclose(tuple(twice[name]), tuple(at_once[name]), rtol=1e-9)


def test_differences_know_that_runs_were_merged(seeds):
    """Leave-one-out values give the printed error: a difference with itself is exact."""
    merged = jdsmc.merge(seeds)
    stress = merged["shear_stress"]
    assert (stress - stress).error == 0
    assert (2.0 * stress).error == pytest.approx(2.0 * stress.error, rel=1e-9)


def test_without_averages_estimates_are_averaged(seeds):
    """Scenes of correlations in time (cooling disks) cut blocks of other lengths in each run."""
    runs = []
    for one in seeds:
        tree = one.to_xarray().copy()
        runs.append(jdsmc.Result(tree.drop_nodes(["averages", "blocks"])))
    merged = jdsmc.merge(runs)
    for name in ("shear_stress", "a2"):
        (a, ea), (b, eb), (value, error) = (r[name] for r in (*runs, merged))
        assert value == pytest.approx((8 * a + 16 * b) / 24, rel=1e-12)
        assert error == pytest.approx(np.hypot(8 * ea, 16 * eb) / 24, rel=1e-12)
        assert (1.0 * merged[name]).error == pytest.approx(error, rel=1e-9)
    assert merged["a2"].degrees_of_freedom == 7 + 15  # how the runs differ is not asked


def test_transients_are_averaged():
    """Without steady values the series alone, with an error that is smaller by the square root."""
    runs = [shear(0.6, seed=k, collisions=3.0) for k in (1, 2)]
    merged = jdsmc.merge(runs)
    assert not merged.is_steady
    with pytest.raises(KeyError, match=r"no steady values.*sample"):
        merged.to_dataframe()
    ours, its = merged.series, [one.series for one in runs]
    count = ours.sizes["sample"]
    mean = 0.5 * sum(one["temperature"].values[:count] for one in its)
    np.testing.assert_allclose(ours["temperature"].values, mean, rtol=1e-12)
    np.testing.assert_allclose(
        ours["temperature_error"].values[1:],
        0.5 * np.hypot(*(one["temperature_error"].values[1:count] for one in its)),
        rtol=1e-12,
    )


def test_what_does_not_belong_together(seeds, sweep):
    for results, words in (
        ([seeds[0]], "at least two"),
        ([seeds[0], seeds[0]], "seed = 1 was used twice"),
        ([sweep, shear(0.6, seed=1)], "restitution = 0.6 is there twice"),
        ([seeds[0], shear(0.6, seed=4, time_step=0.1)], "time_step"),
        ([seeds[0], sweep.at(restitution=0.5)], "part of a sweep"),
        ([seeds[0], shear(0.6, seed=4, collisions=2.0)], "others not"),
        ([seeds[0], shear(0.7, n_realizations=16)], "n_realizations"),
        ([seeds[0], shear(0.6, seed=4, sensitivity=True)], "have derivatives and others not"),
    ):
        with pytest.raises(ValueError, match=words):
            jdsmc.merge(results)
    cooling = jdsmc.run(
        scenarios.HomogeneousCooling(InelasticHardSpheres(0.6)), collisions=4.0, **SMALL
    )
    with pytest.raises(ValueError, match="different scenes: class"):
        jdsmc.merge([seeds[0], cooling])
