"""Where a function of two variables changes its sign, as segments of lines.

Every edge of the grid on which the sign changes is bisected down to the rounding of
floating point, and the points on the edges of a cell are joined; where all four edges
have one, the sign in the middle says which belong together.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, TypeAlias

import numpy as np
import numpy.typing as npt

from screwkit.algebra.batch import Array

Function: TypeAlias = Callable[[Array, Array], Array]
Segment: TypeAlias = tuple[tuple[float, float], tuple[float, float]]

_Truth: TypeAlias = npt.NDArray[np.bool_]
_HALVINGS: Final = 60


def zero_lines(function: Function, xs: Array, ys: Array) -> tuple[Segment, ...]:
    """The segments of the curve on a grid.

    Args:
        function: Of arrays of one shape, values of that shape.
        xs: Ascending, shape (m,).
        ys: Ascending, shape (n,).

    Returns:
        Pairs of points of the curve, each on an edge of the grid; none in cells where
        a value is not finite.
    """
    x, y = np.meshgrid(xs, ys, indexing="ij")
    values = np.broadcast_to(function(x, y), x.shape)
    finite, sign = np.isfinite(values), values >= 0
    along = _crossings(function, (x, y), sign, finite, axis=0)
    across = _crossings(function, (x, y), sign, finite, axis=1)
    found: list[Segment] = []
    for i, j in sorted(_cells(along, across, x.shape)):
        # Below, right, above, left: around the cell.
        edges = (
            along.get((i, j)),
            across.get((i + 1, j)),
            along.get((i, j + 1)),
            across.get((i, j)),
        )
        points = [point for point in edges if point is not None]
        if len(points) == 4:
            below, right, above, left = points
            middle = function(xs[i : i + 2].mean()[None], ys[j : j + 2].mean()[None])
            if bool(middle[0] >= 0) == bool(sign[i, j]):
                found += [(below, right), (above, left)]
            else:
                found += [(left, below), (right, above)]
        elif len(points) == 2:
            found.append((points[0], points[1]))
    return tuple(found)


_Node: TypeAlias = tuple[int, int]
_Crossings: TypeAlias = dict[_Node, tuple[float, float]]


def _cells(along: _Crossings, across: _Crossings, shape: tuple[int, ...]) -> set[_Node]:
    """The cells beside edges that are crossed, by their first corners."""
    beside = {node for i, j in along for node in ((i, j), (i, j - 1))}
    beside |= {node for i, j in across for node in ((i, j), (i - 1, j))}
    return {
        (i, j) for i, j in beside if 0 <= i < shape[0] - 1 and 0 <= j < shape[1] - 1
    }


def _crossings(
    function: Function,
    grid: tuple[Array, Array],
    sign: _Truth,
    finite: _Truth,
    axis: int,
) -> _Crossings:
    """Where edges along an axis are crossed, by the node at which they start."""
    low, high = (slice(None, -1), slice(None)), (slice(1, None), slice(None))
    if axis:
        low, high = low[::-1], high[::-1]
    crossed = (sign[low] != sign[high]) & finite[low] & finite[high]
    nodes = np.argwhere(crossed)
    start = np.stack([part[low][crossed] for part in grid])
    stop = np.stack([part[high][crossed] for part in grid])
    first = sign[low][crossed]
    for _ in range(_HALVINGS if len(nodes) else 0):
        middle = (start + stop) / 2
        same = (function(middle[0], middle[1]) >= 0) == first
        start = np.where(same, middle, start)
        stop = np.where(same, stop, middle)
    return {
        (int(i), int(j)): (float(x), float(y))
        for (i, j), x, y in zip(nodes, *start, strict=True)
    }
