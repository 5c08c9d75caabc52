"""Bodies as outlines through the points of their joints."""

from __future__ import annotations

import math
from collections.abc import Sequence

from screwkit.results.scene import Point


def around(points: Sequence[Point]) -> list[Point]:
    """The points in the order in which they go around their middle."""
    middle = [sum(p[i] for p in points) / len(points) for i in range(3)]
    spread = [max(p[i] for p in points) - min(p[i] for p in points) for i in range(3)]
    i, j = sorted(range(3), key=lambda k: -spread[k])[:2]
    return sorted(points, key=lambda p: math.atan2(p[j] - middle[j], p[i] - middle[i]))
