"""`python -m experiments [PAPER | all] [--full] [--fresh] [--out FOLDER]`: reproduce studies."""

import argparse
import sys
from importlib import import_module
from pathlib import Path

from .paper import Paper

PAPERS = (
    "uniform_shear_flow",
    "heat_flux_force",
    "fourier_flow_gravity",
    "conduction_limits",
    "conduction_limits.convergence",
    "cooling_fluctuations",
    "calibration",
)


def load(name: str) -> Paper:
    """The paper of a module of this package."""
    return import_module(f"experiments.{name}").PAPER


def cli(paper: str = "", arguments: list[str] | None = None) -> None:
    """The command of one paper, or of all; without any argument it lists them."""
    parser = argparse.ArgumentParser(f"python -m experiments{'.' if paper else ''}{paper}")
    if not paper:
        told = "the study to reproduce; by default, and with `all`, one after the other"
        parser.add_argument("paper", nargs="?", choices=(*PAPERS, "all"), default="all", help=told)
    parser.add_argument("--full", action="store_true", help="all states, more statistics")
    parser.add_argument("--fresh", action="store_true", help="run every simulation again")
    where = "simulations (reused), figures, tables: FOLDER/<paper>/small or full; default: output"
    parser.add_argument("--out", type=Path, metavar="FOLDER", default=Path("output"), help=where)
    given = sys.argv[1:] if arguments is None else arguments
    asked = parser.parse_args(given if given or paper else ["--help"])
    name = paper or asked.paper
    for one in PAPERS if name == "all" else (name,):
        load(one).main("full" if asked.full else "small", asked.out, asked.fresh)


if __name__ == "__main__":
    cli()
