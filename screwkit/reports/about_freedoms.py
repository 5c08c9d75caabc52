"""Which constraints are redundant, what is free, and where motion branches."""

from __future__ import annotations

from dataclasses import replace

from screwkit.algebra.names import counted
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
    Paragraph,
    Table,
    Text,
    prose,
    words,
)
from screwkit.reports.phrases import platform_called
from screwkit.results.mobility import (
    Connectivity,
    FullCycle,
    Mobility,
    MotionBranch,
    Redundancy,
)

LONG = 24
"""Rows of a table that may break across pages."""


def class_sentence(answer: Mobility) -> str:
    """The platform's motion in words; empty where there is nothing to add."""
    found, known = answer.platform.motion_class, answer.at_values
    if found is None or answer.platform.twist_dimension in (0, 6):
        return ""
    if known is not None and known.platform.motion_class is not None:
        at_values = known.platform.motion_class.description
        if at_values != found.description:
            return f"{at_values} (at the values of the file)"
    return found.description


def _shown(title: str, table: Table, *, captioned: bool) -> tuple[Block, ...]:
    """A table under a heading, or with a caption where it may float."""
    head = words(title[:1].upper() + title[1:] if captioned else title)
    if captioned:
        return (replace(table, caption=head, long=len(table.rows) > LONG),)
    return Heading(head, 2), table


def redundancy_blocks(
    answer: Mobility, *, captioned: bool = False
) -> tuple[Block, ...]:
    """The redundant constraints by name, each with a freedom that would remove it."""
    if not answer.redundancies:
        return ()
    number = len(answer.redundancies)
    verb = "follows" if number == 1 else "follow"
    head = f"{counted(number, 'constraint')} that {verb} from the others"
    rows = tuple(
        (words(str(i)), prose(redundancy.description), prose(_removed(redundancy)))
        for i, redundancy in enumerate(answer.redundancies, 1)
    )
    columns = (
        Column((), "right"),
        Column(words("in balance by themselves"), "wrap", 3.0),
        Column(words("removed, for instance, by"), "wrap", 2.0),
    )
    return _shown(head, Table(columns, rows), captioned=captioned)


def _removed(redundancy: Redundancy) -> str:
    if not redundancy.removed_by:
        return "no single freedom"
    return redundancy.removed_by[0].description


def freedom_blocks(answer: Mobility, *, captioned: bool = False) -> tuple[Block, ...]:
    """What is free: the platform's motions, and the idle ones."""
    if not answer.remaining_freedoms:
        return ()
    rows = tuple(
        (words(str(i)), prose(_named(freedom.description, answer)))
        for i, freedom in enumerate(answer.remaining_freedoms, 1)
    )
    columns = (Column((), "right"), Column((), "wrap"))
    return _shown("what is free", Table(columns, rows), captioned=captioned)


def _named(sentence: str, answer: Mobility) -> str:
    """With the reader's own word for the platform."""
    return sentence.replace("the platform", platform_called(answer.platform_name))


def branch_blocks(answer: FullCycle, *, captioned: bool = False) -> tuple[Block, ...]:
    """The branches of finite motion, where there are several."""
    if len(answer.branches) < 2:
        return ()
    rows: list[tuple[Text, ...]] = []
    for i, branch in enumerate(answer.branches, 1):
        rows.append(
            (
                words(str(i)),
                words(counted(branch.mobility, "freedom")),
                words(branch.finite_type or branch.motion_type),
                prose(_motion(branch)),
                words(str(branch.redundant_constraints)),
            )
        )
    columns = (
        Column((), "right"),
        Column(words("mobility")),
        Column(words("platform")),
        Column(words("motion"), "wrap"),
        Column(words("redundant"), "right"),
    )
    head = "branches of finite motion through this posture"
    return _shown(head, Table(columns, tuple(rows)), captioned=captioned)


def _motion(branch: MotionBranch) -> str:
    """The motion in words, with the joints that run straight."""
    if not branch.straight:
        return branch.motion
    straight = f"{', '.join(branch.straight)} on a straight line"
    return ", ".join(filter(None, (branch.motion, straight)))


def connectivity_blocks(
    answer: Connectivity | None, *, captioned: bool = False
) -> tuple[Block, ...]:
    """Freedom of every body (row) relative to every other (column), by number."""
    if answer is None or len(answer.bodies) < 3:
        return ()
    numbers = range(1, len(answer.bodies) + 1)
    columns = (
        Column((), "right"),
        Column(words("body")),
        *(Column(words(str(n)), "right") for n in numbers),
    )
    rows = tuple(
        (
            words(str(n)),
            words(body),
            *(words("·" if i == n - 1 else str(x)) for i, x in enumerate(row)),
        )
        for n, body, row in zip(numbers, answer.bodies, answer.table, strict=True)
    )
    head = "freedoms of each body relative to every other"
    return _shown(head, Table(columns, rows), captioned=captioned)


def loose_sentence(answer: Mobility) -> str:
    """Bodies that nothing connects with the base; empty where there are none."""
    if not answer.loose_bodies:
        return ""
    number = len(answer.loose_bodies)
    names = ", ".join(answer.loose_bodies[:8])
    more = ", …" if number > 8 else ""
    verb = "is" if number == 1 else "are"
    bodies = counted(number, "body", "bodies")
    return f"{bodies} {verb} not connected with the base: {names}{more}"


def unnamed_paragraph(answer: Mobility) -> tuple[Block, ...]:
    """Why redundancies and freedoms are not listed."""
    return (Paragraph(prose(answer.unnamed), 1),) if answer.unnamed else ()
