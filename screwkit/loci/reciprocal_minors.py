"""Where wrenches of some limbs become reciprocal to the twists of another.

Wrenches w_1, w_2, ... of all limbs but one add up to a wrench of that one exactly where
their sum is reciprocal to its twists t_j.  So the limbs' wrench systems are dependent
exactly where the reciprocal products t_j·w_i have less than their rank, w_i spanning
the systems of the others, each as large as in general.  These products do not depend on
the frame, and their minors are as small as the other limbs' systems: of two limbs, one
with a single wrench, they are the products themselves.  Where the systems do not
overlap in general, a minor is the meet of the others' twists with some twists of the
one, and free of the choice of w_i.

References: [LongCaroKhalil2012] (26); [Hunt1978] §12; [CoxLittleOShea] §9.1.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import reduce
from itertools import combinations
from math import comb

from screwkit.algebra.branches import Branch
from screwkit.algebra.minors import dual, joined, minors_of
from screwkit.algebra.nowhere_zero import without_nowhere_zero
from screwkit.algebra.points import Point, residue
from screwkit.algebra.trigonometric import Polynomial, content
from screwkit.loci.wrench_vectors import Vector, overlap_minors

PRODUCTS = 100_000
"""Of terms, in one reciprocal product or meet."""

CHOICES = 60
"""Choices of twists of one limb."""

Extensor = Mapping[int, Polynomial]


def largest_systems(counts: Sequence[int]) -> list[int]:
    """Positions of the limbs that leave the fewest wrenches to the others."""
    return [i for i, count in enumerate(counts) if count == max(counts)]


def reciprocal_meets(
    branch: Branch,
    limbs: Sequence[Sequence[Vector]],
    extensors: Sequence[Extensor],
    height: int,
) -> list[Polynomial]:
    """Zero together where the wrenches of limbs without overlap become dependent.

    Args:
        branch: Where everything is taken.
        limbs: The twists of each limb.
        extensors: Of these twists; each system is as large as it is here.
        height: Coordinates of a twist.

    Returns:
        Those with the twists of a limb that has most wrenches; nothing where they are
        too many or too long.
    """
    ring = branch.ring
    counts = [height - next(iter(e)).bit_count() for e in extensors]
    found: list[list[Polynomial]] = []
    for number in largest_systems(counts):
        own: list[Polynomial] = []
        twists = limbs[number]
        size = sum(counts) - counts[number]
        if size > len(twists) or comb(len(twists), size) > CHOICES:
            return []
        wrenches = _joined_wrenches(branch, extensors, number, height)
        if wrenches is None:
            return []
        for chosen in combinations(twists, size):
            minors = minors_of(ring, chosen)
            pairs = [
                (minors[rows], w) for rows, w in wrenches.items() if rows in minors
            ]
            if sum(len(a) * len(b) for a, b in pairs) > PRODUCTS:
                return []
            value = ring.normal(sum((a * b for a, b in pairs), ring.zero))
            if value != 0:
                own += without_nowhere_zero(ring, [value], branch.divisors)
        found.append(own)
    return min(found, key=lambda own: sum(map(len, own)))


def _joined_wrenches(
    branch: Branch, extensors: Sequence[Extensor], left_out: int, height: int
) -> Extensor | None:
    """What the wrenches of all limbs but one span; None where that is too long."""
    ring = branch.ring
    others = [dual(ring, e, height) for i, e in enumerate(extensors) if i != left_out]
    sizes = [sum(map(len, e.values())) for e in others]
    if reduce(lambda a, b: a * b, sizes, 1) > PRODUCTS:
        return None
    return reduce(lambda a, b: joined(ring, a, b), others)


def reciprocal_minors(
    branch: Branch,
    limbs: Sequence[Sequence[Vector]],
    wrenches: Sequence[Sequence[Vector]],
    counts: Sequence[int],
    at: tuple[Point, int],
    longest: int,
) -> list[Polynomial]:
    """Minors of the reciprocal products of one limb's twists with others' wrenches.

    Args:
        branch: Where everything is taken.
        limbs: The twists of each limb.
        wrenches: Of each limb, spanning all that are reciprocal to its twists.
        counts: Dimension of each limb's wrench system.
        at: An exact point of the branch and its prime.
        longest: Products of terms in a minor, and terms of all of them.

    Returns:
        Of those limbs that leave the fewest wrenches to the others; one is not zero at
        the point.  Nothing where they are too long.
    """
    found: list[Polynomial] = []
    for number in largest_systems(counts):
        others = [w for i, own in enumerate(wrenches) if i != number for w in own]
        columns = _products(branch, limbs[number], others)
        if columns is None:
            return []
        columns = [c for c in columns if any(residue(x, *at) for x in c)]
        if columns:
            found += overlap_minors(branch, columns, at, longest, longest)
    return found


def _products(
    branch: Branch, twists: Sequence[Vector], wrenches: Sequence[Vector]
) -> list[Vector] | None:
    """For each wrench its products with all twists, up to what is nowhere zero."""
    ring = branch.ring
    found: list[Vector] = []
    for wrench in wrenches:
        column = []
        for twist in twists:
            pairs = list(zip(twist, wrench, strict=True))
            if sum(len(a) * len(b) for a, b in pairs) > PRODUCTS:
                return None
            column.append(ring.normal(sum((a * b for a, b in pairs), ring.zero)))
        column = without_nowhere_zero(ring, column, branch.divisors)
        scale = content(next((x for x in column if x != 0), ring.one))
        found.append(tuple(x / scale for x in column))
    return found
