"""The joint graph: loops that close, limbs as the format defines them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from screwkit.mechanism.graph import (
    actuable_freedoms,
    components,
    fundamental_loops,
    independent_loops,
    joint_graph,
    limbs,
    other_parts,
    spanning_tree,
)
from screwkit.mechanism.joints import CATALOGUE, freedoms_of_type, variable_count
from screwkit.mechanism.model import Joint, JointType, Mechanism


def mechanism(
    edges: str, platform: str = "p", names: dict[str, tuple[str, ...]] | None = None
) -> Mechanism:
    """From ``"A:b-x B:x-p"``: joint A from link b to x, and so on; b is the base."""
    joints = []
    links = dict.fromkeys(["b", platform])
    for part in edges.split():
        name, _, ends = part.partition(":")
        parent, _, child = ends.partition("-")
        links |= dict.fromkeys([parent, child])
        joints.append(
            Joint(name, JointType.REVOLUTE, parent, child, variables=(f"q{name}",))
        )
    return Mechanism(
        name="m",
        title="",
        base="b",
        platform=platform,
        links=tuple(links),
        joints=tuple(joints),
        geometry="posture",
        limb_names=names or {},
    )


def test_two_arms() -> None:
    both = mechanism("A:b-x B:x-p C:b-y D:p-y")
    first, second = limbs(both)
    assert (first.name, second.name) == ("limb_1", "limb_2")
    assert first.path == (("A", 1), ("B", 1))
    assert second.path == (("C", 1), ("D", -1))
    assert fundamental_loops(both) in [
        ((("C", 1), ("D", -1), ("B", -1), ("A", -1)),),
        ((("A", 1), ("B", 1), ("D", 1), ("C", -1)),),
    ]


def test_order_is_that_of_the_first_joints_and_names_are_those_of_the_file() -> None:
    both = mechanism("C:b-y A:b-x B:x-p D:y-p", names={"right": ("A", "B")})
    assert [limb.name for limb in limbs(both)] == ["limb_1", "right"]


def test_joints_between_base_and_platform_are_limbs_each() -> None:
    both = mechanism("A:b-p B:p-b")
    assert [limb.path for limb in limbs(both)] == [(("A", 1),), (("B", -1),)]
    assert independent_loops(both) == 1
    assert len(fundamental_loops(both)[0]) == 2


def test_a_loop_inside_a_limb_leaves_no_path() -> None:
    (limb,) = limbs(mechanism("A:b-x B:x-y C:x-y D:y-p"))
    assert limb.path is None
    assert limb.joints == ("A", "B", "C", "D")
    assert limb.links == ("x", "y")


def test_coupled_limbs_are_one() -> None:
    (limb,) = limbs(mechanism("A:b-x B:x-p C:b-y D:y-p E:x-y"))
    assert limb.path is None


def test_dangling_parts_are_no_limbs() -> None:
    m = mechanism("A:b-x B:x-p C:b-t D:p-u E:v-w")
    assert [limb.joints for limb in limbs(m)] == [("A", "B")]
    assert [(part.joints, part.touches) for part in other_parts(m)] == [
        (("C",), ("b",)),
        (("D",), ("p",)),
        (("E",), ()),
    ]
    assert components(m) == (("b", "p", "x", "t", "u"), ("v", "w"))
    assert independent_loops(m) == 0
    assert fundamental_loops(m) == ()


def test_a_tree_on_a_limb_leaves_no_path() -> None:
    (limb,) = limbs(mechanism("A:b-x B:x-p C:x-t"))
    assert limb.joints == ("A", "B", "C")
    assert limb.path is None


@pytest.mark.parametrize("joint_type", list(JointType))
def test_catalogue_is_complete(joint_type: JointType) -> None:
    kind = CATALOGUE[joint_type]
    assert 0 <= kind.spatial_freedoms < 6
    assert kind.planar_freedoms is None or kind.planar_freedoms <= 3
    count = variable_count(joint_type)
    assert count == (0 if kind.contact else kind.spatial_freedoms)


def test_types_that_the_plane_does_not_have() -> None:
    with pytest.raises(ValueError, match="spherical joint does not exist in a planar"):
        freedoms_of_type(JointType.SPHERICAL, "planar")
    assert freedoms_of_type(JointType.POINT, "planar") == 2


links = st.sampled_from(["b", "p", "s", "t", "u", "v"])
graphs = st.lists(st.tuples(links, links).filter(lambda e: e[0] != e[1]), max_size=12)


@given(graphs)
def test_laws_of_any_graph(edges: list[tuple[str, str]]) -> None:
    text = " ".join(f"J{i}:{a}-{b}" for i, (a, b) in enumerate(edges))
    m = mechanism(text)
    loops = fundamental_loops(m)
    tree = set(spanning_tree(m))
    assert len(loops) == independent_loops(m)
    assert len(tree) == len(m.links) - len(components(m))
    assert joint_graph(m).number_of_edges() == len(m.joints)
    for loop in loops:
        ends = []
        for name, sign in loop:
            joint = m.joint(name)
            step = (joint.parent, joint.child)
            ends.append(step if sign == 1 else step[::-1])
        for (_, here), (there, _) in zip(ends, [*ends[1:], ends[0]], strict=True):
            assert here == there
        assert len({name for name, _ in loop}) == len(loop)
        assert sum(name not in tree for name, _ in loop) == 1
    owned = [name for limb in limbs(m) for name in limb.joints]
    owned += [name for part in other_parts(m) for name in part.joints]
    assert sorted(owned) == sorted(joint.name for joint in m.joints)
    assert len(actuable_freedoms(m)) == len(m.joints)
