"""Boltzmann equations that others solved in closed form, each run as a user would.

Inelastic Maxwell gas: with a pair rate w that does not depend on the speed and isotropic outgoing
directions, a particle makes ω = w/2√2 collisions per time (shared by two), and moments close.
"""

from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import jdsmc
from jdsmc import MaxwellMolecules, random
from jdsmc.motion.drive import centred, temperature_of
from jdsmc.scenarios import FourierFlow, HomogeneousCooling, UniformShear
from jdsmc.scenarios.homogeneous import HomogeneousState, first_majorant

OMEGA = 1 / np.sqrt(np.pi)
"""Collisions per particle and τ0 of the gases below, that of hard spheres at T0."""
SIZE = {"n_particles": 10_240, "progress": False}


class InelasticMaxwell(jdsmc.AbstractGas):
    """Grains that collide at a rate independent of their speed."""

    restitution: Any = jdsmc.number("α", low=0.0, high=1.0)

    def rate(self, speed):
        return jnp.full_like(speed, 2 * np.sqrt(2) * OMEGA)

    def momentum_transfer(self, relative_velocity, outgoing):
        share = (1 + self.restitution) / 4
        return tuple(share * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


def later(series, name):
    """Mean of the last two thirds of a series, and its error from eight blocks."""
    values = series[name].values[len(series["sample"]) // 3 :]
    blocks = values[: len(values) // 8 * 8].reshape(8, -1).mean(axis=1)
    return np.mean(blocks), np.std(blocks, ddof=1) / np.sqrt(8)


@pytest.mark.parametrize("alpha", [0.5, 0.8])
def test_steady_shear_of_the_inelastic_maxwell_gas(alpha):
    """-P_xy/p = √(3c(1-c))/(2-c) and P_yy/p = c/(2-c) with c = (1+α)/2.

    Stresses decay with ω c(2-c), T with ζ = 2ω c(1-c): with P_yy/p = 1 - ζ/ων' and 2aΠ/3 = ζ there
    is one shear rate at which T is steady, any T. The step adds (ν dt)²/6: 2e-4.
    """
    c = (1 + alpha) / 2
    stress, yy = np.sqrt(3 * c * (1 - c)) / (2 - c), c / (2 - c)
    shear_rate = 3 * OMEGA * c * (1 - c) / stress
    scene = UniformShear(InelasticMaxwell(alpha), shear_rate)
    series = jdsmc.run(scene, duration=60.0, **SIZE).series
    for name, known in (("shear_stress", stress), ("pressure_yy", yy), ("pressure_zz", yy)):
        value, error = later(series, name)
        assert error < 4e-3 * known
        assert abs(value - known) < 5 * error + 5e-4 * known


@pytest.mark.parametrize(("alpha", "a2"), [(0.5, 2 / 7), (0.8, 2 / 49)])
def test_kurtosis_of_the_cooling_inelastic_maxwell_gas(alpha, a2):
    """The closed equation of ⟨V⁴⟩; T falls by e^{-ζt}, ζ = (1-α²)ω/2, whatever the distribution.

    At α = 0.5 the tail is a power of the speed, so that a2 of N particles is noisy.
    """
    scene = HomogeneousCooling(InelasticMaxwell(alpha))
    result = jdsmc.run(scene, duration=60.0, **SIZE)
    value, error = later(result.series, "a2")
    assert error < 0.05 * a2
    assert abs(value - a2) < 5 * error + 5e-3 * a2
    last = result.series.isel(sample=-1)
    loss = -float(last["log_temperature"] / last["time"]) / ((1 - alpha**2) * OMEGA / 2)
    assert loss == pytest.approx(1.0, abs=2e-3)  # 8e4 particles, each 34 collisions


class BobylevKrookWu(HomogeneousCooling):
    """A gas that starts from f ∝ v² exp(-5v²/6T), the solution of 1976 at K = 3/5."""

    def initial(self, key, options):
        shape = options.rows.rows, options.rows.lanes
        normal = [
            n
            for draw in range(4)
            for n in random.normal_pair(random.bits(random.fold_in(key, draw), shape), jnp.float32)
        ]
        x, y, z = normal[:3]
        speed = jnp.sqrt(sum(n * n for n in normal[3:8]) / (x * x + y * y + z * z))
        velocity = centred((speed * x, speed * y, speed * z))
        scale = jnp.sqrt(0.5 / temperature_of(velocity))
        start = tuple(scale * v for v in velocity)
        return HomogeneousState(start, first_majorant(self.gas, options.dtype))


def test_relaxation_of_bobylev_krook_and_wu():
    """⟨v⁴⟩/15T² = K(2-K) and ⟨v⁶⟩/105T³ = K²(3-2K), K = 1 - x, x = (2/5) e^{-ωt/3}.

    Hence a2 = -x² and a3 = -2x³, at all times.
    """
    gas = MaxwellMolecules()
    series = jdsmc.run(BobylevKrookWu(gas), duration=6.0, steps_per_record=4, **SIZE).series
    assert float(series["a2"][0]) == pytest.approx(-0.16, abs=0.01)
    x = 0.4 * np.exp(-gas.collision_rate(0.5) * series["time"].values / 3)
    for name, known in (("a2", -(x**2)), ("a3", -2 * x**3)):
        score = (series[name].values - known) / series[f"{name}_error"].values
        # t of 7 has t² = 1.4 in the mean; the start is remembered, so that it counts as 4 values
        assert np.mean(score**2) < 1.4 + 4.5 * np.sqrt(2 * 1.4**2 / 4)
        assert np.mean(series[f"{name}_error"].values[: len(x) // 2]) < 0.05 * np.max(np.abs(known))


def test_sheared_maxwell_molecules_of_ikenberry_and_truesdell():
    """T and stresses while the gas heats up: a closed linear system for ⟨V_x²⟩, ⟨V_xV_y⟩, ...

    dM_ij/dt = -ν (M_ij - T δ_ij) - a (δ_ix M_yj + δ_jx M_iy), ν = 8/5√π, from T0.
    """
    rate, nu, time = 1.0, 8 / (5 * np.sqrt(np.pi)), 5.0
    scene = UniformShear(MaxwellMolecules(), rate)
    size = SIZE | {"n_particles": 40_960}
    series = jdsmc.run(scene, duration=time, steps_per_record=4, **size).series
    moments, now = np.diag([0.5, 0.5, 0.5]), 0.0
    gradient = np.zeros((3, 3))
    gradient[0, 1] = rate
    steps = 4000
    end = float(series["time"][-1])
    for _ in range(steps):  # second order: the middle of each step

        def slope(m):
            drag = gradient @ m
            return -nu * (m - np.trace(m) / 3 * np.eye(3)) - drag - drag.T

        half = moments + 0.5 * end / steps * slope(moments)
        moments = moments + end / steps * slope(half)
        now += end / steps
    heat = np.trace(moments) / 3
    known = {"temperature": 2 * heat, "shear_stress": -moments[0, 1] / heat}
    known["pressure_yy"] = moments[1, 1] / heat
    assert known["temperature"] > 3
    for name, expected in known.items():
        value, error = (float(series[n][-1]) for n in (name, f"{name}_error"))
        assert error < 5e-3 * expected
        assert abs(value - expected) < 5 * error + 1e-3 * expected


class Rarefied(jdsmc.AbstractGas):
    """Elastic spheres that hardly ever meet."""

    def rate(self, speed):
        return 1e-6 * speed

    def momentum_transfer(self, relative_velocity, outgoing):
        return tuple(0.5 * (g - e) for g, e in zip(relative_velocity, outgoing, strict=True))


def test_free_molecular_heat_flux():
    """Knudsen's flux between walls at T_- and T_+: two streams, one from either wall.

    Particles leave a wall with the energy T (m v0²); as many come as go: n_± ∝ 1/√T_±.
    q = -(1-T_-) √T_-/((1+√T_-)√π) n̄ m v0³. The start is forgotten as the slowest cross: L/t of
    their flux, 0.5% after 100 τ0, is still to come.
    """
    cold, length = 0.2, 0.5
    scene = FourierFlow(Rarefied(), cold, 0.0, length, layers=4)
    series = jdsmc.run(scene, n_particles=1000, duration=150.0, progress=False).series
    known = -(1 - cold) * np.sqrt(cold / np.pi) / (1 + np.sqrt(cold))
    for name in ("heat_flux_cold_wall", "heat_flux_hot_wall", "mean_heat_flux"):
        value, error = later(series, name)
        assert error < 0.01 * abs(known)
        assert abs(value - known) < 5 * error + 5e-3 * abs(known)
