"""Rules of certificates: sums of conditions, roots together, angles in numbers."""

from __future__ import annotations

import random
from itertools import islice

import pytest

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, Pending
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.linear_systems import has_solutions, linear_systems
from screwkit.algebra.parse import parse
from screwkit.algebra.points import residue
from screwkit.algebra.sums_of_conditions import (
    Combination,
    equal_leads,
    made_a_sum,
    sums_by_elimination,
)
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.case import load_text
from screwkit.certificates.checking import PartCheck
from screwkit.certificates.conditions import (
    Conditions,
    Place,
    Problem,
    with_conditions,
)
from screwkit.certificates.equations_told import Multiple, Step, Unsolved
from screwkit.certificates.minor_choice import Matrix
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Case, Locus, Node, Part, Reach
from screwkit.certificates.roots import roots_of
from screwkit.certificates.signs import Signs
from screwkit.certificates.solutions import Solutions
from screwkit.certificates.sums import paired_equation
from screwkit.certificates.texts import RefusedError, read

ARM = """
screwkit: 1
name: arm
base: ground
platform: tip
links: [ground, arm, tip]
geometry: posture
variables:
  q: {value: 0.3, angle: true}
  x: 1
  y: 2
  z: 3
joints:
  - {name: "1", type: revolute, parent: ground, child: arm, axis: [0, 0, 1],
     point: [x, y, z]}
  - {name: "2", type: revolute, parent: arm, child: tip, axis: [0, 0, 1],
     point: [cos(q), sin(q), 0]}
"""


def polynomials(*texts: str) -> tuple[TrigonometricRing, list[Polynomial]]:
    seen = SurveyRing()
    for text in texts:
        evaluate(parse(text), seen)
    ring = TrigonometricRing(seen)
    return ring, [ring.normal(evaluate(parse(text), ring)) for text in texts]


def arm() -> Postures:
    part = Part("limb", "ground", ({"q": 1},), 2, (), limb="limb_1")
    return Postures(load_text(ARM).mechanism, part, random.Random(3))


def is_sum(
    ring: TrigonometricRing, found: Combination, conditions: list[Polynomial]
) -> bool:
    total = sum(
        (t * c for t, c in zip(found.times, conditions, strict=True)), ring.zero
    )
    return bool(ring.normal(total) == found.value)


def test_elimination_shows_that_three_conics_do_not_meet() -> None:
    """Two of them imply 4uv = √3 between them, the third says 4uv = −√3."""
    ring, conditions = polynomials(
        "u^2 + 2*sqrt(3)*u*v - v^2 - 1",
        "3*u^2 - 2*sqrt(3)*u*v - 3*v^2 + 3",
        "4*u*v + sqrt(3)",
    )
    found = [*sums_by_elimination(ring, conditions, 0)]
    assert any(own.value.is_constant() for own in found)
    found += [*equal_leads(ring, conditions)]
    found += [*sums_by_elimination(ring, conditions, 1)]
    assert all(own.value != 0 and is_sum(ring, own, conditions) for own in found)


def test_a_minor_times_an_entry_is_a_sum_of_the_other_minors() -> None:
    """x·(w u − y v) = w·(x u − z v) − v·(x y − z w): Plücker's relation."""
    ring, (first, second, third) = polynomials("x*y - z*w", "x*u - z*v", "w*u - y*v")
    found = made_a_sum(ring, third, [first, second], lambda value: True)
    assert found is not None
    assert is_sum(ring, found, [first, second])
    assert divmod(found.value, third)[1] == 0
    # Where every leading coefficient vanishes nothing follows.
    assert made_a_sum(ring, third, [first, second], lambda value: False) is None


def test_conditions_linear_in_three_symbols_are_met_together() -> None:
    texts = (
        "x + 2*y*cos(q) + z - 1",
        "x*sin(q) - y + 3*z",
        "x - y*cos(q)^3 + z*sin(q) + 5",
    )
    ring, conditions = polynomials(*texts)
    (system,) = roots_of(ring, conditions)
    assert {u.symbol for u in (system, *system.together)} == {"x", "y", "z"}
    for point in islice(arm().on(Way(), (system,)), 4):
        assert all(point.value(read(text)) == 0 for text in texts)


def test_only_the_steps_that_bear_on_an_expression_are_followed() -> None:
    """Whatever the others do, the value is the same."""
    postures = arm()
    x = Step("symbol", symbol="x", value="2*y")
    y = Step("symbol", symbol="y", value="z + 1")
    turn = Step(
        "angle", symbol="x", angle=0, sine="0", cosine="1"
    )  # its name says nothing
    way = Way((x, y, turn))
    assert postures.bearing_on("x", way).steps == (x, y)
    assert postures.bearing_on("y + z", way).steps == (y,)
    assert postures.bearing_on("z", way).steps == ()
    assert postures.bearing_on("z*sin(q)", way).steps == (turn,)
    for text in ("x", "y + z", "z*sin(q)", "x*cos(q) - y"):
        own = postures.bearing_on(text, way)
        for before in postures.several_before(way):
            there = (postures.moved(before, known) for known in (own, way))
            first, second = (point.value(read(text)) for point in there)
            assert first == second
    numbers = Way((Step("numbers", angle=0, numbers=("1", "0", "0")), y))
    assert postures.bearing_on("z", numbers) == numbers


def test_only_symbols_are_solved_for_together() -> None:
    system = Unsolved(
        "x + sin(q)", symbol="x", together=(Unsolved("x - cos(q)", angle=0),)
    )
    with pytest.raises(RefusedError, match="no symbol"):
        next(arm().on(Way(), (system,)))


def test_postures_meet_what_was_given_no_root() -> None:
    """Of (x − 1)(x − 2) = 0 the root 1 is taken where x·y = y is a condition too."""
    way = Way((), ("(x - 1)*(x - 2)", "x*y - y"))
    roots = (Unsolved("(x - 1)*(x - 2)", symbol="x", degree=2),)
    for _, point in islice(arm().meeting(way, roots), 4):
        assert point.symbol("x") == 1
    with pytest.raises(RefusedError, match="no root"):
        next(arm().meeting(Way((), ("(x - 1)*(x - 2)", "x - 3")), roots))


# cos q = 1/2 on the way: sin q is ±√3/2, so 2·sin q = 1 is elsewhere.
HALF = Way((Step("numbers", angle=0, numbers=("0", "2", "-1")),))


def elsewhere(text: str, *numbers: str) -> Case:
    return Case((text,), 1, end="elsewhere", angle=0, numbers=numbers)


def test_an_angle_in_numbers_is_nowhere_else() -> None:
    solutions = Solutions(arm(), Signs(set(), set()))
    solutions.elsewhere(elsewhere("2*sin(q) - 1", "2", "0", "-1"), HALF)
    solutions.elsewhere(elsewhere("cos(q) + 3", "0", "1", "3"), HALF)


@pytest.mark.parametrize(
    ("case", "way"),
    [
        # The same equation again.
        (elsewhere("4*cos(q) - 2", "0", "4", "-2"), HALF),
        # A point of the circle that the way's equation has too.
        (
            elsewhere("5*sin(q) - 4", "5", "0", "-4"),
            Way((Step("numbers", angle=0, numbers=("0", "5", "-3")),)),
        ),
        # Other numbers than those of the equation.
        (elsewhere("4*cos(q) - 2", "2", "0", "-1"), HALF),
        # Nothing on the way fixes the angle.
        (elsewhere("2*sin(q) - 1", "2", "0", "-1"), Way()),
        # Not in numbers.
        (elsewhere("2*sin(q) - x", "2", "0", "-1"), HALF),
    ],
)
def test_false_claims_about_an_angle_in_numbers_are_refused(
    case: Case, way: Way
) -> None:
    with pytest.raises(RefusedError):
        Solutions(arm(), Signs(set(), set())).elsewhere(case, way)


def test_homogeneous_equations_are_not_met_by_lengths_that_vanish() -> None:
    """Of b·u = c·v and b·v = c·w only b = c = 0 is left unless u·w = v²."""
    ring, conditions = polynomials("b*u - c*v", "b*v - c*w")
    places = places_of(ring)
    nonzero = (places["b"], places["c"])
    found = linear_systems(ring, conditions)
    of_lengths = next(own for own in found if {*own.symbols} == {*nonzero})
    assert has_solutions(conditions, of_lengths, ())
    assert not has_solutions(conditions, of_lengths, nonzero)
    ring, other = polynomials("b*u - c*v", "b*v - c*w - 1")
    places = places_of(ring)
    nonzero = (places["b"], places["c"])
    assert all(has_solutions(other, s, nonzero) for s in linear_systems(ring, other))
    # Points of a branch on which they hold have lengths that are not 0.
    ring, conditions = polynomials("b*u - c*v", "b*v - c*w")
    branch = Branch(
        ring,
        assumptions=Assumptions(frozenset({"b", "c"})),
        pending=tuple(Pending(own, own) for own in conditions),
        thorough=True,
    )
    assert branch.points
    for point, prime in branch.points:
        assert all(residue(own, point, prime) == 0 for own in conditions)
        assert all(point[places_of(ring)[name]] for name in ("b", "c"))


@pytest.mark.parametrize(
    ("over", "excluded"), [("-", False), ("+", False), ("*", True)]
)
def test_a_divisor_that_vanishes_for_one_solution_excludes_nothing(
    over: str, excluded: bool
) -> None:
    """With cos q = 3/5 a divisor may allow one of sin q = ±4/5."""
    text = f"5*sin(q) {over} 4" if over != "*" else "25*sin(q)^2 - 16"
    steps = (
        Step("symbol", symbol="x", value="y", over=text),
        Step("numbers", angle=0, numbers=("0", "5", "-3")),
    )
    assert arm().excluded(Way(steps)) is excluded


def asked(
    ring: TrigonometricRing, conditions: list[Polynomial], *components: Polynomial
) -> tuple[Conditions, Place]:
    """Questions about a node on which conditions are not solved."""
    root = Branch(ring, Assumptions(frozenset()))
    matrix = Matrix((), (), (), single=True)
    problem = Problem(
        root,
        matrix,
        tuple((own,) for own in components),
        moving=False,
        library=FactorLibrary(ring),
        signs=Signs(set(), set()),
        axes={},
        directions={},
    )
    place = Place(with_conditions(root, conditions), tuple(conditions))
    return Conditions(problem), place


def test_square_roots_of_numbers_hide_no_quotient() -> None:
    """As a polynomial in √3 the product is divided by neither factor."""
    ring, (one, other) = polynomials(
        "3*x - sqrt(3)*y",
        "3*l*(sin(p)*cos(q) - sin(p)*cos(r) - cos(q)*sin(r) + cos(r)*sin(r))"
        " + 2*sqrt(3)*y*(sin(q) + sin(r) - 2*sin(p))",
    )
    known, _ = asked(ring, [])
    product = ring.normal(one * other)
    assert known.quotient(product, other) == one
    assert known.quotient(product, one) == other
    assert known.quotient(product + ring.one, other) is None


def test_both_equations_of_a_half_angle_make_its_multiples() -> None:
    """H = 2 sin ½(p − q): what is h² is made of h sin ½(p + q) and h cos ½(p + q)."""
    ring, (square, *pair) = polynomials(
        "x - x*cos(p)*cos(q) - x*sin(p)*sin(q)", "cos(q) - cos(p)", "sin(p) - sin(q)"
    )
    known, place = asked(ring, pair, square)
    found = paired_equation(known, place)
    assert found is not None
    total = ring.zero
    for term in found.terms:
        times = ring.normal(evaluate(parse(term.times), ring))
        total += times * pair[term.condition]
    assert ring.normal(total) == square
    assert paired_equation(*asked(ring, pair[:1], square)) is None


def places_of(ring: TrigonometricRing) -> dict[str, int]:
    return dict(zip(ring.symbols, ring.symbol_indices(), strict=True))


AXES = """
screwkit: 1
name: axes
base: ground
platform: tip
links: [ground, arm, tip]
geometry: posture
variables: {x: 1, y: 2}
joints:
  - {name: "1", type: revolute, parent: ground, child: arm, axis: [x, y, 0],
     point: [0, 0, 0]}
  - {name: "2", type: revolute, parent: arm, child: tip, axis: [0, 0, 1],
     point: [0, 0, 1]}
"""


def test_an_axis_ends_where_each_of_its_coordinates_does() -> None:
    """Two conditions x = 0 and y = 0 leave the axis (x, y, 0) without direction."""

    def examined(*multiples: Multiple) -> None:
        leaf = Node(2, axis="1", multiples=multiples)
        inner = Node(1, condition=1, cases=(Case(("y",), 1, kept=leaf),))
        locus = Locus(
            ("x", "y"),
            1,
            -1,
            (Reach((Step("symbol", symbol="x", value="0"),)),),
            Node(0, condition=0, cases=(Case(("x",), 1, kept=inner),)),
        )
        checker = PartCheck(
            load_text(AXES).mechanism,
            Part("limb", "ground", (), 2, (locus,), limb="limb_1"),
            random.Random(1),
        )
        checker._cover(locus)

    examined(Multiple(0, 0, "1", {}), Multiple(1, 1, "1", {}))
    for wrong in (
        (Multiple(0, 0, "1", {}),),
        (Multiple(0, 1, "1", {}), Multiple(1, 0, "1", {})),
    ):
        with pytest.raises(RefusedError, match="direction"):
            examined(*wrong)


def test_where_a_divisor_vanishes_there_is_no_posture() -> None:
    """Of x = z/y nothing is left where y = 0, and all where z = 0."""
    step = Step("symbol", symbol="x", value="z", over="y")
    for symbol, excluded in (("y", True), ("z", False)):
        there = Way((step, Step("symbol", symbol=symbol, value="0")))
        assert arm().excluded(there) is excluded
    assert not arm().excluded(Way((step,)))
