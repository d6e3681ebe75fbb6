"""Random gases in random scenes: finite or refused, conserving, the same again, as in a sweep.

Sizes are few, since each is another program; physical numbers are any.
"""

from dataclasses import dataclass, field

import jax
import numpy as np
import pytest
import xarray as xr
from hypothesis import assume, event, given
from hypothesis import strategies as st

import jdsmc
from jdsmc.gases.hard_spheres import loses_energy
from jdsmc.measure.heat import RESPONSES
from jdsmc.scenarios import (
    FourierFlow,
    HeatFluxForce,
    HomogeneousCooling,
    NavierStokes,
    ShearedSlab,
    UniformShear,
)
from jdsmc.scenarios.homogeneous import AbstractHomogeneous

from .effort import FULL, cases, refused
from .numbers import fields_of
from .test_bad_input import is_sentence

SPHERES, DISKS = jdsmc.InelasticHardSpheres, jdsmc.InelasticHardDisks
LONGEST = 40.0
"""τ0 of a gas that nothing drives: up to three chunks of 64 steps."""
EPSILON = float(np.finfo(np.float32).eps)


@dataclass(frozen=True)
class Kind:
    """A scene and a gas whose switches are fixed, so that one program serves all numbers."""

    scene: type
    gas: type
    of_scene: dict = field(default_factory=dict)
    of_gas: dict = field(default_factory=dict)
    options: dict = field(default_factory=dict)


KINDS = [
    Kind(UniformShear, SPHERES, {"initial_state": "equilibrium"}),
    Kind(HomogeneousCooling, SPHERES),
    Kind(ShearedSlab, SPHERES, {"layers": 5, "initial_state": "equilibrium"}),
    Kind(FourierFlow, SPHERES, {"layers": 5, "wall": "maxwell"}, {"restitution": 1.0}),
]
if FULL:
    frictional = {"drag": "local", "rate_factor": "linear"}
    KINDS += [
        Kind(UniformShear, SPHERES, {"initial_state": "steady"}),
        Kind(UniformShear, jdsmc.ElasticHardSpheres, KINDS[0].of_scene, frictional),
        Kind(UniformShear, jdsmc.MaxwellMolecules, KINDS[0].of_scene),
        Kind(
            *(UniformShear, SPHERES, KINDS[0].of_scene),
            options={"splitting": "lie", "time_step": 0.05},
        ),
        Kind(HomogeneousCooling, DISKS, options={"n_particles": 96}),
        Kind(HomogeneousCooling, jdsmc.MaxwellMolecules),
        Kind(HeatFluxForce, SPHERES, {"scheme": "exact"}),
        Kind(HeatFluxForce, SPHERES, {"scheme": "paper"}),
        Kind(NavierStokes, SPHERES, {"duration": 2.0}),
        Kind(ShearedSlab, jdsmc.ElasticHardSpheres, KINDS[2].of_scene, frictional),
        Kind(FourierFlow, jdsmc.MaxwellMolecules, KINDS[3].of_scene),
    ]


@st.composite
def asked(draw):
    """The arguments of a scene and gas of some kind, and what is asked of a run."""
    kind = draw(st.sampled_from(KINDS))
    of_gas = draw(fields_of(kind.gas, kind.of_gas))
    of_scene = draw(fields_of(kind.scene, kind.of_scene))
    fastest = 1.0 + of_scene.get("shear_rate", 0.0)
    limits = {"duration": draw(st.floats(0.01, LONGEST)) / fastest}
    options = {"n_particles": 64, "time_step": 0.2, "steps_per_record": 8} | kind.options
    return kind, of_scene, of_gas, options | limits | {"seed": draw(st.integers(0, 2**64 - 1))}


def run(kind, of_scene, of_gas, options):
    """What a run returns; None if it is refused with a sentence."""
    try:
        scene = kind.scene(gas=kind.gas(**of_gas), **of_scene)
        made = jdsmc.run(scene, progress=False, **options)
        event("made")
        return made
    except (ValueError, TypeError, jdsmc.FaultError) as error:
        refused(error)
        assert is_sentence(error), f"{type(error).__name__}: {error}"
        return None


SPARSE = 0.5
"""Of 13 particles in a layer: six in each realization on average."""
OVER_SHEAR = ("reduced_viscosity", "first_viscometric", "second_viscometric")
OVER_LOSS = ("relative_speed_cubed_collisional",)
OVER_FIELD = tuple(one.name for one in RESPONSES)


def check_finite(scene, result):
    """All but ratios over zero: no collisions yet, no shear or field, no energy lost in them;
    and profiles, where a layer is empty in some realization."""
    still = of(scene, "shear_rate", 1.0) == 0.0
    empty = scene.in_space and float(result.series["density"].min()) < SPARSE
    for name, values in result.series.data_vars.items():
        first = 1 if name.startswith("collision_ratio") else 0
        nothing = still and name.startswith(OVER_SHEAR)
        lost = np.any(scene.gas.energy_loss_rate(np.asarray(0.5)) > 0)
        nothing |= not lost and name.startswith(OVER_LOSS)
        nothing |= of(scene, "field", 1.0) == 0.0 and name.startswith(OVER_FIELD)
        nothing |= empty and scene.axis in values.dims
        assert np.all(np.isfinite(values[first:])) or nothing, name
        assert not (name.endswith("_error") and np.any(values < 0.0)), name


def check_conserved(kind, scene, result):
    """Particles; momentum of a homogeneous gas, energy where nothing drives it or cools it.

    In float32: sums of N numbers, rounded in every step, walk by about √steps roundings.
    """
    session = result.under_way.session
    states = jax.tree.map(np.asarray, session.engine.states)
    steps = session.options.steps * (session.history.length + 1)
    rounding = 20.0 * EPSILON * np.sqrt(steps)
    for state in states:
        velocity = np.stack([np.asarray(v, float) for v in state.velocity])
        assert np.all(np.isfinite(velocity))
        thermal = np.sqrt(np.mean(velocity**2))
        if isinstance(scene, AbstractHomogeneous) and not isinstance(scene, NavierStokes):
            mean = np.mean(velocity, axis=(-2, -1))
            assert np.all(np.abs(mean) <= rounding * thermal)
    undriven = isinstance(scene, HomogeneousCooling) or not np.any(
        of(scene, "shear_rate", 1.0) + of(scene, "field", 1.0)
    )
    if undriven and "temperature" in result.series:
        temperature = result.series["temperature"].values
        if loses_energy(scene.gas):
            assert np.all(np.diff(temperature) <= rounding * temperature[:-1])
        else:
            assert np.allclose(temperature, 1.0, rtol=0.0, atol=rounding)
    if "density" in result.series:
        assert np.allclose(result.series["density"].mean(scene.axis), 1.0, rtol=0.0, atol=1e-6)


def of(scene, name: str, otherwise):
    """A number of a scene, or what stands for one that it does not have."""
    return vars(scene).get(name, otherwise)


@cases(2400, 24)
@given(asked())
def test_a_run(drawn):
    """Finite and conserving, or refused; and the same again, or refused again."""
    kind, of_scene, of_gas, _ = drawn
    result, again = run(*drawn), run(*drawn)
    assert (result is None) == (again is None)
    if result is None:
        return
    scene = kind.scene(gas=kind.gas(**of_gas), **of_scene)
    check_finite(scene, result)
    check_conserved(kind, scene, result)
    xr.testing.assert_identical(result.to_xarray(), again.to_xarray())


@cases(600, 6)
@given(asked(), st.data())
def test_a_point_of_a_sweep(drawn, data):
    """It is the run of that point alone, as far as both go; of the others, none matters."""
    kind, of_scene, of_gas, options = drawn
    numbers = [name for name, value in of_gas.items() if name not in kind.of_gas]
    if not numbers:
        return
    name = data.draw(st.sampled_from(numbers), label="name")
    other = data.draw(fields_of(kind.gas, kind.of_gas), label="other")[name]
    values = [of_gas[name], other]
    if of_gas[name] == other or any(isinstance(value, str) for value in values):
        return
    alone = run(*drawn)
    swept = run(kind, of_scene, of_gas | {name: values}, options)
    if alone is None or swept is None:
        return
    one = swept.at(**{name: of_gas[name]}).series
    both = slice(0, min(one.sizes["sample"], alone.series.sizes["sample"]))
    xr.testing.assert_equal(one.isel(sample=both), alone.series.isel(sample=both))


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """One folder for all cases."""
    return tmp_path_factory.mktemp("runs")


@cases(250, 4)
@given(asked())
def test_the_file_of_a_run(folder, drawn):
    """It has all of the result, and builds the scene again."""
    result = run(*drawn)
    if result is None:
        return
    loaded = jdsmc.load(result.save(folder / "x.h5", overwrite=True))
    xr.testing.assert_identical(loaded.series, result.series)
    assert loaded.attrs.keys() == result.attrs.keys()
    for name, value in result.attrs.items():
        np.testing.assert_array_equal(loaded.attrs[name], value)
    assert str(loaded.scene()) == str(result.under_way.scene)


@cases(250, 4)
@given(asked())
def test_gone_on(drawn):
    """A first chunk that is gone on from gives the numbers of one run."""
    *what, options = drawn
    whole, part = run(*what, options), run(*what, options | {"duration": 1e-3})
    assume(whole is not None and part is not None)
    assume(whole.series.sizes["sample"] > part.series.sizes["sample"])
    again = jdsmc.resume(part, duration=options["duration"], progress=False)
    xr.testing.assert_identical(again.series, whole.series)
