"""Exact division over a field of one algebraic number, such as Q(2 cos π/18).

Long division by leading terms, with coefficients in the field.  For numbers of higher
degree the norm of a divisor, which divides over the rationals, is too long to be made.

References: [CoxLittleOShea] §2.3.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, TypeAlias

from flint import fmpq_poly

from screwkit.algebra.trigonometric import Polynomial

MOST_PRODUCTS: Final = 100_000
"""Products of coefficients in one division."""

Coefficients: TypeAlias = dict[tuple[int, ...], fmpq_poly]


def quotient_over(
    polynomial: Polynomial, divisor: Polynomial, place: int, minimal: Sequence[int]
) -> Polynomial | None:
    """The quotient, or None where the division was not found to be exact.

    Args:
        polynomial: Of degree in the number below that of the minimal polynomial.
        divisor: Likewise, and not zero.
        place: Of the number among the generators.
        minimal: Coefficients of its minimal polynomial, of the constant first.
    """
    modulus = fmpq_poly([*minimal])
    below = _coefficients(divisor, place)
    lead = max(below)
    inverse = _inverse(below[lead], modulus)
    left = _coefficients(polynomial, place)
    found: Coefficients = {}
    while left:
        highest = max(left)
        power = tuple(a - b for a, b in zip(highest, lead, strict=True))
        if min(power) < 0 or len(found) * len(below) > MOST_PRODUCTS:
            return None
        number = left[highest] * inverse % modulus
        found[power] = number
        for exponents, own in below.items():
            key = tuple(a + b for a, b in zip(exponents, power, strict=True))
            value = (left.get(key, fmpq_poly()) - own * number) % modulus
            if value:
                left[key] = value
            else:
                left.pop(key, None)
    return _polynomial(found, place, polynomial)


def _coefficients(polynomial: Polynomial, place: int) -> Coefficients:
    """By the monomial in the other generators, polynomials in the number."""
    parts: dict[tuple[int, ...], dict[int, object]] = {}
    for exponents, value in polynomial.to_dict().items():
        own = tuple(0 if i == place else int(e) for i, e in enumerate(exponents))
        parts.setdefault(own, {})[int(exponents[place])] = value
    return {
        key: fmpq_poly([powers.get(k, 0) for k in range(max(powers) + 1)])
        for key, powers in parts.items()
    }


def _inverse(value: fmpq_poly, modulus: fmpq_poly) -> fmpq_poly:
    """One over a number that is not zero."""
    common, inverse, _ = value.xgcd(modulus)
    return inverse / common[0] % modulus


def _polynomial(found: Coefficients, place: int, like: Polynomial) -> Polynomial:
    terms = {
        (*key[:place], power, *key[place + 1 :]): value[power]
        for key, value in found.items()
        for power in range(value.degree() + 1)
        if value[power] != 0
    }
    return like.context().from_dict(terms)
