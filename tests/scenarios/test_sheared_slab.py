"""The sheared slab: balances, limits, initial states, the homogeneous gas, commands."""

from dataclasses import replace

import equinox as eqx
import jax
import jax.numpy as jnp
import matplotlib.pyplot as plt
import numpy as np
import pytest

import jdsmc
from jdsmc import ElasticHardSpheres, InelasticHardSpheres, cli, random
from jdsmc.motion.cells import totals
from jdsmc.motion.flight import cross_planes
from jdsmc.motion.friction import LayerFlow, friction, peculiar, slowed, slowing
from jdsmc.running.engine import Engine
from jdsmc.scenarios import Options, ShearedSlab, UniformShear

from .batches import f32, keys, relative_error, standard_error, traced, within

SQRT_PI = np.sqrt(np.pi)


def _states(scene, records, *, n_particles=2000, n_realizations=16, steps=1, time_step=0.05):
    """States of every realization before the records and after the last, and the records."""
    options = Options.checked(n_particles, time_step, "strang", "float32", steps, in_space=True)
    start, own = traced(scene), keys(1, n_realizations)
    states = _starts(start, own, options)
    # how a gas began is no part of how it goes on: one program for all
    states, made = _records(
        replace(start, initial_state="equilibrium"), own, states, options, records
    )
    return jax.tree.map(lambda x: np.asarray(x, float), (states, made))


@eqx.filter_jit
def _starts(scene, keys, options):
    return jax.lax.map(lambda key: scene.initial(random.fold_in(key, 2**20), options), keys)


@eqx.filter_jit
def _records(scene, keys, states, options, count):
    def realization(given):
        key, start = given

        def record(state, number):
            new, made = scene.advance(random.fold_in(key, number), state, options)
            return new, (state, made)

        last, (before, made) = jax.lax.scan(record, start, jnp.arange(count))
        return jax.tree.map(lambda x, y: jnp.concatenate([x, y[None]]), before, last), made

    return jax.lax.map(realization, (keys, states))


def _peculiar(states, shear_rate, length):
    """Velocities in the frame that moves with uniform shear: what the planes keep."""
    vx, vy, vz = states.velocity
    return vx - shear_rate * (states.position - length / 2), vy, vz


# Flight and drag


def test_planes_keep_the_peculiar_velocity_over_many_images():
    """V_x = v_x - a y falls by a v_y t in any flight, whatever the number of images passed."""
    rng = np.random.default_rng(1)
    position = rng.random(2000) * 2.5
    velocity = rng.normal(size=(3, 2000)) * 10  # up to 16 images of 2.5 in a step of 1
    start = tuple(jnp.asarray(v, jnp.float32) for v in velocity)
    place, (vx, vy, vz) = cross_planes(
        jnp.asarray(position, jnp.float32), start, f32(4.0), f32(2.5), f32(1.0)
    )
    images = np.round((position + velocity[1] - np.asarray(place)) / 2.5)
    assert images.max() > 8 and images.min() < -8
    before, after = velocity[0] - 4 * position, np.asarray(vx) - 4 * np.asarray(place)
    # 1e-7 of terms up to 160
    np.testing.assert_allclose(after, before - 4 * velocity[1], atol=1e-4)
    np.testing.assert_array_equal(vy, start[1])
    np.testing.assert_array_equal(vz, start[2])


@pytest.fixture
def crowd():
    """Layers of 0, 1, 2, 3 and 60 particles, each with a flow and a temperature of its own."""
    rng = np.random.default_rng(2)
    numbers = [0, 1, 2, 3, 60]
    layer = rng.permutation(np.repeat(np.arange(5), numbers))
    thermal, flow = np.array([1.0, 1.0, 0.5, 2.0, 1.0]), np.array([0.0, 5.0, -3.0, 1.0, 4.0])
    velocity = tuple(thermal[layer] * rng.normal(size=66) + flow[layer] for _ in range(3))
    return jnp.asarray(layer, jnp.int32), tuple(jnp.asarray(v, jnp.float32) for v in velocity)


def test_drag_alone_is_haffs_law_in_every_layer(crowd):
    """√T(t) = √T(0)/(1 + γ(0) t) in two steps or one; flow kept; who is alone feels nothing."""
    layer, start = crowd
    gas = ElasticHardSpheres(f32(0.5))
    flow = LayerFlow.of(layer, start, 5)
    rate = friction(gas, flow)
    once = slowed(layer, start, flow.mean, slowing(rate, f32(3.0)))
    half = slowed(layer, start, flow.mean, slowing(rate, f32(1.2)))
    then = LayerFlow.of(layer, half, 5)
    twice = slowed(layer, half, then.mean, slowing(friction(gas, then), f32(1.8)))
    expected = np.asarray(flow.temperature) / (1 + 3.0 * np.asarray(rate)) ** 2
    for velocity in (once, twice):
        after = LayerFlow.of(layer, velocity, 5)
        np.testing.assert_allclose(after.temperature, expected, rtol=2e-5)  # flows of 5 T^(1/2)
        np.testing.assert_allclose(after.mean, flow.mean, atol=2e-6)
    alone = np.asarray(layer) == 1
    np.testing.assert_array_equal(np.asarray(once)[:, alone], np.asarray(start)[:, alone])
    assert np.all(np.asarray(rate)[:2] == 0) and np.all(np.asarray(rate)[2:] > 0)


def test_friction_of_a_full_layer_is_that_of_the_homogeneous_gas():
    """ζ0/2 = (1-α²)/(3√π τ) with τ = 1/√(2T), n = n̄; 2e5 particles know T to 0.2%."""
    rng = np.random.default_rng(3)
    velocity = tuple(jnp.asarray(rng.normal(size=200_000), jnp.float32) for _ in range(3))
    flow = LayerFlow.of(jnp.zeros(200_000, jnp.int32), velocity, 1)
    rate = float(friction(ElasticHardSpheres(f32(0.8)), flow)[0])
    assert rate == pytest.approx(0.36 / (3 * SQRT_PI) * np.sqrt(2.0), rel=5 * 0.001)


@pytest.mark.parametrize("population", [2, 5, 50])
def test_layers_of_any_population_lose_the_right_energy(population):
    """⟨Σ ζ0 Σ(v-u)²/2⟩ over layers of an ideal gas is ζ0 (3/2) N T, as for infinitely many."""
    layers = 4000 // population
    count = layers * population

    def loss(key):
        words = random.bits(random.fold_in(key, 0), (count,))[0]
        layer = (random.unit_interval(words, jnp.float32) * layers).astype(jnp.int32)
        x, y = random.normal_pair(random.bits(random.fold_in(key, 1), (count,)), jnp.float32)
        z, _ = random.normal_pair(random.bits(random.fold_in(key, 2), (count,)), jnp.float32)
        flow = LayerFlow.of(layer, (x, y, z), layers)
        rate = friction(ElasticHardSpheres(f32(0.5)), flow)
        a, b, c = peculiar(layer, (x, y, z), flow.mean)
        return jnp.sum(rate * totals(layer, a * a + b * b + c * c, layers)) / count

    lost = np.asarray(jax.jit(jax.vmap(loss))(keys(4, 400)), float)
    # N - 1 of a gas of N: an ideal gas has ⟨N_I (N_I - 1)⟩ = N (N-1)/layers²
    expected = 3.0 * 0.75 / (3 * SQRT_PI) * np.sqrt(2.0) * (count - 1) / count
    assert relative_error(lost) < 2.5e-3
    assert within(lost - expected)


def test_frictional_gas_in_thin_layers_cools_by_haffs_law():
    """No shear, 20 particles a layer: √T = √T0/(1 + γ t) of the total energy; EHS stay Maxwellian.

    A fast particle raises the drag of its own layer, so that tails thin out by 1/N and the mean of
    T^{3/2} by 1/N²: T was 0.7% high with 4 particles, 0.1% with 20. Counting N for N - 1 would make
    T 3.5% too high, leaving out the fluctuations of T 1.6% too low.
    """
    scene = ShearedSlab(ElasticHardSpheres(0.5), 0.0, 2.5, layers=100)
    states, records = _states(scene, 30, steps=8)
    energy = np.mean(np.square(states.velocity), axis=(0, -1))[:, -1]
    time = np.sum(records.elapsed, axis=1)
    # the mean of all velocities is zero: 1999 particles know the temperature
    expected = 0.5 / (1 + 0.75 / (3 * SQRT_PI) * time * 1999 / 2000) ** 2
    assert np.all(expected < 0.1)
    assert relative_error(energy / expected) < 1e-3
    assert abs(np.mean(energy / expected) - 1) < 1 / 20**2


# Balances


@pytest.mark.parametrize("gas", [InelasticHardSpheres(0.7), ElasticHardSpheres(0.7)])
@pytest.mark.parametrize("state", ["equilibrium", "nonequilibrium"])
def test_mass_and_momentum(gas, state):
    """N exactly; Σ v_y, Σ v_z and Σ (v_x - a y) + a t Σ v_y to rounding of 120 steps."""
    scene = ShearedSlab(gas, 4.0, 2.5, initial_state=state, layers=20)
    states, records = _states(scene, 30, steps=4, n_realizations=4)
    assert np.all(np.sum(records.moments.number, axis=-1) == 2000)
    vx, vy, vz = (np.mean(v, axis=-1) for v in _peculiar(states, 4.0, 2.5))
    time = np.cumsum(records.elapsed, axis=1)
    # roundings of 6e-8 x 10 in each of 120 steps, independent among 2000 particles: 2e-7
    np.testing.assert_allclose(vy, 0.0, atol=5e-6)
    np.testing.assert_allclose(vz, 0.0, atol=5e-6)
    np.testing.assert_allclose(
        vx[:, 1:] + 4.0 * time * vy[:, :1], vx[:, :1].repeat(30, 1), atol=1e-5
    )


@pytest.mark.parametrize("state", ["local_equilibrium", "nonequilibrium"])
def test_viscous_heating_is_all_the_energy(state):
    """α = 1: the energy about uniform shear grows by -a ∫⟨V_x V_y⟩ dt, V_x = v_x - a y.

    Collisions keep it but for the momentum exchanged between the particles' places within a layer
    (relative size (16/45π) δy² = 7e-5 at δy = 0.025). The integrand is known every step.
    """
    scene = ShearedSlab(InelasticHardSpheres(1.0), 4.0, 2.5, initial_state=state, layers=100)
    states, records = _states(scene, 100, n_particles=4000)
    vx, vy, vz = _peculiar(states, 4.0, 2.5)
    energy = np.mean(vx**2 + vy**2 + vz**2, axis=-1) / 2
    heating = -4.0 * np.mean(vx * vy, axis=-1)
    supplied = np.sum(0.5 * (heating[:, 1:] + heating[:, :-1]) * records.elapsed, axis=1)
    gained = energy[:, -1] - energy[:, 0]
    assert np.all(gained > 1.0)
    assert relative_error(supplied / gained) < 2e-3
    # of order (a dt)²/12 = 2e-4 by splitting, 7e-5 by the places: -2e-4 in four other seeds
    off = supplied / gained - 1
    assert abs(np.mean(off)) < 4.5 * standard_error(off) + 3e-4


def test_profiles_tell_the_same_heating():
    """3/2 dT̄/dt = -a P̄_xy/n̄ - loss in uniform shear, from the averages a user gets."""
    scene = ShearedSlab(InelasticHardSpheres(1.0), 4.0, 2.5, "local_equilibrium", layers=20)
    result = jdsmc.run(scene, n_particles=4000, duration=1.5, steps_per_record=2, progress=False)
    series = result.series
    time, temperature = series["time"].values, series["mean_temperature"].values
    stress = series["shear_stress"].values * temperature / 2
    supplied = np.sum(0.5 * 4.0 * (stress[1:] + stress[:-1]) * np.diff(time))
    gained = 0.75 * (temperature[-1] - temperature[0])
    error = 0.75 * series["mean_temperature_error"].values[-1]
    # realizations with more stress are hotter: the difference is known better than either
    assert error < 0.02 * gained and abs(supplied - gained) < 4.5 * error


@pytest.mark.parametrize("layers", [10, 400])
def test_equilibrium_collision_rate(layers):
    """a = 0, α = 1: 1/(√π τ0) per particle with N - 1 partners of N, with 5 or 200 in a layer."""
    scene = ShearedSlab(InelasticHardSpheres(1.0), 0.0, 2.5, layers=layers)
    states, records = _states(scene, 40, steps=16)
    rate = np.sum(records.tally.accepted, axis=1) / 2000 / np.sum(records.elapsed, axis=1)
    assert relative_error(rate) < 3e-3
    assert within(rate * SQRT_PI - 1999 / 2000)
    temperature = sum(np.mean(v**2, axis=-1) for v in states.velocity)
    np.testing.assert_allclose(temperature, 1.5, rtol=2e-5)


def test_layers_of_two_particles_have_the_temperature_of_the_gas():
    """Elastic and without shear: energy is conserved, and T/T0 is what it was, in every layer.

    To be exact N/(N-1) times that, with N particles whose momentum is zero: two of them move
    relative to each other with 2T of N/(N-1). Layers with one particle, a third of those that
    are not empty, have none; counted as cold they made it 0.87.
    """
    scene = ShearedSlab(InelasticHardSpheres(1.0), 0.0, 2.5, layers=32)
    result = jdsmc.run(scene, n_particles=64, duration=300.0, progress=False)
    series = result.series.isel(sample=slice(1, None))
    heat = series["mean_temperature"].values
    blocks = np.mean(heat[: len(heat) // 40 * 40].reshape(40, -1), axis=1)
    error = standard_error(blocks)
    assert error < 2.5e-3
    assert abs(np.mean(blocks) - 64 / 63) < 4.5 * error
    layers = np.nanmean(series["temperature"].values, axis=0)
    assert abs(np.mean(layers) - 64 / 63) < 4.5 * standard_error(layers)
    # s/s0 with the N(N-1) pairs that there were: noise of 300/√π · 64 · 8 collisions is 0.3%
    assert float(series["collision_ratio"][-1]) == pytest.approx(1.0, abs=0.012)


# Against the homogeneous gas


@pytest.mark.parametrize("gas", [InelasticHardSpheres(0.7), ElasticHardSpheres(0.7)])
def test_uniform_shear_stays_uniform_and_is_the_homogeneous_gas(gas):
    """T and stresses at six times up to T = 25 T0 within combined errors; flat profiles.

    Time steps are the same; layers of 0.05 λ0 add (16/45π) δy² = 3e-4 to the viscosity.
    """
    options = {"n_realizations": 16, "duration": 3.0, "steps_per_record": 4, "progress": False}
    scene = ShearedSlab(gas, 4.0, 2.5, "local_equilibrium")
    slab = jdsmc.run(scene, n_particles=5000, **options).series
    flat = jdsmc.run(UniformShear(gas, 4.0), n_particles=10_000, seed=1, **options).series
    at = np.linspace(0.5, 2.8, 6)
    for name in ("temperature", "shear_stress", "normal_stress_xy", "collisions"):
        mine = "mean_temperature" if name == "temperature" else name
        ours, theirs = _at_times(slab, mine, at), _at_times(flat, name, at)
        error = np.hypot(ours[1], theirs[1])
        assert np.all(error < 0.02 * np.abs(theirs[0]))
        assert np.all(np.abs(ours[0] - theirs[0]) < 4.5 * error)
    last = slab.isel(sample=-1)
    y = last["y"].values
    uniform = {
        "density": 1.0,
        "temperature": float(last["mean_temperature"]),
        "velocity_x": 4.0 * (y - 1.25),
        "velocity_y": 0.0,
    }
    for name, value in uniform.items():
        score = (last[name].values - value) / last[f"{name}_error"].values
        # Student's t of 15 degrees of freedom: t² has mean 1.15 and variance 3.4; the layers count
        # as 10 independent ones, since long waves decay slowly
        assert np.mean(score**2) < 1.15 + 4.5 * np.sqrt(3.4 / 10)


def _at_times(series, name, at):
    time = series["time"].values
    return tuple(np.interp(at, time, series[n].values) for n in (name, f"{name}_error"))


@pytest.mark.parametrize("state", ["equilibrium", "nonequilibrium"])
def test_any_start_ends_in_uniform_shear(state):
    """The steady stress and temperature are those of the homogeneous gas; α = 0.5 is quick."""
    gas = InelasticHardSpheres(0.5)
    scene = ShearedSlab(gas, 4.0, 2.5, state, layers=25)
    slab = jdsmc.run(scene, n_particles=2500, rtol=0.01, progress=False)
    flat = jdsmc.run(UniformShear(gas, 4.0), n_particles=5000, rtol=0.005, seed=1, progress=False)
    for mine, name in (("mean_temperature", "temperature"), ("shear_stress", "shear_stress")):
        (value, error), (other, its) = slab[mine], flat[name]
        # 100 particles a layer: correlations of order 1/100 of the noise are not seen
        assert abs(value - other) < 4.5 * np.hypot(error, its) + 0.003 * other
    assert slab.to_xarray()["realizations"]["stress_xy"].dims == ("realization", "y")


# Initial states


def test_initial_states():
    """Eqs. (3.5) to (3.8), with 40 layers of 2500: errors of 2% in density, 0.02 v0 in velocity."""
    options = Options.checked(100_000, 0.05, "strang", "float32", 1, in_space=True)
    y = (np.arange(40) + 0.5) / 40
    found = {}
    for state in ("equilibrium", "nonequilibrium", "local_equilibrium"):
        scene = ShearedSlab(InelasticHardSpheres(f32(0.9)), f32(4.0), f32(2.5), state, 40)
        start = scene.initial(random.key_from_seed(3), options)
        moments = scene.measure(start)
        number, momentum = np.asarray(moments.number), np.asarray(moments.momentum_x)
        found[state] = number / 2500, momentum / number
        assert float(jnp.mean(start.velocity[1])) == pytest.approx(0.0, abs=1e-6)
        assert np.asarray(start.position).min() >= 0 and np.asarray(start.position).max() <= 2.5
        # the flow changes by aδy within a layer, which counts as (aδy)²/12 of v_x²
        gradient = {"equilibrium": 0.0, "local_equilibrium": 0.25**2 / 12}.get(state)
        if gradient is not None:
            temperature = float(moments.mean_temperature())
            assert temperature == pytest.approx(0.5 + gradient / 3, rel=1e-3)  # 40 layers' own u
    np.testing.assert_allclose(found["equilibrium"][0], 1.0, atol=0.1)
    np.testing.assert_allclose(found["equilibrium"][1], 0.0, atol=0.07)  # 4.5 errors of 0.014
    np.testing.assert_allclose(found["local_equilibrium"][1], 10 * (y - 0.5), atol=0.07)
    density, flow = found["nonequilibrium"]
    paper = y - 0.5  # the paper's y/L
    np.testing.assert_allclose(density, 1 + 0.5 * np.sin(2 * np.pi * paper), atol=0.1)
    expected = 10 * (np.cos(np.pi * paper) - 2 / np.pi)
    np.testing.assert_allclose(flow, expected, atol=0.1)  # and the curvature within a layer


def test_all_peculiar_speeds_are_equal():
    """Eq. (3.6): |v - u0| = V0 = √(3/2) (T0 = 1/2), but for a mean of 1/√N that is taken out."""
    scene = ShearedSlab(InelasticHardSpheres(f32(0.9)), f32(4.0), f32(2.5), "nonequilibrium", 10)
    options = Options.checked(20_000, 0.05, "strang", "float32", 1, in_space=True)
    start = scene.initial(random.key_from_seed(3), options)
    vx, vy, vz = (np.asarray(v, float) for v in start.velocity)
    vx -= 10 * (np.sin(np.pi * np.asarray(start.position, float) / 2.5) - 2 / np.pi)
    speed = np.sqrt(vx**2 + vy**2 + vz**2)
    np.testing.assert_allclose(speed, np.sqrt(1.5), atol=4.5 * np.sqrt(1.5 / 20_000))


# What a user gets


def test_sweep_of_length_and_shear_rate():
    """One program for all; y is then a share of the length; series of profiles and averages."""
    scene = ShearedSlab(InelasticHardSpheres(0.9), [1.0, 4.0], [2.0, 3.0, 4.0], layers=10)
    result = jdsmc.run(scene, n_particles=500, duration=0.3, progress=False)
    series = result.series
    assert series["density"].dims == ("shear_rate", "length", "sample", "y")
    assert series["mean_temperature"].dims == ("shear_rate", "length", "sample")
    np.testing.assert_allclose(series["y"], (np.arange(10) + 0.5) / 10)
    np.testing.assert_allclose(series["density"].mean("y"), 1.0, rtol=1e-6)
    trace = sum(series[f"pressure_{ij}"] for ij in ("xx", "yy", "zz"))
    np.testing.assert_allclose(trace, 3.0, rtol=1e-6)
    flow = np.abs(series["velocity_x"].isel(sample=-1, y=-1).values)
    assert np.all(flow[1] > 2 * flow[0])  # four times the shear rate
    assert np.all(np.isfinite(series["collision_ratio"].values[..., 1:]))


SMALL = ["--particles", "500", "--realizations", "8", "--layers", "10", "--no-progress"]


def test_commands(tmp_path, monkeypatch, capsys):
    """A run to the steady state, its picture and table; a sweep of both gases in time."""
    monkeypatch.chdir(tmp_path)
    line = ["run", "sheared-slab", "--restitution", "0.5", "--rtol", "0.2", "--out", "s.h5"]
    assert cli.main([*line, *SMALL, "--plot", "s.png"]) == 0
    out = capsys.readouterr().out
    for words in ("shear stress -P", "density n/n̄", "steady from t ="):
        assert words in out
    assert (tmp_path / "s.png").read_bytes().startswith(b"\x89PNG")
    line = ["sweep", "sheared-slab", "--gas", "ihs,ehs", "--length", "2,3", "--duration", "0.2"]
    assert cli.main([*line, *SMALL, "--out", "w.h5", "--plot", "w.png"]) == 0
    assert "ehs: 2 points" in capsys.readouterr().out
    assert jdsmc.load("w.h5").series["density"].dims == ("gas", "length", "sample", "y")
    plt.close("all")


@pytest.mark.parametrize(
    "line, words",
    [
        ("--shear-rate -1", "shear_rate = -1 [0, inf)"),
        ("--length 0", "length = 0 (0, 1000]"),
        ("--length wide", "length = 'wide' number"),
        ("--length 2,3", "jdsmc sweep"),
        ("--layers 0", "layers = 0 [1, inf)"),
        ("--layers 400", "n_particles = 500 fewer than 2 400 layers"),
        ("--initial-state cold", "initial_state = 'cold' equilibrium"),
        ("--gas ehs-measured", "ShearedSlab drag local"),
        ("--restitution 1", "no steady state duration"),
        ("--observable temperatures", "observable = 'temperatures' mean_temperature"),
    ],
)
def test_bad_input(line, words, tmp_path, capsys, monkeypatch):
    """One sentence, status 2, nothing written and nothing simulated."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(Engine, "advance", lambda self, watch: pytest.fail("a chunk ran"))
    try:
        status = cli.main(["run", "sheared-slab", *SMALL, *line.split(), "--out", "x.h5"])
    except SystemExit as leaving:
        status = leaving.code
    assert status == 2
    error = capsys.readouterr().err
    for word in words.split():
        assert word in error
    assert not list(tmp_path.iterdir()) and "Traceback" not in error
