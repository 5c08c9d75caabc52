"""Fractions from their residues."""

from __future__ import annotations

from fractions import Fraction
from math import isqrt

from hypothesis import given
from hypothesis import strategies as st

from screwkit.algebra.short_fractions import short_fraction

PRIME = 2**61 - 1
LARGEST = isqrt(PRIME // 2)


@given(st.integers(-LARGEST, LARGEST), st.integers(1, LARGEST))
def test_a_short_fraction_comes_back(above: int, below: int) -> None:
    residue = above * pow(below, -1, PRIME) % PRIME
    assert short_fraction(residue, PRIME, LARGEST) == Fraction(above, below)


@given(st.integers(0, PRIME - 1))
def test_what_comes_out_is_short_and_has_the_residue(residue: int) -> None:
    found = short_fraction(residue, PRIME, 1000)
    if found is None:
        return
    assert max(abs(found.numerator), found.denominator) <= 1000
    assert (found.numerator - residue * found.denominator) % PRIME == 0


def test_a_long_one_is_none() -> None:
    third = pow(3, -1, PRIME)
    assert short_fraction(third, PRIME, 2) is None
    assert short_fraction(third, PRIME, 3) == Fraction(1, 3)
