"""Whether equations in one unknown alone have a common real zero: decided, not sampled.

An angle becomes the tangent of its half; the angle π, which has none, is looked at
itself.  Roots are isolated by FLINT, which tells real ones from complex ones.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from typing import Any

from flint import fmpq_poly

from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def never_met(ring: TrigonometricRing, equations: Sequence[Polynomial]) -> bool:
    """Whether it is proved that equations have no common real zero.

    Args:
        ring: Of the equations.
        equations: In normal form; those in more unknowns than one, or with
            irrational numbers that are no square roots, are passed over.
    """
    if any(e.is_constant() and e != 0 for e in equations):
        return True
    numbers = [ring.names.index(name) for name in ring.constant_generators]
    irrational = [*range(len(ring.extensions)), *numbers]
    by_unknown: dict[Unknown, list[Polynomial]] = {}
    for given in equations:
        own = unknowns(ring, given)
        if len(own) != 1:
            continue
        equation = _rational(ring, given)
        degrees = equation.degrees()
        if not any(degrees[i] for i in irrational):
            by_unknown.setdefault(own[0], []).append(equation)
    return any(
        not _has_real_zero(ring, own, unknown) for unknown, own in by_unknown.items()
    )


def _rational(ring: TrigonometricRing, equation: Polynomial) -> Polynomial:
    """The product of an equation with its conjugates: it vanishes wherever that does.

    Without square roots; other irrational numbers stay.
    """
    for name in ring.constant_generators:
        index = ring.names.index(name)
        if equation.degrees()[index]:
            gens = list(ring.context.gens())
            gens[index] = -gens[index]
            equation = ring.normal(equation * equation.compose(*gens))
    return equation


def _has_real_zero(
    ring: TrigonometricRing, equations: Sequence[Polynomial], unknown: Unknown
) -> bool:
    kind, number = unknown
    if kind == "angle":
        at_pi = {ring.sine_index(number): 0, ring.cosine_index(number): -1}
        if all(_at(equation, at_pi) == 0 for equation in equations):
            return True
    common = fmpq_poly([0])
    for equation in equations:
        common = common.gcd(_univariate(ring, equation, unknown))
    if common.degree() < 1:
        return False
    _, factors = common.numer().factor()
    for factor, _ in factors:
        for root, _ in factor.complex_roots():
            if root.imag == 0:
                return True
    return False


def _at(equation: Polynomial, values: dict[int, int]) -> Fraction:
    total = Fraction(0)
    for exponents, coefficient in equation.to_dict().items():
        term = Fraction(int(coefficient.p), int(coefficient.q))
        for index, exponent in enumerate(exponents):
            if exponent:
                term *= values[index] ** int(exponent)
        total += term
    return total


def _univariate(ring: TrigonometricRing, equation: Polynomial, unknown: Unknown) -> Any:
    """In the symbol, or in the tangent of half the angle without its divisor."""
    kind, number = unknown
    terms = equation.to_dict()
    below = lcm(*(int(c.q) for c in terms.values()))
    if kind == "x":
        parts = {
            int(e[number]): int(c.p) * (below // int(c.q)) for e, c in terms.items()
        }
        return fmpq_poly([parts.get(k, 0) for k in range(max(parts) + 1)])
    sine, cosine = ring.sine_index(number), ring.cosine_index(number)
    degree = max(int(e[sine] + e[cosine]) for e in terms)
    t = fmpq_poly([0, 1])
    total = fmpq_poly([0])
    for e, c in terms.items():
        s, k = int(e[sine]), int(e[cosine])
        scale = int(c.p) * (below // int(c.q))
        total += (
            scale * (2 * t) ** s * (1 - t * t) ** k * (1 + t * t) ** (degree - s - k)
        )
    return total
