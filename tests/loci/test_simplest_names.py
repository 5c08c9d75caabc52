"""A line is called by the axis it is, not by the points and axes that also fix it."""

from __future__ import annotations

import pytest

import screwkit as sk
from screwkit.loci.reciprocals import proportional


@pytest.mark.parametrize(
    ("name", "limb", "axis"),
    [("exechon", 0, "U11:1"), ("exechon", 1, "U21:1")],
)
def test_a_force_on_an_axis_is_said_to_be_there(
    name: str, limb: int, axis: str
) -> None:
    """The coordinates show it: the twist of that axis, read as a wrench."""
    case = sk.load(name)
    screws = sk.screws(case).limbs[limb]
    (force,) = [w for w in screws.wrenches if w.kind == "force"]
    assert force.description == f"force along axis {axis}"
    framed = case.assembly.base_twists
    column = framed.column(axis)
    wrenches = case.limbs[limb].wrenches.columns
    assert any(proportional(framed.ring, column, wrench) for wrench in wrenches)


def test_locked_joints_of_a_four_ruu_limb_push_along_axes() -> None:
    """Locking one of two parallel axes leaves the other to carry the force."""
    added = {
        (w.joint, w.freedom): w.screw
        for w in sk.screws(sk.load("4ruu")).actuation_wrenches
    }
    for joint, other in (("U12", "U13:1"), ("U22", "U23:1")):
        screw = added[joint, 1]
        assert screw is not None
        assert screw.description == f"force along axis {other}"


@pytest.mark.parametrize("finger", [1, 2, 3])
def test_forces_through_fingertips_are_named(finger: int) -> None:
    """A ball joint with no axis through its centre is a point of the geometry too.

    Locking the yaw of a finger leaves what meets or is parallel to its other two axes,
    which are parallel, and passes through the tip.
    """
    added = {
        w.joint: w.screw
        for w in sk.screws(sk.load("hand_three_hard")).actuation_wrenches
    }
    screw = added[f"yaw{finger}"]
    assert screw is not None
    assert screw.description == (
        f"force through the centre of tip{finger}, parallel to axis pitch{finger}"
    )


def test_axes_of_forces_are_joined_as_axes() -> None:
    translation = sk.screws(sk.load("2upr_rpu")).platform.twists[0]
    assert translation.description == "translation normal to axes U11:1 and U33:0"


def test_proportional_columns_differ_by_a_factor() -> None:
    framed = sk.load("nao_t14").assembly.base_twists
    one, other = framed.columns[2], framed.columns[3]
    ring = framed.ring
    factor = next(value for value in other if not value.is_constant())
    scaled = [ring.normal(factor * value) for value in one]
    assert proportional(ring, one, scaled)
    assert not proportional(ring, one, other)


def test_a_force_that_meets_one_axis_and_is_normal_to_another_is_named() -> None:
    """Locking joint 2 of the SCARA arm leaves axis 1, the tip and the slide."""
    added = {
        w.joint: w.screw
        for w in sk.screws(sk.load("scara_pair_hard")).actuation_wrenches
    }
    screw = added["2"]
    assert screw is not None
    assert screw.description == (
        "force through the centre of c1, meeting axis 1, normal to axis 2"
    )
    assert screw.coordinates[2] == "0"  # normal to the vertical axes
