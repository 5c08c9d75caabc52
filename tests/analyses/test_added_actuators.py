"""Redundant actuation: against loci of larger schemes and mobility at posed values."""

from __future__ import annotations

from functools import cache
from itertools import combinations

import pytest

import screwkit as sk
from screwkit.analyses.added_actuators import FreedomAt, Place
from screwkit.delivery import only_balanced
from screwkit.reports.article import article
from screwkit.reports.records import from_json, to_json
from screwkit.results.mobility import Mobility
from screwkit.results.schemes import Redundancy
from screwkit.results.undecided import Undecided


@cache
def added(name: str, actuated: tuple[str, ...] = ()) -> Redundancy:
    case = sk.load(name, actuated=list(actuated) or None)
    found = sk.schemes(case, work=0, add=True).redundancy
    assert isinstance(found, Redundancy)
    return found


def test_one_added_joint_removes_what_leaves_the_common_factor() -> None:
    """A component of codimension 1 stays exactly if its equation divides all minors.

    The locus of the five joints together is that common factor: minors of the loop
    matrix, where the answer uses ranks at points.
    """
    found = added("nao_t14")
    equations = [component.equations for component in found.components]
    assert all(len(e) == 1 for e in equations)
    loci = {
        frozenset(s.actuated): set(s.locus) - set(s.idle)
        for s in sk.schemes(sk.load("nao_t14"), size=5).schemes
        if s.admissible and set(found.actuated) <= set(s.actuated)
    }
    assert len(found.single) == len(loci) == 6
    kept = 0
    for one in found.single:
        locus = loci[frozenset((*found.actuated, *one.actuators))]
        for (equation,), left in zip(equations, one.freedoms, strict=True):
            assert (left > 0) is (equation in locus), (one.actuators, equation)
            kept += left > 0
    assert kept == 1  # so that both answers occur


def freedom_at(name: str, actuated: tuple[str, ...], at: dict[str, str]) -> int:
    """By mobility, which knows graphs and no schemes."""
    case = sk.load(name, actuated=list(actuated), set_values=at)
    answer = sk.mobility(case)
    assert isinstance(answer, Mobility)
    assert answer.actuation is not None
    return answer.actuation.remaining_platform_freedom


def test_pairs_are_those_that_hold_the_platform_at_a_posture_of_the_component() -> None:
    found = added("3upu_tsai")
    flat, round_ = found.components
    assert flat.equations == ("z",)
    assert (flat.platform_freedom, round_.platform_freedom) == (2, 1)
    assert found.pairs_asked
    assert not any(one.suffices for one in found.single)
    listed = {one.actuators for one in found.pairs}
    names = [one.actuators[0] for one in found.single]
    every = list(combinations(names, 2))
    assert 0 < len(listed) < len(every)
    at = {"x": "7/10", "y": "-2/5", "z": "0"}
    for one in found.single[::6]:
        left = freedom_at("3upu_tsai", (*found.actuated, *one.actuators), at)
        assert left == one.freedoms[0] == 1
    for pair in every[::13]:
        left = freedom_at("3upu_tsai", (*found.actuated, *pair), at)
        assert (left == 0) is (pair in listed), pair


def test_an_inadmissible_scheme_is_mended() -> None:
    """All wrenches meet the line through the wrist centres; see the paper, §5.2.2."""
    found = added("nao_t14", ("1", "2", "6", "7"))
    assert not found.admissible
    (everywhere,) = found.components
    assert (everywhere.equations, everywhere.platform_freedom) == ((), 1)
    answer = sk.schemes(sk.load("nao_t14"), size=5, work=0)
    admissible = {s.actuated for s in answer.schemes if s.admissible}
    for one in found.single:
        scheme = tuple(sorted((*found.actuated, *one.actuators), key=int))
        assert one.suffices is (scheme in admissible)


def test_a_scheme_that_never_fails_needs_none() -> None:
    found = added("tripteron")
    assert (found.admissible, found.components, found.single) == (True, (), ())
    text = str(sk.schemes(sk.load("tripteron"), work=0, add=True))
    assert "the platform never moves: none is needed" in text


def test_without_a_scheme_it_says_what_to_give() -> None:
    answer = sk.schemes(sk.load("bennett", actuated=[]), add=True)
    assert isinstance(answer.redundancy, Undecided)
    assert "--actuated" in answer.redundancy.reason


def test_candidates_bound_what_is_added() -> None:
    case = sk.load("nao_t14")
    names = ["1", "2", "3", "7", "9", "10"]
    answer = sk.schemes(case, candidates=names, work=0, add=True)
    assert isinstance(answer.redundancy, Redundancy)
    assert [one.actuators for one in answer.redundancy.single] == [("9",), ("10",)]


def test_text_and_document() -> None:
    answer = sk.schemes(sk.load("nao_t14"), work=0, add=True)
    assert from_json(to_json(answer)) == answer
    assert only_balanced(answer).redundancy == answer.redundancy
    text = " ".join(str(answer).split())
    assert "with 1 2 3 7 locked the platform can move where one of these holds" in text
    assert "holds 1 q6 = q1 (mod π)" in text
    assert "4 5 8 9 10 stops it on each" in text
    assert "6 stops it on 1, 2; leaves 1 freedom on 3" in text


@pytest.mark.parametrize("name", ["five_bar"])
def test_the_report_has_it(name: str) -> None:
    text = repr(article(sk.analyze(sk.load(name), add=True)))
    assert "Added actuators" in text
    assert "Where the platform moves with A E locked" in text
    assert "Added actuators" not in repr(article(sk.analyze(sk.load(name))))


def test_what_moves_at_one_point_of_a_sheet_is_not_removed() -> None:
    """A sheet may have parts that no factor showed: a joint may hold one of them."""
    component = added("3upu_tsai").components[0]

    def held_by(joint: str) -> FreedomAt:
        return lambda locked: 0 if joint in locked else 1

    place = Place(component, [[held_by("A"), held_by("B")], [held_by("A")]])
    assert place.freedom(["A"]) == 1
    assert place.freedom(["A", "B"]) == 0
