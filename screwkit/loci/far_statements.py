"""Statements across limbs, for postures at which several things hold together.

A plane may be that of two axes which are parallel for every posture; a line through a
point of one limb may be parallel to an axis of a second and meet one of a third.  There
are many of these, and each says little: they are looked at where the catalogue of
`features` does not suffice.

References: [Merlet1989].
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product

from screwkit.algebra.ring import S
from screwkit.loci.features import Axis, Features, Statement
from screwkit.screw.vector import Vector, cross, dot, subtract

MOST = 4_000
"""Statements that are looked at."""

_BANDS = 24  # planes of parallel axes

Pair = tuple[str, str]


def far_statements(features: Features[S], bands: Sequence[Pair]) -> list[Statement]:
    """All of them, simplest first; none where they are too many.

    Args:
        features: Of the mechanism.
        bands: Pairs of axes that are parallel for every posture, and not one line.
    """
    found = [*_of_bands(features, bands[:_BANDS]), *_of_lines(features)]
    return found if len(found) <= MOST else []


def _of_bands(features: Features[S], bands: Sequence[Pair]) -> Iterator[Statement]:
    for one, other in combinations(bands, 2):
        yield from _two_planes(_Plane(one, band=True), _Plane(other, band=True))
    for band, (i, j, _) in product(bands, features.planes):
        yield from _two_planes(_Plane(band, band=True), _Plane((i, j), band=False))
    for (i, j), p in product(bands, range(len(features.points))):
        point = features.points[p]
        if not {i, j} & {*point.joints}:
            words = f"{point.name} lies in the plane of axes {i}, {j}"
            joints = (*point.own, i, j)
            yield Statement("in plane", words, joints, _point_in_band(p, i, j))


@dataclass(frozen=True)
class _Plane:
    """Of two axes that are parallel for every posture, or meet."""

    axes: Pair
    band: bool

    def normal(self, features: Features[S]) -> Vector[S]:
        i, j = self.axes
        return _across_band(features, i, j) if self.band else features.normal(i, j)


def _two_planes(one: _Plane, other: _Plane) -> Iterator[Statement]:
    joints = (*one.axes, *other.axes)
    if len({*joints}) < 4:
        return
    first, second = (", ".join(plane.axes) for plane in (one, other))
    words = f"the planes of axes {first} and of axes {second} are"

    def parallel(features: Features[S]) -> Sequence[S]:
        return cross(one.normal(features), other.normal(features))

    def perpendicular(features: Features[S]) -> Sequence[S]:
        return [dot(one.normal(features), other.normal(features))]

    yield Statement("planes", f"{words} parallel", joints, parallel)
    yield Statement("normal planes", f"{words} perpendicular", joints, perpendicular)


def _of_lines(features: Features[S]) -> Iterator[Statement]:
    lines = [axis for axis in features.axes if axis.point is not None]
    for p, axis, line in product(range(len(features.points)), features.axes, lines):
        point = features.points[p]
        limbs = {point.limb, axis.limb, line.limb}
        if axis is line or line.joint in point.joints or len(limbs) < 2:
            continue
        i, k = axis.joint, line.joint
        words = f"the line through {point.name} parallel to axis {i} meets axis {k}"
        yield Statement(
            "parallel meets", words, (*point.own, i, k), _parallel_meets(p, i, k)
        )


def _place(axis: Axis[S]) -> Vector[S]:
    assert axis.point is not None
    return axis.point


def _across_band(features: Features[S], i: str, j: str) -> Vector[S]:
    """The normal of the plane of two parallel axes."""
    a, b = features.axis(i), features.axis(j)
    return cross(a.direction, subtract(_place(b), _place(a)))


def _point_in_band(p: int, i: str, j: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        offset = subtract(features.points[p].position, _place(features.axis(i)))
        return [dot(_across_band(features, i, j), offset)]

    return scalars


def _parallel_meets(p: int, i: str, k: str) -> Callable[[Features[S]], Sequence[S]]:
    def scalars(features: Features[S]) -> Sequence[S]:
        offset = subtract(features.points[p].position, _place(features.axis(k)))
        return [dot(features.normal(i, k), offset)]

    return scalars
