"""Rods that spin are split off before the rest of a mechanism is sampled."""

from __future__ import annotations

from itertools import permutations

import numpy as np
import pytest
from finite.linkages import ball, hinge, network
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from screwkit.algebra.batch import Array
from screwkit.analyses.mobility import mobility
from screwkit.finite.finite_motion import finite_motion
from screwkit.finite.idle_freedoms import idle_freedoms
from screwkit.finite.idle_samples import idle_shares
from screwkit.finite.posture_model import posture_model
from screwkit.kinematics.network import Network

ROOT = "sqrt(79)"
BASE = {
    "A": ("1", "1/3"),
    "B": ("1", "1/2"),
    "C": (f"(8 - {ROOT})/4", f"(47 - 4*{ROOT})/12"),
}
"""Bricard's octahedron of the third kind, flat: opposite corners A a, B b, C c."""

TOP = {
    "a": ("0", "5/4"),
    "b": ("1/5", "7/5"),
    "c": (f"(3*{ROOT} + 96)/140", f"(47 - 4*{ROOT})/140"),
}


def on_rods() -> Network:
    """The faces ABC and abc are base and top, the six edges between them rods."""
    joints = []
    for one, other in permutations("abc", 2):
        rod = f"rod_{one}{other}"
        joints += [
            ball(f"S_{one}{other}", "base", rod, (*BASE[one.upper()], 0)),
            ball(f"T_{one}{other}", rod, "top", (*TOP[other], 0)),
        ]
    return network(*joints, platform="top")


def centres(of: Network) -> dict[str, Array]:
    """Where ball joints are."""
    return {
        joint.name: 0.5 * np.cross(joint.screws[:, :3], joint.screws[:, 3:]).sum(axis=0)
        for joint in posture_model(of.mechanism).joints
    }


def test_the_third_octahedron_moves_in_one_way_beside_its_spinning_rods() -> None:
    """A second route: poses of the top that keep six distances, and their rank."""
    rods = on_rods()
    at = centres(rods)
    edges = ["".join(edge) for edge in permutations("abc", 2)]
    base, top = (np.array([at[f"{end}_{edge}"] for edge in edges]) for end in "ST")

    def missed(pose: Array) -> Array:
        moved = Rotation.from_rotvec(pose[:3]).apply(top) + pose[3:]
        kept = ((base - moved) ** 2).sum(axis=1)
        return np.asarray(kept - ((base - top) ** 2).sum(axis=1))

    random, ranks = np.random.default_rng(0), set()
    for _ in range(60):
        start = random.normal(0, 0.3, 6)
        pose = least_squares(missed, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
        turned = np.linalg.norm(pose.x[:3])
        if np.abs(pose.fun).max() < 1e-13 and 0.1 < turned < 1.0:
            sizes = np.linalg.svd(pose.jac, compute_uv=False)
            ranks.add(int((sizes > 1e-5 * sizes[0]).sum()))
    assert 5 in ranks
    assert ranks <= {5, 6}, "other assemblies of these rods are isolated"

    assert rods.motion.mobility == 9
    found = mobility(rods)
    assert (found.full_cycle.status, found.full_cycle.mobility) == ("sampled", (7,))
    assert found.platform.finite_motion_types == ("0T1R",)
    (branch,) = found.full_cycle.branches
    assert (branch.mobility, branch.instantaneous_mobility) == (7, 7)
    assert branch.loop_rank == 36 - 7


@pytest.mark.parametrize("seed", range(5))
def test_no_seed_finds_anything_else(seed: int) -> None:
    rods = on_rods()
    model = posture_model(rods.mechanism)
    idle = idle_freedoms(rods.motion, ("base", "top"), idle_shares(model))
    assert len(idle) == 6
    assert finite_motion(model, locked=idle, seed=seed).mobility == (1,)


def test_held_freedoms_are_those_along_the_rod() -> None:
    """A rod along x with a little of y: about x it spins, so x is held, not y."""
    joints = []
    for k, (x, y, z) in enumerate([(0, 0, 0), (0, 5, 1), (1, -4, 2), (3, 2, 7)]):
        joints += [
            ball(f"S{k}", "base", f"rod{k}", (x, y, z)),
            ball(f"T{k}", f"rod{k}", "top", (f"{x} + 1", f"{y} + 1/50", z)),
        ]
    rods = network(*joints, platform="top")
    model = posture_model(rods.mechanism)
    idle = idle_freedoms(rods.motion, ("base", "top"), idle_shares(model))
    assert idle == ("S0:0", "S1:0", "S2:0", "S3:0")


def test_where_nothing_but_rods_can_spin_the_platform_is_at_rest() -> None:
    """Two stretched bars in a line, and in line with them a rod from one to the wall.

    Both triangles are flat, so the bars cannot leave the line; the rod spins about it.
    """
    flat = network(
        hinge("J0", "wall", "bar", (0, 0, 0)),
        hinge("J1", "bar", "other", (1, 0, 0)),
        hinge("J2", "other", "wall", (3, 0, 0)),
        ball("S", "bar", "rod", (2, 0, 0)),
        ball("T", "rod", "wall", (5, 0, 0)),
        platform="bar",
    )
    assert flat.motion.mobility == 2
    found = mobility(flat)
    assert (found.full_cycle.status, found.full_cycle.mobility) == ("proved", (1,))
    assert found.platform.motion_type == "0T1R"
    assert found.platform.finite_motion_types == ("0T0R",)
    (branch,) = found.full_cycle.branches
    assert (branch.motion, branch.instantaneous_mobility) == ("at rest", 2)


def test_the_spin_of_the_platform_itself_is_not_left_aside() -> None:
    """Of three stretched bars in a line between balls the middle one is asked for."""
    bodies = ["wall", "left", "middle", "right", "wall"]
    bars = network(
        *(ball(f"S{k}", bodies[k], bodies[k + 1], (k * k, 0, 0)) for k in range(4)),
        platform="middle",
    )
    found = mobility(bars)
    assert found.full_cycle.mobility == (3,)
    assert found.platform.finite_motion_types == ("0T1R",)


@pytest.mark.parametrize(
    ("platform", "finite_type"), [("plate", "2T0R"), ("rod0", "0T3R")]
)
def test_a_plate_on_six_equal_parallel_rods_is_one_branch(
    platform: str, finite_type: str
) -> None:
    """Such a plate moves on a sphere without turning, and six rods spin.

    It is shaky wherever it stands: six parallel forces have the rank 3.  Not all of the
    samples tell along which twists they move, and these are no other branch.
    """
    feet = [(0, 0, 0), (3, 0, 0), (4, 2, 1), (2, 5, 0), (-1, 3, 2), (-2, 1, -1)]
    rods = network(
        *(
            joint
            for k, (x, y, z) in enumerate(feet)
            for joint in (
                ball(f"S{k}", "base", f"rod{k}", (x, y, z)),
                ball(f"T{k}", f"rod{k}", "plate", (x + 1, y + 2, z + 4)),
            )
        ),
        platform=platform,
    )
    assert rods.motion.mobility == 6 + 3
    found = mobility(rods)
    assert found.full_cycle.mobility == (8,)
    assert [branch.mobility for branch in found.full_cycle.branches] == [8]
    assert found.platform.finite_motion_types == (finite_type,)
