"""A mechanism as numbers: the unit screws of all joints at one closed posture.

Joints stand in base axes about the base origin where the posture puts them, loops are
closed by construction, and every freedom moves what follows it by the exponential of
its screw.  This is all that the numeric side of finite motion needs to know, whichever
way the file gave its geometry.

References: [MurrayLiSastry1994] §3.2.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.names import meant_or_all
from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.finite.table_closure import require_closed
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.loops import Posture, ring_at
from screwkit.kinematics.placement import joint_twists
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Joint, JointType, Mechanism

NO_LENGTH = 1e-9
"""Distances below this part of the largest coordinate are no length of a mechanism."""


@dataclass(frozen=True, eq=False)
class PosedJoint:
    """One joint at the posture; its motion is that of ``child`` relative to ``parent``.

    The displacement of the child is exp(q₁ξ₁) exp(q₂ξ₂) … in the order of the rows.

    Attributes:
        screws: (ω; v) of each freedom, shape (freedoms, 6), in base axes about the
            base origin; |ω| = 1, or ω = 0 and |v| = 1.
        ball: Whether the first three freedoms turn about x, y and z through one point;
            they are set upright again wherever the model is based anew, so that no
            posture locks them.
        labels: How each freedom is written: ``name``, or ``name:k``.
    """

    name: str
    parent: str
    child: str
    screws: Array
    ball: bool = False
    labels: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        screws = np.array(self.screws, dtype=float).reshape(-1, 6)
        screws.setflags(write=False)
        object.__setattr__(self, "screws", screws)
        if not self.labels:
            count = len(screws)
            several = tuple(f"{self.name}:{k}" for k in range(count))
            object.__setattr__(self, "labels", (self.name,) if count == 1 else several)


@dataclass(frozen=True, eq=False)
class PostureModel:
    """A mechanism at one closed posture, in numbers.

    Attributes:
        links: Names of all links, base and platform among them.
        length: A length that is characteristic of the mechanism, in file lengths;
            lengths and angles are compared by its measure.
    """

    links: tuple[str, ...]
    base: str
    platform: str
    joints: tuple[PosedJoint, ...]
    length: float = 1.0

    @property
    def labels(self) -> tuple[str, ...]:
        """All freedoms, joint by joint: the order of the coordinates q."""
        return tuple(label for joint in self.joints for label in joint.labels)

    @property
    def screws(self) -> Array:
        """The screws of all freedoms, shape (freedoms, 6)."""
        return np.concatenate([np.zeros((0, 6)), *(j.screws for j in self.joints)])

    def index(self, label: str) -> int:
        """Which coordinate a freedom is.

        Raises:
            UnknownNameError: If there is no freedom of that name.
        """
        labels = self.labels
        if label not in labels:
            hint = meant_or_all(label, labels)
            raise UnknownNameError(f"no freedom {label!r}{hint}")
        return labels.index(label)


def posture_model(mechanism: Mechanism, values: Posture | None = None) -> PostureModel:
    """The model of a mechanism at the posture of its file.

    Args:
        mechanism: Any mechanism; a ``reference`` file stands at joint variables 0, an
            ``mdh`` file at the values given for all of its joint variables.
        values: Numbers for symbols, in radians and file lengths; they overrule those
            of the file.

    Raises:
        UnknownNameError: If a symbol has no value.
        UndecidedError: If a joint has no place, no direction, or a value that is not
            finite, or if the values leave a loop of an ``mdh`` table open.
    """
    known: dict[str, Array | float] = {}
    if mechanism.geometry == "reference":
        known.update(dict.fromkeys(mechanism.joint_variables, 0.0))
    known.update(values or {})
    ring = ring_at(mechanism, known)
    if mechanism.geometry == "mdh":
        require_closed(mechanism, ring)
    twists = joint_twists(mechanism, ring, mechanism.base)
    joints = tuple(_posed(joint, twists, mechanism) for joint in mechanism.joints)
    return PostureModel(
        mechanism.links,
        mechanism.base,
        mechanism.platform,
        joints,
        characteristic_length(joints)[1],
    )


def _posed(
    joint: Joint, twists: Mapping[str, JointTwist[Array]], mechanism: Mechanism
) -> PosedJoint:
    labels = freedom_labels(joint, mechanism.space)
    missing = [label for label in labels if label not in twists]
    if missing:
        raise UndecidedError(f"the table does not place joint {joint.name!r}")
    rows = [_unit(twists[label]) for label in labels]
    ball = len(rows) >= 3 and joint.type in _BALLS
    screws = np.array(rows).reshape(-1, 6)
    return PosedJoint(joint.name, joint.parent, joint.child, screws, ball, labels)


def _unit(twist: JointTwist[Array]) -> Array:
    screw = np.array([float(x) for x in twist.coordinates])
    turn, slide = np.linalg.norm(screw[:3]), np.linalg.norm(screw[3:])
    size = turn or slide
    if not (np.isfinite(screw).all() and size > 0):
        raise UndecidedError(f"the axis of {twist.label!r} has no direction here")
    return np.asarray(screw / size)


_BALLS = (JointType.SPHERICAL, JointType.HARD_FINGER, JointType.POINT)


def characteristic_length(joints: Collection[PosedJoint]) -> tuple[Array, float]:
    """The point nearest to all axes of rotation, and how far they pass it.

    The distance is the root mean square; where all axes meet it is that of the
    pitches, and 1 where nothing has a length.  Neither depends on where along an axis
    a file puts its point.

    Returns:
        The point, shape (3,), and the length.
    """
    screws = np.concatenate([np.zeros((0, 6)), *(joint.screws for joint in joints)])
    screws = screws[np.linalg.norm(screws[:, :3], axis=1) > 0.5]
    if not len(screws):
        return np.zeros(3), 1.0
    along, moments = screws[:, :3], screws[:, 3:]
    feet = np.cross(along, moments)
    across = np.eye(3) - along[:, :, None] * along[:, None, :]
    centre = np.linalg.lstsq(across.sum(axis=0), feet.sum(axis=0), rcond=1e-9)[0]
    distances = np.linalg.norm(feet - across @ centre, axis=1)
    length = float(np.sqrt(np.mean(distances**2)))
    if length > NO_LENGTH * np.linalg.norm(feet, axis=1).max(initial=0.0):
        return centre, length
    pitch = float(np.abs(np.sum(along * moments, axis=1)).max())
    return centre, pitch if pitch > NO_LENGTH else 1.0


def scaled(model: PostureModel) -> PostureModel:
    """The same mechanism about its middle and measured by its own length.

    Coordinates of translations are divided by the length as well, so that all joint
    coordinates and all residuals are pure numbers of comparable size.
    """
    centre, _ = characteristic_length(model.joints)
    return replace(
        model,
        joints=tuple(
            replace(joint, screws=_about(joint.screws, centre, model.length))
            for joint in model.joints
        ),
        length=1.0,
    )


def _about(screws: Array, origin: Array, length: float) -> Array:
    turning = np.linalg.norm(screws[:, :3], axis=1, keepdims=True) > 0.5
    moments = screws[:, 3:] - np.cross(origin, screws[:, :3])
    moments = np.where(turning, moments / length, moments)
    return np.concatenate([screws[:, :3], moments], axis=1)


def with_locked(model: PostureModel, locked: Collection[str]) -> PostureModel:
    """The model with some freedoms held where they are.

    Raises:
        UnknownNameError: If a label is no freedom of the model.
    """
    for label in locked:
        model.index(label)
    return replace(model, joints=tuple(_held(joint, locked) for joint in model.joints))


def _held(joint: PosedJoint, locked: Collection[str]) -> PosedJoint:
    kept = [k for k, label in enumerate(joint.labels) if label not in locked]
    labels = tuple(joint.labels[k] for k in kept)
    ball = joint.ball and kept[:3] == [0, 1, 2]
    return replace(joint, screws=joint.screws[kept], labels=labels, ball=ball)
