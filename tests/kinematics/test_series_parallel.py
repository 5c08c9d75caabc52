"""Chains and blocks against the loop equations of the same graph."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from kinematics.random_mechanisms import mechanism_of, random_joint, written

from screwkit.algebra.modular import echelon
from screwkit.kinematics.frames import framed_twists
from screwkit.kinematics.network import Network
from screwkit.kinematics.series_parallel import (
    Block,
    Chain,
    chain_between,
    element_columns,
    joints_of,
)
from screwkit.kinematics.subspaces import dimension, reciprocal
from screwkit.mechanism.model import Joint, JointType, Mechanism
from screwkit.screw.nullspace import Column, independent

laws = settings(max_examples=60, derandomize=True)
KINDS = (
    JointType.REVOLUTE,
    JointType.REVOLUTE,
    JointType.PRISMATIC,
    JointType.HELICAL,
    JointType.UNIVERSAL,
    JointType.CYLINDRICAL,
    JointType.FIXED,
)


def edge(name: str, one: str, other: str) -> Joint:
    return Joint(name, JointType.REVOLUTE, one, other, (f"q{name}",))


def edges(*names: str) -> list[Joint]:
    """``xAB``: joint x between bodies A and B."""
    return [edge(name[:-2], name[-2], name[-1]) for name in names]


@st.composite
def nested(draw: st.DrawFn) -> Mechanism:
    """Edges of one edge are put in series or side by side, again and again."""
    source = random.Random(draw(st.integers(0, 2**20)))
    pairs, bodies = [("s", "t")], ["s", "t"]
    for _ in range(draw(st.integers(0, 7))):
        one, other = pairs.pop(source.randrange(len(pairs)))
        if source.random() < 0.65:
            middle = f"m{len(bodies)}"
            bodies.append(middle)
            pairs += [(one, middle), (middle, other)]
        else:
            pairs += [(one, other), (one, other)]
    joints = []
    for number, pair in enumerate(pairs):
        ends = pair if source.random() < 0.5 else pair[::-1]
        joints.append(random_joint(source, source.choice(KINDS), ends, f"j{number}"))
    source.shuffle(joints)
    return mechanism_of(joints, bodies, base="s", platform="t")


def along(chain: Chain, joints: dict[str, Joint], start: str) -> tuple[str, set[str]]:
    """Where a chain leads to from a body, and the bodies that it passes."""
    here, passed = start, {start}
    for element in chain:
        if isinstance(element, str):
            joint = joints[element]
            assert here in (joint.parent, joint.child)
            here = joint.child if joint.parent == here else joint.parent
        else:
            assert len(element.branches) > 1
            found = [along(branch, joints, here) for branch in element.branches]
            assert len({end for end, _ in found}) == 1
            here = found[0][0]
            passed |= {body for _, bodies in found for body in bodies}
        passed.add(here)
    return here, passed


@laws
@given(nested())
def test_the_chain_is_a_walk_from_one_body_to_the_other(mechanism: Mechanism) -> None:
    """Every joint once; branches of a block begin and end at the same bodies."""
    chain = chain_between(mechanism.joints, "s", "t")
    assert chain is not None
    names = [joint.name for joint in mechanism.joints]
    assert sorted(joints_of(chain)) == sorted(names)
    by_name = {joint.name: joint for joint in mechanism.joints}
    assert along(chain, by_name, "s") == ("t", set(mechanism.links))


@laws
@given(nested())
def test_the_way_back_is_the_way_reversed(mechanism: Mechanism) -> None:
    there = chain_between(mechanism.joints, "s", "t")
    back = chain_between(mechanism.joints, "t", "s")
    assert there is not None
    assert back is not None
    by_name = {joint.name: joint for joint in mechanism.joints}
    assert along(back, by_name, "t") == ("s", set(mechanism.links))
    assert sorted(joints_of(there)) == sorted(joints_of(back))


def system(
    chain: Chain, twists: dict[str, list[list[int]]], prime: int
) -> list[list[int]]:
    """Sums along the chain, intersections over branches, by reciprocals of residues."""
    rows: list[list[int]] = []
    for element in chain:
        if isinstance(element, str):
            rows += twists[element]
        else:
            wrenches = [
                wrench
                for branch in element.branches
                for wrench in reciprocal(system(branch, twists, prime), prime)
            ]
            rows += reciprocal(wrenches, prime)
    return rows


@laws
@given(nested())
def test_sums_and_intersections_are_what_loops_allow(mechanism: Mechanism) -> None:
    """The system of the chain is that of `Motion.twists_of`, space by space."""
    at = Network(mechanism).motion
    prime = at.posture.prime
    chain = chain_between(mechanism.joints, "s", "t")
    assert chain is not None
    twists = {
        joint: [list(at.posture.twists[label]) for label in labels]
        for joint, labels in at.network.labels_of.items()
    }
    spanned = system(chain, twists, prime)
    assert echelon(spanned, prime) == echelon(at.twists_of("t", "s"), prime)


def symbolic_dimension(mechanism: Mechanism) -> int:
    network = Network(mechanism)
    chain = chain_between(mechanism.joints, mechanism.base, mechanism.platform)
    assert chain is not None
    framed = framed_twists(mechanism, joints_of(chain), mechanism.base, merged=False)
    columns: dict[str, list[Column]] = {joint.name: [] for joint in mechanism.joints}
    for label, column in zip(framed.joints, framed.columns, strict=True):
        columns[network.joint_of[label]].append(column)
    spanning = [c for e in chain for c in element_columns(framed.ring, e, columns)]
    return len(independent(framed.ring, spanning))


@settings(laws, max_examples=40)
@given(nested())
def test_symbolic_columns_have_the_exact_dimension(mechanism: Mechanism) -> None:
    assume(any(joint.type is not JointType.FIXED for joint in mechanism.joints))
    at = Network(mechanism).motion
    assert symbolic_dimension(mechanism) == len(at.platform_twists)


def test_bodies_in_a_row_are_a_chain() -> None:
    assert chain_between(edges("aST", "bTU", "cVU"), "S", "V") == ("a", "b", "c")
    assert chain_between(edges("aST", "bTU", "cVU"), "V", "S") == ("c", "b", "a")


def test_a_parallelogram_in_a_limb_is_a_block() -> None:
    chain = chain_between(edges("aSA", "bAB", "cBC", "dAD", "eDC", "fCT"), "S", "T")
    assert chain is not None
    first, block, last = chain
    assert (first, last) == ("a", "f")
    assert isinstance(block, Block)
    assert {frozenset(branch) for branch in block.branches} == {
        frozenset("bc"),
        frozenset("de"),
    }


def test_what_hangs_on_a_chain_is_left_out() -> None:
    """Dead ends, and loops that touch the chain at one body."""
    found = chain_between(edges("aSA", "bAT", "xAX", "yXY", "zXY"), "S", "T")
    assert found == ("a", "b")
    found = chain_between(edges("aSA", "bAT", "xTX", "yXZ", "zZT"), "S", "T")
    assert found == ("a", "b")


BRIDGE = ("aSA", "bSB", "cAB", "dAT", "eBT")
K33 = tuple(f"{n}{x}{y}" for n, (x, y) in enumerate(
    (x, y) for x in "SBC" for y in "TEF"))  # fmt: skip


@pytest.mark.parametrize("names", [BRIDGE, K33, (*BRIDGE, "fTU")])
def test_what_does_not_nest_is_refused(names: Sequence[str]) -> None:
    """The bridge of Wheatstone, K33, and a bridge in series with a joint."""
    assert chain_between(edges(*names), "S", "U" if "fTU" in names else "T") is None


def test_between_the_ends_of_its_cross_joint_a_bridge_nests() -> None:
    """Two chains beside the joint c."""
    chain = chain_between(edges(*BRIDGE), "A", "B")
    assert chain is not None
    assert sorted(joints_of(chain)) == list("abcde")
    by_name = {joint.name: joint for joint in edges(*BRIDGE)}
    assert along(chain, by_name, "A") == ("B", set("ABST"))


def test_nothing_between_two_bodies_is_no_chain() -> None:
    assert chain_between(edges("aSA", "bTB"), "S", "T") is None
    assert chain_between([], "S", "T") is None


def test_planar_parallelograms_share_what_both_chains_allow() -> None:
    """Four parallel hinges at the corners of one: the coupler only translates."""
    source = random.Random(1)
    corners = {"a": (0, 0), "b": (1, 3), "c": (4, 0), "d": (5, 3)}
    ends = {"a": ("s", "p"), "b": ("p", "t"), "c": ("s", "q"), "d": ("q", "t")}
    joints = []
    for name, (x, y) in corners.items():
        hinge = random_joint(source, JointType.REVOLUTE, ends[name], name, "planar")
        joints.append(replace(hinge, point=written((x, y, 0))))
    mechanism = mechanism_of(joints, ["s", "p", "q", "t"])
    at = Network(mechanism).motion
    (twist,) = at.platform_twists
    prime = at.posture.prime
    assert symbolic_dimension(mechanism) == 1
    # The coupler slides across the cranks, which lie along (1, 3).
    assert dimension([twist, [0, 0, 0, 3, -1, 0]], prime) == 1
