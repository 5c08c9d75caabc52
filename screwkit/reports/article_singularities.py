"""Singularities as an article shows them: numbered conditions in tables."""

from __future__ import annotations

from screwkit.algebra.names import counted, limb_called
from screwkit.reports.about_singularities import idle_place, meeting, verdict
from screwkit.reports.about_strata import strata_section
from screwkit.reports.about_superbracket import superbracket_section
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
    Paragraph,
    Table,
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
    at_closed_postures,
    by_number,
    consequence,
    matched,
    numbered,
    reads_well,
    solution_text,
)
from screwkit.reports.phrases import capital
from screwkit.results.singularities import (
    ActuationSingularities,
    ConstraintSingularities,
    LimbSingularities,
    Singularities,
)


def singularities_summary(answer: Singularities) -> str:
    """Numbers of components and what was proved, in a sentence or two."""
    limb = sum(len(one.components) for one in answer.limb)
    constraint = counted(len(answer.constraint.components), "constraint component")
    parts = [f"The singular loci have {counted(limb, 'limb component')}"]
    drives = answer.actuation is not None and answer.actuation.admissible
    parts.append(f"{',' if drives else ' and'} {constraint}")
    lists: list[
        LimbSingularities | ConstraintSingularities | ActuationSingularities
    ] = [*answer.limb, answer.constraint]
    if answer.actuation is not None:
        number = len(answer.actuation.components)
        locked = ", ".join(answer.actuation.actuated)
        parts.append(
            f" and {counted(number, 'actuation component')} with {locked} locked"
            if answer.actuation.admissible
            else f"; locking {locked} does not stop the platform"
        )
        if drives:
            lists.append(answer.actuation)
    certified = [own.certified for own in lists if own.certified is not None]
    parts.append(
        ". Where a list may lack something, this is said."
        if not all(own.complete for own in lists)
        else "; all lists are certified to be complete."
        if certified and all(certified)
        else "; all lists are complete by an exhaustive search; no certificate was "
        "asked for."
        if not certified
        else "; all lists are complete by an exhaustive search. Where a certificate "
        "proves it, this is said."
    )
    return "".join(parts)


def singularities_sections(answer: Singularities) -> tuple[Block, ...]:
    """Three sections: limb, constraint, actuation."""
    numbering = numbered(answer)
    blocks: list[Block] = [Heading(words("Limb singularities"), 1)]
    if not answer.limb:
        blocks.append(Paragraph(words("The platform has no limb.")))
    for index, (limb, entries) in enumerate(
        zip(answer.limb, numbering.limbs, strict=True)
    ):
        blocks += _limb(limb, entries, numbering, index)
    blocks += _constraint(answer.constraint, numbering)
    if answer.actuation is not None:
        blocks += _actuation(answer.actuation, numbering)
    if answer.strata is not None:
        blocks += strata_section(answer, answer.strata, numbering)
    return tuple(blocks)


def _limb(
    limb: LimbSingularities,
    entries: tuple[Numbered, ...],
    numbering: Numbering,
    index: int,
) -> list[Block]:
    name, joints = capital(limb_called(limb.limb)), ", ".join(limb.joints)
    head = (
        f"{name} ({joints}): the twist system has rank {limb.generic_rank} in general."
    )
    blocks: list[Block] = [Paragraph(words(head))]
    if entries:
        caption = f"Rank deficiency of {limb_called(limb.limb)}"
        blocks.append(
            _conditions(entries, numbering, caption, f"table:limb-singular{index}")
        )
    for one in limb.intersections:
        where = meeting(one, entries)
        blocks.append(
            Paragraph(
                (Words("On conditions "), *where, Words(f" the rank is {one.rank}."))
            )
        )
    blocks.append(Paragraph(prose(_sentence(verdict(limb, none=not entries)))))
    return blocks


def _constraint(part: ConstraintSingularities, numbering: Numbering) -> list[Block]:
    blocks: list[Block] = [
        Heading(words("Constraint singularities"), 1),
        Paragraph(
            words(
                f"The loop constraint matrix has rank {part.generic_rank} in general."
            )
        ),
    ]
    if numbering.constraint:
        blocks.append(
            _conditions(
                numbering.constraint,
                numbering,
                "Constraint singularities",
                "table:constraint",
            )
        )
    text = _sentence(verdict(part, none=not numbering.constraint))
    blocks.append(Paragraph(prose(text)))
    return blocks


def _actuation(part: ActuationSingularities, numbering: Numbering) -> list[Block]:
    locked = ", ".join(part.actuated)
    blocks: list[Block] = [
        Heading(words("Actuation singularities"), 1),
        Paragraph(
            words(
                f"With {locked} locked, the global wrench system has rank "
                f"{part.generic_rank} in general."
            )
        ),
    ]
    if not part.admissible:
        why = f": {part.witness}" if part.witness else ""
        text = f"The scheme is not admissible, the platform can always move{why}."
        return [*blocks, Paragraph(prose(text))]
    if numbering.actuation:
        blocks.append(
            _conditions(
                numbering.actuation,
                numbering,
                f"Actuation singularities with {locked} locked",
                "table:actuation",
            )
        )
    text = _sentence(verdict(part, none=not numbering.actuation))
    blocks.append(Paragraph(prose(text)))
    blocks += superbracket_section(part.superbracket, numbering.actuation)
    if part.idle:
        where = joined([idle_place(component) for component in part.idle], "; ")
        blocks.append(
            Paragraph(
                (
                    Words("A limb moves idly while the platform stays fixed where "),
                    *where,
                    Words("."),
                )
            )
        )
    return blocks


def _sentence(text: str) -> str:
    return text[:1].upper() + text[1:] + ("" if text.endswith(".") else ".")


def _conditions(
    entries: tuple[Numbered, ...], numbering: Numbering, caption: str, label: str
) -> Table:
    """No., condition, solution, rank, what it means."""
    ordered = by_number(entries)
    rows = tuple(_row(entry, numbering) for entry in ordered)
    columns = (
        Column(words("No."), "right"),
        Column(words("Condition"), "wrap", 1.25),
        Column(words("Solution"), "wrap"),
        Column(words("Rank"), "centre"),
        Column(words("What it means"), "wrap", 1.15),
    )
    return Table(
        columns,
        rows,
        words(caption),
        label,
        anchors=tuple(entry.label for entry in ordered),
        long=True,
    )


def _row(entry: Numbered, numbering: Numbering) -> tuple[Text, ...]:
    component = entry.component
    pairs = matched(component)
    condition = joined([math(f"{equation} = 0") for equation, _ in pairs], "; ")
    solved = joined(
        [
            math(solution_text(s))
            for e, s in pairs
            if s is not None and reads_well(s, e)
        ],
        "; ",
    )
    parts: list[Text] = [
        prose(component.geometry or ""),
        prose(consequence(component, numbering.platform)),
        at_closed_postures(component),
    ]
    if len(pairs) == 1:
        known = numbering.single.get(component.equations[0])
        if known is not None and known.number != entry.number:
            parts.append((Words("see "), known.reference))
    return (
        words(str(entry.number)),
        condition,
        solved or words("–"),
        words(str(component.rank)),
        joined(parts, "; "),
    )
