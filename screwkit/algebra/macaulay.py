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
from typing import Final

from flint import nmod_mat

from screwkit.algebra.echelon_modulo import Echelon
from screwkit.algebra.effort import Effort
from screwkit.algebra.monomials import (
    Exponents,
    Terms,
    degree_of,
    monomials,
    raised,
    times,
    unit,
)

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
    away: Sequence[Terms] = (),
) -> Multiples | None:
    """What multiples of polynomials imply, from low degrees on, until zeros are known.

    Args:
        equations: The polynomials.
        count: Of variables.
        prime: The modulus.
        effort: Products of residues that it may take.
        widest: Monomials that are eliminated together, at most.
        away: Polynomials whose zeros are left out (`Echelon.quotients`).

    Returns:
        Whole or finite; None where neither came out within width and effort.
    """
    if any(not any(map(sum, equation)) for equation in equations):
        return Multiples(prime, count, 0, {(0,) * count: {(0,) * count: 1}})
    if not count:
        return Multiples(prime, 0, 0, {})
    rows = echelon_of(equations, count, prime, effort, widest=widest, away=away)
    if rows.degree < 0 or not (rows.is_whole or rows.is_finite):
        return None
    return Multiples(prime, count, rows.degree, rows.rows())


def echelon_of(
    equations: Sequence[Terms],
    count: int,
    prime: int,
    effort: Effort,
    *,
    widest: int = WIDEST,
    away: Sequence[Terms] = (),
) -> Echelon:
    """The rows that `multiples` comes to, be they whole, finite or neither.

    Args:
        equations: The polynomials, none of them constant.
        count: Of variables, at least one.
        prime: The modulus.
        effort: See `multiples`, as the others.
        widest: The same.
        away: The same.
    """
    degrees = [degree_of(equation) for equation in equations]
    degree = min(degrees, default=0)
    # Macaulay's bound: beyond, nothing comes out unless zeros lie at infinity.
    largest = 1 + sum(own - 1 for own in sorted(degrees)[-count - 1 :])
    rows = Echelon(count, prime, effort)
    while 0 < degree <= largest and comb(count + degree, degree) <= widest:
        fresh = [e for e, own in zip(equations, degrees, strict=True) if own == degree]
        if not _closed(rows, fresh, degree, away) or rows.is_whole or rows.is_finite:
            break
        degree += 1
    return rows


def zeros(found: Multiples, source: random.Random) -> Iterator[list[int]]:
    """Common zeros with coordinates modulo the prime: those that are simple.

    Args:
        found: Finite, and not whole.
        source: Of the linear function by which they are told apart.
    """
    basis, prime = found.below(), found.prime
    place = {monomial: number for number, monomial in enumerate(basis)}
    units = [unit(number, found.count) for number in range(found.count)]
    weights = [source.randrange(prime) for _ in units]
    size = len(basis)
    table = [0] * size * size
    for row, monomial in enumerate(basis):
        for weight, one in zip(weights, units, strict=True):
            for own, value in found.normal(times(monomial, one)).items():
                at = row * size + place[own]
                table[at] = (table[at] + weight * value) % prime
    matrix = nmod_mat(size, size, table, prime)
    constant = place[(0,) * found.count]
    for root, _ in matrix.charpoly().roots():
        shifted = nmod_mat(matrix)
        for number in range(size):
            shifted[number, number] -= root
        kernel, nullity = shifted.nullspace()
        if int(nullity) != 1 or not int(kernel[constant, 0]):
            continue
        scale = pow(int(kernel[constant, 0]), -1, prime)
        values = [int(kernel[number, 0]) * scale % prime for number in range(size)]
        yield [
            sum(c * values[place[m]] for m, c in found.normal(one).items()) % prime
            for one in units
        ]


def _closed(
    rows: Echelon, fresh: Sequence[Terms], degree: int, away: Sequence[Terms]
) -> bool:
    """Take up all multiples of a degree; whether that did not take too much.

    With what falls in degree, and what is left where some polynomials are not zero.
    """
    units = [unit(number, rows.count) for number in range(rows.count)]
    lower = [rows.row(lead) for lead in rows.leads if sum(lead) == degree - 1]
    rows.raised_to(degree)
    waiting = [*fresh, *raised(lower, units)]
    is_new = bool(fresh)  # of multiples alone nothing is left over
    while waiting:
        found = rows.add(waiting)
        if found is None:
            return False
        if not any(map(any, found)) and found:
            return True
        fallen = [lead for lead in found if sum(lead) < degree]
        is_new = is_new or bool(fallen)
        waiting = raised([rows.row(lead) for lead in fallen], units)
        if not waiting and is_new:
            waiting = rows.quotients(away)
    return rows.effort.left >= 0
