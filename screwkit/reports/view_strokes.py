"""What an interactive picture consists of: strokes, balls, heads of arrows, labels.

Marks hang on a point of the mechanism and have a size of their own, in parts of the
mechanism's, which the reader may change; everything else is in file lengths.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from typing import Any, Literal, TypeAlias

from screwkit.results.scene import Point

Group: TypeAlias = Literal[
    "links", "joints", "link names", "joint names", "frame", "twists", "wrenches"
]
"""What a reader shows and hides at once."""

_SIDES = 14


@dataclass(frozen=True)
class Stroke:
    """A polyline, or a polygon.

    Attributes:
        points: In file lengths; offsets from ``at`` where that is given.
        fill: Colour of the inside; empty for none.
        closed: Whether the last point is joined with the first.
        at: What the offsets of a mark are counted from, in parts of the size.
    """

    group: Group
    points: tuple[Point, ...]
    colour: str
    width: float = 1.0
    fill: str = ""
    closed: bool = False
    dashed: bool = False
    at: Point | None = None


@dataclass(frozen=True)
class Ball:
    """A sphere as a mark; its radius in parts of the size of the mechanism."""

    group: Group
    at: Point
    radius: float
    colour: str
    fill: str


@dataclass(frozen=True)
class Head:
    """The head of an arrow that ends at a point.

    Attributes:
        count: 1, or 2 for a double arrow.
    """

    group: Group
    at: Point
    direction: Point
    colour: str
    count: int = 1


@dataclass(frozen=True)
class Label:
    """Text beside a point."""

    group: Group
    at: Point
    text: str
    colour: str


Item: TypeAlias = Stroke | Ball | Head | Label


def item_data(item: Item) -> dict[str, Any]:
    """An item as plain data, with the name of its type."""
    return {"type": type(item).__name__, **asdict(item)}


@dataclass(frozen=True)
class Mark:
    """A mark where a joint is: how its faces are painted.

    Attributes:
        at: What offsets are counted from.
        fill: Of its faces.
        colour: Of their edges.
    """

    at: Point
    fill: str
    colour: str

    def cylinder(self, axis: Point, half: float, radius: float) -> Iterator[Stroke]:
        """About a unit axis through the point."""
        one, two = across(axis)
        rings = []
        for end in (-half, half):
            ring = []
            for k in range(_SIDES):
                angle = 2 * math.pi * k / _SIDES
                c, s = radius * math.cos(angle), radius * math.sin(angle)
                ring.append(_sum((end, axis), (c, one), (s, two)))
            rings.append(ring)
            yield self._face(*ring)
        for k in range(_SIDES):
            after = (k + 1) % _SIDES
            low, high = rings
            yield self._face(low[k], low[after], high[after], high[k])

    def box(self, axis: Point, half: float, side: float) -> Iterator[Stroke]:
        """A bar of square section along a unit axis."""
        one, two = across(axis)
        corners = [(side, side), (side, -side), (-side, -side), (-side, side)]
        low, high = (
            [_sum((end, axis), (x, one), (y, two)) for x, y in corners]
            for end in (-half, half)
        )
        yield self._face(*low)
        yield self._face(*high)
        for k in range(4):
            after = (k + 1) % 4
            yield self._face(low[k], low[after], high[after], high[k])

    def line(self, *ends: Point, width: float = 1.2) -> Stroke:
        """A polyline of the edges' colour."""
        return Stroke("joints", ends, self.colour, width, at=self.at)

    def _face(self, *points: Point) -> Stroke:
        return Stroke(
            "joints", points, self.colour, 0.6, self.fill, closed=True, at=self.at
        )


def across(axis: Point) -> tuple[Point, Point]:
    """Two unit vectors at right angles to a unit axis and to each other."""
    k = min(range(3), key=lambda i: abs(axis[i]))
    unit: Point = (float(k == 0), float(k == 1), float(k == 2))
    first = _cross(axis, unit)
    size = math.sqrt(sum(x * x for x in first)) or 1.0
    one = _sum((1 / size, first))
    return one, _cross(axis, one)


def along(start: Point, step: float, direction: Point) -> Point:
    """The point a step away."""
    return _sum((1.0, start), (step, direction))


def turn(centre: Point, axis: Point, radius: float) -> tuple[Point, ...]:
    """Three quarters of a circle about a unit axis, right-handed."""
    one, two = across(axis)
    angles = [1.5 * math.pi * k / 24 for k in range(25)]
    return tuple(
        _sum((1.0, centre), (radius * math.cos(a), one), (radius * math.sin(a), two))
        for a in angles
    )


def _cross(a: Point, b: Point) -> Point:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def _sum(*terms: tuple[float, Point]) -> Point:
    x, y, z = (sum(factor * vector[i] for factor, vector in terms) for i in range(3))
    return x, y, z
