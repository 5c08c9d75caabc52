"""States of self-stress: balanced, reciprocal, complete, and where people see them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from reasons.made import (
    ALL,
    Made,
    door,
    four_bar,
    sarrus,
    scissor,
    scrambled,
    spherical_four_bar,
    three_bars,
    three_sliders,
)

from screwkit.algebra.modular import rank
from screwkit.kinematics.network import Motion, Network
from screwkit.mechanism.files import read_mechanism
from screwkit.reasons.added_freedoms import removing_freedoms
from screwkit.reasons.carriers import carriers, limb_wrenches
from screwkit.reasons.joint_points import joint_points
from screwkit.reasons.readable_screws import kind_of, product, readable_basis
from screwkit.reasons.self_stress import (
    SelfStress,
    redundant_count,
    self_stresses,
)
from screwkit.reasons.short_loops import short_loops

CASES = sorted((Path(__file__).parents[2] / "cases").glob("*.yaml"))
MADE = [pytest.param(make(), id=name) for name, make in ALL.items()]


def found(motion: Motion) -> tuple[SelfStress, ...]:
    return self_stresses(motion, joint_points(motion.network, motion.posture))


def check(motion: Motion) -> None:
    """As many as equations that follow from others; independent, balanced, carried."""
    network, prime = motion.network, motion.posture.prime
    stresses = found(motion)
    assert len(stresses) == redundant_count(motion)
    names = [joint.name for joint in network.mechanism.joints]
    still = (0,) * 6
    rows = [
        [x for name in names for x in stress.wrenches.get(name, still)]
        for stress in stresses
    ]
    assert rank(rows, prime) == len(stresses)
    for stress in stresses:
        for name, wrench in stress.wrenches.items():
            assert any(wrench)
            for label in network.labels_of[name]:
                assert product(wrench, motion.posture.twists[label], prime) == 0
        for body in network.mechanism.links:
            total = [0] * 6
            for joint in network.mechanism.joints:
                wrench = stress.wrenches.get(joint.name, still)
                sign = (joint.child == body) - (joint.parent == body)
                total = [a + sign * b for a, b in zip(total, wrench, strict=True)]
            assert not any(x % prime for x in total)
        if stress.loop:
            assert sorted(joint for joint, _ in stress.loop) == sorted(stress.wrenches)


@pytest.mark.parametrize("made", MADE)
def test_made(made: Made) -> None:
    check(Network(made.mechanism).motion)


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_cases(path: Path) -> None:
    network = Network(read_mechanism(path))
    check(network.motion)
    if network.at_values is not None:
        check(network.at_values.motion)


def supports(made: Made) -> list[tuple[list[str], bool]]:
    """Which joints carry something together, and whether it is a couple everywhere."""
    motion = Network(made.mechanism).motion
    prime = motion.posture.prime
    return sorted(
        (
            sorted(stress.wrenches),
            all(kind_of(w, prime) == "free" for w in stress.wrenches.values()),
        )
        for stress in found(motion)
    )


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("made", MADE)
def test_supports_belong_to_the_mechanism(made: Made, seed: int) -> None:
    assert supports(scrambled(made, seed)) == supports(made)


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_files_may_list_joints_in_any_order(path: Path) -> None:
    network = Network(read_mechanism(path))
    network = network.at_values or network
    turned = replace(
        network.mechanism, joints=tuple(reversed(network.mechanism.joints))
    )
    before, after = (
        sorted(sorted(stress.wrenches) for stress in found(Network(m).motion))
        for m in (network.mechanism, turned)
    )
    assert before == after


def kinds(made: Made) -> list[str]:
    motion = Network(made.mechanism).motion
    prime = motion.posture.prime
    return [
        kind
        for stress in found(motion)
        for kind in {kind_of(w, prime) for w in stress.wrenches.values()}
    ]


def test_textbook_loops() -> None:
    """What each loop cannot move in, by hand; every turned copy says the same."""
    for made, expected in (
        (four_bar(), ["free", "free", "line"]),
        (door(), ["free", "free", "line", "line", "line"]),
        (spherical_four_bar(), ["line", "line", "line"]),
        (sarrus(), ["free"]),
    ):
        assert kinds(made) == expected
        assert kinds(scrambled(made, 5)) == expected


def test_small_supports_come_first() -> None:
    """Each cell of a chain is a loop of its own: no wrench goes further."""
    stresses = found(Network(scissor(5).mechanism).motion)
    assert [len(stress.wrenches) for stress in stresses] == [4] * 15
    pairs = found(Network(three_sliders().mechanism).motion)
    assert [len(stress.wrenches) for stress in pairs] == [6] * 3


def test_three_bars_hold_one_force_too_many() -> None:
    """In the plane the three parallel bars carry dependent forces along themselves."""
    mechanism = replace(three_bars().mechanism, space="planar")
    network = Network(mechanism)
    (stress,) = found(network.motion)
    prime = network.motion.posture.prime
    own = carriers(network, stress, prime)
    assert [carrier.joints for carrier in own] == [
        ("A1", "B1"),
        ("A2", "B2"),
        ("A3", "B3"),
    ]
    for carrier in own:
        along = carrier.wrench[0], carrier.wrench[1]
        assert (2 * along[0] - along[1]) % prime == 0
        assert carrier.wrench[2:5] == (0, 0, 0)


@pytest.mark.parametrize("made", MADE)
def test_carriers_and_limbs_balance(made: Made) -> None:
    network = Network(made.mechanism)
    prime = network.motion.posture.prime
    for stress in found(network.motion):
        own = carriers(network, stress, prime)
        joints = [joint for carrier in own for joint in carrier.joints]
        assert sorted(joints) == sorted(stress.wrenches)
        exerted = limb_wrenches(network, stress, prime)
        total = [sum(column) % prime for column in zip(*exerted.values(), strict=True)]
        assert not any(total)


def with_columns(motion: Motion, added: list[tuple[str, tuple[int, ...]]]) -> int:
    """Rank of the loop equations with these twists added to these joints."""
    network, posture = motion.network, motion.posture
    columns = [
        (joint, posture.twists[label])
        for joint, labels in network.labels_of.items()
        for label in labels
    ]
    rows = [
        [
            dict(loop).get(joint, 0) * twist[coordinate] % posture.prime
            for joint, twist in [*columns, *added]
        ]
        for loop in network.loops
        for coordinate in network.rows
    ]
    return rank(rows, posture.prime)


def check_removals(motion: Motion) -> None:
    points = joint_points(motion.network, motion.posture)
    stresses = self_stresses(motion, points)
    lists = removing_freedoms(motion, stresses, points)
    assert len(lists) == len(stresses)
    for stress, listed in zip(stresses, lists, strict=True):
        assert 1 <= len(listed) <= 3
        for candidate in listed:
            # One equation more, one freedom more: the mobility stays as it is.
            added = [(candidate.joint, candidate.twist)]
            assert with_columns(motion, added) == motion.rank + 1
            wrench = stress.wrenches[candidate.joint]
            assert product(wrench, candidate.twist, motion.posture.prime)
    firsts = [(listed[0].joint, listed[0].twist) for listed in lists]
    assert with_columns(motion, firsts) == motion.rank + len(stresses)


@pytest.mark.parametrize("made", MADE)
def test_added_freedoms_remove_what_they_say(made: Made) -> None:
    check_removals(Network(made.mechanism).motion)
    check_removals(Network(scrambled(made, 3).mechanism).motion)


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_added_freedoms_of_cases(path: Path) -> None:
    check_removals(Network(read_mechanism(path)).motion)


def test_shortest_loops_first() -> None:
    loops = list(short_loops(scissor(6).mechanism.joints))
    lengths = [len(loop) for loop in loops]
    assert lengths == sorted(lengths)
    assert lengths.count(4) == 6
    for loop in loops:
        assert len({joint for joint, _ in loop}) == len(loop)


def test_a_basis_spans_its_system() -> None:
    """Translation, rotation and screw come out of combinations of them."""
    prime = 1_000_003
    slide, turn, screw = (0, 0, 0, 0, 0, 1), (1, 0, 0, 0, 5, 0), (0, 1, 0, 2, 3, 0)
    mixed = [
        tuple(
            (a + 7 * b + c) % prime for a, b, c in zip(slide, turn, screw, strict=True)
        ),
        tuple(
            (2 * a + b + 3 * c) % prime
            for a, b, c in zip(slide, turn, screw, strict=True)
        ),
        tuple(
            (a - b + 4 * c) % prime for a, b, c in zip(slide, turn, screw, strict=True)
        ),
    ]
    basis = readable_basis(mixed, prime)
    assert rank([*mixed, *basis], prime) == 3
    assert [kind_of(row, prime) for row in basis] == ["free", "line", "screw"]
