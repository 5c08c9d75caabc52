"""The nearest point where equations hold: least squares under repeated equations.

Newton's method on the Lagrange conditions.  Steps are split by singular values into
the part that mends the equations and the part along them, so that equations may depend
on each other; derivatives are central differences of whole batches.

References: [NocedalWright2006] §18.1.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from screwkit.algebra.batch import Array

Batched: TypeAlias = Callable[[Array], Array]
"""From points, shape (batch, n), to values, shape (batch, k)."""

NUDGE = 1e-6
"""Step of a difference; angles and lengths over the characteristic one are near 1."""

CUT = 1e-7
"""Singular values below this part of the largest, or of 1, are no equations."""

HOLDS = 1e-11
"""Largest miss of an equation, scaled to a gradient near 1, that still holds."""

LEVEL = 1e-7
"""Largest slope of the distance along the equations at a nearest point."""

STEPS = 60

STALLED = 6
"""Steps in which a miss has to become half; a double root takes one for a quarter."""

LONGEST = 0.5
"""Largest step of Newton's method."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What is small, and what must vanish."""

    residual: Batched
    equations: Batched


def slopes(function: Batched, points: Array) -> Array:
    """Derivatives at every point, shape (batch, k, n)."""
    return values_and_slopes(function, points)[1]


def values_and_slopes(function: Batched, points: Array) -> tuple[Array, Array]:
    """Values, shape (batch, k), and derivatives, shape (batch, k, n), in one call."""
    batch, n = points.shape
    nudge = NUDGE * np.eye(n)
    ahead = (points[:, None] + nudge).reshape(-1, n)
    behind = (points[:, None] - nudge).reshape(-1, n)
    values = function(np.concatenate([points, ahead, behind]))
    forward, backward = np.split(values[batch:], 2)
    change = (forward - backward).reshape(batch, n, -1) / (2 * NUDGE)
    return values[:batch], np.swapaxes(change, 1, 2)


def split_of(matrix: Array) -> tuple[Array, Array]:
    """Pseudoinverse and an orthonormal basis of the null space, as columns."""
    if not matrix.size:
        return np.zeros((matrix.shape[1], len(matrix))), np.eye(matrix.shape[1])
    left, sizes, right = np.linalg.svd(matrix)
    rank = int((sizes > CUT * max(1.0, sizes[0])).sum())
    inverse = (right[:rank].T / sizes[:rank]) @ left[:, :rank].T
    return inverse, right[rank:].T


def restored(equations: Batched, start: Array, steps: int = 40) -> Array | None:
    """A point near ``start`` where the equations hold; None where none is come to.

    Gauss-Newton steps, shape (n,) in and out.
    """
    point, sizes = start, []
    for _ in range(steps):
        misses, slope = values_and_slopes(equations, point[None])
        miss = misses[0]
        if not (np.isfinite(miss).all() and np.isfinite(slope).all()):
            return None
        sizes.append(float(np.linalg.norm(miss)))
        if len(sizes) > STALLED and sizes[-1] > 0.5 * sizes[-1 - STALLED]:
            break
        step = split_of(slope[0])[0] @ miss
        size = float(np.abs(step).max(initial=0.0))
        point = point - step * min(1.0, LONGEST / max(size, LONGEST))
        if size < HOLDS:
            break
    return point if _holds(equations, point) else None


def _holds(equations: Batched, point: Array) -> bool:
    """Whether the equations hold as well as floating point tells."""
    miss = equations(point[None])[0]
    if not np.isfinite(miss).all():
        return False
    # A double root is met to the square root of the precision: its miss still is small.
    return bool(np.abs(miss).max(initial=0.0) < HOLDS)


def nearest_from(problem: Problem, start: Array) -> Array | None:
    """A point of least distance among those that ``start`` descends to.

    Args:
        problem: Residual and equations.
        start: Any point, shape (n,).

    Returns:
        None where the equations cannot be met or the descent does not settle.
    """
    point = restored(problem.equations, start)
    if point is None:
        return None
    for _ in range(STEPS):
        downhill = _step(problem, point)
        if downhill is None:
            return None
        step, slope = downhill
        if slope < LEVEL:
            return point
        lower = _lower(problem, point, step)
        if lower is None:
            return point if slope < 1e3 * LEVEL else None
        point = lower
    return None


def _distance(problem: Problem, point: Array) -> float:
    return float(np.linalg.norm(problem.residual(point[None])[0]))


def _lower(problem: Problem, point: Array, step: Array) -> Array | None:
    """A nearer point in the direction of a step, with the equations mended."""
    before = _distance(problem, point)
    part = min(1.0, LONGEST / max(float(np.abs(step).max()), LONGEST))
    for _ in range(12):
        tried = restored(problem.equations, point + part * step, 12)
        if tried is not None and _distance(problem, tried) < before:
            return tried
        part /= 3
    return None


def _step(problem: Problem, point: Array) -> tuple[Array, float] | None:
    """The step along the equations that Newton's method takes, and the slope there."""
    conditions = _conditions(problem, point)
    if conditions is None:
        return None
    along, gradient, curved = conditions
    slope = along.T @ gradient
    size = float(np.abs(slope).max(initial=0.0))
    if size < LEVEL:
        return np.zeros_like(point), size
    hessian = along.T @ curved(along)
    if not np.isfinite(hessian).all():
        return None
    values, vectors = np.linalg.eigh((hessian + hessian.T) / 2)
    # Along a direction that curves down, or not at all, the slope alone leads.
    values = np.maximum(np.abs(values), 1e-3)
    return along @ (vectors @ (-(vectors.T @ slope) / values)), size


def _conditions(
    problem: Problem, point: Array
) -> tuple[Array, Array, Callable[[Array], Array]] | None:
    """Null space, gradient, and the Lagrangian's second derivative.

    None where a derivative does not exist.
    """
    count = len(point)

    def gradients(points: Array) -> Array:
        values, change = values_and_slopes(problem.residual, points)
        return (np.swapaxes(change, 1, 2) @ values[..., None])[..., 0]

    change = slopes(problem.equations, point[None])[0]
    gradient = gradients(point[None])[0]
    if not (np.isfinite(change).all() and np.isfinite(gradient).all()):
        return None
    inverse, along = split_of(change)
    weights = -(inverse.T @ gradient)

    def curved(directions: Array) -> Array:
        nudge = 1e-4 * directions.T
        points = np.concatenate([point + nudge, point - nudge])
        tied = np.swapaxes(slopes(problem.equations, points), 1, 2) @ weights
        ahead, behind = np.split(gradients(points) + tied, 2)
        return np.asarray(((ahead - behind) / 2e-4).T.reshape(count, -1))

    return along, gradient, curved
