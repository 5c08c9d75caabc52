"""Names of joints and bodies as their file writes them, though they look like ``q2``.

Sentences of an answer show symbols with subscripts.  What a file calls a joint, a body
or a limb is no symbol, and is set as plain words.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable
from dataclasses import replace

from screwkit.reports.blocks import (
    Block,
    Column,
    Condition,
    Figure,
    Heading,
    Listing,
    Paragraph,
    Prose,
    Span,
    Table,
    Text,
    Words,
)
from screwkit.results.analysis import Description

_LIKE_A_SYMBOL = re.compile(r"[^\W\d_]\d+")


def given_names(description: Description) -> frozenset[str]:
    """What the file names as symbols are named, without its symbols.

    A joint called like a symbol cannot be told from it in a sentence.
    """
    names = {description.base, description.platform}
    symbols = {name for name, _, _ in description.values}
    for row in description.rows:
        names |= {row.joint, row.antecedent}
        symbols |= set(re.findall(r"\w+", row.variable))
    names |= {name for name, _ in description.limbs}
    return frozenset(name for name in names - symbols if _LIKE_A_SYMBOL.fullmatch(name))


def with_given_names(
    blocks: Iterable[Block], names: Collection[str]
) -> tuple[Block, ...]:
    """The blocks with some names as plain words wherever they stand in sentences."""
    longest_first = sorted(names, key=len, reverse=True)
    if not longest_first:
        return tuple(blocks)
    either = "|".join(map(re.escape, longest_first))
    pattern = re.compile(rf"(?<![\w.*^-])({either})(?![\w.*^-]*\w)")
    return tuple(_in_block(block, pattern) for block in blocks)


def _in_block(block: Block, names: re.Pattern[str]) -> Block:
    match block:
        case Paragraph():
            return replace(block, text=_in_text(block.text, names))
        case Heading():
            text, aside = (_in_text(t, names) for t in (block.text, block.aside))
            return replace(block, text=text, aside=aside)
        case Table():
            columns = tuple(_in_column(column, names) for column in block.columns)
            rows = tuple(
                tuple(_in_text(cell, names) for cell in row) for row in block.rows
            )
            caption = _in_text(block.caption, names)
            return replace(block, columns=columns, rows=rows, caption=caption)
        case Listing():
            items = tuple(_in_condition(item, names) for item in block.items)
            return replace(block, items=items)
        case Figure():
            return replace(block, caption=_in_text(block.caption, names))
        case _:
            return block


def _in_column(column: Column, names: re.Pattern[str]) -> Column:
    return replace(column, head=_in_text(column.head, names))


def _in_condition(item: Condition, names: re.Pattern[str]) -> Condition:
    return replace(
        item,
        where=_in_text(item.where, names),
        value=_in_text(item.value, names),
        meaning=_in_text(item.meaning, names),
        details=tuple(_in_text(line, names) for line in item.details),
        why=_in_text(item.why, names),
    )


def _in_text(text: Text, names: re.Pattern[str]) -> Text:
    found: list[Span] = []
    for span in text:
        if not isinstance(span, Prose):
            found.append(span)
            continue
        # Split by one group: names stand at the odd places.
        for number, part in enumerate(names.split(span.text)):
            if part:
                found.append(Words(part) if number % 2 else Prose(part))
    return tuple(found)
