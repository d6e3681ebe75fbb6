"""Tables in Markdown: quoted numbers and statements beside what was measured."""

import platform
from collections.abc import Iterable, Mapping, Sequence

from jdsmc import Result

from .claims import Claim, Finding
from .compare import Comparison, shown

HOLDS = {True: "holds", False: "**does not hold**", None: "not resolved"}


def document(sections: Mapping[str, Iterable[str]]) -> str:
    """A page of titles and their lines; the first title is that of the page."""
    lines = []
    for level, (title, body) in enumerate(sections.items()):
        lines += [f"{'#' if level == 0 else '##'} {title}", "", *body, ""]
    return "\n".join(lines)


def versions(results: Sequence[Result]) -> str:
    """A sentence on what made the results."""
    attrs = results[0].attrs
    commits = sorted({str(result.attrs["commit"]) for result in results})
    return (
        f"jdsmc {attrs['jdsmc_version']} at {', '.join(commits)} (+: with changes), jax "
        f"{attrs['jax_version']} on {attrs['backend']}, Python {platform.python_version()}."
    )


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
