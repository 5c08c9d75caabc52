"""Postures with more rates than motions on all of a smooth family of motions."""

from __future__ import annotations

import pytest
from finite.linkages import Vector, ball, hinge, network, slider

from screwkit.analyses.mobility import mobility
from screwkit.finite.finite_proofs import proved_mobility
from screwkit.kinematics.network import Network

FEET = [(0, 0, 0), (3, 0, 0), (4, 2, 1), (2, 5, 0), (-1, 3, 2)]


def plate_on_rods(
    feet: list[tuple[int, int, int]], rod: tuple[int, int, int]
) -> Network:
    joints = []
    for k, foot in enumerate(feet):
        head = tuple(p + q for p, q in zip(foot, rod, strict=True))
        joints += [
            ball(f"S{k}", "base", f"rod{k}", foot),
            ball(f"T{k}", f"rod{k}", "plate", head),
        ]
    return network(*joints, platform="plate")


@pytest.mark.parametrize("rod", [(1, 2, 4), (137, -16, -34), (0, 0, 3)])
@pytest.mark.parametrize("feet", [FEET[:4], FEET])
def test_a_plate_on_equal_parallel_rods_only_translates(
    feet: list[tuple[int, int, int]], rod: tuple[int, int, int]
) -> None:
    """Turned by t about the rods it sinks by t² times a half of the squared radius.

    Tops at p sink by |v + t n × p|² / 2L to second order, an affine function of p for
    all of them only if t = 0 or the feet, seen along the rods, lie on a circle.  They
    do not, seen along any of these: what is left are the shifts v, two, which go on.
    """
    plate = plate_on_rods(feet, rod)
    assert plate.motion.mobility == len(feet) + 3
    proof = proved_mobility(plate, plate.motion)
    assert proof is not None
    assert proof.mobility == (len(feet) + 2,)
    assert "the rank stays the same" in proof.reason


def test_a_doubtful_tangent_makes_no_second_branch() -> None:
    found = mobility(plate_on_rods(FEET, (1, 2, 4)))
    assert found.full_cycle.status == "proved"
    assert len(found.full_cycle.branches) == 1
    assert found.platform.finite_motion_types == ("2T0R",)


def test_legs_in_parallel_planes_keep_their_platform_to_planar_motion() -> None:
    """Three balls stay in planes y = const: a platform of any attitude with these.

    Its y-direction u obeys u·(B − A) and u·(C − A) as at the start, so that u = j or
    the image of j in the plane of the balls, which holds j: they are the same.  The
    platform turns about j alone, beside two translations, though it may turn about an
    axis in its plane at first order.
    """
    legs: list[tuple[str, Vector, Vector, Vector]] = [
        ("A", (4, 0, 0), (-1, 0, 6), (3, 0, 6)),
        ("B", (-4, 1, 0), (1, 0, 6), (-3, 1, 6)),
        ("C", (0, 5, 0), (1, 0, 6), (1, 5, 6)),
    ]
    joints = []
    for name, foot, along, top in legs:
        joints += [
            hinge(f"R{name}", "base", f"low{name}", foot, (0, 1, 0)),
            slider(f"P{name}", f"low{name}", f"high{name}", along),
            ball(f"S{name}", f"high{name}", "top", top),
        ]
    robot = network(*joints, platform="top")
    assert robot.motion.mobility == 4
    proof = proved_mobility(robot, robot.motion)
    assert proof is not None
    assert proof.mobility == (3,)


def test_rods_on_a_circle_are_not_claimed() -> None:
    """There the second order leaves every rate: nothing is said from it."""
    circle = [(5, 0, 0), (0, 5, 0), (-5, 0, 0), (3, 4, 0), (-4, 3, 0)]
    plate = plate_on_rods(circle, (0, 0, 3))
    assert proved_mobility(plate, plate.motion) is None
