"""Points where equations vanish together with their slopes, met as well as others.

Where an equation does not change its sign, as cos q + 1 = 0 does not, its zeros are
double: Newton's steps halve the way to them, and end at the square root of the
precision.  The slope vanishes there too, and simply: with it as further equations the
same steps converge as at any other point.

References: [LeykinVerscheldeZhao2006] (deflation).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.metrics.nearest_point import CURVING, Problem, descended, restored
from screwkit.metrics.smooth import Conditions, Smooth

FLAT: Final = 1e-4
"""Slope of an equation, where 1 is usual, that an inexact double zero leaves."""

WEIGHT: Final = 1e-3
"""Of a slope among equations: differences know it to fewer digits than a value."""

ASIDE: Final = 1e-3
"""How far at most an exact double zero lies from where it was met."""

STEPS: Final = 8


@dataclass(frozen=True)
class WithSlopes:
    """Conditions, and that the slopes of some of their equations vanish.

    Attributes:
        conditions: What vanishes.
        flat: Numbers of the equations, from 0.
    """

    conditions: Conditions
    flat: tuple[int, ...]

    def around(self, centres: Array, copies: int = 1) -> Smooth:
        """See `Conditions`; second slopes are differences of slopes."""
        n = centres.shape[1]
        own = self.conditions.around(centres, copies)
        near = self.conditions.around(centres, 2 * n * copies)
        nudges = CURVING * np.concatenate([np.eye(n), -np.eye(n)])

        def chosen(slopes: Array) -> Array:
            there = [i for i in self.flat if i < slopes.shape[1]]
            return WEIGHT * slopes[:, there].reshape(len(slopes), -1)

        def values(points: Array) -> Array:
            found, slopes = own.both(points)
            return np.concatenate([found, chosen(slopes)], axis=1)

        def both(points: Array) -> tuple[Array, Array]:
            found, slopes = own.both(points)
            flat = chosen(slopes)
            beside = (points[:, None] + nudges).reshape(-1, n)
            change = chosen(near.slopes(beside)).reshape(len(points), 2, n, -1)
            curved = (change[:, 0] - change[:, 1]) / (2 * CURVING)
            return (
                np.concatenate([found, flat], axis=1),
                np.concatenate([slopes, np.swapaxes(curved, 1, 2)], axis=1),
            )

        return Smooth(values, both)


def flat_at(equations: Conditions, points: Array) -> list[tuple[int, ...]]:
    """Which equations have next to no slope at points where they hold.

    Args:
        equations: What vanishes.
        points: Shape (batch, n); none is flat at one that is not finite.
    """
    found: list[tuple[int, ...]] = [()] * len(points)
    known = np.flatnonzero(np.isfinite(points).all(axis=1))
    if not known.size:
        return found
    slopes = np.abs(equations.around(points[known]).slopes(points[known]))
    sizes = slopes.max(axis=2, initial=0.0)
    # What has no slope at all is no equation there, or is met exactly.
    for i, flat in zip(known, (sizes > 0) & (sizes < FLAT), strict=True):
        found[i] = tuple(int(k) for k in np.flatnonzero(flat))
    return found


def lowest(problem: Problem, points: Array) -> Array:
    """As `descended`, at double zeros along those of the slopes as well.

    Args:
        problem: Residual and equations.
        points: Where these hold, shape (batch, n).
    """
    begun = np.array(points, dtype=float)
    ends = np.full_like(begun, np.nan)
    for doubled, rows, there in _double(problem, begun):
        begun[rows] = there
        ends[rows] = descended(doubled, there)
    left = ~np.isfinite(ends).all(axis=1)
    ends[left] = descended(problem, begun[left])
    # A way that begins where all is smooth may end at a double zero.
    for _, rows, there in _double(problem, ends):
        ends[rows] = there
    return ends


def _double(
    problem: Problem, points: Array
) -> Iterator[tuple[Problem, list[int], Array]]:
    """The points beside double zeros, by which equations these are of.

    Yields:
        The problem with the slopes that vanish, the rows of the points, and the double
        zeros themselves.
    """
    patterns = flat_at(problem.equations, points)
    for flat in sorted(set(patterns) - {()}):
        rows = [i for i, own in enumerate(patterns) if own == flat]
        equations = WithSlopes(problem.equations, flat)
        there = restored(equations, points[rows], STEPS)
        aside = np.abs(there - points[rows]).max(axis=1, initial=0.0)
        exact = [i for i, size in enumerate(aside) if size < ASIDE]
        if exact:
            yield (
                Problem(problem.residual, equations),
                [rows[i] for i in exact],
                there[exact],
            )
