"""Residues come back as the numbers they were, or not at all."""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from screwkit.algebra.constants import ConstantField
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Expression
from screwkit.algebra.modular import ModularRing, prime_for
from screwkit.algebra.parse import parse
from screwkit.algebra.reconstruction import Reconstruction

Rings = tuple[ModularRing, ModularRing]


def rings(radicands: Sequence[int] = (), turn: int = 12) -> Rings:
    fractions = [Fraction(r) for r in radicands]
    field = ConstantField.needed_by(fractions, turn)
    roots = [Fraction(p) for p in field.primes]
    steps = math.lcm(turn, field.turn or 1)
    first, second = (prime_for(steps, roots, seed) for seed in (1, 2))
    return ModularRing(1, first, field), ModularRing(2, second, field)


USUAL = rings()
FIELDS = {
    "usual": USUAL,
    "fifth": rings([], 5),
    "seventh": rings([], 7),
    "roots": rings([5, 7], 1),
    "root_and_fifth": rings([2], 5),
}
small = st.fractions(-40, 40, max_denominator=12)


def residues(two: Rings, expression: Expression) -> list[int]:
    return [int(evaluate(expression, ring)) for ring in two]


@given(st.fractions(max_denominator=10**7).filter(lambda x: abs(x) < 1000))
def test_rationals_come_back(value: Fraction) -> None:
    back = Reconstruction.between(*USUAL)
    found = back.number(*(int(ring.rational(value)) for ring in USUAL))
    assert found is not None
    assert [weight for _, weight in found.terms] == [value] * bool(value)
    assert float(found) == pytest.approx(float(value))
    assert found.sign == (value > 0) - (value < 0)


NUMBERS = [
    ("usual", "0", 0),
    ("usual", "-3/7", -3 / 7),
    ("usual", "1/2 + sqrt(3)/2", 0.5 + math.sqrt(3) / 2),
    ("usual", "sqrt(2)/3 - 5", math.sqrt(2) / 3 - 5),
    ("usual", "1/(2 + sqrt(3))", 2 - math.sqrt(3)),
    ("usual", "cos(pi/12) - 1", math.cos(math.pi / 12) - 1),
    ("usual", "sqrt(75)/4", 5 * math.sqrt(3) / 4),
    (
        "usual",
        "1 + sqrt(6) - sqrt(2) - sqrt(3)",
        1 + math.sqrt(6) - math.sqrt(2) - math.sqrt(3),
    ),
    ("fifth", "3*sin(2*pi/5) - 1/3", 3 * math.sin(0.4 * math.pi) - 1 / 3),
    ("fifth", "cos(2*pi/5)", math.cos(0.4 * math.pi)),
    ("fifth", "sqrt(5)", math.sqrt(5)),
    (
        "seventh",
        "cos(pi/7) - cos(3*pi/7)",
        math.cos(math.pi / 7) - math.cos(3 * math.pi / 7),
    ),
    ("roots", "3 - sqrt(35) + sqrt(5)/2", 3 - math.sqrt(35) + math.sqrt(5) / 2),
    ("root_and_fifth", "sqrt(2)*cos(pi/5)", math.sqrt(2) * math.cos(math.pi / 5)),
]


@pytest.mark.parametrize(("name", "text", "value"), NUMBERS)
def test_numbers_of_the_field_come_back(name: str, text: str, value: float) -> None:
    two = FIELDS[name]
    known = residues(two, parse(text))
    found = Reconstruction.between(*two).number(*known)
    assert found is not None
    assert float(found) == pytest.approx(value, abs=1e-12)
    assert residues(two, parse(found.text)) == known
    assert residues(two, found.expression) == known
    assert found.sign == (value > 0) - (value < 0)


@given(st.lists(small, min_size=4, max_size=4))
def test_combinations_of_roots_come_back(weights: list[Fraction]) -> None:
    text = " + ".join(
        f"({w})*sqrt({r})" for w, r in zip(weights, (1, 2, 3, 6), strict=True)
    )
    known = residues(USUAL, parse(text))
    found = Reconstruction.between(*USUAL).number(*known)
    value = sum(
        float(w) * math.sqrt(r) for w, r in zip(weights, (1, 2, 3, 6), strict=True)
    )
    if found is not None:  # too long to be told from chance is no error
        assert float(found) == pytest.approx(value, abs=1e-9)
        assert residues(USUAL, parse(found.text)) == known
    if math.lcm(*(w.denominator for w in weights)) <= 60:
        assert found is not None


def test_chance_is_never_a_number() -> None:
    source = random.Random(7)
    for two in FIELDS.values():
        back = Reconstruction.between(*two)
        p, q = back.primes
        for _ in range(60):
            assert back.number(source.randrange(p), source.randrange(q)) is None


@given(st.integers(1, 2**35 - 1), st.integers(1, 2**35 - 1), st.sampled_from([-1, 1]))
def test_rationals_come_back_up_to_what_chance_allows(
    above: int, below: int, sign: int
) -> None:
    """Pairs up to h are (2h + 1)² of more than 2¹²⁰: rare enough below 2³⁵."""
    value = Fraction(sign * above, below)
    found = Reconstruction.between(*USUAL).number(
        *(int(ring.rational(value)) for ring in USUAL)
    )
    assert found is not None
    assert [weight for _, weight in found.terms] == [value]


@pytest.mark.parametrize("above", [2**38 + 1, 2**45 + 1, 1])
@pytest.mark.parametrize("below", [2**38 - 1, 2**45 - 1])
def test_longer_rationals_might_be_chance(above: int, below: int) -> None:
    known = (int(ring.rational(Fraction(above, below))) for ring in USUAL)
    assert Reconstruction.between(*USUAL).number(*known) is None


@given(small, small)
def test_both_primes_must_agree(first: Fraction, second: Fraction) -> None:
    a, b = (int(r.rational(x)) for r, x in zip(USUAL, (first, second), strict=True))
    found = Reconstruction.between(*USUAL).number(a, b)
    assert (found is not None) == (first == second)


def test_a_symbol_is_no_number() -> None:
    known = residues(USUAL, parse("x + 1", ["x"]))
    assert Reconstruction.between(*USUAL).number(*known) is None


def test_a_root_outside_the_field_is_no_number() -> None:
    two = ModularRing(1, USUAL[0].prime), ModularRing(2, USUAL[1].prime)
    back = Reconstruction.between(*two)
    for attempt in range(2, 60):
        roots = [nmod_root(attempt, ring.prime) for ring in two]
        if None not in roots and attempt in {5, 7, 10, 11, 13}:
            assert back.number(*(r for r in roots if r is not None)) is None


def nmod_root(value: int, prime: int) -> int | None:
    """A square root by Cipolla's formula, an oracle apart from FLINT."""
    if pow(value, (prime - 1) // 2, prime) != 1:
        return None
    a = next(
        a
        for a in range(prime)
        if pow(a * a - value, (prime - 1) // 2, prime) == prime - 1
    )
    result, base, exponent = (1, 0), (a, 1), (prime + 1) // 2
    while exponent:
        if exponent & 1:
            result = times(result, base, a * a - value, prime)
        base, exponent = times(base, base, a * a - value, prime), exponent >> 1
    assert result[0] ** 2 % prime == value % prime
    return result[0]


def times(
    x: tuple[int, int], y: tuple[int, int], w: int, prime: int
) -> tuple[int, int]:
    return (
        (x[0] * y[0] + x[1] * y[1] * w) % prime,
        (x[0] * y[1] + x[1] * y[0]) % prime,
    )


@pytest.mark.parametrize(
    ("vector", "expected"),
    [
        (("0", "0", "-2"), ("0", "0", "1")),
        (("-1/2", "1/3", "0"), ("3", "-2", "0")),
        (("1/2", "sqrt(3)/2", "0"), ("1", "sqrt(3)", "0")),
        (("-sqrt(3)", "-3", "3*sqrt(3)"), ("1", "sqrt(3)", "-3")),
    ],
)
def test_directions_are_free_of_their_factor(
    vector: tuple[str, ...], expected: tuple[str, ...]
) -> None:
    factors = 123456789, 987654321987
    columns = [
        [factor * int(evaluate(parse(text), ring)) % ring.prime for text in vector]
        for factor, ring in zip(factors, USUAL, strict=True)
    ]
    found = Reconstruction.between(*USUAL).direction(columns[0], columns[1])
    assert found is not None
    assert tuple(number.text for number in found) == expected


def test_roots_in_the_field() -> None:
    """(x² − 3)(x − 1/2)(x² − 7): the first three roots are in the field."""
    polynomial = [Fraction(x) for x in (-21, 42, 10, -20, -1, 2)]
    columns = [[int(ring.rational(c)) for c in polynomial] for ring in USUAL]
    found = Reconstruction.between(*USUAL).roots(columns[0], columns[1])
    assert [number.text for _, _, number in found] == ["-sqrt(3)", "1/2", "sqrt(3)"]


def test_rings_must_belong_together() -> None:
    with pytest.raises(ValueError, match="one constant field and two primes"):
        Reconstruction.between(USUAL[0], USUAL[0])
    with pytest.raises(ValueError, match="one constant field and two primes"):
        Reconstruction.between(USUAL[0], FIELDS["fifth"][1])
