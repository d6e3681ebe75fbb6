"""Rows of a campaign, in a file that a second call goes on with."""

import csv
from pathlib import Path


class Rows:
    """A table of named columns, made with its folder if it is not there."""

    def __init__(self, path: Path, columns):
        self.path, self.columns = path, columns
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(",".join(columns) + "\n")

    def all(self) -> list[dict]:
        """What the table holds, as text."""
        with self.path.open(newline="") as file:
            return list(csv.DictReader(file))

    def add(self, rows: list[dict]) -> None:
        """Some rows more."""
        with self.path.open("a", newline="") as file:
            csv.DictWriter(file, self.columns).writerows(rows)
