"""What opens by the rounding of its decimals alone is told from what is shaky."""

from __future__ import annotations

from fractions import Fraction

import pytest
from finite.linkages import ball, doubled_contacts, hinge, network, ring

from screwkit.analyses.mobility import mobility
from screwkit.finite.near_motion import near_motion
from screwkit.kinematics.network import Network


def schatz(half: str, root: str) -> Network:
    """Schatz's linkage, which moves where the numbers are √3/2 and √3."""
    return ring(
        [
            ((0, 0, 0), (0, 0, 1)),
            ((0, 0, 0), (0, -1, 0)),
            ((f"-{half}", 0, "1/2"), ("1/2", 0, half)),
            ((f"-{root}", 0, 1), (0, 1, 0)),
            ((f"-{root}", 0, 0), (1, 0, 0)),
            ((f"-{root}", 0, 0), (0, 0, 1)),
        ]
    )


def rounded(square: Fraction, digits: int) -> str:
    """The square root of a number, cut behind so many digits."""
    unit = 10**digits
    least, most = 0, 2 * unit
    while most - least > 1:
        middle = (least + most) // 2
        fits = Fraction(middle, unit) ** 2 <= square
        least, most = (middle, most) if fits else (least, middle)
    return f"{least}/{unit}"


@pytest.mark.parametrize("digits", [7, 10, 20])
def test_a_rounded_schatz_linkage_moves_but_for_the_rounding(digits: int) -> None:
    of = schatz(rounded(Fraction(3, 4), digits), rounded(Fraction(3), digits))
    found = mobility(of).full_cycle
    assert (found.status, found.mobility) == ("proved", (0,))
    assert "opens a loop at order 2" in found.reason
    assert "up to the rounding of decimals it moves" in found.reason


def test_the_exact_one_needs_no_such_word() -> None:
    found = mobility(schatz("sqrt(3)/2", "sqrt(3)")).full_cycle
    assert found.mobility == (1,)
    assert "rounding" not in found.reason


def test_a_linkage_far_from_schatzs_is_rigid_and_no_more() -> None:
    found = mobility(schatz("sqrt(3)/2 + 1/100", "sqrt(3)")).full_cycle
    assert found.mobility == (0,)
    assert "rounding" not in found.reason


@pytest.mark.parametrize("stages", [1, 2, 3, 5])
def test_shaky_structures_of_any_order_do_not_move(stages: int) -> None:
    shaky = doubled_contacts(stages)
    found = mobility(shaky).full_cycle
    assert found.mobility == (0,)
    assert f"at order {2**stages}" in found.reason
    assert near_motion(shaky.motion) == ""


def test_spinning_rods_are_no_motion_of_the_rest() -> None:
    """Two stretched bars in a line, and a rod that spins about that line."""
    flat = network(
        hinge("J0", "wall", "bar", (0, 0, 0)),
        hinge("J1", "bar", "other", (1, 0, 0)),
        hinge("J2", "other", "wall", (3, 0, 0)),
        ball("S", "bar", "rod", (2, 0, 0)),
        ball("T", "rod", "wall", (5, 0, 0)),
        platform="bar",
    )
    assert near_motion(flat.motion) == ""
