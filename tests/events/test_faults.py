"""What can go wrong is counted: collapse, overlap, disks that are not where they should be."""

import numpy as np
import pytest

pytest.importorskip("numba")

from jdsmc import FaultError, events
from jdsmc.events import dynamics
from jdsmc.events import system as at


def three_in_a_row():
    """Two disks run into a third at rest, all on one line; nine others rest far away."""
    density = 0.05
    diameter = density * np.sqrt(8)
    side = np.sqrt(12 / density) * diameter
    row = np.column_stack([0.3 + 2.2 * diameter * np.arange(3), np.full(3, 1.0)])
    rest = np.column_stack([0.2 + 1.3 * diameter * np.arange(9), np.full(9, 1.0 + side / 2)])
    velocities = np.zeros((12, 2))
    velocities[0, 0], velocities[2, 0] = 1.0, -1.0
    return events.place(np.concatenate([row, rest]), velocities, density)


@pytest.mark.parametrize(("restitution", "collapses"), [(0.06, True), (0.12, False)])
def test_three_disks_in_a_row_collapse_below_the_known_restitution(restitution, collapses):
    """Three on a line collapse for α < 7 - 4√3 = 0.0718 (McNamara and Young 1992).

    Just above it they meet many times in quick succession before they part.
    """
    system = events.advance(three_in_a_row(), restitution, 50.0)
    assert (events.faults(system)["collapses"] > 0) == collapses
    assert np.all(np.isfinite(system.disks[:, :4]))
    assert events.faults(system)["overlaps"] == 0


def test_a_clustering_gas_goes_on_and_its_collapses_are_counted():
    system = events.advance(events.start(500, 0.3, seed=1), 0.1, 200.0)
    faults = events.faults(system)
    assert faults.pop("collapses") > 100
    assert not any(faults.values())


def test_overlaps_and_lost_disks_are_counted_at_the_next_rescaling():
    system = events.start(100, 0.05, seed=1)
    system.disks[7, at.X : at.Y + 1] = system.disks[8, at.X : at.Y + 1] + 1e-3
    broken, _ = events.advance_scaled(system, 0.9, 0.04, 1e-6, 3, rescale_every=1)
    assert events.faults(broken)["misplaced"] > 0
    assert events.faults(broken)["overlaps"] > 0
    system.disks[7, at.VX] = np.nan
    broken, _ = events.advance_scaled(system, 0.9, 0.04, 1e-6, 3, rescale_every=1)
    assert events.faults(broken)["misplaced"] > 1


def test_a_loop_without_progress_is_refused():
    """An event that repeats at one moment for ever: a disk whose foreseen partner is itself."""
    system = events.start(20, 0.05, seed=1)
    system.disks[:, at.LEAVES_X] = 0.0
    system.disks[:, at.VX] = np.inf  # crosses from cell to cell in no time
    system.tree_time[1] = 0.0
    with pytest.raises(FaultError, match="came to a stop"):
        events.advance(system, 0.9, 1.0)
    assert dynamics.STALL_LENGTH * 20 < 1e5  # the test is fast
