"""Run everything: `python -m experiments.uniform_shear_flow [--full] [--out FOLDER] [--fresh]`."""

import json
import time
from pathlib import Path

import matplotlib as mpl
import tyro

from ..publish import keep, output_folder
from ..store import obtain, program
from . import report, report_slab, slab, symmetry
from .data import Measurements
from .figures import draw_all
from .figures.slab import draw_slabs
from .store import obtain_steady
from .systems import FULL, MODULE, SMALL, Size, main_cases, study_cases

RESULTS = Path(__file__).parent / "results"


def main(full: bool = False, out: Path | None = None, fresh: bool = False):
    """Reproduce Astillero and Santos (2005).

    Args:
        full: all ten restitutions, far more statistics and the whole convergence study.
        out: folder for simulations (*.h5, reused if they are what is asked for), figures and
            table.md; by default output/uniform_shear_flow/small or full.
        fresh: run every simulation again.
    """
    mpl.use("Agg")
    start = time.perf_counter()
    size = FULL if full else SMALL
    folder = output_folder("uniform_shear_flow", size.name, out)
    data = measure(size, folder, fresh)
    slabs = slab.measure(slab.SIZES[size.name], folder, fresh)
    study = [obtain_steady(case, folder, fresh) for case in study_cases(size)]
    figures = [*draw_all(data, study, folder), *draw_slabs(slabs, data, folder)]
    inhomogeneous = report_slab.sections(slabs, data)
    table = report.write(data, study, inhomogeneous, size, folder, fresh)
    keep([table, *figures], RESULTS, size.name)
    print(f"{table} and {len(figures)} figures in {time.perf_counter() - start:.0f} s")


def measure(size: Size, folder: Path, fresh: bool) -> Measurements:
    """All homogeneous simulations but the convergence study, and the check of symmetry."""
    cases = {case.name: case for case in main_cases(size)}
    results = {name: obtain(case, folder, fresh) for name, case in cases.items()}
    return Measurements(cases, results, _symmetry(size, folder, fresh))


def _symmetry(size: Size, folder: Path, fresh: bool) -> dict:
    path = folder / "symmetry.json"
    if path.exists() and not fresh:
        kept = json.loads(path.read_text())
        if (kept["options"], kept["program"]) == (size.symmetry, program(MODULE)):
            return kept["values"]
    print("symmetry: running", flush=True)
    values = symmetry.check(**size.symmetry)
    kept = {"options": size.symmetry, "program": program(MODULE), "values": values}
    path.write_text(json.dumps(kept, indent=1))
    return values


if __name__ == "__main__":
    tyro.cli(main)
