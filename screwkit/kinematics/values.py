"""A mechanism with numbers put in for some of its symbols."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace

from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import substitute
from screwkit.mechanism.model import (
    Joint,
    MdhRow,
    Mechanism,
    Pose,
    VectorExpression,
)


def with_values(mechanism: Mechanism, values: Mapping[str, Expression]) -> Mechanism:
    """The mechanism with these symbols replaced; they are parameters no longer.

    Args:
        mechanism: As read.
        values: Expressions in the symbols that stay, by name; joint variables are held
            at theirs.
    """
    if not values:
        return mechanism
    known = dict(values)

    def vector(written: VectorExpression) -> VectorExpression:
        x, y, z = (substitute(part, known) for part in written)
        return x, y, z

    pose, point = mechanism.pose, mechanism.reference_point
    if pose is not None:
        first, second, third = (vector(row) for row in pose.rotation)
        pose = Pose(vector(pose.translation), (first, second, third))
    return replace(
        mechanism,
        joints=tuple(_joint(joint, known) for joint in mechanism.joints),
        parameters=tuple(p for p in mechanism.parameters if p.name not in known),
        points={name: vector(p) for name, p in mechanism.points.items()},
        vectors={name: vector(v) for name, v in mechanism.vectors.items()},
        pose=pose,
        reference_point=None if point is None else vector(point),
        weights={
            key: tuple(tuple(substitute(x, known) for x in row) for row in rows)
            for key, rows in mechanism.weights.items()
        },
    )


def declared_values(mechanism: Mechanism) -> dict[str, Expression]:
    """The values that the file gives to its symbols."""
    return {p.name: p.value for p in mechanism.parameters if p.value is not None}


def _joint(joint: Joint, values: dict[str, Expression]) -> Joint:
    def vector(written: VectorExpression | None) -> VectorExpression | None:
        if written is None:
            return None
        x, y, z = (substitute(part, values) for part in written)
        return x, y, z

    row = joint.mdh
    if row is not None:
        cells = {
            cell.name: substitute(getattr(row, cell.name), values)
            for cell in fields(MdhRow)
        }
        row = MdhRow(**cells)
    axes = [vector(axis) for axis in joint.axes]
    pitch = joint.pitch
    return replace(
        joint,
        mdh=row,
        held=_held(joint, values),
        offsets=tuple(substitute(offset, values) for offset in joint.offsets),
        axes=tuple(axis for axis in axes if axis is not None),
        point=vector(joint.point),
        normal=vector(joint.normal),
        line=vector(joint.line),
        pitch=None if pitch is None else substitute(pitch, values),
    )


def _held(joint: Joint, values: dict[str, Expression]) -> tuple[Expression | None, ...]:
    before = joint.held or (None,) * len(joint.variables)
    held = tuple(
        values.get(name, None if old is None else substitute(old, values))
        for name, old in zip(joint.variables, before, strict=True)
    )
    return held if any(value is not None for value in held) else ()
