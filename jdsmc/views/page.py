"""Tables as data, and their two forms: text of fixed width, and HTML."""

import html
import unicodedata
from typing import NamedTuple


class Block(NamedTuple):
    """A table: its heading, rows of as many cells, and the columns that are words."""

    head: list[str]
    rows: list[list[str]]
    words: tuple[int, ...] = ()


class Page(NamedTuple):
    """Tables one below the other, and sentences after them."""

    blocks: list[Block]
    notes: list[str]


def as_text(page: Page) -> str:
    """Columns of fixed width; numbers to the right, words to the left."""
    return "\n".join([line for block in page.blocks for line in _lines(block)] + page.notes)


def _lines(block: Block) -> list[str]:
    cells = [block.head, *block.rows]
    widths = [max(map(_width, column)) for column in zip(*cells, strict=True)]

    def padded(row: list[str]) -> str:
        parts = []
        for column, (cell, width) in enumerate(zip(row, widths, strict=True)):
            space = " " * (width - _width(cell))
            parts.append(cell + space if column in block.words else space + cell)
        return "  ".join(parts).rstrip()

    return [padded(row) for row in cells]


def _width(text: str) -> int:
    """Places on a line: a combining mark takes none."""
    return sum(1 for letter in text if not unicodedata.combining(letter))


def as_html(page: Page) -> str:
    """Tables and paragraphs; every text is escaped."""
    tables = "".join(_html_table(block) for block in page.blocks)
    return tables + "".join(f"<p>{html.escape(note)}</p>" for note in page.notes)


def _html_table(block: Block) -> str:
    def row(cells: list[str], tag: str) -> str:
        parts = []
        for column, cell in enumerate(cells):
            side = "left" if column in block.words else "right"
            parts.append(f'<{tag} style="text-align: {side}">{html.escape(cell)}</{tag}>')
        return f"<tr>{''.join(parts)}</tr>"

    body = "".join(row(cells, "td") for cells in block.rows)
    return f"<table><thead>{row(block.head, 'th')}</thead><tbody>{body}</tbody></table>"
