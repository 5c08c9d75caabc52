"""Where wrenches of some limbs become reciprocal to the twists of another.

Wrenches w_1, w_2, ... of all limbs but one add up to a wrench of that one exactly where
their sum is reciprocal to its twists t_j.  So limbs whose wrench systems are
independent in general are dependent exactly where every meet of the others' twists with
as many t_j as they have wrenches vanishes, each system as large as in general.  These
meets do not depend on the frame and contain no choice of w_i; of two limbs, one with a
single wrench, they are the reciprocal products t_j·w.

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
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.wrench_vectors import Vector

PRODUCTS = 100_000
"""Of terms, in one reciprocal product or meet."""

CHOICES = 60
"""Choices of twists of one limb."""

Extensor = Mapping[int, Polynomial]


def _largest(counts: Sequence[int]) -> list[int]:
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
        Those with the twists of a limb that has most wrenches, or the join of all
        wrenches, whichever contain less; nothing where they are too many or too long.
    """
    ring = branch.ring
    counts = [height - next(iter(e)).bit_count() for e in extensors]
    found: list[list[Polynomial]] = []
    for number in _largest(counts):
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
    joins = _joined_wrenches(branch, extensors, None, height)
    if joins is not None:
        found.append([*joins.values()])
    return min(found, key=how_long)


def how_long(polynomials: Sequence[Polynomial]) -> tuple[int, int]:
    """How many generators they contain, and how many terms they have."""
    degrees = [polynomial.degrees() for polynomial in polynomials]
    places = range(len(degrees[0]) if degrees else 0)
    contained = sum(any(d[place] for d in degrees) for place in places)
    return contained, sum(map(len, polynomials))


def _joined_wrenches(
    branch: Branch, extensors: Sequence[Extensor], left_out: int | None, height: int
) -> Extensor | None:
    """What the wrenches of all limbs but one span; None where that is too long."""
    ring = branch.ring
    others = [dual(ring, e, height) for i, e in enumerate(extensors) if i != left_out]
    sizes = [sum(map(len, e.values())) for e in others]
    if reduce(lambda a, b: a * b, sizes, 1) > PRODUCTS:
        return None
    return reduce(lambda a, b: joined(ring, a, b), others)
