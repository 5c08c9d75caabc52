"""Ball joints without the spin of the rod that they carry.

A ball with one freedom held is a universal joint.  Its axes stand across the rod, for
any other pair comes near to its own dead point as the rod turns, and would be one of
the file's frame.

References: [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.idle_freedoms import IdleMotion
from screwkit.finite.posture_model import PosedJoint, PostureModel, with_locked


def without_idle(model: PostureModel, idle: Sequence[IdleMotion]) -> PostureModel:
    """The model with idle motions held.

    Args:
        model: In a frame of its own.
        idle: What to hold; of a ball with one label held it is the spin about the rod
            that is, not that freedom.

    Raises:
        UnknownNameError: If a label is no freedom of the model.
    """
    joints = {joint.name: joint for joint in model.joints}
    for each in idle:
        first, second = (joints[name] for name in each.joints)
        if first.ball and len(first.screws) == 3 and len(each.held) == 1:
            joints[first.name] = _spinning(first, second, each.held[0])
    turned = replace(model, joints=tuple(joints[j.name] for j in model.joints))
    return with_locked(turned, [label for each in idle for label in each.held])


def _spinning(ball: PosedJoint, other: PosedJoint, label: str) -> PosedJoint:
    """The ball with a freedom along the screw it shares with another joint."""
    shared = np.linalg.svd(np.concatenate([ball.screws, other.screws]).T)[2][-1, :3]
    spin = shared / np.linalg.norm(shared)
    # Axes of the frame, each without what it has of the ones before.
    rows: list[Array] = [spin]
    for unit in np.eye(3)[np.argsort(np.abs(spin) > _SLANTED, kind="stable")]:
        across = unit - sum((row * (row @ unit) for row in rows), np.zeros(3))
        if len(rows) < 3 and np.linalg.norm(across) > _ACROSS:
            rows.append(across / np.linalg.norm(across))
    screws = np.array(rows[1:]) @ ball.screws
    place = ball.labels.index(label)
    screws = np.insert(screws, place, spin @ ball.screws, axis=0)
    return replace(ball, screws=screws)


_SLANTED = 0.7
"""Cosine from which on a direction is left for last."""

_ACROSS = 0.1
