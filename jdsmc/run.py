"""Run a scene: until steady, then until precise; or for a given time."""

import contextlib
import signal
import threading
from typing import Literal

import numpy as np
from tqdm import tqdm

from . import check, faults, grid
from .assemble import assemble, steady_estimates
from .engine import Engine
from .faults import FaultError, NotSteadyError
from .history import History
from .options import STEPS_PER_RECORD, TIME_STEP, Options
from .result import Result
from .steady import FIRST_TEST, SteadyTracker


def run(
    scene,
    *,
    n_particles: int | None = None,
    n_realizations: int = 8,
    seed: int = 0,
    duration: float | None = None,
    collisions: float | None = None,
    observable: str | None = None,
    rtol: float = 1e-3,
    budget: float = 5_000.0,
    time_step: float = TIME_STEP,
    splitting: Literal["strang", "lie"] = "strang",
    dtype: Literal["float32", "float64"] = "float32",
    steps_per_record: int = STEPS_PER_RECORD,
    progress: bool = True,
) -> Result:
    """Simulate a scene and return labelled results with error bars.

    Without `duration` and `collisions` the run goes on until no drift is found between early and
    late blocks, then until the standard error of `observable` is `rtol` of its value at every
    point of the sweep, or until the budget ends; `result.attrs["stopped"]` says which.

    Arguments:
        scene: a scene from `jdsmc.scenarios`; one-dimensional arrays among its numbers are swept
            (their product, in one compiled program).
        n_particles: particles of one realization, at least 64, in a homogeneous gas a number with
            a divisor from 64 to 1024; by default `scene.default_particles`.
        n_realizations: independent realizations, at least 4; all error bars come from them.
        seed: of all random numbers; the same seed gives the same result.
        duration: time to simulate (τ0).
        collisions: time to simulate, in accepted collisions per particle.
        observable, rtol: the precision asked for; by default of the scene's main observable.
        budget: most collisions per particle to spend.
        time_step: largest time step as a fraction of τ(T) and of 1/a, in (0, 1]; it is shortened
            so that a particle is a candidate at most 0.5 times a step.
        splitting: "strang" (second order) or "lie" (first order, as in the paper).
        dtype: "float32", or "float64" with JAX's x64 mode enabled.
        steps_per_record: time steps between two measurements.
        progress: show a progress bar.
    Raises:
        ValueError, TypeError: bad input, before anything is computed.
        NotSteadyError: no steady state within the budget.
        FaultError: lost collisions or numbers that are not finite. Both have `.result`, what was
            measured until then, or None.
    Ctrl-C ends the run after the present chunk and returns what was measured.
    """
    if not hasattr(scene, "steady_observables"):
        raise TypeError(f"scene must be one of jdsmc.scenarios, got {scene!r}.")
    options = Options.checked(
        scene.default_particles if n_particles is None else n_particles,
        *(time_step, splitting, dtype, steps_per_record),
        records=_records(steps_per_record, getattr(scene, "samples_per_record", 1)),
        in_space=getattr(scene, "in_space", False),
    )
    limits = Limits(
        scene, duration, collisions, observable or scene.default_observable, rtol, budget
    )
    if hasattr(scene, "check_options"):
        scene.check_options(options)
    check.at_least("n_realizations", n_realizations, 4)
    check.at_least("seed", seed, 0)
    flat, _ = grid.flatten(scene)
    engine = Engine(flat, n_realizations, seed, options)
    session = Session(flat, options, engine, limits)
    attrs = {"seed": seed, "n_realizations": n_realizations, **limits.attributes()}

    def result(stopped: str) -> Result:
        tracker = session.tracker if limits.can_be_steady and not session.failed else None
        return assemble(scene, options, session.history, tracker, attrs | {"stopped": stopped})

    try:
        with interruptible() as interrupted, _bar(progress, scene) as bar:
            stopped = ""
            while not stopped:
                session.advance()
                stopped = session.ending()
                bar.show(session)
                if interrupted.is_set() and not stopped:
                    stopped = f"interrupted after {session.spent:.1f} collisions per particle"
    except FaultError as error:
        if session.history.length:
            error.result = result(f"fault: {error}")
        raise
    if session.failed:
        error = NotSteadyError(stopped)
        error.result = result(stopped)
        raise error
    return result(stopped)


def _records(steps: int, samples: int) -> int:
    """Records per chunk: about 64 steps between two looks at the clock."""
    check.at_least("steps_per_record", steps, 1)
    return max(1, 64 // (steps * samples))


class Limits:
    """When to stop, checked against the scene."""

    def __init__(self, scene, duration, collisions, observable, rtol, budget):
        if duration is not None and collisions is not None:
            raise ValueError("give duration or collisions, not both.")
        for name, value in (("duration", duration), ("collisions", collisions), ("budget", budget)):
            if value is not None:
                check.scalar(name, value, 0.0, np.inf, high_included=False)
        check.scalar("rtol", rtol, 0.0, 1.0)
        self.duration, self.collisions = duration, collisions
        self.observable, self.rtol, self.budget = observable, float(rtol), float(budget)
        self.fixed = duration is not None or collisions is not None
        self.can_be_steady = scene.has_steady_state()
        if observable not in scene.steady_observables:
            raise ValueError(
                f"observable = {observable!r} is unknown; choose one of "
                f"{', '.join(scene.steady_observables)}."
            )
        if not self.fixed and not self.can_be_steady:
            raise ValueError(
                f"{type(scene).__name__} has no steady state with these parameters "
                "(it needs shear_rate > 0 and restitution < 1); give duration or collisions."
            )

    def attributes(self) -> dict:
        """What was asked for, as attributes of the result."""
        asked = {"observable": self.observable, "rtol": self.rtol, "budget": self.budget}
        times = {"duration": self.duration, "collisions": self.collisions}
        return asked | {name: float(t) for name, t in times.items() if t is not None}


BLOCKS = 4
"""Blocks of a measurement for the second estimate of its precision."""


class Session:
    """A run under way: engine, history, steady-state tracker, precision."""

    def __init__(self, scene, options: Options, engine: Engine, limits: Limits):
        self.scene, self.options, self.engine, self.limits = scene, options, engine, limits
        self.history = History(options.n_particles, options.steps, scene.averages)
        warm_up = scene.shortest_warm_up() if hasattr(scene, "shortest_warm_up") else FIRST_TEST
        self.tracker = SteadyTracker(engine.shape[0], scene.monitored, warm_up)
        self.precision = np.inf
        self.failed = False
        self._next_look = 0.0

    def advance(self) -> None:
        """One chunk, its faults checked, and the steady state looked for."""
        record, sample = self.engine.advance()
        self.history.append(record, sample)
        faults.check(self.scene, self.history, record)
        if self.limits.can_be_steady:
            self.tracker.update(self.history)

    @property
    def spent(self) -> float:
        """Collisions per particle of the point that is least far."""
        return float(np.min(self.history.mean_collisions()))

    def ending(self) -> str:
        """Why to stop now, or an empty string."""
        limits = self.limits
        if limits.fixed:
            return "the asked time was simulated" if self.progress() >= 1.0 else ""
        if self.tracker.all_measuring and self.spent >= self._next_look:
            self._next_look = 1.05 * self.spent
            self._look()
            if self.precision <= limits.rtol and self._confirmed():
                return (
                    f"{limits.observable} is known to {self.precision:.2g} (asked {limits.rtol:g})"
                )
        if self.spent < limits.budget:
            return ""
        self._look()
        if np.isfinite(self.precision) and self._confirmed():
            return (
                f"the budget of {limits.budget:g} collisions per particle ended: "
                f"{limits.observable} is known to {self.precision:.2g}, asked {limits.rtol:g}"
            )
        self.failed = True
        return (
            f"no steady state within {limits.budget:g} collisions per particle: early and late "
            "blocks still differ. Raise budget, start nearer to the steady state (a shear_rate "
            "with T_s closer to T0), or give duration."
        )

    def _look(self) -> None:
        """Relative error of the observable at the worst point."""
        if self.tracker.all_measuring:
            points = range(len(self.tracker.start))
            self.precision = max(self._relative_error(point) for point in points)

    def _relative_error(self, point: int) -> float:
        """The larger of two estimates: from realizations, and from blocks of them.

        The first alone has few degrees of freedom, and a run that stops when it happens to be
        small would report error bars that are too small. The second has more of them, but takes
        blocks as independent, so it is used for this decision only.
        """
        first, last = self.tracker.start[point], self.history.length
        if last - first < 2 * BLOCKS:
            return np.inf
        name = self.limits.observable
        value, error = steady_estimates(self.scene, self.history, point, first)
        edges = np.linspace(first, last, BLOCKS + 1).astype(int)
        _, block_error = steady_estimates(self.scene, self.history, point, edges)
        return float(np.max(np.maximum(error[name], block_error[name]) / np.abs(value[name])))

    def _confirmed(self) -> bool:
        """No point drifts; all are tested, since a test drops what it finds to drift."""
        tests = [self.tracker.confirm(self.history, p) for p in range(len(self.tracker.start))]
        return all(tests)

    def progress(self) -> float:
        """Share of the work done, as far as it can be known."""
        limits = self.limits
        if limits.duration is not None:
            return min(1.0, float(np.min(self.history.mean_time())) / limits.duration)
        if limits.collisions is not None:
            return min(1.0, self.spent / limits.collisions)
        precise = (limits.rtol / self.precision) ** 2 if np.isfinite(self.precision) else 0.0
        return min(1.0, max(precise, self.spent / limits.budget))


class _Bar:
    """A progress bar in percent that tells the phase, or nothing."""

    def __init__(self, bar):
        self._bar = bar

    def show(self, session: Session) -> None:
        if self._bar is None:
            return
        limits = session.limits
        if limits.fixed:
            phase = "running"
        else:
            phase = "measuring" if session.tracker.all_measuring else "warming up"
        self._bar.set_description_str(phase)
        facts = {"collisions/particle": f"{session.spent:.0f}"}
        if np.isfinite(session.precision):
            facts[limits.observable] = f"±{session.precision:.2g}"
        self._bar.set_postfix(facts, refresh=False)
        self._bar.update(100.0 * session.progress() - self._bar.n)


@contextlib.contextmanager
def _bar(show: bool, scene):
    if not show:
        yield _Bar(None)
        return
    layout = "{desc} {percentage:3.0f}%|{bar}| {elapsed}{postfix}"
    with tqdm(total=100.0, bar_format=layout, desc="compiling", dynamic_ncols=True) as bar:
        yield _Bar(bar)


@contextlib.contextmanager
def interruptible():
    """An event set by Ctrl-C in place of an exception; a second Ctrl-C interrupts as usual."""
    event = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield event
        return
    usual = signal.getsignal(signal.SIGINT)

    def on_interrupt(number, frame):
        event.set()
        signal.signal(signal.SIGINT, usual)

    signal.signal(signal.SIGINT, on_interrupt)
    try:
        yield event
    finally:
        signal.signal(signal.SIGINT, usual)
