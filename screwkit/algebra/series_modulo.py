"""Power series in one variable modulo a prime, cut off at an order that may grow.

Enough to follow a motion from its posture: products, reciprocals and the arc tangent
that a helix needs.  Coefficients are exact, so that one that is not zero is not zero.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from flint import nmod_poly

Series: TypeAlias = Any  # flint.nmod_poly, which has no type stubs


@dataclass(frozen=True)
class SeriesRing:
    """Series modulo a prime and modulo s to the power ``order``."""

    prime: int
    order: int

    def series(self, coefficients: Sequence[int]) -> Series:
        """From the constant term upwards."""
        return nmod_poly(list(coefficients[: self.order]), self.prime)

    def times(self, left: Series, right: Series) -> Series:
        """The product, cut off."""
        return left.mul_low(right, self.order)

    def cut(self, series: Series) -> Series:
        """A longer series cut off at the order of this ring."""
        return series.truncate(self.order)

    def scaled_arctangent(self, series: Series, square: int) -> Series:
        """∫ dt / (1 + square·t²) along t = series, whose constant term is zero."""
        if not series.length():
            return series
        below = 1 + square * self.times(series, series)
        slope = self.times(series.derivative(), below.inverse_series_trunc(self.order))
        return self.cut(slope.integral())

    def reciprocal(self, series: Series) -> Series:
        """1/series; its constant term must not be zero."""
        return series.inverse_series_trunc(self.order)


def first_order(series: Series) -> int | None:
    """The least power with a coefficient that is not zero; None for zero."""
    if not series.length():
        return None
    return next(k for k, x in enumerate(series.coeffs()) if int(x))


def double_root(values: Sequence[int], prime: int) -> int | None:
    """The one double root of a polynomial with values at 0, 1, 2 …, if it has just one.

    Args:
        values: One more than its degree.
        prime: The modulus.
    """
    total = nmod_poly([0], prime)
    for k, value in enumerate(values):
        term = nmod_poly([value], prime)
        for other in range(len(values)):
            if other != k:
                term *= nmod_poly([-other, 1], prime)
                term *= pow(k - other, -1, prime)
        total += term
    shared = total.gcd(total.derivative())
    if shared.degree() != 1:
        return None
    return int(-int(shared[0]) * pow(int(shared[1]), -1, prime) % prime)


def common_roots(polynomials: Sequence[Sequence[int]], prime: int) -> tuple[int, ...]:
    """What all polynomials have as a root, coefficients from the constant upwards."""
    shared = nmod_poly([0], prime)
    for coefficients in polynomials:
        shared = shared.gcd(nmod_poly(list(coefficients), prime))
    if shared.degree() < 1:
        return ()
    return tuple(sorted(int(root) for root, _ in shared.roots()))
