"""Symbols projected onto a condition: they meet it, and stay where it holds."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import pytest

from screwkit.algebra.projections import projection
from screwkit.algebra.substitution import Substitution, power_of, substituted
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def ring_of(angles: str, symbols: str) -> TrigonometricRing:
    seen = SurveyRing()
    for angle in angles:
        seen.cosine_sine(angle)
    for symbol in symbols:
        seen.symbol(symbol)
    return TrigonometricRing(seen)


RING = ring_of("t", "xyza")
C, S = RING.cosine_sine("t")
X, Y, Z, A = (RING.symbol(name) for name in "xyza")
KEPT = (RING.names.index(str(A)),)

ON_A_LINE = RING.normal(X * S - Y * C + A * C - 2)
IN_SPACE = RING.normal(3 * Z * S + 3 * X * C + Y - A)


@pytest.mark.parametrize("condition", [ON_A_LINE, IN_SPACE])
def test_the_images_meet_the_condition(condition: Polynomial) -> None:
    step = projection(RING, condition, KEPT)
    assert step is not None
    assert substituted(RING, [condition], step) == [0]


def at(polynomial: Polynomial, values: Sequence[Fraction]) -> Fraction:
    """A polynomial at rational values of its generators."""
    total = Fraction(0)
    for exponents, coefficient in polynomial.to_dict().items():
        term = Fraction(int(coefficient.p), int(coefficient.q))
        for value, exponent in zip(values, exponents, strict=True):
            term *= value ** int(exponent)
        total += term
    return total


def test_where_the_condition_holds_nothing_moves() -> None:
    """At sin t = 3/5 and cos t = 4/5, on a line and in a plane."""
    places = {str(g): k for k, g in enumerate(RING.context.gens())}
    for condition, free in ((ON_A_LINE, Y), (IN_SPACE, X)):
        values = [Fraction(k + 2, 7) for k in range(len(places))]
        values[places[str(S)]], values[places[str(C)]] = Fraction(3, 5), Fraction(4, 5)
        index = places[str(free)]
        values[index] = Fraction(0)
        rest = at(condition, values)
        values[index] = Fraction(1)
        values[index] = -rest / (at(condition, values) - rest)
        assert at(condition, values) == 0
        step = projection(RING, condition, KEPT)
        assert step is not None
        for moved, image in step.images:
            assert at(image, values) == at(step.divisor, values) * values[moved]


def test_factors_are_seen_that_the_condition_hides() -> None:
    """On x·sin t = y·cos t the area x·sin u − y·cos u holds the length along t."""
    ring = ring_of("tu", "xy")
    (c, s), (d, v) = ring.cosine_sine("t"), ring.cosine_sine("u")
    x, y = ring.symbol("x"), ring.symbol("y")
    step = projection(ring, ring.normal(x * s - y * c))
    assert step is not None
    along = x * c + y * s
    (found,) = substituted(ring, [x * v - y * d], step)
    assert found == ring.normal(along * (c * v - s * d))


@pytest.mark.parametrize("condition", [X * Y * S - Y * C, X * A * S - Y * C, X * S + A])
def test_other_conditions_have_none(condition: Polynomial) -> None:
    assert projection(RING, RING.normal(condition), KEPT) is None


def test_dimensions_stay() -> None:
    """Only x and a have a unit normal together, and a is a dimension."""
    condition = RING.normal(X * S - A * C)
    assert projection(RING, condition, KEPT) is None
    assert projection(RING, condition) is not None


@pytest.mark.parametrize(
    "value",
    [
        X * Y * Z - A,  # linear in one of the two that are replaced
        X * A + Y * Z + C,  # in both, and not in their product
        X * Y + S,
        X**2 * S - Y + 1,
    ],
)
def test_what_is_put_in_is_the_quotient(value: Polynomial) -> None:
    """At rational places, with x = (z + 1)/(a + z) and y = 3 a/(a + z)."""
    places = {str(g): k for k, g in enumerate(RING.context.gens())}
    x, y = places[str(X)], places[str(Y)]
    step = Substitution(images=((x, Z + 1), (y, 3 * A)), divisor=A + Z)
    (replaced,) = substituted(RING, [value], step)
    power = power_of([value], step)
    values = [Fraction(k + 2, 7) for k in range(len(places))]
    values[places[str(S)]], values[places[str(C)]] = Fraction(3, 5), Fraction(4, 5)
    put_in = list(values)
    put_in[x], put_in[y] = (at(p, values) / at(A + Z, values) for p in (Z + 1, 3 * A))
    assert at(replaced, values) == at(value, put_in) * at(A + Z, values) ** power
