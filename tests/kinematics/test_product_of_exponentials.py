"""Bodies of ``reference`` files against scipy's matrix exponential and differences."""

from __future__ import annotations

import random
from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from kinematics.random_mechanisms import (
    chain,
    mechanism_of,
    random_joint,
    rescaled,
    turned_round,
    written,
)
from numpy.typing import NDArray
from scipy.linalg import expm

from screwkit.algebra.batch import BatchRing
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Number
from screwkit.algebra.modular import ModularRing, prime_for
from screwkit.algebra.survey import SurveyRing
from screwkit.kinematics.freedoms import JointTwist, freedom_twists
from screwkit.kinematics.loops import ring_at
from screwkit.kinematics.placement import joint_twists
from screwkit.kinematics.product_of_exponentials import (
    exponential,
    placed_by_variables,
)
from screwkit.mechanism.joints import freedom_labels, is_actuable
from screwkit.mechanism.model import Joint, JointType, Mechanism, VectorExpression
from screwkit.screw.displacement import Displacement

Array = NDArray[np.float64]
MOVING = tuple(kind for kind in JointType if is_actuable(kind))
laws = settings(max_examples=40, derandomize=True)
chains = st.builds(
    chain,
    st.lists(st.sampled_from([*MOVING, JointType.FIXED]), min_size=1, max_size=5),
    st.integers(0, 2**20),
)
seeds = st.integers(0, 2**20)


def as_reference(mechanism: Mechanism) -> Mechanism:
    return replace(mechanism, geometry="reference")


def angles(mechanism: Mechanism, seed: int) -> dict[str, float]:
    source = np.random.default_rng(seed)
    return {name: float(source.uniform(-3, 3)) for name in mechanism.joint_variables}


def floats(vector: VectorExpression | None) -> Array:
    if vector is None:
        return np.zeros(3)
    ring = BatchRing({})
    return np.array([float(evaluate(part, ring)) for part in vector])


def unit(vector: Array) -> Array:
    return vector / float(np.linalg.norm(vector))


def hat(turning: Array, sliding: Array) -> Array:
    """A twist as a 4×4 matrix."""
    x, y, z = turning
    matrix = np.zeros((4, 4))
    matrix[:3, :3] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    matrix[:3, 3] = sliding
    return matrix


def generators(joint: Joint, tangents: Array) -> list[Array]:
    """The 4×4 twists of a joint's freedoms per unit of their variables.

    Args:
        joint: At joint variables 0.
        tangents: Directions in which a planar joint slides: any two will do, but the
            variables belong to those that the module chose.
    """
    point = floats(joint.point)
    axes = [unit(floats(axis)) for axis in joint.axes]

    def turn(axis: Array, pitch: float = 0.0) -> Array:
        return hat(axis, np.cross(point, axis) + pitch * axis)

    def slide(axis: Array) -> Array:
        return hat(np.zeros(3), axis)

    match joint.type:
        case JointType.REVOLUTE | JointType.UNIVERSAL:
            return [turn(axis) for axis in axes]
        case JointType.PRISMATIC:
            return [slide(axes[0])]
        case JointType.HELICAL:
            assert isinstance(joint.pitch, Number)
            return [turn(axes[0], float(joint.pitch.value))]
        case JointType.CYLINDRICAL:
            return [turn(axes[0]), slide(axes[0])]
        case JointType.SPHERICAL:
            return [turn(axis) for axis in np.eye(3)]
        case JointType.PLANAR:
            return [turn(unit(floats(joint.normal))), *map(slide, tangents)]
        case _:
            return []


def step(mechanism: Mechanism, joint: Joint, values: Mapping[str, float]) -> Array:
    """Parent-from-child as a product of scipy's exponentials."""
    at_rest = dict.fromkeys(mechanism.joint_variables, 0.0)
    still = joint_twists(
        mechanism_of([joint], [joint.parent, joint.child]), BatchRing(at_rest), ""
    )
    labels = freedom_labels(joint)
    sliding = [matrix_row(still[label])[3:] for label in labels[1:]]
    matrix = np.eye(4)
    # Sliding directions count per unit of the file's length, as written or not.
    tangents = np.array([unit(s) if joint.type is JointType.PLANAR else s
                         for s in sliding])  # fmt: skip
    for name, generator in zip(
        joint.variables, generators(joint, tangents), strict=True
    ):
        matrix = matrix @ expm(values[name] * generator)
    return matrix


def matrix_row(twist: JointTwist[Array]) -> Array:
    return np.array([float(x) for x in twist.coordinates])


def as_matrix(displacement: Displacement[Array]) -> Array:
    matrix = np.eye(4)
    matrix[:3, :3] = [[float(x) for x in row] for row in displacement.rotation]
    matrix[:3, 3] = [float(x) for x in displacement.translation]
    return matrix


def placed(mechanism: Mechanism, values: Mapping[str, float]) -> dict[str, Array]:
    found, _ = placed_by_variables(mechanism, ring_at(mechanism, values))
    return {link: as_matrix(where) for link, where in found.items()}


@laws
@given(chains, seeds)
def test_chains_are_products_of_exponentials(system: Mechanism, seed: int) -> None:
    """All joint types; joints passed backwards are inverses."""
    mechanism, values = as_reference(system), angles(system, seed)
    found = placed(mechanism, values)
    at = np.eye(4)
    for joint, (before, after) in zip(
        mechanism.joints, pairwise(mechanism.links), strict=True
    ):
        matrix = step(mechanism, joint, values)
        at = at @ (matrix if joint.parent == before else np.linalg.inv(matrix))
        np.testing.assert_allclose(found[after], at, atol=1e-9)


@laws
@given(chains)
def test_nothing_moves_at_zero(system: Mechanism) -> None:
    """Bodies at the identity, twists where ``posture`` files have them."""
    mechanism = as_reference(system)
    ring = BatchRing(dict.fromkeys(mechanism.joint_variables, 0.0))
    bodies, twists = placed_by_variables(mechanism, ring)
    for where in bodies.values():
        np.testing.assert_allclose(as_matrix(where), np.eye(4), atol=1e-12)
    for label, twist in joint_twists(system, ring, "").items():
        np.testing.assert_allclose(
            matrix_row(twists[label]), matrix_row(twist), atol=1e-12
        )


def per_unit(joint: Joint, freedom: int, twist: JointTwist[Array]) -> Array:
    """A twist per unit of its variable; axes count with unit length."""
    row = matrix_row(twist)
    length = np.linalg.norm(row[:3])
    return row / (length if length > 1e-9 else np.linalg.norm(row[3:]))


@laws
@given(chains, seeds)
def test_rates_of_bodies_are_the_twists(system: Mechanism, seed: int) -> None:
    """Central differences of the last body: dT/dq T⁻¹ is the joint's twist, signed."""
    mechanism, values = as_reference(system), angles(system, seed)
    last, small = mechanism.links[-1], 1e-6
    here = placed(mechanism, values)[last]
    _, twists = placed_by_variables(mechanism, ring_at(mechanism, values))
    links = mechanism.links
    for joint in mechanism.joints:
        forwards = links.index(joint.parent) < links.index(joint.child)
        for k, name in enumerate(joint.variables):
            ahead = placed(mechanism, {**values, name: values[name] + small})[last]
            behind = placed(mechanism, {**values, name: values[name] - small})[last]
            rate = (ahead - behind) / (2 * small) @ np.linalg.inv(here)
            label = freedom_labels(joint)[k]
            twist = per_unit(joint, k, twists[label]) * (1 if forwards else -1)
            np.testing.assert_allclose(
                rate, hat(twist[:3], twist[3:]), atol=1e-6, rtol=1e-6
            )


@laws
@given(chains, seeds)
def test_lengths_of_axes_move_nothing(system: Mechanism, seed: int) -> None:
    """Other lengths move no body; the negative of an axis reverses its variable."""
    source = random.Random(seed)
    values = angles(system, seed)
    longer = [rescaled(joint, source) for joint in system.joints]
    other = replace(as_reference(system), joints=tuple(longer))
    turned = dict(values)
    for before, after in zip(system.joints, longer, strict=True):
        for k, name in enumerate(before.variables):
            if sense(before, after, k) < 0:
                turned[name] = -values[name]
    mine, theirs = placed(as_reference(system), values), placed(other, turned)
    for link in system.links:
        np.testing.assert_allclose(theirs[link], mine[link], atol=1e-9)


def sense(before: Joint, after: Joint, freedom: int) -> float:
    """Whether an axis points the same way in both."""
    if before.type is JointType.PLANAR:
        if freedom == 2:  # n x (e x n), the same for -n
            return 1.0
        return float(floats(before.normal) @ floats(after.normal))
    if not before.axes:
        return 1.0
    number = freedom if before.type is JointType.UNIVERSAL else 0
    return float(floats(before.axes[number]) @ floats(after.axes[number]))


@pytest.mark.parametrize("kind", MOVING)
def test_exchanging_the_bodies_inverts_the_motion(kind: JointType) -> None:
    for seed in range(4):
        joint = random_joint(random.Random(seed), kind, ("a", "b"))
        links = ["a", "b"]
        forwards = as_reference(mechanism_of([joint], links))
        backwards = as_reference(mechanism_of([turned_round(joint)], links))
        values = angles(forwards, seed)
        there, back = placed(forwards, values)["b"], placed(backwards, values)["b"]
        np.testing.assert_allclose(there @ back, np.eye(4), atol=1e-9)


def tree(seed: int) -> Mechanism:
    """Joints of a random tree, in any order and sense, with a loose tree beside it."""
    source = random.Random(seed)
    links = [f"b{i}" for i in range(7)]
    joints = []
    for i in range(1, 7):
        if i == 5:
            continue  # b5 and what hangs on it are connected with nothing else
        before = links[source.randrange(i)] if i < 5 else "b5"
        ends = (before, links[i]) if source.random() < 0.5 else (links[i], before)
        joints.append(random_joint(source, source.choice(MOVING), ends, f"j{i}"))
    source.shuffle(joints)
    return as_reference(mechanism_of(joints, links))


@pytest.mark.parametrize("seed", range(12))
def test_trees_place_every_body_by_its_neighbour(seed: int) -> None:
    mechanism = tree(seed)
    values = angles(mechanism, seed)
    found = placed(mechanism, values)
    assert set(found) == set(mechanism.links)
    np.testing.assert_array_equal(found["b0"], np.eye(4))
    np.testing.assert_array_equal(found["b5"], np.eye(4))
    for joint in mechanism.joints:
        wanted = found[joint.parent] @ step(mechanism, joint, values)
        np.testing.assert_allclose(found[joint.child], wanted, atol=1e-9)


def test_a_screw_advances_by_its_pitch_per_radian() -> None:
    """Half a turn at pitch 2 about an axis of length 5: forward by 2π, right-handed."""
    screw = Joint(
        "h",
        JointType.HELICAL,
        "a",
        "b",
        ("q",),
        axes=(written((0, 0, 5)),),
        point=written((1, 0, 0)),
        pitch=Number(Fraction(2)),
    )
    mechanism = as_reference(mechanism_of([screw], ["a", "b"]))
    where = placed(mechanism, {"q": np.pi})["b"]
    np.testing.assert_allclose(where @ [0, 0, 0, 1], [2, 0, 2 * np.pi, 1], atol=1e-12)
    quarter = placed(mechanism, {"q": np.pi / 2})["b"]
    np.testing.assert_allclose(quarter @ [2, 0, 0, 1], [1, 1, np.pi, 1], atol=1e-12)


def test_many_postures_at_once() -> None:
    """The same formulas over arrays."""
    mechanism = as_reference(chain([JointType.REVOLUTE, JointType.UNIVERSAL], 3))
    source = np.random.default_rng(1)
    batch = {n: source.uniform(-3, 3, 8) for n in mechanism.joint_variables}
    together, _ = placed_by_variables(mechanism, BatchRing(batch))
    last = mechanism.links[-1]
    for number in range(8):
        alone = placed(mechanism, {n: float(v[number]) for n, v in batch.items()})
        at = together[last].translation
        found = [float(np.broadcast_to(x, 8)[number]) for x in at]
        np.testing.assert_allclose(found, alone[last][:3, 3], atol=1e-12)


@pytest.mark.parametrize(
    ("normal", "freedom"),
    [
        ((0, 0, 3), 1),
        ((0, 0, 3), 2),
        ((0, 3, 4), 2),
        ((1, 1, 1), 1),
        ((1, 1, 1), 2),
        ((1, -2, 0), 1),
    ],
)
def test_planar_joints_slide_by_their_variables_modulo_a_prime(
    normal: tuple[int, int, int], freedom: int
) -> None:
    """The length of a shift is the variable's, in exact rings as in floats."""
    joint = Joint(
        "e",
        JointType.PLANAR,
        "a",
        "b",
        ("q0", "q1", "q2"),
        normal=written(normal),
        point=written((0, 0, 0)),
    )
    seen = SurveyRing()
    twists = freedom_twists(joint, seen)
    exponential(twists[freedom], joint, seen)
    radicands = [r.value for r in seen.roots if isinstance(r, Number)]
    field = ConstantField.needed_by([*radicands, *map(Fraction, (2, 3, 5))], seen.turn)
    prime = prime_for(seen.turn, list(map(Fraction, (2, 3, 5))), 1)
    ring = ModularRing(1, prime, field)
    twist = freedom_twists(joint, ring)[freedom]
    shift = exponential(twist, joint, ring).translation
    square = shift[0] * shift[0] + shift[1] * shift[1] + shift[2] * shift[2]
    amount = ring.symbol(joint.variables[freedom])
    assert square == amount * amount
