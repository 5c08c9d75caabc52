"""Linkages whose finite motion is known from theory, as numbers at one posture."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations, product
from typing import TypeAlias

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.posture_model import (
    PosedJoint,
    PostureModel,
    characteristic_length,
)

Vector: TypeAlias = Sequence[float] | Array
Z = (0.0, 0.0, 1.0)


def turn(name: str, parent: str, child: str, axis: Vector, point: Vector) -> PosedJoint:
    along = np.asarray(axis, dtype=float)
    along = along / np.linalg.norm(along)
    screw = np.concatenate([along, np.cross(point, along)])
    return PosedJoint(name, parent, child, screw[None])


def slide(name: str, parent: str, child: str, axis: Vector) -> PosedJoint:
    along = np.asarray(axis, dtype=float)
    screw = np.concatenate([np.zeros(3), along / np.linalg.norm(along)])
    return PosedJoint(name, parent, child, screw[None])


def ball(name: str, parent: str, child: str, point: Vector) -> PosedJoint:
    axes = np.eye(3)
    screws = np.concatenate([axes, np.cross(point, axes)], axis=1)
    return PosedJoint(name, parent, child, screws, ball=True)


def model(base: str, platform: str, *joints: PosedJoint) -> PostureModel:
    ends = dict.fromkeys(x for joint in joints for x in (joint.parent, joint.child))
    length = characteristic_length(joints)[1]
    return PostureModel(tuple(ends), base, platform, tuple(joints), length)


def ring(platform: int, joints: Sequence[tuple[Vector, Vector]]) -> PostureModel:
    """A closed chain of revolute joints, given by axis and point."""
    count = len(joints)
    return model(
        "L0",
        f"L{platform}",
        *(
            turn(f"J{i}", f"L{i}", f"L{(i + 1) % count}", axis, point)
            for i, (axis, point) in enumerate(joints)
        ),
    )


def pins(platform: int, points: Sequence[tuple[float, float]]) -> PostureModel:
    """A planar closed chain."""
    return ring(platform, [(Z, (x, y, 0.0)) for x, y in points])


def two_kites() -> PostureModel:
    """Two kites on one hinge, flat: the hinge moves both, or each folds by itself.

    With the hinge at rest the pins A and C coincide and either dyad turns about them:
    two freedoms.  When the hinge turns, both dyads stand on the bisector: one.
    """
    joints = [turn("D", "base", "arm", Z, (0, 0, 0))]
    for name, reach in (("1", 1.0), ("2", 0.7)):
        joints += [
            turn(f"A{name}", "base", f"a{name}", Z, (1, 0, 0)),
            turn(f"B{name}", f"a{name}", f"c{name}", Z, (1 + reach, 0, 0)),
            turn(f"C{name}", f"c{name}", "arm", Z, (1, 0, 0)),
        ]
    return model("base", "arm", *joints)


def origami_vertex(sectors: Vector, platform: int) -> PostureModel:
    """A flat vertex with creases at the given sector angles in degrees."""
    angles = np.radians(np.cumsum(sectors))
    return ring(platform, [((np.cos(a), np.sin(a), 0), (0, 0, 0)) for a in angles])


def octahedron(corners: Mapping[str, Vector]) -> PostureModel:
    """Eight triangles hinged along twelve edges; opposite corners are A a, B b, C c."""
    faces = ["".join(face) for face in product("Aa", "Bb", "Cc")]
    points = {name: np.asarray(p, dtype=float) for name, p in corners.items()}
    joints = []
    for one, two in combinations(faces, 2):
        shared = sorted(set(one) & set(two))
        if len(shared) == 2:
            p, q = (points[name] for name in shared)
            joints.append(turn(f"{one}-{two}", one, two, p - q, p))
    return model(faces[0], faces[-1], *joints)


def moved(linkage: PostureModel, factor: float, seed: int) -> PostureModel:
    """The same linkage elsewhere, in other units, its joints turned round and mixed."""
    random = np.random.default_rng(seed)
    rotation = np.linalg.qr(random.standard_normal((3, 3)))[0]
    rotation *= np.sign(np.linalg.det(rotation))
    shift = factor * linkage.length * random.standard_normal(3)
    joints = []
    for number in random.permutation(len(linkage.joints)):
        joint = linkage.joints[number]
        screws = _placed(joint.screws, rotation, shift, factor)
        ends = (joint.parent, joint.child)
        if joint.ball:
            centre = 0.5 * np.cross(screws[:, :3], screws[:, 3:]).sum(axis=0)
            joints.append(ball(joint.name, *ends, centre))
        elif random.random() < 0.5:
            joints.append(PosedJoint(joint.name, *ends, screws))
        else:
            joints.append(PosedJoint(joint.name, *ends[::-1], -screws[::-1]))
    length = characteristic_length(joints)[1]
    return replace(linkage, joints=tuple(joints), length=length)


def _placed(screws: Array, rotation: Array, shift: Array, factor: float) -> Array:
    along = screws[:, :3] @ rotation.T
    turning = np.linalg.norm(along, axis=1, keepdims=True) > 0.5
    moments = screws[:, 3:] @ rotation.T * np.where(turning, factor, 1.0)
    return np.concatenate([along, moments + np.cross(shift, along)], axis=1)
