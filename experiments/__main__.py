"""`python -m experiments [PAPER] [--full] [--fresh] [--out FOLDER]`: reproduce a published study."""

from importlib import import_module
from pathlib import Path
from typing import Annotated

import tyro

from .paper import Paper

PAPERS = (
    "uniform_shear_flow",
    "heat_flux_force",
    "fourier_flow_gravity",
    "conduction_limits",
    "conduction_limits.convergence",
)


def load(name: str) -> Paper:
    """The paper of a module of this package."""
    return import_module(f"experiments.{name}").PAPER


def cli(name: str = "") -> None:
    """The command of all papers, or of one."""

    def one(full: bool = False, fresh: bool = False, out: Path | None = None) -> None:
        """Reproduce a published study: its figures, and every number and statement of its text.

        Args:
            full: all states and several times the statistics.
            fresh: run every simulation again.
            out: folder for simulations (*.h5, reused if they are what is asked for), figures and
                tables; by default output/<paper>/small or full.
        """
        load(name).main("full" if full else "small", out, fresh)

    def any_of_them(
        paper: Annotated[str, tyro.conf.Positional] = "",
        full: bool = False,
        fresh: bool = False,
        out: Path | None = None,
    ) -> None:
        nonlocal name
        if paper not in PAPERS:
            print(f"python -m experiments PAPER [--full] [--fresh] [--out FOLDER]{WHICH}")
            raise SystemExit(2 if paper else 0)
        name = paper
        one(full, fresh, out)

    any_of_them.__doc__ = one.__doc__
    tyro.cli(one if name else any_of_them)


WHICH = "\nPAPER is one of:\n" + "\n".join(f"  {name}" for name in PAPERS)

if __name__ == "__main__":
    cli()
