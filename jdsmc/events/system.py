"""What is carried from event to event: plain NumPy arrays, so that a file restores them exactly."""

from typing import NamedTuple

import numpy as np

# Columns of `System.disks`. One disk is one cache line of 64 bytes.
X, Y, VX, VY = 0, 1, 2, 3
MOVED = 4  # time at which the position holds: it is advanced only when the disk collides
LEAVES_X, LEAVES_Y = 5, 6  # times at which the disk leaves its cell through either pair of sides
COLLIDES = 7  # time of the earliest collision foreseen from this disk

# Columns of `System.links`.
COLUMN, ROW = 0, 1  # of the cell
PARTNER = 2  # with whom a collision is foreseen
PARTNER_HITS = 3  # how many collisions the partner had had when it was foreseen
HITS = 4  # collisions of this disk so far
HASTE = 5  # how many of its last collisions came in quick succession
PRECEDING = 6  # disk before in the same cell

# Places in `System.box`.
SIDE, DIAMETER, CELL_SIDE = 0, 1, 2

# Places in `System.clock`; all since the last rescaling but ELAPSED.
TIME = 0  # t, plain time of free cooling
SCALED_TIME = 1  # s = ln(1 + μt)/μ
GROWTH_RATE = 2  # μ
SAMPLES = 3  # samples taken
ELAPSED = 4  # s at the last rescaling, since the start

# Places in `System.sums`, in scaled units, since the last sample.
ENERGY_LOST, VIRIAL = 0, 1  # virial: sum over collisions of σ |Δp|

# Places in `System.counts`, since the start.
COLLISIONS, CROSSINGS, OUTDATED = 0, 1, 2
OVERLAPS, COLLAPSES, MISPLACED, BACKWARD, STALLED = 3, 4, 5, 6, 7
N_COUNTS = 8

OUTSIDE = -1  # the end of the list of a cell, and the partner of a disk that will not collide


class System(NamedTuple):
    """N disks, their next events and the cells; never changed in place by the public functions.

    Positions hold at the times in `disks[:, 4]`: use `phase_space` for positions at one time.
    """

    disks: np.ndarray  # (N, 8) float64: x, y, v_x, v_y and four times
    links: np.ndarray  # (N, 7) int64: cell, foreseen partner, numbers of collisions
    last_hit: np.ndarray  # (N,) float64: time of the last collision
    following: np.ndarray  # (N,) int32: next disk in the same cell
    first: np.ndarray  # (columns, rows) int32: first disk of each cell
    tree_time: np.ndarray  # (2P,) float64: tournament of the disks' next events, winner at 1
    tree_disk: np.ndarray  # (2P,) int32: whose event that is
    box: np.ndarray  # (3,) float64: side L, diameter σ, side of a cell
    clock: np.ndarray  # (5,) float64
    sums: np.ndarray  # (2,) float64
    counts: np.ndarray  # (8,) int64

    def copy(self) -> "System":
        """A system of its own with the same numbers."""
        return System(*(array.copy() for array in self))


class Samples(NamedTuple):
    """Scaled observables at S sample times; sums are over the interval that ends there."""

    time: np.ndarray  # (S,) s since the start, τ0
    modes: np.ndarray  # (S, 4) complex: Σ w_⊥ exp(ik·r), k along y, x, (1, 1), (1, -1)
    temperature: np.ndarray  # (S,) ⟨w²⟩/2; at the start T0 = 1/2
    fourth_moment: np.ndarray  # (S,) ⟨w⁴⟩
    collisions: np.ndarray  # (S,) int64: collisions between pairs
    energy_lost: np.ndarray  # (S,) Σ (1-α²) g_n²/4 of the scaled velocities
    virial: np.ndarray  # (S,) Σ σ|Δp|; Z - 1 = virial/(2 N T~ interval)
