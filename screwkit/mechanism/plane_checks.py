"""What a planar file holds lies in the xy plane: points, motions, poses and tables.

Rotations are about z, everything else has no part along it.  Only what provably leaves
the plane is refused; for the rows of a table one posture of random numbers is proof.
"""

from __future__ import annotations

import random
from collections import deque
from collections.abc import Sequence
from fractions import Fraction
from math import cos, sin
from typing import Final, TypeAlias

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.expression import ONE, Expression, Number
from screwkit.algebra.expression_building import substitute, subtract, symbols_of
from screwkit.algebra.vector_expression import VectorExpression
from screwkit.mechanism.model import Joint, JointType, MdhRow, Pose
from screwkit.mechanism.nodes import Path, find
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.structure import Draft
from screwkit.mechanism.vanishing import is_zero

Rotation: TypeAlias = tuple[tuple[float, ...], ...]

_TURNING: Final = frozenset({JointType.REVOLUTE, JointType.PLANAR})
_CLEARLY: Final = 1e-6
"""Sines above this are those of angles that are not zero."""


def refuse_height(path: Path, place: VectorExpression, reading: Reading) -> bool:
    """Report a place above or below the plane of a planar file; whether it was one."""
    if not reading.planar or is_zero(place[2]) is not False:
        return False
    own: Path = (*path, 2)
    reading.fault(
        path if find(reading.root, own) is None else own,
        "in a planar file z is 0; write [x, y]",
    )
    return True


def check_pose_plane(pose: Pose, reading: Reading) -> bool:
    """In a planar file the platform turns about z and moves along x and y."""
    if not reading.planar:
        return True
    high = refuse_height(("pose", "translation"), pose.translation, reading)
    first, second, third = pose.rotation
    tilts = (first[2], second[2], third[0], third[1], subtract(third[2], ONE))
    tilted = any(is_zero(tilt) is False for tilt in tilts)
    if tilted:
        path: Path = ("pose", "rotation")
        for key in ("axis", "angles", "quaternion"):
            if find(reading.root, (*path, key)) is not None:
                path = (*path, key)
                break
        reading.fault(
            path,
            "in a planar file the platform turns about z alone; write "
            "{axis: z, angle: …}",
        )
    return not (high or tilted)


def check_joint_plane(joint: Joint, path: Path, reading: Reading) -> None:
    """In a planar file rotations are about z, everything else lies in the plane."""
    about_z = joint.type in _TURNING
    directions = (
        *(("axis", axis) for axis in joint.axes),
        *((("normal", joint.normal),) if joint.normal is not None else ()),
    )
    for key, (x, y, z) in directions:
        out = (x, y) if about_z else (z,)
        if any(is_zero(part) is False for part in out):
            reading.fault((*path, key), f"in a planar file this {_direction(about_z)}")
    if joint.point is not None:
        refuse_height((*path, "point"), joint.point, reading)


def _direction(about_z: bool) -> str:
    return "direction is along z" if about_z else "direction is in the xy plane"


def check_table_plane(
    joints: Sequence[Joint], positions: Sequence[int], draft: Draft, reading: Reading
) -> None:
    """Rows of a planar table keep the axes of rotations along z."""
    if not reading.planar or draft.entry.geometry != "mdh" or draft.broken:
        return
    hanging: dict[str, list[tuple[Joint, int]]] = {}
    for joint, position in zip(joints, positions, strict=True):
        hanging.setdefault(joint.parent, []).append((joint, position))
    placed: dict[str, Rotation] = {draft.entry.base: _turn(2, 0.0)}
    waiting = deque(placed)
    while waiting:
        link = waiting.popleft()
        for joint, position in hanging.get(link, ()):
            if joint.mdh is None:
                continue
            turned = _turned(placed[link], joint, joint.mdh)
            if turned is None:
                continue
            _check_row_plane(joint, turned, ("joints", position, "mdh"), reading)
            if joint.child not in placed:
                placed[joint.child] = turned
                waiting.append(joint.child)


def _check_row_plane(
    joint: Joint, turned: Rotation, path: Path, reading: Reading
) -> None:
    x, y, z = (row[2] for row in turned)
    about_z = joint.type in _TURNING
    if joint.type is JointType.PRISMATIC or about_z:
        out = max(abs(x), abs(y)) if about_z else abs(z)
        if out > _CLEARLY:
            words = "axis is along z" if about_z else "axis is in the xy plane"
            reading.fault(
                path, f"in a planar file this {words}, and this row turns it elsewhere"
            )


def _turned(before: Rotation, joint: Joint, row: MdhRow) -> Rotation | None:
    """The frame of a joint turned as its row says, at random numbers."""
    angles = [_number(row.gamma), _number(row.alpha), _number(row.theta)]
    if joint.type is JointType.REVOLUTE:
        angles += map(_number, joint.offsets)
        angles.append(_drawn(joint.name))
    known = [angle for angle in angles if angle is not None]
    if len(known) != len(angles):
        return None
    gamma, alpha, *rest = known
    for axis, angle in ((2, gamma), (0, alpha), (2, sum(rest))):
        before = _product(before, _turn(axis, angle))
    return before


def _number(expression: Expression) -> float | None:
    names = symbols_of(expression)
    values: dict[str, Expression] = {
        name: Number(Fraction(_drawn(name))) for name in names
    }
    try:
        return closed_value(substitute(expression, values))
    except ZeroDivisionError:
        return None


def _drawn(name: str) -> float:
    return random.Random(name).uniform(0.1, 1.0)


def _turn(axis: int, angle: float) -> Rotation:
    c, s = cos(angle), sin(angle)
    if axis == 0:
        return ((1.0, 0.0, 0.0), (0.0, c, -s), (0.0, s, c))
    return ((c, -s, 0.0), (s, c, 0.0), (0.0, 0.0, 1.0))


def _product(left: Rotation, right: Rotation) -> Rotation:
    columns = tuple(zip(*right, strict=True))
    return tuple(
        tuple(
            sum(a * b for a, b in zip(row, column, strict=True)) for column in columns
        )
        for row in left
    )
