"""Blocks for a terminal: the answer first, aligned columns, nothing to decode.

Expressions longer than a cap are summarised by their number of terms, because nobody
reads two hundred of them on a screen; the JSON has them in full.
"""

from __future__ import annotations

import re
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
from screwkit.reports.notation import factor_unicode, in_unicode, term_count
from screwkit.reports.spelling import SUPERSCRIPTS

WIDTH: Final = 100
CAP: Final = 160
_GAP: Final = "  "
_LEAST: Final = 18
_HARD_SPACE: Final = "\u00a0"
_INNER_SPACE: Final = re.compile(r"(?<![+−·=,/>< ]) (?![+−·=/>< (])")


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
    text = "\n".join(parts) + "\n" if parts else ""
    return text.replace(_HARD_SPACE, " ")


def inline(text: Text, page: Page | None = None) -> str:
    """A text on one line."""
    return _inline(text, page or Page()).replace(_HARD_SPACE, " ")


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
            return _printable(text)
        case Loose(text):
            return _printable(text).replace(" - ", " − ")
        case Strong(text):
            text = _printable(text)
            return f"\x1b[1m{text}\x1b[0m" if page.bold else text
        case Math(text, terms):
            return _expression(text, terms, page)
        case Loci(factors):
            return _locus(factors, page)
        case Reference(_, number):
            return number
        case Citation(key, place):
            return f"[{key}, {place}]" if place else f"[{key}]"
        case _:
            assert_never(span)


def _printable(text: str) -> str:
    """Text from a file without control characters, which a terminal would obey."""
    return "".join(c if c.isprintable() else " " for c in text)


def _expression(text: str, terms: int, page: Page) -> str:
    if len(text) > page.cap:
        return f"({terms or term_count(text)} terms, see --json)"
    return _unbroken(_printable(in_unicode(text)))


def _locus(factors: tuple[tuple[str, int, int], ...], page: Page) -> str:
    written: list[str] = []
    for text, power, terms in factors:
        if len(text) > page.cap:
            mark = str(power).translate(SUPERSCRIPTS) if power > 1 else ""
            written.append(_expression(text, terms, page) + mark)
        else:
            written.append(_printable(factor_unicode(text, power, len(factors) == 1)))
    return " · ".join(map(_unbroken, written))


def _unbroken(text: str) -> str:
    """Spaces within a monomial made unbreakable, so that lines end at operators."""
    return _INNER_SPACE.sub(_HARD_SPACE, text)


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
            return _listing(items, "  " * indent, page)
        case Bibliography(entries):
            return "\n".join(f"[{entry.key}]  {entry.text}" for entry in entries)
        case _:
            assert_never(block)


def _heading(text: str, level: int, aside: str, page: Page) -> str:
    shown = f"\x1b[1m{text}\x1b[0m" if page.bold else text
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
    cells = [[_expression(text, 0, page) for text in row] for row in rows]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = [
        "[ " + _GAP.join(c.ljust(w) for c, w in zip(row, widths, strict=True)) + " ]"
        for row in cells
    ]
    head = f"{name} = "
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


def _listing(items: tuple[Condition, ...], indent: str, page: Page) -> str:
    numbers = max((len(item.number) for item in items), default=0)
    start = len(indent) + (numbers + 2 if numbers else 0)
    places = [_inline(item.where, page) for item in items]
    values = [_inline(item.value, page) for item in items]
    value_width = max(map(len, values), default=0)
    longest = max(map(len, places), default=0)
    where_width = min(max(longest, 24), max(page.width // 2 - start, 24))
    lines: list[str] = []
    for item, place, value in zip(items, places, values, strict=True):
        meaning = _inline(item.meaning, page)
        room = page.width - start - where_width - value_width - 5
        if not value and not meaning:
            where, why = _wrapped(place, page.width - start), [""]
        else:
            where, why = _wrapped(place, where_width), _wrapped(meaning, room)
        for line in range(max(len(where), len(why))):
            number = item.number.rjust(numbers) if line == 0 else " " * numbers
            parts = (
                indent
                + (number + "  " if numbers else "")
                + (where[line] if line < len(where) else "").ljust(where_width)
                + "  "
                + (value if line == 0 else "").ljust(value_width)
                + "   "
                + (why[line] if line < len(why) else "")
            )
            lines.append(parts.rstrip())
        for detail in item.details:
            deeper = " " * (start + 2)
            lines += [
                deeper + part
                for part in _wrapped(_inline(detail, page), page.width - start - 2)
            ]
    return "\n".join(lines)
