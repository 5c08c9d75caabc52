"""Wrenches that span a limb's wrench system wherever its twists are independent.

From any r + 1 rows of r independent twists Cramer's rule gives a vector that
annihilates them all; together these vectors span the annihilator wherever the twists
keep their rank.  Each may be divided by the common factor of its coordinates: the
quotient is reciprocal by continuity, and often no more than a couple or a line.  Where
limbs overlap in general, the minors of these vectors are far shorter than joins of the
limbs.

References: [CoxLittleOShea] §9.1, [LongCaroKhalil2012] (26).
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import combinations
from math import comb, prod

from screwkit.algebra.branches import Branch
from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.minors import minors_of_size
from screwkit.algebra.modular import independent, rank
from screwkit.algebra.nowhere_zero import without_nowhere_zero
from screwkit.algebra.points import Point, residue
from screwkit.algebra.trigonometric import Polynomial, content

ALL = 400
"""Minors up to which all of them are taken."""

CHOICES = 12
"""Choices of vectors of which each gives minors, where there are more."""

Vector = tuple[Polynomial, ...]


def spanning_wrenches(
    branch: Branch,
    extensor: Mapping[int, Polynomial],
    height: int,
    size: int,
    library: FactorLibrary | None = None,
) -> list[Vector]:
    """Vectors that annihilate the twists of an extensor, and span all that do.

    Args:
        branch: Where the extensor is taken.
        extensor: Of ``size`` twists, by set of rows.
        height: Coordinates of a twist.
        size: Number of independent twists.
        library: Of the branch's ring; factors met before.
    """
    ring = branch.ring
    found: dict[str, Vector] = {}
    for chosen in combinations(range(height), min(size + 1, height + 1)):
        whole = sum(1 << row for row in chosen)
        vector = [ring.zero] * height
        for place, row in enumerate(chosen):
            minor = extensor.get(whole ^ 1 << row)
            if minor is not None:
                vector[row] = -minor if place % 2 else minor
        if not branch.vanishes(vector):
            kept = shortened_vector(branch, vector, library)
            found.setdefault(str(kept), kept)
    return sorted(found.values(), key=size_of)


def shortened_vector(
    branch: Branch, vector: Sequence[Polynomial], library: FactorLibrary | None
) -> Vector:
    """A vector without what vanishes nowhere, and without common factors.

    Args:
        branch: Where it is taken.
        vector: Not zero.
        library: Of the branch's ring; factors met before.
    """
    values = without_nowhere_zero(branch.ring, vector, branch.divisors)
    shorter = without_common_factors(branch.ring, values, library)
    scale = content(next(value for value in shorter if value != 0))
    return tuple(value / scale for value in shorter)


def size_of(vector: Sequence[Polynomial]) -> int:
    """Terms of all coordinates."""
    return sum(map(len, vector))


def overlap_minors(
    branch: Branch,
    vectors: Sequence[Vector],
    at: tuple[Point, int],
    dearest: int,
    longest: int,
) -> list[Polynomial]:
    """Minors of these vectors, of the size of their rank at a point.

    All of them where they are few; otherwise some, one of them not zero at the point.

    Args:
        branch: Where the vectors are taken.
        vectors: Not zero.
        at: An exact point of the branch and its prime.
        dearest: Products of terms that a minor may take.
        longest: Terms of all minors together; the first ones are taken however long.

    Returns:
        Nothing where a minor would take more products of terms.
    """
    point, prime = at
    rows = [[residue(x, point, prime) for x in vector] for vector in vectors]
    size, height = rank(rows, prime), len(vectors[0])
    every = comb(len(vectors), size) * comb(height, size) <= ALL
    source = random.Random(len(vectors))
    seen: set[tuple[int, ...]] = set()
    found: list[Polynomial] = []
    for number in range(CHOICES):
        noise = 4 if number else 0
        weights = [size_of(v) * (1 + source.uniform(0, noise)) for v in vectors]
        order = sorted(range(len(vectors)), key=weights.__getitem__)
        chosen = [order[k] for k in independent([rows[i] for i in order], prime)]
        key = tuple(sorted(chosen))
        own = [vectors[i] for i in key]
        if prod(map(size_of, own)) > dearest or sum(map(len, found)) > longest:
            break
        if every:
            return minors_of_size(branch.ring, vectors, size)
        if key not in seen:
            seen.add(key)
            found += minors_of_size(branch.ring, own, size)
    return found
