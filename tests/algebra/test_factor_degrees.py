"""Degrees of factors, against products made of known ones."""

from __future__ import annotations

import random

import pytest
from flint import nmod_poly

from screwkit.algebra.factor_degrees import factor_degrees, sums_of

PRIME = 10007


@pytest.mark.parametrize("degrees", [(1,), (3,), (1, 1, 2), (2, 2, 3), (1, 4, 5)])
def test_degrees_of_a_product_are_those_of_its_factors(
    degrees: tuple[int, ...],
) -> None:
    source = random.Random(2)
    product, seen = nmod_poly([1], PRIME), set[tuple[int, ...]]()
    for degree in degrees:
        while True:  # FLINT tells which random polynomials are irreducible
            own = [source.randrange(PRIME) for _ in range(degree)] + [1]
            _, factors = nmod_poly(own, PRIME).factor()
            if len(factors) == 1 and factors[0][1] == 1 and tuple(own) not in seen:
                break
        seen.add(tuple(own))
        product = product * nmod_poly(own, PRIME)
    assert factor_degrees(product) == degrees


def test_a_square_says_nothing() -> None:
    assert factor_degrees(nmod_poly([1, 2, 1], PRIME)) is None


def test_sums_of_degrees() -> None:
    assert sums_of((1, 3)) == {0, 1, 3, 4}
    assert sums_of(()) == {0}
