"""The freedoms of joints as lines and directions in numbers."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.grasping.matrices import GraspMatrices
from screwkit.kinematics.freedoms import JointTwist
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Joint, JointType, Mechanism
from screwkit.results.scene import Point, Scene
from screwkit.results.view import FreedomShape, PlacedScrew
from screwkit.systems.principal_screws import principal_screws

_ROUNDING: Final = 1e-9
"""Pitches below this part of a mechanism's size count as zero; said with the answer."""


def freedoms_of(
    mechanism: Mechanism, matrices: GraspMatrices[Array], scene: Scene
) -> tuple[FreedomShape, ...]:
    """The freedoms of all joints where the grasp stands.

    Args:
        mechanism: Symbols with numbers, and the scheme that is to be shown.
        matrices: The grasp.
        scene: Where its joints are drawn.
    """
    drawn = {shape.name: shape.point for shape in scene.joints}
    return tuple(
        _freedom(joint, index, matrices.twists[label], drawn)
        for joint in mechanism.joints
        for index, label in enumerate(freedom_labels(joint, mechanism.space))
        if label in matrices.twists
    )


def _freedom(
    joint: Joint, index: int, twist: JointTwist[Array], drawn: dict[str, Point]
) -> FreedomShape:
    turns = _floats(twist.direction)
    slides = not any(turns)
    along = _floats(twist.moment) if slides else turns
    point = _floats(twist.point)
    pitch: float | None = None if slides else 0.0
    if joint.type is JointType.HELICAL:
        moment = np.array(_floats(twist.moment))
        pitch = float(moment @ np.array(turns)) / float(np.dot(turns, turns))
    kind = "translation" if slides else "screw" if pitch else "rotation"
    return FreedomShape(
        joint.name,
        twist.label,
        kind,
        drawn.get(joint.name, point) if slides else point,
        _unit(along),
        pitch,
        index in joint.actuated,
    )


def placed_screw(
    coordinates: Sequence[float], kind: str, description: str = ""
) -> PlacedScrew:
    """A screw (direction; moment) with six coordinates, whose kind is known."""
    direction, moment = np.array(coordinates[:3]), np.array(coordinates[3:])
    if kind in ("couple", "translation"):
        return PlacedScrew(kind, _unit(moment), None, None, description)
    square = float(direction @ direction)
    point = _floats(np.cross(direction, moment) / square)
    pitch = float(direction @ moment) / square if kind == "screw" else 0.0
    return PlacedScrew(kind, _unit(direction), point, pitch, description)


def principal_shapes(
    system: Array, size: float, kinds: tuple[str, str]
) -> tuple[PlacedScrew, ...]:
    """The principal screws of a system that is known in floating point alone.

    Args:
        system: Rows (direction; moment).
        size: Of the mechanism.
        kinds: What screws of pitch zero and pure moments are called.
    """
    zero, pure = kinds
    found = []
    for screw in principal_screws(system):
        if screw.point is None:
            found.append(PlacedScrew(pure, screw.direction, None, None))
        elif abs(screw.pitch) <= _ROUNDING * size:
            found.append(PlacedScrew(zero, screw.direction, screw.point, 0.0))
        else:
            found.append(
                PlacedScrew("screw", screw.direction, screw.point, screw.pitch)
            )
    return tuple(found)


def _floats(values: Sequence[Array] | Array) -> Point:
    x, y, z = (float(value) + 0.0 for value in values)
    return x, y, z


def _unit(direction: Sequence[float] | Array) -> Point:
    vector = np.array(direction, dtype=float)
    return _floats(vector / (float(np.linalg.norm(vector)) or 1.0))
