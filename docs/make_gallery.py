"""Write the gallery: every figure of the experiments, what it shows, and their tables of numbers.

A page takes the full run of a study where there is one, and the small one for what the full run
has not; each figure says which, and the command that makes it.
"""

import re
import shutil
from pathlib import Path

from experiments.__main__ import PAPERS, load

ROOT = Path(__file__).parents[1]
BENCHMARKS = ROOT / "benchmarks" / "results"
QUOTED = r"^## Quoted numbers\n.*?(?=^## |\Z)"


def write(folder: Path) -> None:
    """One page a study, one for each of its tables, one of benchmarks."""
    folder.mkdir(exist_ok=True)
    studies: dict[str, list[str]] = {}
    for name in PAPERS:
        studies.setdefault(name.split(".")[0], []).append(name)
    for study, parts in studies.items():
        (folder / f"gallery_{study}.md").write_text(page(study, parts, folder), encoding="utf-8")
    (folder / "benchmarks.md").write_text(speed(), encoding="utf-8")
    for picture in BENCHMARKS.glob("*.png"):
        shutil.copyfile(picture, folder / picture.name)


def page(study: str, parts: list[str], folder: Path) -> str:
    """What the study says of itself, the quoted numbers, its figures; the tables lie beside."""
    results = ROOT / "experiments" / study / "results"
    readme = text_of(ROOT / "experiments" / study / "README.md").strip()
    known = {figure: name for name in parts for figure in load(name).figures}
    others = {picture.stem: study for picture in sorted(results.glob("*.png"))}
    order = sorted(known | others, key=lambda name: (not name.startswith("fig"), name))
    figures = [one for figure in order for one in shown(figure, known, results, folder)]
    tables = write_tables(study, results, folder)
    return "\n\n".join([readme, *quoted(results), "## Figures", *figures, *tables]) + "\n"


def quoted(results: Path) -> list[str]:
    """The paper's numbers beside ours, from the table of the largest run."""
    for run, where in (("full", results / "full"), ("small", results)):
        table = where / "table.md"
        if table.is_file():
            found = re.search(QUOTED, text_of(table), re.M | re.S)
            return [found[0].strip().replace("numbers", f"numbers ({run} run)", 1)] if found else []
    return []


def text_of(page: Path) -> str:
    """A page whose stars in κ*, a* and the like stay stars, and whose links lead to the site."""
    text = page.read_text(encoding="utf-8").replace("](../../../docs/", "](../")
    text = re.sub(r"`?docs/(\w+\.md)`?", r"[](../\1)", text)
    return re.sub(r"(?<![A-Za-z*])(Δ?[A-Za-zα-ωΑ-Ω])\*(?!\*)", r"\1\*", text)


def shown(figure: str, known: dict[str, str], results: Path, folder: Path) -> list[str]:
    """A heading, the command, the picture of the largest run there is."""
    full, small = results / "full" / f"{figure}.png", results / f"{figure}.png"
    source = full if full.is_file() else small
    if not source.is_file():
        return []
    study = results.parent.name
    shutil.copyfile(source, folder / f"{study}_{source.name}")
    name = known.get(figure)
    caption = " ".join((load(name).figures[figure].__doc__ or "").split()) if name else ""
    command = f"`python -m experiments.{name or study}{' --full' if source == full else ''}`"
    image = f"![{caption or figure}]({study}_{source.name})"
    return [f"### {title_of(figure)}", f"{plain(caption)} {command}".strip(), image]


def title_of(figure: str) -> str:
    """The name of a picture in words: fig07_transient_0.9 is Figure 7: transient 0.9."""
    found = re.match(r"fig0*(\d+)_(.*)", figure)
    words = (found[2] if found else figure).replace("_", " ")
    return f"Figure {found[1]}: {words}" if found else words.capitalize()


def plain(text: str) -> str:
    """Text that Markdown shows as it is."""
    return re.sub(r"([*_<$])", r"\\\1", text)


def write_tables(study: str, results: Path, folder: Path) -> list[str]:
    """A page for each table of the small and the full run, and the navigation to them."""
    names = []
    for run, where in (("small", results), ("full", results / "full")):
        for table in sorted(where.glob("*.md")):
            name = f"numbers_{study}_{table.stem}_{run}"
            (folder / f"{name}.md").write_text(text_of(table), encoding="utf-8")
            names.append(name)
    return ["## All numbers", "```{toctree}\n:maxdepth: 1\n\n" + "\n".join(names) + "\n```"]


def speed() -> str:
    """The charts and tables of the benchmarks."""
    parts = ["# Benchmarks", SPEED]
    for table in sorted(BENCHMARKS.glob("*.md")):
        parts.append(re.sub(r"^#", "##", table.read_text(encoding="utf-8").strip(), flags=re.M))
        parts += [f"![{p.stem}]({p.name})" for p in sorted(BENCHMARKS.glob(f"{table.stem}*.png"))]
    return "\n\n".join(parts) + "\n"


SPEED = """\
Made by the commands of `benchmarks/`, each on the machine that it names; ratios of programs
run side by side on it mean more than times."""
