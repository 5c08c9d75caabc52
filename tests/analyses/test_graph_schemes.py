"""Schemes of joint graphs: why they fail and what is added, against loops in floats."""

from __future__ import annotations

import re
from functools import cache

import numpy as np
import pytest
from kinematics.float_loops import null_vectors
from loci.numeric import Array, value
from loci.test_graph_loci import exactly_on
from loci.test_hybrid_loci import At, at, drawn, freedom
from loci.test_tied_loci import FIVE_BAR, FOUR_BAR

import screwkit as sk
from screwkit.algebra.expression import Expression
from screwkit.algebra.text import expression_text
from screwkit.case import load_text
from screwkit.results.schemes import Ranking, Redundancy, Refusal, Schemes
from screwkit.results.undecided import Undecided

ARM = "palletizer_scara"


@cache
def refusals(size: int) -> tuple[Refusal, ...]:
    return sk.schemes(sk.load(ARM), size=size, work=0).refusals


def number_of(expression: Expression | None) -> float:
    assert expression is not None
    return value(expression_text(expression), {})


def left(*locked: str, seed: int = 2) -> int:
    """The platform's freedom in floats."""
    return freedom(at(ARM, drawn(ARM, seed)).platform(locked))


def test_pairs_that_hold_the_same_do_so_in_floats() -> None:
    same = r"actuators (\w+) and (\w+) hold the same freedom: .* keeps 2T1R"
    found = [re.fullmatch(same, r.reason) for r in refusals(4)]
    pairs = [match.groups() for match in found if match]
    assert len(pairs) > 10
    whole = left()
    for one, other in pairs:
        assert left(one) == left(other) == left(one, other) == whole - 1 == 3


def test_every_inadmissible_scheme_has_a_reason_of_its_own_kind() -> None:
    answer = sk.schemes(sk.load(ARM), work=0)
    assert sum(r.schemes for r in answer.refusals) == answer.total - answer.admissible
    for refusal in answer.refusals:
        assert left(*refusal.example) > 0
        assert not re.match("the platform keeps 1 freedom$", refusal.reason)


@pytest.mark.parametrize("axis", ["T", "W"])
def test_the_axis_that_is_left_is_the_screw_that_is_left(axis: str) -> None:
    """The wrist can turn the tool, the turret the whole arm: in floats one twist."""
    text = f"the platform can turn about axis {axis}: every wrench meets it"
    (one,) = [r for r in refusals(4) if r.reason == text]
    here = at(ARM, drawn(ARM, 3))
    moving = here.platform(one.example)
    assert freedom(moving) == 1
    both = np.column_stack([moving, here.twists[axis]])
    assert freedom(both) == 1


def test_joints_that_move_are_those_of_the_null_vector() -> None:
    """Five locked: a translation, and the joints whose rates do not vanish."""
    found = [r for r in refusals(5) if "can translate" in r.reason]
    assert len(found) == 3
    for one in found:
        rates = null_vectors(at(ARM, drawn(ARM, 4)).loop_matrix(one.example))
        assert rates.shape[1] == 1
        joints = [joint.name for joint in sk.load(ARM).mechanism.joints]
        labels = [name for name in joints if name not in one.example]
        moving = [
            label
            for label, rate in zip(labels, rates[:, 0], strict=True)
            if abs(rate) > 1e-9
        ]
        named = re.search("joints (.*) and (\\d+) more move", one.reason)
        assert named
        names = named[1].split(", ")
        assert names == moving[: len(names)]
        assert int(named[2]) == len(moving) - len(names)


@cache
def added(name: str, *actuated: str) -> Redundancy:
    case = sk.load(name, actuated=list(actuated) or None)
    found = sk.schemes(case, work=0, add=True).redundancy
    assert isinstance(found, Redundancy)
    return found


@pytest.mark.parametrize("name", [ARM, "peaucellier"])
def test_what_is_added_holds_the_platform_at_postures_of_the_components(
    name: str,
) -> None:
    found = added(name)
    assert found.components
    for number, component in enumerate(found.components):
        here = at(name, exactly_on(name, component, number + 3))
        assert freedom(here.platform(found.actuated)) == component.platform_freedom
        for one in (*found.single, *found.pairs):
            locked = (*found.actuated, *one.actuators)
            assert freedom(here.platform(locked)) == one.freedoms[number], locked


def test_a_pair_is_found_where_no_single_joint_suffices() -> None:
    found = added("peaucellier")
    assert found.pairs_asked
    assert not any(one.suffices for one in found.single)
    first = at("peaucellier", exactly_on("peaucellier", found.components[0], 9))
    second = at("peaucellier", exactly_on("peaucellier", found.components[1], 9))
    listed = {one.actuators for one in found.pairs}
    names = [one.actuators[0] for one in found.single]
    for i, one in enumerate(names):
        for other in names[i + 1 :]:
            locked = (*found.actuated, one, other)
            held = not freedom(first.platform(locked))
            held = held and not freedom(second.platform(locked))
            assert held is ((one, other) in listed)


def test_an_inadmissible_scheme_of_a_graph_is_mended() -> None:
    found = added(ARM, "W", "O1", "t0", "T")
    assert not found.admissible
    (everywhere,) = found.components
    assert everywhere.geometry
    assert "O1 and t0 hold the same freedom" in everywhere.geometry
    for one in found.single:
        assert left(*found.actuated, *one.actuators) == one.freedoms[0]
    assert {one.suffices for one in found.single} == {True, False}


@pytest.mark.parametrize("text", [FOUR_BAR, FIVE_BAR])
def test_any_second_reading_holds_a_linkage_at_its_dead_points(text: str) -> None:
    """A dead linkage turns about all three other pivots: each of them holds it."""
    case = load_text(text)
    answer: Schemes = sk.schemes(case, work=0, add=True)
    found = answer.redundancy
    assert isinstance(found, Redundancy)
    (component,) = found.components
    assert component.platform_freedom == 1
    free = set("12345" if text is FIVE_BAR else "1234") - set(found.actuated)
    assert {one.actuators[0] for one in found.single if one.suffices} == free


def test_a_graph_without_actuators_says_so() -> None:
    case = sk.load("generic_k33", actuated=[])
    found = sk.schemes(case, size=0, work=0, add=True).redundancy
    assert isinstance(found, Undecided)
    assert "declares no actuated joint" in found.reason


def conditioning(here: At, actuated: tuple[str, ...]) -> float:
    """Of the map from rates of unit axes to the platform's twist: least over largest.

    The twist follows from the rates, where the other way round a scheme is read off the
    twist; slides are measured, like all lengths, in units of the size.
    """
    mechanism = here.mechanism
    labels = [joint.name for joint in mechanism.joints]
    rates = null_vectors(here.loop_matrix())
    twists = here.platform()
    read = []
    for label in actuated:
        twist = here.as_written[label]
        scale = np.linalg.norm(here.twists[label])
        turns = np.linalg.norm(twist[:3])
        unit = turns if np.any(twist[:3]) else np.linalg.norm(twist[3:]) / here.size
        read.append(rates[labels.index(label)] / scale * unit)
    given: Array = twists @ np.linalg.pinv(np.array(read), rcond=1e-10)
    sizes = np.linalg.svd(given, compute_uv=False)[: len(actuated)]
    return float(sizes[-1] / sizes[0])


@pytest.mark.parametrize(
    ("name", "candidates"),
    [
        (ARM, ["W", "O1", "O2", "c", "u0", "T"]),
        ("orthoglide", ["P1", "P2", "P3", "Rb2"]),  # limbs with parallelograms
    ],
)
def test_schemes_are_ranked_as_their_maps_are_in_floats(
    name: str, candidates: list[str]
) -> None:
    case = sk.load(name)
    declared = {p.name: number_of(p.value) for p in case.mechanism.parameters}
    posture = {
        p.name: declared[p.name] + 0.07 * number
        for number, p in enumerate(case.mechanism.parameters)
        if p.free
    }
    here = at(name, {**declared, **posture})
    found = sk.schemes(
        case,
        work=0,
        candidates=candidates,
        rank=1,
        within=[f"{symbol}={x!r}:{x!r}" for symbol, x in posture.items()],
        length=repr(here.size),
    ).ranking
    assert isinstance(found, Ranking)
    assert len(found.schemes) > 2
    for one in found.schemes:
        wanted = conditioning(here, one.actuated)
        assert one.median == one.worst == pytest.approx(wanted, rel=1e-7)


def test_one_freedom_is_always_even() -> None:
    found = sk.schemes(sk.load("peaucellier"), work=0, rank=5).ranking
    assert isinstance(found, Ranking)
    assert {round(one.worst, 12) for one in found.schemes} == {1.0}


def test_loops_that_tie_joint_variables_are_not_ranked() -> None:
    found = sk.schemes(load_text(FIVE_BAR), work=0, rank=5).ranking
    assert isinstance(found, Undecided)
    assert "no set of closed postures is drawn" in found.reason
