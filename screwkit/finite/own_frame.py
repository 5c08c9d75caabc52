"""A posture model in a frame, an order and directions that are the mechanism's own.

Samples depend on the coordinates in which random directions are drawn.  Here these come
from where the joints stand about the middle of the mechanism and from their names, so
that a file in another frame, its joints turned round or in another order, is sampled
at the very same postures.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.batch import Array
from screwkit.finite.chain_graph import joints_away
from screwkit.finite.exponentials import Stance, cross
from screwkit.finite.posture_model import PosedJoint, PostureModel

VISIBLE = 1e-6
"""Size of a vector, or of its part across others, that gives a direction."""

TURNABLE = 2
"""Freedoms of a joint, no ball, that is as simple in both directions."""


@dataclass(frozen=True, eq=False)
class OwnFrame:
    """A model in its own frame, and the way back.

    Attributes:
        model: In its own frame.
        given: As it was given.
        rotation: From the given frame to the own one, shape (3, 3).
        order: Which given freedom each own one is, shape (freedoms,).
        signs: −1 where an own screw points against the given one, shape (freedoms,).
    """

    model: PostureModel
    given: PostureModel
    rotation: Array
    order: NDArray[np.intp]
    signs: Array

    def as_given(self, stance: Stance) -> Stance:
        """Postures of the own model as those of the given one; loops are closed."""
        screws = np.empty_like(stance.screws)
        turned = _turned(self.rotation.T, stance.screws)
        screws[:, self.order] = self.signs[:, None] * turned
        start = 0
        for joint in self.given.joints:
            if joint.ball:
                _set_upright(screws[:, start : start + 3])
            start += len(joint.screws)
        bodies = np.array(stance.bodies)
        bodies[..., :3, :3] = self.rotation.T @ bodies[..., :3, :3] @ self.rotation
        bodies[..., :3, 3] = bodies[..., :3, 3] @ self.rotation
        return Stance(screws, stance.gaps, bodies)


def in_own_frame(model: PostureModel) -> OwnFrame:
    """A model about its middle, in a frame and an order of its own.

    Args:
        model: As `scaled` leaves it.
    """
    joints, order = _ordered(model)
    rotation = _own_axes(joints)
    signs = list[float]()
    turned = list[PosedJoint]()
    for joint in joints:
        screws = _turned(rotation, joint.screws)
        own = np.ones(len(screws))
        if joint.ball:
            _set_upright(screws[:3])
        else:
            own = np.array([_sign(screw) for screw in screws]).reshape(-1)
            screws = own[:, None] * screws
        turned.append(replace(joint, screws=screws))
        signs += own.tolist()
    others = (x for x in model.links if x not in (model.base, model.platform))
    links = tuple(dict.fromkeys((model.base, model.platform, *sorted(others))))
    own_model = replace(model, joints=tuple(turned), links=links)
    return OwnFrame(own_model, model, rotation, order, np.array(signs))


def _ordered(model: PostureModel) -> tuple[list[PosedJoint], NDArray[np.intp]]:
    """The joints by their names, each leading away from the base.

    Those of several freedoms that no order of these turns round stay as they are.

    Returns:
        The joints, their screws not yet turned, and which given freedom each is.
    """
    starts = np.cumsum([0, *(len(joint.screws) for joint in model.joints)])
    away = joints_away(((j.parent, j.child) for j in model.joints), model.base)
    joints, order = list[PosedJoint](), list[NDArray[np.intp]]()
    for number in sorted(range(len(model.joints)), key=lambda k: model.joints[k].name):
        joint = model.joints[number]
        rows = np.arange(len(joint.screws))
        ends = joint.parent, joint.child
        first = min(ends, key=lambda body: (away.get(body, 0), body))
        if first != joint.parent and (len(rows) <= TURNABLE or joint.ball):
            ends = joint.child, joint.parent
            rows = rows if joint.ball else rows[::-1]
        labels = tuple(joint.labels[row] for row in rows)
        joints.append(
            PosedJoint(joint.name, *ends, joint.screws[rows], joint.ball, labels)
        )
        order.append(starts[number] + rows)
    return joints, np.concatenate([np.zeros(0, dtype=np.intp), *order])


def _own_axes(joints: Sequence[PosedJoint]) -> Array:
    """Right-handed axes as rows: by the places of joints, then by directions."""
    axes: list[Array] = []
    for vector in _vectors(joints):
        across = vector - sum((axis * (axis @ vector) for axis in axes), np.zeros(3))
        size = np.linalg.norm(across)
        if size > VISIBLE:
            axes.append(across / size)
        if len(axes) == 2:
            break
    while len(axes) < 2:
        unit = np.eye(3)[np.argmin(np.abs(axes[0]))] if axes else np.eye(3)[0]
        across = unit - sum((axis * (axis @ unit) for axis in axes), np.zeros(3))
        axes.append(across / np.linalg.norm(across))
    return np.array([*axes, np.cross(axes[0], axes[1])])


def _vectors(joints: Sequence[PosedJoint]) -> Iterator[Array]:
    """Vectors that turn with the mechanism, those with a sign of their own first."""
    for joint in joints:
        if joint.ball:
            yield _centre(joint.screws[:3])
            continue
        for screw in joint.screws:
            yield np.cross(screw[:3], screw[3:])
    for joint in joints:
        if not joint.ball:
            for screw in joint.screws:
                yield screw[:3] if screw[:3].any() else screw[3:]


def _centre(ball: Array) -> Array:
    """Of a ball's three screws, shape batch + (3, 6)."""
    feet = cross(ball[..., :3], ball[..., 3:])
    return np.asarray(0.5 * feet.sum(axis=-2))


def _set_upright(ball: Array) -> None:
    """A ball's three screws along x, y and z through its centre, in place."""
    centre = _centre(ball)
    ball[..., :3] = np.eye(3)
    ball[..., 3:] = cross(centre[..., None, :], np.eye(3))


def _turned(rotation: Array, screws: Array) -> Array:
    halves = screws[..., :3] @ rotation.T, screws[..., 3:] @ rotation.T
    return np.concatenate(halves, axis=-1)


def _sign(screw: Array) -> float:
    """That of the first coordinate of a direction that counts."""
    along = screw[:3] if screw[:3].any() else screw[3:]
    leading = along[np.abs(along) > VISIBLE]
    return -1.0 if len(leading) and leading[0] < 0 else 1.0
