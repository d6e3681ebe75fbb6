"""A tournament of the next events of all disks: the earliest one is at the root, place 1.

Disk i plays at the leaf P + i, with P a power of two; free leaves hold infinity. Each node keeps
the time and the disk of the winner below it, so that reading the next event costs nothing and a
new time costs one comparison per level.
"""

import numpy as np

from .compiled import compiled


@compiled
def enter(tree_time, tree_disk, disk, time):
    """Give a disk a new time, and replay its way to the root."""
    node = tree_time.size // 2 + disk
    tree_time[node] = time
    winner = np.int32(disk)
    while node > 1:
        rival = node ^ 1
        rival_time = tree_time[rival]
        if rival_time < time:
            time = rival_time
            winner = tree_disk[rival]
        node >>= 1
        if tree_disk[node] == winner and tree_time[node] == time:
            return  # nothing above can change
        tree_time[node] = time
        tree_disk[node] = winner


@compiled
def play_all(tree_time, tree_disk):
    """Every match anew, from times at the leaves."""
    for node in range(tree_time.size // 2 - 1, 0, -1):
        winner = 2 * node + (tree_time[2 * node + 1] < tree_time[2 * node])
        tree_time[node] = tree_time[winner]
        tree_disk[node] = tree_disk[winner]
