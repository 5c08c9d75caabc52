"""The nearest point of a set from many starts, and the way there.

Starts lie around the posture, nearer ones and farther ones, the same every time.  What
is found is the nearest of what they lead to: no proof that nothing is nearer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.metrics.nearest_point import (
    Batched,
    Problem,
    nearest_from,
    restored,
    slopes,
    split_of,
)

STARTS: Final = 16
"""From how many postures the nearest one is looked for."""

CLOSER: Final = 4
"""Starts in a second round, nearer than what the first has found."""

NEAREST: Final = 0.2
FARTHEST: Final = 5.0
"""How far from the posture starts lie, in radians and lengths over the length, along
the coordinates of the search; joints have many."""

LONG_STRIDE: Final = 0.4
"""Largest step on the way to a start."""

STRIDE: Final = 0.1
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
    away: Batched
    kept: Batched
    tied: bool

    def distance(self, point: Array) -> float:
        """From the posture to a point."""
        return float(np.linalg.norm(self.away(point[None])[0]))


@dataclass(frozen=True, eq=False)
class Found:
    """A point and how far it is.

    Attributes:
        connected: Whether a way on the motion was followed to it.
    """

    point: Array
    distance: float
    connected: bool


def starts_of(space: Space, count: int = STARTS) -> list[Array]:
    """The posture itself and postures on the motion around it."""
    random = np.random.default_rng(1)
    found = [space.start]
    for radius in np.geomspace(NEAREST, FARTHEST, count - 1):
        way = random.normal(size=len(space.start))
        if space.tied:
            found.append(_walked(space, way, float(radius)))
        else:
            found.append(space.start + radius * way / np.linalg.norm(way))
    return found


def _walked(space: Space, way: Array, length: float) -> Array:
    """Where steps on the motion lead that keep to a direction as far as they can."""
    point, left = space.start, length
    while left > 0:
        along = split_of(slopes(space.kept, point[None])[0])[1]
        heading = along @ (along.T @ way)
        size = float(np.linalg.norm(heading))
        if size < 1e-9:
            break
        stride = min(left, LONG_STRIDE)
        moved = restored(space.kept, point + stride / size * heading, 12)
        if moved is None:
            break
        # The motion may bend: the heading is carried along, not the first direction.
        way, point = way - heading + (moved - point) * (size / stride), moved
        left -= stride
    return point


def nearest(
    space: Space,
    equations_from: Callable[[Array], Batched],
    starts: Sequence[Array],
) -> list[Found]:
    """The nearest points where equations hold, nearest first, each once.

    Args:
        space: Where.
        equations_from: What vanishes besides, shape (batch, n) to (batch, k); may be
            written otherwise from another start.
        starts: Points to start from.
    """
    points: list[Array] = []

    def look(start: Array) -> None:
        with np.errstate(all="ignore"):
            problem = Problem(space.away, on_motion(space, equations_from(start)))
            point = nearest_from(problem, start)
        if point is not None and not _known(point, points):
            points.append(point)

    for start in starts:
        look(start)
    for start in _closer(space, points):
        look(start)
    points.sort(key=space.distance)
    return [Found(p, space.distance(p), connected=not space.tied) for p in points]


def _closer(space: Space, points: Sequence[Array]) -> list[Array]:
    """More starts: between the posture and the nearest point that was found so far."""
    if not points:
        return []
    best = min(points, key=space.distance)
    random = np.random.default_rng(3)
    found = []
    for part in np.linspace(0.2, 0.9, CLOSER):
        way = random.normal(size=len(best))
        aside = 0.5 * space.distance(best) * way / np.linalg.norm(way)
        point = space.start + part * (best - space.start) + aside
        moved = restored(space.kept, point) if space.tied else point
        if moved is not None:
            found.append(moved)
    return found


def on_motion(space: Space, equations: Batched) -> Batched:
    """The equations and those of the motion."""
    if not space.tied:
        return equations
    return lambda x: np.concatenate([space.kept(x), equations(x)], axis=-1)


def _known(point: Array, points: Sequence[Array]) -> bool:
    return any(np.abs(point - other).max(initial=0.0) < 1e-6 for other in points)


def nearest_connected(space: Space, found: Sequence[Found]) -> Found | None:
    """The nearest point to which a way leads; the nearest of all where none does."""
    for one in found:
        if one.connected or followed(space, one.point):
            return Found(one.point, one.distance, connected=True)
    return found[0] if found else None


def followed(space: Space, goal: Array) -> bool:
    """Whether steps on the motion lead from the posture to a point.

    A motion of one freedom is followed both ways round, others towards the goal.
    """
    return any(_followed(space, goal, sign) for sign in (1.0, -1.0))


def _followed(space: Space, goal: Array, sign: float) -> bool:
    point, heading = space.start, None
    for _ in range(LONGEST_WAY):
        left = goal - point
        if np.abs(left).max() < ARRIVED:
            return True
        along = split_of(slopes(space.kept, point[None])[0])[1]
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
        moved = restored(space.kept, point + step, 12)
        if moved is not None:
            change = np.linalg.norm(moved - point - step)
            if change <= 0.5 * np.linalg.norm(step):
                return moved
        step = step / 2
    return None
