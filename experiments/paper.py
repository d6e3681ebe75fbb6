"""A published study: its cases are run, its claims judged, its figures drawn, its tables written.

The modules of a paper hand in what is theirs by decorators: `claim`, `section`, `figure`.
"""

import platform
import shutil
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl

from . import markdown, style
from .case import Measurements
from .claims import Claim, table


class Paper:
    """What a study consists of.

    Arguments:
        name: its module in this package; the part before a dot is its folder.
        title, reference: for the head of its table.
        sizes: how much to compute, by name; "small", "full", and "tiny" for tests.
        measure: makes the `Measurements` of a size from a folder.
        table: name of the file of tables.
    """

    def __init__(
        self,
        name: str,
        title: str,
        reference: str,
        sizes: dict[str, Any],
        measure: Callable[[Any, Path, bool], Measurements],
        table: str = "table",
    ):
        self.name, self.title, self.reference = name, title, reference
        self.sizes, self.measure, self.table = sizes, measure, table
        self.claims: list[Claim] = []
        self.sections: dict[str, tuple[str, Callable[[Any], Sequence[str]]]] = {}
        self.figures: dict[str, Callable[[Any], Any]] = {}

    def judge(self, title: str, claims: Iterable[Claim], note: str = "") -> None:
        """A section of claims beside what was measured; `claims` may still grow."""
        self.sections[title] = note, lambda data: table(data.verdict(c) for c in claims)

    def section(self, title: str, note: str = ""):
        """Decorator: a function of the measurements makes the lines of a section."""

        def register(lines: Callable[[Any], Sequence[str]]):
            self.sections[title] = note, lines
            return lines

        return register

    def figure(self, name: str):
        """Decorator: a function of the measurements draws NAME.png."""

        def register(draw: Callable[[Any], Any]):
            self.figures[name] = draw
            return draw

        return register

    def reproduce(self, size: str, folder: Path, fresh: bool = False) -> list[Path]:
        """Simulate, draw and compare. Returns the files: the tables, then the figures."""
        mpl.use("Agg")
        data = self.measure(self.sizes[size], folder, fresh)
        figures = [style.save(draw(data), folder / f"{n}.png") for n, draw in self.figures.items()]
        tables = folder / f"{self.table}.md"
        tables.write_text(self.document(data, size))
        return [tables, *figures]

    def document(self, data: Measurements, size: str) -> str:
        """All tables as one page of Markdown."""
        sections = {f"{self.title} ({size} run)": self._provenance(data)}
        for title, (note, lines) in self.sections.items():
            sections[title] = [*([note, ""] if note else []), *lines(data)]
        return markdown.document(sections)

    def _provenance(self, data: Measurements) -> list[str]:
        """The reference, the versions, the time it took."""
        attrs = [result.attrs for result in data.results.values()]
        commits = ", ".join(sorted({str(one["commit"]) for one in attrs}))
        minutes = sum(float(one["seconds"]) for one in attrs) / 60
        return [
            f"{self.reference}. Made by `python -m experiments.{self.name}`; do not edit.",
            "",
            f"jdsmc {attrs[0]['jdsmc_version']} at {commits} (+: with changes), jax "
            f"{attrs[0]['jax_version']} on {attrs[0]['backend']}, Python "
            f"{platform.python_version()}. The simulations took {minutes:.0f} minutes.",
        ]

    def main(self, size: str, out: Path | None, fresh: bool) -> None:
        """Reproduce, and keep tables and figures beside the code that made them."""
        start = time.perf_counter()
        home = self.name.split(".")[0]
        folder = out or Path("output") / home / size
        folder.mkdir(parents=True, exist_ok=True)
        files = self.reproduce(size, folder, fresh)
        results = Path(__file__).parent / home / "results" / ("" if size == "small" else size)
        results.mkdir(parents=True, exist_ok=True)
        for path in files:
            shutil.copy(path, results / path.name)
        print(f"{files[0]} and {len(files) - 1} figures in {time.perf_counter() - start:.0f} s")
