"""`python -m benchmarks.work_precision [--quick] [--out FOLDER] [--only SCENE ...]`."""

import argparse
from pathlib import Path

from .chart import defaults, draw
from .measure import campaign
from .scenes import SCENES


def main() -> None:
    """Measure what the table lacks; draw a picture a scene, write the table of the defaults."""
    parser = argparse.ArgumentParser("python -m benchmarks.work_precision")
    parser.add_argument("--quick", action="store_true", help="short runs: shows that it works")
    parser.add_argument("--out", type=Path, default=Path("output/work_precision"), metavar="FOLDER")
    parser.add_argument("--only", nargs="+", choices=[one.name for one in SCENES], metavar="SCENE")
    given = parser.parse_args()
    given.out.mkdir(parents=True, exist_ok=True)
    chosen = [one for one in SCENES if given.only is None or one.name in given.only]
    rows = campaign(chosen, given.out / "work_precision.csv", quick=given.quick)
    for scene in chosen:
        print(draw(scene, rows, given.out))
    page = given.out / "work_precision.md"
    page.write_text(defaults(rows, quick=given.quick))
    print(page)


if __name__ == "__main__":
    main()
