"""Pieces that lie in others are left out, sheet by sheet."""

from __future__ import annotations

from dataclasses import replace

import pytest
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, restricted, without
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.elimination import steps_of
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.factors import factor
from screwkit.algebra.parse import parse
from screwkit.algebra.points import residue
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.search import Search, refined
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.case import load_text
from screwkit.kinematics.loop_state import LoopState
from screwkit.loci.actuation import _Scheme
from screwkit.loci.meetings import recovered
from screwkit.loci.pieces import (
    Piece,
    has_equations_of,
    pieces_of,
    without_contained,
)
from screwkit.questions import singularities


def pieces_where(*systems: list[str]) -> list[list[Piece]]:
    parsed = [[parse(text) for text in system] for system in systems]
    survey = SurveyRing()
    for system in parsed:
        for expression in system:
            evaluate(expression, survey)
    ring = TrigonometricRing(survey)
    root, library = Branch(ring, Assumptions(frozenset())), FactorLibrary(ring)
    found = []
    for system in parsed:
        equations = [ring.normal(evaluate(one, ring)) for one in system]
        zeros = common_zeros(root, equations, Search(library))
        assert zeros.complete
        found.append(pieces_of(zeros.branches))
    return found


def in_ring_of(text: str, number: str) -> tuple[TrigonometricRing, Polynomial]:
    """A polynomial in a ring that contains a number beside it."""
    ring, (polynomial, _) = in_one_ring(text, number)
    return ring, polynomial


def texts(pieces: list[Piece]) -> set[tuple[str, ...]]:
    return {
        tuple(equation_text(p.branches[0].ring, e) for e in p.equations) for p in pieces
    }


WHOLE = ("cos(q) + sin(q)", "x - y")


@pytest.mark.parametrize(
    ("systems", "wanted"),
    [
        # −π/4 and 3·π/4 are told apart by √2: one of them, of the same codimension.
        ([[*WHOLE], ["sqrt(2)*cos(q) - 1", "sqrt(2)*sin(q) + 1", "x - y"]], {WHOLE}),
        ([[*WHOLE], ["sqrt(2)*cos(q) + 1", "sqrt(2)*sin(q) - 1", "x - y"]], {WHOLE}),
        # One of two sheets lies inside, whichever it is; the other one stays.
        ([["cos(q) - 1"], ["sin(q)", "y"]], {("cos(q) - 1",), ("cos(q) + 1", "y")}),
        ([["cos(q) + 1"], ["sin(q)", "y"]], {("cos(q) + 1",), ("cos(q) - 1", "y")}),
        # Each sheet in another piece.
        (
            [["cos(q) + 1"], ["cos(q) - 1"], ["sin(q)", "y"]],
            {("cos(q) + 1",), ("cos(q) - 1",)},
        ),
        ([["cos(q) - 1", "z"], ["sin(q)", "z"]], {("sin(q)", "z")}),
    ],
)
def test_no_sheet_is_listed_twice_and_none_is_lost(
    systems: list[list[str]], wanted: set[tuple[str, ...]]
) -> None:
    groups = pieces_where(*systems)
    for ordered in (groups, groups[::-1]):
        kept = without_contained([piece for group in ordered for piece in group])
        assert texts(kept) == wanted


@pytest.mark.parametrize(
    ("condition", "root"),
    [("cos(q) + sin(q)", 2), ("2*cos(q) - 1", 3), ("3*sin(q) + cos(q) - 2", 6)],
)
def test_roots_of_the_ring_tell_sheets_apart(condition: str, root: int) -> None:
    """An angle that they give has sheets; elsewhere one branch speaks of both."""
    ring, equation = in_ring_of(condition, f"sqrt({root})")
    steps = steps_of(ring, Assumptions(frozenset()), equation)
    assert steps is not None
    assert len(steps) == 2
    (one, two) = (dict(step.images) for step in steps)
    assert one != two
    for step, other in (steps, steps[::-1]):
        gens = list(ring.context.gens())
        for place, image in step.images:
            gens[place] = image
        assert ring.normal(equation.compose(*gens)) == 0
        circle = sum(image**2 for _, image in step.images)
        assert ring.normal(circle) == 1
        own, opposite = step.sheet, other.sheet
        assert own is not None
        assert opposite is not None
        assert ring.normal(own.compose(*gens)) == 0
        assert ring.normal(opposite.compose(*gens)) != 0
    ring, equation = in_ring_of(condition, "sqrt(7)")
    both = steps_of(ring, Assumptions(frozenset()), equation)
    assert both is not None
    assert [step.sheet for step in both] == [None]


def test_half_angles_that_differ_by_a_half_turn_are_one_condition() -> None:
    """2·sin q·cos q − 1 = −(cos q − sin q)²; √2 makes t² + 2·t − 1 split."""
    ring, product = in_ring_of("2*sin(q)*cos(q) - 1", "sqrt(2)")
    ((part, multiplicity),) = factor(ring, product).factors
    assert multiplicity == 2
    assert equation_text(ring, part.polynomial) == "cos(q) - sin(q)"


MECHANISM = """
screwkit: 1
name: two_arms
title: Two arms whose first offset is an eighth of a turn
geometry: mdh
base: ground
platform: load
links: [ground, L00, L01, L10, L11, L12, load]
parameters:
  a: {value: "0.7", positive: true}
  b: {value: "0.7", positive: true}
  d: {value: "0.3", positive: true}
joints:
  - {name: A1, type: revolute, parent: ground, child: L00, mdh: {alpha: "0", d: "1/2"}}
  - {name: A2, type: prismatic, parent: L00, child: L01,
     mdh: {alpha: pi/2, d: b, r: a}}
  - {name: hold0, type: fixed, parent: L01, child: load}
  - {name: B1, type: revolute, parent: ground, child: L10,
     mdh: {alpha: -pi/2, r: "1"}, offset: pi/4}
  - {name: B2, type: revolute, parent: L10, child: L11, mdh: {alpha: -pi/2, d: d}}
  - {name: B3, type: revolute, parent: L11, child: L12, mdh: {alpha: pi/2}}
  - {name: hold1, type: fixed, parent: L12, child: load}
"""


def test_an_offset_of_an_eighth_of_a_turn_changes_no_list() -> None:
    """The same components as without it, turned: q becomes q + π/4."""
    turned = singularities(load_text(MECHANISM)).constraint
    plain = singularities(load_text(MECHANISM.replace(", offset: pi/4", ""))).constraint
    assert turned.complete
    assert plain.complete
    first = [c.equations[0] for c in turned.components]
    assert sorted(first) == ["cos(qB1) + sin(qB1)", "cos(qB1) - sin(qB1)", "cos(qB2)"]
    assert sorted(c.equations[0] for c in plain.components) == [
        "cos(qB1)",
        "cos(qB2)",
        "sin(qB1)",
    ]
    (meeting,) = [c for c in turned.components if "+" in c.equations[0]]
    assert meeting.solved[0] is not None
    assert set(meeting.solved[0].values) == {"-pi/4", "3*pi/4"}


def test_what_holds_already_is_imposed_once() -> None:
    """Isoglide4's equations of two limbs, one of them said twice as conditions are.

    Of a condition that was imposed twice both were lost when one was taken away.
    """
    one = "b*cos(p)*sin(s) - a*sin(s) - y*sin(s) - z*cos(s)"
    other = "cos(s)*sin(t)*cos(u) + sin(s)*cos(t)*sin(u)"
    ring, (first, second) = in_one_ring(one, other)
    root, search = Branch(ring, Assumptions(frozenset())), Search(FactorLibrary(ring))
    told = [first, second, second, first, second]
    piece = recovered(root, told, 2, search)
    assert piece is not None
    (branch,) = piece.branches
    assert list(branch.conditions) == [first, second]
    twice = restricted(restricted(root, second)[0], second)[0]
    assert list(twice.equations(())) == [second]
    left = without(twice, twice.pending[0])
    assert (len(left.pending), list(left.conditions)) == (1, [second])


def test_solved_conditions_say_what_a_piece_does() -> None:
    """Where x = y and z = u, x·z = y·u; a pending condition is known by its text."""
    product, cubic, inner = pieces_where(
        ["x*z - y*u"],
        ["x^3*t + y^3*s + x*y"],
        ["x - y", "z - u", "z^3*t^2 + s^3 + v^3 + 1"],
    )
    (branch,) = inner[0].branches
    assert branch.pending
    assert has_equations_of(branch, product[0])
    assert has_equations_of(branch, inner[0])
    assert not has_equations_of(branch, cubic[0])
    assert not has_equations_of(product[0].branches[0], inner[0])


def test_sheets_that_share_no_equations_are_pieces_of_their_own() -> None:
    """At p = 0 and π; cos p = 1 holds on one sheet, cos p = −1 on the other."""
    ring, (sine, *signs) = in_one_ring("sin(p)", "cos(p) - 1", "cos(p) + 1")
    search = Search(FactorLibrary(ring))
    sheets = common_zeros(Branch(ring, Assumptions()), [sine], search).branches
    assert [len(piece.branches) for piece in pieces_of(sheets)] == [2]
    told = [
        replace(b, extra=tuple(e for e in signs if not residue(e, *b.points[0])))
        for b in sheets
    ]
    pieces = pieces_of(told)
    assert len(pieces) == 2
    for piece in pieces:
        (branch,) = piece.branches
        assert not any(residue(e, *branch.points[0]) for e in piece.equations)


def test_what_moves_is_kept_where_equations_of_idle_limbs_say_too_much() -> None:
    """Equations that were not solved may hold on a part of another set too."""
    ring, (one, two, *origin) = in_one_ring(
        "x^3 + y^3 - x*y", "u^3 + v^3 - u*v", "x", "y", "u", "v"
    )
    root, library = Branch(ring, Assumptions()), FactorLibrary(ring)
    (rest,) = common_zeros(root, origin, Search(library)).branches
    (line,) = common_zeros(root, origin[:2], Search(library)).branches
    zeros = common_zeros(root, [one, two], Search(library)).branches
    idle = [p for p in pieces_of(zeros) if p.codimension == 2 and not p.is_exact]
    assert idle
    moving = Piece(tuple(origin), (rest,))

    def state(piece: Piece) -> LoopState:
        return LoopState((int(piece.codimension == 4),), 0, 1)

    scheme = _Scheme(root, library, (), state)
    branches = [*idle[0].branches, rest]
    (found,) = scheme._moving_outside(branches, idle)
    assert found.texts == moving.texts
    exact = Piece(tuple(origin[:2]), (line,))
    assert scheme._moving_outside([line, rest], [exact]) == []


def test_what_later_steps_leave_of_a_condition_is_asked_for_its_real_zeros() -> None:
    """With cos p·cos q = −1 where x = 0, p and q are 0 and π, one each."""
    ring, (condition, x, *sines) = in_one_ring(
        "x^3*y + x*y^3 + x*y + cos(p)*cos(q) + 1", "x", "sin(p)", "sin(q)"
    )
    search = Search(FactorLibrary(ring))
    (whole,) = restricted(Branch(ring, Assumptions()), condition)
    assert whole.pending
    (branch,) = restricted(whole, x)
    parts = refined(branch, search)
    assert parts
    for part in parts:
        assert part.codimension == 3
        assert not any(residue(e, *at) for e in sines for at in part.points)
