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

from screwkit.algebra.factor_library import Factor, FactorLibrary, collected
from screwkit.algebra.half_angle import Form, HalfAngles
from screwkit.algebra.irreducible import Layout
from screwkit.algebra.points import PRIME
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
    content,
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
    whole = primitive(polynomial)
    if ring.has_extensions:
        return _by_expansion(known, polynomial, known.split(whole))
    value = known.value(whole)
    found, rest = known.divided(whole, value)
    if not rest.is_constant():
        found = found + known.split(rest)
    factors = _sorted(known.paired(collected(found)))
    ratio = Fraction(value)
    for part, multiplicity in factors:
        ratio /= known.factor_value(part)[0] ** multiplicity
    scale = content(polynomial)
    result = Factored(ratio * Fraction(int(scale.p), int(scale.q)), factors)
    _verify(known, polynomial, result)
    return result


def _verify(library: FactorLibrary, polynomial: Polynomial, result: Factored) -> None:
    """Compare with the product at a random point mod a 61-bit prime."""
    if any(factor.form is not None for factor, _ in result.factors):
        if result.expand(library.ring) != polynomial:
            raise ArithmeticError("the product of the factors is another polynomial")
        return
    product = result.content.numerator * pow(result.content.denominator, -1, PRIME)
    for part, multiplicity in result.factors:
        power = pow(library.factor_value(part)[1], multiplicity, PRIME)
        product = product * power % PRIME
    if (product - library.residue(polynomial)) % PRIME:
        raise ArithmeticError("the product of the factors is another polynomial")


def _by_expansion(
    library: FactorLibrary,
    polynomial: Polynomial,
    found: Sequence[tuple[Factor, int]],
) -> Factored:
    """The content from the expanded product; for rings with roots."""
    ring = library.ring
    numbers = set(range(len(ring.names) - len(ring.constant_generators)))
    unit, factors = ring.one, []
    for part, multiplicity in library.paired(found):
        degrees = part.equations[0].degrees()
        if any(degrees[i] for i in numbers):
            factors.append((part, multiplicity))
        else:
            unit = ring.normal(unit * part.polynomial**multiplicity)
    result = Factored(Fraction(1), _sorted(factors), None if unit == 1 else unit)
    product = result.expand(ring)
    ratio = polynomial.coeffs()[0] / product.coeffs()[0]
    if ratio * product != polynomial:
        raise ArithmeticError("the product of the factors is another polynomial")
    return replace(result, content=Fraction(int(ratio.p), int(ratio.q)))


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
