"""Directions at right angles to a normal that moves, zero at no posture.

A product of the normal with an axis of the base vanishes where the two are parallel:
what slides along it would lose a freedom there that the joint has.  On the sphere no
product does better; but a normal is seldom free: it stays at right angles to an axis
of the base, of the platform or of the mechanism, or keeps an angle with one.

References: [BicchiPrattichizzo] Table I (tangents of a contact).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Final, TypeAlias

from screwkit.algebra.expression import ONE, ZERO, Expression, Number
from screwkit.algebra.expression_building import substitute, subtract, symbols_of
from screwkit.algebra.vector_expression import (
    VectorExpression,
    add_vectors,
    cross,
    dot,
    scale_vector,
)
from screwkit.mechanism.model import Joint, JointType, Mechanism, Parameter, Pose
from screwkit.mechanism.vanishing import is_zero

Frame: TypeAlias = tuple[VectorExpression, VectorExpression, VectorExpression]

_BASE: Final[Frame] = (
    (ONE, ZERO, ZERO),
    (ZERO, ONE, ZERO),
    (ZERO, ZERO, ONE),
)

_WITH_TANGENTS: Final = frozenset(
    {JointType.PLANAR, JointType.PLANE, JointType.POINT, JointType.SOFT_FINGER}
)
"""Joints whose freedoms are written along two directions in the plane of contact."""


Sides: TypeAlias = tuple[VectorExpression, VectorExpression]


def with_sides(
    joints: Sequence[Joint],
    pose: Pose | None,
    vectors: Iterable[VectorExpression],
    parameters: Sequence[Parameter],
) -> tuple[Joint, ...]:
    """The joints of a spatial ``posture`` file, each with the sides of its normal.

    Args:
        joints: In base coordinates; normals are zero nowhere.
        pose: Of the platform.
        vectors: Of the file, in base coordinates.
        parameters: Symbols of the file; those that are free make up the posture.
    """
    samples = _samples(parameters)
    if not any(_may_turn(joint, samples) for joint in joints):
        return tuple(joints)
    frames = [_BASE]
    if pose is not None:
        first, second, third = zip(*pose.rotation, strict=True)
        frames.append((first, second, third))
    long = [*_of_constant_length(vectors, samples)]
    return tuple(
        replace(joint, sides=_sides(joint.normal, frames, long, samples))
        if joint.normal is not None and _may_turn(joint, samples)
        else joint
        for joint in joints
    )


def without_sides(mechanism: Mechanism) -> tuple[Joint, ...]:
    """Joints with a normal that moves, of which no sides are known at all postures."""
    samples = _samples(mechanism.parameters)
    return tuple(
        joint
        for joint in mechanism.joints
        if joint.sides is None
        and mechanism.space == "spatial"
        and _may_turn(joint, samples)
    )


def _sides(
    normal: VectorExpression,
    frames: Sequence[Frame],
    vectors: Sequence[VectorExpression],
    samples: Mapping[str, Expression],
) -> Sides | None:
    """Two directions at right angles to a normal; zero nowhere, or not known."""
    found: list[VectorExpression] = []
    for frame in frames:
        values = [_constant(dot(axis, normal), samples) for axis in frame]
        known = [value for value in values if value is not None]
        k = next((k for k in (2, 1, 0) if _is_something(values[k])), None)
        if k is not None and len(known) == len(frame):  # it stands still in the frame
            x, y, z = known
            first = cross(_BASE[(k + 2) % 3], (x, y, z))
            return _in(frame, first), _in(frame, cross((x, y, z), first))
        if k is not None:
            found.append(cross(frame[(k + 2) % 3], normal))
    for axis in (*(axis for frame in frames for axis in frame), *vectors):
        if is_zero(dot(axis, normal)):
            found.insert(0, axis)
            break
    return (found[0], cross(normal, found[0])) if found else None


def _in(frame: Frame, coordinates: VectorExpression) -> VectorExpression:
    """The vector that has these coordinates in a frame."""
    return add_vectors(
        *(scale_vector(x, axis) for x, axis in zip(coordinates, frame, strict=True))
    )


def _is_something(value: Expression | None) -> bool:
    return value is not None and is_zero(value) is False


def _may_turn(joint: Joint, samples: Mapping[str, Expression]) -> bool:
    """Whether freedoms are written along sides of a normal that moves."""
    if joint.type not in _WITH_TANGENTS or joint.normal is None:
        return False
    return any(symbols_of(part) & samples.keys() for part in joint.normal)


def _samples(parameters: Iterable[Parameter]) -> dict[str, Expression]:
    """A number for every symbol of the posture; angles are 0."""
    free = [parameter for parameter in parameters if parameter.free]
    return {
        parameter.name: ZERO if parameter.angle else Number(Fraction(2 * k + 3, 7))
        for k, parameter in enumerate(free)
    }


def _of_constant_length(
    vectors: Iterable[VectorExpression], samples: Mapping[str, Expression]
) -> Iterator[VectorExpression]:
    """Those that are zero nowhere because their length is the same everywhere."""
    for vector in vectors:
        if _is_something(_constant(dot(vector, vector), samples)):
            yield vector


def _constant(
    expression: Expression, samples: Mapping[str, Expression]
) -> Expression | None:
    """What an expression is at every posture, if that is always the same."""
    try:
        value = substitute(expression, dict(samples))
    except ZeroDivisionError:
        return None
    return value if is_zero(subtract(expression, value)) else None
