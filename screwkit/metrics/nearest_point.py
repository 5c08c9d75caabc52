"""The nearest points where equations hold, from many starts at once.

Newton's method on the Lagrange conditions.  Steps are split by singular values into
the part that mends the equations and the part along them, so that equations may depend
on each other.  All starts go side by side, each at its own pace.

References: [NocedalWright2006] §18.1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.batch import Array
from screwkit.metrics.smooth import Conditions, Smooth

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

MENDING = 6
"""Steps in which a point beside the equations is brought back to them."""

HALVINGS = 7
"""How often a step that leads no nearer is cut, each time to a third."""

SETTLED = 3e-7
"""Size of a step after which the next one would change nothing that counts."""

CURVING = 1e-4
"""Step of the difference of two slopes."""


@dataclass(frozen=True, eq=False)
class Problem:
    """What is small, and what must vanish."""

    residual: Smooth
    equations: Conditions

    def distances(self, points: Array) -> Array:
        """Shape (batch, n) to (batch,)."""
        return np.asarray(np.linalg.norm(self.residual.values(points), axis=1))


def split_of(matrix: Array) -> tuple[Array, Array]:
    """Pseudoinverse and an orthonormal basis of the null space, as columns."""
    inverse, vectors, kept = splits(matrix[None])
    return inverse[0], vectors[0][:, kept[0]]


def splits(matrices: Array) -> tuple[Array, Array, NDArray[np.bool_]]:
    """Pseudoinverses, right singular vectors, and which of these map to 0.

    Args:
        matrices: Shape (batch, k, n).

    Returns:
        Shapes (batch, n, k), (batch, n, n) as columns, and (batch, n).
    """
    batch, k, n = matrices.shape
    if not k or not batch:
        whole = np.broadcast_to(np.eye(n), (batch, n, n))
        return np.zeros((batch, n, k)), whole, np.ones((batch, n), dtype=bool)
    left, sizes, right = np.linalg.svd(matrices, full_matrices=k < n)
    count = min(k, n)
    counts = sizes > CUT * np.maximum(1.0, sizes[:, :1])
    inverted = np.where(counts, 1.0 / np.where(counts, sizes, 1.0), 0.0)
    across = np.swapaxes(right[:, :count], 1, 2) * inverted[:, None]
    inverse = across @ np.swapaxes(left[:, :, :count], 1, 2)
    free = np.ones((batch, n), dtype=bool)
    free[:, :count] = ~counts
    return inverse, np.swapaxes(right, 1, 2), free


def mended(change: Array, misses: Array) -> Array:
    """The shortest steps that undo misses to first order; see `restored`.

    By normal equations with a ridge, several times faster than singular values: what
    depends on other equations takes no part, and what the ridge leaves the next step
    of Newton's method mends.

    Args:
        change: Shape (batch, k, n).
        misses: Shape (batch, k).

    Returns:
        Shape (batch, n).
    """
    _, k, n = change.shape
    turned = np.swapaxes(change, 1, 2)
    square = change @ turned if k <= n else turned @ change
    size = np.trace(square, axis1=1, axis2=2)[:, None, None]
    ridge = CUT**2 * np.maximum(1.0, size) * np.eye(min(k, n))
    right = misses[..., None]
    if k <= n:
        return np.asarray((turned @ np.linalg.solve(square + ridge, right))[..., 0])
    return np.asarray(np.linalg.solve(square + ridge, turned @ right)[..., 0])


def restored(equations: Conditions, starts: Array, steps: int = 25) -> Array:
    """Points near ``starts`` where the equations hold, by Gauss-Newton steps.

    Args:
        equations: What vanishes.
        starts: Shape (batch, n).
        steps: At most so many.

    Returns:
        Shape (batch, n); nan where none is come to.
    """
    points = np.array(starts, dtype=float)
    sizes = np.full((steps, len(points)), np.inf)
    shortened = np.zeros(len(points), dtype=bool)
    active = np.arange(len(points))
    for count in range(steps):
        if not active.size:
            break
        here = points[active]
        own = equations.around(here)
        misses, change = own.both(here)
        exist = np.isfinite(misses).all(axis=1) & np.isfinite(change).all(axis=(1, 2))
        points[active[~exist]] = np.nan
        active, misses, change = active[exist], misses[exist], change[exist]
        sizes[count, active] = np.linalg.norm(misses, axis=1)
        if count >= STALLED:
            halved = sizes[count, active] <= 0.5 * sizes[count - STALLED, active]
            # Steps that are cut short still are on their way.
            halved |= shortened[active]
            active, misses, change = active[halved], misses[halved], change[halved]
        step = mended(change, misses)
        size = np.abs(step).max(axis=1, initial=0.0)
        points[active] -= step * _shortened(size)[:, None]
        shortened[active] = size > LONGEST
        active = active[size > SETTLED]
    return _where_they_hold(equations, points)


def _shortened(sizes: Array) -> Array:
    """The part of steps of these sizes that is taken."""
    return np.asarray(LONGEST / np.maximum(sizes, LONGEST))


def _where_they_hold(equations: Conditions, points: Array) -> Array:
    """The points where the equations hold as well as floating point tells, else nan."""
    points = points.copy()
    known = np.flatnonzero(np.isfinite(points).all(axis=1))
    if known.size:
        misses = equations.around(points[known]).values(points[known])
        # A double root is met to the square root of the precision: its miss is small.
        holds = np.abs(misses).max(axis=1, initial=0.0) < HOLDS
        points[known[~holds]] = np.nan
    return points


def descended(problem: Problem, points: Array) -> Array:
    """Points of least distance among those that points on the equations descend to.

    Args:
        problem: Residual and equations.
        points: Where these hold, shape (batch, n).

    Returns:
        Shape (batch, n); nan where a descent does not settle.
    """
    points = np.array(points, dtype=float)
    found = np.full_like(points, np.nan)
    active = np.flatnonzero(np.isfinite(points).all(axis=1))
    for _ in range(STEPS):
        if not active.size:
            break
        step, slope = _steps(problem, points[active])
        level = slope < LEVEL
        found[active[level]] = points[active[level]]
        going = ~level & np.isfinite(slope)
        active, step, slope = active[going], step[going], slope[going]
        lower = _lower(problem, points[active], step)
        ended = ~np.isfinite(lower).all(axis=1)
        flat = active[ended & (slope < 1e3 * LEVEL)]
        found[flat] = points[flat]
        active = active[~ended]
        points[active] = lower[~ended]
    return found


def _lower(problem: Problem, points: Array, steps: Array) -> Array:
    """Nearer points in the direction of steps, with the equations mended; else nan."""
    before = problem.distances(points)
    part = _shortened(np.abs(steps).max(axis=1, initial=0.0))
    lower = np.full_like(points, np.nan)
    active = np.arange(len(points))
    for _ in range(HALVINGS):
        if not active.size:
            break
        aim = points[active] + part[active, None] * steps[active]
        tried = restored(problem.equations, aim, MENDING)
        nearer = problem.distances(tried) < before[active]
        lower[active[nearer]] = tried[nearer]
        active = active[~nearer]
        part[active] /= 3
    return lower


def _steps(problem: Problem, points: Array) -> tuple[Array, Array]:
    """Newton's steps along the equations, and the slopes there.

    Returns:
        Shapes (batch, n) and (batch,), the slope nan where a derivative does not exist.
    """
    n = points.shape[1]
    gradient = _gradients(problem.residual, points)
    change = problem.equations.around(points).slopes(points)
    exist = np.isfinite(change).all(axis=(1, 2)) & np.isfinite(gradient).all(axis=1)
    gradient, change = (np.where(exist.T, x.T, 0.0).T for x in (gradient, change))
    inverse, vectors, free = splits(change)
    count = int(free.sum(axis=1).max(initial=0))
    along = (vectors * free[:, None])[:, :, n - count :]
    slope = (np.swapaxes(along, 1, 2) @ gradient[..., None])[..., 0]
    size = np.abs(slope).max(axis=1, initial=0.0)
    weights = -(np.swapaxes(inverse, 1, 2) @ gradient[..., None])[..., 0]
    hessian = np.swapaxes(along, 1, 2) @ _curved(problem, points, along, weights)
    exist &= np.isfinite(hessian).all(axis=(1, 2))
    hessian[~exist] = 0.0
    values, turned = np.linalg.eigh((hessian + np.swapaxes(hessian, 1, 2)) / 2)
    # Along a direction that curves down, or not at all, the slope alone leads.
    values = np.maximum(np.abs(values), 1e-3)
    across = (np.swapaxes(turned, 1, 2) @ slope[..., None])[..., 0] / values
    step = -(along @ (turned @ across[..., None]))[..., 0]
    return step, np.where(exist, size, np.nan)


def _gradients(residual: Smooth, points: Array) -> Array:
    """Of half the squared distance, shape (batch, n)."""
    values, change = residual.both(points)
    return np.asarray((np.swapaxes(change, 1, 2) @ values[..., None])[..., 0])


def _curved(problem: Problem, points: Array, along: Array, weights: Array) -> Array:
    """The Lagrangian's second derivative in directions, shape (batch, n, count)."""
    batch, n = points.shape
    count = along.shape[2]
    if not count:
        return np.zeros((batch, n, 0))
    nudge = CURVING * np.swapaxes(along, 1, 2)
    near = np.concatenate([points[:, None] + nudge, points[:, None] - nudge], axis=1)
    near = near.reshape(-1, n)
    tied = problem.equations.around(points, 2 * count).slopes(near)
    repeated = np.repeat(weights, 2 * count, axis=0)
    rates = _gradients(problem.residual, near)
    rates = rates + (np.swapaxes(tied, 1, 2) @ repeated[..., None])[..., 0]
    ahead, behind = np.split(rates.reshape(batch, 2 * count, n), 2, axis=1)
    return np.swapaxes((ahead - behind) / (2 * CURVING), 1, 2)
