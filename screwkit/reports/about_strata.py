"""What happens where singular conditions meet: a row for each set."""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.names import counted
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
    Paragraph,
    Reference,
    Table,
    Text,
    Words,
    joined,
    math,
    words,
)
from screwkit.reports.conditions import Numbering
from screwkit.reports.phrases import capital, listed
from screwkit.results.singularities import Singularities
from screwkit.results.strata import Member, PlatformState, Strata, Stratum

_HOLDS = {"everywhere": "everywhere", "generally": "generally", "undecided": "?"}


def strata_blocks(
    answer: Singularities,
    strata: Strata,
    numbering: Numbering,
    *,
    shown: int | None,
) -> list[Block]:
    """The section as a terminal shows it; None shows every set."""
    chosen, notes = _chosen(strata, shown, more=" (--all, --json)")
    title = "TOGETHER   where several of these conditions hold at once"
    blocks: list[Block] = [Heading(words(title), 1, words(_bound(strata)))]
    if chosen:
        blocks.append(_table(answer, strata, chosen, numbering))
    return [*blocks, *(Paragraph(words(text), 2) for text in notes)]


def strata_section(
    answer: Singularities, strata: Strata, numbering: Numbering
) -> list[Block]:
    """The same as a section of an article."""
    chosen, notes = _chosen(strata, len(strata.strata))
    blocks: list[Block] = [
        Heading(words("Where singularities meet"), 1),
        Paragraph(words(f"Intersections taken: {_bound(strata)}.")),
    ]
    if chosen:
        caption = words("Ranks and freedoms where several conditions hold")
        blocks.append(_table(answer, strata, chosen, numbering, caption))
    return [*blocks, *(Paragraph(words(f"{capital(text)}.")) for text in notes)]


def _bound(strata: Strata) -> str:
    count = counted(strata.together, "condition")
    return f"up to {count}, codimension up to {strata.deepest}"


def _chosen(
    strata: Strata, shown: int | None, more: str = ""
) -> tuple[list[Stratum], list[str]]:
    """The sets that are listed, and what is said of the rest and of all.

    Args:
        strata: The answer.
        shown: How many are listed; None lists all.
        more: Where the others are found.
    """
    meetings = [one for one in strata.strata if one.around]
    if shown is None:
        listed_ones = list(strata.strata)
        hidden = 0
    else:
        telling = [one for one in meetings if one.differs]
        listed_ones, hidden = telling[:shown], len(telling[shown:])
    plain = sum(not one.differs for one in meetings) if shown is not None else 0
    notes = []
    if not meetings:
        notes.append("no two of them meet")
    if hidden:
        notes.append(f"… {counted(hidden, 'more set')} of this kind{more}")
    if plain:
        also = "more " if listed_ones else ""
        notes.append(
            f"{counted(plain, f'{also}set')}, where the conditions taken one by one "
            f"say all there is{more}"
        )
    if any(one.holds == "undecided" for one in listed_ones):
        notes.append("?: whether this holds at all postures of the set is undecided")
    if meetings and strata.complete:
        notes.append("complete: no other sets of conditions meet within these bounds")
    elif not strata.complete:
        notes.append(f"undecided whether other sets meet: {strata.reason}")
    return listed_ones, notes


def _table(
    answer: Singularities,
    strata: Strata,
    chosen: Sequence[Stratum],
    numbering: Numbering,
    caption: Text = (),
) -> Table:
    locked = strata.generic.locked_freedom is not None and answer.actuation is not None
    heads = ["where", "limb ranks", "wrenches", numbering.platform]
    if locked and answer.actuation is not None:
        heads.append(f"{listed(answer.actuation.actuated)} locked")
    heads.append("holds")
    if caption:
        heads = [capital(head) for head in heads]
    columns = tuple(
        Column(words(head), "wrap") if place == 0 else Column(words(head))
        for place, head in enumerate(heads)
    )
    rows = [_generic_row(strata.generic, locked=locked)]
    rows += [_row(one, answer, numbering, locked=locked) for one in chosen]
    label = "table:strata" if caption else ""
    return Table(columns, tuple(rows), caption, label, long=bool(caption), indent=2)


def _generic_row(state: PlatformState, *, locked: bool) -> tuple[Text, ...]:
    cells = [
        words("in general"),
        words(", ".join(map(str, state.limb_ranks))),
        words(str(state.wrench_dimension)),
        words(_freedom(state)),
    ]
    if locked:
        cells.append(words(str(state.locked_freedom)))
    return (*cells, ())


def _row(
    one: Stratum, answer: Singularities, numbering: Numbering, *, locked: bool
) -> tuple[Text, ...]:
    state, expected = one.state, one.expected
    ranks = ", ".join(map(str, state.limb_ranks))
    wrenches, freedom = str(state.wrench_dimension), _freedom(state)
    left = str(state.locked_freedom)
    if expected is not None:
        ranks += _instead(", ".join(map(str, expected.limb_ranks)), ranks)
        wrenches += _instead(str(expected.wrench_dimension), wrenches)
        left += _instead(str(expected.locked_freedom), left)
    cells = [_where(one, answer, numbering), words(ranks), words(wrenches)]
    cells.append(words(freedom))
    if locked:
        cells.append(words(left))
    return (*cells, words(_HOLDS[one.holds]))


def _instead(expected: str, found: str) -> str:
    """``, not 4`` where the conditions taken one by one say so."""
    return "" if expected == found else f", not {expected}"


def _freedom(state: PlatformState) -> str:
    return f"{state.platform_freedom} ({state.motion_type})"


def _where(one: Stratum, answer: Singularities, numbering: Numbering) -> Text:
    """``5 (2 and 4)`` for a component, ``2 and 3 with cos q3 = 0`` for another set."""

    def listed_ones(members: Sequence[Member]) -> Text:
        names: list[Text] = [(_reference(m, answer, numbering),) for m in members]
        if len(names) < 2:
            return joined(names)
        return joined([joined(names[:-1], ", "), names[-1]], " and ")

    around = listed_ones(one.around)
    if one.itself:
        text = listed_ones(one.itself)
        text = (*text, Words(" ("), *around, Words(")")) if around else text
    elif one.extra:
        extra = joined([math(f"{equation} = 0") for equation in one.extra])
        text = (*around, Words(" with "), *extra)
    else:
        text = around
    if one.real == "undecided":
        text = (*text, Words(" (no real posture found)"))
    return text


def _reference(
    member: Member, answer: Singularities, numbering: Numbering
) -> Reference:
    """The number of a component in the whole answer."""
    if member.part == "limb":
        names = [limb.limb for limb in answer.limb]
        entries = numbering.limbs[names.index(member.limb)]
    elif member.part == "constraint":
        entries = numbering.constraint
    else:
        entries = numbering.actuation
    return entries[member.component].reference
