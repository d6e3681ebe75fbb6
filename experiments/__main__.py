"""`python -m experiments [PAPER] [--full] [--fresh] [--out FOLDER]`: reproduce a study."""

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
    """The command of one paper, or of all."""
    parser = argparse.ArgumentParser(f"python -m experiments{'.' if paper else ''}{paper}")
    if not paper:
        parser.add_argument("paper", choices=PAPERS, help="the study to reproduce")
    parser.add_argument("--full", action="store_true", help="all states, more statistics")
    parser.add_argument("--fresh", action="store_true", help="run every simulation again")
    where = "for simulations (reused), figures and tables; default: output/<paper>/small or full"
    parser.add_argument("--out", type=Path, metavar="FOLDER", help=where)
    given = sys.argv[1:] if arguments is None else arguments
    asked = parser.parse_args(given if given or paper else ["--help"])
    load(paper or asked.paper).main("full" if asked.full else "small", asked.out, asked.fresh)


if __name__ == "__main__":
    cli()
