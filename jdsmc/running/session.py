"""A run under way, of any scene: engine, history, steady-state tracker, precision."""

from collections.abc import Callable

import jax.numpy as jnp
import numpy as np

from .. import check
from ..derivatives.request import Request
from ..derivatives.samples import Samples
from ..errors import FaultError
from ..scenarios.options import Options
from ..stats import BLOCKS
from . import faults
from .compiled import keep_programs
from .devices import check_devices
from .engine import Engine
from .estimates import printed_estimates, realization_estimates, steady_changes
from .history import History
from .host_engine import HostEngine
from .limits import Limits
from .memory import room_for
from .steady import tracker_for

PATIENCE, SLACK = 10.0, 1_000.0
"""A run may take ten times as many steps as hard spheres in equilibrium would need for the
collisions it may spend, and a thousand more: a gas that hardly collides ends too."""


class Session:
    """What a run has come to. `advance` makes one chunk, `ending` says why to stop.

    Arguments: the scene of each point, realizations of each, seed, options, limits; what to take
    derivatives to, if anything.
    """

    def __init__(
        self,
        scenes,
        n_realizations: int,
        seed: int,
        options: Options,
        limits: Limits,
        request: Request | None = None,
    ):
        self.options, self.limits, self.request = options, limits, request
        sampler = None if request is None else request.sampler
        self.samples = None if sampler is None else Samples(sampler)
        check_devices()
        check.untraced(type(scenes[0]).__name__, [jnp.zeros(())])  # within jit, all is traced
        keep_programs()
        self.gases = len(scenes) * n_realizations
        with room_for(self.gases, options):
            self.engine = (
                Engine(scenes, n_realizations, seed, options, sampler)
                if scenes[0].traced
                else HostEngine(scenes, n_realizations, seed, options)
            )
        self.history = History(scenes, options.n_particles, options.steps)
        drift = None if scenes[0].correlated else steady_changes
        self.correlated = scenes[0].correlated
        self.tracker = tracker_for(limits.approaches, scenes[0].monitored, drift)
        self.precision = self.share = np.inf
        self.failed = self.broken_off = False
        self.unsettled = self.tracker.state()
        """What the tracker had found before it was asked for the last word, which a run that goes
        on must not know of."""
        self._settled = np.zeros(len(scenes), bool)
        self._asked_at = -1
        self._next_look = self._next_check = 0.0

    def state(self) -> dict:
        """What the run has come to, one pytree of NumPy arrays and numbers: a checkpoint.

        `take` of a session made with the same arguments goes on from it to the bit.
        """
        return {
            "engine": self.engine.all_states(),
            "chunks": self.engine.chunks,
            "history": self.history.state(),
            "tracker": self.unsettled,
            "samples": None if self.samples is None else self.samples.state(),
            "next_look": self._next_look,
            "next_check": self._next_check,
            "failed": self.failed,
        }

    def take(self, state: dict) -> None:
        """Become the session that gave this `state`."""
        self.engine.take(state["engine"], int(state["chunks"]))
        self.history.take(state["history"])
        self.tracker.take(state["tracker"])
        if self.samples is not None:
            self.samples.take(state["samples"])
        self._next_look, self._next_check = float(state["next_look"]), float(state["next_check"])
        self.unsettled, self._asked_at = self.tracker.state(), -1
        self.failed = bool(state["failed"])

    def go_on(self, limits: Limits) -> None:
        """Take other limits, as if they had been asked for from the start."""
        self.limits = limits
        self.tracker.take(self.unsettled)
        self.precision = self.share = np.inf
        self.failed, self._asked_at = False, -1

    def advance(self) -> None:
        """One chunk, its faults checked, and the steady state looked for."""
        self.broken_off = True  # until the chunk is in the history
        sampler = None if self.samples is None else self.samples.sampler
        watch = sampler is not None and (sampler.each or self.tracker.may_be_measured)
        with room_for(self.gases, self.options):
            record, sample = self.engine.advance(watch)
        faults.check_record(self.history, record)
        faults.check_collisions(self.history, record)
        if self.samples is not None and watch:
            self.samples.extend(self.engine.watched, record.elapsed, self.history.length)
        self.history.append(record, sample)
        self.broken_off = False
        if self.history.length >= self._next_check:
            self._next_check = 1.5 * self.history.length
            self._look_for_trouble()
        if self.limits.can_be_steady:
            self.tracker.update(self.history)
        self.unsettled = self.tracker.state()

    def _look_for_trouble(self) -> None:
        """Raise FaultError if a scene finds fault with the later half of the run so far."""
        for point, scene in enumerate(self.history.scenes):
            half = self.history.length // 2
            trouble = scene.trouble(*self.history.window(point, half, self.history.length))
            if trouble:
                raise FaultError(trouble)

    @property
    def spent(self) -> float:
        """Collisions per particle of the point that is least far."""
        return float(np.min(self.history.mean_collisions())) if self.history.length else 0.0

    def ending(self) -> str:
        """Why to stop now, or an empty string; to ask leaves no trace in a run that goes on."""
        ending = self._ending()
        if not ending:
            self.tracker.take(self.unsettled)
            self._asked_at = -1
        return ending

    def _ending(self) -> str:
        limits = self.limits
        due = self.tracker.all_measuring and self.spent >= self._next_look
        if due:
            self._next_look = (1.2 if self.correlated else 1.05) * self.spent
        if limits.fixed:
            if self.progress() >= 1.0:
                return self._time_ended()
            return "" if limits.collisions is None else self._hardly_collides(limits.collisions)
        if due and self._precise() and self.is_settled() and self._precise():
            return (
                f"{limits.named} {limits.verb} known to {self.precision:.2g} (asked {limits.asked})"
            )
        if limits.records is not None and self.history.length >= limits.records:
            self._look()
            return (
                f"{limits.records} records were made: {limits.named} {limits.verb} known to "
                f"{self.precision:.2g}"
            )
        if self.spent >= limits.budget:
            return self._budget_ended(f"{limits.budget:g} collisions per particle")
        few = self._hardly_collides(limits.budget)
        return self._budget_ended(few) if few else ""

    def _hardly_collides(self, wanted: float) -> str:
        """A clause if far more steps were made than hard spheres need for so many collisions."""
        steps = self.history.length * self.options.steps
        if steps < PATIENCE * (wanted + SLACK) * np.sqrt(np.pi) / self.options.time_step:
            return ""
        return (
            f"{steps} time steps, in which the gas made only {self.spent:.3g} of {wanted:g} "
            "collisions per particle"
        )

    def _budget_ended(self, budget: str) -> str:
        """What was tested when a budget ended, and what is known or must be done."""
        limits = self.limits
        if self.is_settled():
            self._look()
        else:
            self.precision = self.share = np.inf
        drift = f"a drift of {', '.join(limits.monitored)}" if limits.monitored else "nothing"
        if np.isfinite(self.precision):
            every = "" if self.correlated else ", and every observable for a slower change"
            return (
                f"the budget of {budget} ended: {limits.named} {limits.verb} known to "
                f"{self.precision:.2g}, asked {limits.asked}; tested were {drift}{every}"
            )
        self.failed = True
        tested = self._unsteady()
        if not self.tracker.all_measuring:
            tested += f", tested was {drift} only"
        return (
            f"no steady state within {budget}: {tested}, {limits.slowest()}. Raise "
            "budget, start nearer to the steady state, or give duration."
        )

    def _time_ended(self) -> str:
        """That the asked time is over, and why there are no steady values if there are none."""
        over, limits = "the asked time was simulated", self.limits
        if not limits.can_be_steady or self.is_settled():
            return over
        return f"{over}, too short for steady values: {self._unsteady()}, {limits.slowest()}"

    def _unsteady(self) -> str:
        if self.tracker.all_measuring:
            return "what is measured still changes, or may change by more than its error"
        warm = int(np.sum(self.tracker.start < 0))
        return f"the warm-up had not ended at {warm} of {len(self.tracker.start)} points"

    def is_settled(self) -> bool:
        """True if what is measured may be printed as steady at every point."""
        return bool(np.all(self.settled()))

    def settled(self) -> np.ndarray:
        """The same of each point; asked once for each length of the history."""
        if self._asked_at != self.history.length:
            self._asked_at = self.history.length
            self._settled = self.tracker.settled(self.history)
        return self._settled

    def _precise(self) -> bool:
        """Look, and tell if it is enough; a start that was moved on has less to show."""
        if not self._long_enough():
            return False
        self._look(unless_too_large=True)
        return self.share <= 1.0

    def _long_enough(self) -> bool:
        """True if no scene finds the measurement too short for error bars."""
        history, starts = self.history, self.tracker.start
        return bool(np.all(starts < history.length)) and all(
            scene.long_enough(*history.window(p, int(starts[p]), history.length))
            for p, scene in enumerate(history.scenes)
        )

    def _look(self, unless_too_large: bool = False) -> None:
        """Relative error at the worst point: the largest, and the largest in units of `rtol`.

        As they would be printed, that is the larger of two: a run that stops when one estimate
        happens to be small would print errors that are too small. `unless_too_large`: the second is
        left out if the first says already that the run must go on.
        """
        if not self.tracker.all_measuring:
            return
        rtol, points = self.limits.rtol, range(len(self.tracker.start))
        for estimates in (realization_estimates, printed_estimates):
            errors = [self._relative_errors(point, estimates) for point in points]
            self.precision = float(np.max([list(point.values()) for point in errors]))
            self.share = float(np.max([point[n] / rtol[n] for point in errors for n in rtol]))
            if unless_too_large and self.share > 1.0:
                return

    def _relative_errors(self, point: int, estimates: Callable) -> dict[str, float]:
        """The relative errors of the observables asked for."""
        first = int(self.tracker.start[point])
        least = 1 if self.correlated or self.limits.records is not None else 2 * BLOCKS
        if self.history.length - first < least:
            return dict.fromkeys(self.limits.observables, np.inf)
        value, error, _ = estimates(self.history, point, first, self.limits.observables)
        unknown = [name for name in value if np.any(np.isnan(value[name]))]
        if unknown and not self.correlated:
            raise FaultError(
                f"{unknown[0]} is not a number at some of what was run, so that it is never known "
                "to a precision; name another observable."
            )
        return {name: float(np.max(error[name] / np.abs(value[name]))) for name in value}

    def progress(self, limits: Limits | None = None) -> float:
        """Share of the work done, as far as it can be known; of other limits than asked for."""
        limits = limits or self.limits
        if limits.duration is not None:
            return min(1.0, float(np.min(self.history.reached("time"))) / limits.duration)
        if limits.collisions is not None:
            return min(1.0, float(np.min(self.history.reached("collisions"))) / limits.collisions)
        done = self.spent / limits.budget
        if limits.records is not None:
            done = self.history.length / limits.records
        precise = self.share**-2 if 0.0 < self.share < np.inf else 0.0
        return min(1.0, max(precise, done))
