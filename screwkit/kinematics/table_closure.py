"""Closed postures of tables that place a body twice.

Such a table ties joint variables together; whether they are closed at 0 is looked at
first, then a posture is searched by nonlinear least squares, from 0 and from random
postures.  The frames of the body by both ways must agree.

References: [KhalilKleinfinger1986] (closed chains).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.kinematics.loops import ring_at
from screwkit.kinematics.placement import (
    parent_from_joint,
    placed_links,
    table_joints,
)
from screwkit.mechanism.model import MdhRow, Mechanism

CLOSED = 1e-10
"""Largest miss of a closed posture, in radians and in parts of the largest length."""

STARTS = 24
"""Random postures from which a closed one is searched."""


@dataclass(frozen=True)
class TableClosure:
    """A posture of a table.

    Attributes:
        values: By joint variable, in radians and file lengths.
        miss: The largest difference of the two places of a body, relative.
        joint: The row that misses most; empty where all agree.
        at_zero: Whether the joint variables are 0.
    """

    values: Mapping[str, float]
    miss: float
    joint: str
    at_zero: bool

    @property
    def closed(self) -> bool:
        """Whether every body is where all its rows put it."""
        return self.miss <= CLOSED


def table_closure(
    mechanism: Mechanism, guess: Mapping[str, float] | None = None
) -> TableClosure:
    """The posture at 0 if it is closed, else the nearest closed one that is found.

    Args:
        mechanism: An ``mdh`` mechanism whose symbols all have values.
        guess: Values of joint variables to begin with, and to keep.

    Raises:
        UnknownNameError: If a symbol has no value.
    """
    from scipy.optimize import least_squares  # noqa: PLC0415

    kept = dict(guess or {})
    names = [n for n in mechanism.joint_variables if n not in kept]
    length = _length(mechanism)

    def values(free: Array) -> dict[str, float]:
        return kept | dict(zip(names, map(float, free), strict=True))

    def misses(free: Array) -> Array:
        return np.concatenate([m for _, m in _misses(mechanism, values(free), length)])

    def report(free: Array) -> TableClosure:
        found = [
            (float(abs(m).max()), name)
            for name, m in _misses(mechanism, values(free), length)
        ]
        miss, joint = max(found)
        at_zero = not any(values(free).values())
        return TableClosure(values(free), miss, joint if miss > CLOSED else "", at_zero)

    origin = np.zeros(len(names))
    best = report(origin)
    random = np.random.default_rng(0)
    for number in range(STARTS + 1):
        if best.closed or not names:
            break
        start = origin if number == 0 else random.uniform(-np.pi, np.pi, len(names))
        solution = least_squares(misses, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        trial = report(solution.x)
        best = min(best, trial, key=lambda found: found.miss)
    return best


def _misses(
    mechanism: Mechanism, values: Mapping[str, float], length: float
) -> list[tuple[str, Array]]:
    """Each row's own place of its child less the child's place, rotation and shift."""
    ring = ring_at(mechanism, values)
    placed = placed_links(mechanism, ring, mechanism.base)
    found = []
    for joint in table_joints(mechanism):
        if joint.parent not in placed or joint.child not in placed:
            continue
        step = parent_from_joint(joint, joint.mdh or MdhRow(), ring)
        here, there = placed[joint.parent].then(step, ring), placed[joint.child]
        turned = [
            float(a - b)
            for one, other in zip(here.rotation, there.rotation, strict=True)
            for a, b in zip(one, other, strict=True)
        ]
        shifted = [
            float(a - b) / length
            for a, b in zip(here.translation, there.translation, strict=True)
        ]
        found.append((joint.name, np.array([*turned, *shifted])))
    return found


def _length(mechanism: Mechanism) -> float:
    """The largest distance of a body's origin from that of the base, at 0."""
    zeros = dict.fromkeys(mechanism.joint_variables, 0.0)
    placed = placed_links(mechanism, ring_at(mechanism, zeros), mechanism.base)
    distances = [
        float(np.linalg.norm([float(x) for x in place.translation]))
        for place in placed.values()
    ]
    return max([d for d in distances if d > 0], default=1.0)
