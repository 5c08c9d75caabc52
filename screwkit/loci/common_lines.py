"""Planes of parallel axes of limbs, and where several of them have a line in common.

A limb whose parallel axes lie in one plane resists along lines in it.  Where such
planes of several limbs meet in one line the platform may turn about that, as where
lines in one plane meet in a point.  A plane is (n, e) with n·x = e on it; planes have
a line in common, or are parallel, where these vectors span two dimensions.

References: [Merlet1989]; [Hunt1978] §12.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from screwkit.algebra.branches import Branch
from screwkit.algebra.minors import minors_of_size
from screwkit.algebra.modular import rank
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.loci.features import Features, listed
from screwkit.loci.pieces import Piece
from screwkit.loci.said_together import Said, points_of
from screwkit.screw.vector import cross, dot, subtract

_LIMBS = 6


@dataclass(frozen=True)
class AxesPlane:
    """The plane of two axes that are parallel for every posture.

    Attributes:
        axes: Their names.
        column: (n, e), over the ring.
    """

    axes: tuple[str, str]
    column: tuple[Polynomial, ...]

    @property
    def name(self) -> str:
        """It in words, after ``the planes``."""
        return f"of axes {', '.join(self.axes)}"


def limb_planes(
    ring: TrigonometricRing,
    features: Features[Polynomial],
    bands: Sequence[tuple[str, str]],
) -> list[AxesPlane]:
    """One plane of each limb, of axes whose distance is shortest to write.

    Args:
        ring: Of the features.
        features: Of the mechanism.
        bands: Pairs of axes that are parallel for every posture and not one line.
    """
    found: dict[int, tuple[int, AxesPlane]] = {}
    for pair in bands:
        one, other = (features.axis(joint) for joint in pair)
        if one.limb != other.limb or one.point is None or other.point is None:
            continue
        offset = subtract(other.point, one.point)
        normal = [ring.normal(x) for x in cross(one.direction, offset)]
        height = ring.normal(dot((normal[0], normal[1], normal[2]), one.point))
        column = tuple(ring.without_divisors([*normal, height]))
        cost = sum(map(len, column))
        if one.limb not in found or cost < found[one.limb][0]:
            found[one.limb] = cost, AxesPlane(pair, column)
    return [plane for _, plane in found.values()][:_LIMBS]


def with_common_line(
    ring: TrigonometricRing, planes: Sequence[AxesPlane], root: Branch, piece: Piece
) -> Iterator[Said]:
    """Planes that have a line in common on a piece and not in general, most first."""
    at, prime = root.points[0]

    def left(chosen: Sequence[AxesPlane], at: Sequence[int], prime: int) -> int:
        return rank([[residue(x, at, prime) for x in p.column] for p in chosen], prime)

    found: list[set[tuple[str, str]]] = []
    for size in range(len(planes), 2, -1):
        for chosen in combinations(planes, size):
            own = {plane.axes for plane in chosen}
            if any(own <= known for known in found):
                continue
            if left(chosen, at, prime) > 2 and all(
                left(chosen, *place) == 2 for place in points_of(piece)
            ):
                found.append(own)
                minors = minors_of_size(ring, [p.column for p in chosen], 3)
                values = [v for v in map(ring.normal, minors) if v != 0]
                named = listed([plane.name for plane in chosen])
                words = f"the planes {named} have a line in common or are parallel"
                yield words, values
