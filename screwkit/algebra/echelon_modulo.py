"""Polynomials modulo a prime as reduced rows, to which more are added at little cost.

What is added is reduced by the rows that are there, eliminated among itself, and put
into them: work grows with what is new, not with all that is known.

References: [CoxLittleOShea] §5.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from flint import nmod_mat

from screwkit.algebra.effort import Effort
from screwkit.algebra.monomials import (
    Exponents,
    Terms,
    degree_of,
    monomials,
    multiple,
)

DEAREST: Final = 30_000_000
"""Products of residues for what one divisor leaves, at most."""

HANDLED: Final = 800
"""Products of residues that take as long as to hand one over."""


class Echelon:
    """Reduced rows: each a leading monomial and what it has at those that lead none.

    Args:
        count: Of variables.
        prime: The modulus.
        effort: Products of residues that it may take.
    """

    def __init__(self, count: int, prime: int, effort: Effort) -> None:
        self.count, self.prime, self.effort = count, prime, effort
        self.degree = -1
        self.leads: list[Exponents] = []
        self.free: list[Exponents] = []
        self._below: Any = nmod_mat(0, 0, [], prime)

    def raised_to(self, degree: int) -> None:
        """Take up all monomials up to a degree."""
        every = monomials(self.count, degree)
        fresh = [m for m in every if sum(m) > self.degree]
        old = self._rows_of(self._below, len(self.free))
        added = [0] * len(fresh)
        self.free = [*fresh, *self.free]
        self._below = self._matrix([[*added, *row] for row in old], len(self.free))
        self.degree = degree

    @property
    def is_whole(self) -> bool:
        """Whether 1 is a sum of rows."""
        return (0,) * self.count in self.leads

    @property
    def is_finite(self) -> bool:
        """Whether every monomial of the degree leads a row."""
        return not any(sum(monomial) == self.degree for monomial in self.free)

    def row(self, lead: Exponents) -> Terms:
        """The row of a leading monomial."""
        number = self.leads.index(lead)
        values = (int(self._below[number, k]) for k in range(len(self.free)))
        pairs = zip(self.free, values, strict=True)
        return {lead: 1, **{monomial: value for monomial, value in pairs if value}}

    def rows(self) -> dict[Exponents, Terms]:
        """All rows by their leading monomials."""
        found: dict[Exponents, Terms] = {}
        table = self._rows_of(self._below, len(self.free))
        for lead, row in zip(self.leads, table, strict=True):
            pairs = zip(self.free, row, strict=True)
            found[lead] = {lead: 1, **{m: value for m, value in pairs if value}}
        return found

    def add(self, polynomials: Sequence[Terms]) -> list[Exponents] | None:
        """Take up polynomials, and what new monomials lead then; None if too dear."""
        height, width, known = len(polynomials), len(self.free), len(self.leads)
        if not height or not width:
            return []
        entries = HANDLED * (width * (height + known) + height * known)
        products = height * width * (known + min(height, width))
        if not self.effort.spend(entries + products):
            return None
        reduced, rank = self._reduced(polynomials).rref()
        size = int(rank)
        fresh = self._rows_of(reduced, width)[:size]
        pivots = [next(k for k, value in enumerate(row) if value) for row in fresh]
        if not self.effort.spend(known * width * size):
            return None
        leading = set(pivots)
        kept = [k for k in range(width) if k not in leading]
        own = self._matrix([[row[k] for k in kept] for row in fresh], len(kept))
        old = self._rows_of(self._below, width)
        across = self._matrix([[row[k] for k in pivots] for row in old], size)
        below = self._matrix([[row[k] for k in kept] for row in old], len(kept))
        below -= across * own
        self._below = self._matrix(
            [*self._rows_of(below, len(kept)), *self._rows_of(own, len(kept))],
            len(kept),
        )
        found = [self.free[k] for k in pivots]
        self.leads += found
        self.free = [self.free[k] for k in kept]
        return found

    def quotients(self, divisors: Sequence[Terms]) -> list[Terms]:
        """Polynomials that are no sums of rows, but times a divisor are.

        They vanish wherever the rows do and the divisor does not: with them the zeros
        of the divisor are left out, again and again (saturation, [CoxLittleOShea]
        §4.4).  All up to a degree are the kernel of a matrix.

        Args:
            divisors: Polynomials; those of a larger degree, or too dear, are left
                out.
        """
        found: list[Terms] = []
        for divisor in divisors:
            left = self.degree - degree_of(divisor)
            factors = [monomial for monomial in self.free if sum(monomial) <= left]
            size = len(factors) * len(self.free)
            size *= len(self.leads) + len(factors)
            entries = HANDLED * len(factors) * (len(self.free) + len(self.leads))
            if not factors or size > DEAREST or not self.effort.spend(size + entries):
                continue
            products = [multiple(divisor, monomial) for monomial in factors]
            kernel, nullity = self._reduced(products).transpose().nullspace()
            for number in range(int(nullity)):
                values = [int(kernel[k, number]) for k in range(len(factors))]
                pairs = zip(factors, values, strict=True)
                found.append({monomial: value for monomial, value in pairs if value})
        return found

    def _reduced(self, polynomials: Sequence[Terms]) -> Any:
        """What is left of polynomials at the monomials that lead no row."""
        own, led = self._at(polynomials, self.free), self._at(polynomials, self.leads)
        return own - led * self._below if self.leads else own

    def _at(self, polynomials: Sequence[Terms], places: Sequence[Exponents]) -> Any:
        column = {monomial: number for number, monomial in enumerate(places)}
        width = len(places)
        entries = [0] * (len(polynomials) * width)
        for number, polynomial in enumerate(polynomials):
            for monomial, value in polynomial.items():
                place = column.get(monomial)
                if place is not None:
                    entries[number * width + place] = value
        return nmod_mat(len(polynomials), width, entries, self.prime)

    def _matrix(self, rows: Sequence[Sequence[int]], width: int) -> Any:
        entries = [value for row in rows for value in row]
        return nmod_mat(len(rows), width, entries, self.prime)

    def _rows_of(self, matrix: Any, width: int) -> list[list[int]]:
        entries = [int(value) for value in matrix.entries()]
        if not width:
            return [[] for _ in range(matrix.nrows())]
        return [entries[k : k + width] for k in range(0, len(entries), width)]
