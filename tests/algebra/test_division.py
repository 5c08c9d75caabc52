"""Exact division of trigonometric polynomials, by products with the divisor.

A quotient is known where the dividend was made of it; where the dividend is not zero at
all zeros of the divisor there is none.
"""

from __future__ import annotations

import pytest
from one_ring import in_one_ring

from screwkit.algebra.division import Divisor
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.restrictions import Layout

DIVISORS = [
    "a*sin(q) + b*cos(q)",
    "a + sin(q)",
    "sin(p - q)",
    "sqrt(3)*sin(q) + b*cos(p)",
    "sqrt(3)*a + b*sin(p)*sin(q)",
    "a^2 + b^2",
]
QUOTIENTS = ["cos(q)", "a*sin(p) + cos(q)^2 - b", "1/7*a + sqrt(3)*sin(q)"]


@pytest.mark.parametrize("divisor", DIVISORS)
@pytest.mark.parametrize("quotient", QUOTIENTS)
def test_products_are_divided_and_nothing_else(divisor: str, quotient: str) -> None:
    ring, (below, wanted, *others) = in_one_ring(
        divisor, quotient, "a", "sin(p)", "sqrt(3)*cos(q) - b"
    )
    layout = Layout.of(ring)
    divide = Divisor(below, ring, HalfAngles(ring, layout), layout).divide
    product = ring.normal(below * wanted)
    for _ in range(2):
        found = divide(product)
        assert found is not None
        assert ring.normal(found) == wanted
        # None of these is divided by the divisor, nor is such a sum.
        for other in others:
            assert divide(ring.normal(product + other)) is None


@pytest.mark.parametrize(
    "divisor", ["a*cos(pi/18) + sin(pi/9)", "b*sin(q) + 2*cos(pi/9)*a + sin(pi/18)"]
)
@pytest.mark.parametrize("quotient", ["a + cos(q)", "cos(pi/18)*sin(q) + a*b - 3"])
def test_numbers_of_higher_degree_are_coefficients(divisor: str, quotient: str) -> None:
    ring, (below, wanted, *others) = in_one_ring(
        divisor, quotient, "a", "sin(q)", "cos(pi/18)"
    )
    layout = Layout.of(ring)
    divide = Divisor(below, ring, HalfAngles(ring, layout), layout).divide
    product = ring.normal(below * wanted)
    found = divide(product)
    assert found is not None
    assert ring.normal(found) == wanted
    for other in others:
        assert divide(ring.normal(product + other)) is None
