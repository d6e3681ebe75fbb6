"""When a run stops: what was asked for, checked against the scene."""

import numpy as np

from .. import check
from ..errors import NotSteadyError
from ..scenarios.approach import UNKNOWN
from ..scenarios.base import AbstractScene
from ..scenarios.options import Options
from .provenance import specification
from .steady import tracker_for


class Limits:
    """A time, a number of collisions, or a precision and a budget.

    Arguments: the scene of each point, the options; the rest as of `run`. `records` ends a run
    after a number of them, whatever the precision.
    """

    def __init__(
        self,
        scenes: list[AbstractScene],
        options: Options,
        *,
        duration=None,
        collisions=None,
        observable=None,
        rtol=None,
        budget=5_000.0,
        records=None,
    ):
        scene = scenes[0]
        if duration is not None and collisions is not None:
            raise ValueError("give duration or collisions, not both.")
        for name, value in (("duration", duration), ("collisions", collisions), ("budget", budget)):
            if value is not None or name == "budget":
                check.scalar(name, value, 0.0, np.inf, high_included=False)
        given = {"duration": duration, "collisions": collisions, "observable": observable}
        self.given = specification(given | {"rtol": rtol, "budget": budget, "records": records})
        self.duration = None if duration is None else float(duration)
        self.collisions = None if collisions is None else float(collisions)
        self.records, self.budget = records, float(budget)
        self.fixed = duration is not None or collisions is not None
        self.observables = _names(scenes[:1] if self.fixed else scenes, observable)
        self.rtol = _shares(scene.default_rtol if rtol is None else rtol, self.observables)
        self.monitored = scene.monitored
        self.approaches = [s.approach(options) if s.has_steady_state() else UNKNOWN for s in scenes]
        without = [scene for scene in scenes if not scene.has_steady_state()]
        self.can_be_steady = not without
        if not self.fixed and without:
            raise ValueError(
                f"{type(scene).__name__} has no steady state with these parameters: "
                f"{without[0].no_steady_state()}."
            )

    @property
    def named(self) -> str:
        """The observables whose precision is asked."""
        return ", ".join(self.observables)

    @property
    def verb(self) -> str:
        """That goes with them."""
        return "is" if len(self.observables) == 1 else "are"

    @property
    def asked(self) -> str:
        """The precision that is asked of each, or once if of all the same."""
        return ", ".join(f"{share:g}" for share in dict.fromkeys(self.rtol.values()))

    def check_warm_up(self) -> None:
        """Raise NotSteadyError if the warm-up alone takes more than the budget."""
        if self.fixed:
            return
        least = float(np.max(tracker_for(self.approaches, self.monitored).least))
        if least >= self.budget:
            raise NotSteadyError(
                f"budget = {self.budget:g} collisions per particle is too small: the warm-up takes "
                f"{least:.0f}, {self.slowest()}. Raise budget to {4 * least:.2g} or so, or give "
                "duration."
            )

    def slowest(self) -> str:
        """A clause that tells the largest of the slow times."""
        longest = max(a.collisions for a in self.approaches)
        known = all(a.certain for a in self.approaches)
        article = "the" if known else "a"
        return f"{article} slow relaxation taking {longest:.3g} collisions per particle"

    def attributes(self) -> dict:
        """What was asked for, as attributes of the result."""
        asked = {"observable": self.named, "budget": self.budget}
        shares = tuple(dict.fromkeys(self.rtol.values()))
        asked["rtol"] = shares[0] if len(shares) == 1 else tuple(self.rtol.values())
        times = {"duration": self.duration, "collisions": self.collisions}
        return asked | {name: t for name, t in times.items() if t is not None}


def _shares(rtol, names: tuple[str, ...]) -> dict[str, float]:
    """The relative error asked of each observable; ValueError if there are more or fewer."""
    shares = (rtol,) * len(names) if np.ndim(rtol) == 0 else tuple(rtol)
    if len(shares) != len(names):
        raise ValueError(
            f"rtol must be one number, or one for each observable ({', '.join(names)}), got {rtol}."
        )
    for share in shares:
        check.scalar("rtol", share, 0.0, 1.0)
    return {name: float(share) for name, share in zip(names, shares, strict=True)}


def _names(scenes: list[AbstractScene], observable) -> tuple[str, ...]:
    """The observables that end a run; ValueError for one that the scene does not report."""
    known = [one.name for one in scenes[0].reports]
    if observable is None:
        ends = {scene.ends(): None for scene in scenes}
        if len(ends) > 1:
            named = " or ".join(", ".join(names) for names in ends)
            raise ValueError(
                f"points of this sweep would end by {named}: say which as observable, or run them "
                "apart."
            )
        return next(iter(ends))
    names = (observable,) if isinstance(observable, str) else observable
    if not isinstance(names, tuple | list) or not names:
        raise TypeError(f"observable = {observable!r} is neither a name nor a tuple of names.")
    for name in names:
        check.one_of("observable", name, known)
    return tuple(names)
