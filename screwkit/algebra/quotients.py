"""Exact quotients of polynomials with sines, cosines and square roots of numbers."""

from __future__ import annotations

from screwkit.algebra.division import Divisor, exact_quotient
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.over_roots import square_roots
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def quotient_of(
    ring: TrigonometricRing,
    value: Polynomial,
    below: Polynomial,
    library: FactorLibrary | None = None,
) -> Polynomial | None:
    """An exact quotient, if one is found.

    Args:
        ring: Of both.
        value: In normal form.
        below: Not zero.
        library: Of the ring; tells whether a value holds further algebraic numbers.
    """
    plain = exact_quotient(value, below) or _by_root(ring, value, below)
    if plain is not None or (library is not None and library.is_extended(value)):
        return plain
    layout = Layout.of(ring)
    found = Divisor(below, ring, HalfAngles(ring, layout), layout).divide(value)
    degrees = below.degrees()
    if found is None and any(degrees[place] for place in layout.constants):
        return _by_conjugates(ring, value, below)
    return found


def _by_root(
    ring: TrigonometricRing, value: Polynomial, below: Polynomial
) -> Polynomial | None:
    """A quotient that holds a square root of a number below the line."""
    for root in square_roots(ring):
        number = ring.context.gens()[root.place]
        found = exact_quotient(ring.normal(value * number), below)
        if found is not None:
            return ring.normal(found * number) / root.square
    return None


def _by_conjugates(
    ring: TrigonometricRing, value: Polynomial, below: Polynomial
) -> Polynomial | None:
    """A quotient by a divisor made rational first: times what it is with −√."""
    for name in ring.constant_generators:
        if below.degrees()[ring.names.index(name)]:
            mirrored = below.subs({name: 0}) * 2 - below
            value = ring.normal(value * mirrored)
            below = ring.normal(below * mirrored)
    layout = Layout.of(ring)
    if any(below.degrees()[place] for place in layout.constants):
        return None  # no square roots
    found = exact_quotient(value, below)
    return found or HalfAngles(ring, layout).quotient(value, below)
