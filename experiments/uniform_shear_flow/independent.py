"""A second program for the same gases: Bird's sequential method in a plain loop.

It shares nothing with `jdsmc` but the equations, and settles whether a disagreement with the paper
comes from the way `jdsmc` draws its pairs. Needs numba (the extra `benchmarks`).
"""

from typing import NamedTuple

import numpy as np

from jdsmc import Estimate

try:
    from numba import njit

    compiled = njit(fastmath=True)
except ImportError:  # an optional check
    njit = None

    def compiled(function):
        """Leave the function as it is; `available` says that it is too slow to use."""
        return function


WARM_UP, DURATION = 60.0, 120.0
"""Times in units of τ(T)."""

EVERY = 8
"""Steps between two measurements."""

NAMES = (
    *("temperature", "shear_stress", "normal_stress_xy", "normal_stress_zy"),
    *("fourth", "sixth", "below_1", "below_2"),
)
"""Means that `observe` makes: reduced as elsewhere, ⟨V⁴⟩ and ⟨V⁶⟩ over the Maxwellian's."""


class Physics(NamedTuple):
    """Momentum exchange (1+α)/4, collision rate β, drag coefficient c, shear rate, majorant/v0."""

    exchange: float
    rate_factor: float
    drag: float
    shear_rate: float
    majorant: float


def available() -> bool:
    """True if numba is installed."""
    return njit is not None


def physics(gas: str, restitution: float, shear_rate: float) -> Physics:
    """IHS or EHS, eqs. (2.8), (2.16), (2.21)."""
    if gas == "ihs":
        return Physics((1.0 + restitution) / 4.0, 1.0, 0.0, shear_rate, 9.0)
    cooling = 2.0 / (3.0 * np.sqrt(np.pi)) * (1.0 - restitution**2)
    return Physics(0.5, (1.0 + restitution) / 2.0, cooling, shear_rate, 9.0)


def steady(
    gas: str,
    restitution: float,
    shear_rate: float,
    temperature: float,
    *,
    n_particles: int,
    n_gases: int,
    step: float,
) -> dict[str, Estimate]:
    """Steady values: means over time, errors from independent gases; `step` in units of τ(T).

    `temperature`, in T0, is that of the Maxwellian to start from; near the end it saves time.
    """
    rows, excess = [], 0
    setting = physics(gas, restitution, shear_rate)
    for seed in range(n_gases):
        random = np.random.default_rng(seed)
        velocity = np.sqrt(0.5 * temperature) * random.normal(size=(n_particles, 3))
        velocity -= velocity.mean(axis=0)  # or the mean V_x would grow with the mean V_y for ever
        advance(velocity, setting, round(WARM_UP / step), step, 2 * seed)
        means, missed = advance(velocity, setting, round(DURATION / step), step, 2 * seed + 1)
        rows.append(means)
        excess += missed
    if excess > 1e-6 * n_gases * n_particles * DURATION:
        raise RuntimeError(f"{excess} pairs were faster than the majorant {setting.majorant} v0.")
    columns = dict(zip(NAMES, np.array(rows).T, strict=True))
    a2 = columns.pop("fourth") - 1.0
    columns |= {"a2": a2, "a3": -columns.pop("sixth") + 1.0 + 3.0 * a2}
    return {
        name: Estimate(float(x.mean()), float(x.std(ddof=1) / np.sqrt(len(x))))
        for name, x in columns.items()
    }


@compiled
def advance(velocity, setting, steps, step, seed):
    """Half a flow, collisions, half a flow, `steps` times. Means of the observables; excesses."""
    np.random.seed(seed)  # noqa: NPY002 - the generator that numba compiles
    sums, count, excess = np.zeros(8), 0, 0
    for k in range(steps):
        thermal = thermal_speed(velocity)
        duration = step / thermal
        flow(velocity, setting, 0.5 * duration, thermal)
        excess += collide(velocity, setting, duration, thermal)
        flow(velocity, setting, 0.5 * duration, thermal_speed(velocity))
        if k % EVERY == 0:
            sums += observe(velocity)
            count += 1
    return sums / count, excess


@compiled
def thermal_speed(velocity):
    """v0(T) of the present velocities."""
    return np.sqrt(2.0 * np.sum(velocity**2) / (3.0 * len(velocity)))


@compiled
def flow(velocity, setting, duration, thermal):
    """Shear (4.21), then drag at the present temperature (4.22)."""
    factor = np.exp(-0.5 * setting.drag * thermal * duration)
    for i in range(len(velocity)):
        velocity[i, 0] = factor * (velocity[i, 0] - setting.shear_rate * duration * velocity[i, 1])
        velocity[i, 1] *= factor
        velocity[i, 2] *= factor


@compiled
def collide(velocity, setting, duration, thermal):
    """Candidates of (4.23), rounded without bias, accepted with g/w. Returns pairs with g > w.

    The outgoing relative velocity of an elastic collision of spheres is isotropic.
    """
    size, bound = len(velocity), setting.majorant * thermal
    expected = setting.rate_factor * (size - 1) * bound * duration / np.sqrt(8.0)
    excess = 0
    for _ in range(int(expected + np.random.random())):  # noqa: NPY002
        i, j = np.random.randint(size), np.random.randint(size - 1)  # noqa: NPY002
        j += j >= i
        gx = velocity[i, 0] - velocity[j, 0]
        gy = velocity[i, 1] - velocity[j, 1]
        gz = velocity[i, 2] - velocity[j, 2]
        speed = np.sqrt(gx * gx + gy * gy + gz * gz)
        excess += speed > bound
        if np.random.random() * bound < speed:  # noqa: NPY002
            cosine = 2.0 * np.random.random() - 1.0  # noqa: NPY002
            azimuth = 2.0 * np.pi * np.random.random()  # noqa: NPY002
            across = speed * np.sqrt(1.0 - cosine**2)
            give(velocity, i, j, 0, setting.exchange * (gx - across * np.cos(azimuth)))
            give(velocity, i, j, 1, setting.exchange * (gy - across * np.sin(azimuth)))
            give(velocity, i, j, 2, setting.exchange * (gz - speed * cosine))
    return excess


@compiled
def give(velocity, i, j, component, momentum):
    """Momentum from one particle to another."""
    velocity[i, component] -= momentum
    velocity[j, component] += momentum


@compiled
def observe(velocity):
    """The means named in NAMES at one instant."""
    x, y, z = velocity[:, 0], velocity[:, 1], velocity[:, 2]
    square = x * x + y * y + z * z
    temperature = np.mean(square) / 3.0
    reduced = square / (2.0 * temperature)
    return np.array(
        [
            2.0 * temperature,
            -np.mean(x * y) / temperature,
            np.mean(x * x - y * y) / temperature,
            np.mean(z * z - y * y) / temperature,
            np.mean(square**2) / (15.0 * temperature**2),
            np.mean(square**3) / (105.0 * temperature**3),
            np.mean(reduced < 1.0),
            np.mean(reduced < 4.0),
        ]
    )
