"""Subspaces of vectors over a prime field whose entries have names.

Rates are named by their freedom, wrenches of a self-stress by joint and coordinate, so
that a vector is a mapping without its zeros.  Every choice here depends on nothing but
which entries vanish: the same rational space gives the same rational basis modulo each
prime.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeAlias, TypeVar

K = TypeVar("K")
Named: TypeAlias = Mapping[K, int]


@dataclass(frozen=True)
class _Mark:
    """The name of an entry that is no coordinate."""

    number: int


class Span(Generic[K]):
    """A space that grows by the vectors that are independent of it."""

    def __init__(self, prime: int, vectors: Iterable[Named[K]] = ()) -> None:
        self.prime = prime
        self._pivots: dict[K, dict[K, int]] = {}
        for vector in vectors:
            self.add(vector)

    def __len__(self) -> int:
        """Its dimension."""
        return len(self._pivots)

    @property
    def pivots(self) -> Collection[K]:
        """Entries that tell its vectors apart."""
        return self._pivots.keys()

    def rest(self, vector: Named[K]) -> dict[K, int]:
        """The vector less what lies in the space; empty if all of it does."""
        left = dict(vector)
        for pivot, row in self._pivots.items():
            if pivot in left:
                _subtract(left, left[pivot], row, self.prime)
        return left

    def add(self, vector: Named[K]) -> bool:
        """Take a vector in; False if it is there already."""
        left = self.rest(vector)
        if left:
            pivot = next(iter(left))
            self._pivots[pivot] = _scaled(left, pivot, self.prime)
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


def least_outside(
    space: Sequence[Named[K]], groups: Iterable[Collection[K]], known: Span[K]
) -> list[dict[K, int]]:
    """A part of a space that is not known and has entries in as few groups as can be.

    Groups are given up one after the other as long as something unknown is left, so
    that none of the groups kept can be spared.

    Args:
        space: A basis; not all of it known.
        groups: Entries that vanish together, those to give up first in front.
        known: What is known; its prime is that of the space.
    """
    rests = [known.rest(vector) for vector in space]
    pivots = list(Span(known.prime, rests).pivots)
    # Marks go along with every combination and vanish where it is known.
    left: list[dict[Any, int]] = [
        {**vector, **{_Mark(i): rest[p] for i, p in enumerate(pivots) if p in rest}}
        for vector, rest in zip(space, rests, strict=True)
    ]
    marks = [_Mark(i) for i in range(len(pivots))]
    for group in groups:
        without = vanishing(left, group, known.prime)
        if any(mark in vector for vector in without for mark in marks):
            left = without
    return [
        {key: value for key, value in vector.items() if not isinstance(key, _Mark)}
        for vector in left
    ]


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
