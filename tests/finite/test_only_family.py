"""Postures with more rates than motions on all of a smooth family of motions."""

from __future__ import annotations

from fractions import Fraction

import pytest
from finite.frames import FRAMES, Frame, Given
from finite.linkages import ball, flat_ring, hinge, network, slider

from screwkit.analyses import full_cycle
from screwkit.analyses.mobility import mobility
from screwkit.finite.finite_proofs import proved_mobility
from screwkit.kinematics.network import Network

FEET = [(0, 0, 0), (3, 0, 0), (4, 2, 1), (2, 5, 0), (-1, 3, 2)]


def plate_on_rods(
    feet: list[tuple[int, int, int]],
    rod: tuple[int, int, int],
    frame: Frame = FRAMES[0],
) -> Network:
    joints = []
    for k, foot in enumerate(feet):
        head = tuple(p + q for p, q in zip(foot, rod, strict=True))
        joints += [
            ball(f"S{k}", "base", f"rod{k}", frame.point(foot)),
            ball(f"T{k}", f"rod{k}", "plate", frame.point(head)),
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


@pytest.mark.parametrize("frame", FRAMES)
@pytest.mark.parametrize("feet", [FEET[:4], FEET])
def test_such_a_plate_moves_on_a_sphere_in_every_frame(
    feet: list[tuple[int, int, int]], frame: Frame
) -> None:
    """All rods stay parallel, so that the plate is shifted by their two rotations."""
    found = mobility(plate_on_rods(feet, (1, 2, 4), frame))
    assert found.full_cycle.status == "proved"
    assert found.platform.finite_motion_types == ("2T0R",)
    (branch,) = found.full_cycle.branches
    assert (branch.motion_type, branch.finite_type) == ("2T1R", "2T0R")
    assert branch.motion == "pure translation"
    assert branch.instantaneous_mobility == len(feet) + 3


@pytest.mark.parametrize("frame", FRAMES)
def test_stages_of_parallel_rods_translate_together(frame: Frame) -> None:
    """Two spheres' worth of shifts in a row: all three translations."""
    upper = [(0, 0, 9), (2, 1, 7), (1, 4, 8), (-3, 1, 8)]
    joints = []
    for name, feet, rod, ends in (
        ("a", FEET[:4], (1, 2, 4), ("base", "middle")),
        ("b", upper, (-2, 1, 4), ("middle", "top")),
    ):
        for k, foot in enumerate(feet):
            head = [p + q for p, q in zip(foot, rod, strict=True)]
            joints += [
                ball(f"S{name}{k}", ends[0], f"{name}{k}", frame.point(foot)),
                ball(f"T{name}{k}", f"{name}{k}", ends[1], frame.point(head)),
            ]
    found = mobility(network(*joints, platform="top"))
    assert found.full_cycle.status == "proved"
    assert found.full_cycle.mobility == (8 + 4,)
    assert found.platform.finite_motion_types == ("3T0R",)


@pytest.mark.parametrize("frame", FRAMES)
def test_equal_bars_carry_a_plate_on_circles(frame: Frame) -> None:
    joints = []
    for k, (x, y) in enumerate([(0, 0), (3, 0), (5, 1)]):
        foot, head = frame.point((x, y, 0)), frame.point((x + 1, y + 2, 0))
        axis = frame.direction((0, 0, 1))
        joints += [
            hinge(f"f{k}", "ground", f"bar{k}", foot, axis),
            hinge(f"h{k}", f"bar{k}", "plate", head, axis),
        ]
    found = mobility(network(*joints, platform="plate"))
    assert found.full_cycle.status == "proved"
    assert found.platform.finite_motion_types == ("1T0R",)
    (branch,) = found.full_cycle.branches
    assert branch.motion == "pure translation in a plane"


def test_what_is_proved_is_not_sampled(monkeypatch: pytest.MonkeyPatch) -> None:
    """A plate on rods, and a triangle of bars that is flat."""

    def refuse(*_: object, **__: object) -> object:
        raise AssertionError

    monkeypatch.setattr(full_cycle, "sampled_motion", refuse)
    plate = mobility(plate_on_rods(FEET[:4], (1, 2, 4)))
    assert plate.platform.finite_motion_types == ("2T0R",)
    flat = flat_ring((0, 0), (1, 0), (3, 0))
    assert flat.motion.mobility == 1
    assert mobility(flat).full_cycle.mobility == (0,)


@pytest.mark.parametrize("frame", FRAMES)
def test_legs_in_parallel_planes_keep_their_platform_to_planar_motion(
    frame: Frame,
) -> None:
    """Three balls stay in planes y = const: a platform of any attitude with these.

    Its y-direction u obeys u·(B − A) and u·(C − A) as at the start, so that u = j or
    the image of j in the plane of the balls, which holds j: they are the same.  The
    platform turns about j alone, beside two translations, though it may turn about an
    axis in its plane at first order.  The balls turn about j, which is no axis of the
    base frame in most frames.
    """
    legs: list[tuple[str, Given, Given, Given]] = [
        ("A", (4, 0, 0), (-1, 0, 6), (3, 0, 6)),
        ("B", (-4, 1, 0), (1, 0, 6), (-3, 1, 6)),
        ("C", (0, 5, 0), (1, 0, 6), (1, 5, 6)),
    ]
    joints = []
    for name, foot, along, top in legs:
        joints += [
            hinge(
                f"R{name}",
                "base",
                f"low{name}",
                frame.point(foot),
                frame.direction((0, 1, 0)),
            ),
            slider(f"P{name}", f"low{name}", f"high{name}", frame.direction(along)),
            ball(f"S{name}", f"high{name}", "top", frame.point(top)),
        ]
    robot = network(*joints, platform="top")
    assert robot.motion.mobility == 4
    proof = proved_mobility(robot, robot.motion)
    assert proof is not None
    assert proof.mobility == (3,)


@pytest.mark.parametrize("frame", FRAMES)
def test_balls_turn_about_the_axes_of_the_hinges_beside_them(frame: Frame) -> None:
    """Arms of one length swing in a plane, and a bar on their balls across it.

    The balls stay in a row, shifted by the arms' common angle.  The bar's line through
    the upper hinges goes round the row at a fixed distance, and the bar round its line:
    two circles of shifts and one rotation.  To first order the arms part, too.
    """
    joints = []
    for k, x in enumerate((2, 1, -2)):
        low, ball_at, high = ((x, -1, z) for z in (0, Fraction(3, 2), 3))
        across, along = frame.direction((0, 1, 0)), frame.direction((1, 0, 0))
        joints += [
            hinge(f"R{k}", "base", f"arm{k}", frame.point(low), across),
            ball(f"S{k}", f"arm{k}", f"link{k}", frame.point(ball_at)),
            hinge(f"T{k}", f"link{k}", "bar", frame.point(high), along),
        ]
    robot = network(*joints, platform="bar")
    assert robot.motion.mobility == 4
    found = mobility(robot)
    assert (found.full_cycle.status, found.full_cycle.mobility) == ("proved", (3,))
    assert found.platform.finite_motion_types == ("2T1R",)


@pytest.mark.parametrize("frame", FRAMES)
def test_three_equal_bars_in_a_line_leave_it_in_one_way(frame: Frame) -> None:
    """As parallelograms; any two could cross, yet not all three at once.

    To first order both ends of the plate move at will across the line.  Crossed, the
    plate turns by twice the sum of two small angles about a place that the distance of
    the bars decides, and the distances 2, 3 and 5 disagree.
    """
    axis = frame.direction((0, 0, 1))
    joints = []
    for k, x in enumerate((0, 2, 5)):
        joints += [
            hinge(f"f{k}", "ground", f"bar{k}", frame.point((x, 0, 0)), axis),
            hinge(f"h{k}", f"bar{k}", "plate", frame.point((x + 1, 0, 0)), axis),
        ]
    bars = network(*joints, platform="plate")
    assert bars.motion.mobility == 2
    proof = proved_mobility(bars, bars.motion)
    assert proof is not None
    assert proof.mobility == (1,)
    assert "tied or held" in proof.reason
