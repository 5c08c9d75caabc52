"""Rounding in a reduced lattice finds short numbers and nothing else."""

from __future__ import annotations

import random

import pytest

from screwkit.algebra.short_numbers import VanishingCombinations

MODULUS = (2**61 - 1) * (2**59 - 55)
CHANCE = 2**48


def lattice(count: int, seed: int) -> tuple[list[int], VanishingCombinations]:
    source = random.Random(seed)
    units = [1, *(source.randrange(MODULUS) for _ in range(count - 1))]
    return units, VanishingCombinations.of(units, MODULUS, CHANCE)


@pytest.mark.parametrize("count", range(1, 7))
def test_a_basis_vanishes(count: int) -> None:
    units, vanishing = lattice(count, count)
    for row in vanishing.rows:
        assert sum(c * u for c, u in zip(row, units, strict=True)) % MODULUS == 0
    assert abs(vanishing.size) == MODULUS


@pytest.mark.parametrize("count", range(1, 7))
def test_short_numerators_come_back(count: int) -> None:
    units, vanishing = lattice(count, 10 + count)
    source = random.Random(count)
    for below in (1, 7, 1000):
        above = [source.randint(-40, 40) for _ in range(count)]
        total = sum(c * u for c, u in zip(above, units, strict=True))
        residue = total * pow(below, -1, MODULUS) % MODULUS
        assert vanishing.over(below, residue) == above


@pytest.mark.parametrize("count", range(1, 7))
def test_a_random_residue_is_no_number(count: int) -> None:
    _, vanishing = lattice(count, 20 + count)
    source = random.Random(30 + count)
    assert all(
        vanishing.over(below, source.randrange(MODULUS)) is None
        for below in range(1, 40)
    )
