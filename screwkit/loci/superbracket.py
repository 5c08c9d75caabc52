"""The wrench system of a locked platform as six lines through points of the mechanism.

Of each limb's wrenches with the actuated joints locked, a basis of lines is looked for,
each through two of the limb's points: centres, common points of axes, points of the
file, and directions of axes as points at infinity.  Their superbracket vanishes where
the lines are dependent; incidences among the points shorten it.

References: [BenHorinShoham2006]; [McMillanWhite1991].
"""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

from screwkit.algebra.branches import Branch
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.modular import rank
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial
from screwkit.errors import ExpressionError
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.bracket_forms import Sample
from screwkit.loci.brackets import Bracket, Line, bracket
from screwkit.loci.meanings import features_of
from screwkit.screw.vector import cross

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
    """

    name: str
    coordinates: tuple[Polynomial, ...]
    ideal: bool
    arbitrary: bool = False


@dataclass(frozen=True)
class SixLines:
    """Lines through points, and the points at random postures.

    Attributes:
        points: Those that lines pass through.
        lines: Six pairs of their numbers, limb by limb.
        samples: The points at exact postures.
    """

    points: tuple[PlacedPoint, ...]
    lines: tuple[Line, ...]
    samples: tuple[Sample, ...]

    def always_in_a_plane(self, four: Bracket) -> bool:
        """Whether four points are in one plane at every posture."""
        return all(
            bracket([s.points[i] for i in four]) % s.prime == 0 for s in self.samples
        )


def six_lines(assembly: Assembly, actuated: Collection[str]) -> SixLines | str:
    """Lines that span the wrenches of the platform with the actuated joints locked.

    Returns:
        Why there are none, in words.
    """
    framed = assembly.common_twists
    root = assembly.root(framed.ring)
    if assembly.dimension != 6:
        return "the mechanism is planar"
    samples = _samples(root)
    if not samples:
        return "no exact posture was found"
    points, owners = _points(assembly, samples)
    placed = [Sample(_at(points, at, prime), prime) for at, prime in samples]
    chosen: list[Line] = []
    for number, limb in enumerate(assembly.limbs):
        passive = [joint for joint in limb.joints if joint not in actuated]
        twists = [
            [[residue(x, at, p) for x in framed.column(j)] for j in passive]
            for at, p in samples
        ]
        wanted = 6 - max(
            rank(t, s.prime) if t else 0 for t, s in zip(twists, placed, strict=True)
        )
        own = [i for i, owner in enumerate(owners) if number in owner]
        lines = _basis(wanted, own, points, twists, placed)
        if lines is None:
            return (
                f"not all wrenches of limb {limb.name} are spanned by lines through "
                f"two of its points"
            )
        chosen += lines
    if len(chosen) != 6:
        return f"the limbs have {len(chosen)} wrenches in all, not six"
    used = sorted({i for line in chosen for i in line})
    place = {old: new for new, old in enumerate(used)}
    return SixLines(
        tuple(points[i] for i in used),
        tuple((place[a], place[b]) for a, b in chosen),
        tuple(Sample([s.points[i] for i in used], s.prime) for s in placed),
    )


def _samples(root: Branch) -> list[tuple[Sequence[int], int]]:
    source = random.Random(17)
    found = [root.point(source) for _ in range(SAMPLES)]
    return [] if None in found else [p for p in found if p is not None]


def _at(
    points: Sequence[PlacedPoint], at: Sequence[int], prime: int
) -> list[tuple[int, ...]]:
    return [tuple(residue(x, at, prime) for x in p.coordinates) for p in points]


def _points(
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
    samples = _samples(assembly.root(ring))

    def homogeneous(name: str, position: Sequence[Polynomial]) -> PlacedPoint:
        cleared = ring.without_divisors([*position, ring.one])
        return PlacedPoint(name, tuple(cleared), ideal=False)

    named = []
    if framed.origin == assembly.mechanism.base:
        for name, written in assembly.mechanism.points.items():
            try:
                values = [ring.normal(evaluate(part, ring)) for part in written]
            except (ExpressionError, KeyError):
                continue
            named.append(homogeneous(name, values))
    for place in features.points:
        labels = list(place.joints)
        for joint, own in balls.items():
            if place.called == f"the centre of {joint}":
                labels += own
        point = homogeneous(place.name, place.position)
        alike = (n.name for n in named if _same(n, point, samples))
        limbs = {framed.limb_of(label) for label in labels}
        yield replace(point, name=next(alike, place.name)), limbs
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
        p, q = _at([one, other], at, prime)
        if any((p[i] * q[j] - p[j] * q[i]) % prime for i in range(4) for j in range(i)):
            return False
    return True


def _basis(
    wanted: int,
    own: Sequence[int],
    points: Sequence[PlacedPoint],
    twists: Sequence[Sequence[Sequence[int]]],
    placed: Sequence[Sample],
) -> list[Line] | None:
    """Lines through two points that are reciprocal to these twists and span so much."""
    pairs = sorted(
        combinations(own, 2),
        key=lambda pair: (
            sum(points[i].arbitrary for i in pair),
            sum(points[i].ideal for i in pair),
        ),
    )
    chosen: list[Line] = []
    for a, b in pairs:
        if len(chosen) == wanted:
            break
        reciprocal = all(
            not _power(wrench_through(s.points[a], s.points[b]), twist) % s.prime
            for own_twists, s in zip(twists, placed, strict=True)
            for twist in own_twists
        )
        if reciprocal and _independent([*chosen, (a, b)], placed[0]):
            chosen.append((a, b))
    return chosen if len(chosen) == wanted else None


def wrench_through(a: Sequence[Any], b: Sequence[Any]) -> list[Any]:
    """(f; m) along the line of two homogeneous points; a couple if both are ideal."""
    (x, v), (y, w) = (tuple(a[:3]), a[3]), (tuple(b[:3]), b[3])
    force = [v * q - w * p for p, q in zip(x, y, strict=True)]
    return [*force, *cross((x[0], x[1], x[2]), (y[0], y[1], y[2]))]


def _power(wrench: Sequence[int], twist: Sequence[int]) -> int:
    force, moment = wrench[:3], wrench[3:]
    return sum(f * v for f, v in zip(force, twist[3:], strict=True)) + sum(
        m * w for m, w in zip(moment, twist[:3], strict=True)
    )


def _independent(lines: Sequence[Line], sample: Sample) -> bool:
    rows = [
        [x % sample.prime for x in wrench_through(sample.points[a], sample.points[b])]
        for a, b in lines
    ]
    return rank(rows, sample.prime) == len(lines)
