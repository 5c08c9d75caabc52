"""Ways to cheat: quotients, scales, factors besides, and what is no equation."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest
from certificates.forged import (
    POSITIVE,
    TWO_LENGTHS,
    judged,
    limb,
    minor,
    three_joints,
)

from screwkit.case import load_text
from screwkit.certificates.checking import _PartCheck
from screwkit.certificates.general_claims import GeneralClaims
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import (
    Case,
    Locus,
    Multiple,
    Node,
    Reach,
    Sheet,
    Step,
    Unsolved,
)
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError


def kept(text: str, node: Node) -> Case:
    return Case((text,), 1, kept=node)


AT_B = Locus(
    ("a - b",), 2, -1, (Reach((Step("symbol", symbol="a", value="b", over="1"),)),)
)


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


def part_check(mechanism: str) -> _PartCheck:
    return _PartCheck(load_text(mechanism).mechanism, limb(), random.Random(2))
