"""Wrenches that are constructed from a limb's points, where no two of them span one.

Couples normal to a plane or to two directions, forces parallel to a line, and those
in a plane that meet an axis: what rods in pairs and hinges behind them transmit.

References: [Hunt1978] §12, for the line at infinity of a plane as a couple.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any, TypeAlias

from screwkit.algebra.modular import echelon, rank
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.loci.features import listed
from screwkit.loci.named_screws import JOIN, NORMAL, NamedScrew, Noun
from screwkit.loci.placed_points import PlacedPoint, placed_at, power, wrench_through
from screwkit.loci.reciprocal_lines import TwistsAt
from screwkit.screw.vector import cross, dot

_POINTS = 10  # of a limb whose planes and lines are looked at

PLANE = Noun("the normal of the plane of", "the normals of the planes of", "of ")
ACROSS = Noun("the normal of", "the normals of", "of ")

Place: TypeAlias = Sequence[Any]
"""Homogeneous coordinates of a point over a ring."""


@dataclass(frozen=True)
class _Construction:
    """A wrench as a function of points and axes over any ring.

    Attributes:
        points: Numbers of the points it takes, before the axes.
        axes: Numbers of the axes.
        wrench: (f; m) of their homogeneous coordinates and (direction, moment).
    """

    noun: Noun
    name: str
    points: tuple[int, ...]
    axes: tuple[int, ...]
    wrench: Callable[..., Sequence[Any]]
    free: bool

    def of(self, points: Sequence[Place], axes: Sequence[Place]) -> Sequence[Any]:
        """The wrench over the ring of these coordinates."""
        given = [*(points[i] for i in self.points), *(axes[i] for i in self.axes)]
        return self.wrench(*given)


def constructed_wrenches(
    ring: TrigonometricRing,
    limb: int,
    known: Sequence[NamedScrew],
    points: Sequence[PlacedPoint],
    axes: Sequence[NamedScrew],
    passive: Sequence[TwistsAt],
    samples: Sequence[tuple[Sequence[int], int]],
) -> list[NamedScrew]:
    """Further wrenches of a limb, and all its couples.

    Args:
        ring: Of the coordinates.
        limb: Its number.
        known: Wrenches that lines through two of its points give.
        points: Its points and directions.
        axes: Of its joints that are lines.
        passive: Its twists at each of the postures.
        samples: Exact postures.
    """
    wanted = 6 - max(map(len, passive))
    couples = 3 - max(
        rank([t[DIRECTION] for t in twists], prime)
        for twists, (_, prime) in zip(passive, samples, strict=True)
    )
    at, prime = samples[0]
    rows = [screw.at(at, prime) for screw in known]
    free = [screw.at(at, prime) for screw in known if screw.free]
    placed = [
        ([*map(list, placed_at(points, *s))], [axis.at(*s) for axis in axes], s[1])
        for s in samples
    ]
    found: list[NamedScrew] = []
    finite = [i for i, p in enumerate(points) if not p.ideal][:_POINTS]
    banded = _bands(finite, [(p, own) for p, _, own in placed])
    for one in _constructions(points, finite, axes, banded):
        if len(free) == couples and (one.free or len(rows) == wanted):
            if len(rows) == wanted:
                break
            continue
        wrenches = [one.of(p, a) for p, a, _ in placed]
        if not all(
            any(x % own for x in wrench)
            and not any(power(wrench, twist) % own for twist in twists)
            for wrench, (_, _, own), twists in zip(
                wrenches, placed, passive, strict=True
            )
        ):
            continue
        row = [x % prime for x in wrenches[0]]
        among = free if one.free else rows
        if rank([*among, row], prime) == len(among):
            continue
        if rank([*rows, row], prime) > len(rows):
            rows.append(row)
        if one.free:
            free.append(row)
        found.append(_named(ring, one, points, axes, limb))
    return found


def _named(
    ring: TrigonometricRing,
    one: _Construction,
    points: Sequence[PlacedPoint],
    axes: Sequence[NamedScrew],
    limb: int,
) -> NamedScrew:
    exact = one.of([p.coordinates for p in points], [a.column for a in axes])
    column: tuple[Polynomial, ...] = tuple(ring.normal(value) for value in exact)
    return NamedScrew(column, one.noun, one.name, limb, free=one.free)


def _constructions(
    points: Sequence[PlacedPoint],
    finite: Sequence[int],
    axes: Sequence[NamedScrew],
    banded: Sequence[tuple[int, int, int]],
) -> Iterator[_Construction]:
    """Simplest first; planes are named by a line in them and one point more."""
    ideal = [i for i, p in enumerate(points) if p.ideal]
    names = [p.name for p in points]
    lines = [
        tuple(sorted(two, key=lambda i: names[i])) for two in combinations(finite, 2)
    ]
    for a, b in combinations(ideal, 2):
        name = " and ".join(_direction(names[i]) for i in (a, b))
        yield _Construction(NORMAL, name, (a, b), (), wrench_through, True)
    for three in combinations(finite, 3):
        name = listed([names[i] for i in three])
        yield _Construction(PLANE, name, three, (), _normal_of_plane, True)
    for d, (a, b) in ((d, line) for d in ideal for line in lines):
        name = f"axis {_direction(names[d])} and line {names[a]} {names[b]}"
        yield _Construction(ACROSS, name, (d, a, b), (), _normal_to_line, True)
    for a, b in lines:
        for c in (c for c in finite if c not in (a, b)):
            name = f"through {names[c]} parallel to line {names[a]} {names[b]}"
            yield _Construction(JOIN, name, (c, a, b), (), _parallel, False)
    for n, axis in enumerate(axes):
        for a, b in lines:
            for c in (c for c in finite if c not in (a, b)):
                plane = listed([names[i] for i in (a, b, c)])
                name = (
                    f"through axis {axis.name} parallel to {names[a]} {names[b]} "
                    f"in the plane of {plane}"
                )
                yield _Construction(JOIN, name, (a, b, c), (n,), _in_plane, False)

    for n, axis in enumerate(axes):
        for one, other in combinations(banded, 2):
            planes = " and of ".join(
                listed([names[i] for i in p]) for p in (one, other)
            )
            name = (
                f"axis {axis.name} and of the line in which the planes of {planes} meet"
            )
            six = (*one, *other)
            yield _Construction(ACROSS, name, six, (n,), _across_meet, True)


def _bands(
    finite: Sequence[int], placed: Sequence[tuple[Sequence[Place], int]]
) -> list[tuple[int, int, int]]:
    """Planes of two lines that are parallel at every posture, by three points."""
    found: dict[tuple[Sequence[int], ...], tuple[int, int, int]] = {}

    def alike(one: tuple[int, int], other: tuple[int, int]) -> bool:
        return all(
            rank([_along(p[one[0]], p[one[1]]), _along(p[other[0]], p[other[1]])], own)
            == 1
            for p, own in placed
        )

    for one, other in combinations(combinations(finite, 2), 2):
        if len({*one, *other}) < 4 or not alike(one, other):
            continue
        points, prime = placed[0]
        a, b, c = (points[i] for i in (*one, other[0]))
        normal = echelon([_normal(a, b, c)], prime)
        if normal:
            found.setdefault(tuple(map(tuple, normal)), (*one, other[0]))
    return list(found.values())


def _direction(name: str) -> str:
    return name.removeprefix("the direction of axis ")


def _along(a: Place, b: Place) -> tuple[Any, Any, Any]:
    """From one point to another, times their weights."""
    x, y, z = (q * a[3] - p * b[3] for p, q in zip(a[:3], b[:3], strict=True))
    return x, y, z


def _normal(a: Place, b: Place, c: Place) -> tuple[Any, Any, Any]:
    return cross(_along(a, b), _along(a, c))


def _couple(moment: Sequence[Any]) -> list[Any]:
    zero = moment[0] - moment[0]
    return [zero, zero, zero, *moment]


def _normal_of_plane(a: Place, b: Place, c: Place) -> list[Any]:
    return _couple(_normal(a, b, c))


def _normal_to_line(direction: Place, a: Place, b: Place) -> list[Any]:
    return _couple(cross(direction[:3], _along(a, b)))


def _across_meet(*given: Place) -> list[Any]:
    """Of the lines at infinity of two planes the common point, and an axis."""
    *points, axis = given
    meet = cross(_normal(*points[:3]), _normal(*points[3:]))
    return _couple(cross(axis[DIRECTION], meet))


def _parallel(through: Place, a: Place, b: Place) -> list[Any]:
    along = _along(a, b)
    return wrench_through(through, [*along, along[0] - along[0]])


def _in_plane(a: Place, b: Place, c: Place, axis: Place) -> list[Any]:
    """Through the point where an axis meets a plane: of x × d = m and N · x = N · a.

    N × (x × d) = x (N · d) − d (N · x), so that x (N · d) = N × m + (N · a) d.
    """
    normal = _normal(a, b, c)
    d, m = axis[DIRECTION], axis[MOMENT]
    height = dot(normal, a[:3])
    place = [a[3] * v + height * w for v, w in zip(cross(normal, m), d, strict=True)]
    return _parallel([*place, a[3] * dot(normal, d)], a, b)
