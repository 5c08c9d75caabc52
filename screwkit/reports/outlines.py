"""Bodies as outlines through the points of their joints."""

from __future__ import annotations

import math
from collections.abc import Sequence

from screwkit.results.scene import BodyShape, Point


def around(points: Sequence[Point]) -> list[Point]:
    """The points in the order in which they go around their middle."""
    middle = [sum(p[i] for p in points) / len(points) for i in range(3)]
    spread = [max(p[i] for p in points) - min(p[i] for p in points) for i in range(3)]
    i, j = sorted(range(3), key=lambda k: -spread[k])[:2]
    return sorted(points, key=lambda p: math.atan2(p[j] - middle[j], p[i] - middle[i]))


def drawn_through(body: BodyShape) -> list[Point]:
    """The points of a body as a line through them: of three or more, around and back.

    >>> square = ((0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0))
    >>> [p[:2] for p in drawn_through(BodyShape("b", square, "link"))]
    [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)]
    """
    points = list(dict.fromkeys(body.points))
    if len(points) < 3:
        return points
    outline = around(points)
    return [*outline, outline[0]]
