"""Ways on a mechanism's motion: many in random directions, and one to a given point.

The directions are the same every time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.metrics.nearest_point import MENDING, mended, restored, split_of
from screwkit.metrics.smooth import Smooth

NEAREST: Final = 0.2
FARTHEST: Final = 5.0
"""How long ways are, in radians and lengths over the length, along the coordinates of
the search; joints have many."""

LONG_STRIDE: Final = 0.4
"""Largest step on a way in a random direction."""

STRIDES: Final = 8
"""Steps of a way, where they are not longer than that."""

STRIDE: Final = 0.2
"""Largest step on the way to a posture."""

LONGEST_WAY: Final = 400
"""Steps of a way."""

ARRIVED: Final = 1e-5
"""Distance at which a way has come to its end; its equations may have a double root."""


@dataclass(frozen=True, eq=False)
class Space:
    """Where the nearest point is looked for.

    Attributes:
        start: The posture, shape (n,).
        away: What the distance from it is the norm of.
        kept: What vanishes on the mechanism's motion.
        tied: Whether anything has to vanish.
    """

    start: Array
    away: Smooth
    kept: Smooth
    tied: bool

    def distance(self, point: Array) -> float:
        """From the posture to a point."""
        return float(self.distances(point[None])[0])

    def distances(self, points: Array) -> Array:
        """From the posture to points, shape (batch, n) to (batch,)."""
        return np.asarray(np.linalg.norm(self.away.values(points), axis=1))


def ways_from(space: Space, count: int, seed: int) -> Array:
    """Points on ways of different lengths in random directions.

    Args:
        space: Where.
        count: How many ways.
        seed: Of the directions.

    Returns:
        Shape (count, steps, n); nan behind the end of a way, the start left out.
    """
    random = np.random.default_rng(seed)
    headings = random.normal(size=(count, len(space.start)))
    lengths = np.geomspace(NEAREST, FARTHEST, count)
    strides = np.minimum(LONG_STRIDE, lengths / STRIDES)
    steps = np.ceil(lengths / strides - 1e-9).astype(int)
    if space.tied:
        return _walked(space, headings, strides, steps)
    headings /= np.linalg.norm(headings, axis=1, keepdims=True)
    numbers = np.arange(1, steps.max() + 1)
    along = np.where(numbers <= steps[:, None], numbers * strides[:, None], np.nan)
    return space.start + along[..., None] * headings[:, None]


def _walked(space: Space, ways: Array, strides: Array, steps: Array) -> Array:
    """Where steps on the motion lead that keep to directions as far as they can."""
    count, n = ways.shape
    found = np.full((count, steps.max(), n), np.nan)
    points = np.broadcast_to(space.start, (count, n)).copy()
    active = np.arange(count)
    for step in range(steps.max()):
        change = space.kept.slopes(points[active])
        way = ways[active]
        heading = way - mended(change, (change @ way[..., None])[..., 0])
        size = np.linalg.norm(heading, axis=1)
        going = size > 1e-9
        active, way, heading = active[going], way[going], heading[going]
        if not active.size:
            break
        stride = (strides[active] / size[going])[:, None]
        before = points[active]
        moved = restored(space.kept, before + stride * heading, MENDING)
        # The motion may bend: the heading is carried along, not the first direction.
        ways[active] = way - heading + (moved - before) / stride
        found[active, step] = points[active] = moved
        arrived = np.isfinite(moved).all(axis=1)
        active = active[arrived & (steps[active] > step + 1)]
        if not active.size:
            break
    return found


def followed(space: Space, goal: Array, begin: Array | None = None) -> bool:
    """Whether steps on the motion lead to a point.

    A motion of one freedom is followed both ways round, others towards the goal.

    Args:
        space: Where.
        goal: Shape (n,).
        begin: A point on the motion; the posture itself where None.
    """
    first = space.start if begin is None else begin
    return any(_followed(space, first, goal, sign) for sign in (1.0, -1.0))


def _followed(space: Space, begin: Array, goal: Array, sign: float) -> bool:
    point, heading = begin, None
    for _ in range(LONGEST_WAY):
        left = goal - point
        if np.abs(left).max() < ARRIVED:
            return True
        along = split_of(space.kept.slopes(point[None])[0])[1]
        if not along.shape[1]:
            return False
        step = along @ (along.T @ left)
        close = np.linalg.norm(left) < STRIDE
        if along.shape[1] == 1 and not close:
            turn = along[:, 0]
            ahead = sign * left if heading is None else heading
            step = turn * (STRIDE if turn @ ahead >= 0 else -STRIDE)
        elif sign < 0:
            return False
        size = float(np.linalg.norm(step))
        if size < ARRIVED / 10:
            return False
        moved = _moved(space, point, step * min(1.0, STRIDE / size))
        if moved is None:
            return False
        heading, point = moved - point, moved
    return False


def _moved(space: Space, point: Array, step: Array) -> Array | None:
    """One step on the motion, shorter where the way bends."""
    for _ in range(6):
        moved = restored(space.kept, (point + step)[None], MENDING)[0]
        # Comparisons with nan, where none was come to, are false.
        if np.linalg.norm(moved - point - step) <= 0.5 * np.linalg.norm(step):
            return np.asarray(moved)
        step = step / 2
    return None
