"""What joints and contacts hold, against their freedoms [BicchiPrattichizzo, I, II]."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from kinematics.random_mechanisms import (
    Similarity,
    dot,
    random_joint,
    rank,
    read_number,
    written,
)
from kinematics.test_freedoms import EVERY, NAMES, RING, same_span

from screwkit.kinematics.contacts import contact_wrenches
from screwkit.kinematics.freedoms import freedom_twists
from screwkit.mechanism.model import Joint, JointType, Space
from screwkit.screw.displacement import Displacement

SELECTORS = {
    # By Tables I and II: how many rows of FS and of MS, in space.
    JointType.POINT: (1, 0),
    JointType.HARD_FINGER: (3, 0),
    JointType.SOFT_FINGER: (3, 1),
    JointType.LINE: (1, 1),
    JointType.LINE_FRICTION: (3, 2),
    JointType.PLANE: (1, 2),
    JointType.COMPLETE: (3, 3),
    JointType.REVOLUTE: (3, 2),
    JointType.PRISMATIC: (2, 3),
    JointType.SPHERICAL: (3, 0),
    # By the same reasoning, beyond the tables.
    JointType.CYLINDRICAL: (2, 2),
    JointType.UNIVERSAL: (3, 1),
    JointType.PLANAR: (1, 2),
    JointType.FIXED: (3, 3),
}
IN_THE_PLANE = {
    JointType.POINT: (1, 0),
    JointType.HARD_FINGER: (2, 0),
    JointType.LINE: (1, 1),
    JointType.PLANE: (1, 1),
    JointType.COMPLETE: (2, 1),
    JointType.REVOLUTE: (2, 0),
    JointType.PRISMATIC: (1, 1),
    JointType.FIXED: (2, 1),
}


def drawn(kind: JointType, space: Space) -> list[Joint]:
    return [
        random_joint(random.Random(seed), kind, space=space, name=f"j{seed}")
        for seed in range(6)
    ]


@pytest.mark.parametrize(("kind", "space"), EVERY, ids=NAMES)
def test_what_is_held_is_reciprocal_to_what_is_free(
    kind: JointType, space: Space
) -> None:
    for joint in drawn(kind, space):
        held = [w.coordinates for w in contact_wrenches(joint, RING, space)]
        free = [t.coordinates for t in freedom_twists(joint, RING, space)]
        power = [dot(w[:3], t[3:]) + dot(w[3:], t[:3]) for w in held for t in free]
        assert not any(power)
        assert rank(held) == len(held)
        size = 3 if space == "planar" else 6
        if kind is not JointType.UNIVERSAL:  # whose axes may be parallel
            assert len(held) + rank(free) == size


@pytest.mark.parametrize("kind", SELECTORS)
def test_rows_of_the_selectors(kind: JointType) -> None:
    for joint in drawn(kind, "spatial"):
        kinds = [w.kind for w in contact_wrenches(joint, RING)]
        assert (kinds.count("force"), kinds.count("couple")) == SELECTORS[kind]
        assert kinds == sorted(kinds, reverse=True)  # forces before couples


@pytest.mark.parametrize("kind", IN_THE_PLANE)
def test_rows_of_the_selectors_in_the_plane(kind: JointType) -> None:
    """Forces in the plane, couples about z."""
    for joint in drawn(kind, "planar"):
        rows = contact_wrenches(joint, RING, "planar")
        kinds = [w.kind for w in rows]
        assert (kinds.count("force"), kinds.count("couple")) == IN_THE_PLANE[kind]
        for row in rows:
            force, moment = row.coordinates[2], row.coordinates[3:5]
            assert not force
            assert not any(moment)


def test_a_line_with_friction_hinges_about_its_line_and_no_more() -> None:
    """With normal z and line x it turns about x; about y and z it is held (E16)."""
    for kind, free in (
        (JointType.LINE_FRICTION, [(1, 0, 0)]),
        (JointType.LINE, [(1, 0, 0), (0, 0, 1)]),
        (JointType.PLANE, [(0, 0, 1)]),
        (JointType.SOFT_FINGER, [(1, 0, 0), (0, 1, 0)]),
    ):
        joint = replace(
            drawn(kind, "spatial")[0],
            point=written((0, 0, 0)),
            normal=written((0, 0, 1)),
            line=written((1, 0, 0)) if "line" in kind else None,
        )
        held = [w.coordinates for w in contact_wrenches(joint, RING)]
        for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1)):
            felt = any(dot(w[3:], tuple(map(Fraction, axis))) for w in held)
            assert felt == (axis not in free), (kind, axis)


def test_a_screw_joint_holds_a_screw() -> None:
    """Zᵀv − h zᵀω: two forces, two couples and a wrench of pitch −h."""
    for joint in drawn(JointType.HELICAL, "spatial"):
        rows = contact_wrenches(joint, RING)
        kinds = [w.kind for w in rows]
        assert [kinds.count(k) for k in ("force", "screw", "couple")] == [2, 1, 2]
        (screw,) = (w for w in rows if w.kind == "screw")
        assert joint.pitch is not None
        pitch = dot(screw.force, screw.moment) / dot(screw.force, screw.force)
        assert pitch == -read_number(joint.pitch)


@pytest.mark.parametrize(("kind", "space"), EVERY, ids=NAMES)
def test_directions_are_at_right_angles(kind: JointType, space: Space) -> None:
    for joint in drawn(kind, space):
        rows = contact_wrenches(joint, RING, space)
        for which in ("force", "couple"):
            some = [w.direction for w in rows if w.kind == which]
            for number, one in enumerate(some):
                assert all(dot(one, other) == 0 for other in some[:number])


@pytest.mark.parametrize(("kind", "space"), EVERY, ids=NAMES)
def test_moving_a_contact_moves_what_it_holds(kind: JointType, space: Space) -> None:
    """By a displacement, and by other numbers in the file: the same wrenches."""
    for seed, joint in enumerate(drawn(kind, space)):
        move = replace(
            Similarity.drawn(random.Random(seed + 50), space), scale=Fraction(1)
        )
        there = Displacement(move.rotation, move.shift)
        carried = contact_wrenches(joint, RING, space, there)
        written = contact_wrenches(move.of_joint(joint), RING, space)
        assert same_span(
            [w.coordinates for w in carried], [w.coordinates for w in written]
        )
