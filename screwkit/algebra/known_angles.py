"""Angles that are rational multiples of π, told by their cosines in an exact field.

cos φ = x holds for a multiple of 2π/k exactly where the Chebyshev polynomial T_k is 1
at x; which multiple it is, balls tell, for there are finitely many.

References: [Washington1997] §2.
"""

from __future__ import annotations

from fractions import Fraction
from math import gcd
from typing import Final

from flint import arb, ctx, fmpq

from screwkit.algebra.constant_multiples import ball, inverse, sign
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

ORDER: Final = 48
"""Parts of a full turn at most: the multiples of π/24, and of π/n up to n = 24."""


def turns_of_cosine(ring: TrigonometricRing, cosine: Polynomial) -> Fraction | None:
    """φ/π in [0, 1] for a number cos φ of the ring's field.

    None where φ/π is not rational, or is no multiple of 2/k with k up to `ORDER`.
    """
    before, now = ring.one, cosine
    for order in range(1, ORDER + 1):
        if now == 1:
            return _among(ring, cosine, order)
        before, now = now, ring.normal(2 * cosine * now - before)
    return None


def turns_of_tangent(ring: TrigonometricRing, tangent: Polynomial) -> Fraction | None:
    """φ/π in (−1/2, 1/2) for a number tan φ; by the cosine of 2·φ."""
    square = ring.normal(tangent * tangent)
    double = ring.normal((1 - square) * inverse(ring, 1 + square))
    turns = turns_of_cosine(ring, double)
    return None if turns is None else sign(ring, tangent) * turns / 2


def turns_of_direction(
    ring: TrigonometricRing, cosine: Polynomial, sine: Polynomial
) -> Fraction | None:
    """φ/π in (−1, 1] for numbers cos φ and sin φ, whose squares have the sum 1."""
    turns = turns_of_cosine(ring, cosine)
    return -turns if turns is not None and sign(ring, sine) < 0 else turns


def _among(ring: TrigonometricRing, cosine: Polynomial, order: int) -> Fraction:
    """Which multiple of 2/k an angle is that is one, of no smaller k."""
    left = [j for j in range(order // 2 + 1) if gcd(j, order) == 1]
    bits = 64
    while len(left) > 1:
        with ctx.workprec(bits):
            value = ball(ring, cosine)
            left = [
                j
                for j in left
                if (value - arb.cos_pi_fmpq(fmpq(2 * j, order))).contains(0)
            ]
        bits *= 2
    return Fraction(2 * left[0], order)
