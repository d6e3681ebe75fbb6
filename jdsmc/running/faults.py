"""Faults counted in the steps, raised on the host with what to change."""

import jax
import numpy as np

from ..errors import FaultError
from .batch import point_of

TOLERATED = 1e-4
"""Share of collisions that may be missed: a tenth of the best precision asked by default. Less than
one collision is none, so that this counts from 1e4 of them on."""


def check_record(history, record) -> None:
    """Raise FaultError if a scene finds fault with the latest records, or they are not finite.

    Arguments: the history so far, without these records.
    """
    for point, scene in enumerate(history.scenes):
        own = scene.faults(point_of(record, point))
        if own:
            raise FaultError(own)
    if not all(np.all(np.isfinite(values)) for values in jax.tree.leaves(record)):
        spent = history.mean_collisions().max() if history.length else 0.0
        raise FaultError(
            f"Velocities became infinite or NaN after {spent:.1f} collisions per particle; reduce "
            "time_step, or use dtype='float64' if the temperature left the range of float32."
        )


def check_collisions(history, record) -> None:
    """Raise FaultError if collisions were lost, in the latest records or in all since the start.

    Arguments: the history so far, without these records.
    """
    accepted = np.sum(record.tally.accepted)
    overflow = np.sum(record.tally.overflow)
    if overflow > TOLERATED * accepted:
        raise FaultError(
            f"{overflow:.0f} candidate pairs had no slot ({accepted:.0f} collisions were made); "
            "reduce time_step."
        )
    total = history.total_accepted + accepted
    excess = history.total_excess + np.sum(record.tally.excess)
    if excess > max(TOLERATED * total, 1.0):
        raise FaultError(
            f"Collision probabilities above one cost {excess:.1f} of {total:.0f} collisions: the "
            "fastest pairs outran the majorant; reduce time_step (none helps if a gas of your "
            "own makes energy in collisions, or collides ever faster at small speeds)."
        )
