"""Whether equations in one unknown alone have a common real zero: decided, not sampled.

An angle becomes the tangent of its half; the angle π, which has none, is looked at
itself.  Roots are isolated by FLINT, which tells real ones from complex ones.  With
square roots in the equations these are zeros of products with conjugates, and belong to
a conjugate alone where balls show that an equation is not 0 there.
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from math import lcm
from typing import Any

from flint import arb, ctx, fmpq_poly

from screwkit.algebra.assumptions import ball_of
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

_BITS = 256  # of the balls around roots


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
    by_unknown: dict[Unknown, list[tuple[Polynomial, Polynomial]]] = {}
    for given in equations:
        own = unknowns(ring, given)
        if len(own) != 1:
            continue
        equation = _rational(ring, given)
        degrees = equation.degrees()
        if not any(degrees[i] for i in irrational):
            by_unknown.setdefault(own[0], []).append((given, equation))
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
    ring: TrigonometricRing,
    equations: Sequence[tuple[Polynomial, Polynomial]],
    unknown: Unknown,
) -> bool:
    """Whether equations, each with its product with conjugates, have a common zero."""
    before = ctx.prec
    ctx.prec = _BITS
    try:
        kind, _ = unknown
        if kind == "angle" and all(_at_pi(ring, e, unknown) for e in equations):
            return True
        common = fmpq_poly([0])
        for _, product in equations:
            common = common.gcd(_univariate(ring, product, unknown))
        if common.degree() < 1:
            return False
        _, factors = common.numer().factor()
        return any(
            root.imag == 0
            and all(_may_vanish(ring, e, unknown, root.real) for e, _ in equations)
            for factor, _ in factors
            for root, _ in factor.complex_roots()
        )
    finally:
        ctx.prec = before


def _at_pi(
    ring: TrigonometricRing, equation: tuple[Polynomial, Polynomial], unknown: Unknown
) -> bool:
    """Whether an equation may vanish at π, where the half has no tangent."""
    given, product = equation
    sine, cosine = ring.sine_index(unknown[1]), ring.cosine_index(unknown[1])
    values = {sine: arb(0), cosine: arb(-1)}
    exact = _at(product, {sine: 0, cosine: -1})
    return exact == 0 and bool(_ball(ring, given, values).contains(0))


def _may_vanish(
    ring: TrigonometricRing, given: Polynomial, unknown: Unknown, root: Any
) -> bool:
    """Whether by balls an equation may vanish at a root of its product."""
    kind, number = unknown
    if kind == "x":
        values = {number: root}
    else:
        below = 1 + root * root
        values = {
            ring.sine_index(number): 2 * root / below,
            ring.cosine_index(number): (1 - root * root) / below,
        }
    return bool(_ball(ring, given, values).contains(0))


def _ball(
    ring: TrigonometricRing, polynomial: Polynomial, values: dict[int, Any]
) -> Any:
    """Around the value of a polynomial in one unknown and numbers."""
    known = dict(values)
    for name, text in ring.constant_generators.items():
        known[ring.names.index(name)] = ball_of(text)
    total = arb(0)
    for exponents, coefficient in polynomial.to_dict().items():
        term = arb(coefficient.p) / arb(coefficient.q)
        for index, exponent in enumerate(exponents):
            if exponent:
                term *= known[index] ** int(exponent)
        total += term
    return total


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
