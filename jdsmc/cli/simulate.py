"""`jdsmc run` and `jdsmc sweep`: run a scene with every gas, keep what was measured."""

import jax

from .. import sweep
from ..errors import FaultError
from ..results.result import Result
from ..running.run import run
from .arguments import Arguments, Asked
from .catalogue import find_scene
from .keep import check_files, keep


def simulate(command: str, name: str, words: list[str]) -> int:
    """Run `jdsmc COMMAND NAME WORDS`; the exit status.

    Raises ValueError, TypeError or OSError for bad input, before anything is computed, and
    FaultError for a run that cannot be trusted; what was measured before is kept.
    """
    arguments = Arguments(f"jdsmc {command} {name}", find_scene(name), words)
    if {"-h", "--help"} & set(words):
        print(arguments.parser().format_help(), end="")
        return 0
    several = command == "sweep"
    asked = arguments.read(several)
    check_files(asked.out, asked.plot, asked.run.get("checkpoint"))
    if asked.run.get("checkpoint") is not None and len(asked.scenes) > 1:
        raise ValueError("--checkpoint keeps the run of one gas; give one --gas.")
    if asked.run.get("dtype") == "float64":
        jax.config.update("jax_enable_x64", True)
    results: dict[str, Result] = {}
    status = 0
    try:
        run_all(asked, results, count_points=several)
    finally:
        if results:
            status = keep(
                results,
                asked.out,
                asked.plot,
                join=len(asked.scenes) > 1,
                spare=f"jdsmc-{arguments.scene.__name__}",
            )
    return status


def run_all(asked: Asked, results: dict[str, Result], *, count_points: bool) -> None:
    """Fill in the result of every gas, one after the other, until one is interrupted."""
    for name, scene in asked.scenes.items():
        if count_points:
            print(f"{name}: {len(sweep.points(scene)[0])} points")
        try:
            results[name] = run(scene, **asked.run)
        except FaultError as error:
            if error.result is not None:
                results[name] = error.result
            raise
        if results[name].interrupted:
            break
