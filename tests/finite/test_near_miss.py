"""Rounded numbers: what is written is rigid, what is meant is said beside it."""

from __future__ import annotations

import pytest
from finite.linkages import ring

from screwkit.analyses.mobility import mobility
from screwkit.finite.near_miss import near_miss
from screwkit.kinematics.network import Network

PLACES = [
    # Bennett's linkage on a skew quadrilateral that a half-turn takes to itself.
    ((3, 0, 1), (8, -4, -12)),
    ((1, 2, -1), (0, -12, -12)),
    ((-3, 0, 1), (-8, 4, -12)),
    ((-1, -2, -1), (0, 12, -12)),
]


def bennett(error: str) -> Network:
    """With one coordinate of a hinge off by an error."""
    ((x, y, z), axis), *others = PLACES
    return ring([((f"{x} + {error}", y, z), axis), *others])


@pytest.mark.parametrize("digits", [8, 10, 14, 20])
def test_a_rounded_linkage_is_rigid_and_it_is_said_what_was_meant(digits: int) -> None:
    rounded = bennett(f"1/{10**digits}")
    found = mobility(rounded).full_cycle
    assert (found.status, found.mobility) == ("proved", (0,))
    assert "up to the rounding of decimals the loop rank is 3" in found.reason
    assert "the mobility 1" in found.reason


@pytest.mark.parametrize("error", ["0", "1/100"])
def test_clear_ranks_are_left_alone(error: str) -> None:
    clear = bennett(error)
    assert near_miss(clear.mechanism, clear.motion.rank) == ""
