"""Sections that answer `singularities`: every condition beside what happens on it."""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.names import limb_called
from screwkit.reports.about_slice import slice_blocks
from screwkit.reports.about_strata import strata_blocks
from screwkit.reports.about_superbracket import superbracket_blocks
from screwkit.reports.blocks import (
    Block,
    Heading,
    Listing,
    Paragraph,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.conditions import (
    Numbered,
    Numbering,
    by_number,
    condition,
    matched,
    numbered,
    numbered_alone,
    reads_well,
    solution_text,
)
from screwkit.reports.phrases import listed
from screwkit.results.singularities import (
    ActuationSingularities,
    Component,
    ConstraintSingularities,
    Intersection,
    LimbSingularities,
    Singularities,
)

SHOWN = 12
ONE_POSTURE = (
    "the file describes one posture, in numbers: what is said here holds at it"
)


def singularities_blocks(
    answer: Singularities, *, shown: int | None = SHOWN
) -> tuple[Block, ...]:
    """The whole answer; ``shown`` caps each list of conditions, None shows all."""
    numbering = numbered(answer)
    blocks: list[Block] = []
    if answer.one_posture:
        blocks.append(Paragraph(words(ONE_POSTURE), 1))
    ranks = {limb.generic_rank for limb in answer.limb}
    aside = f"rank {ranks.pop()} in general" if len(ranks) == 1 else ""
    if answer.limb:
        blocks.append(
            Heading(words("LIMB   where a limb loses a freedom"), 1, words(aside))
        )
    for limb, entries in zip(answer.limb, numbering.limbs, strict=True):
        blocks += limb_blocks(
            limb, entries, numbering, show_rank=not aside, shown=shown
        )
    blocks += constraint_blocks(answer.constraint, numbering, shown=shown)
    if answer.actuation is not None:
        blocks += actuation_blocks(answer.actuation, numbering, shown=shown)
    if answer.strata is not None:
        blocks += strata_blocks(answer, answer.strata, numbering, shown=shown)
    if answer.assumptions:
        taken = joined([math(text) for text in answer.assumptions])
        blocks.append(Paragraph((Words("assumed: "), *taken)))
    if note := uncertified(answer):
        blocks.append(Paragraph(words(note)))
    if answer.slice is not None:
        blocks += slice_blocks(answer.slice)
    return tuple(blocks)


def limb_blocks(
    limb: LimbSingularities,
    entries: tuple[Numbered, ...],
    numbering: Numbering,
    *,
    show_rank: bool,
    shown: int | None = SHOWN,
) -> list[Block]:
    """One limb's conditions and where they meet."""
    head = f"{limb_called(limb.limb)}: {listed(limb.joints) or 'no freedom'}"
    aside = f"rank {limb.generic_rank} in general" if show_rank else ""
    blocks: list[Block] = [Heading(words(head), 2, words(aside))]
    blocks += listing(entries, numbering, shown)
    blocks += [
        Paragraph(
            (*meeting(one, entries), Words(f":  rank {one.rank}")),
            2,
        )
        for one in limb.intersections[:shown]
    ]
    hidden = len(limb.intersections) - len(limb.intersections[:shown])
    if hidden:
        more = f"… {hidden} more meetings of these conditions (--all, --json)"
        blocks.append(Paragraph(words(more), 2))
    blocks.append(Paragraph(prose(verdict(limb, none=not entries)), 2))
    return blocks


def meeting(one: Intersection, entries: Sequence[Numbered]) -> Text:
    """Which numbered conditions meet, and what else must hold."""
    together = joined(
        [(entries[index].reference,) for index in one.components], " and "
    )
    if not one.extra:
        return together
    extra = joined([math(f"{equation} = 0") for equation in one.extra])
    return (*together, Words(" with "), *extra)


def verdict(
    part: LimbSingularities | ConstraintSingularities | ActuationSingularities,
    *,
    none: bool,
) -> str:
    """What the search found, whether a certificate proves it, and what is open."""
    searched = part.complete or (bool(part.reason) and part.reason == part.uncertified)
    if not searched:
        known = "nothing found, but " if none else ""
        return f"{known}undecided whether this is all: {part.reason or 'not proved'}"
    proof = getattr(part, "proof", "")
    found = "never" if none else "complete"
    if part.certified:
        found += ", certified"
        if part.uncertified:
            found += f", but {part.uncertified}"
    elif part.certified is not None:
        found += f" by search, not certified ({part.uncertified})"
    return f"{found}: {proof}" if proof else found


def uncertified(answer: Singularities) -> str:
    """What complete lists rest on where no certificate was asked for; else empty."""
    parts: list[
        LimbSingularities | ConstraintSingularities | ActuationSingularities
    ] = [*answer.limb, answer.constraint]
    if answer.actuation is not None and answer.actuation.admissible:
        parts.append(answer.actuation)
    if answer.slice is not None or answer.certificate is not None:
        return ""
    if not any(part.complete for part in parts):
        return ""
    return (
        "complete and never are said by an exhaustive search; --certificate FILE looks "
        "for proofs of them that `verify` checks"
    )


def listing(
    entries: Sequence[Numbered], numbering: Numbering, shown: int | None
) -> list[Block]:
    """The conditions, the likeliest to be met first; how many are not shown."""
    if not entries:
        return []
    ordered = by_number(entries)
    taken, hidden = ordered[:shown], ordered[shown:] if shown is not None else []
    items = tuple(condition(entry, numbering) for entry in taken)
    blocks: list[Block] = [Listing(items)]
    if hidden:
        depths = sorted({entry.component.codimension for entry in hidden})
        of = " and ".join(
            filter(None, (", ".join(map(str, depths[:-1])), str(depths[-1])))
        )
        more = f"… {len(hidden)} more, of codimension {of} (--all, --json)"
        blocks.append(Paragraph(words(more), 2))
    return blocks


def constraint_blocks(
    part: ConstraintSingularities,
    numbering: Numbering,
    *,
    shown: int | None = SHOWN,
) -> list[Block]:
    """Where the constraints of the limbs become dependent."""
    blocks: list[Block] = [
        Heading(
            words("CONSTRAINT   where the constraints of the loops become dependent"),
            1,
            words(f"rank {part.generic_rank} in general"),
        )
    ]
    blocks += listing(numbering.constraint, numbering, shown)
    blocks.append(Paragraph(prose(verdict(part, none=not numbering.constraint)), 2))
    return blocks


def actuation_blocks(
    part: ActuationSingularities, numbering: Numbering, *, shown: int | None = SHOWN
) -> list[Block]:
    """Where the locked platform can move after all."""
    locked = listed(part.actuated)
    blocks: list[Block] = [
        Heading(
            words(
                f"ACTUATION   with {locked} locked, "
                f"where the {numbering.platform} moves"
            ),
            1,
            words(f"rank {part.generic_rank} in general"),
        )
    ]
    if not part.admissible:
        why = f": {part.witness}" if part.witness else ""
        return [*blocks, Paragraph(prose(f"not admissible, it always can{why}"), 2)]
    blocks += listing(numbering.actuation, numbering, shown)
    blocks.append(Paragraph(prose(verdict(part, none=not numbering.actuation)), 2))
    blocks += superbracket_blocks(part.superbracket, numbering.actuation)
    if part.idle:
        ordered = sorted(part.idle, key=lambda component: component.codimension)
        where = joined([idle_place(component) for component in ordered[:shown]], ";  ")
        if ordered[shown:] if shown is not None else ():
            where = (*where, Words(f";  … {len(ordered[shown:])} more"))
        head = Words(f"idle only (the {numbering.platform} stays fixed): ")
        blocks.append(Paragraph((head, *where), 2))
    return blocks


def limb_part(limb: LimbSingularities) -> tuple[Block, ...]:
    """One limb alone, as a part of an unfinished answer."""
    numbering = numbered_alone(limb.components)
    return tuple(limb_blocks(limb, numbering.constraint, numbering, show_rank=True))


def constraint_part(part: ConstraintSingularities) -> tuple[Block, ...]:
    """The constraint singularities alone."""
    return tuple(constraint_blocks(part, numbered_alone(part.components)))


def actuation_part(part: ActuationSingularities) -> tuple[Block, ...]:
    """The actuation singularities alone."""
    return tuple(actuation_blocks(part, numbered_alone(part.components)))


def idle_place(component: Component) -> Text:
    """Where a component lies, without numbers."""
    return joined(
        [
            math(
                solution_text(solution)
                if solution is not None and reads_well(solution, equation)
                else f"{equation} = 0"
            )
            for equation, solution in matched(component)
        ]
    )
