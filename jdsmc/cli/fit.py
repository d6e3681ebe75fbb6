"""`jdsmc fit beta`: the rate factor with which an elastic gas does what an inelastic one does."""

import argparse
from dataclasses import replace
from functools import partial

from ..fit.calibrate import USUAL, calibrate
from ..fit.targets import SERIES
from ..gases import ElasticHardSpheres, InelasticHardSpheres
from ..scenarios import UniformShear
from .arguments import Parser, add, joined_negatives
from .catalogue import did_you_mean
from .keep import check_files, keep
from .numbers import numbers, one_number
from .options import Option, chosen, run_options, text

WHAT = "beta"
UNUSED = {"duration", "collisions", "observable"}
"""Options of a run that a fit decides."""


def fit_options() -> list[Option]:
    """The options of the fit itself."""
    drags = partial(chosen, choices=("local", "measured"))
    table = (
        ("restitution", numbers, "0.5:0.95:0.05", "NUMBER[S]",
         "coefficient of normal restitution α; in (0, 1)"),
        ("target", text, "shear_stress,reduced_shear_rate", "NAME[S]",
         "observables of the sheared gas to match: a,b each alone, a+b together"),
        ("drag", drags, "local", "NAME", "friction of the elastic gas: local, measured"),
        ("free", text, "rate_factor", "NAME[S]",
         "what is adjusted: rate_factor, drag_factor, or both with a comma"),
        ("shear_rate", one_number, 4.0, "NUMBER",
         "shear rate a in 1/τ0, on which no result depends"),
    )  # fmt: skip
    return [
        Option(name.replace("_", "-"), name, meaning, read, default, metavar)
        for name, read, default, metavar, meaning in table
    ]


def fit(words: list[str]) -> int:
    """Run `jdsmc fit WORDS`; the exit status.

    Raises ValueError, TypeError or OSError for bad input, before anything is computed.
    """
    if not words or (words[0] != WHAT and not {"-h", "--help"} & set(words[:1])):
        near = did_you_mean(words[0], [WHAT]) if words else ""
        raise ValueError(f"`jdsmc fit` needs what to fit: {WHAT}{near}.")
    own, of_run = fit_options(), usual_run_options()
    parser = fit_parser(own, of_run)
    if {"-h", "--help"} & set(words):
        print(parser.format_help(), end="")
        return 0
    known, rest = parser.parse_known_args(joined_negatives(words[1:]))
    if rest:
        near = did_you_mean(rest[0].removeprefix("--"), [one.flag for one in (*own, *of_run)])
        raise ValueError(
            f"there is no option {rest[0]} here{near.replace('mean ', 'mean --')}; "
            f"`jdsmc fit {WHAT} --help` lists all."
        )
    given = {flag.replace("_", "-"): said for flag, said in vars(known).items()}
    asked = {one.name: one.value(given.get(one.flag), None) for one in own}
    options = {one.name: one.value(given.get(one.flag), None) for one in of_run}
    options["progress"] = "no-progress" not in given
    check_files(given.get("out"), given.get("plot"))
    alpha = asked["restitution"]
    alpha = numbers("restitution", alpha) if isinstance(alpha, str) else alpha
    if SERIES in asked["target"]:
        raise ValueError(
            f"target {asked['target']!r} is a whole transient; fit it in Python, by "
            "jdsmc.fit.calibrate(..., duration=...)."
        )
    rate = asked["shear_rate"]
    found = calibrate(
        UniformShear(InelasticHardSpheres(alpha), rate),
        UniformShear(ElasticHardSpheres(alpha, drag=asked["drag"]), rate),
        asked["target"],
        free=tuple(asked["free"].split(",")),
        **options,
    )
    files = given.get("out"), given.get("plot")
    return keep({WHAT: found}, *files, join=False, spare=f"jdsmc-fit-{WHAT}")


def usual_run_options() -> list[Option]:
    """The options of `jdsmc.run`, with what a fit takes if nothing is said."""
    found = run_options(UNUSED, USUAL["rtol"], "(default: 4096)")
    return [replace(o, default=USUAL[o.name]) if o.name in USUAL else o for o in found]


def fit_parser(own: list[Option], of_run: list[Option]) -> Parser:
    """The parser, whose help explains every option."""
    parser = Parser(
        prog=f"jdsmc fit {WHAT}",
        usage=f"jdsmc fit {WHAT} [options]",
        description="Rate factor β(α) with which elastic hard spheres under a drag do what "
        "inelastic ones do in steady shear; NaN where none does.",
        argument_default=argparse.SUPPRESS,
    )
    add(parser.add_argument_group("fit"), own)
    run = parser.add_argument_group("run")
    add(run, of_run)
    run.add_argument("--no-progress", action="store_true", help="show no progress bar")
    files = parser.add_argument_group("files")
    files.add_argument("--out", metavar="FILE", help="file to write (HDF5); must not exist")
    files.add_argument("--plot", metavar="FILE", help="picture to write (PNG, PDF or SVG)")
    return parser
