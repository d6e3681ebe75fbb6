"""Random positions without overlap: disks are dropped one after another."""

from .compiled import compiled
from .predict import nearest_image
from .system import CELL_SIDE, DIAMETER, OUTSIDE, SIDE, X, Y


@compiled
def is_free(system, x, y):
    """True if a disk at (x, y) overlaps none of those dropped; also the column and row."""
    disks, side = system.disks, system.box[SIDE]
    contact, n_cells = system.box[DIAMETER] ** 2, system.first.shape[0]
    column = min(int(x / system.box[CELL_SIDE]), n_cells - 1)
    row = min(int(y / system.box[CELL_SIDE]), n_cells - 1)
    for i in range(-1, 2):
        for j in range(-1, 2):
            other = system.first[(column + i) % n_cells, (row + j) % n_cells]
            while other != OUTSIDE:
                rx = nearest_image(x - disks[other, X], side)
                ry = nearest_image(y - disks[other, Y], side)
                if rx * rx + ry * ry <= contact:
                    return False, column, row
                other = system.following[other]
    return True, column, row


@compiled
def drop(system, placed, candidates):
    """Place disks at candidates (K, 2) that are free; returns how many are placed in all.

    Random sequential addition. The lists of the cells are built on the way.
    """
    for candidate in range(candidates.shape[0]):
        if placed == system.disks.shape[0]:
            break
        x, y = candidates[candidate]
        free, column, row = is_free(system, x, y)
        if free:
            system.disks[placed, X], system.disks[placed, Y] = x, y
            system.following[placed] = system.first[column, row]
            system.first[column, row] = placed
            placed += 1
    return placed
