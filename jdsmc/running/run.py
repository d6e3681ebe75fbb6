"""Run a scene: until steady, then until precise; or for a given time."""

from typing import Literal, NamedTuple

import numpy as np

from .. import check, sweep
from ..derivatives.request import Request, requested
from ..errors import FaultError, NotSteadyError
from ..results.result import Result
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options
from ..types import Whole
from .assemble import assemble
from .limits import Limits
from .progress import interruptible, progress_bar
from .session import Session

LEAST_REALIZATIONS = 8
"""With four, Student's t decides nothing: a drift of three errors has a significance of 0.06."""


def run(
    scene: AbstractScene,
    *,
    n_particles: Whole | None = None,
    n_realizations: Whole = 8,
    seed: Whole = 0,
    duration: float | None = None,
    collisions: float | None = None,
    observable: str | tuple[str, ...] | None = None,
    rtol: float | tuple[float, ...] | None = None,
    budget: float = 5_000.0,
    time_step: float | None = None,
    splitting: Literal["strang", "lie"] = "strang",
    dtype: Literal["float32", "float64"] | type | np.dtype = "float32",
    steps_per_record: Whole | None = None,
    progress: bool = True,
    sensitivity: bool | str | tuple[str, ...] = False,
) -> Result:
    """Simulate a scene and return labelled results with error bars.

    Without `duration` and `collisions` the run goes on until the gas is steady: for several times
    as long as its slowest relaxation takes, and until nothing that is printed can be off by a good
    part of its error; then until the standard error of `observable` is `rtol` of its value at every
    point of the sweep, or until the budget ends; `result.attrs["stopped"]` says which.

    Arguments:
        scene: a scene, ours or your own; one-dimensional arrays among its numbers are swept (their
            product, in one compiled program).
        n_particles: particles of one realization, at least 64, in a homogeneous gas a number with
            a divisor from 64 to 1024; by default what the scene says, mostly 20000.
        n_realizations: independent realizations, at least 8; all error bars come from them.
        seed: of all random numbers; the same seed gives the same result.
        duration: time to simulate (τ0).
        collisions: time to simulate, in accepted collisions per particle.
        observable, rtol: the precision asked for, one number or one for each observable; by
            default of the scene's main observables, and 0.001 for most scenes.
        budget: most collisions per particle to spend.
        time_step: largest time step in (0, 1], 0.05 for most scenes, as a fraction of τ(T) and of
            the scene's own times (1/shear_rate) in homogeneous gases and sheared slabs, of τ0 in a
            Fourier flow; it is shortened so that no pair is likelier to collide than the pair
            selection allows.
        splitting: "strang" (second order) or "lie" (first order, as in the papers).
        dtype: "float32", or "float64" with JAX's x64 mode enabled.
        steps_per_record: time steps between two measurements, 16 for most scenes.
        progress: show a progress bar.
        sensitivity: names of numbers of gas and scene, or True for all: `result.sensitivity` then
            has the derivatives of what is reported with respect to them (homogeneous gases).
    Raises:
        ValueError, TypeError: bad input, before anything is computed.
        NotSteadyError: no steady state within the budget; before the run, with `.result` None, if
            the warm-up alone needs more.
        FaultError: lost collisions or numbers that are not finite. Both have `.result`, what was
            measured until then, or None.
    Ctrl-C ends the run after the present chunk and returns what was measured.
    """
    scenes = scenes_of(scene)
    along = duration is not None or collisions is not None
    request = None if sensitivity is False else requested(scene, scenes, sensitivity, along=along)
    options = options_of(scenes, n_particles, time_step, splitting, dtype, steps_per_record)
    scenes = [one.prepared() for one in scenes]
    limits = Limits(
        scenes,
        options,
        duration=duration,
        collisions=collisions,
        observable=observable,
        rtol=rtol,
        budget=budget,
    )
    return simulate(
        *(scene, scenes, options, limits),
        n_realizations=n_realizations,
        seed=seed,
        progress=progress,
        request=request,
    )


def scenes_of(scene) -> list[AbstractScene]:
    """The scene at every point of its sweep; TypeError for what is no scene."""
    if isinstance(scene, type) and issubclass(scene, AbstractScene):
        raise TypeError(
            f"scene is the class {scene.__name__}; make one: {scene.__name__}(gas, ...)."
        )
    if not isinstance(scene, AbstractScene):
        raise TypeError(f"scene must be one of jdsmc.scenarios or derive from them, got {scene!r}.")
    return sweep.points(scene)[0]


def options_of(scenes, n_particles, time_step, splitting, dtype, steps_per_record) -> Options:
    """The checked options, as all points of a sweep need them."""
    scene = scenes[0]
    options = Options.checked(
        scene.default_particles() if n_particles is None else n_particles,
        scene.default_time_step if time_step is None else time_step,
        *(splitting, dtype),
        scene.default_steps if steps_per_record is None else steps_per_record,
        samples=scene.samples_per_record,
        in_space=scene.in_space,
    )
    fitted = [one.fit_options(options) for one in scenes]
    if any(other != fitted[0] for other in fitted):
        raise ValueError(
            f"the points of this sweep of {type(scene).__name__} need different sizes of arrays; "
            "run them one by one."
        )
    return fitted[0]


def simulate(
    scene: AbstractScene,
    scenes: list[AbstractScene],
    options: Options,
    limits: Limits,
    *,
    n_realizations: Whole,
    seed: Whole,
    progress: bool,
    request: Request | None = None,
) -> Result:
    """Advance until a limit is met, and assemble what was measured; see `run`."""
    n_realizations = check.whole("n_realizations", n_realizations, LEAST_REALIZATIONS)
    seed = check.whole("seed", seed, 0)
    limits.check_warm_up()
    session = Session(scenes, n_realizations, seed, options, limits, request)
    return go_on(scene, session, {"seed": seed, "n_realizations": n_realizations}, progress)


class UnderWay(NamedTuple):
    """What a result must know to go on: the run as it stood when the result was made."""

    scene: AbstractScene
    session: Session
    attrs: dict
    length: int
    start: np.ndarray


def go_on(scene: AbstractScene, session: Session, attrs: dict, progress: bool) -> Result:
    """Advance a session until its limits are met; raise what went wrong, with what there is."""
    limits = session.limits

    def result(stopped: str, whole: bool = True) -> Result:
        known = whole and limits.can_be_steady and not session.failed
        start = session.tracker.start.copy()  # to settle may move it
        told = attrs | limits.attributes() | {"stopped": stopped}
        made = assemble(scene, session, known, told)
        made.under_way = UnderWay(scene, session, attrs, session.history.length, start)
        return made

    try:
        with interruptible() as interrupted, progress_bar(progress) as bar:
            stopped = ""
            while not stopped:
                session.advance()
                stopped = session.ending()
                bar.show(session)
                if interrupted.is_set() and not stopped:
                    stopped = f"interrupted after {session.spent:.1f} collisions per particle"
    except FaultError as error:
        if session.history.length:
            error.result = result(f"fault: {error}", whole=False)
        raise
    if session.failed:
        error = NotSteadyError(stopped)
        error.result = result(stopped)
        raise error
    return result(stopped)


def resume(
    result: Result,
    *,
    duration: float | None = None,
    collisions: float | None = None,
    observable: str | tuple[str, ...] | None = None,
    rtol: float | tuple[float, ...] | None = None,
    budget: float = 5_000.0,
    progress: bool = True,
) -> Result:
    """Go on with the run that made a result, in the same process; limits as of `run`.

    With `duration` or `collisions`, counted from the start of the first run, the new result is to
    the bit what asking for them at once would have given. Raises ValueError for a result that was
    loaded, joined or cut (only a run of this process still holds its gas), for one that has been
    gone on from, and for a time that was reached already.
    """
    under_way = result.under_way
    if under_way is None:
        raise ValueError(
            "this result cannot go on: it was loaded, joined or cut, and holds no gas; run its "
            "scene again."
        )
    scene, session, attrs, length, start = under_way
    if session.history.length != length:
        raise ValueError("this result has been gone on from already; go on from the latest one.")
    limits = Limits(
        session.history.scenes,
        session.options,
        **{"duration": duration, "collisions": collisions, "observable": observable},
        **{"rtol": rtol, "budget": budget},
    )
    session.go_on(limits, start)
    if limits.fixed and session.progress() >= 1.0:
        raise ValueError("the time asked for was reached already; ask for more.")
    return go_on(scene, session, attrs, progress)
