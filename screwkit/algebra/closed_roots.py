"""The roots of a polynomial with rational coefficients, where they are short.

Linear and quadratic factors over the rationals are solved; a factor of higher degree
has no short roots, and then none are given.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm

from flint import fmpz_poly

from screwkit.algebra.expression import Expression, Number
from screwkit.algebra.expression_building import add, call, multiply
from screwkit.algebra.text import expression_text


def closed_roots(coefficients: Sequence[Fraction]) -> tuple[str, ...]:
    """All real roots with multiplicity, largest first; empty where one is not short.

    Args:
        coefficients: Constant term first.

    >>> closed_roots([Fraction(2), Fraction(-3), Fraction(1)])
    ('2', '1')
    >>> closed_roots([Fraction(5), Fraction(-41, 4), Fraction(1)])
    ('41/8 + sqrt(1361)/8', '41/8 - sqrt(1361)/8')
    >>> closed_roots([Fraction(2), Fraction(0), Fraction(0), Fraction(1)])
    ()
    """
    below = lcm(*(c.denominator for c in coefficients))
    _, factors = fmpz_poly([int(c * below) for c in coefficients]).factor()
    found: list[tuple[float, str]] = []
    for factor, multiplicity in factors:
        own = [Fraction(int(c)) for c in factor.coeffs()]
        if len(own) > 3:
            return ()
        found += _roots(own) * int(multiplicity)
    return tuple(text for _, text in sorted(found, reverse=True))


def _roots(coefficients: Sequence[Fraction]) -> list[tuple[float, str]]:
    if len(coefficients) == 2:
        constant, slope = coefficients
        root = -constant / slope
        return [(float(root), expression_text(Number(root)))]
    c, b, a = coefficients
    middle, square = -b / (2 * a), (b * b - 4 * a * c) / (4 * a * a)
    if square < 0:
        return []
    outside, inside = _square_part(square)
    radical = call("sqrt", Number(Fraction(inside)))
    size = float(outside) * float(inside) ** 0.5
    return [
        (
            float(middle) + sign * size,
            expression_text(_sum(middle, multiply(Number(sign * outside), radical))),
        )
        for sign in (1, -1)
    ]


def _sum(middle: Fraction, other: Expression) -> Expression:
    return add(Number(middle), other) if middle else other


def _square_part(value: Fraction) -> tuple[Fraction, int]:
    """The root of a rational as a rational times the root of a square-free integer."""
    number = value.numerator * value.denominator
    outside, inside, divisor = 1, number, 2
    while divisor * divisor <= inside and divisor < 100_000:
        while inside % (divisor * divisor) == 0:
            inside //= divisor * divisor
            outside *= divisor
        divisor += 1
    return Fraction(outside, value.denominator), inside
