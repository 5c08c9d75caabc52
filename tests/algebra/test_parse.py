"""Reading expressions: what the grammar means, and what it refuses and where."""

from __future__ import annotations

import time
import warnings
from fractions import Fraction

import pytest

from screwkit.algebra.expression import (
    ONE,
    Call,
    Number,
    Pi,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse, parse_vector
from screwkit.algebra.vector_expression import VectorExpression
from screwkit.errors import ExpressionError

x, y, z = Symbol("x"), Symbol("y"), Symbol("z")


def number(text: str) -> Number:
    return Number(Fraction(text))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.1", number("1/10")),
        ("1e-3", number("1/1000")),
        (".5", number("1/2")),
        ("010", number("10")),
        ("2*3 + 4", number("10")),
        ("pi", Pi()),
        ("-pi/2", Product((number("-1/2"), Pi()))),
        ("x + (y + z)", Sum((x, y, z))),
        ("x*(y*z)", Product((x, y, z))),
        ("x - y", Sum((x, Product((number("-1"), y))))),
        ("x*2*y*3", Product((number("6"), x, y))),
        ("x/2", Product((number("1/2"), x))),
        ("x/y", Quotient(x, y)),
        ("x/y/z", Quotient(x, Product((y, z)))),
        ("x*(y/z)", Quotient(Product((x, y)), z)),
        ("x^2", Power(x, 2)),
        ("x**2", Power(x, 2)),
        ("x^-2", Quotient(ONE, Power(x, 2))),
        ("-x^2", Product((number("-1"), Power(x, 2)))),
        ("2^3^2", number("512")),
        ("(x^2)^3", Power(x, 6)),
        ("x^0", ONE),
        ("x - x*0", x),
        ("atan2(y, x)", Call("atan2", (y, x))),
        ("+x", x),
        ("--x", x),
        ("  x\n+ y ", Sum((x, y))),
    ],
)
def test_meaning(text: str, expected: object) -> None:
    assert parse(text) == expected


@pytest.mark.parametrize("name", ["lambda", "is", "S", "N", "E", "I", "beta", "None"])
def test_keywords_and_letters_of_other_systems_are_plain_names(name: str) -> None:
    assert parse(f"{name} + 1", {name}) == Sum((Symbol(name), ONE))


@pytest.mark.parametrize(
    ("text", "position", "message"),
    [
        ("", 0, "nothing is written"),
        ("   ", 0, "nothing is written"),
        ("rr3 + 1", 0, r"unknown name 'rr3' \(did you mean 'r3'\?\)"),
        ("1 + sni(r3)", 4, r"unknown function 'sni' \(did you mean 'sin'\?\)"),
        ("r3(2)", 0, r"'r3' is no function; write r3\*"),
        ("sin + 1", 0, r"'sin' is a function: write sin\("),
        ("sin(r3, 1)", 0, "sin takes one argument, not 2"),
        ("atan2(r3)", 0, "atan2 takes 2 arguments, not 1"),
        ("2 r3", 2, "an operator is missing between '2' and 'r3'"),
        ("2 (r3)", 2, r"an operator is missing between '2' and '\('"),
        ("(r3", 0, r"'\(' is never closed"),
        ("r3)", 2, r"'\)' closes nothing"),
        ("r3, 1", 2, "a comma stands only between"),
        ("r3 +", 3, r"nothing stands after '\+'"),
        ("r3 * / 2", 5, r"an operand is expected after '\*'"),
        ("* r3", 0, "an operand is expected at the start"),
        ("sin()", 4, r"an operand is expected after '\('"),
        ("r3//2", 3, "an operand is expected after '/'"),
        ("1/0", 2, "division by zero"),
        ("r3/(2 - 2)", 4, "division by zero"),
        ("0^-1", 0, "division by zero"),
        ("r3^r3", 3, "an exponent is an integer"),
        ("r3^(1/2)", 4, "an exponent is an integer; for roots"),
        ("r3^65", 3, "go up to 64"),
        ("(r3^9 + 1)^9", 11, "go up to 64"),
        ("sqrt(-1)", 0, "not real"),
        ("asin(2)", 0, "asin takes numbers from -1 to 1, not 2"),
        ("atan2(0, 0)", 0, r"atan2\(0, 0\) has no value"),
        ("1" * 41, 0, "more than 40 digits"),
        ("1e41", 0, "more than 40 digits"),
        ("1e" + "9" * 500, 0, "more than 40 digits"),
        ("r3 − 1", 3, "the character '−' is not in the grammar; write -"),
        ("sin(30°)", 6, "not in the grammar; write angles in radians"),
        ("π", 0, "write pi"),
        ("dot(r3, r3)", 0, "dot takes two vectors"),
    ],
)
def test_refusals_say_what_and_where(text: str, position: int, message: str) -> None:
    with pytest.raises(ExpressionError, match=message) as caught:
        parse(text, {"r3"})
    assert caught.value.position == position


HOSTILE = [
    "__import__('os')",
    "__import__",
    "x.__class__",
    "().__class__.__bases__[0]",
    "lambda: 1",
    "lambda x: x",
    "[a for a in b]",
    "{1: 2}",
    "f'{x}'",
    '"text"',
    "b'1'",
    "(a := 1)",
    "x if x else y",
    "x < y",
    "x and y",
    "not x",
    "x @ y",
    "x % 2",
    "x // 2",
    "~x",
    "x ^^ 2",
    "sin(x=1)",
    "sin(*x)",
    "sin(**x)",
    "x[0]",
    "x;y",
    "x = 1",
    "x # comment",
    "x \\\n + y",
    "1_000",
    "1j",
    "0x10",
    "1if 1else 2",
    "...",
    "ａ + 1",
    "exec(x)",
    "eval(x)",
    "exp(x)",
    "x\x00",
    "((9**64)**64)**64",
    "9**9**9**9",
    "2^1000*2^1000",
    "(((x+1)^60+1)^60+1)^60",
    "(" * 100 + "x" + ")" * 100,
    "sin(" * 61 + "x" + ")" * 61,
    "-" * 100_000 + "x",
    "-" * 1_000 + "x",
    "(" * 100_000,
    "x+" * 2_000 + "x",
    "^".join("1" * 500),
    "a" * 33,
]


@pytest.mark.parametrize("text", HOSTILE, ids=lambda text: text[:24])
def test_hostile_text_is_refused_quickly_and_quietly(text: str) -> None:
    start = time.perf_counter()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(ExpressionError):
            parse(text)
    assert time.perf_counter() - start < 1


def test_long_sums_are_no_deep_trees() -> None:
    expression = parse("+".join(["x*y"] * 500))
    assert isinstance(expression, Sum)
    assert len(expression.terms) == 500


def test_results_may_be_longer_than_what_people_write() -> None:
    text = " + ".join(f"x^{k % 60 + 2}*y" for k in range(900))
    with pytest.raises(ExpressionError, match="2000 are allowed"):
        parse(text)
    assert parse(text, limits=RESULT_LIMITS)


KNOWN: dict[str, VectorExpression] = {
    "ex": (ONE, number("0"), number("0")),
    "ey": (number("0"), ONE, number("0")),
    "P": (x, y, z),
}


class TestVectors:
    def test_products_and_sums(self) -> None:
        assert parse_vector("cross(ex, ey)", vectors=KNOWN) == (
            number("0"),
            number("0"),
            ONE,
        )
        assert parse_vector("P - 2*ex/4", vectors=KNOWN) == (
            Sum((x, number("-1/2"))),
            y,
            z,
        )
        assert parse_vector("-ex", vectors=KNOWN)[0] == number("-1")
        assert parse_vector("dot(P, ey)*ex", vectors=KNOWN)[0] == y

    def test_dot_is_a_number(self) -> None:
        assert parse("dot(P, ex) + 1", vectors=KNOWN) == Sum((x, ONE))

    @pytest.mark.parametrize(
        ("text", "message"),
        [
            ("P*ex", r"write dot\(a, b\) or cross\(a, b\)"),
            ("P + 1", "a number and a vector cannot be added"),
            ("1/P", "divided by a vector"),
            ("P^2", "a vector has no powers"),
            ("sin(P)", "sin takes numbers, not vectors"),
            ("cross(P, 1)", "cross takes two vectors"),
            ("x", "a vector is expected here"),
        ],
    )
    def test_kinds_do_not_mix(self, text: str, message: str) -> None:
        with pytest.raises(ExpressionError, match=message):
            parse_vector(text, vectors=KNOWN)

    def test_a_vector_is_no_scalar(self) -> None:
        with pytest.raises(ExpressionError, match="this is a vector"):
            parse("P", vectors=KNOWN)

    def test_stacked_products_do_not_explode(self) -> None:
        text = "P"
        for _ in range(40):
            text = f"cross({text}, {text} + P)"
            if len(text) > 1_900:
                break
        with pytest.raises(ExpressionError):
            parse_vector(f"cross(P, {text})", vectors=KNOWN)
