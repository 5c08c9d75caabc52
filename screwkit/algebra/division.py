"""Exact division of trigonometric polynomials.

The norm of a divisor, its product with the images under s → −s, contains no sine, and
divides as an ordinary polynomial; where it is long, half angles divide instead.
"""

from __future__ import annotations

from flint.utils.flint_exceptions import DomainError

from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LARGEST_NORM = 1000  # products of terms
LARGEST_OF_ROOTS = 100_000  # where half angles are no help


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
        self._signs = sines + roots
        self._largest = LARGEST_OF_ROOTS if roots else LARGEST_NORM
        self._norm: tuple[Polynomial, Polynomial] | None = None

    def divide(self, polynomial: Polynomial) -> Polynomial | None:
        """The quotient, or None where the division was not found to be exact."""
        quotient = exact_quotient(polynomial, self.polynomial)
        if quotient is not None or not self._signs:
            return quotient
        if self._norm is None and self._normed:
            self._norm = self._with_cofactor()
            self._normed = self._norm is not None
        if self._norm is None:
            return self._halves.quotient(polynomial, self.polynomial)
        norm, cofactor = self._norm
        return exact_quotient(self._ring.normal(polynomial * cofactor), norm)

    def _with_cofactor(self) -> tuple[Polynomial, Polynomial] | None:
        """The norm, and what it is times the polynomial; None where it is large."""
        norm, cofactor = self.polynomial, self._ring.one
        for place in self._signs:
            generator = self._ring.names[place]
            mirrored = norm.subs({generator: 0}) * 2 - norm
            if len(mirrored) * len(norm) > self._largest:
                return None
            cofactor = self._ring.normal(cofactor * mirrored)
            norm = self._ring.normal(norm * mirrored)
        return norm, cofactor


def exact_quotient(polynomial: Polynomial, divisor: Polynomial) -> Polynomial | None:
    """The quotient of polynomials, if that is one."""
    try:
        return polynomial / divisor
    except DomainError:
        return None
