"""The next events of a disk: its earliest collision with disks of given cells, and its leaving."""

import numpy as np

from .compiled import compiled
from .system import (
    CELL_SIDE,
    COLLIDES,
    COLUMN,
    DIAMETER,
    HITS,
    LEAVES_X,
    LEAVES_Y,
    MOVED,
    OUTSIDE,
    PARTNER,
    PARTNER_HITS,
    ROW,
    SIDE,
    VX,
    VY,
    X,
    Y,
)


@compiled
def nearest_image(distance, side):
    """The periodic image of a distance in (-L, L) that lies within half a side."""
    if distance > 0.5 * side:
        return distance - side
    if distance < -0.5 * side:
        return distance + side
    return distance


@compiled
def foresee(disks, links, following, first, box, disk, now, columns, rows):
    """Keep the earliest collision of a disk with those in a block of cells, if earlier than known.

    `columns` and `rows` are (first, last) offsets from the disk's own cell. Contact is the smaller
    root of |r + g t| = σ, r and g the relative position and velocity, written without cancellation
    as c/(sqrt(b² - g² c) - b) with b = r·g < 0 and c = r² - σ²; c < 0 (contact by rounding) while
    approaching means now. With four cells a side or more the nearest image is the one in the block.
    """
    side, contact = box[SIDE], box[DIAMETER] ** 2
    n_cells = first.shape[0]
    lag = now - disks[disk, MOVED]
    vx, vy = disks[disk, VX], disks[disk, VY]
    x, y = disks[disk, X] + vx * lag, disks[disk, Y] + vy * lag
    best = disks[disk, COLLIDES] - now
    partner = OUTSIDE
    for column in range(links[disk, COLUMN] + columns[0], links[disk, COLUMN] + columns[1] + 1):
        cx = column + n_cells * ((column < 0) - (column >= n_cells))
        for row in range(links[disk, ROW] + rows[0], links[disk, ROW] + rows[1] + 1):
            cy = row + n_cells * ((row < 0) - (row >= n_cells))
            other = first[cx, cy]
            while other >= 0:
                lag = now - disks[other, MOVED]
                gx, gy = disks[other, VX], disks[other, VY]
                rx = nearest_image(disks[other, X] + gx * lag - x, side)
                ry = nearest_image(disks[other, Y] + gy * lag - y, side)
                gx -= vx
                gy -= vy
                b = rx * gx + ry * gy
                c = rx * rx + ry * ry - contact
                root = b * b - (gx * gx + gy * gy) * c
                if (b < 0.0) & (root > 0.0):  # one branch, seldom taken
                    wait = max(c, 0.0) / (np.sqrt(root) - b)
                    if wait < best:
                        best = wait
                        partner = other
                other = following[other]
    if partner != OUTSIDE:
        disks[disk, COLLIDES] = now + best
        links[disk, PARTNER] = partner
        links[disk, PARTNER_HITS] = links[partner, HITS]


@compiled
def foresee_all_around(system, disk, now):
    """Forget the foreseen collision of a disk and look for the earliest in the nine cells."""
    system.disks[disk, COLLIDES] = np.inf
    system.links[disk, PARTNER] = OUTSIDE
    around = (-1, 1)
    foresee(
        system.disks,
        system.links,
        system.following,
        system.first,
        system.box,
        disk,
        now,
        around,
        around,
    )


@compiled
def time_to_side(position, velocity, cell, cell_side):
    """Time until a disk at `position` leaves its cell through one pair of sides."""
    within = position - cell * cell_side
    if velocity > 0.0:
        return max(cell_side - within, 0.0) / velocity
    if velocity < 0.0:
        return max(within, 0.0) / -velocity
    return np.inf


@compiled
def foresee_leaving(disks, links, box, disk):
    """When a disk leaves its cell, from the position and velocity just stored."""
    for axis in range(2):
        disks[disk, LEAVES_X + axis] = disks[disk, MOVED] + time_to_side(
            disks[disk, X + axis],
            disks[disk, VX + axis],
            links[disk, COLUMN + axis],
            box[CELL_SIDE],
        )


@compiled
def next_event(disks, disk):
    """Time of the earliest of a disk's three events."""
    return min(disks[disk, COLLIDES], disks[disk, LEAVES_X], disks[disk, LEAVES_Y])
