"""Heat conduction under gravity: balances, equilibrium, and known solutions."""

import numpy as np
import pytest
import xarray as xr

from jdsmc import (
    AbstractGas,
    ElasticHardSpheres,
    FaultError,
    InelasticHardDisks,
    InelasticHardSpheres,
    MaxwellMolecules,
    load,
    run,
)
from jdsmc.cli import main
from jdsmc.results.gravity_effect import at_equal_gradient
from jdsmc.running.run import options_of
from jdsmc.scenarios import FourierFlow

from .batches import observed

SPHERES = InelasticHardSpheres(1.0)
SIZES = {"n_particles": 2000, "n_realizations": 8, "records": 1, "in_space": True}
SMALL = {"n_particles": 2000, "n_realizations": 8, "steps_per_record": 8, "progress": False}


@pytest.fixture(scope="module")
def conducting():
    scene = FourierFlow(SPHERES, 0.2, np.array([-0.05, 0.0, 0.05]), 4.0, layers=20)
    return run(scene, rtol=0.015, seed=3, **SMALL)


def _z_scores(value, error, expected):
    return (np.asarray(value) - expected) / np.asarray(error)


def test_no_particle_is_lost(conducting):
    density = conducting.series["density"].values
    np.testing.assert_allclose(density.mean(axis=-1), 1.0, rtol=1e-12)


def test_energy_balance_closes_at_the_walls(conducting):
    """Eq. (13): what the hot wall gives goes through the gas into the cold wall.

    Three estimates of one flux with independent errors of 1.5%: 4 standard errors.
    """
    flux = conducting["mean_heat_flux"]
    for name in ("heat_flux_cold_wall", "heat_flux_hot_wall"):
        other = conducting[name]
        error = np.hypot(flux.error, other.error)
        assert np.all(np.abs(flux.value - other.value) < 4 * error)
    assert np.all(flux.value < 0)  # from hot to cold


def test_heat_flux_is_uniform(conducting):
    """Eq. (13), layer by layer: a chi-square over layers and states.

    Neighbouring layers see some of the same particles at different times, so the effective number
    of degrees of freedom is smaller than that of layers; 2 per layer is four times its spread.
    """
    flux, mean = conducting["heat_flux"], conducting["mean_heat_flux"].value[:, None]
    assert np.mean(_z_scores(flux.value, flux.error, mean) ** 2) < 2.0


def test_momentum_balance_under_gravity(conducting):
    """Eq. (12) between the first and last layer: ΔP_zz = -g ∫n dz."""
    steady = conducting.to_xarray().to_dataset()
    width = 4.0 / 20
    for state in range(3):
        here = steady.isel(gravity=state)
        pressure, error = here["pressure_zz"].values, here["pressure_zz_error"].values
        density = here["density"].values
        weight = float(here["gravity"]) * width * (density.sum() - 0.5 * (density[0] + density[-1]))
        difference = pressure[-1] - pressure[0]
        assert abs(difference + weight) < 4 * np.hypot(error[0], error[-1])
    assert abs(pressure[-1] - pressure[0]) > 10 * np.hypot(error[0], error[-1])


def test_equal_walls_under_gravity_give_the_barometric_law():
    """n ∝ exp(-2 g z) with m v0² = 2 k T0, at uniform T = T0 and without heat flux."""
    gravity, length, layers = 0.2, 4.0, 16
    scene = FourierFlow(SPHERES, 1.0, gravity, length, layers=layers)
    value, error = observed(scene, 50, 8, time_step=0.05, seed=5, **SIZES)  # 160 τ0, the first 26
    edges = np.linspace(0, length, layers + 1)
    expected = -np.diff(np.exp(-2 * gravity * edges)) * layers
    expected /= 1 - np.exp(-2 * gravity * length)
    for name, law in (("density", expected), ("temperature", 1.0), ("heat_flux", 0.0)):
        scores = _z_scores(value[name], error[name], law)
        # 16 values from 8 realizations: Student's t with 7 degrees of freedom has a variance of 1.4
        assert np.mean(scores**2) < 3.0, name
        assert np.max(np.abs(scores)) < 7.0, name
    assert error["density"].max() < 0.02


def test_gravity_that_empties_the_hot_side():
    """The barometric law in what is filled; where no particle ever was, n = 0 and T is unknown.

    2000 exp(-16) particles are expected in the four highest layers together at one instant: 2e-4.
    """
    gravity, length, layers = 1.0, 10.0, 20
    scene = FourierFlow(SPHERES, 1.0, gravity, length, layers=layers)
    # 50 τ0, the first 32: the fall heats the gas, and the walls take 20 to cool it
    value, error = observed(scene, 100, 64, time_step=0.02, seed=5, **SIZES)
    edges = np.linspace(0, length, layers + 1)
    expected = -np.diff(np.exp(-2 * gravity * edges)) * layers
    filled = expected > 0.2  # at least 20 particles
    for name, law in (("density", expected[filled]), ("temperature", 1.0)):
        scores = _z_scores(value[name][filled], error[name][filled], law)
        # 5 values from 8 realizations, each with a variance of 1.4 (Student's t)
        assert np.mean(scores**2) < 4.0, name
    density, temperature = value["density"], value["temperature"]
    assert np.all(density[-4:] == 0)
    np.testing.assert_array_equal(np.isnan(temperature), density == 0)
    # no particle reaches the hot wall, and in equilibrium the cold one gives no heat
    assert value["heat_flux_hot_wall"] == 0
    assert abs(value["heat_flux_cold_wall"]) < 5 * error["heat_flux_cold_wall"]


def test_same_rule_as_the_paper_finds_the_point_of_equal_gradient(conducting):
    effect = at_equal_gradient(conducting)
    free = effect.sel(gravity=0.0)
    assert float(free["kappa_star_change"]) == 0.0
    assert float(free["mean_free_paths"]) == pytest.approx(2.0, abs=0.02)  # half of L = 4
    np.testing.assert_allclose(
        effect["reduced_gradient"], float(free["reduced_gradient"]), rtol=1e-6
    )
    with pytest.raises(ValueError, match="give another gradient"):
        at_equal_gradient(conducting, gradient=50.0)


def test_realizations_give_back_the_steady_means(conducting):
    each = conducting.to_xarray()["realizations"].to_dataset()
    flux = conducting["mean_heat_flux"]
    np.testing.assert_allclose(each["mean_heat_flux"].mean("realization"), flux.value, rtol=1e-12)
    error = each["mean_heat_flux"].std("realization", ddof=1) / np.sqrt(8)
    # printed is the larger one of realizations and blocks; larger by a few tens of percent at most
    assert np.all(flux.error >= error * (1 - 1e-9)) and np.all(flux.error < 2.5 * error)


def test_a_short_run_of_maxwell_molecules_has_a_series_only(tmp_path):
    scene = FourierFlow(MaxwellMolecules(), 0.5, wall="bgk", layers=10)
    result = run(scene, duration=2.0, **SMALL | {"n_particles": 500})
    result.save(tmp_path / "f.h5")
    assert "No steady values" in result.table()


def test_a_sweep_over_length_is_its_single_runs():
    """κ* and all else of a point stand on its own layers: bit by bit as far as both go."""
    options = SMALL | {"duration": 6.0, "seed": 3}
    lengths = np.array([4.0, 6.0])
    swept = run(FourierFlow(SPHERES, 0.5, length=lengths), **options).series
    for length in lengths:
        single = run(FourierFlow(SPHERES, 0.5, length=length), **options).series
        here = swept.sel(length=length)
        for name in ("kappa_star", "reduced_gradient", "mean_free_paths", "heat_flux"):
            assert np.sum(np.isfinite(single[name])) > 0.9 * single[name].size
            both = np.minimum(single[name].shape, here[name].shape)[0]
            np.testing.assert_array_equal(here[name].values[:both], single[name].values[:both])


class Restless(AbstractGas):
    """Elastic spheres that also collide when they hardly move: no power of the speed."""

    def rate(self, speed):
        return speed + 1.0

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


@pytest.mark.parametrize(
    ("error", "message", "gas"),
    [
        (ValueError, "needs an elastic gas", InelasticHardSpheres([1.0, 0.9])),
        (ValueError, "needs an elastic gas", ElasticHardSpheres([1.0, 0.9])),
        (ValueError, "needs a gas whose pair rate is a power of the relative speed", Restless()),
        (TypeError, "needs a gas of 3 velocity components", InelasticHardDisks(1.0)),
    ],
)
def test_gases_that_do_not_belong_are_refused(error, message, gas):
    with pytest.raises(error, match=f"FourierFlow {message}"):
        FourierFlow(gas, 0.5)


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"cold_temperature": 0.0}, r"cold_temperature = 0 is outside the allowed range \(0, 1\]"),
        ({"cold_temperature": -1.0}, "cold_temperature = -1 is outside"),
        ({"gravity": 2.0}, r"gravity = 2 is outside the allowed range \[-1, 1\]"),
        ({"length": 0.0}, r"length = 0 is outside the allowed range \(0, 1000\]"),
        ({"layers": 0}, r"layers = 0 is outside the allowed range \[1, inf\)"),
        ({"layers": -3}, r"layers = -3 is outside"),
        ({"gas": InelasticHardSpheres(0.9)}, "needs an elastic gas"),
        ({"gas": ElasticHardSpheres(0.9)}, "needs an elastic gas"),
    ],
)
def test_bad_input_is_refused(changed, message):
    good = {"gas": SPHERES, "cold_temperature": 0.05}
    with pytest.raises(ValueError, match=message):
        FourierFlow(**good | changed)


def test_layers_are_counted():
    """What is whole is an integer, as of every size; the rest is refused."""
    assert type(FourierFlow(SPHERES, 0.5, layers=20.0).layers) is int
    for layers in (20.5, True, "20"):
        with pytest.raises(TypeError, match=f"layers must be an integer, got {layers!r}"):
            FourierFlow(SPHERES, 0.5, layers=layers)


@pytest.mark.parametrize(("layers", "particles"), [(20, 5_000), (200, 10_000)])
def test_particles_by_default(layers, particles):
    """What `run` takes where nothing is said; nothing is compiled for it."""
    scene = FourierFlow(SPHERES, 0.5, length=4.0, layers=layers)
    assert options_of([scene], None, None, "strang", "float32", None).n_particles == particles


def test_a_step_that_crosses_the_slab_is_refused():
    scene = FourierFlow(SPHERES, 0.5, length=0.1, layers=1)
    with pytest.raises(ValueError, match="time_step"):
        run(scene, duration=1.0, time_step=0.5, **SMALL)


def test_sweep_on_the_command_line(tmp_path, capsys):
    out, picture = tmp_path / "f.h5", tmp_path / "f.png"
    command = "sweep fourier --cold-temperature 0.5 --gravity=-0.02,0 --length 4 --layers 10"
    sizes = "--particles 500 --realizations 8 --duration 240 --no-progress"
    files = ["--out", str(out), "--plot", str(picture)]
    assert main([*command.split(), *sizes.split(), *files]) == 0
    assert picture.stat().st_size > 10_000
    assert "κ* halfway" in capsys.readouterr().out
    data = xr.open_dataset(out, engine="h5netcdf")
    assert data["temperature"].dims == ("gravity", "z")
    assert data["pressure_zz"].attrs["units"] == "n̄ m v0²"
    assert load(out).attrs["option_wall"] == "maxwell"


def test_endless_bouncing_is_a_fault():
    scene = FourierFlow(SPHERES, 1e-6, 1.0, 2.0, layers=5)
    with pytest.raises(FaultError, match="reduce time_step, or gravity"):
        run(scene, duration=50.0, time_step=0.4, **SMALL | {"n_particles": 200})
