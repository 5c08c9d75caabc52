"""Subspaces of vectors over a prime field whose entries have names.

Rates are named by their freedom, wrenches of a self-stress by joint and coordinate, so
that a vector is a mapping without its zeros.  Every choice here depends on nothing but
which entries vanish: the same rational space gives the same rational basis modulo each
prime.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from typing import Any, Generic, TypeAlias, TypeVar

K = TypeVar("K")
Named: TypeAlias = Mapping[K, int]


class Span(Generic[K]):
    """A space that grows by the vectors that are independent of it."""

    def __init__(self, prime: int, vectors: Iterable[Named[K]] = ()) -> None:
        self._prime = prime
        self._pivots: dict[K, dict[K, int]] = {}
        for vector in vectors:
            self.add(vector)

    def __len__(self) -> int:
        """Its dimension."""
        return len(self._pivots)

    def rest(self, vector: Named[K]) -> dict[K, int]:
        """The vector less what lies in the space; empty if all of it does."""
        left = dict(vector)
        for pivot, row in self._pivots.items():
            if pivot in left:
                _subtract(left, left[pivot], row, self._prime)
        return left

    def add(self, vector: Named[K]) -> bool:
        """Take a vector in; False if it is there already."""
        left = self.rest(vector)
        if left:
            pivot = next(iter(left))
            self._pivots[pivot] = _scaled(left, pivot, self._prime)
        return bool(left)


def reduced_echelon(
    vectors: Iterable[Named[K]], prime: int, order: Callable[[K], Any]
) -> list[dict[K, int]]:
    """The reduced echelon basis, entries in this order; pivots are 1 and ascend."""
    rows: list[tuple[K, dict[K, int]]] = []
    for vector in vectors:
        left = dict(vector)
        for pivot, row in rows:
            if pivot in left:
                _subtract(left, left[pivot], row, prime)
        if not left:
            continue
        own = min(left, key=order)
        left = _scaled(left, own, prime)
        for _, row in rows:
            if own in row:
                _subtract(row, row[own], left, prime)
        rows.append((own, left))
    return [row for _, row in sorted(rows, key=lambda row: order(row[0]))]


def vanishing(
    vectors: Sequence[Named[K]], keys: Collection[K], prime: int
) -> list[dict[K, int]]:
    """Basis of the part of a space whose entries at ``keys`` are all zero.

    Args:
        vectors: A basis of the space.
        keys: In any order; the result is the same space.
        prime: The modulus.
    """
    left = [dict(vector) for vector in vectors]
    for key in keys:
        holding = [vector for vector in left if key in vector]
        if not holding:
            continue
        pivot = min(holding, key=len)
        left = [vector for vector in left if vector is not pivot]
        scaled = _scaled(pivot, key, prime)
        for vector in left:
            if key in vector:
                _subtract(vector, vector[key], scaled, prime)
    return left


def complement(
    space: Iterable[Named[K]],
    known: Iterable[Named[K]],
    prime: int,
    order: Callable[[K], Any],
) -> list[dict[K, int]]:
    """What a space adds to a part of it: reduced, zero at the pivots of the part."""
    part = reduced_echelon(known, prime, order)
    pivots = [min(row, key=order) for row in part]
    rest = []
    for vector in space:
        left = dict(vector)
        for pivot, row in zip(pivots, part, strict=True):
            if pivot in left:
                _subtract(left, left[pivot], row, prime)
        rest.append(left)
    return reduced_echelon(rest, prime, order)


def _subtract(target: dict[K, int], factor: int, row: Named[K], prime: int) -> None:
    for key, value in row.items():
        left = (target.get(key, 0) - factor * value) % prime
        if left:
            target[key] = left
        else:
            target.pop(key, None)


def _scaled(row: Named[K], pivot: K, prime: int) -> dict[K, int]:
    inverse = pow(row[pivot], -1, prime)
    return {key: value * inverse % prime for key, value in row.items()}
