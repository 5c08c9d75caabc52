"""How many terms a determinant of limbs has, told before it is multiplied out.

The join of the limbs' wrenches is linear in each limb's extensor.  Symbols that one
limb alone contains, such as the coordinates of its own points, therefore part its
monomials: for every choice of one monomial in such symbols from each limb, what stands
beside it is the join of the coefficients, in the symbols that limbs share, and no two
choices have a monomial in common.  So the number of terms is a sum over all choices,
and a random sample of them tells it without bias, like Knuth's estimate of the size of
a search tree.  Choices of long coefficients are drawn more often and count less.

References: [Knuth1975].
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence
from math import prod, sqrt
from statistics import mean, stdev
from typing import Any, TypeAlias

from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

Extensor: TypeAlias = Mapping[int, Polynomial]

SAMPLE = 500
"""Choices that are multiplied out, at most."""

FEWEST, EXACT = 50, 0.1
"""Choices with terms that suffice where the standard error is this part of the mean."""

DEAREST = 4_000_000
"""Terms of all that is multiplied out, after which the sample is taken as it is."""


def predicted_terms(
    ring: TrigonometricRing,
    limbs: Sequence[Extensor],
    expand: Callable[[Sequence[Extensor]], Sequence[Polynomial]],
) -> int | None:
    """About how many terms the minors of some extensors have together.

    Args:
        ring: Of the coordinates.
        limbs: An extensor of each limb.
        expand: Linear in each extensor: its minors.

    Returns:
        The mean of a sample, times the number of choices; the same every time.  None
        where there are no more choices than are sampled: expanding is no more work.
    """
    parts = [
        _parted(ring, limb, _own(limb, [*limbs[:k], *limbs[k + 1 :]]))
        for k, limb in enumerate(limbs)
    ]
    if prod(map(len, parts)) <= SAMPLE:
        return None
    weights = [[sqrt(_size(part)) for part in own] for own in parts]
    totals = [sum(own) for own in weights]
    source = random.Random(len(limbs))
    told: list[float] = []
    dear = 0
    while len(told) < SAMPLE and dear < DEAREST and not _is_exact(told):
        drawn = [source.choices(range(len(own)), own)[0] for own in weights]
        chosen = [own[k] for own, k in zip(parts, drawn, strict=True)]
        terms = sum(map(len, expand(chosen)))
        dear += terms
        chances = zip(weights, drawn, totals, strict=True)
        told.append(terms / prod(own[k] / total for own, k, total in chances))
    return round(mean(told))


def _size(extensor: Extensor) -> int:
    return sum(map(len, extensor.values()))


def _is_exact(told: Sequence[float]) -> bool:
    """Whether a sample's standard error is small against its mean."""
    if sum(map(bool, told)) < FEWEST:
        return False
    return stdev(told) <= EXACT * mean(told) * sqrt(len(told))


def _own(limb: Extensor, others: Sequence[Extensor]) -> list[int]:
    """The generators that occur in one limb alone."""
    mine = _occurring([limb])
    return sorted(mine - _occurring(others))


def _occurring(limbs: Sequence[Extensor]) -> set[int]:
    return {
        index
        for limb in limbs
        for value in limb.values()
        for index, degree in enumerate(value.degrees())
        if degree > 0
    }


def _parted(
    ring: TrigonometricRing, limb: Extensor, own: Sequence[int]
) -> list[Extensor]:
    """The coefficients of each monomial in the limb's own generators."""
    parts: dict[tuple[int, ...], dict[int, dict[tuple[int, ...], Any]]] = {}
    for rows, value in limb.items():
        for exponents, coefficient in value.to_dict().items():
            key = tuple(int(exponents[i]) for i in own)
            rest = tuple(0 if i in own else e for i, e in enumerate(exponents))
            parts.setdefault(key, {}).setdefault(rows, {})[rest] = coefficient
    return [
        {rows: ring.context.from_dict(terms) for rows, terms in part.items()}
        for part in parts.values()
    ]
