"""When a gas is steady: after a number of its slow times, and without a drift that shows.

A test for drift can only see what exceeds the noise, so it is never asked alone. The scene's slow
time (`approach.Approach`) tells how much of any change seen between an early and a late window is
still to come; this and twice the uncertainty of the change itself must be small against the
error that is printed, for each observable.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise

import numpy as np

from ..scenarios.approach import Approach
from ..stats import drift_significance, variogram_ratio
from .history import History

FIRST_TEST = 10.0
"""Collisions per particle before the first test."""

GROWTH = 1.25
"""Tests are made when the time has grown by this factor, so that few are made by chance."""

ACCEPT, REJECT = 0.02, 0.001
"""Significances: a warm-up ends only without a hint of drift; a measurement is cut on evidence."""

SAFETY = 1.2
"""Slow times are taken this much longer than the kinetic model says."""

LEAST = 3.0
"""Slow times of a warm-up from a distance of 1: realizations, which start alike, have then the
scatter that makes their error bars."""

TOLERANCE = 0.5
"""Largest bias, as a share of the standard error."""

EARLY = (0.5, 0.25)
"""Share of the warm-up at which the window ends that a measurement is compared with begins: either
may tell. The longer one has less noise, and of the slow mode more."""

LATEST, LATER = 0.6, 1.15
"""Share of the run at which a measurement may begin at the latest; factor of the starts tried."""

BLOCKS = 16
"""Blocks of a measurement whose correlation is looked at where the slow time is not known."""

CORRELATED = 1.6
"""Largest variogram over four blocks relative to one: it is 1 if the slow time is short, 1.4 for
20 of them in the whole, 5.5 for a random walk; the estimate for 8 realizations scatters by 0.3."""

Drift = Callable[[History, int, int, int], tuple[dict, dict, dict]]
"""(history, point, early, start) -> change of the observables from the records [early, start) to
those from start on, its standard error, and that of the observables themselves."""


class SteadyTracker:
    """Finds, for each point of a sweep, the record from which it is steady.

    Arguments: the slow time of each point; names of the averages tested for drift; `drift`, how
    the observables differ between two windows (None: not asked).

    Known slow time: measuring starts after LEAST of them, and more from afar. Unknown: the last
    half of the run so far is measured once it shows no drift against the quarter before it and
    no correlation over a sixteenth of it; that sixteenth then is the slow time, unless the scene
    knows a longer one. From then on the
    first quarter of the measurement is compared with the rest whenever it has grown by a quarter,
    and dropped if it differs. `settled` has the last word.
    """

    def __init__(
        self,
        approaches: Sequence[Approach],
        monitored: tuple[str, ...],
        drift: Drift | None = None,
    ):
        self.monitored = monitored
        self.start = np.full(len(approaches), -1)
        self.certain = np.array([a.certain for a in approaches])
        self.slow_time = SAFETY * np.array([a.collisions for a in approaches])
        distance = np.array([a.distance for a in approaches])
        needed = np.maximum(FIRST_TEST, self.slow_time * (LEAST + distance))
        self.least = np.where(self.certain, needed, np.maximum(4.0 * FIRST_TEST, 2.0 * needed))
        self._drift = drift
        self._next_test = self.least.copy()

    def state(self) -> dict:
        """What it has found, arrays (points,); `take` puts it back."""
        return {
            "start": self.start.copy(),
            "slow_time": self.slow_time.copy(),
            "next_test": self._next_test.copy(),
        }

    def take(self, state: dict) -> None:
        """Become the tracker that gave this `state`."""
        self.start, self.slow_time, self._next_test = (
            np.array(state[name]) for name in ("start", "slow_time", "next_test")
        )

    def update(self, history: History) -> None:
        """Test every point that is due."""
        collisions = history.least_collisions()
        for point in range(len(self.start)):
            if collisions[point] < self._next_test[point]:
                continue
            if self.start[point] < 0:
                self._end_warm_up(history, point, collisions[point])
            else:
                self.confirm(history, point)
                self._next_test[point] = self._grown(history, point, collisions[point])

    def _end_warm_up(self, history: History, point: int, collisions) -> None:
        self._next_test[point] = GROWTH * collisions
        if self.certain[point]:
            self.start[point] = history.length
            self._next_test[point] = collisions + FIRST_TEST
            return
        quarter, half = (history.record_at_collisions(point, x * collisions) for x in (0.25, 0.5))
        if not 0 < quarter < half or history.length - half < BLOCKS:  # records too long to tell
            return
        drift = self._significance(history, point, quarter, half, history.length)
        if drift > ACCEPT and self._decorrelated(history, point, half):
            self.start[point] = half
            self.slow_time[point] = max(self.slow_time[point], 0.5 * collisions / BLOCKS)

    def _grown(self, history: History, point: int, collisions: float) -> float:
        began = self._collisions_at(history, point, self.start[point])
        return float(began + GROWTH * max(collisions - began, FIRST_TEST))

    @staticmethod
    def _collisions_at(history: History, point: int, record) -> float:
        return float(np.min(history["collisions"][point, :, min(record, history.length - 1)]))

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

    def settled(self, history: History) -> np.ndarray:
        """For each point, True if no observable can still be off by a good part of its error.

        A start that is too early for that is moved on, as far as to the middle of the run.
        """
        return np.array([self._settled(history, point) for point in range(len(self.start))])

    def _settled(self, history: History, point: int) -> bool:
        if self.start[point] < 0:
            return False
        end = float(history.least_collisions()[point])
        latest = max(LATEST * end, self.least[point])
        first = -1
        while not self.confirm(history, point):
            if self.start[point] == first:
                return False
            first = self.start[point]
        if not self.certain[point] and not self._decorrelated(history, point, self.start[point]):
            return False
        began = self._collisions_at(history, point, self.start[point])
        while began <= latest:
            start = history.record_at_collisions(point, began)
            if history.length - start < 2:
                return False
            if self._resolved(history, point, start, began, end):
                moved = start > self.start[point]
                self.start[point] = start
                return not moved or self.confirm(history, point)
            began *= LATER
        return False

    def _resolved(self, history: History, point: int, start: int, began, end) -> bool:
        return any(self._resolved_from(history, point, e * began, start, end) for e in EARLY)

    def _resolved_from(self, history: History, point: int, early, start: int, end) -> bool:
        first = history.record_at_collisions(point, early)
        if not first < start:
            return False
        if self._drift is None:
            return True
        began = self._collisions_at(history, point, start)
        share = left_over(early, began, end, self.slow_time[point])
        change, uncertainty, error = self._drift(history, point, first, start)
        for name in change:
            if known(error[name]) and not (known(change[name]) and known(uncertainty[name])):
                return False  # too short a window for what is fitted to it
            moved, doubt, allowed = (rms(x[name]) for x in (change, uncertainty, error))
            if share * (moved + 2.0 * doubt) > TOLERANCE * allowed + 1e-9 * moved:
                return False
        return True

    def _decorrelated(self, history: History, point: int, first) -> bool:
        edges = np.linspace(first, history.length, BLOCKS + 1).astype(int)
        if np.min(np.diff(edges)) < 1:
            return False
        blocks = [history.monitored(point, a, b, self.monitored) for a, b in pairwise(edges)]
        series = (np.stack([b[name] for b in blocks], axis=1) for name in self.monitored)
        return all(variogram_ratio(values) < CORRELATED for values in series)

    def _significance(self, history: History, point: int, first, middle, last) -> float:
        """Smallest significance of a drift of the monitored moments between two windows."""
        early, late = (
            history.monitored(point, a, b, self.monitored)
            for a, b in ((first, middle), (middle, last))
        )
        return min(smallest_significance(early[n], late[n]) for n in self.monitored)

    @property
    def all_measuring(self) -> bool:
        """True once every point has left its warm-up."""
        return bool(np.all(self.start >= 0))

    @property
    def may_be_measured(self) -> bool:
        """True unless records made now are warm-up for certain, at every point."""
        return bool(np.any((self.start >= 0) | ~self.certain))


def smallest_significance(early: np.ndarray, late: np.ndarray) -> float:
    """Of a drift of any component, which are as many chances (Bonferroni)."""
    each = drift_significance(early, late, axis=0)
    return float(np.min(each)) * each.size


def known(values) -> bool:
    """True if any of them is a number."""
    return bool(np.any(np.isfinite(values)))


def rms(values) -> float:
    """Root of the mean square of what is finite: a profile is judged as one, 0 if there is none."""
    finite = np.ravel(values)[np.isfinite(np.ravel(values))]
    return float(np.sqrt(np.mean(finite**2))) if finite.size else 0.0


def left_over(early, began, end, slow_time) -> float:
    """Mean of exp(-s/slow_time) from `began` to `end` over that from `early` to `began`.

    With a change d seen between the two windows the late one is still off by this times d, or a
    little more, as long as it is small.
    """
    before, after = (began - early) / slow_time, max(end - began, 1e-9) / slow_time
    ratio = (before / after) * np.exp(-before) * np.expm1(-after) / np.expm1(-before)
    return float(ratio / max(1.0 - ratio, 1e-3))


class NothingToSettle:
    """The tracker of a scene that starts steady (it monitors nothing): measured from the start."""

    def __init__(self, points: int):
        self.start = np.zeros(points, int)
        self.least = np.zeros(points)
        self.all_measuring = self.may_be_measured = True

    def state(self) -> dict:
        """Where measurements start, (points,)."""
        return {"start": self.start.copy()}

    def take(self, state: dict) -> None:
        """Become the tracker that gave this `state`."""
        self.start = np.array(state["start"])

    def update(self, history: History) -> None:
        """Nothing to be found."""

    def settled(self, history: History) -> np.ndarray:
        """Every point, from the first record on."""
        return np.full(len(self.start), history.length > 0)


def tracker_for(
    approaches: Sequence[Approach], monitored: tuple[str, ...], drift: Drift | None = None
) -> "SteadyTracker | NothingToSettle":
    """The tracker of a scene."""
    if not monitored:
        return NothingToSettle(len(approaches))
    return SteadyTracker(approaches, monitored, drift)
