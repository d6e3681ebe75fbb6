"""`jdsmc resume`: go on with a run that a checkpoint keeps."""

from pathlib import Path
from typing import Any

import jax

from ..errors import FaultError
from ..running import checkpoint
from ..running.checkpoint import EVERY
from ..running.resume import from_file
from .arguments import Parser, add_classes, add_files, classes_of
from .keep import check_files, keep
from .numbers import one_number

LIMITS = {
    "duration": "time to simulate in τ0, from the start of the run",
    "collisions": "time in accepted collisions per particle, from the start of the run",
    "rtol": "relative standard error asked of the observable",
    "budget": "most collisions per particle to spend, from the start of the run",
}


def parser() -> Parser:
    """The options of the command."""
    made = Parser(
        prog="jdsmc resume",
        description="Go on with a run, as if it had never ended. What is not given is as it was; "
        "a run that came to its end gives its result again.",
    )
    made.add_argument("file", metavar="FILE", help="as --checkpoint wrote it, and is written to")
    for name, meaning in LIMITS.items():
        made.add_argument(f"--{name}", metavar="NUMBER", help=meaning)
    made.add_argument("--observable", metavar="NAME", help="whose precision ends the run (or a,b)")
    made.add_argument(
        "--every", metavar="NUMBER", default=f"{EVERY:g}", help="seconds between two checkpoints"
    )
    add_classes(made)
    add_files(made)
    made.add_argument("--no-progress", action="store_true", help="show no progress bar")
    return made


def resume(words: list[str]) -> int:
    """Run the command; the exit status. Raises as `jdsmc.resume` does, and ValueError."""
    if {"-h", "--help"} & set(words):
        print(parser().format_help(), end="")
        return 0
    asked = parser().parse_args(words)
    check_files(asked.out, asked.plot, asked.file)
    given = {name: getattr(asked, name) for name in LIMITS}
    limits: dict[str, Any] = {
        name: one_number(name, text) for name, text in given.items() if text is not None
    }
    if asked.observable:
        limits["observable"] = tuple(asked.observable.split(","))
    path = Path(asked.file)
    every = one_number("every", asked.every)
    kept = checkpoint.read(path, classes_of(asked))
    if kept.chosen["dtype"] == "float64":
        jax.config.update("jax_enable_x64", True)
    result = None
    try:
        result = from_file(path, kept, limits, not asked.no_progress, every)
    except FaultError as error:
        result = error.result
        raise
    finally:
        status = 0
        if result is not None:
            files = {"out": asked.out, "plot": asked.plot, "join": False}
            status = keep({"": result}, **files, spare=f"jdsmc-{path.stem}")
    return status
