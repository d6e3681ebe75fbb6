"""Tables in Markdown: quoted numbers and statements beside what was measured."""

from collections.abc import Iterable, Sequence

from .claims import Claim, Finding
from .compare import Comparison, shown

HOLDS = {True: "holds", False: "**does not hold**", None: "not resolved"}


def grid(header: Sequence[str], rows: Iterable[Sequence[str]]) -> list[str]:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in lines]


def numbers(comparisons: Sequence[Comparison]) -> list[str]:
    """Quoted numbers beside ours."""
    return grid(
        ["quantity", "place", "paper", "ours", "verdict"],
        (
            [
                c.quoted.what,
                c.quoted.place,
                f"{c.quoted.value:g} ± {c.quoted.half_width:g}",
                shown(c.ours),
                c.verdict if c.agrees else f"**{c.verdict}**",
            ]
            for c in comparisons
        ),
    )


def statements(findings: Sequence[tuple[Claim, Finding]]) -> list[str]:
    """Statements without a number."""
    return grid(
        ["statement", "place", "measured", "verdict"],
        (
            [claim.what, claim.place, found.measured, HOLDS[_plain(found.holds)]]
            for claim, found in findings
        ),
    )


def _plain(holds) -> bool | None:
    return None if holds is None else bool(holds)
