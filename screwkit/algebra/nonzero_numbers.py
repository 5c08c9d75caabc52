"""Numbers made of sines and cosines of constant angles: which of them are not zero.

The sine and cosine of a rational number of radians are transcendental, so that no
polynomial in those of one angle with algebraic coefficients is zero unless it is the
zero polynomial in normal form [Lindemann1882].  Several constant angles may be related,
as 1/5 and 1/10 are; there an interval that leaves out 0 decides.

References: [Lindemann1882].
"""

from __future__ import annotations

from fractions import Fraction
from math import prod

from flint import arb, ctx, fmpq

from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

BITS = 256


def is_nonzero_number(ring: TrigonometricRing, polynomial: Polynomial) -> bool:
    """Whether a polynomial is proved to be a number other than zero.

    Args:
        ring: Of the polynomial.
        polynomial: In normal form; in symbols and other angles too, for which the
            answer is false.
    """
    if polynomial == 0:
        return False
    degrees = polynomial.degrees()
    first = len(ring.names) - len(ring.constant_generators)
    used = {i for i, degree in enumerate(degrees[:first]) if degree}
    values = {}
    for angle, form in enumerate(ring.basis):
        places = ring.sine_index(angle), ring.cosine_index(angle)
        if form[0][0] in ring.constant_angles and used.intersection(places):
            values[form[0][0]] = places
    if not values or used - {i for places in values.values() for i in places}:
        return False
    if len(values) == 1:
        return True
    if any(degrees[first:]):
        return False
    before = ctx.prec
    ctx.prec = BITS
    try:
        at = {}
        for text, (sine, cosine) in values.items():
            value = Fraction(text)
            size = arb(fmpq(value.numerator, value.denominator))
            at[sine], at[cosine] = size.sin(), size.cos()
        total = sum(
            (
                arb(coefficient) * prod(at[i] ** int(e) for i, e in enumerate(key) if e)
                for key, coefficient in polynomial.to_dict().items()
            ),
            arb(0),
        )
        return not total.contains(0)
    finally:
        ctx.prec = before
