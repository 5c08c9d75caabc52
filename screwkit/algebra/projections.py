"""Polynomials taken where a condition with a unit normal holds, without solving it.

A condition A·x + B = 0 in symbols x whose coefficients A have a constant square, such
as x·sin θ − y·cos θ + … = 0, is solved for none of them: each coefficient vanishes
somewhere.  But x − A·(A·x + B)/(A·A) meets it, and is x wherever it holds.  Put in for
x it leaves what a polynomial is on the condition, whose factors are then seen.

References: [CoxLittleOShea] §5.4 (the coordinate ring of a variety).
"""

from __future__ import annotations

from collections.abc import Collection

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
        it holds; None where no two symbols have coefficients of constant square.
    """
    if condition.is_constant() or len(condition) > _TERMS:
        return None
    degrees = condition.degrees()
    symbols = [i for i in ring.symbol_indices() if degrees[i] == 1 and i not in kept]
    normals = {i: linear_parts(ring, condition, i)[0] for i in symbols}
    free = [
        i
        for i, factor in normals.items()
        if not factor.is_constant() and not any(factor.degrees()[k] for k in symbols)
    ]
    for one in free:
        for two in free[free.index(one) + 1 :]:
            square = ring.normal(normals[one] ** 2 + normals[two] ** 2)
            if square.is_constant():
                images = tuple(
                    (
                        i,
                        ring.normal(
                            ring.context.gens()[i] * square - normals[i] * condition
                        ),
                    )
                    for i in (one, two)
                )
                return Substitution(images, square)
    return None
