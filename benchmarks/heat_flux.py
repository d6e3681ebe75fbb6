"""The gas under the heat-flux force: `python -m benchmarks.heat_flux [--quick]`.

Writes benchmarks/results/heat_flux.json (raw numbers) and heat_flux.md (tables made from it); with
--quick the same at tiny sizes into benchmarks/results/quick. Every measurement runs in a process of
its own (`worker.py`) on two cores; other work on the machine spoils it.
"""

import argparse
from pathlib import Path
from time import perf_counter

from . import conductivity, conductivity_report
from .timing import machine, say, write_json

RESULTS = Path(__file__).parent / "results"


def main() -> None:
    """Measure, then write the tables."""
    parser = argparse.ArgumentParser(description="Benchmarks of the heat-flux force.")
    parser.add_argument("--quick", action="store_true", help="tiny sizes, into results/quick")
    quick = parser.parse_args().quick
    folder = RESULTS / "quick" if quick else RESULTS
    folder.mkdir(parents=True, exist_ok=True)
    begin = perf_counter()
    data = {"quick": quick, "machine": machine(), **conductivity.measure(quick)}
    data["minutes"] = (perf_counter() - begin) / 60
    write_json(folder / "heat_flux.json", data)
    text = conductivity_report.tables(data)
    (folder / "heat_flux.md").write_text(text)
    say("\n" + text)


if __name__ == "__main__":
    main()
