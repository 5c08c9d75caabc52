"""The superbracket of six lines in words: where they are dependent, and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from screwkit.reports.blocks import Block, Paragraph, Text, Words, joined, prose, words
from screwkit.reports.conditions import Numbered
from screwkit.reports.phrases import capital
from screwkit.results.superbracket import BracketFactor, Superbracket

_SAID = ("exactly", "wider", "there")


def superbracket_blocks(
    found: Superbracket | None, entries: Sequence[Numbered], *, indent: int = 2
) -> list[Block]:
    """The lines, the product and what each factor means; nothing without a product."""
    if found is None or not found.factors:
        return []
    product = "  ".join(factor.expression for factor in found.factors)
    lines = " ".join(found.lines)
    called = ", ".join(f"{point.letter} {point.name}" for point in found.points)
    blocks: list[Block] = [
        Paragraph(
            words(f"six lines hold it, {lines}; dependent where this is 0:"), indent
        ),
        Paragraph(words(product), indent + 1),
        Paragraph(words(called), indent + 1),
    ]
    blocks += [
        Paragraph(_meaning(factor, entries), indent + 1)
        for factor in found.factors
        if factor.holds in _SAID
    ]
    return blocks


def superbracket_section(
    found: Superbracket | None, entries: Sequence[Numbered]
) -> list[Block]:
    """The same as paragraphs of an article."""
    if found is None or not found.factors:
        return []
    product = ", ".join(factor.expression for factor in found.factors)
    called = ", ".join(f"{point.letter} is {point.name}" for point in found.points)
    lines = ", ".join(found.lines)
    head = (
        f"Six lines hold the locked platform, {lines}, where {called}. Their "
        f"superbracket is the product of {product}, up to a constant."
    )
    blocks: list[Block] = [Paragraph(words(head))]
    for factor in found.factors:
        if factor.holds in _SAID:
            written = replace(factor, words=capital(factor.words))
            blocks.append(Paragraph((*_meaning(written, entries), Words("."))))
    return blocks


def _meaning(factor: BracketFactor, entries: Sequence[Numbered]) -> Text:
    """``… meet in one point: exactly 1 and 2``."""
    numbers: list[Text] = [(entries[n].reference,) for n in factor.components]
    where = joined(numbers, " and ")
    if factor.holds == "exactly":
        return (*prose(factor.words), Words(": exactly "), *where)
    more = (
        ", and where another factor of it vanishes"
        if factor.holds == "wider"
        else "; undecided whether elsewhere too"
    )
    return (*prose(factor.words), Words(": on all of "), *where, Words(more))
