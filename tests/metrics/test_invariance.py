"""What indices may not depend on: frames, points, units, and how a file is written.

Random hands of every kind, with redundancy, indeterminacy and rank loss, are changed
in ways that change nothing, or something known, and measured again.
"""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from grasping.random_hands import SPACES, Hand, hand, weighted
from kinematics.random_mechanisms import (
    UNITS,
    Similarity,
    cross,
    read,
    rescaled,
    turned_round,
    written,
)

import screwkit as sk
from screwkit.algebra.expression import Number
from screwkit.analyses.manipulability import manipulability
from screwkit.kinematics.network import Network
from screwkit.mechanism.model import Mechanism, Space
from screwkit.results.manipulability import IndexValues, Manipulability

EVERY = [(seed, space) for space in SPACES for seed in range(100, 118)]
INDICES = ("kinematic", "force", "active_force", "passive_force", "internal_force")


def answer_of(mechanism: Mechanism) -> Manipulability:
    return manipulability(Network(mechanism))


@cache
def measured(seed: int, space: Space) -> tuple[Hand, Manipulability]:
    drawn = hand(seed, space)
    return drawn, answer_of(drawn.mechanism)


def same(one: Manipulability, other: Manipulability) -> None:
    assert one.partition.gamma == other.partition.gamma
    assert one.statics.transmitted == other.statics.transmitted
    for name in INDICES:
        a, b = getattr(one, name), getattr(other, name)
        assert isinstance(a, IndexValues)
        assert (a.infinite, a.zero) == (b.infinite, b.zero)
        assert np.allclose(a.finite, b.finite, rtol=1e-7)


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_the_place_of_the_base_frame_is_no_matter(seed: int, space: Space) -> None:
    drawn, before = measured(seed, space)
    mechanism = drawn.mechanism
    move = replace(Similarity.drawn(random.Random(seed), space), scale=Fraction(1))
    moved = replace(
        mechanism,
        joints=tuple(move.of_joint(joint) for joint in mechanism.joints),
        reference_point=written(move.moved(read(mechanism.reference_point))),
    )
    same(answer_of(moved), before)


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_the_way_of_writing_is_no_matter(seed: int, space: Space) -> None:
    """Longer axes, contacts from the other side, contacts in another order."""
    drawn, before = measured(seed, space)
    mechanism, source = drawn.mechanism, random.Random(seed)
    joints = [rescaled(joint, source) for joint in mechanism.joints]
    joints = [turned_round(j) if source.random() < 0.5 else j for j in joints]
    source.shuffle(joints)
    same(answer_of(replace(mechanism, joints=tuple(joints))), before)


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_the_reference_point_is_no_matter_to_forces_within(
    seed: int, space: Space
) -> None:
    """Dimensions and internal forces stay; the rest does with weights carried along.

    v' = v + ω × d, so u = A u' and W' = Aᵀ W A; wrenches transform by A⁻ᵀ.
    """
    drawn, before = measured(seed, space)
    mechanism, source = drawn.mechanism, random.Random(seed)
    d = [Fraction(source.randint(-2, 2)) for _ in range(3)]
    if space == "planar":
        d[2] = Fraction(0)
    x, y, z = read(mechanism.reference_point)
    there = written((x + d[0], y + d[1], z + d[2]))
    plain = answer_of(replace(mechanism, reference_point=there))
    assert plain.partition.gamma == before.partition.gamma
    assert np.allclose(plain.internal_force.finite, before.internal_force.finite)
    counts = [
        (getattr(a, n).infinite, getattr(a, n).zero) for n in INDICES for a in (plain,)
    ]
    assert counts == [
        (getattr(before, n).infinite, getattr(before, n).zero) for n in INDICES
    ]
    size = 3 if space == "planar" else 6
    a, b = _carried(d, size, back=True), _carried(d, size, back=False)
    twist = _gram(a)
    # m' = m − d × f: power is the same, so wrenches go by the transpose of B.
    order = [1, 2, 0] if size == 3 else [3, 4, 5, 0, 1, 2]
    transposed = [[b[j][i] for j in range(size)] for i in range(size)]
    wrench = _gram([[transposed[i][j] for j in order] for i in order])
    carried = weighted(
        replace(mechanism, reference_point=there), twist=twist, wrench=wrench
    )
    same(answer_of(carried), before)


def _carried(d: list[Fraction], size: int, *, back: bool) -> list[list[Fraction]]:
    """(ω; v) at a point d further, as a matrix; ``back`` from there to here."""
    sign = -1 if back else 1
    whole = [[Fraction(int(i == j)) for j in range(6)] for i in range(6)]
    for k in range(3):
        unit = (Fraction(int(k == 0)), Fraction(int(k == 1)), Fraction(int(k == 2)))
        for i, x in enumerate(cross(unit, (d[0], d[1], d[2]))):
            whole[3 + i][k] += sign * x
    kept = range(2, 5) if size == 3 else range(6)
    return [[whole[i][j] for j in kept] for i in kept]


def _gram(a: list[list[Fraction]]) -> list[list[Fraction]]:
    columns = list(zip(*a, strict=True))
    return [
        [sum((x * y for x, y in zip(p, q, strict=True)), Fraction(0)) for q in columns]
        for p in columns
    ]


@pytest.mark.parametrize(("seed", "space"), EVERY)
def test_the_unit_of_length_is_no_matter_with_a_length_for_a_radian(
    seed: int, space: Space
) -> None:
    """Everything larger, and the length that counts as one radian with it."""
    drawn, _ = measured(seed, space)
    mechanism, factor = drawn.mechanism, Fraction(1000)
    x, y, z = UNITS
    unit = Similarity.drawn(random.Random(seed), space)
    larger = replace(unit, rotation=(x, y, z), shift=(Fraction(0),) * 3, scale=factor)
    scaled = replace(
        mechanism,
        joints=tuple(larger.of_joint(joint) for joint in mechanism.joints),
        reference_point=written(larger.moved(read(mechanism.reference_point))),
    )
    length = Fraction(3, 2)
    one = manipulability(Network(mechanism), length=Number(length))
    other = manipulability(Network(scaled), length=Number(length * factor))
    assert one.partition.gamma == other.partition.gamma
    assert np.allclose(one.kinematic.finite, other.kinematic.finite, rtol=1e-7)
    assert np.allclose(one.force.finite, other.force.finite, rtol=1e-7)
    inside = one.internal_force, other.internal_force
    assert np.allclose(inside[0].finite, inside[1].finite, rtol=1e-7)
    assert (one.kinematic.infinite, one.kinematic.zero) == (
        other.kinematic.infinite,
        other.kinematic.zero,
    )


FINGER = """screwkit: 1
name: finger
space: planar
geometry: posture
base: palm
platform: object
links: [palm, l1, l2, l3, g, object]
actuated: [{actuated}]
joints:
{joints}
"""
LOOP = {
    "a": "type: revolute, parent: palm, child: l1, point: [0, 0]",
    "b": "type: revolute, parent: palm, child: l2, point: [1, 0]",
    "c": "type: revolute, parent: l1, child: l3, point: [0, 2]",
    "d": "type: revolute, parent: l2, child: l3, point: [3/2, 2]",
    "e": "type: revolute, parent: palm, child: g, point: [4, 0]",
    "ca": "type: hard_finger, parent: l3, child: object, point: [1, 4]",
    "cb": "type: line, parent: g, child: object, point: [3, 3], normal: [-1, 0]",
}


def fingers(
    folder: Path, order: str, actuated: str, weights: str = ""
) -> Manipulability:
    """A finger that is a four-bar linkage, and one link, hold an object."""
    names = [*order, "ca", "cb"]
    joints = "\n".join(f"  - {{name: {name}, {LOOP[name]}}}" for name in names)
    path = folder / "finger.yaml"
    text = FINGER.format(actuated=actuated, joints=joints) + weights
    path.write_text(text, encoding="utf-8")
    return sk.manipulability(sk.load(path))


@pytest.mark.parametrize("order", ["abcde", "abdce", "dcbae", "ecabd"])
def test_which_joint_closes_a_loop_is_no_matter(tmp_path: Path, order: str) -> None:
    """Contact forces are those on the object; loads of joints inside a limb are not.

    In balance are (λ, 0) at ca, (-λ, 0) and the moment λ at cb: |f|² = 3 λ².  The
    coupler turns about (0, -4) a third as fast as its cranks, and ca is 8 above: the
    cranks need 8/3 λ together, and e, from which the force is 3 away, 4 λ.
    """
    one = fingers(tmp_path, order, "a, e").internal_force
    assert one.finite == pytest.approx([3 / ((8 / 3) ** 2 + 4**2)], rel=1e-12)
    assert (one.zero, one.infinite, one.polynomial) == (0, 0, "x - 27/208")
    # Two cranks share the torque, or press against each other with none at the tips.
    two = fingers(tmp_path, order, "a, b, e").internal_force
    assert two.finite == pytest.approx([3 / (2 * (4 / 3) ** 2 + 4**2)], rel=1e-12)
    assert (two.zero, two.infinite, two.polynomial) == (1, 0, "x - 27/176")
    assert np.allclose(np.abs(two.zero_directions), [[0.5**0.5, 0.5**0.5, 0]])


@pytest.mark.parametrize("order", ["abcde", "dcbae"])
def test_weights_of_contact_forces_leave_loops_out(tmp_path: Path, order: str) -> None:
    weights = "weights: {contact_forces: [2, 9, 9, 3, 9, 5]}\n"
    index = fingers(tmp_path, order, "a, e", weights).internal_force
    assert index.finite == pytest.approx([(2 + 3 + 5) / (64 / 9 + 16)], rel=1e-12)
    assert index.polynomial == "x - 45/104"


@pytest.mark.parametrize(
    "normal", ["[0, 0, 1]", "[2, -1, 2]", "[1, 1, 0]", "[3, 1, -2]"]
)
def test_planar_joints_slide_in_orthogonal_directions(
    tmp_path: Path, normal: str
) -> None:
    """About its point the joint turns the object once and slides it both ways alike."""
    path = tmp_path / "table.yaml"
    path.write_text(
        "screwkit: 1\nname: table\ngeometry: posture\nbase: ground\nplatform: plate\n"
        "links: [ground, carriage, plate]\nreference_point: [1, 2, 3]\njoints:\n"
        "  - {name: E, type: planar, parent: ground, child: carriage, point: [1, 2, 3],"
        f" normal: {normal}}}\n"
        "  - {name: g, type: complete, parent: carriage, child: plate, "
        "point: [0, 0, 0]}\n"
        "actuated: [E:0, E:1, E:2]\n",
        encoding="utf-8",
    )
    index = sk.manipulability(sk.load(path)).kinematic
    assert index.finite == pytest.approx([1, 1, 1], rel=1e-12)
