"""What second and higher orders allow of the motions that the first order shows.

To second order the rates q of a motion satisfy Q(q, q) = 0 for every self-stress, with
Q(q, q) = Σ λ·[cᵢ, cⱼ] qᵢ qⱼ over the pairs i < j of a loop's signed screws.  The
dimension of these quadrics' common zeros bounds the finite mobility; where the zeros
are none but 0 the posture is isolated, however many rates it has.

References: [ConnellyWhiteley1996] (second-order rigidity), [LongCaroKhalil2012] eq.
(13), corrected, [CoxLittleOShea] ch. 3 §4 (when forms have no common zero).
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations_with_replacement
from typing import TypeAlias

from screwkit.algebra.modular import annihilator, echelon, rank
from screwkit.finite.chain_graph import ChainGraph, independent_cycles
from screwkit.finite.lie_closure import Span, bracket
from screwkit.finite.loop_series import curve

Form: TypeAlias = tuple[tuple[int, ...], ...]
"""Symmetric matrix of a quadratic form in the basis of rates, modulo the prime."""

MOST_VARIABLES = 6
FIRST_ORDERS = 8

HIGH_ORDERS, WIDEST = 136, 40
"""Orders to which a single motion is followed, in blocks of so many freedoms: a chain
of k mechanisms, each at a dead point of the next, opens at order 2^k only."""

LONGEST_SERIES = 5040


@dataclass(frozen=True)
class Continuation:
    """What the loops do along a generic motion of the first order.

    Attributes:
        fails_at: The first order at which they cannot be kept closed; None if none was
            met.
        checked: The order up to which they were followed.
        identical: Whether no equation can hold that far without holding identically.
    """

    fails_at: int | None
    checked: int
    identical: bool


def continuation(graph: ChainGraph) -> Continuation:
    """Follow a motion of a block as far as it takes to decide, or as is affordable."""
    along = curve(graph)
    bound = along.bound()
    identical = bound is not None and bound <= LONGEST_SERIES
    if bound is not None and identical:
        highest = bound
    else:
        alone = graph.mobility == 1 and graph.width <= WIDEST
        highest = HIGH_ORDERS if alone else FIRST_ORDERS
    return Continuation(along.order_of_failure(highest), highest, identical)


def fails_early(graph: ChainGraph) -> bool:
    """Whether a generic motion fails at one of the first orders, or is not decided."""
    along = curve(graph)
    bound = along.bound()
    if bound is None or bound > LONGEST_SERIES:
        return True
    return along.order_of_failure(min(bound, FIRST_ORDERS)) is not None


def fails_at_once(graph: ChainGraph) -> bool:
    """Whether a generic motion of the first order fails in the second."""
    return graph.mobility > 0 and curve(graph).order_of_failure(2) is not None


@lru_cache(maxsize=8)
def second_order_forms(graph: ChainGraph) -> tuple[Form, ...]:
    """The independent quadratic forms among those of the self-stresses of a block."""
    prime, rates = graph.prime, graph.rates
    count = len(graph.fundamental_cycles)
    cycles = independent_cycles(graph, graph.fundamental_cycles, count)
    rows = graph.closure_rows(cycles)
    columns = [[row.get(p, 0) for row in rows] for p in range(graph.width)]
    curvature: dict[tuple[int, int], list[int]] = {}
    for i, j in combinations_with_replacement(range(len(rates)), 2):
        curvature[i, j] = [
            x
            for cycle in cycles
            for x in _curvature(graph.word(cycle), rates[i], rates[j], prime)
        ]
    forms, span = [], Span(prime)
    for stress in annihilator(columns, len(rows), prime):
        values = {
            pair: sum(x * y for x, y in zip(stress, vector, strict=True)) % prime
            for pair, vector in curvature.items()
        }
        form = tuple(
            tuple(values[min(i, j), max(i, j)] for j in range(len(rates)))
            for i in range(len(rates))
        )
        if span.add([x for row in form for x in row]):
            forms.append(form)
    return tuple(forms)


def _curvature(
    word: Sequence[tuple[int, tuple[int, ...]]],
    first: Mapping[int, int],
    second: Mapping[int, int],
    prime: int,
) -> list[int]:
    """The bilinear form of Σ_{i<j} [cᵢ, cⱼ] qᵢ qⱼ, twice: symmetric in the rates."""
    total = [0] * 6
    for left, right in ((first, second), (second, first)):
        before = [0] * 6
        for parameter, screw in word:
            rate = right.get(parameter, 0)
            own = tuple(rate * x % prime for x in screw)
            change = bracket(tuple(before), own, prime)
            total = [(x + y) % prime for x, y in zip(total, change, strict=True)]
            rate = left.get(parameter, 0)
            before = [
                (x + rate * y) % prime for x, y in zip(before, screw, strict=True)
            ]
    return total


@lru_cache(maxsize=8)
def cone_dimension(forms: tuple[Form, ...], variables: int, prime: int) -> int:
    """Upper bound of the dimension of the common zeros of quadratic forms.

    Exact where it is below ``variables``: the least d for which the zeros on a random
    subspace of codimension d are 0 alone.  That is so if and only if the forms generate
    all monomials of degree s + 1 in the s coordinates of the subspace (Macaulay).
    """
    best = variables
    for left in range(1, min(variables, MOST_VARIABLES, len(forms)) + 1):
        if not _only_zero(_restricted(forms, variables, left, prime), left, prime):
            break
        best = variables - left
    return best


def _restricted(
    forms: Sequence[Form], variables: int, left: int, prime: int
) -> Sequence[Form]:
    """The forms on a random subspace of dimension ``left``."""
    source = random.Random(left)
    basis = [[source.randrange(prime) for _ in range(variables)] for _ in range(left)]
    found = []
    for form in forms:
        images = [
            [sum(x * y for x, y in zip(row, vector, strict=True)) for row in form]
            for vector in basis
        ]
        found.append(
            tuple(
                tuple(
                    sum(x * y for x, y in zip(vector, image, strict=True)) % prime
                    for image in images
                )
                for vector in basis
            )
        )
    return found


def _only_zero(forms: Sequence[Form], variables: int, prime: int) -> bool:
    """Whether the forms have no common zero but 0, over any extension of the field."""
    degree = variables + 1
    monomials = list(combinations_with_replacement(range(variables), degree))
    column = {monomial: number for number, monomial in enumerate(monomials)}
    pairs = list(combinations_with_replacement(range(variables), 2))
    # However many loops there are, no more are independent than there are monomials.
    quadrics = echelon(
        [[form[i][j] * (1 if i == j else 2) for i, j in pairs] for form in forms],
        prime,
    )
    rows = []
    for factor in combinations_with_replacement(range(variables), degree - 2):
        columns = [column[tuple(sorted((*factor, i, j)))] for i, j in pairs]
        for quadric in quadrics:
            row = [0] * len(monomials)
            for place, value in zip(columns, quadric, strict=True):
                row[place] = value
            rows.append(row)
    return rank(rows, prime) == len(monomials)
