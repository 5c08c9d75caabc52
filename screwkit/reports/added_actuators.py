"""Redundant actuation in words: where a scheme fails, and who added removes that."""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.names import counted
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
    Paragraph,
    Table,
    Text,
    Words,
    prose,
    words,
)
from screwkit.reports.conditions import Numbered, place
from screwkit.reports.phrases import capital, listed
from screwkit.results.schemes import AddedActuators, Redundancy
from screwkit.results.singularities import Component
from screwkit.results.undecided import Undecided

SHOWN = 24
"""Pairs that are listed."""


def added_blocks(answer: Redundancy | Undecided | None) -> tuple[Block, ...]:
    """The section as a terminal shows it; nothing where it was not asked for."""
    if answer is None:
        return ()
    head = Heading(words("added actuators"), 1)
    if isinstance(answer, Undecided):
        return head, Paragraph(words(f"undecided: {answer.reason}"), 1)
    blocks: list[Block] = [head, *(Paragraph(text, 1) for text in _before(answer))]
    if answer.components:
        blocks.append(conditions_table(answer))
        blocks.append(effects_table(answer))
    return (*blocks, *(Paragraph(text, 1) for text in _after(answer)))


def added_section(answer: Redundancy | Undecided | None) -> tuple[Block, ...]:
    """The same as a part of an article."""
    if answer is None:
        return ()
    head = Heading(words("Added actuators"), 2)
    if isinstance(answer, Undecided):
        return head, Paragraph(words(f"Undecided: {answer.reason}."))
    blocks: list[Block] = [head, *map(_sentence, _before(answer))]
    if answer.components:
        blocks.append(conditions_table(answer, titled=True))
        blocks.append(effects_table(answer, titled=True))
    return (*blocks, *map(_sentence, _after(answer)))


def _sentence(text: Text) -> Paragraph:
    first, *rest = text
    if isinstance(first, Words):
        first = Words(capital(first.text))
    return Paragraph((first, *rest, Words(".")))


def _before(answer: Redundancy) -> list[Text]:
    """What is looked at."""
    locked = listed(answer.actuated)
    if not answer.components:
        return [words(f"with {locked} locked the platform never moves: none is needed")]
    if not answer.admissible:
        return [words(f"with {locked} locked the platform can move everywhere")]
    return [
        words(f"with {locked} locked the platform can move where one of these holds")
    ]


def _after(answer: Redundancy) -> list[Text]:
    """What the table leaves open."""
    notes: list[Text] = []
    if answer.pairs_asked and not answer.pairs:
        largest = max(one.platform_freedom or 0 for one in answer.components)
        notes.append(
            words(f"at least {largest} are needed, one for each freedom left")
            if largest > 2
            else words("no two of them stop it on every one")
        )
    if len(answer.pairs) > SHOWN:
        more = len(answer.pairs) - SHOWN
        notes.append(words(f"… {counted(more, 'more pair')} (--json)"))
    if answer.components:
        example = answer.pairs or tuple(x for x in answer.single if x.suffices)
        added = example[0].actuators if example else ("…",)
        scheme = ",".join((*answer.actuated, *added))
        notes.append(
            words(
                "this is so in general; at special postures on a condition the "
                "platform may still move, and singularities --actuated "
                f"{scheme} finds them"
            )
        )
    if not answer.complete:
        notes.append(
            words(f"undecided whether the scheme fails elsewhere too: {answer.reason}")
        )
    return notes


def conditions_table(answer: Redundancy, *, titled: bool = False) -> Table:
    """The components, numbered, with their geometry."""
    rows = tuple(
        _condition_row(number, component)
        for number, component in enumerate(answer.components, 1)
    )
    heads = ("", "Where", "Platform", "Meaning") if titled else ("",) * 4
    columns = (
        Column(words(heads[0]), "right"),
        Column(words(heads[1]), "wrap"),
        Column(words(heads[2])),
        Column(words(heads[3]), "wrap"),
    )
    if not titled:
        return Table(columns, rows)
    caption = f"Where the platform moves with {listed(answer.actuated)} locked"
    return Table(columns, rows, words(caption), "table:unheld")


def _condition_row(number: int, component: Component) -> tuple[Text, ...]:
    where, used = words("everywhere"), False
    if component.equations:
        where, used = place(Numbered(number, component), {})
    freedom = words(counted(component.platform_freedom or 0, "freedom"))
    meaning = prose("" if used else component.geometry or "")
    return words(str(number)), where, freedom, meaning


def effects_table(answer: Redundancy, *, titled: bool = False) -> Table:
    """Added actuators gathered by what they do; then pairs, if they are needed."""
    groups: dict[tuple[int, ...], list[AddedActuators]] = {}
    for one in answer.single:
        groups.setdefault(one.freedoms, []).append(one)
    ordered = sorted(groups.items(), key=lambda item: (sum(map(bool, item[0])), item))
    rows = [
        (words(listed(x.actuators[0] for x in members)), _effect(freedoms))
        for freedoms, members in ordered
    ]
    if answer.pairs:
        pairs = "; ".join(listed(x.actuators) for x in answer.pairs[:SHOWN])
        rows.append((words(pairs), words("any of these pairs stops it on each")))
    heads = ("Locked too", "Effect") if titled else ("locked too", "")
    columns = (Column(words(heads[0]), "wrap"), Column(words(heads[1]), "wrap"))
    if not titled:
        return Table(columns, tuple(rows))
    return Table(columns, tuple(rows), words("What each does"), "table:added")


def _effect(freedoms: Sequence[int]) -> Text:
    """On which components it holds the platform, and what is left on the others."""
    removed = [str(n) for n, left in enumerate(freedoms, 1) if not left]
    if len(freedoms) == len(removed) == 1:
        return words("stops it")
    if len(freedoms) == len(removed):
        return words("stops it on each")
    parts = [f"stops it on {', '.join(removed)}"] if removed else []
    for count in sorted({*freedoms} - {0}):
        where = [str(n) for n, left in enumerate(freedoms, 1) if left == count]
        parts.append(f"leaves {counted(count, 'freedom')} on {', '.join(where)}")
    return words("; ".join(parts))
