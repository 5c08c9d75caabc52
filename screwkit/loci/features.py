"""The points, axes and planes of a mechanism, and statements about them.

A statement such as "axes 2 and 7 are parallel" is a list of scalars that all vanish
exactly where it holds; it is written once over any ring.  At an exact point of a locus
it costs microseconds to see which statements hold there; only those are then compared
with the locus itself, and one is called its meaning only if the two are the same set.

References: [Merlet1989]; [LongCaroKhalil2012] Table 3.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations, product
from typing import Generic

from screwkit.algebra.ring import S
from screwkit.screw.vector import Vector, cross, dot, subtract

_CENTRES = 6  # of which planes through three are looked at, and lines across limbs

FAR = "line across limbs meets"
"""The kind of statements about a line through points of two limbs."""

LONG = (FAR, "along centres", "across", "normal in")
"""Kinds whose statements are said where no figure of lines is."""


@dataclass(frozen=True)
class Axis(Generic[S]):
    """The axis of a revolute joint, or the direction of a prismatic one.

    Attributes:
        limb: Number of the limb, from 0.
        point: None for prismatic joints.
    """

    joint: str
    limb: int
    direction: Vector[S]
    point: Vector[S] | None


@dataclass(frozen=True)
class Point(Generic[S]):
    """The centre of a spherical joint, or a point in which axes meet for every posture.

    Attributes:
        joints: The axes through it.
        own: Those of them that it is named after, all of one limb.
        called: The name of a centre; empty where the axes name the point.
        limb: Number of the limb that it is named after.
        written: What the file calls the point in which axes meet; empty if nothing.
    """

    joints: tuple[str, ...]
    own: tuple[str, ...]
    position: Vector[S]
    called: str = ""
    limb: int = 0
    written: str = ""

    @property
    def name(self) -> str:
        """The point in words."""
        return (
            self.called
            or self.written
            or f"the common point of axes {listed(self.own)}"
        )


@dataclass(frozen=True)
class Features(Generic[S]):
    """Axes, the points where they meet, and the planes of pairs that meet.

    Attributes:
        planes: (joint, joint) of pairs of axes that meet for every posture.
    """

    axes: tuple[Axis[S], ...]
    points: tuple[Point[S], ...]
    planes: tuple[tuple[str, str, int], ...]

    def axis(self, joint: str) -> Axis[S]:
        """The axis of a joint."""
        return self._by_joint[joint]

    def normal(self, first: str, second: str) -> Vector[S]:
        """The vector product of two axes' directions; computed once for each pair."""
        key = first, second
        if key not in self._normals:
            one, other = self.axis(first), self.axis(second)
            self._normals[key] = cross(one.direction, other.direction)
        return self._normals[key]

    @cached_property
    def _by_joint(self) -> Mapping[str, Axis[S]]:
        return {axis.joint: axis for axis in self.axes}

    @cached_property
    def _normals(self) -> dict[tuple[str, str], Vector[S]]:
        return {}


@dataclass(frozen=True)
class Statement:
    """Something about the geometry that may hold at a posture.

    Attributes:
        kind: Statements of one kind are equally simple.
        words: A sentence without full stop.
        joints: The joints it speaks of.
        scalars: Given features over a ring, what must vanish.
    """

    kind: str
    words: str
    joints: tuple[str, ...]
    scalars: Callable[[Features[S]], Sequence[S]]


def listed(names: Sequence[str]) -> str:
    """``1``, ``1 and 2``, ``1, 2 and 3``."""
    if len(names) < 2:
        return "".join(names)
    return f"{', '.join(names[:-1])} and {names[-1]}"


def statements(features: Features[S]) -> list[Statement]:
    """All statements of the catalogue about these features, simplest first.

    Of two that say the same, the one about joints of a single limb comes first.
    """
    limb_of = {axis.joint: axis.limb for axis in features.axes}
    found = [*_of_lines(features), *_of_planes(features), *_of_three(features)]
    groups: dict[str, int] = {}
    for statement in found:
        groups.setdefault(statement.kind, len(groups))
    return sorted(
        found,
        key=lambda s: (groups[s.kind], len({limb_of[j] for j in s.joints})),
    )


def _of_lines(features: Features[S]) -> Iterator[Statement]:
    axes = [axis.joint for axis in features.axes]
    lines = [axis.joint for axis in features.axes if axis.point is not None]
    points = range(len(features.points))
    for i, j in combinations(lines, 2):
        words = f"axes {i} and {j} are one line"
        yield Statement("line", words, (i, j), _same_line(i, j))
    for p, j in product(points, lines):
        point = features.points[p]
        if j not in point.joints:
            words = f"{point.name} lies on axis {j}"
            yield Statement("on", words, (*point.own, j), _point_on_axis(p, j))
    for p, q in combinations(points, 2):
        words = f"{features.points[p].name} and {_of(features, p, q)} coincide"
        joints = (*features.points[p].own, *features.points[q].own)
        yield Statement("coincide", words, joints, _points_coincide(p, q))
    for i, j in combinations(axes, 2):
        words = f"axes {i} and {j} are parallel"
        yield Statement("parallel", words, (i, j), _parallel(i, j))
    for i, j in combinations(axes, 2):
        words = f"axes {i} and {j} are perpendicular"
        yield Statement("perpendicular", words, (i, j), _perpendicular(i, j))
    for i, j in combinations(lines, 2):
        words = f"axes {i} and {j} lie in one plane"
        yield Statement("meet", words, (i, j), _meet(i, j))


def _of_planes(features: Features[S]) -> Iterator[Statement]:
    for (i, j, _), (k, m, _) in combinations(features.planes, 2):
        if len({i, j, k, m}) == 4:
            planes = f"the planes of axes {i}, {j} and of axes {k}, {m} are"
            four, pairs = (i, j, k, m), ((i, j), (k, m))
            yield Statement(
                "planes", f"{planes} parallel", four, _planes_parallel(*pairs)
            )
            yield Statement(
                "normal planes",
                f"{planes} perpendicular",
                four,
                _planes_perpendicular(*pairs),
            )
    for p, (i, j, _) in product(range(len(features.points)), features.planes):
        point = features.points[p]
        if not {i, j} & set(point.joints):
            words = f"{point.name} lies in the plane of axes {i}, {j}"
            joints = (*point.own, i, j)
            yield Statement("in plane", words, joints, _point_in_plane(p, i, j))


def _of_three(features: Features[S]) -> Iterator[Statement]:
    axes = [axis.joint for axis in features.axes]
    lines = [axis.joint for axis in features.axes if axis.point is not None]
    limb_of = {axis.joint: axis.limb for axis in features.axes}
    points = range(len(features.points))
    for (p, q), k in product(combinations(points, 2), lines):
        first, second = features.points[p], features.points[q]
        if k in first.joints or k in second.joints:
            continue
        words = (
            f"the line through {first.name} and {_of(features, p, q)} meets axis {k}"
        )
        joints = (*first.own, *second.own, k)
        kind = "line meets" if first.limb == second.limb else FAR
        yield Statement(kind, words, joints, _line_meets_axis(p, q, k))
    for (p, q), k in product(combinations(points, 2), axes):
        first, second = features.points[p], features.points[q]
        if first.limb != second.limb and len(points) > _CENTRES:
            continue
        joints = (*first.own, *second.own, k)
        words = (
            f"the line through {first.name} and {_of(features, p, q)} "
            f"is perpendicular to axis {k}"
        )
        yield Statement("line across", words, joints, _line_across_axis(p, q, k))
    for p, i, k in product(points, axes, lines):
        point = features.points[p]
        own = {point.limb, limb_of[i], limb_of[k]}
        if k == i or k in point.joints or len(own) > 1:
            continue
        words = f"axis {i} is parallel to the plane of axis {k} and {point.name}"
        joints = (*point.own, i, k)
        yield Statement("along plane", words, joints, _axis_along_plane(p, i, k))
    centres = [p for p in points if features.points[p].called]
    if len(centres) <= _CENTRES:
        for three, i in product(combinations(centres, 3), axes):
            named = listed([features.points[p].name for p in three])
            words = f"axis {i} is parallel to the plane of {named}"
            yield Statement("along centres", words, (i,), _along_three(three, i))
        for three, (i, j) in product(combinations(centres, 3), combinations(axes, 2)):
            named = listed([features.points[p].name for p in three])
            words = (
                f"the common normal of axes {i} and {j} is parallel to the plane of "
                f"{named}"
            )
            yield Statement("across", words, (i, j), _along_three(three, i, j))
    neighbours = [(i, j) for i, j in combinations(axes, 2) if _adjacent(axes, i, j)]
    for p, (i, j), k in product(points, neighbours, lines):
        point = features.points[p]
        if k in (i, j) or k in point.joints:
            continue
        words = (
            f"the plane through axis {k} and {point.name} contains a direction "
            f"normal to axes {i} and {j}"
        )
        joints = (*point.own, i, j, k)
        yield Statement("normal in", words, joints, _normal_in_plane(p, k, i, j))
    for i, j, k in combinations(axes, 3):
        words = f"axes {i}, {j} and {k} are parallel to one plane"
        yield Statement("directions", words, (i, j, k), _directions_coplanar(i, j, k))


def _adjacent(axes: Sequence[str], i: str, j: str) -> bool:
    return abs(axes.index(i) - axes.index(j)) == 1


def _of(features: Features[S], first: int, number: int) -> str:
    """A point after another: ``the common point of … and that of axes 3 and 4``."""
    point = features.points[number]
    is_named = [p.called or p.written for p in (point, features.points[first])]
    return point.name if any(is_named) else f"that of axes {listed(point.own)}"


def _same_line(i: str, j: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        a, b = features.axis(i), features.axis(j)
        assert a.point is not None
        assert b.point is not None
        offset = subtract(b.point, a.point)
        return [*features.normal(i, j), *cross(offset, a.direction)]

    return scalars


def _point_on_axis(p: int, j: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        axis = features.axis(j)
        assert axis.point is not None
        offset = subtract(features.points[p].position, axis.point)
        return cross(offset, axis.direction)

    return scalars


def _points_coincide(p: int, q: int) -> Callable[[Features[S]], Sequence[S]]:
    return lambda f: subtract(f.points[p].position, f.points[q].position)


def _parallel(i: str, j: str) -> Callable[[Features[S]], Sequence[S]]:
    return lambda f: f.normal(i, j)


def _perpendicular(i: str, j: str) -> Callable[[Features[S]], Sequence[S]]:
    return lambda f: [dot(f.axis(i).direction, f.axis(j).direction)]


def _normals(
    features: Features[S], first: tuple[str, str], second: tuple[str, str]
) -> tuple[Vector[S], Vector[S]]:
    return features.normal(*first), features.normal(*second)


def _planes_parallel(
    first: tuple[str, str], second: tuple[str, str]
) -> Callable[[Features[S]], Sequence[S]]:
    return lambda f: cross(*_normals(f, first, second))


def _planes_perpendicular(
    first: tuple[str, str], second: tuple[str, str]
) -> Callable[[Features[S]], Sequence[S]]:
    return lambda f: [dot(*_normals(f, first, second))]


def _point_in_plane(p: int, i: str, j: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        number = next(n for x, y, n in features.planes if {x, y} == {i, j})
        corner = features.points[number].position
        offset = subtract(features.points[p].position, corner)
        return [dot(features.normal(i, j), offset)]

    return scalars


def _meet(i: str, j: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        a, b = features.axis(i), features.axis(j)
        assert a.point is not None
        assert b.point is not None
        return [dot(features.normal(i, j), subtract(b.point, a.point))]

    return scalars


def _line_meets_axis(p: int, q: int, k: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        axis = features.axis(k)
        assert axis.point is not None
        start = features.points[p].position
        along = subtract(features.points[q].position, start)
        return [dot(cross(along, axis.direction), subtract(start, axis.point))]

    return scalars


def _line_across_axis(p: int, q: int, k: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        ends = features.points[p].position, features.points[q].position
        return [dot(subtract(*ends), features.axis(k).direction)]

    return scalars


def _axis_along_plane(p: int, i: str, k: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        axis = features.axis(k)
        assert axis.point is not None
        offset = subtract(features.points[p].position, axis.point)
        return [dot(features.normal(i, k), offset)]

    return scalars


def _along_three(
    three: tuple[int, ...], i: str, j: str = ""
) -> Callable[[Features[S]], Sequence[S]]:
    """An axis, or the common normal of two, lies along the plane of three points."""

    def scalars(features: Features[S]) -> Sequence[S]:
        a, b, c = (features.points[p].position for p in three)
        normal = cross(subtract(b, a), subtract(c, a))
        along = features.normal(i, j) if j else features.axis(i).direction
        return [dot(normal, along)]

    return scalars


def _normal_in_plane(
    p: int, k: str, i: str, j: str
) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        axis = features.axis(k)
        assert axis.point is not None
        offset = subtract(features.points[p].position, axis.point)
        return [dot(cross(axis.direction, offset), features.normal(i, j))]

    return scalars


def _directions_coplanar(
    i: str, j: str, k: str
) -> Callable[[Features[S]], Sequence[S]]:
    return lambda f: [dot(f.normal(i, j), f.axis(k).direction)]
