"""Constants modulo a prime keep their relations; what is drawn is kept."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import nmod
from hypothesis import given, settings
from hypothesis import strategies as st

from screwkit.algebra.constants import ConstantField
from screwkit.algebra.degree_along import degree_along
from screwkit.algebra.evaluation import cosine_sine, evaluate
from screwkit.algebra.expression import Number
from screwkit.algebra.modular import (
    ModularRing,
    ResampleError,
    annihilator,
    echelon,
    pivots,
    prime_for,
    rank,
    residue_matrix,
)
from screwkit.algebra.parse import parse
from screwkit.algebra.rational_values import rational_value
from screwkit.algebra.survey import SurveyRing

laws = settings(max_examples=60, derandomize=True)


def ring_for(*texts: str, seed: int = 1) -> ModularRing:
    """A ring in which these constants exist, as exact postures draw one."""
    seen = SurveyRing()
    for text in texts:
        evaluate(parse(text, ()), seen)
    radicands = [r.value for r in seen.roots if isinstance(r, Number)]
    field = ConstantField.needed_by(radicands, seen.turn)
    roots = [*radicands, *map(Fraction, field.primes)]
    for attempt in range(100):
        prime = prime_for(seen.turn, roots, seed + 1000 * attempt)
        ring = ModularRing(seed, prime, field)
        try:
            for text in texts:
                evaluate(parse(text, ()), ring)
        except ResampleError:
            continue
        return ring
    raise AssertionError("no prime was found")


EQUAL = [
    ("sqrt(12)", "2*sqrt(3)"),
    ("cos(pi/6)", "sqrt(3)/2"),
    ("sqrt(12)", "4*cos(pi/6)"),
    ("sin(pi/3)", "cos(pi/6)"),
    ("tan(pi/3)", "sqrt(3)"),
    ("sin(pi/4)", "1/sqrt(2)"),
    ("sqrt(6)", "sqrt(2)*sqrt(3)"),
    ("sqrt(3/4)", "cos(pi/6)"),
    ("sqrt(2/3)", "sqrt(6)/3"),
    ("cos(pi/12)", "(sqrt(6) + sqrt(2))/4"),
    ("cos(pi/5)", "(1 + sqrt(5))/4"),
    ("4*sin(pi/5)*sin(2*pi/5)", "sqrt(5)"),
    ("cos(pi/7) - cos(2*pi/7) + cos(3*pi/7)", "1/2"),
    ("cos(-pi/6)", "cos(13*pi/6)"),
    ("sin(7*pi/6)", "-1/2"),
    ("cos(atan(3/4))", "4/5"),
    ("sin(atan2(1, -1))", "sqrt(2)/2"),
    ("cos(2*asin(1/3))", "7/9"),
    ("sin(pi/3 + atan(1))", "(sqrt(6) + sqrt(2))/4"),
    ("sqrt(25/16)", "5/4"),
    ("sqrt(2^2 + 1/4)", "sqrt(17)/2"),
]


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize(("one", "other"), EQUAL, ids=[one for one, _ in EQUAL])
def test_equal_constants_are_equal_residues(one: str, other: str, seed: int) -> None:
    """Signs too: every root is written in one root of each generator."""
    ring = ring_for(one, other, seed=seed)
    assert evaluate(parse(one, ()), ring) == evaluate(parse(other, ()), ring)


def test_three_ways_to_the_root_of_three_agree_in_one_ring() -> None:
    ring = ring_for("sqrt(3)", "sqrt(12)", "cos(pi/6)")
    first, second, third = (
        evaluate(parse(text, ()), ring) for text in ("sqrt(3)", "sqrt(12)", "cos(pi/6)")
    )
    assert (second, 2 * third) == (2 * first, first)
    assert first * first == 3


@laws
@given(st.integers(-60, 60), st.sampled_from([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15]))
def test_turns_are_points_of_the_circle_that_add(k: int, n: int) -> None:
    prime = prime_for(n, list(map(Fraction, (2, 3, 5, 7))), 1)
    ring = ModularRing(1, prime, ConstantField.needed_by([], n))
    cosine, sine = ring.half_turns(Fraction(k, n))
    assert cosine * cosine + sine * sine == 1
    one_c, one_s = ring.half_turns(Fraction(1, n))
    next_c, next_s = ring.half_turns(Fraction(k + 1, n))
    assert next_c == cosine * one_c - sine * one_s
    assert next_s == sine * one_c + cosine * one_s


def test_symbols_and_angles_are_drawn_once() -> None:
    ring = ModularRing(5)
    assert ring.symbol("a") == ring.symbol("a") != ring.symbol("b")
    cosine, sine = ring.cosine_sine("q")
    assert (cosine, sine) == ring.cosine_sine("q")
    assert cosine * cosine + sine * sine == 1
    again = ModularRing(5)
    assert again.symbol("a") == ring.symbol("a")


def test_constants_in_radians_are_opposite_for_opposite_angles() -> None:
    ring = ModularRing(5)
    cosine, sine = ring.radians(Fraction(1, 3))
    assert ring.radians(Fraction(-1, 3)) == (cosine, -sine)
    assert ring.radians(Fraction(0)) == (1, 0)


def test_a_root_of_an_expression_is_one_root_everywhere() -> None:
    text = "sqrt(a^2 + b^2)"
    expression = parse(text, ("a", "b"))
    for seed in range(20):
        ring = ModularRing(seed)
        try:
            root = evaluate(expression, ring)
        except ResampleError:
            continue
        assert root * root == ring.symbol("a") ** 2 + ring.symbol("b") ** 2
        assert evaluate(expression, ring) == root
        cosine, sine = cosine_sine(parse("atan2(b, a)", ("a", "b")), ring)
        assert cosine * cosine + sine * sine == 1
        assert sine * ring.symbol("a") == cosine * ring.symbol("b")
        return
    raise AssertionError("half of all numbers have a root")


def test_dividing_by_nothing_asks_for_another_point() -> None:
    ring = ModularRing(1)
    with pytest.raises(ResampleError):
        evaluate(parse("1/(a - a*cos(q)^2 - a*sin(q)^2)", ("a", "q")), ring)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("3/4", Fraction(3, 4)),
        ("(1/2)^2 + 3*(2 - 1/3)", Fraction(21, 4)),
        ("2^-3", Fraction(1, 8)),
        ("(1 + 1/2)/(3/4)", Fraction(2)),
        ("a + 1", None),
        ("sqrt(4)", None),
        ("pi", None),
    ],
)
def test_plain_rationals_are_recognised(text: str, value: Fraction | None) -> None:
    assert rational_value(parse(text, ("a",))) == value


@laws
@given(
    st.lists(st.lists(st.integers(0, 6), min_size=5, max_size=5), max_size=7),
    st.sampled_from([7, 2**61 - 1]),
)
def test_rank_annihilator_and_echelon_go_together(
    rows: list[list[int]], prime: int
) -> None:
    residues = [[nmod(x, prime) for x in row] for row in rows]
    found = rank(residues, prime)
    across = annihilator(residues, 5, prime)
    assert len(across) == 5 - found
    assert all(
        sum(x * y for x, y in zip(row, vector, strict=True)) % prime == 0
        for row in rows
        for vector in across
    )
    reduced = echelon(residues, prime)
    assert len(reduced) == found
    assert rank([*rows, *reduced], prime) == found
    assert echelon([*reduced, *rows], prime) == reduced
    leading = [rank([row[:k] for row in residues], prime) for k in range(6)]
    assert pivots(residue_matrix(residues, 5, prime)) == [
        k for k in range(5) if leading[k + 1] > leading[k]
    ]


def test_a_degree_is_told_from_values() -> None:
    """(t² + 1)² (t³ − 2), without t² + 1 and with it; of eight values seven tell it."""
    places = range(12)
    values = [(t * t + 1) ** 2 * (t**3 - 2) for t in places]
    below = [t * t + 1 for t in places]
    prime = 10**9 + 7
    assert degree_along(values, [below], prime) == 3
    assert degree_along(values, [], prime) == 7
    assert degree_along(values[:8], [], prime) is None
    assert degree_along([0] * 5, [], prime) is None
