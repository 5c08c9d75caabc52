"""Complete factorisation of polynomials in sines, cosines and symbols.

Factors are not unique in Q[s, c]/(s² + c² = 1): s·s = (1 − c)(1 + c).  So polynomials
are split as they stand, and every piece is either proved irreducible or rewritten in
half angles, where factors are unique.  `factor_library` does the work and remembers it;
here the results are put together and compared with the input.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import isqrt
from weakref import WeakKeyDictionary

from screwkit.algebra.factor_library import Factor, FactorLibrary
from screwkit.algebra.half_angle import Form, HalfAngles
from screwkit.algebra.remembered import LONGEST
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.short_fractions import short_fraction
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
    primitive,
)

__all__ = ["Factor", "FactorLibrary", "Factored", "factor"]


@dataclass(frozen=True)
class Factored:
    """A number times powers of irreducible factors, in canonical order.

    Attributes:
        content: The rational part of the number.
        factors: With their multiplicities; none is a number.
        unit: The irrational part of the number; None for 1.
    """

    content: Fraction
    factors: tuple[tuple[Factor, int], ...]
    unit: Polynomial | None = None

    @property
    def certified(self) -> bool:
        """Whether every factor is proved irreducible."""
        return all(factor.certified for factor, _ in self.factors)

    def expand(self, ring: TrigonometricRing) -> Polynomial:
        """The product, in normal form."""
        total = ring.rational(self.content)
        if self.unit is not None:
            total = total * self.unit
        odd: list[Form] = []
        for factor, multiplicity in self.factors:
            if factor.form is not None:
                odd += [factor.form] * multiplicity
            else:
                for _ in range(multiplicity):
                    total = ring.normal(total * factor.polynomial)
        if odd:
            halves = HalfAngles(ring, Layout.of(ring))
            total = ring.normal(total * halves.exact(halves.product(odd)))
        return total


_FACTORED: WeakKeyDictionary[FactorLibrary, dict[str, Factored]] = WeakKeyDictionary()


def factor(
    ring: TrigonometricRing,
    polynomial: Polynomial,
    library: FactorLibrary | None = None,
) -> Factored:
    """The irreducible factors of a polynomial in normal form.

    Args:
        ring: Of the polynomial.
        polynomial: Not zero.
        library: Of the same ring; reuse one wherever several polynomials are factored.

    Raises:
        ValueError: If the polynomial is zero.
        ArithmeticError: If the product of the factors is not the polynomial, which
            would be a defect of the program.
    """
    if polynomial == 0:
        raise ValueError("zero has no factors")
    known = FactorLibrary(ring) if library is None else library
    if polynomial.is_constant():
        return Factored(as_fraction(polynomial), ())
    if len(polynomial) > LONGEST:
        return _factored(ring, polynomial, known)
    results = _FACTORED.setdefault(known, {})
    key = str(polynomial)
    if key not in results:
        results[key] = _factored(ring, polynomial, known)
    return results[key]


def _factored(
    ring: TrigonometricRing, polynomial: Polynomial, known: FactorLibrary
) -> Factored:
    found = known.factored(primitive(polynomial))
    if known.is_extended(polynomial):
        return _by_expansion(ring, polynomial, found)
    return _by_values(known, polynomial, found)


def _by_values(
    library: FactorLibrary, polynomial: Polynomial, found: Sequence[tuple[Factor, int]]
) -> Factored:
    """The content from values at one point, compared at another, both mod p."""
    first, second = library.residues(polynomial)
    for part, multiplicity in found:
        for_first, for_second = library.factor_residues(part)
        first = first * pow(for_first, -multiplicity, library.prime) % library.prime
        second = second * pow(for_second, -multiplicity, library.prime) % library.prime
    largest = isqrt(library.prime) >> 8  # longer ones come out by chance too often
    ratio = short_fraction(first, library.prime, largest)
    if first != second or not ratio:
        return _by_expansion(library.ring, polynomial, found)
    unit, factors = _without_numbers(library.ring, found)
    return Factored(ratio, _sorted(factors), unit)


def _by_expansion(
    ring: TrigonometricRing, polynomial: Polynomial, found: Sequence[tuple[Factor, int]]
) -> Factored:
    """The content from the expanded product."""
    unit, factors = _without_numbers(ring, found)
    result = Factored(Fraction(1), _sorted(factors), unit)
    product = result.expand(ring)
    ratio = polynomial.coeffs()[0] / product.coeffs()[0]
    if ratio * product != polynomial:
        raise ArithmeticError("the product of the factors is another polynomial")
    return replace(result, content=Fraction(int(ratio.p), int(ratio.q)))


def _without_numbers(
    ring: TrigonometricRing, found: Sequence[tuple[Factor, int]]
) -> tuple[Polynomial | None, list[tuple[Factor, int]]]:
    """The product of irrational numbers, None for 1, and the other factors."""
    numbers = range(len(ring.names) - len(ring.constant_generators))
    unit, factors = ring.one, []
    for part, multiplicity in found:
        degrees = part.equations[0].degrees()
        if any(degrees[i] for i in numbers):
            factors.append((part, multiplicity))
        else:
            unit = ring.normal(unit * part.polynomial**multiplicity)
    return None if unit == 1 else unit, factors


def _sorted(
    factors: Sequence[tuple[Factor, int]],
) -> tuple[tuple[Factor, int], ...]:
    """Simple factors first."""
    return tuple(
        sorted(
            factors,
            key=lambda pair: (
                pair[0].equations[0].total_degree() > 1,
                len(pair[0].equations[0]),
                pair[0].key,
            ),
        )
    )
