"""A published study: its cases are run, its claims judged, its figures drawn, its tables written.

The folder of a paper holds what it says (`claims.txt`), how much to compute ("small", "full", and
"tiny" for tests: `sizes.toml`) and the page that is made (`table.template.md`), in which
`{Heading}` stands for the claims under a heading and `{name}` for a table. What decides the claim
`key`, and what makes the table `name`, are functions of these names in the modules of a paper
(`Paper.take`); figures are registered by a decorator.
"""

import platform
import re
import shutil
import time
import tomllib
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from . import claims, markdown, style
from .case import Measurements

HERE = Path(__file__).parent


class Paper:
    """What a study consists of.

    Arguments: its module in this package, the part before a dot being its folder; what makes the
    `Measurements` of a size from a folder; the name of the template and of the page made of it.
    """

    def __init__(self, name: str, measure: Callable[[Any, Path, bool], Any], page: str = "table"):
        self.name, self.measure, self.page = name, measure, page
        self.folder = HERE / name.split(".", maxsplit=1)[0]
        sizes = tomllib.loads((self.folder / "sizes.toml").read_text())
        self.sizes = {size: SimpleNamespace(**amounts) for size, amounts in sizes.items()}
        self.template = (self.folder / f"{page}.template.md").read_text()
        text = self.folder / "claims.txt"
        self.claims = claims.read(text) if text.exists() else {}
        self.measures: dict[str, Callable[[Any], Any]] = {}
        self.tables: dict[str, Callable[[Any], Sequence[str] | str]] = {"simulations": simulations}
        self.figures: dict[str, Callable[[Any], Figure]] = {}

    def take(self, claims: Sequence[ModuleType], tables: Sequence[ModuleType]) -> "Paper":
        """Functions of the measurements in these modules decide the claims of their names.

        Such a function returns a `Finding` for a sentence, and for a number an `Estimate`, a `Span`
        or a number. Those of `tables` make what stands for their names: lines, or a text.
        """
        for module in claims:
            self.measures = _own(module) | self.measures
        for module in tables:
            self.tables = _own(module) | self.tables
        return self

    def figure(self, name: str, rows: int, columns: int, width: float, height: float, **options):
        """Decorator: a function of the measurements and of axes (rows, columns) draws NAME.png."""

        def register(draw: Callable[[Any, Any], None]):
            def drawn(data) -> Figure:
                found, axes = style.figure(rows, columns, width, height, **options)
                draw(data, axes)
                return found

            drawn.__doc__ = (draw.func if isinstance(draw, partial) else draw).__doc__
            self.figures[name] = drawn
            return draw

        return register

    def verdicts(self, data: Measurements, heading: str) -> list[claims.Verdict]:
        """What the claims under a heading come to; measured once."""
        known = data.verdicts
        for claim in self.claims[heading]:
            if claim not in known:
                known[claim] = claims.judge(claim, self.measures[claim.key](data))
        return [known[claim] for claim in self.claims[heading]]

    def reproduce(self, size: str, folder: Path, fresh: bool = False) -> list[Path]:
        """Simulate, draw and compare. Returns the files: the page of tables, then the figures."""
        mpl.use("Agg")
        data = self.measure(self.sizes[size], folder, fresh)
        figures = [style.save(draw(data), folder / f"{n}.png") for n, draw in self.figures.items()]
        page = folder / f"{self.page}.md"
        page.write_text(self.filled(data, size))
        return [page, *figures]

    def filled(self, data: Measurements, size: str) -> str:
        """The template with its tables."""

        def lines(found: re.Match) -> str:
            name = found[1]
            if name in self.claims:
                made = claims.table(self.verdicts(data, name))
            else:
                made = self.tables[name](data)
            return made if isinstance(made, str) else "\n".join(made)

        text = self.template.replace("{size}", size).replace("{provenance}", self.made_by(data))
        return re.sub(r"\{([^{}\n]+)\}", lines, text)

    def made_by(self, data: Measurements) -> str:
        """The command, the versions, the time it took."""
        attrs = [result.attrs for result in data.results.values()]
        commits = ", ".join(sorted({str(one["commit"]) for one in attrs}))
        minutes = sum(float(one["seconds"]) for one in attrs) / 60
        return (
            f"Made by `python -m experiments.{self.name}`; do not edit. jdsmc "
            f"{attrs[0]['jdsmc_version']} at {commits} (+: with changes), jax "
            f"{attrs[0]['jax_version']} on {attrs[0]['backend']}, Python "
            f"{platform.python_version()}. The simulations took {minutes:.0f} minutes."
        )

    def main(self, size: str, out: Path, fresh: bool) -> None:
        """Reproduce, and keep tables and figures beside the code that made them."""
        start = time.perf_counter()
        folder = out / self.folder.name / size
        folder.mkdir(parents=True, exist_ok=True)
        files = self.reproduce(size, folder, fresh)
        results = self.folder / "results" / ("" if size == "small" else size)
        results.mkdir(parents=True, exist_ok=True)
        for path in files:
            shutil.copy(path, results / path.name)
        print(f"{files[0]} and {len(files) - 1} figures in {time.perf_counter() - start:.0f} s")


def _own(module: ModuleType) -> dict[str, Callable]:
    """Functions that a module defines."""
    own = {n: f for n, f in vars(module).items() if getattr(f, "__module__", "") == module.__name__}
    return {name: function for name, function in own.items() if callable(function)}


def simulations(data: Measurements) -> list[str]:
    """What was run: sizes, times, seconds."""
    rows = []
    for name, result in data.results.items():
        attrs, root, time = result.attrs, result.steady, result.series["time"].values
        size = f"{attrs['n_particles']} x {attrs['n_realizations']}"
        cells = ["", "", ""]
        if result.is_steady and "collisions" in result.series:
            start = root["steady_from_time"].values
            spent = result.series["collisions"].values[..., -1]
            spent = spent - root["steady_from_collisions"].values
            cells = [_range(start, ".0f"), _range(spent, ".0f")]
            cells += [_range(root["time_step"].values, ".3f") if "time_step" in root else ""]
        seconds = f"{float(attrs['seconds']):.0f}"
        rows.append([name, size, f"{time.max():.4g}", *cells, seconds, attrs["stopped"]])
    header = ["simulation", "N x realizations", "τ0", "averaged from (τ0)", "collisions averaged"]
    return markdown.grid([*header, "dt made (τ)", "s", "ended"], rows)


def _range(values, digits: str) -> str:
    known = values[abs(values) >= 0.0]  # not NaN
    ends = [format(float(one), digits) for one in (known.min(), known.max())] if known.size else []
    return " to ".join(dict.fromkeys(ends))
