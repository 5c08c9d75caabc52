"""Sections that answer `screws`: the systems of the limbs and of the platform."""

from __future__ import annotations

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
from screwkit.reports.phrases import counted, listed, tuple_of
from screwkit.results.screws import ActuationWrench, IdentifiedScrew, Screws

LINEAR = "moment-direction"


def screws_blocks(answer: Screws) -> tuple[Block, ...]:
    """The whole answer."""
    blocks: list[Block] = [Paragraph(words(convention(answer)), 1)]
    for limb in answer.limbs:
        blocks += [
            Heading(
                words(f"limb {limb.name}: {listed(limb.joints)}"),
                1,
                words(dimensions(limb.twist_dimension, limb.wrench_dimension)),
            ),
            *screw_tables(limb.twists, limb.wrenches, answer.order),
        ]
    platform = answer.platform
    blocks += [
        Heading(
            words("platform"),
            1,
            words(dimensions(platform.twist_dimension, platform.wrench_dimension)),
        ),
        *screw_tables(platform.twists, platform.wrenches, answer.order),
    ]
    if answer.actuation_wrenches:
        blocks += [
            Heading(words("what each locked joint adds"), 1),
            actuation_table(answer.actuation_wrenches, answer.order),
        ]
    return tuple(blocks)


def dimensions(twists: int, wrenches: int) -> str:
    """The two dimensions of a system and its reciprocal."""
    constraints = counted(wrenches, "constraint wrench", "constraint wrenches")
    return f"{counted(twists, 'freedom')}, {constraints}"


def convention(answer: Screws) -> str:
    """Order, frame and point, said before any coordinate."""
    twist, wrench = (
        ("(v; ω)", "(m; f)") if answer.order == LINEAR else ("(ω; v)", "(f; m)")
    )
    where = "its origin" if answer.point == "origin" else answer.point
    return (
        f"twists {twist} and wrenches {wrench} in the axes of {answer.frame}, "
        f"moments about {where}; each up to a factor"
    )


def split_of(coordinates: tuple[str, ...], order: str, *, wrench: bool) -> int:
    """After how many coordinates the second half begins."""
    if len(coordinates) != 3:
        return len(coordinates) // 2
    return 2 if wrench != (order == LINEAR) else 1


def screw_tables(
    twists: tuple[IdentifiedScrew, ...],
    wrenches: tuple[IdentifiedScrew, ...],
    order: str,
) -> tuple[Table, ...]:
    """Twists, then wrenches; empty systems left out."""
    tables = []
    for screws, wrench in ((twists, False), (wrenches, True)):
        if screws:
            rows = tuple(
                (
                    words(screw.kind),
                    coordinates(screw, order, wrench=wrench),
                    line(screw),
                )
                for screw in screws
            )
            columns = (Column(()), Column((), "wrap", 3), Column((), "wrap", 2))
            tables.append(Table(columns, rows))
    return tuple(tables)


def coordinates(screw: IdentifiedScrew, order: str, *, wrench: bool) -> Text:
    """The coordinates of a screw in brackets."""
    return tuple_of(
        screw.coordinates, split_of(screw.coordinates, order, wrench=wrench)
    )


def line(screw: IdentifiedScrew) -> Text:
    """The screw in geometry's words: its axis, a point of it, its pitch."""
    if screw.description:
        return prose(screw.description)
    parts: list[Text] = []
    if screw.axis:
        parts.append((Words("along "), *tuple_of(screw.axis)))
    if screw.point:
        parts.append((Words("through "), *tuple_of(screw.point)))
    if screw.pitch and screw.pitch != "0":
        parts.append((Words("pitch "), *math(screw.pitch)))
    return joined(parts, " ")


def actuation_table(wrenches: tuple[ActuationWrench, ...], order: str) -> Table:
    """One row a freedom; idle freedoms say so."""
    rows: list[tuple[Text, ...]] = []
    several = {w.joint for w in wrenches if w.freedom}
    for entry in wrenches:
        name = (
            f"{entry.joint}:{entry.freedom}" if entry.joint in several else entry.joint
        )
        if entry.screw is None:
            rows.append((words(name), words("–"), words("adds nothing: idle"), ()))
            continue
        rows.append(
            (
                words(name),
                words(entry.screw.kind),
                coordinates(entry.screw, order, wrench=True),
                line(entry.screw),
            )
        )
    columns = (Column(()), Column(()), Column((), "wrap", 3), Column((), "wrap", 2))
    return Table(columns, tuple(rows))
