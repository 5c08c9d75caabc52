"""Functions on finitely many zeros: which of these other polynomials leave.

Polynomials modulo an ideal with finitely many zeros are a vector space; multiplication
is a matrix.  Further equations span a smaller ideal of it, however large their degree
is, and a product of polynomials vanishes at all zeros that are left if a power of it
lies there.

References: [CoxLittleOShea] §5.3 (finitely many zeros), §4.2 (radical membership).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Final

from flint import nmod_mat

from screwkit.algebra.macaulay import Multiples
from screwkit.algebra.monomials import Exponents, Terms, times, unit

LARGEST: Final = 400
"""Dimension of the functions, at most."""


class FiniteAlgebra:
    """Polynomials modulo others that have finitely many zeros.

    Args:
        found: Finite.
    """

    def __init__(self, found: Multiples) -> None:
        self._prime = found.prime
        self._basis = found.below()
        self._units = [unit(k, found.count) for k in range(found.count)]
        place = {monomial: number for number, monomial in enumerate(self._basis)}
        self._by = [self._times_variable(found, one, place) for one in self._units]
        self._one = self._column([int(not any(m)) for m in self._basis])

    @property
    def dimension(self) -> int:
        """Number of the zeros, each as often as it counts."""
        return len(self._basis)

    def are_left_out(self, equations: Sequence[Terms], away: Sequence[Terms]) -> bool:
        """Whether further equations leave zeros of a product alone, or none.

        Args:
            equations: Of any degrees.
            away: The factors.
        """
        ideal = self._ideal(equations)
        if ideal.nrows() == self.dimension:
            return True
        return not self._is_outside(ideal, self._power(away))

    def by_variable(
        self, equations: Sequence[Terms], away: Sequence[Terms], most: int
    ) -> list[list[int]]:
        """Of each variable a polynomial that vanishes at the zeros that are left.

        Args:
            equations: Further ones, of any degrees.
            away: Polynomials whose zeros are left out.
            most: Their degree, at most.

        Returns:
            Residues of the coefficients, the constant one first and the last one 1;
            none of a variable of which it was not found.
        """
        ideal, start = self._ideal(equations), self._power(away)
        found = []
        for by in self._by:
            columns, own = [start], list[int]()
            while len(columns) <= most + 1 and not own:
                rows = [ideal, *(c.transpose() for c in columns)]
                kernel, nullity = _below(rows).transpose().nullspace()
                if int(nullity):
                    height = ideal.nrows()
                    values = [int(kernel[height + k, 0]) for k in range(len(columns))]
                    scale = pow(values[-1], -1, self._prime)
                    own = [value * scale % self._prime for value in values]
                columns.append(by * columns[-1])
            found.append(own)
        return found

    def _ideal(self, equations: Sequence[Terms]) -> Any:
        """A basis of what further equations span, as rows."""
        ideal: Any = nmod_mat(0, self.dimension, [], self._prime)
        for equation in equations:
            rows = self._times(self._value(equation)).transpose()
            ideal = self._reduced(_below([ideal, rows]))
            if ideal.nrows() == self.dimension:
                break
        return ideal

    def _power(self, factors: Sequence[Terms]) -> Any:
        """A power of a product that lies in an ideal if any does, as a column."""
        power: Any = None
        for factor in factors:
            own = self._times(self._value(factor))
            power = own if power is None else power * own
        if power is None:
            return self._one
        exponent = 1
        while exponent < self.dimension:
            power, exponent = power * power, 2 * exponent
        return power * self._one

    def _is_outside(self, ideal: Any, column: Any) -> bool:
        rows = self._reduced(_below([ideal, column.transpose()]))
        return bool(rows.nrows() > ideal.nrows())

    def _reduced(self, rows: Any) -> Any:
        reduced, rank = rows.rref()
        width = self.dimension
        entries = [int(value) for value in reduced.entries()[: int(rank) * width]]
        return nmod_mat(int(rank), width, entries, self._prime)

    def _column(self, values: Sequence[int]) -> Any:
        return nmod_mat(len(values), 1, list(values), self._prime)

    def _times_variable(
        self, found: Multiples, one: Exponents, place: dict[Exponents, int]
    ) -> Any:
        size = self.dimension
        entries = [0] * (size * size)
        for column, monomial in enumerate(self._basis):
            for own, value in found.normal(times(monomial, one)).items():
                entries[place[own] * size + column] = value
        return nmod_mat(size, size, entries, self._prime)

    def _multiples(self, start: Any, wanted: Sequence[Exponents]) -> list[Any]:
        """A function times monomials; each by one variable less than another one."""
        known: dict[Exponents, Any] = {(0,) * len(self._units): start}

        def of(monomial: Exponents) -> Any:
            stack = []
            while monomial not in known:
                stack.append(monomial)
                number = next(k for k, power in enumerate(monomial) if power)
                lower = list(monomial)
                lower[number] -= 1
                monomial = tuple(lower)
            value = known[monomial]
            for upper in reversed(stack):
                number = next(k for k, power in enumerate(upper) if power)
                value = known[upper] = self._by[number] * value
            return value

        return [of(monomial) for monomial in wanted]

    def _value(self, polynomial: Terms) -> Any:
        """A polynomial by the basis, as a column."""
        parts = self._multiples(self._one, [*polynomial])
        total = self._column([0] * self.dimension)
        for part, value in zip(parts, polynomial.values(), strict=True):
            total += part * value
        return total

    def _times(self, function: Any) -> Any:
        """The matrix of multiplication by a function."""
        columns = self._multiples(function, self._basis)
        entries = [int(value) for column in columns for value in column.entries()]
        size = self.dimension
        return nmod_mat(size, size, entries, self._prime).transpose()


def _below(matrices: Sequence[Any]) -> Any:
    """Rows of matrices below each other."""
    entries = [int(x) for own in matrices for x in own.entries()]
    height, last = sum(own.nrows() for own in matrices), matrices[-1]
    return nmod_mat(height, last.ncols(), entries, last.modulus())
