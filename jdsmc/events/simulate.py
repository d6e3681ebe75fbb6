"""What a caller uses: `start`, `advance` in plain time, `advance_scaled` in the scaled one."""

import math

import numpy as np

from .. import check
from ..errors import FaultError
from . import system as at
from .system import Samples, System

MAX_DENSITY = 0.5
"""Largest nσ² that is started. Dropping disks at random jams at nσ² = 0.696 (packing 0.547)."""
DROPS_PER_DISK = 1000
"""Places tried per disk before all are taken up again; 3000 disks at nσ² = 0.5 need six."""
DISKS_PER_CELL = 1.3
"""Fastest at nσ² = 0.01: fewer cell crossings against fewer pairs to look at."""
RESCALE_EVERY = 8
"""Samples between two rescalings: a few mean free times."""


def _compiled():
    """The compiled functions; ImportError with a remedy where numba is missing."""
    try:
        from . import placing, scaled  # noqa: PLC0415 - numba is an extra, imported when needed
    except ModuleNotFoundError as error:
        if error.name != "numba":
            raise
        raise ImportError(
            'Molecular dynamics needs numba, which is not installed: pip install "jdsmc[md]".'
        ) from error
    return placing, scaled


def start(n_particles: int, density: float, seed: int) -> System:
    """Disks at random places without overlap, Gaussian velocities of mean zero and T = T0 exactly.

    Arguments: the number of disks N, nσ² in (0, 0.5] (packing fraction at most 0.39), and a seed.
    Raises ValueError or TypeError outside the ranges, or where the box would be narrower than four
    diameters; ImportError without numba.
    """
    check.at_least("n_particles", n_particles, 2)
    check.scalar("density", density, 0.0, MAX_DENSITY)
    check.at_least("seed", seed, 0)
    placing, scaled = _compiled()
    generator = np.random.default_rng(seed)
    system, placed = empty(n_particles, density), 0
    while placed < n_particles:  # a small box may jam: then from the beginning
        system, placed = empty(n_particles, density), 0
        for _ in range(DROPS_PER_DISK):
            candidates = system.box[at.SIDE] * generator.random((n_particles, 2))
            placed = placing.drop(system, placed, candidates)
            if placed == n_particles:
                break
    velocity = generator.normal(size=(n_particles, 2))
    velocity -= velocity.mean(axis=0)
    velocity /= np.sqrt(np.mean(np.sum(velocity**2, axis=1)))  # ⟨v²⟩ = 2 T0 = 1
    system.disks[:, at.VX : at.VY + 1] = velocity
    scaled.rebuild(system)
    return system


def place(positions, velocities, density: float) -> System:
    """Disks at given places, (N, 2) in λ0, with given velocities, (N, 2) in v0, at time zero.

    The side of the box follows from N and the density nσ²; positions are taken modulo the side.
    Raises ValueError where shapes differ, numbers are not finite, or disks overlap.
    """
    check.scalar("density", density, 0.0, MAX_DENSITY)
    positions, velocities = np.asarray(positions, float), np.asarray(velocities, float)
    for name, array in (("positions", positions), ("velocities", velocities)):
        if array.shape != (len(positions), 2) or not np.all(np.isfinite(array)):
            raise ValueError(f"{name} must be finite numbers of shape (N, 2), equal for both.")
    check.at_least("number of positions", len(positions), 2)
    _, scaled = _compiled()
    system = empty(len(positions), density)
    system.disks[:, at.X : at.Y + 1] = positions % system.box[at.SIDE]
    system.disks[:, at.VX : at.VY + 1] = velocities
    scaled.rebuild(system)
    if system.counts[at.OVERLAPS]:
        raise ValueError(
            f"positions: {system.counts[at.OVERLAPS]} pairs are nearer than one diameter, "
            f"σ = {system.box[at.DIAMETER]:g}."
        )
    return system


def empty(n_particles: int, density: float) -> System:
    """Arrays of the right shapes, without disks; nσ = 1/(2√2) gives σ and L."""
    diameter = density * 2.0 * math.sqrt(2.0)
    side = math.sqrt(n_particles / density) * diameter
    n_cells = int(min(math.sqrt(n_particles / DISKS_PER_CELL), side / (1.001 * diameter)))
    n_cells = max(n_cells, 4)
    if side / n_cells < 1.001 * diameter:
        raise ValueError(
            f"n_particles = {n_particles} is too small at this density: the box must be wider than "
            f"four diameters, so n_particles must be at least {math.ceil(16.1 * density)}."
        )
    leaves = 1 << (n_particles - 1).bit_length()
    return System(
        disks=np.zeros((n_particles, 8)),
        links=np.zeros((n_particles, 7), np.int64),
        last_hit=np.full(n_particles, -np.inf),
        following=np.full(n_particles, at.OUTSIDE, np.int32),
        first=np.full((n_cells, n_cells), at.OUTSIDE, np.int32),
        tree_time=np.full(2 * leaves, np.inf),
        tree_disk=np.zeros(2 * leaves, np.int32),
        box=np.array([side, diameter, side / n_cells]),
        clock=np.zeros(5),
        sums=np.zeros(2),
        counts=np.zeros(at.N_COUNTS, np.int64),
    )


def advance(system: System, restitution: float, duration: float) -> System:
    """Free cooling for a plain time; `restitution` in (0, 1], `duration` in τ0 of the start.

    Two calls give the numbers of one, bit for bit. Positions of the result hold at different
    times: see `phase_space`. `sums` goes on from before. After a call of `advance_scaled` the
    velocities are first rescaled to that moment, so that plain time starts there.
    """
    check.scalar("restitution", restitution, 0.0, 1.0)
    check.in_range("duration", duration, 0.0, np.inf)
    _, scaled = _compiled()
    system = system.copy()
    _set_growth_rate(scaled, system, 0.0)
    end = system.clock[at.TIME] + float(duration)
    scaled.run_until(system, float(restitution), end)
    system.clock[at.SCALED_TIME] = end
    _refuse_stalled(system)
    return system


def advance_scaled(
    system: System,
    restitution: float,
    growth_rate: float,
    sample_interval: float = 0.7,
    n_samples: int = 1,
    rescale_every: int = RESCALE_EVERY,
) -> tuple[System, Samples]:
    """The stationary representation, exactly: s = ln(1+μt)/μ, w = v e^{μs} (eqs. 6, 7).

    Plain free cooling runs between samples; after every `rescale_every` of them v *= e^{μs}, the
    net momentum is removed and t starts anew. Calls may be split anywhere, bit for bit.
    Arguments: `restitution` in (0, 1], `growth_rate` μ >= 0 in 1/τ0, `sample_interval` in scaled
    time s. A system that came with another growth rate is rescaled first.
    """
    check.scalar("restitution", restitution, 0.0, 1.0)
    check.in_range("growth_rate", growth_rate, 0.0, np.inf, high_included=False)
    check.scalar("sample_interval", sample_interval, 0.0, np.inf)
    check.at_least("n_samples", n_samples, 1)
    check.at_least("rescale_every", rescale_every, 1)
    _, scaled = _compiled()
    system = system.copy()
    _set_growth_rate(scaled, system, float(growth_rate))
    time, collisions = np.zeros(n_samples), np.zeros(n_samples, np.int64)
    modes, moments = np.zeros((n_samples, 4, 2)), np.zeros((n_samples, 2))
    sums = np.zeros((n_samples, 2))
    records = (time, modes, moments, collisions, sums)
    scaled.run_samples(system, float(restitution), float(sample_interval), rescale_every, records)
    _refuse_stalled(system)
    means = moments / system.disks.shape[0]
    return system, Samples(
        time=time,
        modes=modes[..., 0] + 1j * modes[..., 1],
        temperature=means[:, 0] / 2.0,
        fourth_moment=means[:, 1],
        collisions=collisions,
        energy_lost=sums[:, at.ENERGY_LOST],
        virial=sums[:, at.VIRIAL],
    )


def phase_space(system: System) -> tuple[np.ndarray, np.ndarray]:
    """Positions (N, 2) in [0, L) and (scaled) velocities (N, 2), all at the present time."""
    lag = system.clock[at.TIME] - system.disks[:, at.MOVED]
    velocity = system.disks[:, at.VX : at.VY + 1]
    position = system.disks[:, at.X : at.Y + 1] + velocity * lag[:, None]
    scale = 1.0 + system.clock[at.GROWTH_RATE] * system.clock[at.TIME]
    return position % system.box[at.SIDE], velocity * scale


def faults(system: System) -> dict[str, int]:
    """What went wrong since the start, by name; all zero in a run that can be trusted."""
    names = ("overlaps", "collapses", "misplaced", "backward", "stalled")
    return {name: int(system.counts[at.OVERLAPS + i]) for i, name in enumerate(names)}


def _set_growth_rate(scaled, system, growth_rate):
    """Rescale where the growth rate changes: w = v (1 + μt) holds for one μ only."""
    if system.clock[at.GROWTH_RATE] != growth_rate:
        if system.clock[at.TIME] > 0.0:
            scaled.rescale(system, growth_rate)
        system.clock[at.GROWTH_RATE] = growth_rate


def _refuse_stalled(system):
    if system.counts[at.STALLED]:
        raise FaultError(
            "Molecular dynamics came to a stop: events follow each other without end at "
            f"t = {system.clock[at.TIME]:g}; use a restitution nearer to 1 or a lower density."
        )
