"""The arguments of a command that simulates: read, and made into a scene for every gas."""

import argparse
import re
from dataclasses import dataclass
from typing import Any, NoReturn

from .. import sweep
from ..scenarios.base import AbstractScene
from .catalogue import GASES, Gas, did_you_mean, find_class, find_gases, first_line, scenes
from .options import UNSET, Option, options_of, run_options
from .spelling import symbols

RESERVED = {"gas", "out", "plot", "no-progress", "help"}
UNITS = (
    "Lengths are in mean free paths λ0 at the mean density, times in τ0 = λ0/v0 with "
    "v0 = sqrt(2 T0/m)."
)


class Parser(argparse.ArgumentParser):
    """A parser that raises ValueError instead of leaving."""

    def __init__(self, **options):
        super().__init__(allow_abbrev=False, **options)

    def error(self, message: str) -> NoReturn:
        raise ValueError(f"{message}.")


def add_files(parser: Parser) -> None:
    """The files that a command which ends in a result writes."""
    files = parser.add_argument_group("files")
    files.add_argument("--out", metavar="FILE", help="file to write (HDF5); must not exist")
    files.add_argument("--plot", metavar="FILE", help="picture to write (PNG, PDF or SVG)")


def add_classes(parser: Parser) -> None:
    """Scenes and gases of the user's own that a file was made with: see `classes_of`."""
    parser.add_argument(
        "--class",
        dest="classes",
        metavar="module:Class",
        action="append",
        default=[],
        help="a scene or gas of your own that the file was made with",
    )


def classes_of(known: argparse.Namespace) -> tuple[type, ...]:
    """Those classes, imported because the user names them."""
    return tuple(find_class(name) for name in known.classes)


@dataclass(frozen=True)
class Asked:
    """What a command asks for: a scene for every gas by name, arguments of `run`, files."""

    scenes: dict[str, AbstractScene]
    run: dict[str, Any]
    out: str | None
    plot: str | None


class Arguments:
    """The options of a scene on the command line, for the gases it is asked with.

    Arguments: `command`, what was typed before the options; the class of the scene; the words.
    """

    def __init__(self, command: str, scene: type[AbstractScene], words: list[str]):
        self.command, self.scene = command, scene
        self.words = joined_negatives(words)
        self.of_scene = options_of(scene, {}, RESERVED, "scene")
        offered = [gas for gas in GASES if fits(gas, scene, self.of_scene)]
        self.usual_gas = offered[0].name if offered else GASES[0].name
        asked = Parser(add_help=False)
        asked.add_argument("--gas", default=self.usual_gas)
        text = asked.parse_known_args(self.words)[0].gas
        self.gases = find_gases(text, [gas.name for gas in offered])
        self.known = {gas.name: gas for gas in (*offered, *self.gases)}
        taken = RESERVED | {option.flag for option in self.of_scene}
        particles = "(default: what the scene needs, mostly 5120)"
        self.of_run = run_options(taken, scene.default_rtol, particles)
        taken |= {option.flag for option in self.of_run}
        self.of_gases = {
            name: options_of(gas.make, gas.fixed, taken, "gas") for name, gas in self.known.items()
        }

    def read(self, several: bool) -> Asked:
        """Everything that was asked; ValueError or TypeError for what cannot be.

        `several`: true if numbers may be swept, and several gases named.
        """
        parser = self.parser()
        known, rest = parser.parse_known_args(self.words)
        if rest:
            raise ValueError(self.unknown(rest[0]))
        given = {flag.replace("_", "-"): text for flag, text in vars(known).items()}
        self.check_owners(given)
        options = {option.name: option for option in self.of_run}
        arguments = {
            name: option.value(given.get(option.flag), None) for name, option in options.items()
        }
        arguments["progress"] = "no-progress" not in given
        rtol = arguments.get("rtol") or self.scene.default_rtol
        made = {gas.name: self.make(gas, given, rtol) for gas in self.gases}
        if not several and (len(made) > 1 or any(map(sweep.swept_paths, made.values()))):
            raise ValueError("several values were given; use `jdsmc sweep` for ranges and lists.")
        swept = {name: tuple(sweep.dimensions(scene)) for name, scene in made.items()}
        if len(set(swept.values())) > 1:
            each = "; ".join(f"{name}: {', '.join(of) or 'nothing'}" for name, of in swept.items())
            raise ValueError(
                f"gases side by side must be swept over the same numbers, here {each}; "
                "sweep them one by one."
            )
        return Asked(made, arguments, given.get("out"), given.get("plot"))

    def make(self, gas: Gas, given: dict[str, str], rtol: float) -> AbstractScene:
        """The scene with one of the gases."""

        def values(options: list[Option]) -> dict[str, Any]:
            return {one.name: one.value(given.get(one.flag), rtol) for one in options}

        matter = gas.make(**gas.fixed, **values(self.of_gases[gas.name]))
        return self.scene(gas=matter, **values(self.of_scene))

    def check_owners(self, given: dict[str, str]) -> None:
        """Raise ValueError for an option that belongs to gases that were not asked for."""
        used = {one.flag for gas in self.gases for one in self.of_gases[gas.name]}
        for name, options in self.of_gases.items():
            for option in options:
                if option.flag in given and option.flag not in used:
                    asked = ", ".join(gas.name for gas in self.gases)
                    raise ValueError(
                        f"--{option.flag} means nothing to the gas {asked}; it is of {name}: "
                        f"write --gas {name}."
                    )

    def unknown(self, word: str) -> str:
        """A sentence about a word that is no option of this command."""
        if not word.startswith("--"):
            return f"{word!r} is not understood; options are written --name value."
        flag = word.removeprefix("--").split("=")[0]
        options = [*self.of_scene, *(one for of in self.of_gases.values() for one in of)]
        meant = [one.flag for one in options if flag.lower() in symbols(one.meaning)]
        near = did_you_mean(flag, [one.flag for one in (*options, *self.of_run)] + list(RESERVED))
        hint = f" (did you mean --{meant[0]}?)" if meant else near.replace("mean ", "mean --")
        others = [
            name
            for name, scene in scenes().items()
            if flag in {one.flag for one in options_of(scene, {}, RESERVED, "scene")}
        ]
        also = f", which is of {', '.join(others)}" if others and not hint else ""
        return f"there is no option --{flag} here{hint}{also}; `{self.command} --help` lists all."

    def parser(self) -> Parser:
        """The parser, whose help explains every option."""
        parser = Parser(
            prog=self.command,
            usage=f"{self.command} [options]",
            description=f"{first_line(self.scene)} {UNITS} Numbers may be ranges first:last:step "
            "and lists separated by commas for `jdsmc sweep`.",
            argument_default=argparse.SUPPRESS,
        )
        add(parser.add_argument_group("scene"), self.of_scene)
        self.add_gases(parser.add_argument_group("gas"))
        run = parser.add_argument_group("run")
        add(run, self.of_run)
        run.add_argument("--no-progress", action="store_true", help="show no progress bar")
        add_files(parser)
        return parser

    def add_gases(self, group) -> None:
        """`--gas`, and the options of all gases, each once, with the names of its owners."""
        names = "; ".join(f"{name}: {gas.meaning}" for name, gas in self.known.items())
        group.add_argument(
            "--gas",
            metavar="NAME[S]",
            help=f"{names}; or module:Class of your own; sweeps take a list "
            f"(default: {self.usual_gas})",
        )
        owners: dict[str, list[str]] = {}
        shown: dict[str, Option] = {}
        for name, options in self.of_gases.items():
            for option in options:
                owners.setdefault(option.flag, []).append(name)
                shown.setdefault(option.flag, option)
        add(group, list(shown.values()), {flag: ", ".join(who) for flag, who in owners.items()})


def fits(gas: Gas, scene: type[AbstractScene], of_scene: list[Option]) -> bool:
    """True if the scene can be made with the gas, all numbers being those taken by default.

    Where a number must be given, only the dimension is looked at.
    """
    if gas.make.dimension not in scene.dimensions:
        return False
    of_gas = options_of(gas.make, gas.fixed, set(), "gas")
    if any(one.default is UNSET for one in (*of_scene, *of_gas)):
        return True
    fields, matter = ({o.name: o.value(None, 0.01) for o in of} for of in (of_scene, of_gas))
    try:
        scene(gas=gas.make(**gas.fixed, **matter), **fields)
    except (TypeError, ValueError):
        return False
    return True


def add(group, options: list[Option], owners: dict[str, str] | None = None) -> None:
    """Options with their help; `owners` says whose each is."""
    for option in options:
        whose = f"{owners[option.flag]}: " if owners else ""
        text = (whose + option.help).replace("%", "%%")
        group.add_argument(f"--{option.flag}", metavar=option.metavar, help=text)


def joined_negatives(words: list[str]) -> list[str]:
    """`--gravity -0.016,0` as `--gravity=-0.016,0`, which is no option."""
    joined: list[str] = []
    for word in words:
        negative = re.match(r"-[.\d]|-(inf|nan)\b", word)
        if negative and joined and joined[-1].startswith("--") and "=" not in joined[-1]:
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined
