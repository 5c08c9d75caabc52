"""Manipulability as an article shows it: partition, statics, indices, arms, a picture.

References: [BicchiMelchiorri], [BicchiPrattichizzo], [ChiacchioEtAl1990].
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from screwkit.reports.about_manipulability import (
    cooperative_blocks,
    held,
    in_symbols,
    index_blocks,
    internal_blocks,
    notes,
    partition_blocks,
    reach,
    statics_blocks,
    worst_cases,
)
from screwkit.reports.blocks import (
    Block,
    Figure,
    Heading,
    Paragraph,
    Prose,
    Strong,
    Table,
    Text,
    Words,
    words,
)
from screwkit.reports.panels import panels_of
from screwkit.reports.phrases import platform_called
from screwkit.reports.references import cited
from screwkit.results.manipulability import Manipulability


def manipulability_section(answer: Manipulability) -> tuple[Block, ...]:
    """The whole section."""
    platform = platform_called(answer.platform_name)
    blocks: list[Block] = [Heading(words("Manipulability"), 1)]
    blocks += [Paragraph(_sentence(text)) for text in held(answer)]
    blocks += [
        _head("Who moves with whom", "BicchiPrattichizzo, (5)"),
        *_captioned(
            partition_blocks(answer.partition, answer.platform_name),
            "The mobility partition, block by block",
            "table:partition",
        ),
        _head("Statics", "BicchiPrattichizzo, (15)-(19)"),
        *_sentences(statics_blocks(answer.statics, answer)),
        _head("Kinematic index", "BicchiPrattichizzo, (13)"),
        *_captioned(
            [
                *index_blocks(answer.kinematic, answer, "rates"),
                *in_symbols(answer),
                *reach(answer),
            ],
            f"Kinematic index: how fast {platform} moves for actuated rates",
            "table:kinematic",
        ),
        _head("Force index", "BicchiPrattichizzo, (24)"),
        *_captioned(
            [*index_blocks(answer.force, answer, "torques"), *worst_cases(answer)],
            f"Force index: how large a wrench on {platform} actuated torques balance",
            "table:force",
        ),
    ]
    if internal := internal_blocks(answer):
        blocks.append(_head("Internal forces", "BicchiPrattichizzo, (22)"))
        blocks += _sentences(internal)
    arms = [
        block
        for block in cooperative_blocks(answer.cooperative, answer)
        if not isinstance(block, Heading)
    ]
    if arms:
        blocks.append(_head("Cooperation", "ChiacchioEtAl1990, (26)-(37)"))
        blocks += _captioned(
            arms,
            "Semi-axes of the ellipsoids of the system and of its arms",
            "table:cooperation",
        )
    blocks += [Paragraph(_sentence(words(text))) for text in notes(answer)]
    panels = panels_of(answer)
    if panels:
        titles = ", ".join(panel.title for panel in panels)
        caption = (
            f"{answer.title or answer.case}: {titles}. Filled joints are actuated, "
            f"open ones passive, triangles are contacts; ellipses are drawn at the "
            f"reference point, their principal axes to the scale that is given."
        )
        blocks.append(Figure(panels, words(caption), "figure:manipulability"))
    return tuple(blocks)


def _head(title: str, pointer: str) -> Paragraph:
    return Paragraph((Strong(title), Words(" "), *cited(pointer), Words(".")))


def _sentence(text: Text) -> Text:
    """With a capital letter and a full stop."""
    first, *rest = text
    match first:
        case Words(content):
            first = Words(content[:1].upper() + content[1:])
        case Prose(content):
            first = Prose(content[:1].upper() + content[1:])
    last = rest[-1] if rest else first
    ended = isinstance(last, Words | Prose) and last.text.endswith((".", ":"))
    return (first, *rest, *(() if ended else (Words("."),)))


def _sentences(blocks: Iterable[Block]) -> list[Block]:
    return [
        Paragraph(_sentence(block.text)) if isinstance(block, Paragraph) else block
        for block in blocks
    ]


def _captioned(blocks: Iterable[Block], caption: str, label: str) -> list[Block]:
    """Paragraphs as sentences, the table with a caption."""
    return [
        replace(block, caption=words(caption), label=label)
        if isinstance(block, Table)
        else block
        for block in _sentences(blocks)
    ]
