"""A second program for the same gases: Bird's sequential method in a plain loop.

It shares nothing with `jdsmc` but the equations, and settles whether a disagreement with the paper
comes from the way `jdsmc` draws its pairs. Needs numba (the extra `benchmarks`).
"""

import numpy as np

from jdsmc import Estimate

from ..numbers import over_parts

try:
    from numba import njit
except ImportError:  # an optional check
    njit = None


def compiled(function):
    """By numba, or left as it is: too slow to be used."""
    return njit(fastmath=True)(function) if njit else function


WARM_UP, DURATION = 60.0, 120.0
"""Times in units of τ(T)."""

EVERY = 8
"""Steps between two measurements."""

MAJORANT = 9.0
"""Of the relative speed, in v0."""

NAMES = (
    *("temperature", "shear_stress", "normal_stress_xy", "normal_stress_zy"),
    *("fourth", "sixth", "below_1"),
)
"""Means that `advance` makes: reduced as elsewhere, ⟨V⁴⟩ and ⟨V⁶⟩ over the Maxwellian's."""


def available() -> bool:
    """True if numba is installed."""
    return njit is not None


def steady(
    gas: str,
    alpha: float,
    shear_rate: float,
    temperature: float,
    *,
    n_particles: int,
    n_gases: int,
    step: float,
) -> dict[str, Estimate]:
    """Steady values: means over time, errors from independent gases; `step` in units of τ(T).

    `temperature`, in T0, is that of the Maxwellian to start from; near the end it saves time. IHS
    or EHS: momentum exchange, collision rate and drag of eqs. (2.8), (2.16), (2.21).
    """
    cooling = 2.0 / (3.0 * np.sqrt(np.pi)) * (1.0 - alpha**2)
    pair = ((1.0 + alpha) / 4.0, 1.0, 0.0) if gas == "ihs" else (0.5, (1.0 + alpha) / 2.0, cooling)
    rows, excess = [], 0
    for seed in range(n_gases):
        random = np.random.default_rng(seed)
        velocity = np.sqrt(0.5 * temperature) * random.normal(size=(n_particles, 3))
        velocity -= velocity.mean(axis=0)  # or the mean V_x would grow with the mean V_y for ever
        for part, duration in enumerate((WARM_UP, DURATION)):
            steps, number = round(duration / step), 2 * seed + part
            means, missed = advance(velocity, pair, shear_rate, steps, step, number)
        rows.append(means)
        excess += missed
    if excess > 1.0 + 1e-6 * n_gases * n_particles * DURATION:
        raise RuntimeError(f"{excess} pairs were faster than the majorant {MAJORANT} v0.")
    rows = np.array(rows)
    rows[:, 4] -= 1.0
    rows[:, 5] = -rows[:, 5] + 1.0 + 3.0 * rows[:, 4]
    names = (*NAMES[:4], "a2", "a3", *NAMES[6:])
    return {name: over_parts(x) for name, x in zip(names, rows.T, strict=True)}


@compiled
def advance(velocity, pair, shear_rate, steps, step, seed):
    """Half a flow, collisions, half a flow, `steps` times. Means of the observables; excesses.

    Flow: shear (4.21), then drag at the present temperature (4.22). Candidates of (4.23), rounded
    without bias, accepted with g/w. The outgoing relative velocity of an elastic collision of
    spheres is isotropic.
    """
    np.random.seed(seed)  # noqa: NPY002 - the generator that numba compiles
    exchange, rate_factor, drag = pair
    size, sums, count, excess = len(velocity), np.zeros(7), 0, 0
    for k in range(steps):
        thermal = np.sqrt(2.0 * np.sum(velocity**2) / (3.0 * size))
        duration = step / thermal
        for half in range(2):
            if half:
                bound = MAJORANT * thermal
                expected = rate_factor * (size - 1) * bound * duration / np.sqrt(8.0)
                for _ in range(int(expected + np.random.random())):  # noqa: NPY002
                    i, j = np.random.randint(size), np.random.randint(size - 1)  # noqa: NPY002
                    j += j >= i
                    g = velocity[i] - velocity[j]
                    speed = np.sqrt(g[0] ** 2 + g[1] ** 2 + g[2] ** 2)
                    excess += speed > bound
                    if np.random.random() * bound < speed:  # noqa: NPY002
                        cosine = 2.0 * np.random.random() - 1.0  # noqa: NPY002
                        azimuth = 2.0 * np.pi * np.random.random()  # noqa: NPY002
                        across = speed * np.sqrt(1.0 - cosine**2)
                        g[0] -= across * np.cos(azimuth)
                        g[1] -= across * np.sin(azimuth)
                        g[2] -= speed * cosine
                        velocity[i] -= exchange * g
                        velocity[j] += exchange * g
                thermal = np.sqrt(2.0 * np.sum(velocity**2) / (3.0 * size))
            velocity[:, 0] -= 0.5 * shear_rate * duration * velocity[:, 1]
            velocity *= np.exp(-0.25 * drag * thermal * duration)
        if k % EVERY == 0:
            x, y, z = velocity[:, 0], velocity[:, 1], velocity[:, 2]
            square = x * x + y * y + z * z
            heat = np.mean(square) / 3.0
            sums[0] += 2.0 * heat
            sums[1] -= np.mean(x * y) / heat
            sums[2] += np.mean(x * x - y * y) / heat
            sums[3] += np.mean(z * z - y * y) / heat
            sums[4] += np.mean(square**2) / (15.0 * heat**2)
            sums[5] += np.mean(square**3) / (105.0 * heat**3)
            sums[6] += np.mean(square < 2.0 * heat)
            count += 1
    return sums / count, excess
