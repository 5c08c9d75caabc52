"""Closed solutions: known ones, and every branch put back into its condition."""

import math
import random

import pytest

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import (
    Call,
    Expression,
    Number,
    Pi,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from screwkit.algebra.expression_building import symbols_of
from screwkit.algebra.factors import Factor, factor
from screwkit.algebra.parse import parse
from screwkit.algebra.polynomial_text import to_expression
from screwkit.algebra.solve import Solved, solutions
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing, primitive

POSITIVE = Assumptions(frozenset({"r1", "r3", "d3"}))


def solved(text: str) -> list[tuple[TrigonometricRing, Factor, tuple[Solved, ...]]]:
    expression = parse(text)
    survey = SurveyRing()
    evaluate(expression, survey)
    ring = TrigonometricRing(survey)
    found = factor(ring, evaluate(expression, ring))
    return [(ring, part, solutions(ring, part, POSITIVE)) for part, _ in found.factors]


def only(text: str) -> dict[str, tuple[tuple[str, ...], str]]:
    ((_, _, found),) = solved(text)
    return {s.variable: (s.values, s.modulo) for s in found}


@pytest.mark.parametrize(
    ("text", "variable", "values", "modulo"),
    [
        ("sin(q4)", "q4", ("0", "pi"), "pi"),
        ("cos(q4)", "q4", ("pi/2", "-pi/2"), "pi"),
        (
            "r3*cos(q2) + d3*sin(q2)",
            "q2",
            ("atan(-r3/d3)", "atan(-r3/d3) + pi"),
            "pi",
        ),
        ("r3*cos(q7) - d3*sin(q7)", "q7", ("atan(r3/d3)", "atan(r3/d3) - pi"), "pi"),
        ("sin(q6 - q1)", "q6", ("q1", "q1 + pi"), "pi"),
        ("a*sin(q1) + d", "q1", ("asin(-d/a)", "pi - asin(-d/a)"), "2*pi"),
        (
            "2*r1*cos(q2) + d3",
            "q2",
            ("acos(-d3/(2*r1))", "-acos(-d3/(2*r1))"),
            "2*pi",
        ),
        ("2*sin(q1) + 1", "q1", ("-pi/6", "-5*pi/6"), "2*pi"),
        ("1 + cos(q4)", "q4", ("pi",), "2*pi"),
        ("sqrt(3)*cos(q1) + sin(q1)", "q1", ("-pi/3", "2*pi/3"), "pi"),
        ("sin(q1) - sqrt(3)*cos(q1) - 2", "q1", ("5*pi/6",), "2*pi"),
        ("cos(q6 - q1) - cos(pi/5)", "q6", ("q1 + pi/5", "q1 - pi/5"), "2*pi"),
        (
            "(d3^2 - r3^2)*sin(q2 - q7) + 2*d3*r3*cos(q2 - q7)",
            "q2",
            ("q7 + 2*atan(d3/r3)", "q7 + 2*atan(d3/r3) - pi"),
            "pi",
        ),
        # (c + 1/3)² = 98/81 has a root below −1, too.
        (
            "81*cos(q1)^2 + 54*cos(q1) - 89",
            "q1",
            ("acos(-1/3 + 7*sqrt(2)/9)", "-acos(-1/3 + 7*sqrt(2)/9)"),
            "2*pi",
        ),
        ("2*x^2 - 4*x - 7", "x", ("1 + 3*sqrt(2)/2", "1 - 3*sqrt(2)/2"), ""),
        ("x*sin(q1) - y", "x", ("y/sin(q1)",), ""),
        (
            "x^2 + x*y + 1",
            "x",
            ("(-y + sqrt(y^2 - 4))/2", "(-y - sqrt(y^2 - 4))/2"),
            "",
        ),
        ("x^3 + y", "y", ("-x^3",), ""),
        ("r1 - d3", "d3", ("r1",), ""),
    ],
)
def test_known_solutions(
    text: str, variable: str, values: tuple[str, ...], modulo: str
) -> None:
    assert only(text)[variable] == (values, modulo)


def test_a_half_angle_pair_has_one_branch() -> None:
    found = solved("a4*(1 - cos(q4)) - d3*sin(q4)")
    assert [(s.variable, s.values) for _, _, group in found for s in group] == [
        ("q4", ("0",)),
        ("q4", ("2*atan(d3/a4)",)),
    ]


@pytest.mark.parametrize("k", range(-11, 13))
def test_an_equation_of_one_known_angle_gives_that_angle(k: int) -> None:
    """cos(φ − φ₀) = 1 written out, and cos(φ − φ₀) = 0."""
    along = f"cos({k}*pi/12)*cos(q) + sin({k}*pi/12)*sin(q)"
    for text, turns in ((f"2*({along}) - 2", [0]), (along, [6, -6])):
        survey = SurveyRing()
        evaluate(parse(text), survey)
        ring = TrigonometricRing(survey)
        equation = primitive(ring.normal(evaluate(parse(text), ring)))
        (found,) = solutions(ring, Factor(text, (equation,)), POSITIVE)
        assert not any("a" in value for value in found.values)  # atan2, acos, ...
        read = [number(parse(value), {}) for value in found.values]
        wanted = [math.remainder((k + t) * math.pi / 12, 2 * math.pi) for t in turns]
        assert all(
            min(abs(math.remainder(r - w, 2 * math.pi)) for w in wanted) < 1e-12
            for r in read
        )
        assert len(read) == len(wanted)


def test_a_cubic_is_not_solved_for_its_variable() -> None:
    assert "x" not in only("x^3 + y")


CONDITIONS = [
    "sin(q4)",
    "cos(q1 + q2)",
    "r3*cos(q2) + d3*sin(q2)",
    "a*cos(q2) + b*sin(q2)",
    "a*sin(q1) + b*cos(q1) + d",
    "a*sin(q1 + q2) + b*cos(q2)",
    "r1*sin(q1) + d3",
    "d5*sin(q2 + q3 + q4) + a2*cos(q2) + a3*cos(q2 + q3)",
    "4*r1^2*cos(q2)*cos(q7) + d3^2*sin(q6 - q1)^2 + 2*r1*d3*(cos(q2) + cos(q7))",
    "r1^2*sin(q1)^2 + 2*r3*sin(q1)*cos(q1) - d3*cos(q1)^2",
    "r1*cos(q1)^2 + d3*cos(q1) - r3",
    "r1*sin(q1)^2 + d3*sin(q1) - r3",
    "(d3^2 - r3^2)*sin(q2 - q7) + 2*d3*r3*cos(q2 - q7)",
    "a4*(1 - cos(q4)) - d3*sin(q4)",
    "cos(q1) + cos(q2)",
    "(x - sin(q1))^2*y + x - 1",
    "sqrt(3)*cos(q1) + sin(q1)",
    "sqrt(x^2 + 1)*cos(q1) + y*sin(q1)",
]


@pytest.mark.parametrize("text", CONDITIONS)
def test_every_branch_satisfies_the_condition(text: str) -> None:
    source = random.Random(5)
    count = 0
    for ring, part, group in solved(text):
        conditions = [to_expression(ring, e) for e in part.equations]
        names = {name for c in conditions for name in symbols_of(c)}
        for found in group:
            assert len(set(found.values)) == len(found.values)
            for value in found.values:
                reached = False
                for _ in range(200):
                    point = {name: source.uniform(0.3, 2.5) for name in names}
                    try:
                        point[found.variable] = number(parse(value), point)
                    except ValueError:
                        continue  # not real at this point
                    reached = True
                    for condition in conditions:
                        assert abs(number(condition, point)) < 1e-8
                assert reached, value
                count += 1
    assert count


def number(expression: Expression, point: dict[str, float]) -> float:
    """The value in floating point.

    Raises:
        ValueError: If it is not real.
    """
    match expression:
        case Number(value):
            return float(value)
        case Pi():
            return math.pi
        case Symbol(name):
            return point[name]
        case Sum(terms):
            return sum(number(term, point) for term in terms)
        case Product(factors):
            return math.prod(number(f, point) for f in factors)
        case Quotient(above, below):
            return number(above, point) / number(below, point)
        case Power(base, exponent):
            return number(base, point) ** exponent
        case Call(function, arguments):
            values = [number(argument, point) for argument in arguments]
            return float(getattr(math, function)(*values))


@pytest.mark.parametrize(
    ("text", "variables"),
    [
        ("sin(q6 - q1)", ["q6", "q1"]),
        ("sin(q2 - q10)", ["q10", "q2"]),
        ("cos(q1 + q6)", ["q6", "q1"]),
    ],
)
def test_the_positive_or_the_later_angle_comes_first(
    text: str, variables: list[str]
) -> None:
    ((_, _, found),) = solved(text)
    assert [s.variable for s in found] == variables


@pytest.mark.parametrize(
    "inner", ["sin(q2)", "cos(q2)", "cos(q2 + q3)", "sin(q1 - q3)"]
)
@pytest.mark.parametrize("outer", ["sin(q1)", "cos(q1)"])
@pytest.mark.parametrize("sign", "+-")
def test_the_function_of_another_angle_is_solved_without_its_inverse(
    outer: str, inner: str, sign: str
) -> None:
    condition = parse(f"{outer} {sign} {inner}")
    survey = SurveyRing()
    evaluate(condition, survey)
    ring = TrigonometricRing(survey)
    whole = ring.normal(evaluate(condition, ring))
    found = solutions(ring, Factor(str(whole), (whole,)), POSITIVE)
    assert found
    point = {"q1": 0.4, "q2": 1.3, "q3": 2.2}
    for one in found:
        assert len(one.values) == 2
        for value in one.values:
            assert "(" not in value
            at = {**point, one.variable: number(parse(value), point)}
            assert abs(number(condition, at)) < 1e-12
        sines = {
            round(math.sin(number(parse(value), point)), 9) for value in one.values
        } | {round(math.cos(number(parse(v), point)), 9) for v in one.values}
        assert len(sines) > 2  # two angles, not one twice


def test_of_a_product_no_factor_is_taken_for_the_whole() -> None:
    """x·sin q₁ = 0 does not say q₁ = 0, nor x·(y − 1) = 0 that y = 1 but for x > 0."""
    positive = Assumptions(frozenset({"x"}))
    for text, variable, values in (
        ("x*sin(q1)", "q1", ("0", "pi")),
        ("x*(y - 1)", "y", ("1",)),
    ):
        expression = parse(text)
        survey = SurveyRing()
        evaluate(expression, survey)
        ring = TrigonometricRing(survey)
        whole = ring.normal(evaluate(expression, ring))
        factor_of_all = Factor(text, (whole,))
        assert not solutions(ring, factor_of_all, POSITIVE)
        (found,) = solutions(ring, factor_of_all, positive)
        assert (found.variable, found.values) == (variable, values)
