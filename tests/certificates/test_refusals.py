"""Ways to cheat: quotients, scales, factors besides, and what is no equation."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest
from certificates.forged import (
    HELICAL,
    IN_PLANE,
    POSITIVE,
    TWO_LENGTHS,
    helical,
    judged,
    limb,
    met_in_turn,
    minor,
    solved,
    three_joints,
    zero,
)

import screwkit
from screwkit.case import load_text
from screwkit.certificates.checking import PartCheck, checked
from screwkit.certificates.equations_told import Multiple, Step, Unsolved
from screwkit.certificates.general_claims import GeneralClaims
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Case, Locus, Node, Reach, Sheet
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError
from screwkit.certificates.written import from_text


def kept(text: str, node: Node) -> Case:
    return Case((text,), 1, kept=node)


AT_B = Locus(
    ("a - b",), 2, -1, (Reach((Step("symbol", symbol="a", value="b", over="1"),)),)
)


def test_what_a_limb_does_not_say_of_the_platform_is_refused() -> None:
    """Of a limb the rank of its twists is looked at, and no freedom of a platform."""
    with pytest.raises(RefusedError, match="speaks of the platform"):
        judged(TWO_LENGTHS, limb(replace(AT_B, freedom=1)))


def test_a_quotient_makes_nothing_a_multiple() -> None:
    """(a − b) = ((a − b)/sin q)·sin q, which says nothing where sin q = 0."""
    leaf = Node(1, component=0, multiples=(Multiple(0, 0, "(a - b)/sin(q)", {}),))
    proof = minor(
        POSITIVE,
        Case(("a - b",), 1, end="special"),
        kept("sin(q)", leaf),
    )
    with pytest.raises(RefusedError, match="no polynomial"):
        judged(TWO_LENGTHS, limb(AT_B, proof=proof))


def test_a_quotient_makes_no_sum_that_vanishes_nowhere() -> None:
    """(1/sin q)·sin q = 1 has no case to be looked at."""
    none = Node(1, combination=(Multiple(-1, 0, "1/sin(q)", {}),))
    proof = minor(POSITIVE, Case(("a - b",), 1, end="special"), kept("sin(q)", none))
    for times in ("1/sin(q)", "sin(q)^-1", "tan(q)/sin(q)", "sqrt(a)"):
        one = replace(none, combination=(Multiple(-1, 0, times, {}),))
        forged = replace(proof, cases=(*proof.cases[:2], kept("sin(q)", one)))
        with pytest.raises(RefusedError, match="no polynomial"):
            judged(TWO_LENGTHS, limb(proof=forged))


def test_scales_do_not_vanish() -> None:
    """Twists times sin q vanish where sin q = 0, and their axes do not."""
    free = Node(1, axis="1", multiples=(Multiple(0, 0, "sin(q)", {}),))
    proof = minor(
        POSITIVE,
        Case(("a - b",), 1, end="special"),
        Case(("sin(q)",), 2, kept=free),
    )
    with pytest.raises(RefusedError, match="may vanish"):
        judged(TWO_LENGTHS, replace(limb(proof=proof), scales={"1": "sin(q)"}))


# det: c·x·(5·sin q − 3).
TWO_FACTORS = three_joints(
    "parameters: {c: {value: 1, positive: true}}\n"
    "variables: {q: {value: 0.3, angle: true}, x: 1}",
    "[c, 0]",
    "[cos(q), x*(5*sin(q) - 3)]",
)


@pytest.mark.parametrize("number", ["3", "7"])
def test_numbers_for_an_angle_leave_no_factor_out(number: str) -> None:
    """x·(5·sin q − 7) vanishes where x = 0, though 5·sin q = 7 has no solution."""
    text = f"x*(5*sin(q) - {number})"
    mechanism = TWO_FACTORS.replace("x*(5*sin(q) - 3)", text)
    numbers = ("5", "0", f"-{number}")
    step = Step("numbers", angle=0, numbers=numbers)
    locus = Locus((f"5*sin(q) - {number}",), 2, -1, (Reach((step,)),))
    case = Case((text,), 1, sheets=(Sheet(step, Node(1, component=0)),))
    ended = Case((text,), 1, end="unreal", numbers=numbers, angle=0)
    forged = (
        limb(locus, proof=minor(POSITIVE, case))
        if number == "3"
        else limb(proof=minor(POSITIVE, ended))
    )
    with pytest.raises(RefusedError, match="factor besides"):
        judged(mechanism, forged)


def test_lengths_that_are_not_zero_do_not_vanish_at_postures() -> None:
    """Two equations homogeneous in the lengths b, c > 0 are not met by b = c = 0.

    That would tie the lengths; where the determinant x² − 1 vanishes they are free.
    """
    first, second = "b*x - c", "b - c*x"
    mechanism = three_joints(
        "parameters: {b: {value: 1, positive: true}, c: {value: 1, positive: true}}\n"
        "variables: {q: {value: 0.3, angle: true}, x: 1}",
        f"[0, {first}]",
        f"[{second}, cos(q)]",
    )
    # The determinant of points 0, (0, b·x − c), (b − c·x, cos q).
    roots = (Unsolved(first, symbol="b", together=(Unsolved(second, symbol="c"),)),)
    postures = Postures(load_text(mechanism).mechanism, limb(), random.Random(2))
    claims = GeneralClaims(
        postures,
        ScrewMatrix(postures),
        Sheets(postures, random.Random(3)),
        ("b", "c"),
        ("b", "c"),
    )
    with pytest.raises(RefusedError, match="not 0 vanishes"):
        claims.special(Node(2, special=True, roots=roots), Way((), (first, second)))


def test_zero_is_no_equation_of_dimensions() -> None:
    """0² + sin²q vanishes for all dimensions."""
    pair = Case(("0", "sin(q)"), 2, end="special")
    proof = minor(
        Case(("c",), 2, end="positive"), Case(("a - b",), 2, end="special"), pair
    )
    with pytest.raises(RefusedError, match="dimensions alone"):
        judged(TWO_LENGTHS, limb(proof=replace(proof, cases=fixed(proof.cases))))


def fixed(cases: tuple[Case, ...]) -> tuple[Case, ...]:
    """Powers count squares where some case has two equations."""
    return tuple(replace(own, power=1) for own in cases)


PRODUCT = three_joints(
    "parameters: {a: {value: 1, positive: true}, c: {value: 1, positive: true}, b: 2}\n"
    "variables: {q: {value: 0.3, angle: true}, x: 1}",
    "[c, 0]",
    "[0, (a - c*x)*x*sin(q)]",
)


def test_where_a_length_vanishes_nothing_is() -> None:
    """On x = 0 the length a is c·x, by the step before: 0."""
    steps = (
        Step("symbol", symbol="a", value="c*x", over="1"),
        Step("symbol", symbol="x", value="0", over="1"),
    )
    check = part_check(PRODUCT)
    check._node(Node(0, vanishing="a"), Way(steps))
    for name, way, why in (
        ("b", Way((Step("symbol", symbol="b", value="0", over="1"),)), "may be 0"),
        ("x", Way(steps), "may be 0"),
        ("a", Way(steps[:1]), "not 0 on it"),
        ("c", Way(steps), "not 0 on it"),
    ):
        with pytest.raises(RefusedError, match=why):
            part_check(PRODUCT)._node(Node(0, vanishing=name), way)


def part_check(mechanism: str) -> PartCheck:
    return PartCheck(load_text(mechanism).mechanism, limb(), random.Random(2))


def sheet(number: int) -> Node:
    return Node(number, sheet=True)


# Where x2 and x3 are not determined: y1 = y2·x1 = 0, and y1 = y3·x1 = 0.  At
# x1 = y1 = 0 two equations say no more, and the other three points are anywhere.
FIRST = Case(
    ("y1", "-y2*x1"),
    1,
    kept=solved(
        1,
        -2,
        zero("y1", solved(2, 0, zero("x1", sheet(3)), zero("y2", sheet(4)))),
    ),
)
SECOND = Case(
    ("y1", "-y3*x1"),
    1,
    kept=solved(
        5,
        -2,
        zero("y1", solved(6, 1, zero("x1", sheet(7)), zero("y3", sheet(8)))),
    ),
)


def with_condition(case: Case, number: int) -> Case:
    """Its first condition has this number on the way."""
    assert case.kept is not None
    return replace(case, kept=replace(case.kept, condition=number))


def test_a_component_without_one_of_its_equations_is_refused() -> None:
    """Two of three 2×2 minors of a 2×3 matrix vanish where a column does, too."""
    cover = met_in_turn(with_condition(FIRST, 2), with_condition(SECOND, 2))
    with pytest.raises(RefusedError, match="as in general"):
        judged(HELICAL, helical(*IN_PLANE[:2], cover=cover))


def test_each_equation_of_a_true_component_is_needed() -> None:
    """Of points in a plane: the list that is found, and what is left without one."""
    found = screwkit.singularities(screwkit.load("4H_equal_pitch"), certificate=True)
    parts = from_text(str(found.certificate)).parts
    (locus,) = parts[2].components
    assert len(locus.equations) == len(IN_PLANE)
    mechanism = screwkit.load("4H_equal_pitch").mechanism
    assert not checked(mechanism, parts[2], "seed", parts).sampled_components
    part = replace(parts[2], proof=None)
    for equation in locus.equations:
        left = tuple(own for own in locus.equations if own != equation)
        forged = replace(locus, equations=left)
        with pytest.raises(RefusedError):
            judged(HELICAL, replace(part, components=(forged,)))


@pytest.mark.parametrize("left_out", range(3))
def test_equations_that_meet_unseen_are_refuted_or_not_certified(left_out: int) -> None:
    equations = [own for k, own in enumerate(IN_PLANE) if k != left_out]
    for cover in (None, sheet(0)):
        with pytest.raises(RefusedError, match="as in general"):
            judged(HELICAL, helical(*equations, cover=cover))
        found = judged(HELICAL, helical(*IN_PLANE, cover=cover))
        assert found.sampled_components == (IN_PLANE,)


def test_no_case_of_conditions_met_in_turn_is_left_out() -> None:
    """Nor ended by another coefficient, an unknown of both, or for its dimensions."""
    first, second = with_condition(FIRST, 2), with_condition(SECOND, 2)
    honest = met_in_turn(first, second)
    never = Case(("p",), 1, end="positive")
    one, two = honest.roots
    small = replace(first, kept=Node(1, small=True))
    for forged, why in (
        (met_in_turn(first), "cases of their own"),
        (met_in_turn(never, second), "other coefficients"),
        (met_in_turn(replace(first, equations=()), second), "other coefficients"),
        (replace(honest, roots=(one, one)), "cases of their own"),
        (replace(honest, roots=(replace(one, symbol="y1"), two)), "coefficients"),
        (replace(honest, roots=(one, replace(two, symbol="x1"))), "does not lack"),
        (replace(honest, roots=(replace(one, equation="x2"), two)), "its conditions"),
        (met_in_turn(small, second), "may be a sheet"),
    ):
        with pytest.raises(RefusedError, match=why):
            judged(HELICAL, helical(*IN_PLANE[:2], cover=forged))
    with pytest.raises(RefusedError, match="nothing about a proof"):
        judged(TWO_LENGTHS, limb(proof=Node(0, small=True)))
