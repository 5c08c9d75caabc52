"""Screw systems as an article shows them: one table a limb, one for the platform."""

from __future__ import annotations

from screwkit.algebra.names import limb_called
from screwkit.reports.about_screws import (
    actuation_table,
    convention,
    coordinates,
    dimensions,
    line,
)
from screwkit.reports.blocks import (
    Block,
    Column,
    Heading,
    Paragraph,
    Table,
    Text,
    words,
)
from screwkit.reports.phrases import capital
from screwkit.results.screws import IdentifiedScrew, Screws


def screws_section(answer: Screws) -> tuple[Block, ...]:
    """The section on screw systems."""
    text = convention(answer)
    blocks: list[Block] = [
        Heading(words("Screw systems"), 1),
        Paragraph(words(f"{capital(text)}.")),
    ]
    for index, limb in enumerate(answer.limbs):
        joints = ", ".join(limb.joints)
        caption = (
            f"{capital(limb_called(limb.name))} ({joints}): "
            f"{dimensions(limb.twist_dimension, limb.wrench_dimension)}"
        )
        blocks.append(
            _system(
                limb.twists, limb.wrenches, answer.order, caption, f"table:limb{index}"
            )
        )
    platform = answer.platform
    caption = "Platform: " + dimensions(
        platform.twist_dimension, platform.wrench_dimension
    )
    blocks.append(
        _system(
            platform.twists, platform.wrenches, answer.order, caption, "table:platform"
        )
    )
    if answer.actuation_wrenches:
        plain = actuation_table(answer.actuation_wrenches, answer.order)
        heads = ("Joint", "Kind", "Coordinates", "Line")
        columns = tuple(
            Column(words(head), column.align, column.weight)
            for head, column in zip(heads, plain.columns, strict=True)
        )
        blocks.append(
            Table(
                columns,
                plain.rows,
                words("Actuation wrenches: what each locked joint adds"),
                "table:actuation-wrenches",
                long=True,
            )
        )
    return tuple(blocks)


def _system(
    twists: tuple[IdentifiedScrew, ...],
    wrenches: tuple[IdentifiedScrew, ...],
    order: str,
    caption: str,
    label: str,
) -> Table:
    rows: list[tuple[Text, ...]] = []
    for role, screws, wrench in (("twist", twists, False), ("wrench", wrenches, True)):
        rows += [
            (
                words(f"{role}, {screw.kind}"),
                coordinates(screw, order, wrench=wrench),
                line(screw),
            )
            for screw in screws
        ]
    columns = (
        Column(words("Screw")),
        Column(words("Coordinates"), "wrap", 1.6),
        Column(words("Line"), "wrap"),
    )
    return Table(columns, tuple(rows), words(caption), label, long=True)
