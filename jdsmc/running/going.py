"""A session advanced until its limits are met."""

from contextlib import nullcontext
from typing import NamedTuple

from ..errors import FaultError, NotSteadyError
from ..results.result import Result
from ..scenarios.base import AbstractScene
from . import hosts
from .assemble import assemble
from .checkpoint import Keeper
from .progress import interruptible, progress_bar
from .session import Session

INTERRUPTED = "interrupted"
"""First word of what is said of a run that was ended by a signal."""

FAULT = "fault"
"""And by a FaultError."""


class UnderWay(NamedTuple):
    """What a result must know to go on: the run as it stood when the result was made."""

    scene: AbstractScene
    session: Session
    attrs: dict
    length: int
    keeper: Keeper | None = None


def go_on(
    scene: AbstractScene,
    session: Session,
    attrs: dict,
    progress: bool,
    keeper: Keeper | None = None,
) -> Result:
    """Advance a session until its limits are met; raise what went wrong, with what there is.

    Arguments: the scene as the user made it; the session; attributes of the result; whether a bar
    is shown; where the run is kept, if anywhere.
    """
    shown = progress and hosts.is_first()
    try:
        with keeper or nullcontext(), interruptible() as ended, progress_bar(shown) as bar:
            stopped = ""
            while not stopped:
                session.advance()
                stopped = session.ending()
                bar.show(session)
                due = keeper is not None and keeper.is_due()
                end, due = hosts.any_of(ended.is_set(), due)
                if end and not stopped:
                    stopped = f"{INTERRUPTED} after {session.spent:.1f} collisions per particle"
                if keeper is not None and (due or stopped):
                    keeper.keep(session, stopped)
    except FaultError as error:
        if session.history.length:
            told = f"{FAULT}: {error}"
            error.result = made(scene, session, attrs, told, keeper, whole=False)
        raise
    return concluded(scene, session, attrs, stopped, keeper)


def concluded(
    scene: AbstractScene, session: Session, attrs: dict, stopped: str, keeper: Keeper | None = None
) -> Result:
    """The result of a session that has ended; NotSteadyError if it failed to become steady."""
    result = made(scene, session, attrs, stopped, keeper)
    if session.failed:
        error = NotSteadyError(stopped)
        error.result = result
        raise error
    return result


def made(
    scene: AbstractScene,
    session: Session,
    attrs: dict,
    stopped: str,
    keeper: Keeper | None = None,
    *,
    whole: bool = True,
) -> Result:
    """The result of what a session has come to, steady values only if it can be trusted."""
    limits = session.limits
    known = whole and limits.can_be_steady and not session.failed
    told = attrs | limits.attributes() | {"stopped": stopped}
    result = assemble(scene, session, known, told)
    result.under_way = UnderWay(scene, session, attrs, session.history.length, keeper)
    return result
