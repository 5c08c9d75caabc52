"""Random hands as mechanisms, and their J and Gᵀ written out from the definitions.

Small integers make parallel, meeting and coincident axes frequent, so that ranks are
lost in every way; joints and contacts are many enough for redundancy and few enough
for indeterminacy.  Rows come from the tables of constraints, columns from a point and
a direction, all over the rationals.
"""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

import numpy as np
from grasping.random_grasps import Drawn
from kinematics.random_mechanisms import (
    UNITS,
    Six,
    Vec,
    constraint_wrenches,
    cross,
    dot,
    mechanism_of,
    random_joint,
    rank,
    read,
    written,
)
from numpy.typing import NDArray

from screwkit.algebra.expression import Number
from screwkit.mechanism.model import Joint, JointType, Mechanism, Space

Array = NDArray[np.float64]
J = JointType
SPACES: list[Space] = ["planar", "spatial"]
CONTACTS: Mapping[Space, tuple[JointType, ...]] = {
    "spatial": (
        J.POINT,
        J.HARD_FINGER,
        J.HARD_FINGER,
        J.SOFT_FINGER,
        J.LINE,
        J.LINE_FRICTION,
        J.PLANE,
        J.COMPLETE,
    ),
    "planar": (J.POINT, J.HARD_FINGER, J.HARD_FINGER, J.LINE, J.PLANE, J.COMPLETE),
}


@dataclass(frozen=True)
class Hand:
    """A mechanism and what the definitions say of it.

    Attributes:
        mechanism: Numbers only.
        drawn: Columns of J_a, J_p and Gᵀ, per unit of the axes as written.
        lengths: Squares of the lengths of the actuated axes.
        acting: For each row its (f; m) about the contact, in the order of the rows,
            with zeros at the other contacts.
    """

    mechanism: Mechanism
    drawn: Drawn
    lengths: tuple[int, ...]
    acting: tuple[tuple[Fraction, ...], ...]

    def floats(self) -> tuple[Array, Array, Array]:
        """J_a per unit axis, J_p and Gᵀ."""
        rows = self.drawn.rows

        def matrix(columns: list[list[int]]) -> Array:
            return np.array(columns, float).reshape(len(columns), rows).T

        lengths = np.sqrt(np.array(self.lengths, float))
        a, p, o = (matrix(c) for c in (self.drawn.a, self.drawn.p, self.drawn.o))
        return a / lengths, p, o


def hand(seed: int, space: Space) -> Hand:
    """Two or three fingers of up to four joints; contacts of every kind."""
    source = random.Random(seed)
    links, joints, fingers = ["palm"], [], []
    for finger in range(source.choice([2, 2, 3])):
        at, own = "palm", []
        for number in range(source.choice([0, 1, 1, 2, 2, 3, 4])):
            body, kind = (
                f"l{finger}{number}",
                source.choice([J.REVOLUTE] * 3 + [J.PRISMATIC]),
            )
            joint = random_joint(source, kind, (at, body), f"{finger}{number}", space)
            joint = replace(joint, variables=(f"q{finger}{number}",))
            if source.random() < 0.65:
                joint = replace(joint, actuated=(0,))
            links.append(body)
            own.append(joint)
            at = body
        kind = source.choice(CONTACTS[space])
        contact = random_joint(source, kind, (at, "ball"), f"c{finger}", space)
        if contact.point is None:
            contact = replace(contact, point=written((1, finger, 0)))
        joints += [*own, contact]
        fingers.append((own, contact))
    driven = tuple(j.name for j in joints if j.actuated)
    # Without a scheme all joints count as actuated.
    free = [j for own, _ in fingers for j in own]
    if not driven:
        joints = [replace(j, actuated=(0,)) if j in free else j for j in joints]
        driven = tuple(j.name for j in free)
    turned = list(driven)
    source.shuffle(turned)
    centre = tuple(
        Fraction(source.randint(-2, 2)) if k < 2 or space == "spatial" else Fraction(0)
        for k in range(3)
    )
    mechanism = replace(
        mechanism_of(joints, [*links, "ball"], space),
        scheme_order=tuple(turned),
        reference_point=written(centre),
    )
    return _defined(mechanism, fingers, turned, (centre[0], centre[1], centre[2]))


def _defined(
    mechanism: Mechanism,
    fingers: list[tuple[list[Joint], Joint]],
    driven: list[str],
    centre: Vec,
) -> Hand:
    space = mechanism.space
    rows: list[tuple[int, Six]] = []
    acting: list[tuple[Fraction, ...]] = []
    for number, (_, contact) in enumerate(fingers):
        own: list[Six] = []
        for wrench in constraint_wrenches(contact, space):
            if rank([*own, wrench]) > len(own):
                own.append(wrench)
        for wrench in own:
            point = read(contact.point)
            lever = cross(point, _force(wrench))
            moment = [m - x for m, x in zip(wrench[3:], lever, strict=True)]
            blank = [Fraction(0)] * (6 * len(fingers))
            blank[6 * number : 6 * number + 6] = [*wrench[:3], *moment]
            acting.append(tuple(blank))
            rows.append((number, wrench))
    finger_of = {j.name: k for k, (own, _) in enumerate(fingers) for j in own}
    joint_of = {j.name: j for own, _ in fingers for j in own}

    def column(name: str) -> list[int]:
        twist = _twist(joint_of[name])
        return [
            int(_power(wrench, twist)) if number == finger_of[name] else 0
            for number, wrench in rows
        ]

    coordinates = range(2, 5) if space == "planar" else range(6)
    object_columns = [
        [int(_power(wrench, _object_twist(k, centre))) for _, wrench in rows]
        for k in coordinates
    ]
    passive = [name for name in joint_of if name not in driven]
    drawn = Drawn(
        len(rows),
        [column(name) for name in driven],
        [column(name) for name in passive],
        object_columns,
    )
    lengths = [read(joint_of[name].axes[0]) for name in driven]
    return Hand(mechanism, drawn, tuple(int(dot(x, x)) for x in lengths), tuple(acting))


def _force(wrench: Six) -> Vec:
    return wrench[0], wrench[1], wrench[2]


def _twist(joint: Joint) -> Six:
    axis = read(joint.axes[0])
    if joint.type is J.PRISMATIC:
        return (Fraction(0),) * 3 + axis
    return axis + cross(read(joint.point), axis)


def _object_twist(number: int, centre: Vec) -> Six:
    """About the base origin, for a unit of one coordinate of (ω; v at the centre)."""
    if number >= 3:
        return (Fraction(0),) * 3 + UNITS[number - 3]
    omega = UNITS[number]
    return omega + cross(centre, omega)


def _power(wrench: Six, twist: Six) -> Fraction:
    return dot(wrench[:3], twist[3:]) + dot(wrench[3:], twist[:3])


def spd(source: random.Random, size: int) -> list[list[Fraction]]:
    """A Aᵀ + 1 of small integers."""
    root = [[source.randint(-1, 1) for _ in range(size)] for _ in range(size)]
    return [
        [
            Fraction(sum(x * y for x, y in zip(a, b, strict=True)) + (a is b))
            for b in root
        ]
        for a in root
    ]


def weighted(mechanism: Mechanism, **weights: list[list[Fraction]]) -> Mechanism:
    """The mechanism with exact weights."""
    return replace(
        mechanism,
        weights={
            key: tuple(tuple(Number(x) for x in row) for row in rows)
            for key, rows in weights.items()
        },
    )
