"""A mechanism with numbers put in for some of its symbols."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from typing import TypeAlias

from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import substitution
from screwkit.mechanism.model import (
    Joint,
    MdhRow,
    Mechanism,
    Pose,
    VectorExpression,
)

Put: TypeAlias = Callable[[Expression], Expression]


def with_values(mechanism: Mechanism, values: Mapping[str, Expression]) -> Mechanism:
    """The mechanism with these symbols replaced; they are parameters no longer.

    Args:
        mechanism: As read.
        values: Expressions in the symbols that stay, by name; joint variables are held
            at theirs.
    """
    if not values:
        return mechanism
    put = substitution(values)

    def vector(written: VectorExpression) -> VectorExpression:
        x, y, z = (put(part) for part in written)
        return x, y, z

    pose, point = mechanism.pose, mechanism.reference_point
    if pose is not None:
        first, second, third = (vector(row) for row in pose.rotation)
        pose = Pose(vector(pose.translation), (first, second, third))
    return replace(
        mechanism,
        joints=tuple(_joint(joint, values, put) for joint in mechanism.joints),
        parameters=tuple(p for p in mechanism.parameters if p.name not in values),
        points={name: vector(p) for name, p in mechanism.points.items()},
        vectors={name: vector(v) for name, v in mechanism.vectors.items()},
        pose=pose,
        reference_point=None if point is None else vector(point),
        weights={
            key: tuple(tuple(put(x) for x in row) for row in rows)
            for key, rows in mechanism.weights.items()
        },
    )


def declared_values(mechanism: Mechanism) -> dict[str, Expression]:
    """The values that the file gives to its symbols."""
    return {p.name: p.value for p in mechanism.parameters if p.value is not None}


def given_before(mechanism: Mechanism) -> frozenset[str]:
    """Symbols of the file in whose place values from outside stand already."""
    left = {parameter.name for parameter in mechanism.parameters}
    return frozenset(mechanism.written) - left - {*mechanism.joint_variables}


def _joint(joint: Joint, values: Mapping[str, Expression], put: Put) -> Joint:
    def vector(written: VectorExpression | None) -> VectorExpression | None:
        if written is None:
            return None
        x, y, z = (put(part) for part in written)
        return x, y, z

    row = joint.mdh
    if row is not None:
        cells = {cell.name: put(getattr(row, cell.name)) for cell in fields(MdhRow)}
        row = MdhRow(**cells)
    axes = [vector(axis) for axis in joint.axes]
    first, second = map(vector, joint.sides or (None, None))
    pitch = joint.pitch
    return replace(
        joint,
        mdh=row,
        held=_held(joint, values, put),
        offsets=tuple(put(offset) for offset in joint.offsets),
        axes=tuple(axis for axis in axes if axis is not None),
        point=vector(joint.point),
        normal=vector(joint.normal),
        sides=None if first is None or second is None else (first, second),
        line=vector(joint.line),
        pitch=None if pitch is None else put(pitch),
    )


def _held(
    joint: Joint, values: Mapping[str, Expression], put: Put
) -> tuple[Expression | None, ...]:
    before = joint.held or (None,) * len(joint.variables)
    held = tuple(
        values.get(name, None if old is None else put(old))
        for name, old in zip(joint.variables, before, strict=True)
    )
    return held if any(value is not None for value in held) else ()
