"""Points of a mechanism by name, in homogeneous coordinates, and the joins of two.

Centres, common points of axes, points of the file, and directions of axes as points at
infinity; each once, and named as the file names it where it does.

References: [BenHorinShoham2006]; [Hunt1978] §5 for the join of two points.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

from screwkit.algebra.branches import Branch
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.features import Features
from screwkit.loci.placed_features import bands_of, features_of
from screwkit.screw.vector import cross, subtract

SAMPLES = 4
"""Random postures at which incidences are seen and forms compared."""


@dataclass(frozen=True)
class PlacedPoint:
    """A point in homogeneous coordinates.

    Attributes:
        name: In words.
        coordinates: (x, w) over the ring of all limbs; w is 0 for a direction.
        ideal: Whether it is a direction.
        arbitrary: Whether another point of its axis would do as well.
        written: Whether the file names it.
        constructed: Whether it is a direction that no axis has.
    """

    name: str
    coordinates: tuple[Polynomial, ...]
    ideal: bool
    arbitrary: bool = False
    written: bool = False
    constructed: bool = False


def sample_points(root: Branch) -> list[tuple[Sequence[int], int]]:
    """Exact postures, each with its prime; nothing where none was found."""
    source = random.Random(17)
    found = [root.point(source) for _ in range(SAMPLES)]
    return [] if None in found else [p for p in found if p is not None]


def placed_at(
    points: Sequence[PlacedPoint], at: Sequence[int], prime: int
) -> list[tuple[int, ...]]:
    """Their homogeneous coordinates at an exact posture."""
    return [tuple(residue(x, at, prime) for x in p.coordinates) for p in points]


def placed_points(
    assembly: Assembly, samples: Sequence[tuple[Sequence[int], int]]
) -> tuple[list[PlacedPoint], list[set[int]]]:
    """Points and directions, each once, and the limbs that each belongs to."""
    points: list[PlacedPoint] = []
    owners: list[set[int]] = []
    for point, limbs in _candidates(assembly):
        known = next(
            (i for i, other in enumerate(points) if _same(point, other, samples)), None
        )
        if known is None:
            points.append(point)
            owners.append(set(limbs))
        else:
            owners[known] |= limbs
    return points, owners


def _candidates(assembly: Assembly) -> Iterator[tuple[PlacedPoint, set[int]]]:
    framed = assembly.common_twists
    ring = framed.ring
    features = features_of(framed)
    balls = dict(framed.balls)
    samples = sample_points(assembly.root(ring))

    def homogeneous(name: str, position: Sequence[Polynomial]) -> PlacedPoint:
        cleared = ring.without_divisors([*position, ring.one])
        return PlacedPoint(name, tuple(cleared), ideal=False)

    named = [
        replace(homogeneous(name, place), written=True) for name, place in framed.places
    ]
    for place in features.points:
        labels = list(place.joints)
        for joint, own in balls.items():
            if place.called == f"the centre of {joint}":
                labels += own
        point = homogeneous(place.name, place.position)
        alike = (n for n in named if _same(n, point, samples))
        limbs = {framed.limb_of(label) for label in labels}
        known = next(alike, point)
        yield replace(point, name=known.name, written=known.written), limbs
    for axis in features.axes:
        if axis.point is None:
            continue
        point = homogeneous(f"a point of axis {axis.joint}", axis.point)
        same = (n for n in named if _same(n, point, samples))
        yield next(same, replace(point, arbitrary=True)), {axis.limb}
    for axis in features.axes:
        direction = ring.without_divisors([*axis.direction, ring.zero])
        name = f"the direction of axis {axis.joint}"
        yield PlacedPoint(name, tuple(direction), ideal=True), {axis.limb}


def _same(
    one: PlacedPoint, other: PlacedPoint, samples: Sequence[tuple[Sequence[int], int]]
) -> bool:
    """Whether two points coincide at every posture."""
    if one.ideal != other.ideal:
        return False
    for at, prime in samples:
        p, q = placed_at([one, other], at, prime)
        if any((p[i] * q[j] - p[j] * q[i]) % prime for i in range(4) for j in range(i)):
            return False
    return True


def normal_directions(
    points: Sequence[PlacedPoint], own: Sequence[int], ring: TrigonometricRing
) -> list[PlacedPoint]:
    """The directions normal to two of a limb's own."""
    ideal = [points[i] for i in own if points[i].ideal]
    found = []
    for one, other in combinations(ideal, 2):
        a, b = one.coordinates, other.coordinates
        normal = cross((a[0], a[1], a[2]), (b[0], b[1], b[2]))
        values = [*map(ring.normal, normal), ring.zero]
        if all(value == 0 for value in values):
            continue
        first, second = (
            p.name.removeprefix("the direction of axis ") for p in (one, other)
        )
        name = f"normal to axes {first} and {second}"
        coordinates = tuple(ring.without_divisors(values))
        found.append(PlacedPoint(name, coordinates, ideal=True, constructed=True))
    return found


def common_normals(
    features: Features[Polynomial], limb: int, ring: TrigonometricRing
) -> list[PlacedPoint]:
    """The directions from one axis of a limb to another that is parallel to it."""
    found = []
    for i, j in bands_of(ring, features):
        one, other = features.axis(i), features.axis(j)
        if one.limb != limb or other.limb != limb:
            continue
        assert one.point is not None
        assert other.point is not None
        offset = subtract(other.point, one.point)
        across = cross(one.direction, cross(offset, one.direction))
        values = [*map(ring.normal, across), ring.zero]
        name = f"along the common normal of axes {i} and {j}"
        coordinates = tuple(ring.without_divisors(values))
        found.append(PlacedPoint(name, coordinates, ideal=True, constructed=True))
    return found


def wrench_through(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    """(f; m) along the line of two homogeneous points; a couple if both are ideal."""
    (x, v), (y, w) = (tuple(a[:3]), a[3]), (tuple(b[:3]), b[3])
    force = [v * q - w * p for p, q in zip(x, y, strict=True)]
    return [*force, *cross((x[0], x[1], x[2]), (y[0], y[1], y[2]))]


def power(wrench: Sequence[int], twist: Sequence[int]) -> int:
    """f·v + m·ω of a wrench (f; m) and a twist (ω; v)."""
    force, moment = wrench[:3], wrench[3:]
    return sum(f * v for f, v in zip(force, twist[3:], strict=True)) + sum(
        m * w for m, w in zip(moment, twist[:3], strict=True)
    )
