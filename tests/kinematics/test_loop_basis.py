"""The basis of short loops against the loops of a spanning tree."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kinematics.random_mechanisms import mechanism_of, rank

from screwkit.kinematics.loop_basis import short_loops
from screwkit.mechanism.graph import (
    Step,
    components,
    fundamental_loops,
    independent_loops,
)
from screwkit.mechanism.model import Joint, JointType, Mechanism

laws = settings(max_examples=120, derandomize=True)


def graph(ends: Sequence[tuple[int, int]], bodies: int = 0, base: int = 0) -> Mechanism:
    """Revolute joints between numbered bodies."""
    count = max([bodies - 1, *(i for pair in ends for i in pair)]) + 1
    links = [f"b{i}" for i in range(count)]
    joints = [
        Joint(f"j{n}", JointType.REVOLUTE, f"b{i}", f"b{k}", (f"q{n}",))
        for n, (i, k) in enumerate(ends)
    ]
    return mechanism_of(joints, links, base=links[base])


@st.composite
def multigraphs(draw: st.DrawFn) -> Mechanism:
    """Connected or not, with several joints between the same bodies."""
    bodies = draw(st.integers(1, 9))
    if bodies == 1:
        return graph([], 1)
    body = st.integers(0, bodies - 1)
    pairs = st.tuples(body, body).filter(lambda pair: pair[0] != pair[1])
    return graph(draw(st.lists(pairs, max_size=16)), bodies, draw(body))


def vector(mechanism: Mechanism, loop: Sequence[Step]) -> list[int]:
    """How often each joint is passed, with its sign."""
    passed = {joint.name: 0 for joint in mechanism.joints}
    for name, sign in loop:
        passed[name] += sign
    return list(passed.values())


def check_walk(mechanism: Mechanism, loop: Sequence[Step]) -> None:
    """Every step leaves the body where the step before arrived."""
    steps = [(mechanism.joint(name), sign) for name, sign in loop]
    ends = [(j.parent, j.child)[:: 1 if sign > 0 else -1] for j, sign in steps]
    for (_, arrived), (left, _) in zip(ends, [*ends[1:], ends[0]], strict=True):
        assert arrived == left
    assert all(sign in (1, -1) for _, sign in loop)


@laws
@given(multigraphs())
def test_independent_closed_walks_and_enough_of_them(mechanism: Mechanism) -> None:
    """Joints − links + components, with the span of the tree's loops."""
    loops = short_loops(mechanism)
    wanted = len(mechanism.joints) - len(mechanism.links) + len(components(mechanism))
    assert len(loops) == wanted == independent_loops(mechanism)
    for loop in loops:
        check_walk(mechanism, loop)
        names = [name for name, _ in loop]
        assert len(set(names)) == len(names)
        joint, sign = mechanism.joint(loop[0][0]), loop[0][1]
        assert sign == 1
        assert joint in mechanism.joints
    short = [vector(mechanism, loop) for loop in loops]
    known = [vector(mechanism, loop) for loop in fundamental_loops(mechanism)]
    assert rank(short) == len(loops)
    assert rank([*short, *known]) == len(loops)


@laws
@given(multigraphs())
def test_each_loop_has_a_joint_of_its_own(mechanism: Mechanism) -> None:
    """The one that closes it: no earlier loop passes it."""
    seen: set[str] = set()
    for loop in short_loops(mechanism):
        assert loop[0][0] not in seen
        seen |= {name for name, _ in loop}


@laws
@given(multigraphs())
def test_no_loop_passes_a_body_twice(mechanism: Mechanism) -> None:
    for loop in short_loops(mechanism):
        left = [
            mechanism.joint(name).parent if sign > 0 else mechanism.joint(name).child
            for name, sign in loop
        ]
        assert len(set(left)) == len(left)


def scissor(cells: int) -> Mechanism:
    """Two bars a cell: bodies 2i and 2i + 1."""
    ends = []
    for i in range(cells):
        a, b = 2 * i, 2 * i + 1
        ends.append((a, b))
        if i + 1 < cells:
            ends += [(a, b + 2), (b, a + 2)]
    return graph(ends)


@pytest.mark.parametrize("cells", [2, 5, 40, 160])
def test_loops_of_a_scissor_chain_stay_in_their_cells(cells: int) -> None:
    """Four bars each, where the tree's loops grow with the chain."""
    loops = short_loops(scissor(cells))
    assert len(loops) == cells - 1
    assert all(len(loop) == 4 for loop in loops)


@pytest.mark.parametrize("base", [0, 79, 40])
def test_wherever_the_chain_is_held(base: int) -> None:
    mechanism = scissor(40)
    turned = mechanism_of(
        mechanism.joints[::-1], mechanism.links, base=f"b{base}", platform="b1"
    )
    assert sum(map(len, short_loops(turned))) <= 6 * 39


def test_joints_side_by_side_close_loops_of_two() -> None:
    loops = short_loops(graph([(0, 1), (1, 0), (0, 1)]))
    assert [len(loop) for loop in loops] == [2, 2]


@pytest.mark.parametrize("ends", [[], [(0, 1)], [(0, 1), (2, 3)], [(1, 0), (1, 2)]])
def test_trees_have_none(ends: list[tuple[int, int]]) -> None:
    assert short_loops(graph(ends, 4)) == ()


def test_a_complete_graph_has_triangles_only() -> None:
    ends = [(i, k) for i in range(8) for k in range(i)]
    loops = short_loops(graph(ends))
    assert len(loops) == 28 - 8 + 1
    assert {len(loop) for loop in loops} == {3}
