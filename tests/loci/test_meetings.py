"""Where sets meet, in real postures alone."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.points import residue
from screwkit.algebra.real_point import real_point
from screwkit.algebra.search import Search
from screwkit.loci.lifting import with_sheets_together
from screwkit.loci.meetings import Meetings, recovered
from screwkit.loci.pieces import pieces_of


def _no_state(branch: Branch) -> None:
    """Nothing that tells sheets apart."""


@pytest.mark.parametrize(
    ("condition", "met"),
    [
        ("sqrt(2)*x*cos(q) - sqrt(3)", 0),  # cos q would be 1.22
        ("cos(q) + x*sin(q) - sqrt(3)", 0),  # and this at most the root of 2
        ("sqrt(2)*x*sin(q) - 1", 2),  # q = pi/4 and 3*pi/4
        ("cos(q) + x*sin(q) - 1", 2),  # q = 0 and q = pi/2
        ("x*y^2 + 3", 0),
        ("x*y^2 - 3", 1),
    ],
)
def test_what_complex_postures_alone_share_is_no_meeting(
    condition: str, met: int
) -> None:
    ring, (first, second) = in_one_ring(condition, "x - 1")
    root = Branch(ring, Assumptions(frozenset()))
    search = Search(FactorLibrary(ring))
    places = [recovered(root, [p], 1, search) for p in (first, second)]
    assert all(places)
    found = Meetings(search, [p for p in places if p], 5, 100, _no_state).up_to(2)
    assert len(found) == 2 + met


def test_sheets_that_lie_on_other_places_are_told_apart() -> None:
    """Of the four postures with cos p = sin q = 0 two have sin(p + q) = 1."""
    ring, equations = in_one_ring("cos(p)", "sin(q)", "sin(p + q) - 1")
    root = Branch(ring, Assumptions(frozenset()))
    search = Search(FactorLibrary(ring))
    places = [recovered(root, [e], 1, search) for e in equations]
    found = Meetings(search, [p for p in places if p], 5, 100, _no_state).up_to(3)
    met = [m for m in found if {0, 1} <= m.places]
    assert sorted(len(m.places) for m in met for _ in m.piece.branches) == [2, 2, 3, 3]
    for meeting in met:
        (alike,) = {
            residue(equations[2], *at) == 0
            for branch in meeting.piece.branches
            for at in branch.points
        }
        assert alike == (2 in meeting.places)


def test_sheets_of_two_states_are_told_apart() -> None:
    ring, (cosine, sine, telling) = in_one_ring("cos(p)", "sin(q)", "cos(q)")
    root = Branch(ring, Assumptions(frozenset()))
    search = Search(FactorLibrary(ring))
    places = [recovered(root, [e], 1, search) for e in (cosine, sine)]

    def sheet(branch: Branch) -> str:
        """Where q is 0 and where it is π something else holds."""
        return str(branch.value(telling))

    known = [p for p in places if p]
    found = Meetings(search, known, 5, 100, sheet).up_to(2)[2:]
    kinds = [{sheet(b) for b in m.piece.branches} for m in found]
    assert sorted(kinds, key=min) == [{"-1"}, {"1"}]


def test_sheets_put_together_are_all_there() -> None:
    """Where p = π/2, r − q is; where p = −π/2, r + q is: no half turn is added."""
    ring, (first, sine, *rest) = in_one_ring(
        "cos(p)", "sin(p)", "cos(r - q)", "cos(r + q)"
    )
    root = Branch(ring, Assumptions(frozenset()))
    every = [
        branch
        for sheet in restricted(root, first)
        for branch in restricted(sheet, rest[sheet.value(sine) == 1])
    ]
    own = every[::2]
    pieces = with_sheets_together(pieces_of(own), _no_state)
    on = [any(all(p.contains(*at) for at in b.points) for p in pieces) for b in every]
    assert on == [True, False, True, False]


def test_sets_leave_out_where_an_axis_is_zero() -> None:
    ring, (equation, length) = in_one_ring("sin(q)", "cos(q) + 1")
    root = Branch(ring, Assumptions(frozenset()))
    nowhere = replace(root, nonvanishing=(length,))
    search = Search(FactorLibrary(ring))
    both, one = (recovered(r, [equation], 1, search) for r in (root, nowhere))
    assert both is not None
    assert one is not None
    assert (len(both.branches), len(one.branches)) == (2, 1)


@pytest.mark.parametrize(
    ("condition", "turn"), [("cos(q) + 1", pi), ("3*sin(q) + 4*cos(q) - 5", 0.6435)]
)
def test_a_double_condition_has_a_real_point(condition: str, turn: float) -> None:
    ring, (equation,) = in_one_ring(condition)
    (branch,) = restricted(Branch(ring, Assumptions(frozenset())), equation)
    found = real_point(branch, {}, 1)
    assert found is not None
    assert abs(found.turns[0]) == pytest.approx(turn, abs=1e-4)
