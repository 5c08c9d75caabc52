"""Exact postures keep what holds between symbols and constants; placement of files."""

from __future__ import annotations

import random
from collections.abc import Iterable
from dataclasses import replace
from fractions import Fraction
from functools import cache

import pytest
from kinematics.random_mechanisms import (
    SPATIAL,
    chain,
    constraint_wrenches,
    mechanism_of,
    random_joint,
    reciprocal_row,
    turned_round,
    written,
)

from screwkit.algebra.parse import parse
from screwkit.case import load
from screwkit.errors import UndecidedError
from screwkit.kinematics.exact_postures import at_zero, exact_posture
from screwkit.kinematics.network import Network
from screwkit.kinematics.placement import why_tied
from screwkit.mechanism.model import (
    Joint,
    JointType,
    Mechanism,
    Parameter,
    VectorExpression,
)

NAMES = ("a", "b", "phi")


def vector(texts: Iterable[str]) -> VectorExpression:
    x, y, z = (parse(text, NAMES) for text in texts)
    return x, y, z


def hinge(name: str, ends: str, point: Iterable[str], axis: Iterable[str]) -> Joint:
    return Joint(
        name,
        JointType.REVOLUTE,
        ends[0],
        ends[1],
        (f"q{name}",),
        axes=(vector(axis),),
        point=vector(point),
    )


def mechanism(*joints: Joint) -> Mechanism:
    links = sorted({link for joint in joints for link in (joint.parent, joint.child)})
    made = mechanism_of(joints, links)
    return replace(made, parameters=tuple(Parameter(name) for name in NAMES))


@pytest.mark.parametrize("kind", SPATIAL)
def test_residues_are_reciprocal_to_the_constraints(kind: JointType) -> None:
    """Numbers modulo the prime: the tables of joints and contacts hold in it."""
    for seed in range(3):
        joint = random_joint(random.Random(seed), kind)
        posture = exact_posture(mechanism_of([joint], ["base", "body"]), seed)
        prime = posture.prime
        for wrench in constraint_wrenches(joint):
            form = [
                x.numerator * pow(x.denominator, -1, prime)
                for x in reciprocal_row(wrench, range(6))
            ]
            for twist in posture.twists.values():
                power = sum(x * y for x, y in zip(form, twist, strict=True))
                assert power % prime == 0


HIDDEN = [
    # The same line through the same point, written in two ways.
    (("sqrt(3)", "0", "0"), ("2*cos(pi/6)", "0", "0")),
    (("sqrt(12)", "a", "0"), ("2*sqrt(3)", "a", "0")),
    (("a*cos(phi)^2", "0", "0"), ("a - a*sin(phi)^2", "0", "0")),
    (("sin(2*phi)", "0", "0"), ("2*sin(phi)*cos(phi)", "0", "0")),
    (("sqrt(a^2 + b^2)^2", "0", "0"), ("a^2 + b^2", "0", "0")),
    (("(a^2 - b^2)/(a - b)", "0", "0"), ("a + b", "0", "0")),
    (("cos(pi/5)", "b", "0"), ("(1 + sqrt(5))/4", "b", "0")),
    (("sin(atan2(a, b))*sqrt(a^2 + b^2)", "0", "0"), ("a", "0", "0")),
]


@pytest.mark.parametrize(("one", "other"), HIDDEN, ids=[x[0] for x, _ in HIDDEN])
def test_lines_that_are_equal_by_an_identity(
    one: tuple[str, ...], other: tuple[str, ...]
) -> None:
    """Two hinges on one line turn together; 1 apart they lock each other."""
    axis = ("0", "0", "1")
    door = mechanism(hinge("x", "fd", one, axis), hinge("y", "fd", other, axis))
    assert [m.mobility for m in Network(door).motions] == [1, 1]
    apart = (f"{other[0]} + 1", *other[1:])
    shut = mechanism(hinge("x", "fd", one, axis), hinge("y", "fd", apart, axis))
    assert [m.mobility for m in Network(shut).motions] == [0, 0]


def test_symbols_are_generic() -> None:
    """Equal only at special values: a and b are independent."""
    axis = ("0", "0", "1")
    joints = (
        hinge("x", "fd", ("a", "0", "0"), axis),
        hinge("y", "fd", ("b", "0", "0"), axis),
    )
    assert [m.mobility for m in Network(mechanism(*joints)).motions] == [0, 0]


def test_the_same_seed_is_the_same_posture() -> None:
    bennett = load("bennett").mechanism
    one, same, other = (exact_posture(bennett, seed) for seed in (1, 1, 2))
    assert (one.prime, one.twists) == (same.prime, same.twists)
    assert one.prime != other.prime


def test_smaller_primes_may_be_asked_for() -> None:
    small = exact_posture(load("five_bar").mechanism, 1, bits=31)
    assert 2**29 < small.prime < 2**31
    assert all(0 <= x < small.prime for t in small.twists.values() for x in t)


def test_what_divides_by_zero_everywhere_is_undecided() -> None:
    point = ("1/(a*cos(phi)^2 + a*sin(phi)^2 - a)", "0", "0")
    with pytest.raises(UndecidedError, match="no exact posture"):
        exact_posture(mechanism(hinge("x", "fd", point, ("0", "0", "1"))), 1)


@cache
def parallelogram() -> Mechanism:
    """Four parallel hinges at the corners of a parallelogram, joint variables 0."""
    corners = {"x": ("fc", (0, 0)), "y": ("cg", (1, 2)), "z": ("fh", (4, 0))}
    corners["w"] = ("hg", (5, 2))
    joints = [
        replace(
            hinge(name, ends, ("0", "0", "0"), ("0", "0", "1")),
            point=written((*corner, 0)),
        )
        for name, (ends, corner) in corners.items()
    ]
    return replace(mechanism(*joints), geometry="reference", parameters=())


def test_loops_of_a_reference_file_tie_its_variables() -> None:
    """There the posture of the file is taken; open chains move freely."""
    closed = parallelogram()
    assert "loops tie" in why_tied(closed)
    assert Network(closed).motion.mobility == 1
    still = at_zero(closed)
    assert still.geometry == "posture"
    assert Network(still).motion.rank == Network(closed).motion.rank
    open_chain = replace(chain([JointType.REVOLUTE] * 4, 1), geometry="reference")
    assert why_tied(open_chain) == ""
    assert why_tied(still) == ""


@pytest.mark.parametrize("seed", range(6))
def test_open_chains_of_reference_files_are_generic(seed: int) -> None:
    """Twists at random joint variables: at least what they span at zero."""
    kinds = [JointType.REVOLUTE, JointType.UNIVERSAL, JointType.PRISMATIC]
    posture = chain([*kinds, JointType.REVOLUTE], seed)
    moving = replace(posture, geometry="reference")
    at_rest = len(Network(posture).motion.platform_twists)
    assert at_rest <= len(Network(moving).motion.platform_twists) <= 5


def test_arms_that_are_straight_at_zero_are_not_singular_elsewhere() -> None:
    """Three hinges in one plane in line: rank 3 once they bend."""
    axis = ("0", "0", "1")
    points = (("0", "0", "0"), ("1", "0", "0"), ("2", "0", "0"))
    joints = [
        hinge(name, ends, point, axis)
        for name, ends, point in zip("xyz", ("ab", "cb", "cd"), points, strict=True)
    ]
    straight = replace(mechanism(*joints), parameters=())
    assert len(Network(straight).motion.platform_twists) == 2
    bent = replace(straight, geometry="reference")
    assert len(Network(bent).motion.platform_twists) == 3
    back = replace(bent, joints=tuple(turned_round(j) for j in bent.joints))
    assert len(Network(back).motion.platform_twists) == 3


def test_rationals_of_many_digits_stay_exact() -> None:
    """Lines 10⁻⁴⁰ apart are two lines."""
    near = written((Fraction(1, 10**40), 0, 0))
    first = hinge("x", "fd", ("0", "0", "0"), ("0", "0", "1"))
    second = replace(hinge("y", "fd", ("0", "0", "0"), ("0", "0", "1")), point=near)
    assert Network(mechanism(first, second)).motion.mobility == 0
