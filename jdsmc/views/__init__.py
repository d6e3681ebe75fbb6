"""How results are shown to people: tables and pictures."""

from . import generic


def table(result) -> str:
    """Steady values with errors, beside theory."""
    return generic.table(result)


def draw(result):
    """The matplotlib figure of a result."""
    return generic.draw(result)
