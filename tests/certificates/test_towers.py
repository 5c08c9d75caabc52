"""Conditions that are met one after the other, or together: lies about these."""

from __future__ import annotations

import random
from dataclasses import replace
from typing import Any

import pytest
from certificates.forged import (
    HELICAL,
    IN_LINE,
    IN_PLANE,
    ONE_HEIGHT,
    POSITIVE,
    TWO_LENGTHS,
    helical,
    judged,
    limb,
    minor,
    solved,
    zero,
)

from screwkit.case import load_text
from screwkit.certificates.coefficients import Coefficients
from screwkit.certificates.equations_told import Multiple, Step, Unsolved
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Case, Locus, Node, Part, Reach
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError, read
from screwkit.certificates.towers import Towers

ONE, TWO, _ = IN_PLANE


def sheet(number: int) -> Node:
    return Node(number, sheet=True)


def together(case: Case, second: str = "x3", equation: str = TWO) -> Node:
    """The first two equations, linear in x2 and x3 together."""
    beside = Unsolved(equation, symbol=second)
    return Node(
        0,
        sheet=True,
        roots=(Unsolved(ONE, symbol="x2", together=(beside,)),),
        cases=(case,),
    )


# The determinant is y1².  At y1 = 0 two equations say y2·x1 = 0 = y3·x1.
AT_Y1 = solved(
    2,
    0,
    zero("x1", sheet(3)),
    zero("y2", solved(4, 1, zero("x1", Node(5, small=True)), zero("y3", sheet(6)))),
)
NO_SOLUTION = Case(
    ("y1^2",),
    1,
    kept=Node(
        1, condition=3, over={}, cases=(Case(("y1",), 2, sheets=(zero("y1", AT_Y1),)),)
    ),
)


def test_equations_that_are_linear_together_are_met_at_once() -> None:
    found = judged(HELICAL, helical(*IN_PLANE, cover=together(NO_SOLUTION)))
    assert not found.sampled_components


@pytest.mark.parametrize(
    ("cover", "why"),
    [
        (together(replace(NO_SOLUTION, equations=("y1",))), "other coefficients"),
        (together(replace(NO_SOLUTION, equations=())), "other coefficients"),
        (together(NO_SOLUTION, "y3"), "other coefficients"),
        (together(NO_SOLUTION, "y1"), "linear in symbols together"),
        (together(NO_SOLUTION, "nowhere"), "no symbol"),
        (together(NO_SOLUTION, "x2"), "cases of their own"),
        (together(NO_SOLUTION, equation="x3"), "its conditions"),
        (replace(together(NO_SOLUTION), cases=()), "cases of their own"),
        (together(replace(NO_SOLUTION, kept=Node(1, small=True))), "may be a sheet"),
    ],
)
def test_nothing_else_is_met_at_once(cover: Node, why: str) -> None:
    with pytest.raises(RefusedError, match=why):
        judged(HELICAL, helical(*IN_PLANE, cover=cover))


def test_a_component_without_an_equation_is_refused_there_too() -> None:
    """At x1 = y1 = 0 two of the three equations hold, and nothing is singular."""
    forged = replace(
        NO_SOLUTION, kept=replace(NO_SOLUTION.kept or sheet(1), condition=2)
    )
    with pytest.raises(RefusedError, match="as in general"):
        judged(HELICAL, helical(ONE, TWO, cover=together(forged)))


def test_too_few_conditions_show_nothing() -> None:
    """Where the first equation alone holds nothing is singular."""
    alone = Node(
        0,
        sheet=True,
        roots=(Unsolved(ONE, symbol="x2"),),
        cases=(Case(("y1", "-y2*x1"), 1, kept=sheet(1)),),
    )
    found = judged(HELICAL, helical(*IN_PLANE, cover=alone))
    assert found.sampled_components == (IN_PLANE,)


def test_a_tree_rests_on_components_that_were_met_before_alone() -> None:
    multiples = tuple(Multiple(k, 2 - k, "1", {}) for k in range(3))
    behind = Node(0, component=0, multiples=multiples)
    whole = helical(*IN_PLANE, cover=together(NO_SOLUTION))
    (first,) = whole.components
    second = replace(first, equations=IN_PLANE[::-1], cover=behind)
    found = judged(HELICAL, replace(whole, components=(first, second)))
    assert not found.sampled_components
    unseen = replace(first, cover=None)
    for components in ((unseen, second), (second, first), (second,)):
        with pytest.raises(RefusedError, match="says nothing about"):
            judged(HELICAL, replace(whole, components=components))
    false = replace(behind, multiples=multiples[:2])
    with pytest.raises(RefusedError, match="does not vanish"):
        judged(
            HELICAL, replace(whole, components=(first, replace(second, cover=false)))
        )


# -- in a proof ------------------------------------------------------------------------


def kept(text: str, coefficient: Case, *roots: Unsolved) -> Node:
    """A minor with a case that is met at all of its roots."""
    own = roots or (Unsolved(text, angle=0),)
    there = Node(1, sheet=True, roots=own, cases=(coefficient,))
    return minor(POSITIVE, Case((text,), 1, kept=there))


NUMBER = Case(("1",), 1, end="positive")
TIED = Case(("a - b",), 1, end="special")


@pytest.mark.parametrize(
    "proof", [kept("a*sin(q) - b*sin(q)", TIED), kept("(a - b)*sin(q)", TIED)]
)
def test_conditions_whose_sheets_lie_on_components_are_an_end(proof: Node) -> None:
    judged(TWO_LENGTHS, limb(IN_LINE, proof=proof))


@pytest.mark.parametrize(
    ("part", "why"),
    [
        (limb(proof=kept("(a - b)*sin(q)", TIED)), "on no component"),
        (limb(IN_LINE, proof=kept("(a - b)*sin(q)", NUMBER)), "other coefficients"),
        (
            limb(IN_LINE, proof=kept("(a - b)*sin(q)", replace(TIED, end="positive"))),
            "may vanish",
        ),
        (
            limb(
                IN_LINE,
                proof=kept("(a - b)*sin(q)", NUMBER, Unsolved("sin(q)", angle=0)),
            ),
            "its conditions",
        ),
    ],
)
def test_other_sheets_are_no_end(part: Part, why: str) -> None:
    with pytest.raises(RefusedError, match=why):
        judged(TWO_LENGTHS, part)


def test_no_root_of_a_condition_is_left_out() -> None:
    """5·sin q = 3 at (4/5, 3/5), which is listed, and at (−4/5, 3/5)."""
    there = Reach((Step("angle", angle=0, sine="3/5", cosine="4/5"),))
    right = Locus(("5*sin(q) - 3", "5*cos(q) - 4"), 2, -1, (there,))
    both = Locus(("5*sin(q) - 3",), 2, -1, (there,))
    proof = kept("5*sin(q) - 3", Case(("5",), 1, end="positive"))
    judged(ONE_HEIGHT, limb(both, proof=proof))
    for seed in range(8):
        with pytest.raises(RefusedError, match="on no component"):
            judged(ONE_HEIGHT, limb(right, proof=proof), seed)


# -- coefficients ----------------------------------------------------------------------


def drawn() -> tuple[Postures, Coefficients]:
    postures = Postures(load_text(TWO_LENGTHS).mechanism, limb(), random.Random(3))
    return postures, Coefficients(postures, random.Random(4))


@pytest.mark.parametrize(
    ("own", "wanted"),
    [
        (Unsolved("a^2*b - c", symbol="a", degree=2), ("-c", "0", "b")),
        (Unsolved("a*b - c", symbol="a", degree=2), ("-c", "b")),
        (Unsolved("sin(q)^2", angle=0, degree=2), ("1", "0", "-1", "0", "0")),
        (
            Unsolved("a*cos(q)*sin(q) + b*sin(q)", angle=0, degree=2),
            ("0", "0", "0", "b", "a"),
        ),
    ],
)
def test_coefficients_are_those_of_powers(
    own: Unsolved, wanted: tuple[str, ...]
) -> None:
    postures, coefficients = drawn()
    point = postures.another()
    found = coefficients.of(own, point, Way())
    assert [*found] == [point.value(read(text)) for text in wanted]


@pytest.mark.parametrize(
    "own",
    [
        Unsolved("a^2*b - c", symbol="a"),
        Unsolved("sin(q)^2", angle=0),
        Unsolved("a", symbol="a", degree=0),
        Unsolved("a", symbol="a", degree=9),
        Unsolved("a", symbol="nowhere"),
        Unsolved("a", angle=3),
    ],
)
def test_other_degrees_and_unknowns_are_refused(own: Unsolved) -> None:
    postures, coefficients = drawn()
    with pytest.raises(RefusedError):
        coefficients.of(own, postures.another(), Way())


def test_all_roots_of_conditions_of_higher_degree_are_met() -> None:
    """a² = b, and then b·cos²q = c: four postures up to the signs of sines."""
    postures, coefficients = drawn()
    sheets = Sheets(postures, random.Random(5))
    towers = Towers(postures, sheets, coefficients)
    roots = (
        Unsolved("a^2 - b", symbol="a", degree=2),
        Unsolved("a*cos(q)^2 - c", angle=0, degree=2),
    )
    seen: list[Any] = []

    def found(_: Any, there: Any) -> int:
        seen.append(there.value(read("a")))
        return int(all(there.value(read(own.equation)) == 0 for own in roots))

    values = towers.on(
        Way(conditions=tuple(own.equation for own in roots)), roots, found
    )
    assert all(values)
    assert len({int(a) for a in seen}) == 2
