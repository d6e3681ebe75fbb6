"""The whole map: `python -m tests.stability --out FOLDER [--only FAMILY] [--docs]`.

Every point is judged and appended to FOLDER/stability.csv; a second call goes on where the first
ended. Then FOLDER/stability.png and FOLDER/stability.md are made, by `--docs` in docs/ too. The
exit status is 1 if a point is wrong.
"""

import argparse
import csv
import sys
from pathlib import Path

import jax

from . import picture
from .judge import WRONG, Verdict, judge
from .points import every_point


def main() -> int:
    """Judge what is not yet in the table, and draw the map."""
    parser = argparse.ArgumentParser(description="Where jdsmc is right, refuses, warns or is wrong")
    parser.add_argument("--out", type=Path, required=True, help="folder of table, picture and page")
    parser.add_argument("--only", default="", help="families whose name contains this")
    parser.add_argument("--docs", action="store_true", help="put page and picture into docs/")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    table = options.out / "stability.csv"
    jax.config.update("jax_enable_x64", True)  # some points ask for float64
    points = every_point()
    known = {(row.family, row.setting) for row in read(table)}
    for point in points:
        if options.only in point.family and (point.family, point.setting) not in known:
            row = judge(point)
            append(table, row)
            said = row.sentence or f"{row.quantity} {picture.found(row)} for {row.expected:.5g}"
            print(f"{row.verdict:8} {row.family}, {row.setting}: {said} [{row.cpu_seconds:.1f} s]")
            sys.stdout.flush()
    found = {(row.family, row.setting): row for row in read(table)}
    rows = [found[key] for p in points if (key := (p.family, p.setting)) in found]
    for folder in [options.out] + [Path(__file__).parents[2] / "docs"] * options.docs:
        picture.draw(rows, folder / "stability.png")
        (folder / "stability.md").write_text(picture.page(rows))
    return int(any(row.verdict == WRONG for row in rows))


def read(table: Path) -> list[Verdict]:
    """The rows that are there."""
    if not table.exists():
        return []
    with table.open(newline="") as file:
        rows = list(csv.DictReader(file))
    numbers = ("value", "error", "expected", "cpu_seconds")
    return [Verdict(**(row | {name: float(row[name]) for name in numbers})) for row in rows]


def append(table: Path, row: Verdict) -> None:
    """One row more."""
    fresh = not table.exists()
    with table.open("a", newline="") as file:
        writer = csv.DictWriter(file, Verdict._fields)
        if fresh:
            writer.writeheader()
        writer.writerow(row._asdict())


if __name__ == "__main__":
    sys.exit(main())
