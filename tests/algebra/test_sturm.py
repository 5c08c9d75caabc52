"""Real zeros counted: products of known factors have known numbers of them."""

from __future__ import annotations

from fractions import Fraction
from itertools import product

import pytest

from screwkit.algebra.sturm import real_zeros


def times(one: list[int], other: list[int]) -> list[int]:
    found = [0] * (len(one) + len(other) - 1)
    for (i, a), (k, b) in product(enumerate(one), enumerate(other)):
        found[i + k] += a * b
    return found


@pytest.mark.parametrize("zeros", [(), (0,), (1, 1), (-2, 0, 5), (3, 3, 3, -7)])
@pytest.mark.parametrize("pairs", [(), ((2, 0, 1),), ((1, -1, 1), (7, 2, 3))])
def test_zeros_are_counted_once_each(
    zeros: tuple[int, ...], pairs: tuple[tuple[int, ...], ...]
) -> None:
    """Factors x − z, and quadratics of negative discriminant."""
    polynomial = [-5]
    for z in zeros:
        polynomial = times(polynomial, [-z, 1])
    for pair in pairs:
        polynomial = times(polynomial, list(pair))
    assert real_zeros([Fraction(c, 3) for c in polynomial]) == len({*zeros})


def test_a_cubic_may_have_one_zero_or_three() -> None:
    assert real_zeros([Fraction(c) for c in (1, -3, 0, 1)]) == 3
    assert real_zeros([Fraction(c) for c in (3, -3, 0, 1, 0)]) == 1


def test_zero_is_no_polynomial_to_count_for() -> None:
    with pytest.raises(ValueError, match="zero"):
        real_zeros([Fraction(0)])
