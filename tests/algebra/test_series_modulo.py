"""Truncated series against the textbook's coefficients."""

from __future__ import annotations

from fractions import Fraction

from screwkit.algebra.series_modulo import (
    SeriesRing,
    common_roots,
    double_root,
    first_order,
)

PRIME = 2**61 - 1
RING = SeriesRing(PRIME, 8)


def residue(value: Fraction) -> int:
    return value.numerator * pow(value.denominator, -1, PRIME) % PRIME


def test_arc_tangent_by_leibniz() -> None:
    series = RING.scaled_arctangent(RING.series([0, 1]), 1)
    signs = [0, 1, 0, -1, 0, 1, 0, -1]
    expected = [residue(Fraction(sign, max(k, 1))) for k, sign in enumerate(signs)]
    assert [int(c) for c in series.coeffs()] == expected


def test_products_are_cut_off() -> None:
    ring = RING.series([1] * 12)
    assert [int(c) for c in RING.times(ring, ring).coeffs()] == list(range(1, 9))
    assert RING.cut(SeriesRing(PRIME, 20).series(range(20))).length() == 8


def test_reciprocal_of_the_geometric_series() -> None:
    reciprocal = RING.reciprocal(RING.series([1, PRIME - 1]))
    assert [int(c) for c in reciprocal.coeffs()] == [1] * 8


def test_first_order() -> None:
    assert first_order(RING.series([])) is None
    assert first_order(RING.series([0, 0, 5, 1])) == 2


def test_the_one_double_root_is_found_from_values() -> None:
    """(x − 5)² (x² + x + 3); with another square beside it there are two."""
    values = [(x - 5) ** 2 * (x * x + x + 3) for x in range(5)]
    assert double_root([v % PRIME for v in values], PRIME) == 5
    twice = [(x - 5) ** 2 * (x - 2) ** 2 for x in range(5)]
    assert double_root(twice, PRIME) is None
    assert double_root([x * x + x + 3 for x in range(3)], PRIME) is None


def test_common_roots() -> None:
    """(x − 2)(x − 3) and (x − 2)(x + 1)."""
    assert common_roots([(6, -5, 1), (-2, -1, 1)], PRIME) == (2,)
    assert common_roots([(6, -5, 1), (1, 2, 1)], PRIME) == ()
    assert common_roots([(0, 0, 0)], PRIME) == ()
