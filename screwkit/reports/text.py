"""Blocks for a terminal: the answer first, aligned columns, nothing to decode."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, assert_never

from screwkit.reports.blocks import (
    Bibliography,
    Block,
    Citation,
    Column,
    Condition,
    Figure,
    Formula,
    Heading,
    Listing,
    Loci,
    Loose,
    Math,
    Matrix,
    Paragraph,
    Prose,
    Reference,
    Span,
    Strong,
    Table,
    Text,
    Words,
)
from screwkit.reports.expressions import expression, locus
from screwkit.reports.printing import HARD_SPACE, for_terminal, printable, strong

WIDTH: Final = 100
CAP: Final = 160
_GAP: Final = "  "
_LEAST: Final = 18


@dataclass(frozen=True, slots=True)
class Page:
    """What the terminal offers.

    Attributes:
        width: Columns.
        cap: Characters of an expression's text beyond which it is summarised.
        bold: Whether answers and headings are set in bold.
    """

    width: int = WIDTH
    cap: int = CAP
    bold: bool = False


def render(blocks: Sequence[Block], page: Page | None = None) -> str:
    """The blocks as one text that ends in a newline."""
    page = page or Page()
    parts: list[str] = []
    previous: Block | None = None
    for block in blocks:
        text = _render(block, page)
        if not text:
            continue
        if previous is not None and _apart(previous, block):
            parts.append("")
        parts.append(text)
        previous = block
    return for_terminal("\n".join(parts) + "\n") if parts else ""


def inline(text: Text, page: Page | None = None) -> str:
    """A text on one line."""
    return for_terminal(_inline(text, page or Page()))


def _inline(text: Text, page: Page) -> str:
    return "".join(_span(span, page) for span in text)


def _apart(before: Block, block: Block) -> bool:
    """Whether an empty line stands between two blocks."""
    if isinstance(before, Heading):
        return before.level == 0 and not isinstance(block, Paragraph)
    if isinstance(block, Table) or isinstance(before, Table):
        return True
    if isinstance(block, Heading):
        return block.level < 2
    if isinstance(block, Paragraph):
        if isinstance(before, Paragraph):
            return before.indent == 0 and block.indent > 0
        return isinstance(before, Listing) and block.indent < 2
    return False


def _span(span: Span, page: Page) -> str:
    match span:
        case Words(text) | Prose(text):
            return printable(text)
        case Loose(text):
            return printable(text).replace(" - ", " − ").replace("*", "·")
        case Strong(text):
            text = printable(text)
            return strong(text) if page.bold else text
        case Math(text, terms):
            return expression(text, terms, page.cap)
        case Loci(factors):
            return locus(factors, page.cap)
        case Reference(_, number):
            return printable(number)
        case Citation(key, place):
            return printable(f"[{key}, {place}]" if place else f"[{key}]")
        case _:
            assert_never(span)


def _render(block: Block, page: Page) -> str:
    match block:
        case Heading(text, level, aside):
            return _heading(_inline(text, page), level, _inline(aside, page), page)
        case Paragraph(text, indent):
            return _paragraph(_inline(text, page), "  " * indent, page)
        case Formula(body, _):
            return "    " + _inline((body,), page)
        case Matrix(name, rows, _):
            return _matrix(name, rows, page)
        case Table():
            return _table(block, page)
        case Listing(items, indent):
            return _listing(items, 2 * indent, page)
        case Figure(_, caption, _):
            return _paragraph(f"picture: {_inline(caption, page)}", "  ", page)
        case Bibliography(entries):
            lines = (f"[{entry.key}]  {entry.text}" for entry in entries)
            return "\n".join(map(printable, lines))
        case _:
            assert_never(block)


def _heading(text: str, level: int, aside: str, page: Page) -> str:
    shown = strong(text) if page.bold else text
    indent = "  " * max(level - 1, 0)
    if not aside:
        return indent + shown
    gap = page.width - len(indent) - len(text) - len(aside)
    return indent + shown + " " * max(gap, 2) + aside


def _paragraph(text: str, indent: str, page: Page) -> str:
    return textwrap.fill(
        text,
        page.width,
        initial_indent=indent,
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )


def _wrapped(text: str, width: int) -> list[str]:
    return textwrap.wrap(
        text, max(width, 8), break_long_words=False, break_on_hyphens=False
    ) or [""]


def _matrix(name: str, rows: tuple[tuple[str, ...], ...], page: Page) -> str:
    cells = [[expression(text, 0, page.cap) for text in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = [
        "[ " + _GAP.join(c.ljust(w) for c, w in zip(row, widths, strict=True)) + " ]"
        for row in cells
    ]
    head = f"{printable(name)} = "
    return "\n".join(
        "    " + (head if index == 0 else " " * len(head)) + line
        for index, line in enumerate(lines)
    )


def _table(table: Table, page: Page) -> str:
    indent = "  " * table.indent
    heads = [_inline(column.head, page) for column in table.columns]
    cells = [[_inline(cell, page) for cell in row] for row in table.rows]
    lines: list[str] = []
    if table.caption:
        lines.append(_inline(table.caption, page))
    headed = any(heads)
    every = [heads, *cells] if headed else cells
    if not every:
        return "\n".join(lines)
    widths = _widths(table.columns, every, page.width - len(indent))
    for row in every:
        lines += _row(row, widths, table.columns, indent)
    return "\n".join(lines)


def _widths(
    columns: tuple[Column, ...], rows: list[list[str]], width: int
) -> list[int]:
    """Natural widths, the wrapping columns sharing what is left."""
    natural = [max(map(len, column)) for column in zip(*rows, strict=True)]
    left = width - len(_GAP) * (len(columns) - 1)
    if sum(natural) <= left:
        return natural
    elastic = [i for i, column in enumerate(columns) if column.align == "wrap"]
    left -= sum(w for i, w in enumerate(natural) if i not in elastic)
    share = sum(columns[i].weight for i in elastic)
    for index in sorted(elastic, key=lambda i: natural[i]):
        given = max(int(left * columns[index].weight / share), _LEAST)
        taken = min(natural[index], given)
        natural[index] = taken
        left -= taken
        share = share - columns[index].weight or 1.0
    return natural


def _row(
    cells: list[str], widths: list[int], columns: tuple[Column, ...], indent: str
) -> list[str]:
    wrapped = [
        _wrapped(cell, width) if column.align == "wrap" else [cell]
        for cell, width, column in zip(cells, widths, columns, strict=True)
    ]
    lines: list[str] = []
    for line in range(max(map(len, wrapped))):
        parts = [
            _aligned(cell[line] if line < len(cell) else "", width, column)
            for cell, width, column in zip(wrapped, widths, columns, strict=True)
        ]
        lines.append((indent + _GAP.join(parts)).rstrip())
    return lines


def _aligned(text: str, width: int, column: Column) -> str:
    if column.align == "right":
        return text.rjust(width)
    return text.center(width) if column.align == "centre" else text.ljust(width)


def _listing(items: tuple[Condition, ...], indent: int, page: Page) -> str:
    """Conditions in columns; what is too long for its column gets lines of its own."""
    numbers = max((len(item.number) for item in items), default=0)
    start = indent + (numbers + len(_GAP) if numbers else 0)
    places = [_whole(item.where, page, page.width - start) for item in items]
    values = [_inline(item.value, page) for item in items]
    value_width = max(map(len, values), default=0)
    half = max(page.width // 2 - start, 24)
    shorter = [len(place) for place in places if len(place) <= half]
    where_width = max([*shorter, 24])
    lines: list[str] = []
    for item, place, value in zip(items, places, values, strict=True):
        number = printable(item.number).rjust(numbers) + _GAP if numbers else ""
        where = _wrapped(place, page.width - start) if place else [""]
        meaning, why = _inline(item.meaning, page), _inline(item.why, page)
        room = page.width - start - where_width - value_width - 5
        both = "; ".join(filter(None, (meaning, why)))
        if not value and not both:
            told: list[str] = []
        elif len(both) <= room or not (meaning or value):
            told, why = [both], ""
        elif len(meaning) <= room:
            told = [meaning]
        else:
            told, why = [""], both
        if told and len(where[-1]) > where_width:
            where.append("")
        if told:
            columns = where[-1].ljust(where_width), value.ljust(value_width)
            where[-1] = f"{columns[0]}{_GAP}{columns[1]}   {told[0]}"
        for index, line in enumerate(where):
            head = " " * indent + number if index == 0 else " " * start
            lines.append((head + line).rstrip())
        below = [why, *(_inline(detail, page) for detail in item.details)]
        deeper = " " * (start + 2)
        for text in filter(None, below):
            lines += [deeper + part for part in _wrapped(text, page.width - start - 2)]
    return "\n".join(lines)


def _whole(text: Text, page: Page, room: int) -> str:
    """A text whose expressions do not break, unless one is longer than a line."""
    written: list[str] = []
    for span in text:
        shown = _span(span, page)
        if isinstance(span, Math) and len(shown) < room:
            shown = shown.replace(" ", HARD_SPACE)
        written.append(shown)
    return "".join(written)
