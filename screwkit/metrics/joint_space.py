"""The mechanism's own motion in the rates of its joints, whatever its file describes.

Coordinates count from the given posture: angles in radians, slides over one length.
Loops close where their misses vanish.

References: [MurrayLiSastry1994] §3.2.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.evaluation import evaluate
from screwkit.finite.exponentials import (
    at_stance,
    exponential,
    misses,
    rotation_vectors,
)
from screwkit.finite.posture_model import (
    PosedJoint,
    PostureModel,
    characteristic_length,
    scaled,
)
from screwkit.finite.posture_numbers import numbers_at
from screwkit.finite.spanning_forest import Forest, Indices, forest_of
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.joint_rates import Placed, ball_by_rates, placed_at
from screwkit.metrics.smooth import Remembered, Smooth


@dataclass(frozen=True, eq=False)
class JointSpace:
    """A mechanism at its posture, and where joint coordinates bring it.

    Attributes:
        model: Lengths over ``length``, about its middle.
        forest: Of the model.
        length: That counts as one radian, in file lengths.
        carriers: The node that carries each screw, shape (freedoms,).
        platform: A point of the platform by which its shift is measured, in the
            model's coordinates; None where joints are measured.
    """

    model: PostureModel
    forest: Forest
    length: float
    carriers: Indices
    platform: Array | None = None

    @property
    def turning(self) -> frozenset[str]:
        """The freedoms that turn."""
        turns = np.linalg.norm(self.model.screws[:, :3], axis=1) > 0.5
        pairs = zip(self.model.labels, turns, strict=True)
        return frozenset(label for label, turn in pairs if turn)

    @property
    def start(self) -> Array:
        """The posture from which coordinates count: 0, shape (freedoms,)."""
        return np.zeros(len(self.model.labels))

    @property
    def units(self) -> Array:
        """What a coordinate is multiplied with to be in radians or file lengths."""
        slides = np.linalg.norm(self.model.screws[:, :3], axis=1) < 0.5
        return np.where(slides, self.length, 1.0)

    @cached_property
    def placed(self) -> Remembered[Placed]:
        """The mechanism at points, shape (batch, freedoms)."""
        return Remembered(
            lambda x: placed_at(self.model, self.forest, x, self.carriers)
        )

    @property
    def screws(self) -> JointScrews:
        """The screws of all freedoms at points."""
        return JointScrews(self)

    @property
    def kept(self) -> Smooth:
        """By what the loops miss, shape (batch, 6·loops)."""

        def both(points: Array) -> tuple[Array, Array]:
            placed = self.placed(points)
            return misses(placed.stance), placed.misses_by_rates()

        return Smooth(lambda points: misses(self.placed(points).stance), both)

    @property
    def away(self) -> Smooth:
        """What the distance is the norm of, shape (batch, k)."""
        point = self.platform
        if point is None:
            return Smooth(
                self._joints, lambda x: (self._joints(x), self._joints_by_rates(x))
            )
        return Smooth(
            lambda x: self._pose(x, point),
            lambda x: (self._pose(x, point), self.placed(x).pose_by_rates(point)),
        )

    def _pose(self, points: Array, point: Array) -> Array:
        body = self.placed(points).stance.platform
        turn, shift = body[:, :3, :3], body[:, :3, 3]
        return np.concatenate(
            [rotation_vectors(turn), turn @ point + shift - point], axis=1
        )

    def _joints(self, points: Array) -> Array:
        parts, start = [], 0
        for joint in self.model.joints:
            stop = start + len(joint.screws)
            if joint.ball:
                parts.append(_turned(joint.screws, points[:, start : start + 3]))
                start += 3
            parts.append(points[:, start:stop])
            start = stop
        return np.concatenate(parts, axis=1)

    def _joints_by_rates(self, points: Array) -> Array:
        batch, count = points.shape
        rates = np.broadcast_to(np.eye(count), (batch, count, count)).copy()
        start = 0
        for joint in self.model.joints:
            if joint.ball:
                span = slice(start, start + 3)
                rates[:, span, span] = ball_by_rates(joint.screws[:3], points[:, span])
            start += len(joint.screws)
        return rates

    def model_at(self, point: Array) -> PostureModel:
        """The model at a closed posture, shape (freedoms,)."""
        return at_stance(self.model, self.placed(point[None]).stance)


@dataclass(frozen=True, eq=False)
class JointScrews:
    """The screws of all freedoms of a joint space, and how fast they change.

    Attributes:
        space: Whose they are.
    """

    space: JointSpace

    def values(self, points: Array) -> Array:
        """Shape (batch, freedoms, 6)."""
        return self.space.placed(points).stance.screws

    def rates(self, points: Array, forms: Array) -> Array:
        """See `screwkit.metrics.rank_conditions.Screws`."""
        return self.space.placed(points).forms_by_rates(forms)


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
    model: PostureModel,
    length: float | None = None,
    point: Array | None = None,
    contacts: Collection[str] = (),
) -> JointSpace:
    """The joint coordinates of a model.

    Args:
        model: At a closed posture.
        length: That counts as one radian; the model's own where None.
        point: Of the platform in base coordinates, if its pose is what is measured.
        contacts: Joints that are contacts: their screws stay with their parents, so
            that two tangents stay tangents.
    """
    upright = tuple(
        _with_square_tangents(joint) if joint.name in contacts else joint
        for joint in model.joints
    )
    measured = replace(model, joints=upright, length=length or model.length)
    own = scaled(measured)
    middle = characteristic_length(upright)[0]
    inside = None if point is None else (point - middle) / measured.length
    forest = forest_of(own)
    carriers = _carriers(own, forest, contacts)
    return JointSpace(own, forest, measured.length, carriers, inside)


def _with_square_tangents(joint: PosedJoint) -> PosedJoint:
    """A contact that turns about two tangents, with these at right angles.

    Which two axes through the point span its plane does not matter to a contact; as the
    axes of a universal joint they reach every direction only at right angles.
    """
    first, *rest = joint.screws
    if len(rest) != 1 or min(np.linalg.norm(joint.screws[:, :3], axis=1)) < 0.5:
        return joint
    part = rest[0] - first * (first[:3] @ rest[0][:3])
    square = part / np.linalg.norm(part[:3])
    return replace(joint, screws=np.array([first, square]))


def _carriers(
    model: PostureModel, forest: Forest, contacts: Collection[str]
) -> Indices:
    found, start = forest.before.copy(), 0
    for joint in model.joints:
        stop = start + len(joint.screws)
        if joint.name in contacts and stop > start:
            outwards = forest.signs[start] > 0
            found[start:stop] = (forest.before if outwards else forest.behind)[start]
        start = stop
    return found
