"""A mechanism with numbers put in for some of its symbols."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace

from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import substitute
from screwkit.mechanism.model import Joint, MdhRow, Mechanism


def with_values(mechanism: Mechanism, values: Mapping[str, Expression]) -> Mechanism:
    """The mechanism with these symbols replaced; they are parameters no longer.

    Args:
        mechanism: As read.
        values: Expressions in the symbols that stay, by name.
    """
    known = dict(values)
    return replace(
        mechanism,
        joints=tuple(_joint(joint, known) for joint in mechanism.joints),
        parameters=tuple(p for p in mechanism.parameters if p.name not in known),
    )


def _joint(joint: Joint, values: dict[str, Expression]) -> Joint:
    row = joint.mdh
    if row is not None:
        cells = {
            cell.name: substitute(getattr(row, cell.name), values)
            for cell in fields(MdhRow)
        }
        row = MdhRow(**cells)
    offsets = tuple(substitute(offset, values) for offset in joint.offsets)
    return replace(joint, mdh=row, offsets=offsets)
