"""Lines and directions that a mechanism's own geometry singles out.

Along them lie the forces and couples, the rotations and translations, that a person
would draw: through points in which axes meet, along axes, in the planes of meeting
axes.  Each candidate is written once over any ring; which of them are reciprocal to
given screws is a matter of microseconds at an exact point (`reciprocals`).

References: [Merlet1989]; [LongCaroKhalil2012] §5, [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, Generic, TypeAlias

from screwkit.algebra.ring import S
from screwkit.loci.features import Features, listed
from screwkit.screws.vector import Vector, add, cross, dot, subtract


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

_Way: TypeAlias = tuple[str, PlaceOf, str]
"""A direction in words, the direction, the axis it is taken from."""


@dataclass(frozen=True)
class Candidate:
    """A line, or a free direction.

    Attributes:
        name: The line: ``axis 3``, ``the line through …``; empty for a direction.
        how: What lies on it: ``along axis 3``, ``through …, parallel to axis 2``.
        screw: (direction, moment) of a screw of pitch 0 on the line; for a direction
            the zero vector and the direction.
        point: A point of the line; None where none is short, and for directions.
        rank: Smaller is simpler.
    """

    name: str
    how: str
    screw: ScrewOf
    point: PlaceOf | None = None
    rank: int = 0

    @property
    def free(self) -> bool:
        """Whether it is a direction without a place."""
        return not self.name


@dataclass(frozen=True)
class _Plane:
    """The plane of two axes that meet (``corner``) or are parallel (None)."""

    axes: tuple[str, str]
    corner: int | None


@dataclass(frozen=True)
class Catalogue:
    """Which lines and directions to try, and how to speak of them.

    Attributes:
        features: Over any ring; only their structure is looked at.
        base: Name of the base link.
        parallel: Pairs of axes that are parallel for every posture.
        forces: What the further lines of the geometry are called.
        whole: Of a platform: only forces are combined with each other, not the many
            joints, and lines through the origin come before all others.
    """

    features: Features[Any]
    base: str
    parallel: tuple[tuple[str, str], ...] = ()
    forces: tuple[str, ...] = ()
    whole: bool = False

    def candidates(self) -> list[Candidate]:
        """All of them, simplest first."""
        sources = [self._directions(), self._at_origin(), self._lines()]
        if not self.whole:
            sources = [sources[0], sources[2], sources[1]]
        return [
            Candidate(c.name, c.how, c.screw, c.point, number * 100 + c.rank)
            for number, source in enumerate(sources)
            for c in source
        ]

    # -- what there is -----------------------------------------------------------

    @property
    def _axes(self) -> list[str]:
        return [axis.joint for axis in self.features.axes]

    @property
    def _located(self) -> list[str]:
        return [axis.joint for axis in self.features.axes if axis.point is not None]

    @property
    def _combined(self) -> Sequence[str]:
        """Lines that others are built from, two at a time."""
        return self.forces if self.whole else self._axes

    @property
    def _crossed(self) -> Sequence[str]:
        """Those of them that have a place."""
        return self.forces if self.whole else self._located

    def _planes(self) -> list[_Plane]:
        if self.whole:
            return []
        planes = [_Plane((i, j), n) for i, j, n in self.features.planes]
        return planes + [_Plane(pair, None) for pair in self.parallel]

    def _called(self, *axes: str) -> str:
        """``axes 1 and 2``, ``the force of limb left and axis 3``."""
        joints = [name for name in axes if name not in self.forces]
        named = [name for name in axes if name in self.forces]
        if joints:
            noun = "axis" if len(joints) == 1 else "axes"
            named.append(f"{noun} {listed(joints)}")
        return " and ".join(named)

    # -- directions --------------------------------------------------------------

    def _directions(self) -> Iterator[Candidate]:
        for number, letter in enumerate("xyz"):
            how = f"along the {letter} axis of {self.base}"
            yield Candidate("", how, _free(_unit(number)), None, 0)
        for name in self._axes:
            how = f"along {self._called(name)}"
            yield Candidate("", how, _free(_along(name)), None, 1)
        for i, j in combinations(self._combined, 2):
            how = f"normal to {self._called(i, j)}"
            yield Candidate("", how, _free(_normal(i, j)), None, 2)

    # -- lines -------------------------------------------------------------------

    def _at_origin(self) -> Iterator[Candidate]:
        for number, letter in enumerate("xyz"):
            name = f"the {letter} axis of {self.base}"
            screw = _line(lambda g: g.origin, _unit(number))
            yield Candidate(name, f"along {name}", screw, lambda g: g.origin)

    def _lines(self) -> Iterator[Candidate]:
        for rank, source in enumerate(
            (
                self._joining(),
                self._through_points(self._along_axes()),
                self._on_axes(),
                self._through_points(self._along_units()),
                self._through_points(self._across_axes()),
                self._common_normals(),
                self._in_planes(),
                self._meeting(),
                self._across_planes(),
                self._through_axes(),
            )
        ):
            for c in source:
                yield Candidate(c.name, c.how, c.screw, c.point, rank)

    def _on_axes(self) -> Iterator[Candidate]:
        for name in self._located:
            called = self._called(name)
            screw = _line(_on(name), _along(name))
            yield Candidate(called, f"along {called}", screw, _on(name))

    def _joining(self) -> Iterator[Candidate]:
        points = self.features.points
        for p, q in combinations(range(len(points)), 2):
            called = f"the line through {points[p].name} and {points[q].name}"
            screw = _line(_at(p), _difference(_at(p), _at(q)))
            yield Candidate(called, f"along {called}", screw, _at(p))

    def _through_points(self, ways: Iterable[_Way]) -> Iterator[Candidate]:
        directions = tuple(ways)
        for p, point in enumerate(self.features.points):
            for words, direction, axis in directions:
                if axis not in point.joints:
                    yield Candidate(
                        f"the line through {point.name} {words}",
                        f"through {point.name}, {words}",
                        _line(_at(p), direction),
                        _at(p),
                    )

    def _along_axes(self) -> Iterator[_Way]:
        for name in self._axes:
            yield f"parallel to {self._called(name)}", _along(name), name

    def _along_units(self) -> Iterator[_Way]:
        for number, letter in enumerate("xyz"):
            words = f"parallel to the {letter} axis of {self.base}"
            yield words, _unit(number), ""

    def _across_axes(self) -> Iterator[_Way]:
        for i, j in combinations(self._combined, 2):
            yield f"normal to {self._called(i, j)}", _normal(i, j), ""

    def _common_normals(self) -> Iterator[Candidate]:
        for i, j in self.parallel:
            if not self.whole:
                called = f"meeting {self._called(i, j)} at right angles"
                across = _rejected(_along(i), _difference(_on(i), _on(j)))
                yield Candidate(
                    f"the line {called}", called, _line(_on(i), across), _on(i)
                )

    def _in_planes(self) -> Iterator[Candidate]:
        for a, b in combinations(self._planes(), 2):
            if not set(a.axes) & set(b.axes):
                called = (
                    f"the intersection line of the planes of axes {', '.join(a.axes)} "
                    f"and of axes {', '.join(b.axes)}"
                )
                yield Candidate(called, f"along {called}", _intersection(a, b))

    def _meeting(self) -> Iterator[Candidate]:
        for p, point in enumerate(self.features.points):
            others = [name for name in self._crossed if name not in point.joints]
            for i, j in combinations(others, 2):
                words = f"meeting {self._called(i, j)}"
                yield Candidate(
                    f"the line through {point.name} {words}",
                    f"through {point.name}, {words}",
                    _line(_at(p), _transversal(_at(p), i, j)),
                    _at(p),
                )

    def _across_planes(self) -> Iterator[Candidate]:
        for plane in self._planes():
            others = [name for name in self._crossed if name not in plane.axes]
            for k, m in combinations(others, 2):
                words = (
                    f"in the plane of axes {', '.join(plane.axes)}, "
                    f"meeting {self._called(k, m)}"
                )
                yield Candidate(f"the line {words}", words, _chord(plane, k, m))

    def _through_axes(self) -> Iterator[Candidate]:
        named = {name for point in self.features.points for name in point.joints}
        directions = (
            *self._along_axes(),
            *self._along_units(),
            *self._across_axes(),
        )
        for i in self._located:
            if i in named and self.whole:
                continue
            for words, direction, _ in directions:
                yield Candidate(
                    f"the line meeting {self._called(i)} {words}",
                    f"meeting {self._called(i)}, {words}",
                    _line(_on(i), direction),
                    _on(i),
                )


# -- constructions over any ring -----------------------------------------------------


def _at(point: int) -> PlaceOf:
    return lambda g: g.features.points[point].position


def _on(axis: str) -> PlaceOf:
    def point(g: Geometry[S]) -> Vector[S]:
        found = g.features.axis(axis).point
        assert found is not None
        return found

    return point


def _along(axis: str) -> PlaceOf:
    return lambda g: g.features.axis(axis).direction


def _unit(number: int) -> PlaceOf:
    return lambda g: g.units[number]


def _normal(i: str, j: str) -> PlaceOf:
    def direction(g: Geometry[S]) -> Vector[S]:
        return g.normal(cross(g.direction(i), g.direction(j)))

    return direction


def _difference(start: PlaceOf, end: PlaceOf) -> PlaceOf:
    return lambda g: subtract(end(g), start(g))


def _rejected(along: PlaceOf, offset: PlaceOf) -> PlaceOf:
    """The part of an offset across a direction, times its square."""

    def direction(g: Geometry[S]) -> Vector[S]:
        s = along(g)
        return g.normal(cross(s, cross(offset(g), s)))

    return direction


def _transversal(point: PlaceOf, i: str, j: str) -> PlaceOf:
    """Direction of the line through a point that meets two axes."""

    def direction(g: Geometry[S]) -> Vector[S]:
        place = point(g)
        return g.normal(cross(g.moment_about(i, place), g.moment_about(j, place)))

    return direction


def _free(direction: PlaceOf) -> ScrewOf:
    def screw(g: Geometry[S]) -> tuple[Vector[S], Vector[S]]:
        return g.origin, direction(g)

    return screw


def _line(point: PlaceOf, direction: PlaceOf) -> ScrewOf:
    def screw(g: Geometry[S]) -> tuple[Vector[S], Vector[S]]:
        along = g.normal(direction(g))
        return along, g.normal(cross(point(g), along))

    return screw


def _normal_form(plane: _Plane, g: Geometry[S]) -> tuple[Vector[S], S]:
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


def _intersection(left: _Plane, right: _Plane) -> ScrewOf:
    """Two planes (n, e) meet in the line with direction n₁×n₂, moment e₂n₁ − e₁n₂."""

    def screw(g: Geometry[S]) -> tuple[Vector[S], Vector[S]]:
        (n1, e1), (n2, e2) = _normal_form(left, g), _normal_form(right, g)
        moment = subtract(_scaled(e2, n1), _scaled(e1, n2))
        return g.normal(cross(n1, n2)), g.normal(moment)

    return screw


def _chord(plane: _Plane, k: str, m: str) -> ScrewOf:
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
