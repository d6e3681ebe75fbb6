"""The loop over events: collisions, and crossings from cell to cell."""

import numpy as np

from .compiled import compiled
from .predict import foresee, foresee_all_around, foresee_leaving, nearest_image, next_event
from .system import (
    BACKWARD,
    CELL_SIDE,
    COLLAPSES,
    COLLIDES,
    COLLISIONS,
    COLUMN,
    CROSSINGS,
    DIAMETER,
    ENERGY_LOST,
    GROWTH_RATE,
    HASTE,
    HITS,
    LEAVES_X,
    LEAVES_Y,
    MOVED,
    OUTDATED,
    OUTSIDE,
    OVERLAPS,
    PARTNER,
    PARTNER_HITS,
    PRECEDING,
    ROW,
    SIDE,
    STALLED,
    TIME,
    VIRIAL,
    VX,
    VY,
    X,
    Y,
)
from .tree import enter

CONTACT_ROUNDING = 1e-9
"""Largest relative deviation of r² from σ² at a collision; rounding leaves about 1e-13."""
COLLAPSE_INTERVAL = 1e-6
"""Collisions of a disk follow each other more quickly than this in a collapse.

In τ0 of the clock in use: scaled time, or plain time, in which a gas that cools slows down.
"""
COLLAPSE_LENGTH = 8
"""So many quick intervals in a row are called a collapse: by chance 1e-40 at low density."""
STALL_LENGTH = 1000
"""Events per disk at one and the same time that stop the loop."""


@compiled
def move(system, disk, now):
    """Bring the stored position of a disk to the present.

    It lies in the box, to rounding, since `cross` carries it over when the disk leaves.
    """
    disks = system.disks
    lag = now - disks[disk, MOVED]
    disks[disk, X] += disks[disk, VX] * lag
    disks[disk, Y] += disks[disk, VY] * lag
    disks[disk, MOVED] = now


@compiled
def in_collapse(system, one, other, now):
    """True if either disk has had too many collisions in quick succession; counts the interval."""
    links, last_hit = system.links, system.last_hit
    quick = now - max(last_hit[one], last_hit[other]) < COLLAPSE_INTERVAL
    longest = max(links[one, HASTE], links[other, HASTE]) + 1 if quick else 0
    links[one, HASTE] = links[other, HASTE] = longest
    last_hit[one] = last_hit[other] = now
    return longest >= COLLAPSE_LENGTH


@compiled
def collide(system, one, other, now, restitution):
    """Two disks at contact: v1' = v1 - (1+α)/2 (g·σ̂)σ̂, v2' the opposite (eq. 1).

    A collision within an inelastic collapse is made elastic and counted (the TC model of Luding
    and McNamara 1998, with the number of quick collisions in place of a single interval).
    """
    disks, counts = system.disks, system.counts
    move(system, one, now)
    move(system, other, now)
    side, diameter = system.box[SIDE], system.box[DIAMETER]
    rx = nearest_image(disks[one, X] - disks[other, X], side)
    ry = nearest_image(disks[one, Y] - disks[other, Y], side)
    distance = np.sqrt(rx * rx + ry * ry)
    counts[OVERLAPS] += abs((distance / diameter) ** 2 - 1.0) > CONTACT_ROUNDING
    rx, ry = rx / distance, ry / distance
    if in_collapse(system, one, other, now):
        restitution = 1.0
        counts[COLLAPSES] += 1
    gx, gy = disks[one, VX] - disks[other, VX], disks[one, VY] - disks[other, VY]
    normal = gx * rx + gy * ry
    kick = 0.5 * (1.0 + restitution) * normal
    disks[one, VX] -= kick * rx
    disks[one, VY] -= kick * ry
    disks[other, VX] += kick * rx
    disks[other, VY] += kick * ry
    scale = 1.0 + system.clock[GROWTH_RATE] * now  # w = v (1 + μt), eq. 6
    system.sums[ENERGY_LOST] += 0.25 * (1.0 - restitution**2) * (scale * normal) ** 2
    system.sums[VIRIAL] += diameter * abs(scale * kick)
    counts[COLLISIONS] += 1
    system.links[one, HITS] += 1
    system.links[other, HITS] += 1


@compiled
def remove(links, following, first, disk):
    """Take a disk out of the list of its cell."""
    before, after = links[disk, PRECEDING], following[disk]
    if before == OUTSIDE:
        first[links[disk, COLUMN], links[disk, ROW]] = after
    else:
        following[before] = after
    if after != OUTSIDE:
        links[after, PRECEDING] = before


@compiled
def insert(links, following, first, disk):
    """Put a disk at the head of the list of its cell."""
    column, row = links[disk, COLUMN], links[disk, ROW]
    after = first[column, row]
    following[disk] = after
    links[disk, PRECEDING] = OUTSIDE
    if after != OUTSIDE:
        links[after, PRECEDING] = disk
    first[column, row] = disk


@compiled
def cross(system, disk, now):
    """Into the next cell; three cells have come near, where an earlier collision may wait."""
    disks, links, following, first = system.disks, system.links, system.following, system.first
    axis = 0 if disks[disk, LEAVES_X] <= disks[disk, LEAVES_Y] else 1
    velocity = disks[disk, VX + axis]
    step = 1 if velocity > 0.0 else -1
    n_cells = first.shape[0]
    remove(links, following, first, disk)
    index = links[disk, COLUMN + axis] + step
    around = (index < 0) - (index >= n_cells)  # once around the box
    links[disk, COLUMN + axis] = index + n_cells * around
    disks[disk, X + axis] += system.box[SIDE] * around
    insert(links, following, first, disk)
    disks[disk, LEAVES_X + axis] += system.box[CELL_SIDE] / abs(velocity)
    ahead, across = (step, step), (-1, 1)
    columns, rows = (ahead, across) if axis == 0 else (across, ahead)
    foresee(disks, links, following, first, system.box, disk, now, columns, rows)
    system.counts[CROSSINGS] += 1


@compiled
def foresee_both(system, one, other, now):
    """All events of two disks that have just collided."""
    for disk in (one, other):
        foresee_leaving(system.disks, system.links, system.box, disk)
        foresee_all_around(system, disk, now)
        enter(system.tree_time, system.tree_disk, disk, next_event(system.disks, disk))


@compiled
def run_until(system, restitution, end):
    """Every event up to the time `end`, in order. Changes the arrays of the system."""
    tree_time, tree_disk, counts = system.tree_time, system.tree_disk, system.counts
    disks, links = system.disks, system.links
    now = system.clock[TIME]
    patience = STALL_LENGTH * disks.shape[0]
    events_at_once = 0
    while tree_time[1] <= end and events_at_once < patience:
        disk = np.int64(tree_disk[1])
        counts[BACKWARD] += tree_time[1] < now
        events_at_once = events_at_once + 1 if tree_time[1] <= now else 0
        now = tree_time[1]
        if disks[disk, COLLIDES] > now:
            cross(system, disk, now)
        else:
            partner = links[disk, PARTNER]
            if links[disk, PARTNER_HITS] == links[partner, HITS]:
                collide(system, disk, partner, now, restitution)
                foresee_both(system, disk, partner, now)
                continue
            counts[OUTDATED] += 1  # the partner has been hit by another disk meanwhile
            foresee_all_around(system, disk, now)
        enter(tree_time, tree_disk, disk, next_event(disks, disk))
    counts[STALLED] += events_at_once >= patience
    system.clock[TIME] = end
