"""Polynomials that are rational once some symbols are counted in units of a root.

A polynomial over Q(√d) may contain √d only with odd powers of some symbols: the
mechanism's y coordinates are multiples of √3, say.  With y = √3·y′ it is a polynomial
over Q, times √d perhaps, and its factors are those of that polynomial.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from flint import nmod_mat

from screwkit.algebra.restrictions import Layout
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive


@dataclass(frozen=True)
class Scaled:
    """A polynomial with some symbols in units of √d.

    Attributes:
        ring: Of the polynomial.
        root: Index of √d.
        square: d.
        symbols: Indices of the symbols that are counted in its units.
        polynomial: Free of √d.
        odd: Whether the polynomial was √d times this.
    """

    ring: TrigonometricRing
    root: int
    square: int
    symbols: tuple[int, ...]
    polynomial: Polynomial
    odd: bool

    def unscaled(self, factor: Polynomial) -> tuple[Polynomial, bool]:
        """A factor in the symbols themselves, and whether √d was multiplied to it.

        Of the two multiples the one with fewer irrational terms is taken.  The factor
        may contain √d: 3·y′² − 1 is rational, and splits over Q(√3).
        """
        terms = factor.to_dict()
        degree = max(self._degree(exponents) for exponents in terms)
        multiples = [
            (
                primitive(self._multiplied(factor, degree + more)),
                bool(degree + more & 1),
            )
            for more in (0, 1)
        ]
        return min(multiples, key=lambda m: (self._irrational(m[0]), str(m[0])))

    def _degree(self, exponents: Sequence[int]) -> int:
        return sum(int(exponents[i]) for i in self.symbols)

    def _multiplied(self, factor: Polynomial, power: int) -> Polynomial:
        """√d^power · the factor, with x/√d for every scaled x."""
        context = self.ring.context
        moved = {}
        for exponents, coefficient in factor.to_dict().items():
            key = [int(e) for e in exponents]
            left = power - self._degree(exponents) + key[self.root]
            key[self.root] = left & 1
            moved[tuple(key)] = coefficient * self.square ** (left >> 1)
        return context.from_dict(moved)

    def _irrational(self, value: Polynomial) -> int:
        return sum(bool(exponents[self.root]) for exponents in value.to_dict())


def scaled(
    ring: TrigonometricRing, layout: Layout, polynomial: Polynomial
) -> Scaled | None:
    """The polynomial with symbols scaled so that no root is left.

    None where it contains no root of an integer or several algebraic numbers, or where
    no choice of symbols does it.
    """
    degrees = polynomial.degrees()
    roots = [i for i in layout.constants if degrees[i]]
    if len(roots) != 1:
        return None
    root = roots[0]
    minimal = dict(ring.algebraic_relations)[root]
    if not isinstance(minimal, tuple) or len(minimal) != 3 or minimal[1]:
        return None
    square = int(-minimal[0])
    symbols = [i for i in layout.symbols if degrees[i]]
    terms = polynomial.to_dict()
    chosen = _choice([(*(t[i] for i in symbols), t[root]) for t in terms])
    if chosen is None:
        return None
    own = tuple(i for i, taken in zip(symbols, chosen[:-1], strict=True) if taken)
    odd = chosen[-1]
    moved = {}
    for exponents, coefficient in terms.items():
        power = int(exponents[root]) + sum(int(exponents[i]) for i in own) - int(odd)
        key = [int(e) for e in exponents]
        key[root] = 0
        moved[tuple(key)] = coefficient * square ** (power >> 1)
    found = primitive(ring.context.from_dict(moved))
    return Scaled(ring, root, square, own, found, bool(odd))


def _choice(terms: Sequence[Sequence[int]]) -> list[int] | None:
    """Which symbols are scaled, and whether √d is left.

    Σ vᵢeᵢ + e + c must be even in all terms.

    Args:
        terms: Exponents of the symbols, then of the root.
    """
    rows = {tuple(int(e) & 1 for e in term) for term in terms}
    width = len(next(iter(rows)))  # the root's place serves the constant c
    system = nmod_mat(
        len(rows),
        width + 1,
        [x for row in sorted(rows) for x in (*row[:-1], 1, row[-1])],
        2,
    )
    reduced, rank = system.rref()
    found = [0] * width
    for line in range(int(rank)):
        pivot = next(i for i in range(width + 1) if reduced[line, i] != 0)
        if pivot == width:
            return None
        found[pivot] = int(reduced[line, width])
    return found
