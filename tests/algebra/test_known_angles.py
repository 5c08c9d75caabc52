"""Multiples of π are told by numbers, and nothing else is."""

from __future__ import annotations

from fractions import Fraction

import pytest
from one_ring import in_one_ring

from screwkit.algebra.known_angles import (
    turns_of_cosine,
    turns_of_direction,
    turns_of_tangent,
)


@pytest.mark.parametrize("parts", [1, 2, 3, 5, 7, 8, 12])
def test_multiples_of_a_part_of_a_half_turn_are_told(parts: int) -> None:
    for k in range(1 - parts, parts + 1):
        turns = Fraction(k, parts)
        ring, (cosine, sine) = in_one_ring(
            f"cos({k}*pi/{parts})", f"sin({k}*pi/{parts})"
        )
        assert turns_of_direction(ring, cosine, sine) == turns
        assert turns_of_cosine(ring, cosine) == abs(turns)


@pytest.mark.parametrize(
    ("tangent", "turns"),
    [
        ("2 - sqrt(3)", Fraction(1, 12)),
        ("sqrt(2) - 1", Fraction(1, 8)),
        ("-sqrt(3)/3", Fraction(-1, 6)),
        ("-2 - sqrt(3)", Fraction(-5, 12)),
        ("sqrt(2)", None),  # cos 2φ = −1/3, and 2·cos 2φ is no algebraic integer
    ],
)
def test_tangents_are_told(tangent: str, turns: Fraction | None) -> None:
    ring, (number,) = in_one_ring(tangent)
    assert turns_of_tangent(ring, number) == turns


@pytest.mark.parametrize("cosine", ["1/3", "sqrt(2)", "sqrt(2) - 1", "sqrt(3)/3"])
def test_other_cosines_are_not(cosine: str) -> None:
    """Twice a cosine of a known angle is an algebraic integer.

    It lies in [−2, 2] with its conjugates; −2·√2 − 2 does not.
    """
    ring, (number,) = in_one_ring(cosine)
    assert turns_of_cosine(ring, number) is None
