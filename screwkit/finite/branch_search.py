"""Where the finite motions through a posture lead: starts that leave it.

Starts leave the posture in directions of its kernel, at random and aimed at branches
on which some joints rest or the platform does, and are corrected until the loops
close.  Those that return to the posture tell of directions that lead nowhere.

References: [Mueller2016] on the kinematic tangent cone, [Zlatanov2002].
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import (
    Stance,
    body_jacobian,
)
from screwkit.finite.local_dimension import Kernel, kernels, unit_rows
from screwkit.finite.loop_split import Split
from screwkit.finite.projection import projected
from screwkit.finite.spanning_forest import Forest
from screwkit.finite.tangent_cone import second_order_directions

NEAREST, FARTHEST = 0.08, 0.25
"""How far starts leave the posture, in coordinates."""

STRIDE, STRIDES = 0.06, 12
"""Length of a step on a branch, and how many lead to where ranks are clear."""

COLLAPSED = 0.2
"""A start that keeps less than this part of its way has returned to the posture."""


@dataclass(frozen=True, eq=False)
class Starts:
    """What became of the starts.

    Attributes:
        stance: The closed postures away from where they started.
        tangents: The direction in which the way to each leaves the posture, shape
            (postures, freedoms), unit vectors; meant for branches of one dimension.
        collapsed: How many returned to the posture.
        failed: How many did not close.
        count: How many there were.
    """

    count: int
    stance: Stance
    tangents: Array
    collapsed: int
    failed: int


def starts(
    forest: Forest,
    origin: Stance,
    kernel: Kernel,
    count: int,
    random: np.random.Generator,
) -> Starts:
    """Leave a posture in many directions and close the loops.

    Args:
        forest: Of the mechanism, scaled.
        origin: One closed posture.
        kernel: Of that posture.
        count: How many starts at random; as many at most are aimed at directions in
            which the loops stay closed to second order.
        random: Chooses directions and distances.
    """
    directions = start_directions(forest, origin, kernel, count, random)
    aimed = second_order_directions(forest, origin, kernel, count, random)
    directions = np.concatenate([directions, aimed])
    count = len(directions)
    distances = random.uniform(NEAREST, FARTHEST, count)
    step = directions * distances[:, None]
    ambient = 0.3 * distances[:, None] * unit_rows(random.standard_normal(step.shape))
    ambient[np.arange(count) % 3 != 2] = 0.0
    ambient[count - len(aimed) :] = 0.0
    same = np.zeros(count, dtype=np.intp)
    split = kernel.split.take(same)
    found = projected(forest, origin.take(same), step + ambient, split)
    way = np.linalg.norm(found.travelled, axis=1)
    home = (way < COLLAPSED * distances) & (found.largest < 1e-6)
    away = found.closed & ~home
    stance, split = found.stance.take(away), split.take(np.flatnonzero(away))
    ways = found.travelled[away]
    tangents = _tangents(forest, origin, split, ways)
    for _ in range(4):
        stance, ways = _outward(forest, stance, split, ways, random)
    stance = _cleared(forest, stance, split, ways)
    failed = int((~home & ~found.closed).sum())
    return Starts(count, stance, tangents, int(home.sum()), failed)


def start_directions(
    forest: Forest,
    origin: Stance,
    kernel: Kernel,
    count: int,
    random: np.random.Generator,
) -> Array:
    """Unit vectors of the kernel, shape (count, freedoms).

    In turn at random, with random freedoms at rest, and with the platform not
    turning, not shifting, or at rest; branches are often found there.
    """
    twists = body_jacobian(forest, origin, forest.platform[1])[0] @ kernel.basis
    held = (twists[:3], twists[3:], twists)
    directions = []
    for number in range(count):
        coordinates = random.standard_normal(kernel.dimension)
        conditions = np.zeros((0, kernel.dimension))
        if number % 3 == 1 and kernel.dimension > 1:
            rest = random.permutation(len(kernel.basis))
            conditions = kernel.basis[rest[: random.integers(1, kernel.dimension)]]
        elif number % 6 == 2:
            conditions = held[number // 6 % 3]
        free = _null_space(conditions)
        coordinates = free @ (free.T @ coordinates) if free.size else coordinates
        direction = kernel.basis @ coordinates
        directions.append(direction / np.linalg.norm(direction))
    return np.array(directions)


def _null_space(conditions: Array) -> Array:
    if not len(conditions):
        return np.eye(conditions.shape[1])
    _, values, right = np.linalg.svd(conditions)
    rank = int((values > 1e-9 * max(1.0, values[0])).sum())
    return np.asarray(right[rank:].T)


def _tangents(forest: Forest, origin: Stance, split: Split, ways: Array) -> Array:
    """Where branches leave the posture, from the ways to points on them.

    A point nearer to the posture on the same branch gives a better direction.
    """
    start = origin.take(np.zeros(len(ways), dtype=np.intp))
    for distance in (0.05, 0.01):
        if len(ways):
            step = distance * unit_rows(ways)
            ways = projected(forest, start, step, split).travelled
    return unit_rows(ways) if len(ways) else ways


def wandered(
    forest: Forest, stance: Stance, split: Split, random: np.random.Generator
) -> Stance:
    """Every posture after one random step on its branch; those that fail stay."""
    still = np.zeros(stance.screws.shape[:2])
    return _outward(forest, stance, split, still, random)[0]


def _outward(
    forest: Forest,
    stance: Stance,
    split: Split,
    ways: Array,
    random: np.random.Generator,
) -> tuple[Stance, Array]:
    """One random step on, not back along the ways that led there, and the new ways."""
    if not len(stance):
        return stance, ways
    steps = np.zeros_like(ways)
    for number, kernel in enumerate(kernels(forest, stance, split)):
        if kernel.dimension:
            step = kernel.anywhere(1, random)[0]
            sign = -1.0 if step @ ways[number] < 0 else 1.0
            steps[number] = sign * STRIDE * step / np.linalg.norm(step)
    found = projected(forest, stance, steps, split)
    moved = found.closed[:, None] * found.travelled
    onward = stance.put(found.closed, found.stance.take(found.closed))
    return onward, ways + moved


def _cleared(forest: Forest, stance: Stance, split: Split, ways: Array) -> Stance:
    """Postures of unclear rank led on along their ways, until it is clear.

    Where branches touch to a high order, equations that tell them apart grow slowly
    with the distance, and a start may have slid back to where they are within rounding.
    """
    stance, ways = stance.take(np.arange(len(stance))), ways.copy()
    left = np.arange(len(stance))
    for _ in range(STRIDES):
        if not len(left):
            break
        own = kernels(forest, stance.take(left), split.take(left))
        left = left[[not kernel.is_clear for kernel in own]]
        if not len(left):
            break
        steps = STRIDE * unit_rows(ways[left])
        found = projected(forest, stance.take(left), steps, split.take(left))
        good = found.closed
        stance = stance.put(left[good], found.stance.take(good))
        ways[left[good]] += found.travelled[good]
        left = left[good]
    return stance
