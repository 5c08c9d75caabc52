"""Back to closed loops after a step: Newton's method that does not slide along.

Near a posture where branches meet, and on a linkage that is shaky wherever it stands,
the loop Jacobian has singular values that are small because the point is not yet on
the branch.  A full Newton step divides by them and runs off along the curve; here they
are left out at first and let in only when the rest of the error is gone.

References: [Deuflhard2004] §4.4 on rank-deficient systems.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import Stance, misses, moved
from screwkit.finite.loop_split import Split, largest_miss, reduced
from screwkit.finite.spanning_forest import Forest

CLOSED = 1e-12
"""Largest miss of closed loops: radians, and lengths over the mechanism's own."""

POLISHED = 1e-15
"""Down to which closing goes on as long as it gains; a double root needs it."""

SLOWEST = 0.9
"""A step that leaves more than this part of a miss has no use."""

LONGEST_STEP = 0.5
"""Largest change of a coordinate in one step."""

STAGES = ((3e-3, 25), (1e-5, 25), (1e-8, 25))
"""Relative cut-off of the singular values, and the steps taken with it at most."""


@dataclass(frozen=True, eq=False)
class Projected:
    """What came of closing loops; where `closed` is false `stance` is no posture.

    Attributes:
        travelled: Sum of the steps, shape (batch, freedoms).
        closed: Shape (batch,).
        largest: The largest miss, shape (batch,).
    """

    stance: Stance
    travelled: Array
    closed: NDArray[np.bool_]
    largest: Array


def projected(
    forest: Forest,
    start: Stance,
    step: Array,
    split: Split,
    stages: tuple[tuple[float, int], ...] = STAGES,
) -> Projected:
    """Step, then close the loops by truncated Newton steps.

    Args:
        forest: Of the mechanism, scaled.
        start: Where the step starts.
        step: Of every coordinate, shape (batch, freedoms).
        split: Of the equations near each start, at a rank that all of them have.
        stages: See `STAGES`.
    """
    stance, travelled = moved(forest, start, step), step.copy()
    largest = largest_miss(stance)
    for cut, steps in stages:
        left = np.flatnonzero(largest > (POLISHED if cut == stages[0][0] else CLOSED))
        for _ in range(steps):
            if not len(left):
                break
            part = stance.take(left)
            parts = reduced(forest, part, split.take(left))
            change = clipped(parts.step(misses(part), cut))
            part = moved(forest, part, change)
            sizes = largest_miss(part)
            better = sizes < SLOWEST * largest[left]
            kept = better | (largest[left] > CLOSED)
            stance = stance.put(left[kept], part.take(kept))
            travelled[left[kept]] += change[kept]
            largest[left[kept]] = sizes[kept]
            left = left[better & (sizes > POLISHED)]
    return Projected(stance, travelled, largest <= CLOSED, largest)


def projected_at_rank(
    forest: Forest,
    start: Stance,
    step: Array,
    split: Split,
    tolerance: float = CLOSED,
    steps: int = 12,
) -> Projected:
    """Step, then close as many equations as the split's rank says there are.

    The chord method with the inverse at the start, and Newton's method where that is
    slow.  What is left is by how much the *other* loop equations fail: nothing
    wherever the rank stays constant along the branch.

    Args:
        forest: Of the mechanism, scaled.
        start: Closed postures.
        step: Of every coordinate, shape (batch, freedoms).
        split: At the rank of J_c at each start.
        tolerance: Largest miss of a closed posture.
        steps: Bound on the steps, half of them with new inverses.
    """
    stance, travelled = moved(forest, start, step), step.copy()
    left = np.arange(len(stance) if split.rank else 0)
    parts = reduced(forest, start, split)
    for number in range(steps):
        if not len(left):
            break
        part = stance.take(left)
        if number >= steps // 2:
            parts = reduced(forest, part, split.take(left))
        change = clipped(parts.step_at_rank(misses(part)))
        stance = stance.put(left, moved(forest, part, change))
        travelled[left] += change
        moving = np.abs(change).max(axis=-1) > 1e-13
        parts = parts.take(moving)
        left = left[moving]
    largest = largest_miss(stance)
    return Projected(stance, travelled, largest <= tolerance, largest)


def clipped(change: Array) -> Array:
    """No coordinate changes by more than `LONGEST_STEP`."""
    longest = np.abs(change).max(axis=-1, keepdims=True, initial=0.0)
    return np.asarray(change * (LONGEST_STEP / np.maximum(longest, LONGEST_STEP)))
