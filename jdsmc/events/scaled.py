"""The stationary representation: samples, rescaling, and the lists rebuilt."""

import numpy as np

from .compiled import compiled
from .dynamics import CONTACT_ROUNDING, insert, move, run_until
from .predict import foresee_all_around, foresee_leaving, nearest_image, next_event
from .system import (
    CELL_SIDE,
    COLLISIONS,
    COLUMN,
    DIAMETER,
    ELAPSED,
    GROWTH_RATE,
    MISPLACED,
    MOVED,
    OUTSIDE,
    OVERLAPS,
    ROW,
    SAMPLES,
    SCALED_TIME,
    SIDE,
    STALLED,
    TIME,
    VX,
    VY,
    X,
    Y,
)
from .tree import play_all


@compiled
def scale_now(system):
    """w/v = e^{μs} = 1 + μt since the last rescaling (eqs. 6, 7)."""
    return 1.0 + system.clock[GROWTH_RATE] * system.clock[TIME]


@compiled
def check_places(system):
    """Count disks that are not within their recorded cell at the present time, or are nowhere."""
    disks, links = system.disks, system.links
    side, cell_side = system.box[SIDE], system.box[CELL_SIDE]
    margin = 1e-9 * side
    for disk in range(disks.shape[0]):
        for axis in range(2):
            lag = system.clock[TIME] - disks[disk, MOVED]
            position = disks[disk, X + axis] + disks[disk, VX + axis] * lag
            within = position - links[disk, COLUMN + axis] * cell_side
            if not -margin <= within <= cell_side + margin:  # true also of NaN
                system.counts[MISPLACED] += 1


@compiled
def check_overlaps(system):
    """Count pairs closer than a diameter by more than rounding; all positions at one time."""
    disks, links, side = system.disks, system.links, system.box[SIDE]
    contact = system.box[DIAMETER] ** 2 * (1.0 - CONTACT_ROUNDING)
    n_cells = system.first.shape[0]
    for disk in range(disks.shape[0]):
        for column in range(-1, 2):
            for row in range(-1, 2):
                cx, cy = links[disk, COLUMN] + column, links[disk, ROW] + row
                other = system.first[cx % n_cells, cy % n_cells]
                while other > disk:  # the lists descend after a rebuild: each pair once
                    rx = nearest_image(disks[disk, X] - disks[other, X], side)
                    ry = nearest_image(disks[disk, Y] - disks[other, Y], side)
                    system.counts[OVERLAPS] += rx * rx + ry * ry < contact
                    other = system.following[other]


@compiled
def rebuild(system):
    """Cells, all next events and their tournament, from positions that hold at time zero."""
    disks, links, box = system.disks, system.links, system.box
    n_disks, n_cells = disks.shape[0], system.first.shape[0]
    system.first[:] = OUTSIDE
    for disk in range(n_disks):
        for axis in range(2):
            index = int(disks[disk, X + axis] / box[CELL_SIDE])
            links[disk, COLUMN + axis] = max(min(index, n_cells - 1), 0)  # rounding, and NaN
        insert(links, system.following, system.first, disk)
    check_overlaps(system)
    leaves = system.tree_time.size // 2
    system.tree_time[:] = np.inf
    for disk in range(n_disks):
        foresee_leaving(disks, links, box, disk)
        foresee_all_around(system, disk, 0.0)
        system.tree_time[leaves + disk] = next_event(disks, disk)
        system.tree_disk[leaves + disk] = disk
    play_all(system.tree_time, system.tree_disk)


@compiled
def rescale(system, growth_rate):
    """v *= e^{μs}, no net momentum, t = s = 0; from here on the growth rate given."""
    disks, clock = system.disks, system.clock
    check_places(system)
    scale, now = scale_now(system), clock[TIME]
    n_disks, mean_x, mean_y = disks.shape[0], 0.0, 0.0
    for disk in range(disks.shape[0]):
        move(system, disk, now)
        disks[disk, MOVED] = 0.0
        system.last_hit[disk] = (system.last_hit[disk] - now) / scale
        disks[disk, VX] *= scale
        disks[disk, VY] *= scale
        mean_x += disks[disk, VX] / n_disks
        mean_y += disks[disk, VY] / n_disks
    for disk in range(n_disks):
        disks[disk, VX] -= mean_x
        disks[disk, VY] -= mean_y
    clock[ELAPSED] += clock[SCALED_TIME]
    clock[TIME] = clock[SCALED_TIME] = clock[SAMPLES] = 0.0
    clock[GROWTH_RATE] = growth_rate
    rebuild(system)


@compiled
def sample(system, modes, moments):
    """Transverse modes (4, 2) and Σw², Σw⁴ at the present time; the system is only read."""
    disks = system.disks
    wave_number = 2.0 * np.pi / system.box[SIDE]
    scale = scale_now(system)
    half = np.sqrt(0.5)
    modes[:], moments[:] = 0.0, 0.0
    for disk in range(disks.shape[0]):
        vx, vy = disks[disk, VX], disks[disk, VY]
        lag = system.clock[TIME] - disks[disk, MOVED]
        x, y = wave_number * (disks[disk, X] + vx * lag), wave_number * (disks[disk, Y] + vy * lag)
        wx, wy = scale * vx, scale * vy
        cx, sx, cy, sy = np.cos(x), np.sin(x), np.cos(y), np.sin(y)
        modes[0, 0] += wx * cy
        modes[0, 1] += wx * sy
        modes[1, 0] += wy * cx
        modes[1, 1] += wy * sx
        across = half * (wx - wy)
        modes[2, 0] += across * (cx * cy - sx * sy)
        modes[2, 1] += across * (sx * cy + cx * sy)
        across = half * (wx + wy)
        modes[3, 0] += across * (cx * cy + sx * sy)
        modes[3, 1] += across * (sx * cy - cx * sy)
        square = wx * wx + wy * wy
        moments[0] += square
        moments[1] += square * square


@compiled
def run_samples(system, restitution, interval, rescale_every, records):
    """Advance from sample to sample and fill the records. Stops early if the loop has stalled."""
    clock = system.clock
    time, modes, moments, collisions, sums = records
    for place in range(time.size):
        if clock[SAMPLES] >= rescale_every:
            rescale(system, clock[GROWTH_RATE])
        before = system.counts[COLLISIONS]
        clock[SCALED_TIME] += interval
        clock[SAMPLES] += 1
        rate = clock[GROWTH_RATE]
        end = clock[SCALED_TIME] if rate == 0.0 else np.expm1(rate * clock[SCALED_TIME]) / rate
        run_until(system, restitution, end)
        time[place] = clock[ELAPSED] + clock[SCALED_TIME]
        sample(system, modes[place], moments[place])
        collisions[place] = system.counts[COLLISIONS] - before
        for kind in range(system.sums.size):
            sums[place, kind] = system.sums[kind]
            system.sums[kind] = 0.0
        if system.counts[STALLED] > 0:
            return
