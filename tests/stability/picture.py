"""The map as a picture and a page."""

from itertools import groupby
from pathlib import Path

from .judge import REFUSED, RIGHT, VERDICTS, WARNED, WRONG, Verdict

COLOURS = {RIGHT: "#4c9f70", WARNED: "#e3b23c", REFUSED: "#8fa6b8", WRONG: "#c0392b"}
MARKS = {RIGHT: "", WARNED: "w", REFUSED: "r", WRONG: "!"}

HEAD = """\
# Where it is right, and where it says no

Made by `python -m tests.stability --out FOLDER --docs`. Every scene is run at the edges of what it
allows, cheaply, and held to a closed form or a limit (`tests/stability`): a
point is *right* if it is within five standard errors and a tolerance, *warned* if the result comes
with a remark, *refused* if a sentence says what to change, and WRONG otherwise, or if its error is
so large that it tells nothing. {count} points took {cpu:.0f} s of one core: {summary}.

![Verdicts by family](stability.png)
"""


def draw(rows: list[Verdict], path: Path) -> None:
    """A row of boxes for each family, a box for each setting."""
    import matplotlib  # noqa: PLC0415 - slow to import

    matplotlib.use("agg")
    from matplotlib import pyplot  # noqa: PLC0415
    from matplotlib.patches import Patch, Rectangle  # noqa: PLC0415

    families = by_family(rows)
    most = max(len(points) for _, points in families)
    size = (1.6 + 1.05 * most, 0.8 + 0.52 * len(families))
    figure, panel = pyplot.subplots(figsize=size, layout="constrained")
    for line, (_, points) in enumerate(families):
        for place, row in enumerate(points):
            box = Rectangle((place, -line), 0.94, 0.84, color=COLOURS[row.verdict], lw=0)
            panel.add_patch(box)
            text = row.setting.replace(", ", "\n")
            style = {"ha": "center", "va": "center", "fontsize": 6.5 if len(text) < 14 else 5.2}
            panel.text(place + 0.47, 0.42 - line, text, **style)
    panel.set(xlim=(0, most), ylim=(1 - len(families), 0.9), xticks=[])
    panel.set_yticks([0.42 - k for k in range(len(families))], [name for name, _ in families])
    panel.tick_params(length=0)
    panel.spines[:].set_visible(False)
    shown = [Patch(color=COLOURS[one], label=one) for one in VERDICTS]
    figure.legend(handles=shown, loc="outside lower center", ncols=4, frameon=False, fontsize=8)
    figure.savefig(path, dpi=130)
    pyplot.close(figure)


def page(rows: list[Verdict]) -> str:
    """Every point with its numbers, or the sentence that came instead."""
    counts = {one: sum(row.verdict == one for row in rows) for one in VERDICTS}
    summary = ", ".join(f"{number} {one}" for one, number in counts.items())
    cpu = sum(row.cpu_seconds for row in rows)
    parts = [HEAD.format(count=len(rows), cpu=cpu, summary=summary)]
    for family, points in by_family(rows):
        parts.append(f"\n## {family[:1].upper()}{family[1:]}\n")
        parts.append("| setting | verdict | what was held | found | must be | what was said |")
        parts.append("|---|---|---|---|---|---|")
        parts += [
            f"| {row.setting} | {row.verdict} | {row.quantity} | {found(row)} | "
            f"{'' if row.expected != row.expected else f'{row.expected:.5g}'} | {row.sentence} |"
            for row in points
        ]
    return "\n".join(parts) + "\n"


def found(row: Verdict) -> str:
    """Value and error of the worst quantity of a point."""
    return "" if row.value != row.value else f"{row.value:.5g} ± {row.error:.2g}"


def by_family(rows: list[Verdict]) -> list[tuple[str, list[Verdict]]]:
    """Families in the order of the map."""
    return [(name, list(points)) for name, points in groupby(rows, key=lambda row: row.family)]
