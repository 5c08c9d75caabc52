"""The loop matrix of nested parts has the ranks that are counted part by part."""

from __future__ import annotations

import random

import pytest

from screwkit.algebra.modular import rank
from screwkit.kinematics.limb_parts import Parts, SideBySide, columns_of, motion_of
from screwkit.kinematics.loop_columns import loop_columns
from screwkit.kinematics.loop_state import state_of

PRIME = 10007
HEIGHT = 3


def nested(source: random.Random, depth: int) -> list[SideBySide | list[int]]:
    """Random twists in series, some of them blocks of chains side by side."""
    found: list[SideBySide | list[int]] = []
    for _ in range(source.randint(1, 3)):
        if depth and source.random() < 0.5:
            chains = (nested(source, depth - 1) for _ in range(source.randint(2, 3)))
            found.append(SideBySide(tuple(tuple(chain) for chain in chains)))
        else:
            found.append([source.randrange(PRIME) for _ in range(HEIGHT)])
    return found


def rank_of(limbs: list[Parts]) -> int:
    columns = [[x % PRIME for x in c] for c in loop_columns(limbs, HEIGHT)]
    return rank(columns, PRIME)


@pytest.mark.parametrize("seed", range(12))
def test_the_rank_of_the_loop_columns_is_that_of_the_loops(seed: int) -> None:
    source = random.Random(seed)
    limbs: list[Parts] = [nested(source, 2) for _ in range(source.randint(2, 3))]
    motions = [motion_of(limb, HEIGHT, PRIME) for limb in limbs]
    assert rank_of(limbs) == state_of(motions, PRIME).loop
    freedoms = sum(1 for limb in limbs for _ in columns_of(limb))
    assert len(loop_columns(limbs, HEIGHT)) == freedoms


@pytest.mark.parametrize("seed", range(12))
def test_a_limb_beside_an_empty_one_is_held_at_its_end(seed: int) -> None:
    """The motions that are left are those that leave the platform still."""
    limb = nested(random.Random(seed), 2)
    motion = motion_of(limb, HEIGHT, PRIME)
    assert rank_of([limb, ()]) == motion.freedoms - motion.idle
