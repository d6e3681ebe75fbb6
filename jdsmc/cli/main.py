"""Entry point of the command line: which command, and how it ends."""

import os
import sys
import warnings
from pathlib import Path

from ..errors import FaultError
from ..results.columns import columns, write_csv
from ..results.result import Result, load
from ..running.hosts import is_first, join_hosts
from ..running.provenance import version
from . import catalogue
from .arguments import Parser
from .fit import fit
from .keep import check_picture, draw, picture_of, show
from .merge import merge
from .resume import resume
from .simulate import simulate
from .spelling import never_fail_to_print
from .theory import parser as theory_parser
from .theory import theory

COMMANDS = {
    "run": ("SCENE [options]", "simulate one gas: steady values with error bars"),
    "sweep": ("SCENE [options]", "simulate every combination of the given numbers and gases"),
    "resume": ("FILE [options]", "go on with a run that --checkpoint kept"),
    "merge": ("FILES --out FILE", "realizations, or points of a sweep, of several runs as one"),
    "fit": ("beta [options]", "the rate factor of an elastic gas that mimics an inelastic one"),
    "show": ("FILE [--csv]", "print the table of a result file"),
    "plot": ("FILE [--out PICTURE]", "draw a result file"),
    "theory": ("[--restitution A:B:STEP]", "transport coefficients without simulation"),
}
HELP = {"-h", "--help"}
COMPUTING = ("run", "sweep", "resume", "fit")
"""Commands that several processes may share."""


def main(arguments: list[str] | None = None) -> int:
    """Run a command; returns the exit status.

    0; 1 for a run that cannot be trusted, has no room, or whose result cannot be shown; 2, with one
    sentence, for bad input; 130 after Ctrl-C or SIGTERM, which end a run after the present chunk
    with what there is. A reader that has seen enough (`jdsmc show f | head`) ends the printing
    silently.
    """
    never_fail_to_print()
    try:
        status = command(list(sys.argv[1:] if arguments is None else arguments))
        print(end="", flush=True)  # unlike sys.stdout.flush, also if whoever called has closed it
    except (FaultError, MemoryError) as error:
        return told(error, 1)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # else Python complains
        return 0
    except (ValueError, TypeError, OSError) as error:
        return told(error, 2)
    except KeyboardInterrupt:
        return told("interrupted.", 130)
    return status


def told(why: Exception | str, status: int) -> int:
    """The status, after one sentence on stderr."""
    print(f"jdsmc: {why}", file=sys.stderr)
    return status


def command(words: list[str]) -> int:
    """Run the command of these words; ValueError if there is none."""
    if not words or words[0] in HELP or words == ["--version"]:
        print(f"jdsmc {version()}" if words == ["--version"] else overview())
        return 0
    first, rest = words[0], words[1:]
    if first in COMPUTING and join_hosts() and not is_first():
        sys.stdout = open(os.devnull, "w")  # noqa: SIM115 (until the process ends): one tells it all
    if first in ("run", "sweep"):
        if not rest or rest[0] in HELP:
            print(overview())
            return 0
        if rest[0].startswith("-"):
            names = ", ".join(catalogue.scenes())
            raise ValueError(f"`jdsmc {first}` needs a scene: {names}, or your own module:Class.")
        return simulate(first, rest[0], rest[1:])
    if first in ("show", "plot"):
        return shown(first, rest)
    if first == "theory" and HELP & set(rest):
        print(theory_parser().format_help(), end="")
        return 0
    others = {"fit": fit, "theory": theory, "resume": resume, "merge": merge}
    if first in others:
        return others[first](rest)
    near = catalogue.did_you_mean(first, COMMANDS)
    raise ValueError(f"there is no command {first!r}{near}; there are {', '.join(COMMANDS)}.")


def shown(name: str, words: list[str]) -> int:
    """`jdsmc show` and `jdsmc plot`."""
    parser = Parser(prog=f"jdsmc {name}", description=f"{COMMANDS[name][1].capitalize()}.")
    parser.add_argument("file", metavar="FILE", help="result file, as --out writes it")
    if name == "plot":
        parser.add_argument(
            "--out",
            metavar="PICTURE",
            help="picture to write (PNG, PDF or SVG); by default the name of the file with .png",
        )
    else:
        parser.add_argument("--csv", action="store_true", help="print values separated by commas")
        parser.add_argument(
            "--along",
            metavar="DIMENSION",
            default="",
            help="with --csv, a line for each place on this dimension: sample (time series), z, "
            "velocity, ...; steady values without it",
        )
    if HELP & set(words):
        print(parser.format_help(), end="")
        return 0
    asked = parser.parse_args(words)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", UserWarning)
        result = load(asked.file)
    for warning in caught:
        print(f"jdsmc: {warning.message}", file=sys.stderr)
    if name == "show" and (asked.csv or asked.along):
        return print_csv(result, asked.along)
    if name == "show":
        return int(show(result))
    return int(draw(result, check_picture(asked.out or picture_of(Path(asked.file)))))


def print_csv(result: Result, along: str) -> int:
    """Values separated by commas; ValueError for a dimension that is not there."""
    try:
        table = columns(result.to_xarray(), result.dims, along)
    except KeyError as error:
        raise ValueError(error.args[0]) from None
    write_csv(table, sys.stdout)
    return 0


def overview() -> str:
    """Commands, scenes and gases."""
    commands = [(f"jdsmc {name} {words}", text) for name, (words, text) in COMMANDS.items()]
    scenes = [(name, catalogue.first_line(one)) for name, one in catalogue.scenes().items()]
    scenes.append(("module:Class", "a scene of your own: a class in module.py of this folder"))
    gases = [(gas.name, gas.meaning) for gas in catalogue.GASES]
    gases.append(("module:Class", "a gas of your own"))
    width = max(len(name) for name, _ in commands) + 2
    parts = ["Direct simulation Monte Carlo of granular and molecular gases."]
    for title, rows in (("", commands), ("Scenes", scenes), ("Gases (--gas)", gases)):
        parts.append("\n".join([title, *(f"  {name:{width}}{text}" for name, text in rows)]))
    parts.append(
        "\n`jdsmc run SCENE --help` explains every option of a scene with its unit; "
        "`jdsmc --version`."
    )
    return "\n".join(parts)
