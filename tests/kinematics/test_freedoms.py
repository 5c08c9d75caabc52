"""Twists of joints and contacts against the tables of their constraints."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from kinematics.random_mechanisms import (
    NOTHING,
    PLANAR,
    SPATIAL,
    UNITS,
    Similarity,
    Six,
    constraint_wrenches,
    dot,
    random_joint,
    rank,
    rescaled,
    turned_round,
    written,
)

from screwkit.algebra.expression import Expression, Number
from screwkit.errors import UndecidedError
from screwkit.kinematics.freedoms import freedom_twists
from screwkit.mechanism.joints import freedom_labels, freedoms_of_type
from screwkit.mechanism.model import Joint, JointType, Space
from screwkit.screw.displacement import Displacement

SEEDS = range(6)
EVERY: list[tuple[JointType, Space]] = [
    *((kind, "spatial") for kind in SPATIAL),
    *((kind, "planar") for kind in PLANAR),
]
NAMES = [f"{kind}-{space}" for kind, space in EVERY]


class Rationals:
    """The ring of plain fractions; joints at numbers need no more."""

    zero, one = Fraction(0), Fraction(1)
    known = None
    plain = True

    def rational(self, value: Fraction) -> Fraction:
        return value

    def normal(self, value: Fraction) -> Fraction:
        return value

    def is_zero(self, value: Fraction) -> bool:
        return not value

    def symbol(self, name: str) -> Fraction:
        raise KeyError(name)

    def cosine_sine(self, angle: str) -> tuple[Fraction, Fraction]:
        raise KeyError(angle)

    def half_turns(self, count: Fraction) -> tuple[Fraction, Fraction]:
        raise KeyError(count)

    def radians(self, value: Fraction) -> tuple[Fraction, Fraction]:
        raise KeyError(value)

    def square_root(self, radicand: Expression, value: Fraction) -> Fraction:
        raise AssertionError("a twist counts up to a factor: no root is needed")

    def inverse(self, divisor: Expression, value: Fraction) -> Fraction:
        raise AssertionError("a twist counts up to a factor: nothing is divided")


RING = Rationals()


def twists_of(joint: Joint, space: Space = "spatial") -> list[Six]:
    return [twist.coordinates for twist in freedom_twists(joint, RING, space)]


def joints_of(kind: JointType, space: Space) -> list[Joint]:
    return [
        random_joint(random.Random(seed), kind, space=space, name=f"j{seed}")
        for seed in SEEDS
    ]


def power(wrench: Six, twist: Six) -> Fraction:
    """f·v + m·ω."""
    return dot(wrench[:3], twist[3:]) + dot(wrench[3:], twist[:3])


def same_span(one: list[Six], other: list[Six]) -> bool:
    return rank(one) == rank(other) == rank([*one, *other])


@pytest.mark.parametrize(("kind", "space"), EVERY, ids=NAMES)
def test_freedoms_and_constraints_share_the_space(
    kind: JointType, space: Space
) -> None:
    """Reciprocal to the table's wrenches, and as many as these leave."""
    for joint in joints_of(kind, space):
        twists = twists_of(joint, space)
        wrenches = constraint_wrenches(joint, space)
        size = 3 if space == "planar" else 6
        assert len(twists) == freedoms_of_type(kind, space)
        assert len(twists) == len(freedom_labels(joint, space))
        assert all(power(w, t) == 0 for w in wrenches for t in twists)
        assert rank(twists) == size - rank(wrenches)
        if kind is not JointType.UNIVERSAL:  # whose axes may be parallel
            assert rank(twists) == len(twists)
        if space == "planar":
            assert not any(t[k] for t in twists for k in (0, 1, 5))


@pytest.mark.parametrize(("kind", "space"), EVERY, ids=NAMES)
def test_moving_the_joint_moves_its_twists(kind: JointType, space: Space) -> None:
    """Covariance, by moving the numbers of the joint and by moving the twists."""
    for seed, joint in enumerate(joints_of(kind, space)):
        move = replace(
            Similarity.drawn(random.Random(seed + 50), space), scale=Fraction(1)
        )
        wanted = [tuple(move.of_twist(t)) for t in twists_of(joint, space)]
        assert same_span(twists_of(move.of_joint(joint), space), wanted)
        carried = freedom_twists(
            joint, RING, space, Displacement(move.rotation, move.shift)
        )
        assert same_span([twist.coordinates for twist in carried], wanted)


@pytest.mark.parametrize(("kind", "space"), EVERY, ids=NAMES)
def test_scaling_lengths_scales_moments(kind: JointType, space: Space) -> None:
    for seed, joint in enumerate(joints_of(kind, space)):
        move = Similarity.drawn(random.Random(seed), space)
        wanted = [tuple(move.of_twist(t)) for t in twists_of(joint, space)]
        assert same_span(twists_of(move.of_joint(joint), space), wanted)


@pytest.mark.parametrize(("kind", "space"), EVERY, ids=NAMES)
def test_lengths_of_axes_do_not_count(kind: JointType, space: Space) -> None:
    """Nor their sense; each freedom alone is the same, not only what all span.

    Translations in a plane are a choice: there the plane is the same.
    """
    for seed, joint in enumerate(joints_of(kind, space)):
        other = twists_of(rescaled(joint, random.Random(seed)), space)
        mine = twists_of(joint, space)
        assert same_span(mine, other)
        if joint.axes:
            pairs = zip(mine, other, strict=True)
            assert all(same_span([one], [two]) for one, two in pairs)


@pytest.mark.parametrize(("kind", "space"), EVERY, ids=NAMES)
def test_parent_and_child_only_change_the_sign(kind: JointType, space: Space) -> None:
    """The axes of a twist are those of the joint, whichever body comes first."""
    for joint in joints_of(kind, space):
        assert twists_of(turned_round(joint), space) == twists_of(joint, space)


def test_rotations_of_contacts_come_first() -> None:
    for kind in SPATIAL:
        for joint in joints_of(kind, "spatial"):
            turning = [any(t[:3]) for t in twists_of(joint)]
            assert turning == sorted(turning, reverse=True)


def test_positive_pitch_is_right_handed() -> None:
    """One radian about +z at pitch 2 carries a point of the axis by +2 along z."""
    screw = Joint(
        "h",
        JointType.HELICAL,
        "base",
        "nut",
        ("q",),
        axes=(written((0, 0, 3)),),
        point=written((1, 0, 5)),
        pitch=Number(Fraction(2)),
    )
    for length in (3, 1, -2):
        (twist,) = twists_of(replace(screw, axes=(written((0, 0, length)),)))
        turning, at_origin = twist[:3], twist[3:]
        # v(p) = v(origin) + ω × p, with p = (1, 0, 5) and ω = (0, 0, ω)
        rate = turning[2]
        on_axis = (at_origin[0], at_origin[1] + rate, at_origin[2])
        assert on_axis == (*NOTHING[:2], 2 * rate)
        assert rate != 0


def test_moment_of_a_rotation_is_point_cross_axis() -> None:
    """About z through (1, 0, 0), the origin moves along −y: [LongCaroKhalil2012] 24."""
    hinge = Joint(
        "r",
        JointType.REVOLUTE,
        "base",
        "door",
        ("q",),
        axes=(written((0, 0, 1)),),
        point=written((1, 0, 0)),
    )
    assert twists_of(hinge) == [(*UNITS[2], *(-x for x in UNITS[1]))]
    assert twists_of(hinge, "planar") == twists_of(hinge)


def test_freedoms_are_labelled_as_in_schemes() -> None:
    ball = random_joint(random.Random(1), JointType.SPHERICAL, name="ball")
    found = freedom_twists(ball, RING)
    assert [(t.joint, t.freedom, t.label) for t in found] == [
        ("ball", k, f"ball:{k}") for k in range(3)
    ]
    slider = random_joint(random.Random(1), JointType.PRISMATIC, name="slider")
    assert [t.label for t in freedom_twists(slider, RING)] == ["slider"]


@pytest.mark.parametrize("unit", UNITS, ids="xyz")
def test_normals_along_the_axes_of_the_base(unit: tuple[Fraction, ...]) -> None:
    """Where products with some unit vectors vanish, tangents still span the plane."""
    for kind in (JointType.PLANE, JointType.POINT, JointType.SOFT_FINGER):
        joint = Joint("c", kind, "a", "b", point=written(NOTHING), normal=written(unit))
        twists = twists_of(joint)
        assert rank(twists) == len(twists) == freedoms_of_type(kind)
        wrenches = constraint_wrenches(joint)
        assert all(power(w, t) == 0 for w in wrenches for t in twists)


def test_a_joint_that_is_nowhere_is_not_guessed() -> None:
    for kind in SPATIAL:
        joint = replace(random_joint(random.Random(2), kind), point=None)
        free_of_place = {
            JointType.PRISMATIC,
            JointType.PLANAR,
            JointType.PLANE,
            JointType.FIXED,
            JointType.COMPLETE,
        }
        if kind in free_of_place:
            freedom_twists(joint, RING)
        else:
            with pytest.raises(UndecidedError, match="has no point"):
                freedom_twists(joint, RING)
