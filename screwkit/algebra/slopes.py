"""How polynomials of sines, cosines and symbols change with each unknown."""

from __future__ import annotations

from screwkit.algebra.points_on import Unknown
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def slope(
    ring: TrigonometricRing, polynomial: Polynomial, unknown: Unknown
) -> Polynomial:
    """The derivative by a basis angle, or by a symbol."""
    kind, number = unknown
    if kind != "angle":
        return polynomial.derivative(number)
    sine, cosine = ring.sine_index(number), ring.cosine_index(number)
    gens = ring.context.gens()
    return ring.normal(
        polynomial.derivative(sine) * gens[cosine]
        - polynomial.derivative(cosine) * gens[sine]
    )
