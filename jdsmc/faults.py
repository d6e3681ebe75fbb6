"""Faults counted in the steps, raised on the host with what to change."""

from typing import Any

import jax
import numpy as np

TOLERATED = 1e-4
"""Share of collisions that may be missed: a tenth of the best precision asked by default."""


class FaultError(RuntimeError):
    """A run that cannot be trusted. `result` holds what was measured before, if anything."""

    result: Any = None


class NotSteadyError(FaultError):
    """No steady state was found within the budget."""


def check(scene, history, record) -> None:
    """Raise FaultError if the latest records lost collisions or hold numbers that are not finite.

    Arguments: the scene (for faults of its own), the history so far (for the total of collisions)
    and the latest records.
    """
    own = scene.faults(record)
    if own:
        raise FaultError(own)
    values = (*jax.tree.leaves(record.moments), record.elapsed)
    if not all(np.all(np.isfinite(v)) for v in values):
        raise FaultError(
            f"Velocities became infinite or NaN after {history.mean_collisions().max():.1f} "
            "collisions per particle; reduce time_step, or use dtype='float64' if the temperature "
            "left the range of float32."
        )
    accepted = np.sum(record.tally.accepted)
    overflow = np.sum(record.tally.overflow)
    if overflow > TOLERATED * accepted:
        raise FaultError(
            f"{overflow:.0f} candidate pairs had no slot ({accepted:.0f} collisions were made); "
            "reduce time_step."
        )
    total = history.total_accepted
    excess = history.total_excess
    if excess > TOLERATED * total and total > 1e4:
        raise FaultError(
            f"Collision probabilities above one cost {excess:.1f} of {total:.0f} collisions: the "
            "fastest pairs outran the majorant; reduce time_step."
        )
