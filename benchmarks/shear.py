"""All benchmarks of the homogeneous sheared gas: `python -m benchmarks.shear [--quick]`.

Writes benchmarks/results/shear.json (raw numbers), shear.md (tables made from it) and two figures;
with --quick the same at tiny sizes into benchmarks/results/quick. Every measurement runs in a
process of its own (`worker.py`); other work on the machine spoils it.
"""

import argparse
import json
from pathlib import Path
from time import perf_counter

from . import figures, gpu, precision, report, scaling, startup, throughput
from .timing import machine, say, write_json

RESULTS = Path(__file__).parent / "results"
PARTS = {
    "throughput": throughput.measure,
    "precision": precision.measure,
    "scaling": scaling.measure,
    "startup": startup.measure,
    "gpu": gpu.measure,
}


def main() -> None:
    """Measure, then write tables and figures."""
    options = _options()
    folder = RESULTS / "quick" if options.quick else RESULTS
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "shear.json"
    data = {}
    if options.only is not None and path.exists():
        data = json.loads(path.read_text())
    parts = list(PARTS) if options.only is None else options.only
    if parts or not data:
        data |= {"quick": options.quick, "machine": machine()}
    begin = perf_counter()
    for name in parts:
        data[name] = PARTS[name](options.quick)
        say(f"{name} done after {(perf_counter() - begin) / 60:.1f} minutes")
        write_json(path, data)
    if options.only is None:
        data["minutes"] = (perf_counter() - begin) / 60
        write_json(path, data)
    text = report.tables(data)
    (folder / "shear.md").write_text(text)
    files = figures.draw(data, folder, "shear")
    say("\n" + text + "\n" + "\n".join(map(str, [path, folder / "shear.md", *files])))


def _options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Benchmarks of the homogeneous sheared gas.")
    parser.add_argument("--quick", action="store_true", help="tiny sizes, into results/quick")
    parser.add_argument(
        "--only",
        nargs="*",
        choices=list(PARTS),
        help="measure these parts anew and keep the others; none: tables and figures only",
    )
    return parser.parse_args()


if __name__ == "__main__":
    main()
