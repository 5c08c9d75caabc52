"""The features of placed joints: their axes, the points where axes meet, their planes.

Exact once, and then as residues at any exact posture.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

from screwkit.algebra.points import Point as ExactPoint
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.features import Axis, Features, Point
from screwkit.screw.vector import Vector, cross, subtract


def features_at(
    exact: Features[Polynomial], point: ExactPoint, prime: int
) -> Features[Residue]:
    """The features at an exact point."""

    def at(vector: Vector[Polynomial]) -> Vector[Residue]:
        x, y, z = (Residue(residue(v, point, prime), prime) for v in vector)
        return x, y, z

    return Features(
        tuple(
            Axis(a.joint, a.limb, at(a.direction), a.point and at(a.point))
            for a in exact.axes
        ),
        tuple(replace(p, position=at(p.position)) for p in exact.points),
        exact.planes,
    )


class Residue:
    """An integer mod p with the operations of a scalar."""

    __slots__ = ("prime", "value")

    def __init__(self, value: int, prime: int) -> None:
        self.value = value
        self.prime = prime

    def __add__(self, other: Residue) -> Residue:
        return Residue((self.value + other.value) % self.prime, self.prime)

    def __sub__(self, other: Residue) -> Residue:
        return Residue((self.value - other.value) % self.prime, self.prime)

    def __mul__(self, other: Residue) -> Residue:
        return Residue(self.value * other.value % self.prime, self.prime)

    def __neg__(self) -> Residue:
        return Residue(-self.value % self.prime, self.prime)


def _passes(
    ring: TrigonometricRing, axis: Axis[Polynomial], point: Vector[Polynomial]
) -> bool:
    """Whether an axis contains a point for every posture."""
    if axis.point is None:
        return False
    offset = cross(subtract(point, axis.point), axis.direction)
    return all(ring.normal(value) == 0 for value in offset)


def features_of(framed: FramedTwists) -> Features[Polynomial]:
    """Axes, and the points in which two or more of them meet for every posture."""
    ring = framed.ring
    axes = []
    centres = {label: joint for joint, labels in framed.balls for label in labels}
    balls: dict[str, Vector[Polynomial]] = {}
    for joint, column, point in zip(
        framed.joints, framed.columns, framed.points, strict=True
    ):
        if joint in centres:
            balls.setdefault(centres[joint], point)
            continue
        turning = any(value != 0 for value in column[:3])
        direction = column[:3] if turning else column[3:]
        axes.append(
            Axis(
                joint,
                framed.limb_of(joint),
                tuple(direction),
                point if turning else None,
            )
        )
    points: list[Point[Polynomial]] = []
    for joint, centre in balls.items():
        through = tuple(a.joint for a in axes if _passes(ring, a, centre))
        limb = framed.limb_of(next(x for x in centres if centres[x] == joint))
        name = f"the centre of {joint}"
        points.append(Point(through, (), centre, name, limb))
    for axis in axes:
        if axis.point is None:
            continue
        through = tuple(
            other.joint for other in axes if _passes(ring, other, axis.point)
        )
        distinct = _distinct_directions(ring, axes, through)
        if distinct > 1 and not any(
            set(through) <= set(known.joints) for known in points
        ):
            # A centre stays: one axis through it, or none, does not fix it.
            points = [p for p in points if p.called or not set(p.joints) < set(through)]
            own = tuple(j for j in through if framed.limb_of(j) == axis.limb)
            points.append(Point(through, own, axis.point, limb=axis.limb))
    points = [_as_written(framed, point) for point in points]
    planes = []
    for number, corner in enumerate(points):
        for i in range(len(corner.joints)):
            for j in range(i + 1, len(corner.joints)):
                a, b = corner.joints[i], corner.joints[j]
                if _distinct_directions(ring, axes, (a, b)) > 1:
                    planes.append((a, b, number))
    return Features(tuple(axes), tuple(points), tuple(planes))


def bands_of(
    ring: TrigonometricRing, features: Features[Polynomial]
) -> list[tuple[str, str]]:
    """Pairs of axes that are parallel for every posture and not one line.

    None where all are parallel, as in a planar linkage.
    """
    axes = [axis for axis in features.axes if axis.point is not None]
    distinct = _distinct_directions(ring, axes, [axis.joint for axis in axes])
    return [
        (one.joint, other.joint)
        for one, other in combinations(axes, 2)
        if distinct > 1
        and all(ring.normal(x) == 0 for x in features.normal(one.joint, other.joint))
        and one.point
        and not _passes(ring, other, one.point)
    ]


def _as_written(framed: FramedTwists, point: Point[Polynomial]) -> Point[Polynomial]:
    """A point in which axes meet with the name that it has in the file."""
    if point.called:
        return point
    normal = framed.ring.normal
    for name, place in framed.places:
        if all(normal(x) == 0 for x in subtract(place, point.position)):
            return replace(point, written=name)
    return point


def _distinct_directions(
    ring: object, axes: Sequence[Axis[Polynomial]], joints: Sequence[str]
) -> int:
    directions: list[Vector[Polynomial]] = []
    for axis in axes:
        if axis.joint not in joints:
            continue
        normal = ring.normal  # type: ignore[attr-defined]
        if all(
            any(normal(v) != 0 for v in cross(axis.direction, other))
            for other in directions
        ):
            directions.append(axis.direction)
    return len(directions)
