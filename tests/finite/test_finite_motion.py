"""Finite motion of linkages whose branches are known from theory."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from finite.sample_linkages import (
    Z,
    ball,
    model,
    moved,
    octahedron,
    origami_vertex,
    pins,
    ring,
    turn,
    two_kites,
)

from screwkit.errors import UnknownNameError
from screwkit.finite.finite_motion import FiniteMotion, finite_motion
from screwkit.finite.motion_invariants import motion_in_words
from screwkit.finite.posture_model import PosedJoint, PostureModel

BENNETT = (
    ((8, -4, -12), (3, 0, 1)),
    ((0, -12, -12), (1, 2, -1)),
    ((-8, 4, -12), (-3, 0, 1)),
    ((0, 12, -12), (-1, -2, -1)),
)
TRIANGLE = ((0, -1, 0), (1, -1, 0), (3, -1, 0))


def looks(found: FiniteMotion) -> set[tuple[int, str, str]]:
    return {(b.mobility, b.motion_type, b.motion) for b in found.branches}


def perturbed(linkage: PostureModel, number: int) -> PostureModel:
    """One axis shifted and tilted a little."""
    joint = linkage.joints[number]
    screw = joint.screws[0] + 0.01 * np.array([0.3, -0.5, 0.7, 1.1, -0.4, 0.9])
    along = screw[:3] / np.linalg.norm(screw[:3])
    moment = screw[3:] - along * (screw[3:] @ along)
    changed = replace(joint, screws=np.concatenate([along, moment])[None])
    joints = (*linkage.joints[:number], changed, *linkage.joints[number + 1 :])
    return replace(linkage, joints=joints)


def shaky_and_moving() -> PostureModel:
    """A four-bar linkage with a flat triangle on its frame, which never moves."""
    four_bar = pins(2, [(0, 0), (1, 2), (4, 2.5), (5, 0)])
    ends = (("L0", "T1"), ("T1", "T2"), ("T2", "L0"))
    flat = [
        turn(f"T{i}", *pair, Z, point)
        for i, (pair, point) in enumerate(zip(ends, TRIANGLE, strict=True))
    ]
    return model("L0", "L2", *four_bar.joints, *flat)


def line_symmetric() -> PostureModel:
    half = {"A": (1.0, 0.3, 0.2), "B": (0.2, 1.3, -0.4), "C": (0.6, -0.5, 1.1)}
    other = {name.lower(): (-x, -y, z) for name, (x, y, z) in half.items()}
    return octahedron(half | other)


def plane_symmetric() -> PostureModel:
    corners = {"A": (1.0, 0.3, 0.9), "B": (-0.4, 1.3, -0.4)}
    other = {name.lower(): (x, -y, z) for name, (x, y, z) in corners.items()}
    return octahedron(corners | other | {"C": (0.6, 0, 1.1), "c": (-0.7, 0, 0.3)})


def test_a_generic_four_bar_linkage_moves_in_its_plane() -> None:
    found = finite_motion(pins(2, [(0, 0), (1, 2), (4, 2.5), (5, 0)]))
    assert (found.status, found.mobility) == ("sampled", (1,))
    (branch,) = found.branches
    assert (branch.loop_rank, branch.redundant_constraints) == (3, 3)
    assert (branch.motion_type, branch.couples, branch.motion) == ("0T1R", 2, "planar")


def test_bennett_moves_and_a_neighbour_does_not() -> None:
    """[Bennett1903]: four revolute joints in space, mobility 1 where Grübler has −2."""
    linkage = ring(2, BENNETT)
    found = finite_motion(linkage)
    assert found.mobility == (1,)
    assert found.branches[0].redundant_constraints == 3
    for number in range(4):
        assert finite_motion(perturbed(linkage, number)).mobility == (0,)


@pytest.mark.parametrize(
    "points", [[(0, 0), (1, 0), (3, 0)], [(0, 0), (1, 0), (3, 0), (6, 0)]]
)
def test_a_flat_chain_as_long_as_its_frame_is_shaky(
    points: list[tuple[float, float]],
) -> None:
    found = finite_motion(pins(1, points))
    assert (found.status, found.mobility, found.branches) == ("sampled", (0,), ())
    assert "starts return to the posture" in found.reason


def test_a_flat_parallelogram_has_two_branches() -> None:
    found = finite_motion(pins(2, [(0, 0), (1, 0), (4, 0), (3, 0)]))
    assert found.mobility == (1,)
    assert looks(found) == {
        (1, "1T0R", "pure translation in a plane"),
        (1, "0T1R", "planar"),
    }


def test_branches_of_different_dimension_meet() -> None:
    """A kinematotropic linkage: two freedoms with the hinge at rest, one without."""
    found = finite_motion(two_kites())
    assert found.mobility == (1, 2)
    assert looks(found) == {
        (2, "0T0R", "at rest"),
        (1, "0T1R", "rotation about a fixed axis"),
    }


def test_a_folded_sarrus_linkage() -> None:
    """Folded flat, its legs swing freely while the plates lie on each other."""
    joints = []
    for leg, along in (("a", (1.0, 0.0, 0.0)), ("b", (0.0, 1.0, 0.0))):
        across = np.cross(Z, along)
        places = (along, 2 * np.array(along), along)
        bodies = ("base", f"{leg}1", f"{leg}2", "plate")
        joints += [
            turn(f"{leg}{k}", bodies[k], bodies[k + 1], across, places[k])
            for k in range(3)
        ]
    found = finite_motion(model("base", "plate", *joints))
    assert found.mobility == (1, 2)
    assert looks(found) == {(2, "0T0R", "at rest"), (1, "1T0R", "straight line")}


def test_mobility_below_that_of_every_posture() -> None:
    found = finite_motion(shaky_and_moving())
    (branch,) = found.branches
    assert (branch.mobility, branch.instantaneous_mobility) == (1, 2)
    assert branch.motion == "planar"


@pytest.mark.parametrize("linkage", [line_symmetric(), plane_symmetric()])
def test_octahedra_of_bricard_are_flexible(linkage: PostureModel) -> None:
    """[Bricard1897]; twelve hinges and eight triangles, one freedom."""
    assert finite_motion(linkage).mobility == (1,)
    assert finite_motion(perturbed(linkage, 0)).mobility == (0,)


def test_convex_octahedra_are_rigid() -> None:
    """[Cauchy1813]."""
    corners = {"A": (1.0, 0.0, 0.1), "B": (0.0, 1.0, 0.0), "C": (0.0, 0.2, 1.0)}
    other = {"a": (-1.2, 0.0, 0.0), "b": (0.1, -1.0, 0.0), "c": (0.0, 0.0, -0.9)}
    assert finite_motion(octahedron(corners | other)).mobility == (0,)


@pytest.mark.parametrize(
    ("sectors", "mobility"),
    [((60, 75, 120, 105), 1), ((60, 80, 130, 90), 1), ((50, 70, 60, 40, 80, 60), 3)],
)
def test_flat_origami_vertices(sectors: tuple[float, ...], mobility: int) -> None:
    """N creases leave n − 3 freedoms, in several ways of folding."""
    found = finite_motion(origami_vertex(sectors, 2))
    assert found.mobility == (mobility,)
    assert {b.loop_rank for b in found.branches} == {3}
    assert {b.motion for b in found.branches} == {"rotation about a fixed point"}
    if mobility == 1:
        assert sum(b.modes for b in found.branches) == 2


@pytest.mark.parametrize("factor", [1e3, 1e-3])
@pytest.mark.parametrize(
    "linkage",
    [ring(2, BENNETT), two_kites(), pins(2, [(0, 0), (1, 0), (4, 0), (3, 0)])],
)
def test_place_units_and_order_do_not_matter(
    linkage: PostureModel, factor: float
) -> None:
    found = finite_motion(moved(linkage, factor, seed=3), seed=1)
    assert looks(found) == looks(finite_motion(linkage))


def test_locking_takes_a_freedom() -> None:
    five_bar = pins(2, [(0, 0), (1, 3), (3, 4), (6, 3), (7, 0)])
    assert finite_motion(five_bar).mobility == (2,)
    assert finite_motion(five_bar, locked=["J0"]).mobility == (1,)
    assert finite_motion(five_bar, locked=["J0", "J4"]).mobility == (0,)
    with pytest.raises(UnknownNameError, match="did you mean 'J0'"):
        finite_motion(five_bar, locked=["J00"])


def test_rounded_numbers_leave_the_question_open() -> None:
    linkage = ring(2, BENNETT)
    joint = linkage.joints[0]
    screws = joint.screws + np.array([[0, 0, 0, 2e-9, 1e-9, 1e-9]])
    joints = (PosedJoint("J0", "L0", "L1", screws), *linkage.joints[1:])
    found = finite_motion(replace(linkage, joints=joints))
    assert found.status == "undecided"
    assert "rounded" in found.reason


def test_the_same_seed_gives_the_same_answer() -> None:
    assert finite_motion(two_kites(), seed=4) == finite_motion(two_kites(), seed=4)


def test_words_for_motions() -> None:
    """Each subgroup is told from the one that contains it."""
    random = np.random.default_rng(1)

    def displacement(angle: float, axis: int, shift: tuple[float, ...]) -> np.ndarray:
        one = np.eye(4)
        i, j = (axis + 1) % 3, (axis + 2) % 3
        one[i, i] = one[j, j] = np.cos(angle)
        one[j, i], one[i, j] = np.sin(angle), -np.sin(angle)
        one[:3, 3] = shift
        return one

    def words(*makers: object) -> str:
        return motion_in_words(np.array(makers))

    a = random.uniform(-1, 1, (6, 3))
    assert words(*(displacement(0, 2, (x, 2 * x, 0)) for x, _, _ in a)) == (
        "straight line"
    )
    assert words(*(displacement(x, 2, (0, 0, 0.3 * x)) for x, _, _ in a)) == (
        "screw motion about a fixed axis"
    )
    assert words(*(displacement(x, 2, (0, 0, y)) for x, y, _ in a)) == (
        "rotation about and translation along a fixed axis"
    )
    assert words(*(displacement(x, 2, (y, z, 0)) for x, y, z in a)) == "planar"
    assert words(*(displacement(x, 2, (y, z, x * y)) for x, y, z in a)) == "Schönflies"
    assert words(
        *(displacement(x, k % 3, (0, 0, 0)) for k, (x, _, _) in enumerate(a))
    ) == ("rotation about a fixed point")
    assert not words(
        *(displacement(x, k % 3, (y, z, x)) for k, (x, y, z) in enumerate(a))
    )


@pytest.mark.parametrize("seed", [1, 2])
def test_one_rank_counted_in_two_ways_decides_nothing(seed: int) -> None:
    """A flat octahedron of Bricard's third type, its edges rods between balls.

    It moves in one way, and each of six rods spins: 7.  Samples near the flat posture
    disagree on the dimension; no other number may come out of that.
    """
    root = 79**0.5
    base = {"A": (1, 1 / 3, 0), "B": (1, 1 / 2, 0)}
    base["C"] = ((8 - root) / 4, (47 - 4 * root) / 12, 0)
    top = {"a": (0, 5 / 4, 0), "b": (1 / 5, 7 / 5, 0)}
    top["c"] = ((3 * root + 96) / 140, (47 - 4 * root) / 140, 0)
    joints = []
    for lower, upper in ("Ab", "Ac", "Ba", "Bc", "Ca", "Cb"):
        rod = f"rod{lower}{upper}"
        joints.append(ball(f"S{rod}", "base", rod, base[lower]))
        joints.append(ball(f"T{rod}", rod, "top", top[upper]))
    found = finite_motion(model("base", "top", *joints), seed=seed)
    assert found.mobility in {(), (7,)}
