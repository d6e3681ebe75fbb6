"""Scenes of one's own: a homogeneous one and one in a slab; what is incomplete is refused."""

from dataclasses import replace
from typing import Any, ClassVar

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import jdsmc
from jdsmc.motion.cells import populations, totals
from jdsmc.scenarios import AbstractHomogeneous, AbstractSlab, SlabState, homogeneous_observables
from jdsmc.scenarios.slab import maxwellian_at, uniform


class Heated(AbstractHomogeneous):
    """White noise of variance ξ² dt in each component makes up for the energy lost."""

    gas: jdsmc.AbstractGas
    noise: Any = jdsmc.number("strength ξ² of the noise", "v0²/τ0", low=0.0)
    reports: ClassVar = homogeneous_observables("temperature", "a2")
    monitored: ClassVar = ("temperature", "fourth")

    def step(self, key, velocity, majorant, duration, options):
        velocity, tally = self.collide(key, velocity, majorant, duration, options)
        width = jnp.sqrt(self.noise * duration)
        kicks = jdsmc.random.normals(key, velocity, jdsmc.random.Stream.OWN)
        return tuple(v + width * k for v, k in zip(velocity, kicks, strict=True)), tally


class Mixing(AbstractSlab):
    """A gas in the left half of a ring, let go."""

    gas: jdsmc.AbstractGas
    length: Any = jdsmc.number("length of the ring", "λ0", low=0.0, low_included=False, default=2.0)
    layers: int = jdsmc.count("layers", default=8)
    axis: ClassVar = "y"
    reports: ClassVar = (
        jdsmc.Observable("temperature", "temperature T/T0"),
        jdsmc.Observable("density", "density n/n̄", dims=("y",)),
    )
    monitored: ClassVar = ("density",)

    def initial(self, key, options):
        place = 0.5 * self.length * uniform(key, options.n_particles, options.dtype)
        start = jnp.full_like(place, 0.5)
        velocity = maxwellian_at(jdsmc.random.fold_in(key, 1), start)
        return SlabState(place, velocity, 20.0 * jnp.ones_like(place[0]))

    def move(self, key, state, duration):
        return replace(
            state, position=(state.position + state.velocity[1] * duration) % self.length
        )

    def measure(self, state):
        layer, energy = self.layer(state.position), sum(v * v for v in state.velocity)
        numbers = populations(layer, self.layers).astype(energy.dtype)
        return {"number": numbers, "energy": totals(layer, energy, self.layers)}

    def wanted_step(self, moments, options):
        return jnp.asarray(options.time_step, options.dtype)

    def averages(self, record):
        number, energy = (record.moments[name] for name in ("number", "energy"))
        count = np.sum(number, axis=-1)
        return {
            "density": number * self.layers / count[..., None],
            "energy": np.sum(energy, axis=-1) / count,
        }

    def observables(self, means):
        return {"density": means["density"], "temperature": means["energy"] / 1.5}


SMALL = {"n_particles": 1000, "progress": False, "seed": 3}
SCENES = {
    "homogeneous": (Heated(jdsmc.InelasticHardSpheres(0.8), 0.05), {"rtol": 0.02}),
    "slab": (Mixing(jdsmc.InelasticHardSpheres(1.0)), {"collisions": 80.0}),
}


@pytest.fixture(scope="module", params=SCENES)
def ran(request):
    scene, until = SCENES[request.param]
    return scene, jdsmc.run(scene, **until, **SMALL)


def test_runs_and_shows_itself(ran):
    """Steady values under all names it reports, in a table with meanings and units."""
    scene, result = ran
    assert set(result) == {one.name for one in scene.reports}
    assert "temperature T/T0" in result.table() and type(scene).__name__ in repr(result)
    for one in scene.reports:
        assert result.steady[one.name].attrs["long_name"] == one.meaning
        assert result.steady[one.name].dims == one.dims


def test_is_saved_loaded_and_made_again(ran, tmp_path):
    """The file knows class and numbers; a file never imports, and the class is there already."""
    scene, result = ran
    again = jdsmc.load(result.save(tmp_path / "own.h5"))
    assert again.attrs["scene"] == type(scene).__name__
    for name in result:
        np.testing.assert_array_equal(again[name].value, result[name].value)
    assert repr(again.scene()) == repr(scene)


@pytest.mark.parametrize("ran", ["homogeneous"], indirect=True)
def test_white_noise_balances_the_cooling(ran):
    """ξ² = ζT: (3/2) ξ² is what collisions take per particle and time."""
    scene, result = ran
    heat, error = result["temperature"]
    loss = scene.gas.energy_loss_rate(0.5 * heat) * result["relative_speed_cubed_collisional"].value
    # T is known to 2%, the loss goes as T^{3/2}
    assert loss == pytest.approx(1.5 * 0.05, abs=4.5 * 1.5 * 0.075 * error / heat + 0.001)
    assert result["a2"].value < 0.1


@pytest.mark.parametrize("ran", ["slab"], indirect=True)
def test_a_ring_mixes_and_keeps_its_energy(ran):
    """T = T0 but for the start (1000 velocities: 2.6% a realization), n = n̄ everywhere."""
    _, result = ran
    assert result["temperature"].value == pytest.approx(1.0, abs=4.5 * 0.026 / np.sqrt(8))
    series = result.series["temperature"].values
    np.testing.assert_allclose(series, series[0], rtol=1e-4)
    density = result["density"]
    score = (density.value - 1.0) / density.error
    assert np.mean(score**2) < 5.0  # eight layers, Student's t of seven: 1.4, less what is fixed
    assert result.series["density"].isel(sample=0, y=0) > 1.9


@pytest.mark.parametrize("name", SCENES)
def test_is_swept_and_a_point_is_its_single_run(name):
    """Any number may be an array; at fixed collisions a point is the single run, bit by bit."""
    scene, _ = SCENES[name]
    field = "noise" if name == "homogeneous" else "length"
    options = SMALL | {"collisions": 3.0}  # the sizes of `ran`: one program
    values = np.array([0.5, 1.5])
    swept = jdsmc.run(replace(scene, **{field: values}), **options).series
    single = jdsmc.run(replace(scene, **{field: values[1]}), **options).series
    assert swept["temperature"].dims == (field, "sample")
    both = min(swept.sizes["sample"], single.sizes["sample"])
    for one in scene.reports:
        there, here = (x[one.name].isel(sample=slice(both)).values for x in (swept, single))
        np.testing.assert_array_equal(there[1], here)


# Incomplete scenes


class Still(AbstractHomogeneous):
    """Nothing but collisions: complete but for what is taken away below."""

    gas: Any
    reports: ClassVar = homogeneous_observables("a2")
    monitored: ClassVar = ("temperature",)

    def step(self, key, velocity, majorant, duration, options):
        return self.collide(key, velocity, majorant, duration, options)


class WithoutStep(AbstractHomogeneous):
    gas: Any
    reports: ClassVar = homogeneous_observables("a2")
    monitored: ClassVar = ("temperature",)


class WithoutReports(AbstractHomogeneous):
    gas: Any
    monitored: ClassVar = ("temperature",)

    step = Still.step


class Silent(Still):
    reports: ClassVar = ()


class ReportsNames(Still):
    reports: ClassVar = ("a2", "temperature")


class Forgetful(Still):
    reports: ClassVar = (*Still.reports, jdsmc.Observable("entropy", "entropy per particle"))
    monitored: ClassVar = ()  # steady from the start


class Blind(Still):
    monitored: ClassVar = ("temperature", "entropy")


class WithoutMeasure(AbstractSlab):
    gas: Any
    length: float = 1.0
    layers: int = 4
    axis: ClassVar = "y"
    reports: ClassVar = Mixing.reports
    monitored: ClassVar = Mixing.monitored
    initial, move, wanted_step = Mixing.initial, Mixing.move, Mixing.wanted_step
    averages, observables = Mixing.averages, Mixing.observables


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        (WithoutStep, "WithoutStep .* 'step'"),
        (WithoutReports, "WithoutReports .*'reports'"),
        (WithoutMeasure, "WithoutMeasure .* 'measure'"),
        (Silent, r"Silent\.reports must hold at least one jdsmc\.Observable"),
        (ReportsNames, r"ReportsNames\.reports must hold at least one jdsmc\.Observable"),
    ],
)
def test_what_is_missing_is_named_when_it_is_made(scene, words):
    with pytest.raises(TypeError, match=words):
        scene(jdsmc.InelasticHardSpheres(0.9))


def test_no_gas():
    with pytest.raises(TypeError, match=r"gas must be a jdsmc gas, got 0\.9"):
        Still(0.9)


@pytest.mark.parametrize("until", [{"duration": 1.0}, {"rtol": 0.1, "observable": "time_step"}])
def test_what_is_reported_must_be_returned(until):
    with pytest.raises(jdsmc.FaultError, match="observables lacks entropy, which it reports"):
        jdsmc.run(Forgetful(jdsmc.InelasticHardSpheres(1.0)), **until, **SMALL)


def test_what_is_monitored_must_be_averaged():
    with pytest.raises(jdsmc.FaultError, match="averages lacks entropy, which it monitors"):
        jdsmc.run(Blind(jdsmc.InelasticHardSpheres(1.0)), rtol=0.1, **SMALL)


# Scenes whose methods return what a step cannot go on with


def velocities_only(scene, key, velocity, *rest):
    return scene.collide(key, velocity, *rest)[0]


def one_component(scene, key, velocity, *rest):
    after, tally = scene.collide(key, velocity, *rest)
    return after[0], tally


def no_tally(scene, key, velocity, *rest):
    return scene.collide(key, velocity, *rest)[0], None


def fewer(scene, key, velocity, *rest):
    after, tally = scene.collide(key, velocity, *rest)
    return tuple(v[::2] for v in after), tally


def whole_numbers(scene, key, velocity, *rest):
    after, tally = scene.collide(key, velocity, *rest)
    return tuple(jnp.round(v).astype(jnp.int32) for v in after), tally


def nothing(*_):
    return None


STEPS = (velocities_only, one_component, no_tally, fewer, whole_numbers, nothing)


@pytest.mark.parametrize("step", STEPS)
def test_a_step_of_the_wrong_kind_is_named(step):
    wrong = type("Wrong", (Still,), {"step": step, "__module__": __name__})
    with pytest.raises(TypeError, match=r"Wrong\.step must return \(velocity, tally\).*; got "):
        jdsmc.run(wrong(jdsmc.InelasticHardSpheres(0.9)), collisions=1.0, **SMALL)


def positions_only(scene, key, state, duration):
    return state.position


def doubled(scene, key, state, duration):
    return jax.tree.map(lambda x: jnp.concatenate([x, x]) if x.ndim else x, state)


def of_each(scene, moments, options):
    return jnp.ones(scene.layers)


def unchanged(scene, state):
    return state


METHODS = [
    ("move", positions_only, "the state with arrays as they came in"),
    ("move", doubled, "the state with arrays as they came in"),
    ("wanted_step", of_each, "one number; got float32"),
    ("initial", lambda scene, key, options: key, "a SlabState or what derives from it; got Key"),
    ("advance", lambda scene, key, state, options: (state, state), "a Record"),
    ("finish_chunk", unchanged, r"\(state, sample\)"),
]


@pytest.mark.parametrize(("name", "method", "must"), METHODS)
def test_a_method_of_the_wrong_kind_is_named(name, method, must):
    wrong = type("Wrong", (Mixing,), {name: method, "__module__": __name__})
    with pytest.raises(TypeError, match=rf"Wrong\.{name} must return .*{must}"):
        jdsmc.run(wrong(jdsmc.InelasticHardSpheres(1.0)), collisions=1.0, **SMALL)
