"""Factors of polynomials whose coefficients contain square roots of numbers.

4·v² − 3 does not split over the rationals and does over Q(√3).  A polynomial is shifted
so that its norm, the product of its conjugates, tells its factors apart; the norm has
rational coefficients and is factored, and the common divisor with each of its factors
is a factor of the polynomial, irreducible where its own norm is that factor.  Common
divisors are taken modulo a prime in which the roots exist, and proved by division.

References: [Trager1976] §2 (norms), [CoxLittleOShea] §4.2.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import reduce
from itertools import product
from math import isqrt, prod
from typing import Any, NamedTuple

from flint import Ordering, fmpq, nmod_mpoly_ctx, nmod_poly
from flint.utils.flint_exceptions import DomainError

from screwkit.algebra.modular import prime_for
from screwkit.algebra.short_fractions import short_fraction
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

TERMS = 40
"""Of a polynomial that is factored."""

NORM = 20_000
"""Products of terms in its norm."""

SHIFTS = 5


class Root(NamedTuple):
    """The generator of the square root of a number."""

    place: int
    square: int


def square_roots(ring: TrigonometricRing) -> tuple[Root, ...]:
    """The algebraic numbers of a ring, if all are square roots of numbers."""
    numbers = [(i, m) for i, m in ring.algebraic_relations if isinstance(m, tuple)]
    if any(len(minimal) != 3 or minimal[1] for _, minimal in numbers):
        return ()
    return tuple(Root(place, -minimal[0]) for place, minimal in numbers)


def factors_over_roots(
    polynomial: Polynomial, names: Sequence[str], roots: Sequence[Root]
) -> list[tuple[Polynomial, int]] | None:
    """The irreducible factors over the field of the roots, up to numbers of it.

    Args:
        polynomial: Not a number; of degree one at most in each root.
        names: Of the generators of its context.
        roots: Independent of each other.

    Returns:
        None where they were not found, or not proved irreducible.
    """
    degrees = polynomial.degrees()
    places = {root.place for root in roots}
    free = [i for i, d in enumerate(degrees) if d and i not in places]
    if not free or len(polynomial) > TERMS:
        return None
    field = _Field(polynomial.context(), names, roots)
    variable = min(free, key=lambda i: int(degrees[i]))
    for count in range(SHIFTS):
        shifted = field.shifted(polynomial, variable, count)
        norm = field.norm(shifted)
        if norm is None:
            return None
        found = _factors(field, shifted, norm)
        if found is not None:
            return [(field.shifted(f, variable, -count), m) for f, m in found]
    return None


def quotient_number(
    value: Polynomial, divisor: Polynomial, roots: Sequence[Root]
) -> Polynomial | None:
    """The irrational number by which two proportional polynomials differ.

    Up to a rational factor; None where that is all.
    """
    names = [str(generator) for generator in value.context().gens()]
    field = _Field(value.context(), names, roots)
    lead = max(map(field.free, value.monoms()))
    above, below = (field.coefficient(p, lead) for p in (value, divisor))
    number = field.quotient(above, below)
    if number is None or number.is_constant():
        return None
    return primitive(number)


def monic(
    polynomial: Polynomial, names: Sequence[str], roots: Sequence[Root]
) -> Polynomial | None:
    """The multiple by a number whose leading coefficient is one."""
    field = _Field(polynomial.context(), names, roots)
    lead = max(map(field.free, polynomial.monoms()))
    return field.quotient(polynomial, field.coefficient(polynomial, lead))


def _factors(
    field: _Field, polynomial: Polynomial, norm: Polynomial
) -> list[tuple[Polynomial, int]] | None:
    left = polynomial
    found: list[tuple[Polynomial, int]] = []
    for part, _ in norm.factor()[1]:
        divisor = field.common_divisor(polynomial, part)
        if divisor is None:
            return None
        if field.size * _degree(field, divisor) != part.total_degree():
            return None
        multiplicity = 0
        while True:
            quotient = field.quotient(left, divisor)
            if quotient is None:
                break
            left, multiplicity = quotient, multiplicity + 1
        if not multiplicity:
            return None
        found.append((divisor, multiplicity))
    return found if _degree(field, left) == 0 else None


def _degree(field: _Field, polynomial: Polynomial) -> int:
    places = {root.place for root in field.roots}
    return max(
        sum(int(e) for i, e in enumerate(monomial) if i not in places)
        for monomial in polynomial.monoms()
    )


class _Field:
    """Polynomials over the rationals and some square roots."""

    def __init__(
        self, context: Any, names: Sequence[str], roots: Sequence[Root]
    ) -> None:
        self.roots = tuple(roots)
        self.size = 2 ** len(roots)
        self._context = context
        self._names = list(names)
        self._relations = [
            context.gens()[root.place] ** 2 - root.square for root in roots
        ]
        self._prime = prime_for(12, [Fraction(root.square) for root in roots], 1)
        self._values = [
            int(nmod_poly([-root.square, 0, 1], self._prime).roots()[0][0])
            for root in roots
        ]
        self._modular = nmod_mpoly_ctx.get(
            self._names, ordering=Ordering.lex, modulus=self._prime
        )

    def normal(self, value: Polynomial) -> Polynomial:
        """With every root in the first power at most."""
        for relation in self._relations:
            value = divmod(value, relation)[1]
        return value

    def free(self, monomial: Sequence[int]) -> tuple[int, ...]:
        """A monomial without the roots."""
        places = {root.place for root in self.roots}
        return tuple(0 if i in places else int(e) for i, e in enumerate(monomial))

    def coefficient(self, value: Polynomial, free: tuple[int, ...]) -> Polynomial:
        """The number that stands at a monomial without roots."""
        places = {root.place for root in self.roots}
        return self._context.from_dict(
            {
                tuple(int(e) if i in places else 0 for i, e in enumerate(key)): c
                for key, c in value.to_dict().items()
                if self.free(key) == free
            }
        )

    def shifted(self, value: Polynomial, variable: int, count: int) -> Polynomial:
        """With a multiple of the sum of all roots added to a variable."""
        if not count:
            return value
        images = list(self._context.gens())
        images[variable] += count * sum(images[root.place] for root in self.roots)
        return self.normal(value.compose(*images))

    def _conjugate(self, value: Polynomial, root: Root) -> Polynomial:
        return 2 * value.subs({self._names[root.place]: 0}) - value

    def norm(self, value: Polynomial) -> Polynomial | None:
        """The product of all conjugates; None where it is long."""
        both = self._with_cofactor(value)
        return None if both is None else both[0]

    def _with_cofactor(self, value: Polynomial) -> tuple[Polynomial, Polynomial] | None:
        norm, cofactor = value, self._context.constant(1)
        for root in self.roots:
            mirrored = self._conjugate(norm, root)
            if len(mirrored) * len(norm) > NORM:
                return None
            cofactor = self.normal(cofactor * mirrored)
            norm = self.normal(norm * mirrored)
        return norm, cofactor

    def quotient(self, value: Polynomial, divisor: Polynomial) -> Polynomial | None:
        """The quotient, if the division is exact."""
        both = self._with_cofactor(divisor)
        if both is None:
            return None
        norm, cofactor = both
        try:
            return self.normal(value * cofactor) / norm
        except DomainError:
            return None

    def common_divisor(self, one: Polynomial, two: Polynomial) -> Polynomial | None:
        """A monic common divisor of the largest degree, proved to divide the first."""
        images: list[dict[tuple[int, ...], int]] = []
        for signs in product((1, -1), repeat=len(self.roots)):
            first, second = (self._image(value, signs) for value in (one, two))
            if first is None or second is None or first == 0 or second == 0:
                return None
            shared = first.gcd(second)
            lead = int(shared.coeffs()[0])
            scale = pow(lead, -1, self._prime)
            images.append(
                {
                    tuple(map(int, key)): int(value) * scale % self._prime
                    for key, value in shared.to_dict().items()
                }
            )
        terms = self._lifted(images)
        if terms is None:
            return None
        found = self._context.from_dict(terms)
        return found if self.quotient(one, found) is not None else None

    def _image(self, value: Polynomial, signs: Sequence[int]) -> Any:
        """Modulo the prime, with these signs of the roots."""
        p = self._prime
        terms: dict[tuple[int, ...], int] = {}
        for exponents, coefficient in value.to_dict().items():
            if int(coefficient.q) % p == 0:
                return None
            total = int(coefficient.p) * pow(int(coefficient.q), -1, p)
            key = [int(e) for e in exponents]
            for root, residue, sign in zip(
                self.roots, self._values, signs, strict=True
            ):
                total = total * pow(sign * residue, key[root.place], p) % p
                key[root.place] = 0
            place = tuple(key)
            terms[place] = (terms.get(place, 0) + total) % p
        return self._modular.from_dict(terms)

    def _lifted(
        self, images: Sequence[Mapping[tuple[int, ...], int]]
    ) -> dict[tuple[int, ...], Any] | None:
        """Rational coefficients, by powers of the roots, from conjugates mod p."""
        p = self._prime
        keys = reduce(lambda a, b: a | b, (set(image) for image in images))
        patterns = list(product((1, -1), repeat=len(self.roots)))
        terms: dict[tuple[int, ...], Any] = {}
        for key in keys:
            for taken in product((0, 1), repeat=len(self.roots)):
                total = sum(
                    image.get(key, 0)
                    * prod(s for s, t in zip(signs, taken, strict=True) if t)
                    for signs, image in zip(patterns, images, strict=True)
                )
                below = self.size * prod(
                    v for v, t in zip(self._values, taken, strict=True) if t
                )
                residue = total * pow(below, -1, p) % p
                value = short_fraction(residue, p, isqrt(p // 2))
                if value is None:
                    return None
                if value:
                    exponents = list(key)
                    for root, t in zip(self.roots, taken, strict=True):
                        exponents[root.place] = t
                    terms[tuple(exponents)] = fmpq(value.numerator, value.denominator)
        return terms
