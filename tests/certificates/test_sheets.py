"""Conditions that are products: what holds on one of their sheets is not believed."""

from __future__ import annotations

import random
from dataclasses import replace
from fractions import Fraction
from itertools import islice
from typing import Any

import pytest
from certificates.forged import (
    HEAD,
    IN_LINE,
    ONE_HEIGHT,
    POSITIVE,
    TWO_LENGTHS,
    certificate,
    judged,
    limb,
    minor,
    turned,
)

from screwkit.algebra.all_roots import rank_at_roots
from screwkit.case import load_text
from screwkit.certificates.checking import check
from screwkit.certificates.equations_told import Step, Unsolved
from screwkit.certificates.findings import Findings
from screwkit.certificates.irreducible_equations import Shape, shape_of
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.real_postures import RealPostures
from screwkit.certificates.records import Case, Locus, Node, Part, Reach, Sheet, Side
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.texts import RefusedError, read


def test_a_locus_with_a_sheet_of_full_rank_is_refused() -> None:
    """Singular where sin q = 0, not where cos q = 0; postures of the former alone."""
    judged(TWO_LENGTHS, limb(IN_LINE))
    larger = replace(IN_LINE, equations=("sin(q)*cos(q)",))
    with pytest.raises(RefusedError, match="as in general"):
        judged(TWO_LENGTHS, limb(larger))


def test_a_sheet_in_an_extension_of_the_numbers_is_met_too() -> None:
    """3·cos²q = 2 has no rational root, and modulo half of the primes none at all."""
    larger = replace(IN_LINE, equations=("sin(q)*(3*cos(q)^2 - 2)",))
    for seed in range(12):
        with pytest.raises(RefusedError, match="as in general"):
            judged(TWO_LENGTHS, limb(larger), seed)


def test_dimensions_tied_on_one_sheet_alone_are_no_end() -> None:
    """(a − b)·sin q = 0: a = b ties the dimensions, sin q = 0 does not."""
    honest = minor(
        POSITIVE,
        Case(("a - b",), 1, end="special"),
        Case(
            ("sin(q)",),
            1,
            sheets=(
                Sheet(turned("0", "1"), Node(1, component=0)),
                Sheet(turned("0", "-1"), Node(2, component=0)),
            ),
        ),
    )
    judged(TWO_LENGTHS, limb(IN_LINE, proof=honest))
    product = "(a - b)*sin(q)"
    roots = (Unsolved(product, symbol="a"),)
    hidden = minor(
        POSITIVE, Case((product,), 1, kept=Node(1, special=True, roots=roots))
    )
    with pytest.raises(RefusedError, match="free"):
        judged(TWO_LENGTHS, limb(proof=hidden))


# Joints 1 and 2 of one limb at 0 and (x, 0), joint 3 of the other at (a, b): the
# determinant is x·b.  Where x = 0 the first limb idles; where b = 0 the platform
# turns about (a, 0).
TWO_LIMBS = """
screwkit: 1
name: forged
space: planar
base: ground
platform: tip
links: [ground, arm, tip]
geometry: posture
parameters: {a: {value: 1, positive: true}}
variables: {x: 1, b: 2}
joints:
  - {name: "1", type: revolute, parent: ground, child: arm, point: [0, 0]}
  - {name: "2", type: revolute, parent: arm, child: tip, point: [x, 0]}
  - {name: "3", type: revolute, parent: ground, child: tip, point: [a, b]}
"""


def two_limbs(proof: Node, *components: Locus) -> Part:
    return Part("actuation", "ground", (), 3, components, proof=proof)


def test_a_platform_still_on_one_sheet_alone_may_move() -> None:
    smaller = Node(
        1,
        rank=2,
        rows=(2, 4),
        columns=("1", "3"),
        over={},
        cases=(Case(("a",), 1, end="positive"),),
        roots=(Unsolved("x", symbol="x"),),
    )
    moves = Locus(
        ("b",), 2, 1, (Reach((Step("symbol", symbol="b", value="0", over="1"),)),)
    )
    at_b = Step("symbol", symbol="b", value="0", over="1")
    honest = minor(
        Case(("x",), 1, kept=smaller),
        Case(("b",), 1, sheets=(Sheet(at_b, Node(2, component=0)),)),
    )
    judged(TWO_LIMBS, two_limbs(honest, moves))
    hidden = replace(smaller, roots=(Unsolved("x*b", symbol="x"),))
    with pytest.raises(RefusedError, match="moves"):
        judged(TWO_LIMBS, two_limbs(minor(Case(("x*b",), 1, kept=hidden))))


def test_both_solutions_in_numbers_are_looked_at() -> None:
    there = Reach((turned("3/5", "4/5"),))
    right = Locus(("5*sin(q) - 3", "5*cos(q) - 4"), 2, -1, (there,))
    step = Step("numbers", angle=0, numbers=("5", "0", "-3"))
    proof = minor(
        POSITIVE,
        Case(("5*sin(q) - 3",), 1, sheets=(Sheet(step, Node(1, component=0)),)),
    )
    for seed in range(40):
        with pytest.raises(RefusedError, match="vanish"):
            judged(ONE_HEIGHT, limb(right, proof=proof), seed)


# -- how sheets are met --------------------------------------------------------------


def postures(text: str = TWO_LENGTHS) -> Postures:
    return Postures(load_text(text).mechanism, limb(), random.Random(3))


@pytest.mark.parametrize(
    ("text", "factors"),
    [
        ("(a - b)*sin(q)", ("a - b", "sin(q)")),
        ("(a^2 - 2)*(c - 1)", ("a^2 - 2", "c - 1")),
        ("(a*b - c)*(1 + cos(q))*(a - 3*b)^2", ("a*b - c", "1 + cos(q)", "a - 3*b")),
        ("(a^3 - b)*(cos(q)^2 - 2*a*sin(q))", ("a^3 - b", "cos(q)^2 - 2*a*sin(q)")),
    ],
)
def test_every_factor_is_met(text: str, factors: tuple[str, ...]) -> None:
    """On each sheet that is drawn the product vanishes, and each factor on some."""
    drawn = Sheets(postures(), random.Random(4)).on(
        Way(),
        text,
        lambda _, there: (
            there.value(read(text)) == 0,
            # A value that is 0 at some of the roots alone is not asked for: it splits.
            tuple(rank_of_one(there.value(read(f))) for f in factors),
        ),
    )
    assert all(vanishes for vanishes, _ in drawn)
    for number in range(len(factors)):
        assert any(own[number] == 0 for _, own in drawn)


def rank_of_one(value: Any) -> int:
    return rank_at_roots([[value]], postures().prime)


def test_changes_are_those_of_the_solution_in_numbers() -> None:
    """With cos q = 3/5 the change of a·cos q with a is 3/5."""
    drawer = postures()
    way = Way((Step("numbers", angle=0, numbers=("0", "5", "-3")),))
    for point in islice(drawer.drawn_before(way), 3):
        changes = [row[0] for row in drawer.changes(point, way, ["a*cos(q)"])]
        assert [x for x in changes if x != 0] == [point.rational(Fraction(3, 5))]


# -- what is seen besides ------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "shape"),
    [
        ("a*b - c", Shape.IRREDUCIBLE),
        ("sin(q)", Shape.IRREDUCIBLE),  # no product of polynomials in sin q and cos q
        ("a*sin(q) + cos(q) - b", Shape.IRREDUCIBLE),
        ("4*(a - b)^2 - c^2 - 1", Shape.IRREDUCIBLE),
        ("a^4 - 2*b^2*a^2 + c", Shape.IRREDUCIBLE),
        ("a*sin(q)", Shape.PRODUCT),
        ("(a*b - c)*(a^2 + 1)", Shape.PRODUCT),
        ("(a*b - c)*(a + b + c)", Shape.UNKNOWN),
        ("(a*b - c)^2", Shape.UNKNOWN),
        ("(a*sin(q) - b)*(b*cos(q) - a)", Shape.UNKNOWN),
    ],
)
def test_products_are_not_called_irreducible(text: str, shape: Shape) -> None:
    assert shape_of(Sheets(postures(), random.Random(5)), text) is shape


def test_a_component_that_is_a_product_is_refused() -> None:
    """Both sin q = 0 and a = b are singular: two components, not one."""
    one = replace(IN_LINE, equations=("(a - b)*sin(q)",))
    with pytest.raises(RefusedError, match="product"):
        judged(TWO_LENGTHS, limb(one))


def side(tangent: str, **symbols: str) -> Side:
    return Side((tangent,), {"a": "1", "b": "2", "c": "1"} | symbols)


def findings(locus: Locus) -> Findings:
    (found,) = check(
        certificate(TWO_LENGTHS, limb(locus)), load_text(TWO_LENGTHS).mechanism, 1
    )
    return found


def test_real_postures_lie_between_two_signs_or_are_solved() -> None:
    solved = replace(IN_LINE, sides=(side("1/3"),))
    between = replace(IN_LINE, sides=(side("1/3"), side("-1/3")))
    assert findings(IN_LINE) == Findings(irreducible=(("sin(q)",),))
    assert findings(solved).real == findings(between).real == (("sin(q)",),)


@pytest.mark.parametrize(
    ("sides", "why"),
    [
        ((side("1/3"), side("2/3")), "both signs"),
        ((side("0"), side("2/3")), "both signs"),
        ((side("1/3"), side("-1/3", c="-1")), "cannot be"),
        ((Side((), {"a": "1", "b": "2", "c": "1"}),), "lacks"),
        ((Side(("1",), {"a": "1"}),), "lacks"),
        ((side("1/3"),) * 3, "fit"),
    ],
)
def test_false_real_postures_are_refused(sides: tuple[Side, ...], why: str) -> None:
    with pytest.raises(RefusedError, match=why):
        judged(TWO_LENGTHS, limb(replace(IN_LINE, sides=sides)))


def test_a_real_posture_needs_real_solutions() -> None:
    """5·sin q = 7 has none, 5·sin q = 3 has two."""
    real = RealPostures({"q": {0: 1}}, 1, (), (), ())
    for c, is_real in (("-3", True), ("-7", False)):
        step = Step("numbers", angle=0, numbers=("5", "0", c))
        locus = Locus(("x",), 0, -1, (Reach((step,)),), sides=(Side(("1",), {}),))
        if is_real:
            assert real.shown(locus)
        else:
            with pytest.raises(RefusedError, match="none"):
                real.shown(locus)


# -- components of several equations ---------------------------------------------------

# Two conditions: joints 1 and 2 at one point (x, y) = 0.
AT_ONE_POINT = f"""{HEAD}
parameters: {{a: {{value: 1, positive: true}}}}
variables: {{x: 1, y: 2}}
joints:
  - {{name: "1", type: revolute, parent: ground, child: arm, point: [0, 0]}}
  - {{name: "2", type: revolute, parent: arm, child: fore, point: [x, y]}}
  - {{name: "3", type: revolute, parent: fore, child: tip, point: [2*x, 2*y]}}
"""


def at_zero(symbol: str) -> Step:
    return Step("symbol", symbol=symbol, value="0", over="1")


def case(text: str, step: Step, node: Node) -> Case:
    return Case((text,), 1, sheets=(Sheet(step, node),))


def test_all_sheets_of_several_equations_are_met_by_a_tree() -> None:
    """Rank 2 in general (in line), 1 where x = y = 0."""
    reach = Reach((at_zero("x"), at_zero("y")))
    leaf = Node(2, sheet=True)
    inner = Node(1, condition=1, cases=(case("y", at_zero("y"), leaf),))
    cover = Node(0, condition=0, cases=(case("x", at_zero("x"), inner),))
    right = Locus(("x", "y"), 1, -1, (reach,), cover)

    def part(locus: Locus) -> Part:
        return Part("limb", "ground", (), 2, (locus,), limb="limb_1")

    def found(locus: Locus) -> Findings:
        mechanism = load_text(AT_ONE_POINT).mechanism
        return check(certificate(AT_ONE_POINT, part(locus)), mechanism, 1)[0]

    def sampled(locus: Locus) -> tuple[tuple[str, ...], ...]:
        return found(locus).sampled_components

    def irreducible(locus: Locus) -> tuple[tuple[str, ...], ...]:
        return found(locus).irreducible

    assert not sampled(right)
    assert irreducible(right)
    assert sampled(replace(right, cover=None)) == (("x", "y"),)
    # x·(y − 1) = 0 = y·(x − 2) holds at (2, 1) too, where the rank is 2.
    apart = replace(right, equations=("x*(y - 1)", "y*(x - 2)"), cover=None)
    assert sampled(apart)
    first = Node(1, condition=1, cases=(case("y", at_zero("y"), leaf),))
    one = case("y - 1", replace(at_zero("y"), value="1"), Node(3, sheet=True))
    both = Node(0, condition=0, cases=(case("x", at_zero("x"), first), one))
    with pytest.raises(RefusedError, match="as in general"):
        judged(AT_ONE_POINT, part(replace(apart, cover=both)))
    # A case left out, and a leaf that stands for another component.
    for cover_of_less in (
        Node(0, condition=0, cases=(case("x", at_zero("x"), first),)),
        Node(0, component=0),
    ):
        with pytest.raises(RefusedError):
            judged(AT_ONE_POINT, part(replace(apart, cover=cover_of_less)))


def test_a_sheet_is_no_end_of_a_proof() -> None:
    with pytest.raises(RefusedError, match="nothing is said"):
        judged(TWO_LENGTHS, limb(IN_LINE, proof=Node(0, sheet=True)))


TURNED = """
screwkit: 1
name: turned
space: planar
geometry: posture
base: ground
platform: tip
links: [ground, tip]
variables: {x: 1, y: 2, phi: {value: 0.3, angle: true}}
pose: {translation: [x, y], rotation: {axis: z, angle: phi}}
points: {P: {link: tip, at: [1, 0]}}
joints:
  - {name: "1", type: revolute, parent: ground, child: tip, point: P}
"""


def test_what_an_angle_in_numbers_fixes_is_solved_after_it() -> None:
    """At sin φ = cos φ, y = cos φ and 2·x² = 2·sin φ·cos φ + 1, which is x² = 1."""
    part = Part("limb", "ground", ({"phi": 1},), 1, (), limb="limb_1")
    postures = Postures(load_text(TURNED).mechanism, part, random.Random(5))
    steps = (
        Step("numbers", angle=0, numbers=("1", "-1", "0")),
        Step("symbol", symbol="y", value="cos(phi)"),
    )
    root = Unsolved("2*x^2 - 2*cos(phi)*sin(phi) - 1", symbol="x", degree=2)
    for point in islice(postures.on(Way(steps), (root,)), 8):
        for text in ("sin(phi) - cos(phi)", "y - sin(phi)", "x^2 - 1"):
            assert point.value(read(text)) == 0
    before, there = next(postures.meeting(Way(steps), (root,)))
    assert before.value(read("2*cos(phi)^2 - 1")) == 0
    (changes,) = [
        row
        for row in postures.changes(before, Way(steps), ["x", "y"])
        if any(x != 0 for x in row)
    ]
    assert changes[1] == 0  # y is a number there
    assert there.value(read("x^2 - 1")) == 0
