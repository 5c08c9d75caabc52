"""Exact division of trigonometric polynomials.

The norm of a divisor, its product with the images under s → −s, contains no sine, and
divides as an ordinary polynomial; where it is long, half angles divide instead.  An
algebraic number of higher degree is a coefficient in long division.  What is not zero
at a zero of the divisor, modulo a prime, is refused before all that.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from functools import cached_property
from typing import Final

from flint.utils.flint_exceptions import DomainError

from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.modular import random_prime
from screwkit.algebra.number_division import quotient_over
from screwkit.algebra.points import Point, random_point, residue
from screwkit.algebra.points_on import moved_onto
from screwkit.algebra.remembered import remembered
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LARGEST_NORM = 1000  # products of terms
LARGEST_OF_ROOTS = 100_000  # where half angles are no help
_ATTEMPTS: Final = 12


class Divisor:
    """Divides by one polynomial, by its norm over angles and square roots in it.

    Attributes:
        polynomial: The divisor.
    """

    def __init__(
        self,
        polynomial: Polynomial,
        ring: TrigonometricRing,
        halves: HalfAngles,
        layout: Layout,
    ) -> None:
        self.polynomial = polynomial
        self._halves = halves
        self._ring = ring
        degrees = polynomial.degrees()
        minimal = dict(ring.algebraic_relations)
        roots = [i for i in layout.constants if degrees[i]]
        self._normed = all(len(minimal[i]) == 3 and minimal[i][1] == 0 for i in roots)
        sines = [s for s, _ in layout.angles if degrees[s]]
        self._number = _only_number(ring, roots) if not self._normed else None
        self._signs = (*sines, *(roots if self._normed else ()))
        self._largest = LARGEST_OF_ROOTS if roots else LARGEST_NORM

    def divide(self, polynomial: Polynomial) -> Polynomial | None:
        """The quotient, or None where the division was not found to be exact."""
        if not self._signs and self._number is None:
            return exact_quotient(polynomial, self.polynomial)
        if self._zero is not None and residue(polynomial, *self._zero):
            return None
        quotient = exact_quotient(polynomial, self.polynomial)
        if quotient is not None:
            return quotient
        norm = self._norm
        if norm is None:
            return self._halves.quotient(polynomial, self.polynomial)
        whole, cofactor = norm
        multiple = self._ring.normal(polynomial * cofactor)
        if self._number is None:
            return exact_quotient(multiple, whole)
        place, minimal = self._number
        return quotient_over(multiple, whole, place, minimal)

    @cached_property
    def _zero(self) -> tuple[Point, int] | None:
        return _zero_of(self._ring, None, self.polynomial)

    @cached_property
    def _norm(self) -> tuple[Polynomial, Polynomial] | None:
        if not self._normed and self._number is None:
            return None
        return _norm_of(self._ring, (self._signs, self._largest), self.polynomial)


@remembered
def _zero_of(
    ring: TrigonometricRing, _given: None, polynomial: Polynomial
) -> tuple[Point, int] | None:
    """A random zero and its prime; None where none was found.

    What the polynomial divides is zero there too: a prime of 60 bits, drawn at random,
    divides no denominator that a derivation meets.
    """
    if ring.extensions or polynomial.is_constant():
        return None
    source = random.Random(_ATTEMPTS)
    for _ in range(_ATTEMPTS):
        prime = random_prime(source)
        start = random_point(ring, source, prime)
        if start is None:  # √3, which the ring has, is no residue
            continue
        point = moved_onto(ring, [polynomial], start, source, prime)
        if point is not None and not residue(polynomial, point, prime):
            return point, prime
    return None


@remembered
def _norm_of(
    ring: TrigonometricRing, given: tuple[tuple[int, ...], int], polynomial: Polynomial
) -> tuple[Polynomial, Polynomial] | None:
    """The norm, and what it is times the polynomial; None where it is large."""
    signs, largest = given
    norm, cofactor = polynomial, ring.one
    for place in signs:
        generator = ring.names[place]
        mirrored = norm.subs({generator: 0}) * 2 - norm
        if len(mirrored) * len(norm) > largest:
            return None
        cofactor = ring.normal(cofactor * mirrored)
        norm = ring.normal(norm * mirrored)
    return norm, cofactor


def _only_number(
    ring: TrigonometricRing, places: Sequence[int]
) -> tuple[int, Sequence[int]] | None:
    """The one algebraic number of a divisor with its minimal polynomial.

    None where there are more, or square roots of symbols, with it.
    """
    minimal = dict(ring.algebraic_relations)
    others = [own for place, own in minimal.items() if place not in places]
    if len(places) != 1 or others or not isinstance(minimal[places[0]], tuple):
        return None
    return places[0], minimal[places[0]]


def exact_quotient(polynomial: Polynomial, divisor: Polynomial) -> Polynomial | None:
    """The quotient of polynomials, if that is one."""
    try:
        return polynomial / divisor
    except DomainError:
        return None
