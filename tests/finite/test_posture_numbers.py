"""Ranks in floating point against the exact ones, and ranks without a margin."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from reasons.made import C, Made, P, R, S, joint, scrambled

import screwkit as sk
from screwkit.case import bundled_cases
from screwkit.errors import UnknownNameError
from screwkit.finite.posture_model import posture_model
from screwkit.finite.posture_numbers import CLEAR, PostureNumbers, numbers_at
from screwkit.kinematics.network import Motion, Network, motion
from screwkit.kinematics.subspaces import dimension
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.model import Mechanism

EVERY = [
    case
    for name in bundled_cases()
    for case in (name, *(f"{name}#{variant}" for variant in sk.load(name).variants))
]


def at_its_values(mechanism: Mechanism) -> Mechanism:
    return with_values(mechanism, declared_values(mechanism))


def in_floats(mechanism: Mechanism, locked: tuple[str, ...] = ()) -> PostureNumbers:
    """At the posture of the file; a table stands at random joint variables."""
    source = np.random.default_rng(5)
    names = mechanism.joint_variables if mechanism.geometry == "mdh" else ()
    values = {name: float(source.uniform(0.3, 1.4)) for name in names}
    return numbers_at(posture_model(mechanism, values), locked)


def exactly(mechanism: Mechanism, locked: tuple[str, ...] = ()) -> Motion:
    network = Network(mechanism)
    return motion(network, network.motion.posture, locked)


def agree(found: PostureNumbers, exact: Motion) -> None:
    assert found.clear
    assert found.loop_rank == exact.rank
    assert found.mobility == exact.mobility
    twists, prime = exact.platform_twists, exact.posture.prime
    turning = dimension([twist[:3] for twist in twists], prime)
    assert found.twist_dimension == len(twists)
    assert found.rotations == turning
    # A couple does no work where its moment is at right angles to all rotations.
    assert found.couples == 3 - turning
    assert found.motion_type == f"{len(twists) - turning}T{turning}R"


@pytest.mark.parametrize("case", EVERY)
def test_ranks_are_the_exact_ones(case: str) -> None:
    mechanism = at_its_values(sk.load(case).mechanism)
    agree(in_floats(mechanism), exactly(mechanism))
    if mechanism.actuated:
        locked = mechanism.actuated
        agree(in_floats(mechanism, locked), exactly(mechanism, locked))


# A four-bar linkage with the crank, coupler and rocker in one line is shaky: the loop
# rank falls from 3 to 2.
FLAT = Made(
    "base",
    "coupler",
    (
        joint("A", R, "base", "crank", (0, 0, 1), (0, 0, 0)),
        joint("B", R, "crank", "coupler", (0, 0, 1), (1, 0, 0)),
        joint("C", R, "coupler", "rocker", (0, 0, 1), (3, 0, 0)),
        joint("D", R, "rocker", "base", (0, 0, 1), (7, 0, 0)),
    ),
)
CHAIN = Made(
    "base",
    "tool",
    (
        joint("cyl", C, "base", "a", (1, 2, 2), (4, 0, 1)),
        joint("slide", P, "a", "b", (0, 1, 1)),
        joint("ball", S, "b", "tool", None, (2, 3, 5)),
    ),
)


def bent(by: Fraction) -> Made:
    """The flat linkage with one hinge off the line."""
    first, second, *rest = FLAT.joints
    off = joint("B", R, "crank", "coupler", (0, 0, 1), (1, float(by), 0))
    assert second.name == off.name
    return Made("base", "coupler", (first, off, *rest))


def test_a_chain_in_line_loses_a_rank() -> None:
    found = numbers_at(posture_model(FLAT.mechanism))
    assert (found.loop_rank, found.mobility, found.clear) == (2, 2, True)
    regular = numbers_at(posture_model(bent(Fraction(1, 2)).mechanism))
    assert (regular.loop_rank, regular.mobility, regular.clear) == (3, 1, True)


def test_a_singular_value_for_every_size_leaves_no_gap() -> None:
    """Linkages side by side, each ten times closer to its dead line than the last."""
    linkages = [bent(Fraction(1, 10**power)) for power in range(3, 13)]
    joints = [
        replace(
            each,
            name=f"{each.name}{number}",
            parent=each.parent if each.parent == "base" else f"{each.parent}{number}",
            child=each.child if each.child == "base" else f"{each.child}{number}",
        )
        for number, linkage in enumerate(linkages)
        for each in linkage.joints
    ]
    found = numbers_at(posture_model(Made("base", "coupler0", tuple(joints)).mechanism))
    assert not found.clear
    assert 1.0 <= found.gap < CLEAR
    assert 20 < found.loop_rank < 30


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("made", [FLAT, CHAIN], ids=["flat", "chain"])
def test_no_frame_and_no_unit_changes_the_ranks(made: Made, seed: int) -> None:
    plain = numbers_at(posture_model(made.mechanism))
    moved = numbers_at(posture_model(scrambled(made, seed).mechanism))
    assert moved.clear
    for name in ("loop_rank", "mobility", "twist_dimension", "rotations", "couples"):
        assert getattr(moved, name) == getattr(plain, name), name


def test_an_open_chain_has_no_loop_equations() -> None:
    """A cylinder, a slide and a ball: all rotations, translations in a plane."""
    model = posture_model(CHAIN.mechanism)
    free = numbers_at(model)
    assert (free.loop_rank, free.mobility) == (0, 6)
    assert (free.twist_dimension, free.rotations, free.couples) == (6, 3, 0)
    held = numbers_at(model, ("slide", "ball:0", "ball:1", "ball:2"))
    assert (held.mobility, held.motion_type, held.couples) == (2, "1T1R", 2)
    with pytest.raises(UnknownNameError, match="did you mean 'slide'"):
        numbers_at(model, ("slid",))


def test_a_base_that_is_the_platform_is_at_rest() -> None:
    still = Made("base", "base", FLAT.joints)
    found = numbers_at(posture_model(still.mechanism))
    assert (found.twist_dimension, found.motion_type, found.couples) == (0, "0T0R", 3)
