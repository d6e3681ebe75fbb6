"""When a gas is steady: no drift between early and late blocks, tested across realizations."""

import numpy as np

from .history import History
from .stats import drift_significance

FIRST_TEST = 10.0
"""Collisions per particle before the first test."""

GROWTH = 1.25
"""Tests are made when the time has grown by this factor, so that few are made by chance."""

ACCEPT, REJECT = 0.02, 0.001
"""Significances: a warm-up ends only without a hint of drift; a measurement is cut on evidence."""


class SteadyTracker:
    """Finds, for each point of a sweep, the record from which it is steady.

    Warm-up: the last half of the collisions so far is cut in two; if no monitored moment differs
    between the two blocks, measuring starts *now* (what remains of an exponential approach is then
    several times smaller than what the test could miss). Measurement: its first quarter is
    compared with the rest whenever it has grown by a quarter, and dropped if it differs. Every
    test is across realizations, which share no drift by chance.
    """

    def __init__(self, points: int, monitored: tuple[str, ...], first_test: float = FIRST_TEST):
        self.monitored = monitored
        self.start = np.full(points, -1)
        self._next_test = np.full(points, max(FIRST_TEST, first_test))

    def update(self, history: History) -> None:
        """Test every point that is due."""
        collisions = history.mean_collisions()
        for point in range(len(self.start)):
            if collisions[point] < self._next_test[point]:
                continue
            if self.start[point] < 0:
                self._end_warm_up(history, point, collisions[point])
            else:
                self.confirm(history, point)
                self._next_test[point] = self._grown(history, point, collisions[point])

    def _end_warm_up(self, history: History, point: int, collisions: float) -> None:
        half, three_quarters = (
            history.record_at_collisions(point, share * collisions) for share in (0.5, 0.75)
        )
        if not half < three_quarters < history.length:  # records too long to tell
            self._next_test[point] = GROWTH * collisions
        elif self._significance(history, point, half, three_quarters, history.length) > ACCEPT:
            self.start[point] = history.length
            self._next_test[point] = collisions + FIRST_TEST
        else:
            self._next_test[point] = GROWTH * collisions

    def _grown(self, history: History, point: int, collisions: float) -> float:
        first = min(self.start[point], history.length - 1)
        began = np.mean(history["collisions"][point, :, first])
        return float(began + GROWTH * max(collisions - began, FIRST_TEST))

    def confirm(self, history: History, point: int) -> bool:
        """True if the measurement shows no drift; otherwise its first quarter is dropped."""
        first, last = int(self.start[point]), history.length
        quarter = first + (last - first) // 4
        if quarter - first < 2:
            return False
        if self._significance(history, point, first, quarter, last) > REJECT:
            return True
        self.start[point] = quarter
        return False

    def _significance(self, history: History, point: int, first, middle, last) -> float:
        """Smallest significance of a drift of the monitored moments between two windows."""
        early, late = history.point(point, first, middle), history.point(point, middle, last)
        return min(float(drift_significance(early[n], late[n])) for n in self.monitored)

    @property
    def all_measuring(self) -> bool:
        """True once every point has left its warm-up."""
        return bool(np.all(self.start >= 0))
