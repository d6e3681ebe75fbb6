"""Run everything: `python -m experiments.fourier_flow_gravity`; --help lists the options."""

import time
from pathlib import Path

import matplotlib as mpl
import tyro

from ..publish import keep, output_folder
from . import report
from .data import measure
from .figures import draw_all
from .systems import FULL, SMALL, Size

RESULTS = Path(__file__).parent / "results"


def main(full: bool = False, out: Path | None = None, fresh: bool = False):
    """Reproduce Tahiri, Tij and Santos, heat conduction under gravity (2000).

    Args:
        full: all 51 states of the paper and two more of its figures, with more statistics.
        out: folder for simulations (*.h5, reused if they are what is asked for), figures and
            table.md; by default output/fourier_flow_gravity/small or full.
        fresh: run every simulation again.
    """
    start = time.perf_counter()
    size = FULL if full else SMALL
    folder = output_folder("fourier_flow_gravity", size.name, out)
    table, *figures = reproduce(size, folder, fresh)
    keep([table, *figures], RESULTS, size.name)
    print(f"{table} and {len(figures)} figures in {time.perf_counter() - start:.0f} s")


def reproduce(size: Size, folder: Path, fresh: bool) -> list[Path]:
    """Simulate, draw and compare. Returns the files: table.md, then the figures."""
    mpl.use("Agg")
    data = measure(size, folder, fresh)
    figures = draw_all(data, folder)
    return [report.write(data, folder), *figures]


if __name__ == "__main__":
    tyro.cli(main)
