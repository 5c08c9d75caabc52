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
        size = self.dimension
        ideal: Any = nmod_mat(0, size, [], self._prime)
        for equation in equations:
            rows = self._times(self._value(equation)).transpose()
            ideal = self._reduced(_stacked(ideal, rows))
            if ideal.nrows() == size:
                return True
        power: Any = None
        for factor in away:
            own = self._times(self._value(factor))
            power = own if power is None else power * own
        if power is None:
            return False
        exponent = 1
        while exponent < size:
            power, exponent = power * power, 2 * exponent
        whole = _stacked(ideal, (power * self._one).transpose())
        return bool(self._reduced(whole).nrows() == ideal.nrows())

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


def _stacked(upper: Any, lower: Any) -> Any:
    """Rows of two matrices below each other."""
    entries = [*upper.entries(), *lower.entries()]
    height = upper.nrows() + lower.nrows()
    return nmod_mat(height, lower.ncols(), [int(x) for x in entries], lower.modulus())
