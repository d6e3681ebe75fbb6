"""Go on with a run: of this process, or kept in a file."""

from pathlib import Path
from typing import Any

from ..derivatives.request import requested
from ..results.result import Result
from . import checkpoint
from .checkpoint import EVERY, Keeper, Kept, check_every
from .going import FAULT, INTERRUPTED, concluded, go_on
from .limits import Limits
from .run import options_of, scenes_of
from .session import Session


def resume(
    source: Result | str | Path,
    *,
    duration: float | None = None,
    collisions: float | None = None,
    observable: str | tuple[str, ...] | None = None,
    rtol: float | tuple[float, ...] | None = None,
    budget: float | None = None,
    progress: bool = True,
    every: float = EVERY,
    classes: tuple[type, ...] = (),
) -> Result:
    """Go on with a run, to the bit as if it had never ended and the last limits had been asked for.

    Arguments:
        source: the result of a run of this process; or a checkpoint (`run(checkpoint=...)`). That
            of either is written to again as the run goes on.
        duration, collisions: counted from the start of the first run.
        observable, rtol, budget: as of `run`. What is not given is as it was; of a time and a
            precision the new one counts. With no limit at all a run that was ended goes on, and one
            that came to its end gives its result again.
        progress, every: as of `run`.
        classes: of the scene and the gas, if they are your own and not imported yet.
    Raises: ValueError for a result that was loaded, joined or cut (it holds no gas) or has been
        gone on from, for a time that was reached already, and for a file that is no checkpoint or
        was changed; FileNotFoundError; else as `run`.
    A warning says so if another processor or other versions go on, with other roundings.
    """
    check_every(every)
    limits = {"duration": duration, "collisions": collisions, "observable": observable}
    asked = {
        name: x for name, x in {**limits, "rtol": rtol, "budget": budget}.items() if x is not None
    }
    if not isinstance(source, Result):
        path = Path(source)
        return from_file(path, checkpoint.read(path, classes), asked, progress, every)
    under_way = source.under_way
    if under_way is None:
        raise ValueError(
            "this result cannot go on: it was loaded, joined, cut or copied, and holds no gas; "
            "resume the checkpoint of its run, or run its scene again."
        )
    scene, session, attrs, length, keeper = under_way
    if session.history.length != length:
        raise ValueError("this result has been gone on from already; go on from the latest one.")
    if session.broken_off:
        raise ValueError(
            "this run ended within a chunk, which is lost; resume its checkpoint, or run its scene "
            "again."
        )
    stopped = str(source.attrs["stopped"])
    if _is_done(stopped, asked):
        return concluded(scene, session, attrs, stopped, keeper)
    if asked:
        _ask(session, asked)
    if keeper is not None:
        keeper.every = float(every)
    return go_on(scene, session, attrs, progress, keeper)


def from_file(path: Path, kept: Kept, asked: dict, progress: bool, every: float) -> Result:
    """Go on with the run that a checkpoint keeps; `asked` are the limits that change."""
    scene, chosen = kept.scene, kept.chosen
    points = scenes_of(scene)
    sensitivity = chosen["sensitivity"]
    request = None
    if sensitivity is not False:
        request = requested(scene, points, sensitivity, along=chosen["along"])
    numerics = ("n_particles", "time_step", "splitting", "dtype", "steps_per_record")
    options = options_of(points, *(chosen[name] for name in numerics))
    points = [one.prepared() for one in points]
    limits = Limits(points, options, **kept.limits)
    session = Session(points, chosen["n_realizations"], chosen["seed"], options, limits, request)
    kept.give(session)
    attrs = {name: chosen[name] for name in ("seed", "n_realizations")}
    if _is_done(kept.stopped, asked):
        return concluded(scene, session, attrs, kept.stopped)
    if asked:
        _ask(session, asked)
    return go_on(scene, session, attrs, progress, Keeper(path, every, scene, chosen, new=False))


def _is_done(stopped: str, asked: dict) -> bool:
    """True of a run that came to its end, if nothing more is asked of it."""
    return bool(stopped) and not asked and not stopped.startswith((INTERRUPTED, FAULT))


def _ask(session: Session, asked: dict) -> None:
    """Give a session other limits: those given, and for the rest those it had.

    A time that it had does not count beside a new time or precision.
    """
    given: dict[str, Any] = session.limits.given | {"records": None}
    if set(asked) - {"budget"}:
        given |= {"duration": None, "collisions": None}
    limits = Limits(session.history.scenes, session.options, **(given | asked))
    if limits.fixed and session.progress(limits) >= 1.0:
        raise ValueError("the time asked for was reached already; ask for more.")
    session.go_on(limits)
