"""The mechanism's own motion in the rates of its joints, whatever its file describes.

Coordinates count from the given posture: angles in radians, slides over one length.
Loops close where their misses vanish.

References: [MurrayLiSastry1994] §3.2.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.evaluation import evaluate
from screwkit.finite.exponentials import (
    Stance,
    at_stance,
    exponential,
    misses,
    moved,
    rotation_vectors,
    stance_of,
)
from screwkit.finite.posture_model import PostureModel, characteristic_length, scaled
from screwkit.finite.posture_numbers import numbers_at
from screwkit.finite.spanning_forest import Forest, forest_of
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.model import Mechanism


@dataclass(frozen=True, eq=False)
class JointSpace:
    """A mechanism at its posture, and where joint coordinates bring it.

    Attributes:
        model: Lengths over ``length``, about its middle.
        forest: Of the model.
        length: That counts as one radian, in file lengths.
        platform: A point of the platform by which its shift is measured, in the
            model's coordinates; None where joints are measured.
    """

    model: PostureModel
    forest: Forest
    length: float
    platform: Array | None = None

    @property
    def turning(self) -> frozenset[str]:
        """The freedoms that turn."""
        turns = np.linalg.norm(self.model.screws[:, :3], axis=1) > 0.5
        pairs = zip(self.model.labels, turns, strict=True)
        return frozenset(label for label, turn in pairs if turn)

    def stances(self, points: Array) -> Stance:
        """The postures of points, shape (batch, freedoms)."""
        start = stance_of(self.model, self.forest, len(points))
        return moved(self.forest, start, points)

    def screws(self, points: Array) -> Array:
        """The screws of all freedoms, shape (batch, freedoms, 6)."""
        return self.stances(points).screws

    def kept(self, points: Array) -> Array:
        """By what the loops miss, shape (batch, 6·loops)."""
        return misses(self.stances(points))

    def away(self, points: Array) -> Array:
        """What the distance is the norm of, shape (batch, k)."""
        if self.platform is not None:
            body = self.stances(points).platform
            turn, shift = body[:, :3, :3], body[:, :3, 3]
            moved_point = turn @ self.platform + shift
            return np.concatenate(
                [rotation_vectors(turn), moved_point - self.platform], axis=1
            )
        parts, start = [], 0
        for joint in self.model.joints:
            stop = start + len(joint.screws)
            if joint.ball:
                parts.append(_turned(joint.screws, points[:, start : start + 3]))
                start += 3
            parts.append(points[:, start:stop])
            start = stop
        return np.concatenate(parts, axis=1)

    def model_at(self, point: Array) -> PostureModel:
        """The model at a closed posture, shape (freedoms,)."""
        return at_stance(self.model, self.stances(point[None]))


def _turned(screws: Array, angles: Array) -> Array:
    """Of a ball joint: the axis times the angle of its rotation."""
    turn = np.eye(4)
    for screw, angle in zip(screws[:3], angles.T, strict=True):
        turn = turn @ exponential(np.broadcast_to(screw, (len(angle), 6)), angle)
    return rotation_vectors(turn[..., :3, :3])


def pose_origin(mechanism: Mechanism, model: PostureModel) -> Array | None:
    """The platform's origin where its pose says how the whole mechanism stands.

    Args:
        mechanism: All its symbols with values.
        model: At the posture of the file.

    Returns:
        None where there is no pose, or more moves than the platform.
    """
    known = numbers_at(model)
    if mechanism.pose is None or known.mobility != known.twist_dimension:
        return None
    ring = ring_at(mechanism, {})
    return np.array([float(evaluate(x, ring)) for x in mechanism.pose.translation])


def joint_space(
    model: PostureModel, length: float | None = None, point: Array | None = None
) -> JointSpace:
    """The joint coordinates of a model.

    Args:
        model: At a closed posture.
        length: That counts as one radian; the model's own where None.
        point: Of the platform in base coordinates, if its pose is what is measured.
    """
    measured = replace(model, length=length or model.length)
    own = scaled(measured)
    middle = characteristic_length(model.joints)[0]
    inside = None if point is None else (point - middle) / measured.length
    return JointSpace(own, forest_of(own), measured.length, inside)
