"""The posture to which given joint variables move a mechanism with closed loops."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import atan2, isfinite

from screwkit.algebra.evaluation import cosine_sine, evaluate
from screwkit.algebra.expression import Expression
from screwkit.errors import ExpressionError
from screwkit.finite.driven_motion import moved_to
from screwkit.finite.loop_closure import ClosedMotion
from screwkit.finite.posture_model import PostureModel, posture_model
from screwkit.finite.posture_numbers import PostureNumbers, numbers_at
from screwkit.kinematics.loops import ring_at
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Mechanism

ROUNDING = 1e-13
"""Values up to which a joint variable counts as unmoved."""


@dataclass(frozen=True)
class MovedPosture:
    """Where the mechanism came to.

    Attributes:
        reason: Why the posture was not reached, or a rank is unclear; else empty.
        values: By joint variable, from the posture of the file.
        free: Ranks there.
        locked: Ranks with the declared scheme locked; None without one.
    """

    closed: bool
    reason: str
    values: Mapping[str, float]
    free: PostureNumbers
    locked: PostureNumbers | None

    @property
    def gap(self) -> float | None:
        """Of the free mechanism; None where no singular value is small."""
        return self.free.gap if isfinite(self.free.gap) else None


@dataclass(frozen=True)
class Arrival:
    """A motion to given joint variables, before anything is counted.

    Attributes:
        found: The motion, its coordinates counted from ``start``.
        start: The mechanism where the motion starts.
        before: Joint variables there, where the file counts them.
        values: By joint variable where the motion ended, from the posture of the file.
        reason: Why it ended before, in joint variables; empty where it did not.
    """

    found: ClosedMotion
    start: PostureModel
    before: Mapping[str, float]
    values: Mapping[str, float]
    reason: str


def moved_posture(
    mechanism: Mechanism,
    wanted: Mapping[str, Expression],
    start: Mapping[str, float] | None = None,
) -> MovedPosture:
    """Move joint variables from the posture of the file to given values, and count.

    Arguments and errors are those of `arrival_at`.
    """
    there = arrival_at(mechanism, wanted, start)
    found = there.found
    return _report(mechanism, found.model, found.closed, there.reason, there.values)


def arrival_at(
    mechanism: Mechanism,
    wanted: Mapping[str, Expression],
    start: Mapping[str, float] | None = None,
) -> Arrival:
    """Move joint variables from the posture of the file to given values.

    Args:
        mechanism: All its symbols with values.
        wanted: Expressions of constants and symbols by joint variable; without a table
            counted from the posture of the file.  The other joint variables follow as
            the loops demand.
        start: A closed posture of an ``mdh`` file; 0 by default.

    Raises:
        UnknownNameError: If a symbol has no value.
    """
    model, before = departure(mechanism, start)
    labels = _labels(mechanism)
    ring = ring_at(mechanism, {})
    targets = {}
    for name, expression in wanted.items():
        try:
            value = float(evaluate(expression, ring))
        except ExpressionError:  # an inverse function: an angle
            cosine, sine = cosine_sine(expression, ring)
            value = atan2(float(sine), float(cosine))
        targets[labels[name]] = value - before.get(name, 0.0)
    return arrival(mechanism, model, before, moved_to(model, targets))


def departure(
    mechanism: Mechanism, start: Mapping[str, float] | None = None
) -> tuple[PostureModel, dict[str, float]]:
    """The model where motions start, and the joint variables that a table gives it.

    Args:
        mechanism: All its symbols with values.
        start: A closed posture of an ``mdh`` file; 0 by default.
    """
    before: dict[str, float] = {}
    if mechanism.geometry == "mdh":
        before = dict.fromkeys(mechanism.joint_variables, 0.0) | dict(start or {})
    return posture_model(mechanism, before), before


def arrival(
    mechanism: Mechanism,
    model: PostureModel,
    before: Mapping[str, float],
    found: ClosedMotion,
) -> Arrival:
    """Where a motion from a departure came to, by joint variables."""
    names = {label: name for name, label in _labels(mechanism).items()}
    last = (
        found.coordinates[-1] if len(found.coordinates) else [0.0] * len(model.labels)
    )
    values = {}
    for label, change in zip(model.labels, last, strict=True):
        if label in names:
            value = float(change) + before.get(names[label], 0.0)
            values[names[label]] = 0.0 if abs(value) < ROUNDING else value

    def spelled(label: str, value: float) -> str:
        name = names[label]
        return f"{name} = {value + before.get(name, 0.0):.6g}"

    return Arrival(found, model, before, values, found.reason_in(spelled))


def _report(
    mechanism: Mechanism,
    model: PostureModel,
    closed: bool,
    reason: str,
    values: Mapping[str, float],
) -> MovedPosture:
    free = numbers_at(model)
    actuated = mechanism.actuated
    locked = numbers_at(model, actuated) if actuated else None
    if closed and not free.clear:
        reason = (
            f"where the rank is cut, singular values of the loop equations differ by a "
            f"factor of {free.gap:.0f} only"
        )
    return MovedPosture(closed, reason, values, free, locked)


def _labels(mechanism: Mechanism) -> dict[str, str]:
    """The label of each joint variable."""
    found: dict[str, str] = {}
    for joint in mechanism.joints:
        labels = freedom_labels(joint, mechanism.space)
        found |= dict(zip(joint.variables, labels, strict=False))
    return found
