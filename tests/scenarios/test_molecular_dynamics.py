"""Molecular dynamics as a scene: exact numbers, Enskog's rate, the theory, files, bad input."""

import sys
from types import SimpleNamespace

import numpy as np
import pytest

import jdsmc
import jdsmc.events
from jdsmc import InelasticHardDisks, InelasticHardSpheres
from jdsmc.scenarios import CoolingDisks, MolecularDynamics
from jdsmc.scenarios.disk_modes import AbstractCoolingDisks
from jdsmc.theory import langevin

pytest.importorskip("numba")

SIGMAS = 4.5
DENSITY, NUMBER = 0.05, 400
"""N n σ² = 20."""


def simulate(alpha, seed, duration):
    scene = MolecularDynamics(InelasticHardDisks(alpha), density=DENSITY)
    options = {"n_particles": NUMBER, "n_realizations": 8, "progress": False}
    return jdsmc.run(scene, **options, duration=duration, seed=seed)


def contact_value(density):
    """Enskog factor of disks (Henderson): χ = (1 - 7φ/16)/(1 - φ)²."""
    packing = np.pi * density / 4
    return (1 - 7 * packing / 16) / (1 - packing) ** 2


@pytest.fixture(scope="module")
def elastic():
    return simulate(1.0, 1, 250.0)


@pytest.fixture(scope="module")
def cooling():
    return simulate(0.8, 2, 250.0)


def test_elastic_equipartition(elastic):
    """C(0) = 1 and η1 = C(0) η, as in any elastic gas; T~ = T0 to rounding."""
    value, error = elastic["mode_amplitude"]
    assert error < 0.05
    assert abs(value - 1) < SIGMAS * error
    steady = elastic.steady
    assert float(steady["noise_over_viscosity"]) == pytest.approx(value, rel=1e-9)
    assert float(steady["temperature"]) == pytest.approx(1.0, abs=1e-9)
    assert float(steady["cooling_rate"]) == 0.0


def test_collision_rate_of_enskog(elastic):
    """χ times the dilute rate: 1.064 at n σ² = 0.05.

    At fixed energy and momentum it is lower by a few 1/N; its error is about as large.
    """
    value, error = elastic["collision_rate_ratio"]
    assert error < 0.004
    assert abs(value - contact_value(DENSITY)) < SIGMAS * error + 1 / NUMBER


def test_cooling(cooling):
    """ζ = 2μ from the energy lost; a2 < 0; T~ below T0 as 1/χ², but for what flow adds."""
    mu = langevin.cooling_state(0.8).growth_rate
    value, error = cooling["cooling_rate"]
    assert error < 2e-3 * 2 * mu
    assert abs(value - 2 * mu) < SIGMAS * error + 2e-3 * 2 * mu
    heat, error = cooling["temperature"]
    # 1/χ² = 0.883; at n σ² = 0.01 the rest is 0.01 to 0.02 of it, and grows with the density
    assert contact_value(DENSITY) ** -2 - SIGMAS * error < heat < 1.0
    a2, error = cooling["a2"]
    assert abs(a2 - langevin.cooling_state(0.8).a2) < SIGMAS * error + 0.01


def test_noise_exceeds_the_viscosity(cooling):
    """C(0) and η1/η of the theory of dilute disks within 15%, an Enskog factor of 1.06 apart."""
    mode = langevin.transverse_mode(0.8, 20.0)
    for name, known in (
        ("mode_amplitude", mode.amplitude),
        ("noise_over_viscosity", mode.noise_over_viscosity),
    ):
        value, error = cooling[name]
        assert error < 0.15 * known
        assert abs(value - known) < SIGMAS * error + 0.15 * known
        assert value > 1


def test_autocorrelation_starts_flat(elastic):
    """dC/ds = 0 at s = 0: C(0.7 τ0) is above C(0) exp(-0.7/τ), by more than half of the drop."""
    here = elastic.steady
    lag, c = here["lag"].values, here["autocorrelation"].values
    fall = -np.expm1(-float(here["mode_decay_rate"]) * lag[1])
    assert lag[1] == pytest.approx(0.7, rel=1e-6)
    assert 1 - c[1] / c[0] < 0.5 * fall


def test_file(cooling, tmp_path):
    """Saved and loaded: names in the root and over `lag`, errors, remarks; drawn the same."""
    path = tmp_path / "disks.h5"
    cooling.save(path)
    loaded = jdsmc.load(path)
    for name in (
        *("mode_amplitude", "mode_decay_rate", "viscosity_ratio", "noise_viscosity_ratio"),
        *("noise_over_viscosity", "tail_noise_over_viscosity", "temperature", "a2"),
    ):
        assert tuple(loaded[name]) == tuple(cooling[name]) and np.isfinite(loaded[name].error)
    assert loaded.steady["autocorrelation"].dims == ("lag",)
    assert loaded.steady["autocorrelation_error"].dims == ("lag",)
    assert loaded.attrs["remarks"] == cooling.attrs["remarks"]
    assert "44% below the limit of stability 35.5" in cooling.table()
    assert loaded.table() == cooling.table()


def test_same_seed_same_gas():
    """Bit for bit, however many cores took part."""
    one, other = (simulate(0.9, 4, 5.0).series["temperature"].values for _ in range(2))
    assert np.array_equal(one, other)


# Input


@pytest.mark.parametrize("scene", [CoolingDisks, MolecularDynamics])
def test_bad_input(scene):
    gas = InelasticHardDisks(0.8)
    with pytest.raises(ValueError, match=r"density = 0\.6 is outside the allowed range \(0, 0\.5"):
        scene(gas, density=0.6)
    with pytest.raises(ValueError, match=r"restitution = 0\.3 .* \[0\.4, 1\]"):
        scene(InelasticHardDisks(0.3))
    # type annotations are checked in tests, which would refuse it first
    with pytest.raises(TypeError, match="needs InelasticHardDisks; got InelasticHardSpheres"):
        AbstractCoolingDisks.__check_init__(SimpleNamespace(gas=InelasticHardSpheres(0.8)))
    with pytest.raises(ValueError, match="growth_rate = -1 is outside"):
        scene(gas, growth_rate=-1.0)


@pytest.mark.parametrize("scene", [CoolingDisks, MolecularDynamics])
def test_unstable_system(scene):
    """The limit, and the number of disks that would do: it runs."""
    gas = InelasticHardDisks(0.7)
    match = r"beyond 24\.88\. Take at most 2488 particles"
    with pytest.raises(ValueError, match=match):
        jdsmc.run(scene(gas), n_particles=3000, duration=1.0, progress=False)
    stable = scene(gas).prepared()
    stable.check_stability(2488)
    with pytest.raises(ValueError, match="2489 at density"):
        stable.check_stability(2489)


def test_too_small_a_system():
    """Where no hydrodynamic mode is left the number of disks is named, not the theory's."""
    scene = MolecularDynamics(InelasticHardDisks(1.0), density=0.01)
    with pytest.raises(ValueError, match=r"n_particles = 400 .* too small .* Take 800 particles"):
        jdsmc.run(scene, n_particles=400, duration=1.0, progress=False)


def test_without_numba(monkeypatch):
    """A sentence that says what to install."""
    for name in ("compiled", "tree", "predict", "dynamics", "placing", "scaled"):
        monkeypatch.delitem(sys.modules, f"jdsmc.events.{name}", raising=False)
        monkeypatch.delattr(jdsmc.events, name, raising=False)
    monkeypatch.setitem(sys.modules, "numba", None)
    scene = MolecularDynamics(InelasticHardDisks(0.8), density=DENSITY)
    with pytest.raises(ImportError, match=r"needs numba.*pip install \"jdsmc\[md\]\""):
        jdsmc.run(scene, n_particles=NUMBER, duration=1.0, progress=False)


@pytest.mark.parametrize("copies", [0, -1])
def test_copies(copies):
    with pytest.raises(ValueError, match=rf"copies = {copies} is outside the allowed range \[1,"):
        CoolingDisks(InelasticHardDisks(0.8), copies=copies)


@pytest.mark.parametrize("wrong", [0.0, -1.0, float("nan"), float("inf"), "a"])
def test_real_per_cell(wrong):
    with pytest.raises((ValueError, TypeError), match="real_per_cell"):
        CoolingDisks(InelasticHardDisks(0.8), real_per_cell=wrong)


def test_few_in_a_cell_warns():
    """Recollisions: how many copies would do."""
    scene = CoolingDisks(InelasticHardDisks(0.8), density=0.1, copies=1, real_per_cell=0.4)
    with pytest.warns(UserWarning, match="fictive particles a cell"):
        jdsmc.run(scene, n_particles=200, duration=0.5, time_step=0.01, progress=False)


def test_power_of_the_mode_in_time(elastic):
    """|ξ|²/(N T0) of the series is averaged after squaring: 1 in an elastic gas, not 1/8."""
    power = elastic.series["mode_power"].values
    # 8 realizations of two modes, 30 decay times each: 5%
    assert np.mean(power) == pytest.approx(1.0, abs=0.25)


def test_wide_cells_warn():
    """Wider than 0.6 λ0: how many real disks of a cell would do."""
    options = jdsmc.scenarios.Options.checked(200, 0.07, "strang", "float32", 10)
    scene = CoolingDisks(InelasticHardDisks(1.0), density=0.1, real_per_cell=2.0)
    with pytest.warns(UserWarning, match=r"cells of 1\.3 λ0 .* real_per_cell = 0\.11"):
        scene.fit_options(options)
