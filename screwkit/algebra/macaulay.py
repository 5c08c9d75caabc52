"""Common zeros of polynomials modulo a prime, by linear algebra of their multiples.

All multiples up to a degree are rows of one matrix, eliminated from the largest
monomials on; rows of lower degree that come out are multiplied again, until nothing new
does (Macaulay's matrix, with what falls in degree).  If 1 comes out there is no common
zero, complex ones included.  If every monomial of the degree is a leading one, there
are finitely many, and the others are a basis of the functions on them: the zeros are
eigenvectors of multiplication.

References: [CoxLittleOShea] §5.3 (finitely many zeros), §4.1 (Nullstellensatz).
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from math import comb
from typing import Any, Final, TypeAlias

from flint import nmod_mat

from screwkit.algebra.effort import Effort

Exponents: TypeAlias = tuple[int, ...]
Terms: TypeAlias = Mapping[Exponents, int]
"""A polynomial: residues by exponents; never empty, and none of them 0."""

WIDEST: Final = 1_300
"""Monomials of a matrix, at most."""

WORK: Final = 4_000_000_000
"""Products of residues in the eliminations of one system, at most."""


@dataclass(frozen=True)
class Multiples:
    """What multiples of polynomials imply up to a degree.

    Attributes:
        prime: The modulus.
        count: Of variables.
        degree: Of the largest monomials.
        rows: Reduced, by leading monomial.
    """

    prime: int
    count: int
    degree: int
    rows: Mapping[Exponents, Terms]

    @property
    def is_whole(self) -> bool:
        """Whether 1 is among them: there is no common zero."""
        return (0,) * self.count in self.rows

    @property
    def is_finite(self) -> bool:
        """Whether it is seen that common zeros are finitely many."""
        if not self.degree:
            return not self.count
        full = comb(self.count + self.degree - 1, self.degree)
        return full == sum(sum(lead) == self.degree for lead in self.rows)

    def below(self) -> list[Exponents]:
        """The monomials that lead no row: a basis of functions on finitely many."""
        return [m for m in monomials(self.count, self.degree) if m not in self.rows]

    def normal(self, monomial: Exponents) -> Terms:
        """A monomial of at most the degree, by those that lead no row."""
        row = self.rows.get(monomial)
        if row is None:
            return {monomial: 1}
        return {m: -c % self.prime for m, c in row.items() if m != monomial}


def multiples(
    equations: Sequence[Terms],
    count: int,
    prime: int,
    effort: Effort,
    *,
    widest: int = WIDEST,
) -> Multiples | None:
    """What multiples of polynomials imply, from low degrees on, until zeros are known.

    Args:
        equations: The polynomials.
        count: Of variables.
        prime: The modulus.
        effort: Products of residues that it may take.
        widest: Monomials that are eliminated together, at most.

    Returns:
        Whole or finite; None where neither came out within width and effort.
    """
    if any(not any(map(sum, equation)) for equation in equations):
        return Multiples(prime, count, 0, {(0,) * count: {(0,) * count: 1}})
    if not count:
        return Multiples(prime, 0, 0, {})
    degrees = [max(map(sum, equation)) for equation in equations]
    degree = min(degrees, default=0)
    # Macaulay's bound: beyond, nothing comes out unless zeros lie at infinity.
    largest = 1 + sum(own - 1 for own in sorted(degrees)[-count - 1 :])
    found: dict[Exponents, Terms] = {}
    while 0 < degree <= largest and comb(count + degree, degree) <= widest:
        fresh = [e for e, own in zip(equations, degrees, strict=True) if own == degree]
        closed = _closed(found, fresh, degree, (count, prime), effort)
        if closed is None:
            return None
        found = closed
        answer = Multiples(prime, count, degree, found)
        if answer.is_whole or answer.is_finite:
            return answer
        degree += 1
    return None


def zeros(found: Multiples, source: random.Random) -> Iterator[list[int]]:
    """Common zeros with coordinates modulo the prime: those that are simple.

    Args:
        found: Finite, and not whole.
        source: Of the linear function by which they are told apart.
    """
    basis, prime = found.below(), found.prime
    place = {monomial: number for number, monomial in enumerate(basis)}
    units = [_unit(number, found.count) for number in range(found.count)]
    weights = [source.randrange(prime) for _ in units]
    size = len(basis)
    table = [0] * size * size
    for row, monomial in enumerate(basis):
        for weight, unit in zip(weights, units, strict=True):
            for own, value in found.normal(_times(monomial, unit)).items():
                at = row * size + place[own]
                table[at] = (table[at] + weight * value) % prime
    matrix = nmod_mat(size, size, table, prime)
    one = place[(0,) * found.count]
    for root, _ in matrix.charpoly().roots():
        shifted = nmod_mat(matrix)
        for number in range(size):
            shifted[number, number] -= root
        kernel, nullity = shifted.nullspace()
        if int(nullity) != 1 or not int(kernel[one, 0]):
            continue
        scale = pow(int(kernel[one, 0]), -1, prime)
        values = [int(kernel[number, 0]) * scale % prime for number in range(size)]
        yield [
            sum(c * values[place[m]] for m, c in found.normal(unit).items()) % prime
            for unit in units
        ]


def _closed(
    known: Mapping[Exponents, Terms],
    fresh: Sequence[Terms],
    degree: int,
    sizes: tuple[int, int],
    effort: Effort,
) -> dict[Exponents, Terms] | None:
    """Reduced rows of a degree: what is known times variables, and fresh polynomials.

    None where that takes too much.
    """
    count, prime = sizes
    order = monomials(count, degree)
    units = [_unit(number, count) for number in range(count)]
    rows: list[Terms] = [*known.values(), *fresh]
    rows += _raised([r for lead, r in known.items() if sum(lead) == degree - 1], units)
    seen = {lead for lead in known if sum(lead) < degree - 1}
    while True:
        if not effort.spend(len(rows) * len(order) * min(len(rows), len(order))):
            return None
        found = _eliminated(rows, order, prime)
        fallen = [x for x in found if sum(x) < degree and x not in seen]
        if not fallen or (0,) * count in found:
            return found
        seen.update(fallen)
        rows = [*found.values(), *_raised([found[x] for x in fallen], units)]


def _raised(rows: Sequence[Terms], units: Sequence[Exponents]) -> list[Terms]:
    """Every polynomial times every variable."""
    return [{_times(m, u): c for m, c in row.items()} for row in rows for u in units]


def _eliminated(
    rows: Sequence[Terms], order: Sequence[Exponents], prime: int
) -> dict[Exponents, Terms]:
    """The reduced rows of a matrix by their leading monomials, large ones first."""
    place = {monomial: number for number, monomial in enumerate(order)}
    width = len(order)
    entries = [0] * (width * len(rows))
    for number, row in enumerate(rows):
        start = number * width
        for monomial, value in row.items():
            entries[start + place[monomial]] = value
    matrix: Any = nmod_mat(len(rows), width, entries, prime)
    reduced, rank = matrix.rref()
    values = [int(value) for value in reduced.entries()[: int(rank) * width]]
    found: dict[Exponents, Terms] = {}
    for start in range(0, len(values), width):
        own = {
            order[k]: value
            for k, value in enumerate(values[start : start + width])
            if value
        }
        found[next(iter(own))] = own
    return found


def monomials(count: int, degree: int) -> list[Exponents]:
    """All exponents of at most a degree, those of large degree first."""
    found: list[list[Exponents]] = [[(0,) * count]]
    for _ in range(degree):
        higher = dict.fromkeys(
            _times(m, _unit(k, count)) for m in found[-1] for k in range(count)
        )
        found.append(sorted(higher, reverse=True))
    return [monomial for level in reversed(found) for monomial in level]


def _unit(number: int, count: int) -> Exponents:
    return tuple(int(k == number) for k in range(count))


def _times(one: Exponents, other: Exponents) -> Exponents:
    return tuple(map(int.__add__, one, other))
