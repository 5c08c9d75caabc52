"""Null vectors without factors that only the way they were found has brought in.

Cramer's rule gives of a force F and a couple u, say, the sum v = p·F + k·u in which one
coordinate vanishes, where p is a coordinate of u.  Where p is 0 the vector v depends on
others; from that F is found again.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence

from screwkit.algebra.minors import minors_of
from screwkit.algebra.modular import independent, rank
from screwkit.algebra.points import branch_primes, random_point, residue
from screwkit.algebra.quotients import quotient_of
from screwkit.algebra.substitution import linear_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.errors import TooLargeError
from screwkit.loci.wrench_vectors import Vector, size_of

ROUNDS = 40
"""Vectors that are replaced, one after the other."""

FILLED = 20_000
"""Products of terms that one more column of a determinant may take."""


def shorter_vectors(
    ring: TrigonometricRing, vectors: Sequence[Vector], helpers: Sequence[Vector] = ()
) -> list[Vector]:
    """Vectors that span what the given ones do where these are independent, or more.

    Args:
        ring: Of the vectors, in normal form, none zero.
        vectors: Of the same length each.
        helpers: Others that may be added to them.

    Returns:
        Short ones first, none twice.
    """
    left = _sorted(vectors)
    for _ in range(ROUNDS):
        found = next(_replaced(ring, left, helpers), None)
        if found is None:
            break
        place, vector = found
        left = _sorted([*left[:place], vector, *left[place + 1 :]])
    return left


def _sorted(vectors: Sequence[Vector]) -> list[Vector]:
    return sorted({tuple(map(str, own)): own for own in vectors}.values(), key=size_of)


def _replaced(
    ring: TrigonometricRing, vectors: Sequence[Vector], helpers: Sequence[Vector]
) -> Iterator[tuple[int, Vector]]:
    """A vector by its number, and a shorter one in its place."""
    for place, vector in enumerate(vectors):
        shorter = [*vectors[:place], *helpers]
        pivots = {str(x): x for own in vectors[:place] for x in own if len(x) > 1}
        for pivot in pivots.values():
            found = _divided(ring, vector, shorter, pivot)
            if found is not None and size_of(found) < size_of(vector):
                yield place, found


def _divided(
    ring: TrigonometricRing,
    vector: Vector,
    shorter: Sequence[Vector],
    pivot: Polynomial,
) -> Vector | None:
    """(v − Σ k·u)/p as polynomials; None where there is none."""
    for index in ring.symbol_indices():
        if pivot.degrees()[index] != 1:
            continue
        slope, rest = linear_parts(ring, pivot, index)
        if not slope.is_constant():
            continue
        images = list(ring.context.gens())
        images[index] = -rest / slope
        numbers = _depends(ring, [vector, *shorter], index, images[index])
        if numbers is None:
            return None
        columns, places = numbers
        chosen = [shorter[k] for k in columns]
        there = [
            [ring.normal(own[i].compose(*images)) for i in places] for own in chosen
        ]
        wanted = [ring.normal(vector[i].compose(*images)) for i in places]
        times = _solved(ring, there, wanted)
        if times is None:
            return None
        found = []
        for i, value in enumerate(vector):
            pairs = zip(times, chosen, strict=True)
            left = ring.normal(value - sum((k * u[i] for k, u in pairs), ring.zero))
            quotient = quotient_of(ring, left, pivot)
            if quotient is None:
                return None
            found.append(quotient)
        return tuple(found) if any(x != 0 for x in found) else None
    return None


def _depends(
    ring: TrigonometricRing, vectors: Sequence[Vector], index: int, image: Polynomial
) -> tuple[list[int], list[int]] | None:
    """On which of the others the first vector depends, by which coordinates.

    Asked at a random point where a symbol has the value of its image; None where it
    depends on none of them there.
    """
    prime = branch_primes()[0]
    point = random_point(ring, random.Random(index), prime)
    if point is None:
        return None
    point = [*point]
    point[index] = residue(image, point, prime)
    first, *others = ([residue(x, point, prime) for x in vector] for vector in vectors)
    chosen = independent(others, prime)
    rows = [others[k] for k in chosen]
    if not rows or rank([*rows, first], prime) > len(rows):
        return None
    across = [[row[i] for row in rows] for i in range(len(first))]
    return chosen, independent(across, prime)


def _solved(
    ring: TrigonometricRing,
    units: Sequence[Sequence[Polynomial]],
    values: Sequence[Polynomial],
) -> list[Polynomial] | None:
    """By Cramer's rule, k with values = Σ k·units; None where one is no polynomial."""
    whole = (1 << len(values)) - 1
    try:
        below = minors_of(ring, units, FILLED).get(whole, ring.zero)
        found = []
        for number in range(len(units)):
            replaced = [*units[:number], values, *units[number + 1 :]]
            above = minors_of(ring, replaced, FILLED).get(whole, ring.zero)
            quotient = quotient_of(ring, above, below) if below != 0 else None
            if quotient is None:
                return None
            found.append(quotient)
    except TooLargeError:
        return None
    return found
