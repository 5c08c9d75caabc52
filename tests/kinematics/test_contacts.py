"""What joints and contacts hold, against their freedoms [BicchiPrattichizzo, I, II]."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction

import pytest
from kinematics.random_mechanisms import Similarity, dot, random_joint, rank
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
