"""Polynomials quadratic in a symbol that are nowhere of the other sign.

4·A·(A·x² + B·x + C) = (2·A·x + B)² + 4·A·C − B².  Where the rest is a square, or a sum
of terms that are not negative, both are zero at every real zero: the circle
(x − k)² + (y − √3·k)² = 0, multiplied out, is one point.
"""

from __future__ import annotations

from typing import Final

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.division import exact_quotient
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.scaled_symbols import scaled
from screwkit.algebra.solved_text import root_of_square
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
    primitive,
)

TERMS: Final = 200
"""Products of terms in the rest."""


def completed_square(
    ring: TrigonometricRing, assumptions: Assumptions, polynomial: Polynomial
) -> list[Polynomial] | None:
    """What vanishes at every real zero of a polynomial that is a sum of two squares.

    Args:
        ring: Of the polynomial.
        assumptions: Signs of the symbols.
        polynomial: In normal form, not zero.

    Returns:
        The halves and the polynomial itself; 1 where it has no real zero; None where
        no symbol completes a square.
    """
    degrees = polynomial.degrees()
    for place in ring.symbol_indices():
        if degrees[place] != 2:
            continue
        name = ring.names[place]
        slope = polynomial.derivative(place)
        twice = slope.derivative(place)  # 2·A
        middle = slope.subs({name: 0})  # B
        last = polynomial.subs({name: 0})  # C
        if len(twice) * len(last) + len(middle) ** 2 > TERMS:
            continue
        rest = ring.normal(2 * twice * last - middle * middle)
        if assumptions.sign_of(ring, rest) is not None:
            if assumptions.sign_of(ring, rest) == 1:
                return [ring.one]
            continue
        if not polynomial.gcd(rest).is_constant():
            continue  # a product, which is better factored
        root = _root(ring, rest)
        if root is not None:
            return [primitive(slope), primitive(root), polynomial]
        if assumptions.range_of(ring, rest, assumptions.of_generators(ring)).sign == 1:
            return [primitive(slope), primitive(rest), polynomial]
    return None


def _root(ring: TrigonometricRing, value: Polynomial) -> Polynomial | None:
    """A polynomial whose square is a positive rational multiple of the value."""
    found = root_and_number(ring, value)
    return None if found is None else found[0]


def root_and_number(
    ring: TrigonometricRing, value: Polynomial
) -> tuple[Polynomial, Polynomial] | None:
    """A polynomial and a positive rational number whose product, squared once, it is.

    Args:
        ring: Of the value.
        value: Not zero; it need not be in normal form.

    Returns:
        (g, k) with k·g² equal to the value; None where it is not found to be one.
    """
    shape = primitive(value)
    found = root_of_square(shape)
    if found is None:
        found = _scaled_root(ring, shape)
    if found is None:
        return None
    ratio = exact_quotient(ring.normal(value), ring.normal(found * found))
    if ratio is None or not ratio.is_constant() or as_fraction(ratio) <= 0:
        return None
    return found, ratio


def _scaled_root(ring: TrigonometricRing, value: Polynomial) -> Polynomial | None:
    """Of y² − 2·√3·k·y + 3·k², a square with y in units of √3."""
    form = scaled(ring, Layout.of(ring), value)
    if form is None or form.odd:
        return None
    found = root_of_square(form.polynomial)
    return None if found is None else form.unscaled(found)[0]
