"""In which unknowns conditions that were not solved are met by roots."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import combinations

from screwkit.algebra.linear_systems import has_solutions, linear_systems
from screwkit.algebra.points_on import Unknown, degree_in, unknowns
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.certificates.equations_told import Unsolved


class NotProvedError(Exception):
    """No proof was found; the text says where the search ended."""


def roots_of(
    ring: TrigonometricRing,
    conditions: Sequence[Polynomial],
    nonzero: Collection[int] = (),
) -> tuple[Unsolved, ...]:
    """Conditions in an order in which each has an unknown that the earlier lack.

    Args:
        ring: Of the conditions.
        conditions: What is to be met.
        nonzero: Indices of generators that are not 0.

    Raises:
        NotProvedError: If there is no such order.
    """
    left, found = list(conditions), list[Unsolved]()
    while left:
        for position, condition in enumerate(left):
            others = [c for i, c in enumerate(left) if i != position]
            used = {u for c in others for u in unknowns(ring, c)}
            own = [u for u in unknowns(ring, condition) if u not in used]
            if own:
                found.append(_unsolved(ring, left.pop(position), own[0]))
                break
        else:
            found.append(_together(ring, left, nonzero) or _pair(ring, left))
    return tuple(reversed(found))


def _together(
    ring: TrigonometricRing, left: list[Polynomial], nonzero: Collection[int]
) -> Unsolved | None:
    """Conditions linear in as many symbols, which the others lack; taken out."""
    systems = [s for s in linear_systems(ring, left) if has_solutions(left, s, nonzero)]
    if not systems:
        return None
    conditions, symbols = systems[0].conditions, systems[0].symbols
    taken = [
        replace(_unsolved(ring, left[k], ("x", index)), degree=1)
        for k, index in zip(conditions, symbols, strict=True)
    ]
    left[:] = [c for k, c in enumerate(left) if k not in conditions]
    return replace(taken[0], together=tuple(taken[1:]))


def _pair(ring: TrigonometricRing, left: list[Polynomial]) -> Unsolved:
    """Two conditions that share two unknowns which the others lack; taken out."""
    for one, two in combinations(range(len(left)), 2):
        others = [c for i, c in enumerate(left) if i not in (one, two)]
        used = {u for c in others for u in unknowns(ring, c)}
        shared = {*unknowns(ring, left[one])} & {*unknowns(ring, left[two])} - used
        if len(shared) < 2:
            continue
        second, first = left.pop(two), left.pop(one)
        u, v = sorted(shared)[:2]
        across = _degree(ring, first, v), _degree(ring, second, u)
        beside = _unsolved(ring, second, v)
        return replace(_unsolved(ring, first, u), beside=beside, across=across)
    raise NotProvedError("no order was found in which conditions can be met by roots")


def _degree(ring: TrigonometricRing, condition: Polynomial, unknown: Unknown) -> int:
    """In a symbol, or in sine and cosine of an angle together."""
    found = degree_in(ring, condition, unknown)
    return found if unknown[0] == "x" else found // 2


def _unsolved(
    ring: TrigonometricRing, condition: Polynomial, unknown: Unknown
) -> Unsolved:
    kind, number = unknown
    written, degree = text(ring, condition), _degree(ring, condition, unknown)
    if kind == "x":
        symbol = ring.symbols[number - ring.symbol_indices().start]
        return Unsolved(written, symbol=symbol, degree=degree)
    return Unsolved(written, angle=number, degree=degree)
