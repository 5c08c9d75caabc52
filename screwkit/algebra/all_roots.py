"""Residues at all roots of a polynomial at once, whatever field they lie in.

A value is a polynomial in the root t modulo f(t), with f square-free over a prime
field.  Where a computation has to know whether a value is zero and the answer is not
the same at all roots, f is split by a greatest common divisor and the computation is
done again on each part (dynamic evaluation).  Nothing is factored, and no root is
missed because it lies in an extension of the field.

References: [DellaDoraDicrescenzoDuval1985].
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

from flint import nmod, nmod_mat, nmod_poly

T = TypeVar("T")


class SplitError(Exception):
    """A value is zero at some roots and not at others."""

    def __init__(self, factor: Any) -> None:
        self.factor = factor
        super().__init__("a value is zero at some roots and not at others")


class NoResidueError(Exception):
    """A number is asked for where a value differs from root to root."""


class RootValue:
    """A value at every root of a square-free polynomial.

    Args:
        poly: The value as a polynomial in the root, reduced.
        modulus: Whose roots are meant.
    """

    __slots__ = ("modulus", "poly")

    def __init__(self, poly: Any, modulus: Any) -> None:
        self.poly, self.modulus = poly, modulus

    def _of(self, poly: Any) -> RootValue:
        return RootValue(poly, self.modulus)

    def __add__(self, other: Any) -> RootValue:
        return self._of(self.poly + _poly(other))

    __radd__ = __add__

    def __sub__(self, other: Any) -> RootValue:
        return self._of(self.poly - _poly(other))

    def __rsub__(self, other: Any) -> RootValue:
        return self._of(_poly(other) - self.poly)

    def __neg__(self) -> RootValue:
        return self._of(-self.poly)

    def __mul__(self, other: Any) -> RootValue:
        if isinstance(other, RootValue):
            return self._of(self.poly * other.poly % self.modulus)
        return self._of(self.poly * other)

    __rmul__ = __mul__

    def __pow__(self, exponent: int) -> RootValue:
        if exponent < 0:
            return self.inverse() ** -exponent
        result = self._of(nmod_poly([1], self.modulus.modulus()))
        for _ in range(exponent):
            result = result * self
        return result

    def __truediv__(self, other: Any) -> RootValue:
        if isinstance(other, RootValue):
            return self * other.inverse()
        return self._of(self.poly * (1 / nmod(int(other), self.modulus.modulus())))

    def __rtruediv__(self, other: Any) -> RootValue:
        quotient: RootValue = self.inverse() * other
        return quotient

    def __eq__(self, other: object) -> bool:
        """Whether two values agree at every root."""
        return bool(self.poly == _poly(other))

    __hash__ = None  # type: ignore[assignment]

    def __bool__(self) -> bool:
        return bool(self.poly != 0)

    def __int__(self) -> int:
        if self.poly.degree() > 0:
            raise NoResidueError
        return int(self.poly[0])

    def inverse(self) -> RootValue:
        """The inverse.

        Raises:
            SplitError: If it exists at some roots alone.
            ZeroDivisionError: If it exists at none.
        """
        if self.poly == 0:
            raise ZeroDivisionError
        shared, times, _ = self.poly.xgcd(self.modulus)
        if shared.degree() > 0:
            raise SplitError(shared)
        return self._of(times)

    def is_zero(self) -> bool:
        """Whether it is zero at every root.

        Raises:
            SplitError: If it is at some of them.
        """
        if self.poly == 0:
            return True
        if self.poly.degree() > 0:
            shared = self.poly.gcd(self.modulus)
            if shared.degree() > 0:
                raise SplitError(shared)
        return False


def at_all_roots(polynomial: Any, found: Callable[[Any], T]) -> list[T]:
    """What a computation finds at the roots of a polynomial that is not zero.

    Args:
        polynomial: Over a prime field.
        found: Called with the roots of one part after the other: a `RootValue`, or a
            residue where the part has one root.

    Returns:
        One value for each part; none if there is no root.
    """
    waiting = [polynomial // polynomial.gcd(polynomial.derivative())]
    results = list[T]()
    while waiting:
        part = waiting.pop()
        if part.degree() < 1:
            continue
        try:
            results.append(found(_root_of(part)))
        except SplitError as split:
            waiting += [split.factor, part // split.factor]
    return results


def vanishes(value: Any) -> bool:
    """Whether a residue is zero, or a value at every root.

    Raises:
        SplitError: If it is zero at some roots alone.
    """
    if isinstance(value, RootValue):
        return value.is_zero()
    return bool(value == 0)


def rank_at_roots(rows: Sequence[Sequence[Any]], prime: int) -> int:
    """Rank of a matrix of residues and values at roots, the same at all of them.

    Raises:
        SplitError: If it may not be.
    """
    if not any(isinstance(x, RootValue) for row in rows for x in row):
        if not rows or not rows[0]:
            return 0
        entries = [int(x) for row in rows for x in row]
        return int(nmod_mat(len(rows), len(rows[0]), entries, prime).rank())
    left = [{k: x for k, x in enumerate(row) if x != 0} for row in rows]
    rank = 0
    while left:
        # Few entries fill up little; residues are divided by without asking.
        left.sort(key=lambda row: (_roots_in(row), len(row)))
        row = left.pop(0)
        plain = [k for k in row if not isinstance(row[k], RootValue)]
        pivot = next((k for k in (plain or row) if not vanishes(row[k])), None)
        if pivot is None:
            continue
        rank += 1
        inverse = 1 / row.pop(pivot)
        for other in left:
            if pivot in other:
                factor = other.pop(pivot) * inverse
                for k, value in row.items():
                    new = other[k] - factor * value if k in other else -(factor * value)
                    if new != 0:
                        other[k] = new
                    else:
                        other.pop(k, None)
    return rank


def _roots_in(row: Mapping[int, Any]) -> int:
    return sum(isinstance(value, RootValue) for value in row.values())


def _root_of(part: Any) -> Any:
    """The root of a part: of degree 1, its residue."""
    p = part.modulus()
    if part.degree() == 1:
        return -nmod(int(part[0]), p) / nmod(int(part[1]), p)
    return RootValue(nmod_poly([0, 1], p), part)


def _poly(value: Any) -> Any:
    return value.poly if isinstance(value, RootValue) else value
