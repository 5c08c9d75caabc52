"""Polynomials taken where a condition with a unit normal holds, without solving it.

A condition A·x + B = 0 in symbols x whose coefficients A have a constant square, such
as x·sin θ − y·cos θ + … = 0, is solved for none of them: each coefficient vanishes
somewhere.  But x − A·(A·x + B)/(A·A) meets it, and is x wherever it holds.  Put in for
x it leaves what a polynomial is on the condition, whose factors are then seen.

References: [CoxLittleOShea] §5.4 (the coordinate ring of a variety).
"""

from __future__ import annotations

from collections.abc import Collection
from itertools import combinations

from screwkit.algebra.substitution import Substitution, linear_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

_TERMS = 60  # of a condition that is looked at


def projection(
    ring: TrigonometricRing, condition: Polynomial, kept: Collection[int] = ()
) -> Substitution | None:
    """The projection of some symbols onto the zeros of a condition, if it has one.

    Args:
        ring: Of the condition.
        condition: In normal form.
        kept: Indices of symbols that stay as they are.

    Returns:
        Images that meet the condition everywhere and are the symbols themselves where
        it holds; None where no two or three symbols have coefficients of constant
        square.
    """
    gens = ring.context.gens()
    found = _normal(ring, condition, kept)
    if found is None:
        return None
    normal, square = found
    images = tuple(
        (i, ring.normal(gens[i] * square - factor * condition))
        for i, factor in normal.items()
    )
    return Substitution(images, square)


def normal_of(
    ring: TrigonometricRing, condition: Polynomial, kept: Collection[int] = ()
) -> list[Polynomial]:
    """The coefficients that `projection` goes by; empty where it has none."""
    found = _normal(ring, condition, kept)
    return [] if found is None else list(found[0].values())


def _normal(
    ring: TrigonometricRing, condition: Polynomial, kept: Collection[int]
) -> tuple[dict[int, Polynomial], Polynomial] | None:
    """Coefficients by symbol, and the sum of their squares, a number."""
    if condition.is_constant() or len(condition) > _TERMS:
        return None
    degrees = condition.degrees()
    symbols = [i for i in ring.symbol_indices() if degrees[i] == 1 and i not in kept]
    factors = {i: linear_parts(ring, condition, i)[0] for i in symbols}
    free = [
        i
        for i, factor in factors.items()
        if not factor.is_constant() and not any(factor.degrees()[k] for k in symbols)
    ]
    for size in (2, 3):
        for chosen in combinations(free, size):
            square = ring.normal(sum((factors[i] ** 2 for i in chosen), ring.zero))
            if square.is_constant():
                return {i: factors[i] for i in chosen}, square
    return None
