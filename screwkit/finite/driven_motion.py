"""Motions from a closed posture: to given values of some freedoms, or ever onward.

Both go in steps along the branch of closed postures itself, not along a freedom, so
that nothing is special about a dead point but that the driven freedom turns back there.
Steps are halved until they keep to the branch; where that does not help, the motion
ends, and says at which posture and why.

References: [AllgowerGeorg2003] ch. 2 and 8 on continuation.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.errors import UnfitValueError
from screwkit.finite.branch_steps import (
    Posed,
    Verdict,
    passes_branch_point,
    posed,
    stepped,
)
from screwkit.finite.exponentials import moved, stance_of
from screwkit.finite.loop_closure import (
    ClosedMotion,
    Scene,
    State,
    Stop,
    report,
    scene_of,
)
from screwkit.finite.posture_model import PostureModel

STRIDE = 0.1
"""Largest change of a coordinate in one step along a motion."""

SHORTEST = 1e-9
"""Steps below this mean that the motion has ended."""

LEVEL, CREST = 1e-10, 1e-5
"""Slopes of the driven freedoms along the branch: below the first they are held, below
the second a motion may end on either side of its dead point."""

MOST = 10_000
"""Postures after which a motion that hardly rises counts as ended."""

FURTHEST = 100.0
"""Largest target, in radians or in lengths of the mechanism's own."""


@dataclass(frozen=True, eq=False)
class _Climb:
    """Where a motion along a branch has come to.

    Attributes:
        here: The last posture that is surely on the branch.
        tried: The last attempt.
        verdict: On that attempt.
        length: Of the next step.
    """

    here: Posed
    tried: Posed
    verdict: Verdict | Literal["level", "back"]
    length: float


def moved_to(model: PostureModel, targets: Mapping[str, float]) -> ClosedMotion:
    """Move some freedoms to given values; the loops take the others along.

    The driven freedoms keep to the straight line between their values.

    Args:
        model: At a closed posture, where all coordinates are 0.
        targets: Values by freedom, in radians and file lengths.

    Returns:
        The postures on the way, the start first.

    Raises:
        UnknownNameError: If a target is no freedom.
        UnfitValueError: If a target is too far away to be followed there.
    """
    scene = scene_of(model, targets)
    chosen = [model.index(label) for label in targets]
    ends = np.array([float(value) for value in targets.values()]) / scene.units[chosen]
    origin = stance_of(scene.model, scene.forest)
    start = np.zeros(len(scene.units))
    labels = tuple(targets)
    if not scene.forest.closing_joints:
        step = start.copy()
        step[chosen] = ends
        there = State(moved(scene.forest, origin, step[None]), step)
        return report(scene, [State(origin, start), there], there, 1.0)
    _refuse_far(targets, ends)
    total = float(np.linalg.norm(ends))
    basis = _along(len(start), chosen, ends)
    here = posed(scene.forest, origin, start, basis)
    if not total:
        return _told(scene, [here], here, 1.0, "", labels)
    up = np.zeros(basis.shape[1])
    up[-1] = 1.0
    postures, climb = [here], _Climb(here, here, "good", STRIDE)
    while (left := total - float(climb.here.sums @ basis @ up)) > 1e-13 * total:
        slope = climb.here.allowed(up)
        if np.linalg.norm(slope) < LEVEL or len(postures) > MOST:
            climb = _Climb(climb.here, climb.here, "level", climb.length)
            break
        climb = _climbed(scene, climb, slope, up, left)
        if climb.length < SHORTEST:
            break
        if climb.verdict == "good":
            postures.append(climb.here)
    share = 1.0 - max(left, 0.0) / total
    if left <= 1e-13 * total:
        return _told(scene, postures, climb.here, 1.0, "", labels)
    if climb.verdict == "open":
        return _told(scene, postures, climb.tried, share, "", labels)
    return _told(scene, postures, climb.here, share, _why(climb, len(postures)), labels)


def followed(
    model: PostureModel,
    heading: Mapping[str, float],
    steps: int = 40,
    stride: float = STRIDE,
) -> ClosedMotion:
    """Follow a motion from a closed posture along the branch it is on.

    Where the mechanism has several freedoms, the motion keeps its direction as well as
    the loops allow.

    Args:
        model: At a closed posture.
        heading: Rates of some freedoms that the motion is to begin with; it begins with
            the rates nearest to them that the loops allow.
        steps: How many steps to take.
        stride: Largest change of a coordinate in a step.

    Raises:
        UnknownNameError: If ``heading`` names no freedom.
        ValueError: If the loops allow none of the rates.
    """
    scene = scene_of(model)
    wanted = np.zeros(len(scene.units))
    for label, rate in heading.items():
        wanted[model.index(label)] = rate
    wanted /= scene.units
    origin, basis = stance_of(scene.model, scene.forest), np.eye(len(wanted))
    here = posed(scene.forest, origin, np.zeros(len(wanted)), basis)
    ahead = here.allowed(wanted)
    if np.linalg.norm(ahead) <= LEVEL * np.linalg.norm(wanted):
        raise ValueError("the loops allow none of the rates asked for")
    postures, labels = [here], tuple(heading)
    for number in range(steps):
        there, ahead, tried, verdict = _onward(scene, here, ahead, stride)
        if verdict != "good":
            share = number / steps
            stop: Stop = "" if verdict == "open" else "branches"
            last = tried if verdict == "open" else here
            return _told(scene, postures, last, share, stop, labels)
        here = there
        postures.append(here)
    return _told(scene, postures, here, 1.0, "", labels)


def _climbed(
    scene: Scene, climb: _Climb, slope: Array, up: Array, left: float
) -> _Climb:
    """One step up the slope, or with half the length where it leaves the branch."""
    step = slope * (climb.length / np.abs(climb.here.basis @ slope).max())
    rise = float(step @ up)
    ends_here = rise >= left
    if ends_here:
        step = step * (left / rise)
        step += up * (left - step @ up)
    there, verdict = _kept(scene, climb.here, step, up if ends_here else None)
    length = float(np.abs(climb.here.basis @ step).max())
    if verdict == "good" or (ends_here and verdict == "rank"):
        onward = there.allowed(up)
        level = ends_here and np.linalg.norm(onward) < CREST
        if level or onward @ slope > 0 or there.rank != climb.here.rank:
            return _Climb(there, there, "good", min(2 * length, STRIDE))
        return _Climb(climb.here, there, "back", length / 2)
    return _Climb(climb.here, there, verdict, length / 2)


def _onward(
    scene: Scene, here: Posed, ahead: Array, stride: float
) -> tuple[Posed, Array, Posed, Verdict]:
    """A stride along the branch, in as many steps as that takes."""
    made, length, tried = 0.0, stride, here
    verdict: Verdict = "good"
    while made < stride * (1 - 1e-9):
        length = min(length, stride - made)
        step = ahead * (length / np.abs(here.basis @ ahead).max())
        tried, verdict = _kept(scene, here, step, None)
        if verdict == "good":
            made += length
            ahead = tried.allowed(here.basis.T @ (tried.sums - here.sums))
            here, length = tried, 2 * length
        else:
            length /= 2
        if length < SHORTEST or not np.linalg.norm(ahead):
            break
    return here, ahead, tried, verdict


def _kept(
    scene: Scene, here: Posed, step: Array, held: Array | None
) -> tuple[Posed, Verdict]:
    """A step, good also where it passes straight through a branch point."""
    there, verdict = stepped(scene.forest, here, step, held)
    if verdict == "crossed" and passes_branch_point(here, there):
        return there, "good"
    return there, verdict


def _why(climb: _Climb, postures: int) -> Stop:
    """Why a motion ended at closed loops."""
    if climb.verdict not in {"level", "back"}:
        return "branches"
    return "turns" if postures > 1 else "held"


def _refuse_far(targets: Mapping[str, float], ends: Array) -> None:
    for (label, value), end in zip(targets.items(), ends, strict=True):
        if abs(end) > FURTHEST:
            raise UnfitValueError(
                f"{label} would move by {value:.6g}, too far to be followed step by "
                f"step: up to {FURTHEST:g} radians or lengths of the mechanism's own "
                f"size are; reduce angles modulo 2*pi"
            )


def _along(count: int, chosen: Sequence[int], ends: Array) -> Array:
    """All other freedoms, and last the line on which the driven ones move."""
    free = [number for number in range(count) if number not in set(chosen)]
    line = np.zeros((count, 1))
    line[chosen, 0] = ends / (np.linalg.norm(ends) or 1.0)
    return np.concatenate([np.eye(count)[:, free], line], axis=1)


def _told(
    scene: Scene,
    postures: Sequence[Posed],
    last: Posed,
    reached: float,
    stop: Stop,
    driven: tuple[str, ...],
) -> ClosedMotion:
    states = [State(place.stance, place.sums) for place in postures]
    end = State(last.stance, last.sums)
    return report(scene, states, end, reached, stop, driven)
