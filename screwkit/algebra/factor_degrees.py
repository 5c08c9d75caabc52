"""Degrees of the irreducible factors of a polynomial over a prime field.

The factor of degree d divides x^(p^d) − x; greatest common divisors are all that is
taken, and no factor is split further.

References: [vonzurGathenGerhard2013] §14.2 (distinct degrees).
"""

from __future__ import annotations

from typing import Any

from flint import nmod_poly


def factor_degrees(polynomial: Any) -> tuple[int, ...] | None:
    """The degrees, ascending; None where a factor is met twice."""
    if polynomial.gcd(polynomial.derivative()).degree() > 0:
        return None
    prime = polynomial.modulus()
    x = nmod_poly([0, 1], prime)
    left, found, degree = polynomial, list[int](), 0
    frobenius = raised = x.pow_mod(prime, left) if left.degree() > 1 else x
    while left.degree() >= 2 * (degree + 1):
        degree += 1
        shared = left.gcd(raised - x)
        found += [degree] * (shared.degree() // degree)
        left = left // shared
        frobenius, raised = frobenius % left, raised % left
        if left.degree() > 0:
            raised = raised.compose_mod(frobenius, left)
    if left.degree() > 0:
        found.append(left.degree())
    return tuple(found)


def sums_of(degrees: tuple[int, ...]) -> set[int]:
    """Degrees that a product of some of the factors can have."""
    sums = {0}
    for degree in degrees:
        sums |= {degree + other for other in sums}
    return sums
