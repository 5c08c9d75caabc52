"""Complete factorisation of polynomials in sines, cosines and symbols.

Factors are not unique in Q[s, c]/(s² + c² = 1): s·s = (1 − c)(1 + c).  So polynomials
are split as they stand, every piece is either proved irreducible (`irreducible`) or
rewritten in half angles, where factors are unique (`half_angle`), and what was found
once is kept in a library and divided out first: mechanisms have few factors, which
occur again and again.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from flint import fmpq

from screwkit.algebra.half_angle import Form, HalfAngles
from screwkit.algebra.irreducible import Layout, is_irreducible
from screwkit.algebra.points import PRIME, random_point, residue
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
    content,
    primitive,
)

LARGEST_NORM = 400  # terms; see `FactorLibrary.divided`


@dataclass(frozen=True)
class Factor:
    """An irreducible factor; equal when it is the same locus with the same proof.

    Attributes:
        key: Canonical identity within a ring.
        equations: The factor vanishes where all of them do: one primitive polynomial
            in normal form, or two where only a half-angle form shows the factor.
        certified: Whether irreducibility is proved.
        form: The half-angle form where there are two equations.
    """

    key: str
    equations: tuple[Polynomial, ...] = field(compare=False)
    certified: bool = field(default=True, compare=False)
    form: Form | None = field(default=None, compare=False, repr=False)

    @property
    def polynomial(self) -> Polynomial:
        """The single equation.

        Raises:
            ValueError: If a half-angle factor has two.
        """
        if self.form is not None:
            raise ValueError(
                "a half-angle factor is no polynomial in sines and cosines"
            )
        return self.equations[0]


@dataclass(frozen=True)
class Factored:
    """A rational times powers of irreducible factors, in canonical order."""

    content: Fraction
    factors: tuple[tuple[Factor, int], ...]

    @property
    def certified(self) -> bool:
        """Whether every factor is proved irreducible."""
        return all(factor.certified for factor, _ in self.factors)

    def expand(self, ring: TrigonometricRing) -> Polynomial:
        """The product, in normal form."""
        total = ring.rational(self.content)
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


class FactorLibrary:
    """What has been factored in one ring, and the tools to factor more.

    Attributes:
        ring: All polynomials belong to it.
        factors: The irreducible factors met so far, by key.
    """

    def __init__(self, ring: TrigonometricRing) -> None:
        self.ring = ring
        self.factors: dict[str, Factor] = {}
        self._layout = Layout.of(ring)
        self._halves = HalfAngles(ring, self._layout)
        self._pieces: dict[str, list[tuple[Factor, int]]] = {}
        self._point = _Point(ring, self._layout, self._halves)
        self._values: dict[str, tuple[int, int]] = {}
        self._divisors: dict[str, _Divisor] = {}
        for sine, cosine in zip(ring.sines, ring.cosines, strict=True):
            self.irreducible(sine)
            self.irreducible(cosine)

    def irreducible(self, polynomial: Polynomial, certified: bool = True) -> Factor:
        """The factor of a polynomial known not to split."""
        key = str(polynomial)
        factor = self.factors.get(key)
        if factor is None:
            factor = Factor(key, (polynomial,), certified)
            self._keep(factor)
        return factor

    def split(self, polynomial: Polynomial) -> list[tuple[Factor, int]]:
        """The factors of a primitive polynomial in normal form, without constants."""
        key = str(polynomial)
        if key in self.factors:
            return [(self.factors[key], 1)]
        if key not in self._pieces:
            self._pieces[key] = self._split(polynomial)
        return self._pieces[key]

    def value(self, polynomial: Polynomial) -> int:
        """The value of a primitive polynomial at the library's rational point."""
        return self._point.value(polynomial)

    def factor_value(self, factor: Factor) -> tuple[int, int]:
        """Of a factor: `value` and residue at the library's modular point."""
        return self._values[factor.key]

    def residue(self, polynomial: Polynomial) -> int:
        """The value of a polynomial at the library's modular point."""
        return self._point.residue(polynomial)

    def divided(
        self, polynomial: Polynomial, value: int
    ) -> tuple[list[tuple[Factor, int]], Polynomial]:
        """Known factors of a polynomial, and what is left of it.

        A factor must divide in value at a random integer point; the division itself is
        exact, by the norm of the factor, so nothing rests on the point.
        """
        found = []
        for key, divisor in list(self._divisors.items()):
            known = self._values[key][0]
            multiplicity = 0
            while value % known == 0:
                quotient = divisor.divide(polynomial, self.ring)
                if quotient is None:
                    break
                polynomial, value = primitive(quotient), value // known
                multiplicity += 1
            if multiplicity:
                found.append((self.factors[key], multiplicity))
                if polynomial.is_constant():
                    break
        return found, polynomial

    def _split(self, polynomial: Polynomial) -> list[tuple[Factor, int]]:
        pieces = polynomial.factor()[1]
        if len(pieces) > 1 or pieces[0][1] > 1:
            return _collected(
                (factor, n * int(m))
                for piece, m in pieces
                for factor, n in self.split(primitive(piece))
            )
        if is_irreducible(self._layout, polynomial):
            return [(self.irreducible(polynomial), 1)]
        degrees = self._halves.degrees(polynomial)
        for angle in degrees:
            if degrees[angle] > 1 and len(degrees) > 1:
                parts = self._halved(polynomial, (angle,))
                if len(parts) > 1 or parts[0][1] > 1:
                    if any(form.odd for form, _ in parts):
                        break
                    return _collected(
                        (factor, n * m)
                        for form, m in parts
                        for factor, n in self.split(self._halves.whole(form))
                    )
        return [(self._final(form), m) for form, m in self._halved(polynomial, degrees)]

    def _halved(
        self, polynomial: Polynomial, angles: Iterable[int]
    ) -> list[tuple[Form, int]]:
        halves = self._halves
        return halves.paired(halves.factor(halves.form(polynomial, angles)))

    def _final(self, form: Form) -> Factor:
        """The factor of a form that cannot be split further."""
        equations = self._halves.equations(form)
        if len(equations) == 1:
            certified = not self.ring.has_extensions or is_irreducible(
                self._layout, equations[0]
            )
            return self.irreducible(equations[0], certified)
        key = "; ".join(map(str, equations))
        factor = self.factors.get(key)
        if factor is None:
            factor = Factor(key, equations, not self.ring.has_extensions, form)
            self._keep(factor)
        return factor

    def _keep(self, factor: Factor) -> None:
        self.factors[factor.key] = factor
        if self.ring.has_extensions:
            return
        if factor.form is not None:
            self._values[factor.key] = self._point.form_values(factor.form)
            return
        polynomial = factor.polynomial
        self._values[factor.key] = (self.value(polynomial), self.residue(polynomial))
        self._divisors[factor.key] = _Divisor(polynomial, self.ring, self._layout)


class _Point:
    """A rational point and a modular one at which products are compared."""

    def __init__(
        self, ring: TrigonometricRing, layout: Layout, halves: HalfAngles
    ) -> None:
        source = random.Random(7)
        self._halves = halves
        self._pairs = []
        exact: list[fmpq] = [fmpq(0)] * len(ring.names)
        for sine, cosine in layout.angles:
            u, v = source.randrange(1, 2**16) * 2, source.randrange(2**16) * 2 + 1
            self._pairs.append((u, v))
            w = u * u + v * v
            exact[sine], exact[cosine] = fmpq(2 * u * v, w), fmpq(v * v - u * u, w)
        self._symbols = [0] * len(ring.names)
        for symbol in layout.symbols:
            self._symbols[symbol] = source.randrange(2**16, 2**20)
            exact[symbol] = fmpq(self._symbols[symbol])
        self._exact = exact
        self._modular = random_point(ring, source)

    def value(self, polynomial: Polynomial) -> int:
        """The value, times what makes the angles homogeneous: an integer."""
        if polynomial.is_constant():
            return int(as_fraction(polynomial))
        value = polynomial(*self._exact)
        for i, degree in self._halves.degrees(polynomial).items():
            u, v = self._pairs[i]
            value *= (u * u + v * v) ** degree
        return int(value.p)

    def residue(self, polynomial: Polynomial) -> int:
        """The value modulo the prime of `points`."""
        return residue(polynomial, self._modular)

    def form_values(self, form: Form) -> tuple[int, int]:
        """The value of an odd form, and 0 where a residue would be ambiguous."""
        return self._halves.value(form, self._pairs, self._symbols), 0


class _Divisor:
    """Divides by one polynomial, by its norm over the angles it contains."""

    def __init__(
        self, polynomial: Polynomial, ring: TrigonometricRing, layout: Layout
    ) -> None:
        self._polynomial = polynomial
        self._cofactor: Polynomial | None = ring.one
        self._norm = polynomial
        degrees = polynomial.degrees()
        for (sine, _), generator in zip(layout.angles, ring.sines, strict=True):
            if degrees[sine]:
                mirrored = self._norm.compose(
                    *(-g if g == generator else g for g in ring.context.gens())
                )
                if len(mirrored) ** 2 > LARGEST_NORM:
                    self._cofactor = None
                    return
                self._cofactor = ring.normal(self._cofactor * mirrored)
                self._norm = ring.normal(self._norm * mirrored)

    def divide(
        self, polynomial: Polynomial, ring: TrigonometricRing
    ) -> Polynomial | None:
        """The quotient, or None where the division was not found to be exact."""
        quotient, rest = divmod(polynomial, self._polynomial)
        if rest == 0:
            return ring.normal(quotient)
        if self._cofactor is None:
            return None
        raised = ring.normal(polynomial * self._cofactor)
        quotient, rest = divmod(raised, self._norm)
        return quotient if rest == 0 else None


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
        return _by_expansion(ring, polynomial, _sorted(known.split(whole)))
    value = known.value(whole)
    found, rest = known.divided(whole, value)
    if not rest.is_constant():
        found = found + known.split(rest)
    factors = _sorted(_collected(found))
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
    ring: TrigonometricRing,
    polynomial: Polynomial,
    factors: tuple[tuple[Factor, int], ...],
) -> Factored:
    """The content from the expanded product; for rings with roots."""
    product = Factored(Fraction(1), factors).expand(ring)
    ratio = polynomial.coeffs()[0] / product.coeffs()[0]
    if ratio * product != polynomial:
        raise ArithmeticError("the product of the factors is another polynomial")
    return Factored(Fraction(int(ratio.p), int(ratio.q)), factors)


def _collected(
    factors: Iterable[tuple[Factor, int]],
) -> list[tuple[Factor, int]]:
    """Equal factors together."""
    count: dict[str, int] = {}
    kept: dict[str, Factor] = {}
    for part, multiplicity in factors:
        kept[part.key] = part
        count[part.key] = count.get(part.key, 0) + multiplicity
    return [(part, count[key]) for key, part in kept.items()]


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
