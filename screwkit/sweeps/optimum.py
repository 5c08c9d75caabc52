"""The best point of a box: the best points of a grid, refined without derivatives.

Extreme eigenvalues have kinks where two of them meet, and the best design is often on
such a kink; so values are compared and nothing is differentiated.  The simplices of
Nelder and Mead walk from several candidates at once: all points that any of them might
want next are evaluated in one batch.

References: [NelderMead1965]; [BicchiPrattichizzo] §V-B.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.batch import Array
from screwkit.sweeps.grid import Axis
from screwkit.sweeps.objective import Objective

STARTS: Final = 24
"""Candidates that are refined; in one batch many cost little more than one."""

APART: Final = 0.02
"""Smallest distance of two of them, in parts of the box: optima on kinks lie close."""

SIZES: Final = (2e-2, 1e-3, 1e-4, 1e-6, 1e-8)
"""Of the simplices with which the walk begins, and begins again."""

STEPS: Final = 60
"""Steps of a walk, for each dimension."""


def refined(
    objective: Objective,
    axes: Sequence[Axis],
    points: Array,
    values: Array,
    *,
    greatest: bool = False,
) -> tuple[float, tuple[float, ...]]:
    """The least (or greatest) value near the best of given points, inside the box.

    Args:
        objective: What is minimised.
        axes: The box.
        points: Shape (points, axes).
        values: At them, shape (points,), some of them finite.
        greatest: Maximise instead.

    Returns:
        The value and the point.
    """
    sign = -1.0 if greatest else 1.0
    low = np.array([axis.start for axis in axes])
    span = np.array([axis.stop - axis.start for axis in axes])
    safe = np.where(span != 0, span, 1.0)

    def costs(units: Array) -> Array:
        places = low + span * np.clip(units, 0.0, 1.0)
        named = {axis.name: places[..., k] for k, axis in enumerate(axes)}
        found = sign * objective(named)
        return np.where(np.isfinite(found), found, np.inf)

    centres = _starts((points - low) / safe, sign * values)
    best = costs(centres)
    for size in SIZES:
        centres, best = _walked(costs, centres, size)
        if size == SIZES[0]:  # most candidates lead to the same few points
            order = np.argsort(best)[: max(2, STARTS // 3)]
            centres, best = centres[order], best[order]
    winner = int(np.argmin(best))
    place = low + span * np.clip(centres[winner], 0.0, 1.0)
    return sign * float(best[winner]), tuple(float(x) for x in place)


def _walked(
    costs: Callable[[Array], Array], centres: Array, size: float
) -> tuple[Array, Array]:
    """The best corner of every simplex after its walk, and the cost there."""
    count, width = centres.shape
    corners = np.concatenate(
        [centres[:, None], centres[:, None] + size * np.eye(width)], axis=1
    )
    heights = costs(corners)
    walk = np.arange(count)
    for _ in range(STEPS * width):
        order = np.argsort(heights, axis=1, kind="stable")
        corners = np.take_along_axis(corners, order[..., None], axis=1)
        heights = np.take_along_axis(heights, order, axis=1)
        if np.max(np.abs(corners[:, 1:] - corners[:, :1])) < 1e-15:
            break
        middle = corners[:, :-1].mean(axis=1)
        worst = corners[:, -1]
        away = middle - worst
        moves = np.stack(
            [middle + away, middle + 2 * away, middle + away / 2, middle - away / 2],
            axis=1,
        )
        shrunk = corners[:, :1] + 0.5 * (corners[:, 1:] - corners[:, :1])
        tried = costs(np.concatenate([moves, shrunk], axis=1))
        choice = _choices(heights, tried)
        kept = choice >= 0
        corners[walk[kept], -1] = moves[walk[kept], choice[kept]]
        heights[walk[kept], -1] = tried[walk[kept], choice[kept]]
        corners[~kept, 1:], heights[~kept, 1:] = shrunk[~kept], tried[~kept, 4:]
    best = np.argmin(heights, axis=1)
    return corners[walk, best], heights[walk, best]


def _choices(heights: Array, tried: Array) -> NDArray[np.intp]:
    """Which move each simplex makes: 0 to 3, or −1 where it shrinks."""
    reflected, expanded, outside, inside = tried[:, :4].T
    best, second, worst = heights[:, 0], heights[:, -2], heights[:, -1]
    return np.select(
        [
            (reflected < best) & (expanded < reflected),
            reflected < second,
            (reflected < worst) & (outside <= reflected),
            (reflected >= worst) & (inside < worst),
        ],
        [1, 0, 2, 3],
        -1,
    )


def _starts(units: Array, costs: Array) -> Array:
    """The best points, each away from those before it."""
    chosen: list[Array] = []
    for number in np.argsort(np.where(np.isfinite(costs), costs, np.inf)):
        if len(chosen) == STARTS or not np.isfinite(costs[number]):
            break
        unit = units[number]
        if all(np.max(np.abs(unit - other)) > APART for other in chosen):
            chosen.append(unit)
    return np.array(chosen)
