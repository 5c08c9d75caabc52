"""Factors over Q(√3) that show when some symbols are counted in units of √3."""

from __future__ import annotations

import pytest
from one_ring import in_one_ring

from screwkit.algebra.factors import factor
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.scaled_symbols import scaled

SQUARE = "3*sqrt(3)*x**2 + 6*x*y + sqrt(3)*y**2"  # √3 (√3 x + y)²
PRODUCT = "(x + sqrt(3)*y)*(x*y + sqrt(3)*z*w)"


@pytest.mark.parametrize(
    ("text", "multiplicities", "irrational"),
    [
        (SQUARE, [2], True),
        (PRODUCT, [1, 1], False),
        ("(x + sqrt(3)*y)**2*(x - sqrt(3)*y + z)", [1, 2], False),
        ("sqrt(3)*x*(x + sqrt(3)*y)", [1, 1], True),
        ("(x - 1)*(x + 1)*(x*y + sqrt(3)*z)", [1, 1, 1], False),
        ("(x**2 + y + x - sqrt(3)*z)*(x**2 + y - x + sqrt(3)*z)", [1, 1], False),
    ],
)
def test_the_factors_make_up_the_polynomial(
    text: str, multiplicities: list[int], irrational: bool
) -> None:
    ring, (value,) = in_one_ring(text)
    found = factor(ring, value)
    assert sorted(n for _, n in found.factors) == multiplicities
    assert found.certified
    assert found.expand(ring) == value
    assert (found.unit is not None) == irrational


def test_proportional_polynomials_have_the_same_factors() -> None:
    """Multiples by √3 are one locus and get one key."""
    form = "2*a*x + sqrt(3)*a*y - z**2"
    ring, (plain, multiple) = in_one_ring(form, f"sqrt(3)*({form})")
    keys = [[f.key for f, _ in factor(ring, p).factors] for p in (plain, multiple)]
    assert keys[0] == keys[1]
    assert len(keys[0]) == 1


def test_the_scaled_polynomial_is_rational_and_leads_back() -> None:
    ring, (value, rest) = in_one_ring("x**2 - 2*sqrt(3)*x*y + 3*y**2", "x - sqrt(3)*y")
    form = scaled(ring, Layout.of(ring), value)
    assert form is not None
    assert not form.polynomial.degrees()[form.root]
    ((piece, power),) = form.polynomial.factor()[1]
    assert power == 2
    assert form.unscaled(piece)[0] in (rest, -rest)


@pytest.mark.parametrize("text", ["x + y", "x + sqrt(3)*x", "sqrt(2)*x + sqrt(3)*y"])
def test_nothing_is_scaled_where_that_does_not_help(text: str) -> None:
    """No root; one that no choice of symbols takes away; two of them."""
    ring, (value,) = in_one_ring(text)
    assert scaled(ring, Layout.of(ring), value) is None
