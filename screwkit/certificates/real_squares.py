"""Polynomials that are sums of squares with positive weights, as a certificate says it.

At real postures all of the squares are 0 then.  Complex ones, where they need not be,
are no postures: 2 + 2·cos p·cos q − sin p·sin q is 0 where both sines are 0 alone.
What keeps its sign is found as in `algebra.real_zeros`; here it is written down.
"""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.completed_squares import root_and_number
from screwkit.algebra.real_zeros import homogeneous
from screwkit.algebra.substitution import angle_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LONGEST = 40
"""Terms of a polynomial that is looked at."""


@dataclass(frozen=True)
class SumOfSquares:
    """A multiple of a polynomial as a sum.

    Attributes:
        times: What the polynomial is multiplied with.
        squares: Weights, positive by the signs of their terms, and bases.
    """

    times: Polynomial
    squares: tuple[tuple[Polynomial, Polynomial], ...]


def sum_of_squares(
    ring: TrigonometricRing, assumptions: Assumptions, polynomial: Polynomial
) -> SumOfSquares | None:
    """A polynomial as a sum of squares; None if it was not found to be one.

    Args:
        ring: Of the polynomial.
        assumptions: Signs of the symbols.
        polynomial: In normal form, not zero.
    """
    if not 1 < len(polynomial) <= LONGEST:
        return None
    return (
        _of_terms(ring, assumptions, polynomial)
        or _of_an_angle(ring, polynomial)
        or _of_a_symbol(ring, polynomial)
    )


def _of_terms(
    ring: TrigonometricRing, assumptions: Assumptions, polynomial: Polynomial
) -> SumOfSquares | None:
    """Whose terms have one sign, 1 written as a sum of squares where that helps."""
    gens = ring.context.gens()
    for written in (polynomial, homogeneous(ring, polynomial)):
        if len(written) < 2 or not assumptions.has_one_sign(ring, written):
            continue
        squares = []
        for exponents, coefficient in written.to_dict().items():
            weight, base = ring.one * abs(coefficient), ring.one
            for generator, exponent in zip(gens, map(int, exponents), strict=True):
                weight = weight * generator ** (exponent % 2)
                base = base * generator ** (exponent // 2)
            squares.append((weight, base))
        total = ring.normal(sum((w * b * b for w, b in squares), ring.zero))
        times = ring.one if total == polynomial else -ring.one
        if total in (polynomial, -polynomial):
            return SumOfSquares(times, tuple(squares))
    return None


def _of_an_angle(
    ring: TrigonometricRing, polynomial: Polynomial
) -> SumOfSquares | None:
    """E + a·sin φ + b·cos φ, times e − a·sin φ − b·cos φ: e² − a² − b² is a square.

    What is left is the square of a·cos φ − b·sin φ.
    """
    gens = ring.context.gens()
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, polynomial, angle)
        if parts is None or parts[2] == 0:
            continue
        sine, cosine = gens[ring.sine_index(angle)], gens[ring.cosine_index(angle)]
        a, b, e = parts
        beyond = ring.normal(e * e - a * a - b * b)
        for written in (beyond, homogeneous(ring, beyond)) if beyond != 0 else ():
            found = root_and_number(ring, written)
            if found is not None:
                root, number = found
                across = ring.normal(a * cosine - b * sine)
                squares = ((number, ring.normal(root)), (ring.one, across))
                return SumOfSquares(ring.normal(e - a * sine - b * cosine), squares)
    return None


def _of_a_symbol(
    ring: TrigonometricRing, polynomial: Polynomial
) -> SumOfSquares | None:
    """A·x² + B·x + C, times 4·A: (2·A·x + B)² and 4·A·C − B², another square."""
    for place in ring.symbol_indices():
        if polynomial.degrees()[place] != 2:
            continue
        slope = polynomial.derivative(place)
        twice = slope.derivative(place)
        zero = {ring.names[place]: 0}
        middle, last = slope.subs(zero), polynomial.subs(zero)
        rest = ring.normal(2 * twice * last - middle * middle)
        found = None if rest == 0 else root_and_number(ring, rest)
        if found is not None:
            root, number = found
            return SumOfSquares(2 * twice, ((number, root), (ring.one, slope)))
    return None
