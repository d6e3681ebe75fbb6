"""Tables and pages in Markdown."""

from collections.abc import Iterable, Sequence


def grid(header: Sequence[str], rows: Iterable[Sequence]) -> list[str]:
    """A Markdown table; cells are shown by `str`."""
    lines = [header, ["---"] * len(header), *rows]
    return [f"| {' | '.join(str(c).replace('|', chr(92) + '|') for c in row)} |" for row in lines]


def score(sigma: float, limit: float = 3.0) -> str:
    """A distance in standard errors, bold beyond a limit."""
    return f"**{sigma:.1f}**" if abs(sigma) > limit else f"{sigma:.1f}"
