"""From a grasp at a posture to what is drawn of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.evaluation import evaluate
from screwkit.grasping.matrices import GraspMatrices
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.joints import CATALOGUE, RIGID, freedom_labels
from screwkit.mechanism.model import Joint, JointType, Mechanism
from screwkit.results.scene import BodyShape, JointLook, JointShape, Point, Scene
from screwkit.screw import vector

_BALLS: Final = (JointType.SPHERICAL, JointType.UNIVERSAL)
_ANYWHERE: Final = RIGID | {JointType.PRISMATIC}
"""Joints whose freedoms do not depend on a point."""
MOST_JOINTS: Final = 200
"""Joints up to which a picture is printed."""


def scene_of(mechanism: Mechanism, matrices: GraspMatrices[Array]) -> Scene | None:
    """The mechanism where the grasp stands; None where it is too large for print.

    Arguments are those of `whole_scene`.
    """
    if len(mechanism.joints) > MOST_JOINTS:
        return None
    return whole_scene(mechanism, matrices)


def whole_scene(mechanism: Mechanism, matrices: GraspMatrices[Array]) -> Scene:
    """The mechanism where the grasp stands, however large it is.

    Args:
        mechanism: Symbols with numbers.
        matrices: The grasp.
    """
    places = _places(mechanism, matrices)
    points: dict[str, list[Point]] = {link: [] for link in mechanism.links}
    shapes = []
    for joint in mechanism.joints:
        point, direction = places[joint.name]
        if point is None:
            continue
        points[joint.parent].append(point)
        points[joint.child].append(point)
        shapes.append(
            JointShape(joint.name, _look(joint), point, direction, bool(joint.actuated))
        )
    roles = {mechanism.base: "base", mechanism.platform: "platform"}
    centre = _floats(matrices.reference_point)
    every = np.array([p for own in points.values() for p in own] or [centre])
    size = float(np.max(every.max(axis=0) - every.min(axis=0), initial=0.0))
    return Scene(
        tuple(
            BodyShape(link, tuple(own), roles.get(link, "link"))
            for link, own in points.items()
            if own
        ),
        tuple(shapes),
        mechanism.space == "planar",
        centre,
        size or 1.0,
        mechanism.units,
    )


def _look(joint: Joint) -> JointLook:
    if joint.type is JointType.FIXED:
        return "rigid"
    if CATALOGUE[joint.type].contact:
        return "contact"
    if joint.type in _BALLS:
        return "ball"
    return "slides" if joint.type is JointType.PRISMATIC else "turns"


def _places(
    mechanism: Mechanism, matrices: GraspMatrices[Array]
) -> dict[str, tuple[Point | None, Point]]:
    """A point and a direction of every joint."""
    twists = matrices.twists
    held = {row.hold.joint: row.wrench for row in matrices.rows}
    found: dict[str, tuple[Point | None, Point]] = {}
    for joint in mechanism.joints:
        labels = freedom_labels(joint, mechanism.space)
        zero = (0.0, 0.0, 0.0)
        if labels and labels[0] in twists:
            twist = twists[labels[0]]
            slides = joint.type is JointType.PRISMATIC
            along = twist.moment if slides else twist.direction
            placed = joint.mdh is not None or joint.point is not None
            point = _floats(twist.point) if placed else None
            found[joint.name] = point, _unit(_floats(along))
        elif joint.name in held and not _is_placeless(joint):
            found[joint.name] = _floats(held[joint.name].point), zero
        else:
            found[joint.name] = None, zero
        contact = CATALOGUE[joint.type].contact
        if contact and joint.name in held and not _is_placeless(joint):
            normal = _normal(mechanism, matrices, joint)
            found[joint.name] = _floats(held[joint.name].point), normal
    return _all_placed(mechanism, found, _floats(matrices.reference_point))


def _is_placeless(joint: Joint) -> bool:
    given = joint.point is not None or joint.mdh is not None
    return joint.type in _ANYWHERE and not given


def _all_placed(
    mechanism: Mechanism, found: Mapping[str, tuple[Point | None, Point]], centre: Point
) -> dict[str, tuple[Point | None, Point]]:
    """The same with places for joints that may be drawn anywhere.

    They are drawn between their neighbours, from those with a place outwards, and at
    the reference point where no joint has one.
    """
    placed = dict(found)
    anywhere = [
        joint
        for joint in mechanism.joints
        if joint.type in _ANYWHERE and found[joint.name][0] is None
    ]
    while anywhere:
        near = {j.name: _between(mechanism, j, placed) for j in anywhere}
        if not any(near.values()):
            near = dict.fromkeys(near, centre)
        for name, point in near.items():
            placed[name] = point, placed[name][1]
        anywhere = [joint for joint in anywhere if placed[joint.name][0] is None]
    return placed


def _normal(
    mechanism: Mechanism, matrices: GraspMatrices[Array], joint: Joint
) -> Point:
    """Of a contact, a unit vector where it stands; zero where it has none."""
    if joint.normal is None:
        return (0.0, 0.0, 0.0)
    ring = ring_at(mechanism, {})
    x, y, z = (evaluate(part, ring) for part in joint.normal)
    moved = matrices.carried.get(joint.parent)
    turned = (x, y, z) if moved is None else vector.rotate(moved.rotation, (x, y, z))
    return _unit(_floats(turned))


def _between(
    mechanism: Mechanism,
    joint: Joint,
    found: Mapping[str, tuple[Point | None, Point]],
) -> Point | None:
    """The middle of the points that its two bodies have from other joints."""
    near = [
        found[other.name][0]
        for other in mechanism.joints
        if other.name != joint.name
        and {other.parent, other.child} & {joint.parent, joint.child}
    ]
    known = [point for point in near if point is not None]
    if not known:
        return None
    return _floats(np.mean(np.array(known), axis=0))


def _floats(values: Iterable[Array | float]) -> Point:
    x, y, z = (float(v) for v in values)
    return x, y, z


def _unit(direction: Point) -> Point:
    size = float(np.linalg.norm(direction))
    if not size:
        return direction
    return _floats(np.array(direction) / size)
