"""What is taken for granted about the symbols, and what follows for polynomials.

Lengths are declared positive or nonzero; from that alone d3² + r3² cannot vanish.  A
proof here reads signs off the terms, so a missing proof says nothing.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from itertools import groupby
from operator import itemgetter
from typing import Any

from flint import arb, ctx

from screwkit.algebra.nonzero_numbers import is_nonzero_number
from screwkit.algebra.remembered import remembered
from screwkit.algebra.sturm import real_zeros
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, as_fraction


@dataclass(frozen=True)
class Range:
    """What is known of a number: sign (0 where unknown) and whether it can be 0.

    A sign of 1 without ``strict`` means ≥ 0.
    """

    sign: int
    strict: bool

    def times(self, other: Range) -> Range:
        """What is known of a product."""
        return Range(self.sign * other.sign, self.strict and other.strict)

    def power(self, exponent: int) -> Range:
        """What is known of a power."""
        return Range(self.sign if exponent % 2 else 1, self.strict)


_UNKNOWN = Range(0, False)
_ONE = Range(1, True)


@dataclass(frozen=True)
class Assumptions:
    """Signs of symbols.

    Attributes:
        positive: Symbols that are > 0.
        nonzero: Symbols that are not 0; positive ones need not be repeated.
    """

    positive: frozenset[str] = frozenset()
    nonzero: frozenset[str] = frozenset()

    def is_nonzero(self, ring: TrigonometricRing, polynomial: Polynomial) -> bool:
        """Whether a proof was found that the polynomial vanishes at no real point.

        Args:
            ring: Of the polynomial.
            polynomial: In normal form.
        """
        return _is_nonzero(ring, self, polynomial)

    def has_one_sign(self, ring: TrigonometricRing, polynomial: Polynomial) -> bool:
        """Whether no two terms of a polynomial can have different signs."""
        return bool(self.range_of(ring, polynomial, self.of_generators(ring)).sign)

    def sign_of(self, ring: TrigonometricRing, polynomial: Polynomial) -> int | None:
        """1 or −1 where the polynomial has this sign everywhere, 0 for zero.

        Returns:
            None where no proof was found.
        """
        if polynomial.is_constant():
            value = as_fraction(polynomial)
            return (value > 0) - (value < 0)
        found = self.range_of(ring, polynomial, self.of_generators(ring))
        return found.sign if found.strict and found.sign else None

    def of_generators(self, ring: TrigonometricRing) -> list[Range]:
        """What is known of each generator."""
        known = [_UNKNOWN] * len(ring.names)
        for place, name in zip(ring.symbol_indices(), ring.symbols, strict=True):
            if name in self.positive:
                known[place] = _ONE
            elif name in self.nonzero:
                known[place] = Range(0, True)
        for place, relation in ring.algebraic_relations:
            if isinstance(relation, tuple):
                known[place] = _ONE  # √p and 2cos(π/n) with n > 2
            else:
                radicand = self.range_of(ring, relation, known)
                known[place] = Range(1, radicand.strict)
        for place, extension in enumerate(ring.extensions):
            if extension.kind == "inverse":
                known[place] = Range(0, True)
        return known

    def range_of(
        self, ring: TrigonometricRing, polynomial: Polynomial, known: list[Range]
    ) -> Range:
        """What the terms say: all of one sign, and one of them not zero."""
        total: Range | None = None
        for sign, monomial in _terms(ring, polynomial):
            term = Range(sign, True)
            for generator, exponent in zip(known, monomial, strict=True):
                if exponent:
                    term = term.times(generator.power(exponent))
            if total is None:
                total = term
            elif not term.sign or term.sign != total.sign:
                return _UNKNOWN
            else:
                total = Range(total.sign, total.strict or term.strict)
        return total or _UNKNOWN


@remembered
def _is_nonzero(
    ring: TrigonometricRing, assumed: Assumptions, polynomial: Polynomial
) -> bool:
    if polynomial.is_constant():
        return bool(polynomial != 0)
    if ring.constant_angles and is_nonzero_number(ring, polynomial):
        return True
    common = polynomial.term_content()
    known = assumed.of_generators(ring)
    for generator, exponent in zip(known, common.monoms()[0], strict=True):
        if exponent and not generator.strict:
            return False
    rest = polynomial / common
    return assumed.range_of(ring, rest, known).strict or _keeps_its_sign(ring, rest)


def _keeps_its_sign(ring: TrigonometricRing, polynomial: Polynomial) -> bool:
    """Whether it is in one symbol, over the rational numbers, without a real zero."""
    used = [place for place, degree in enumerate(polynomial.degrees()) if degree]
    if len(used) != 1 or used[0] not in ring.symbol_indices():
        return False
    coefficients = [Fraction(0)] * (polynomial.degrees()[used[0]] + 1)
    for monomial, c in zip(polynomial.monoms(), polynomial.coeffs(), strict=True):
        coefficients[monomial[used[0]]] = Fraction(int(c.p), int(c.q))
    return not real_zeros(coefficients)


def _terms(
    ring: TrigonometricRing, polynomial: Polynomial
) -> Iterable[tuple[int, tuple[int, ...]]]:
    """(sign of the coefficient, monomial), algebraic numbers in the coefficient."""
    first = len(ring.names) - len(ring.constant_generators)
    size = len(ring.constant_generators)
    if not size:  # one by one: of most long ones a few terms are enough
        return (
            (1 if polynomial.coefficient(k) > 0 else -1, polynomial.monomial(k))
            for k in range(len(polynomial))
        )
    parts = [
        (tuple(map(int, e[:first])), tuple(map(int, e[first:])), c)
        for e, c in zip(polynomial.monoms(), polynomial.coeffs(), strict=True)
    ]
    parts.sort(key=itemgetter(0, 1))
    return [
        (_sign([(k, c) for _, k, c in group], ring), monomial + (0,) * size)
        for monomial, group in groupby(parts, key=itemgetter(0))
    ]


def _sign(terms: list[tuple[tuple[int, ...], Any]], ring: TrigonometricRing) -> int:
    """The sign of a real algebraic number, which is not 0 in normal form."""
    precision = ctx.prec
    try:
        while True:
            values = [ball_of(text) for text in ring.constant_generators.values()]
            total = arb(0)
            for exponents, coefficient in terms:
                term = arb(coefficient.p) / arb(coefficient.q)
                for value, exponent in zip(values, exponents, strict=True):
                    term *= value**exponent
                total += term
            if total > 0:
                return 1
            if total < 0:
                return -1
            ctx.prec *= 2
    finally:
        ctx.prec = precision


def ball_of(text: str) -> Any:
    """The ball of a constant: ``sqrt(3)`` or ``2*cos(pi/7)``."""
    number = int("".join(filter(str.isdigit, text.removeprefix("2*"))))
    if text.startswith("sqrt"):
        return arb(number).sqrt()
    return 2 * (arb.pi() / number).cos()
