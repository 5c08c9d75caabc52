"""Points, directions and lines constructed from a mechanism's features, over any ring.

Each construction is a function of the geometry, so that one text serves exact
polynomials, residues at a random point, and bounds for the number of terms.

References: [Hunt1978] for the join of points and the meet of planes.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeAlias

from screwkit.algebra.ring import S
from screwkit.loci.features import Features
from screwkit.screw.vector import Vector, add, cross, dot, subtract


@dataclass(frozen=True)
class Geometry(Generic[S]):
    """Features with the base frame and what shortens a vector of their ring.

    Attributes:
        features: Axes, points and planes.
        origin: Of the base frame.
        units: Its three axes.
        forces: (direction, moment) of further lines, by what they are called.
        normal: Gives normal forms.
    """

    features: Features[S]
    origin: Vector[S]
    units: tuple[Vector[S], Vector[S], Vector[S]]
    forces: Mapping[str, tuple[Vector[S], Vector[S]]]
    normal: Callable[[Vector[S]], Vector[S]]

    def direction(self, line: str) -> Vector[S]:
        """Of an axis or of a further line."""
        if line in self.forces:
            return self.forces[line][0]
        return self.features.axis(line).direction

    def moment_about(self, line: str, point: Vector[S]) -> Vector[S]:
        """Normal of the plane of a line and a point: zero if the point lies on it."""
        if line in self.forces:
            along, moment = self.forces[line]
            return self.normal(subtract(moment, cross(point, along)))
        axis = self.features.axis(line)
        assert axis.point is not None
        return self.normal(cross(subtract(axis.point, point), axis.direction))


PlaceOf: TypeAlias = Callable[[Geometry[Any]], Vector[Any]]
ScrewOf: TypeAlias = Callable[[Geometry[Any]], tuple[Vector[Any], Vector[Any]]]


@dataclass(frozen=True)
class Plane:
    """The plane of two axes that meet (``corner``) or are parallel (None)."""

    axes: tuple[str, str]
    corner: int | None


def at_point(point: int) -> PlaceOf:
    """A common point, by its number."""
    return lambda g: g.features.points[point].position


def on_axis(axis: str) -> PlaceOf:
    """A point of an axis."""

    def point(g: Geometry[S]) -> Vector[S]:
        found = g.features.axis(axis).point
        assert found is not None
        return found

    return point


def along(axis: str) -> PlaceOf:
    """The direction of an axis."""
    return lambda g: g.features.axis(axis).direction


def unit(number: int) -> PlaceOf:
    """An axis of the base frame."""
    return lambda g: g.units[number]


def normal_to(i: str, j: str) -> PlaceOf:
    """The direction normal to two lines."""

    def direction(g: Geometry[S]) -> Vector[S]:
        return g.normal(cross(g.direction(i), g.direction(j)))

    return direction


def difference(start: PlaceOf, end: PlaceOf) -> PlaceOf:
    """From one point to another."""
    return lambda g: subtract(end(g), start(g))


def rejected(axis: PlaceOf, offset: PlaceOf) -> PlaceOf:
    """The part of an offset across a direction, times its square."""

    def direction(g: Geometry[S]) -> Vector[S]:
        s = axis(g)
        return g.normal(cross(s, cross(offset(g), s)))

    return direction


def transversal(point: PlaceOf, i: str, j: str) -> PlaceOf:
    """Direction of the line through a point that meets two axes."""

    def direction(g: Geometry[S]) -> Vector[S]:
        place = point(g)
        return g.normal(cross(g.moment_about(i, place), g.moment_about(j, place)))

    return direction


def meeting_across(point: PlaceOf, i: str, j: str) -> PlaceOf:
    """Direction of the line through a point that meets one axis, normal to another."""

    def direction(g: Geometry[S]) -> Vector[S]:
        return g.normal(cross(g.moment_about(i, point(g)), g.direction(j)))

    return direction


def free(direction: PlaceOf) -> ScrewOf:
    """A couple or translation."""

    def screw(g: Geometry[S]) -> tuple[Vector[S], Vector[S]]:
        return g.origin, direction(g)

    return screw


def line(point: PlaceOf, direction: PlaceOf) -> ScrewOf:
    """A force or rotation: (d, p × d)."""

    def screw(g: Geometry[S]) -> tuple[Vector[S], Vector[S]]:
        d = g.normal(direction(g))
        return d, g.normal(cross(point(g), d))

    return screw


def _normal_form(plane: Plane, g: Geometry[S]) -> tuple[Vector[S], S]:
    """(n, e) with n·x = e on the plane."""
    i, j = plane.axes
    a, b = g.features.axis(i), g.features.axis(j)
    if plane.corner is None:
        assert a.point is not None
        assert b.point is not None
        normal = g.normal(cross(a.direction, subtract(b.point, a.point)))
        return normal, dot(normal, a.point)
    normal = g.normal(cross(a.direction, b.direction))
    return normal, dot(normal, g.features.points[plane.corner].position)


def intersection(left: Plane, right: Plane) -> ScrewOf:
    """Two planes (n, e) meet in the line with direction n₁×n₂, moment e₂n₁ − e₁n₂."""

    def screw(g: Geometry[S]) -> tuple[Vector[S], Vector[S]]:
        (n1, e1), (n2, e2) = _normal_form(left, g), _normal_form(right, g)
        moment = subtract(_scaled(e2, n1), _scaled(e1, n2))
        return g.normal(cross(n1, n2)), g.normal(moment)

    return screw


def chord(plane: Plane, k: str, m: str) -> ScrewOf:
    """The line through the points (x, w) in which two axes pierce a plane.

    In homogeneous coordinates x = (n·s) p + (e − n·p) s and w = n·s; the join of two
    points has direction w₁x₂ − w₂x₁ and moment x₁×x₂.
    """

    def screw(g: Geometry[S]) -> tuple[Vector[S], Vector[S]]:
        normal, height = _normal_form(plane, g)
        pierced = []
        for name in (k, m):
            axis = g.features.axis(name)
            assert axis.point is not None
            w = dot(normal, axis.direction)
            lift = height - dot(normal, axis.point)
            x = add(_scaled(w, axis.point), _scaled(lift, axis.direction))
            pierced.append((g.normal(x), w))
        (x1, w1), (x2, w2) = pierced
        along = subtract(_scaled(w1, x2), _scaled(w2, x1))
        return g.normal(along), g.normal(cross(x1, x2))

    return screw


def _scaled(factor: S, a: Sequence[S]) -> Vector[S]:
    return factor * a[0], factor * a[1], factor * a[2]
