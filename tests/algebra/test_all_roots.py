"""All roots at once: as one root after the other, in extensions too."""

from __future__ import annotations

import random
from functools import partial
from typing import Any

import pytest
from flint import nmod, nmod_poly

from screwkit.algebra.all_roots import (
    NoResidueError,
    RootValue,
    at_all_roots,
    rank_at_roots,
)
from screwkit.algebra.evaluated_modulo import laid_out
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.fractions_modulo import NoFractionError, fraction_of
from screwkit.algebra.modular import ModularRing
from screwkit.algebra.parse import parse

PRIME = 10007


def polynomial(*roots: int) -> Any:
    product = nmod_poly([1], PRIME)
    for root in roots:
        product = product * nmod_poly([-root, 1], PRIME)
    return product


def matrix(t: Any) -> list[list[Any]]:
    """Rank 1 at 2, rank 2 at 5, rank 3 elsewhere unless t² = 3."""
    one = nmod(1, PRIME)
    return [
        [t - 2 * one, t * t, one],
        [0 * one, (t - 2) * (t - 5), t * (t - 2)],
        [0 * one, 0 * one, (t - 2) * (t * t - 3)],
    ]


@pytest.mark.parametrize("roots", [(2,), (5, 7), (2, 5, 7, 11), (2, 2, 7)])
def test_ranks_at_all_roots_are_those_at_each(roots: tuple[int, ...]) -> None:
    found = at_all_roots(polynomial(*roots), lambda t: rank_at_roots(matrix(t), PRIME))
    alone = {rank_at_roots(matrix(nmod(root, PRIME)), PRIME) for root in roots}
    assert {*found} == alone


def test_roots_in_an_extension_are_met() -> None:
    """3 is no square modulo 7 and no root of t² − 3 is a residue."""
    prime = 7
    assert not nmod_poly([-3, 0, 1], prime).roots()
    seen = at_all_roots(
        nmod_poly([-3, 0, 1], prime) * nmod_poly([-1, 1], prime),
        lambda t: rank_at_roots([[t * t - 3]], prime),
    )
    assert sorted(seen) == [0, 1]


def test_inverses_and_quotients_at_roots() -> None:
    def identities(t: Any) -> bool:
        assert isinstance(t, RootValue)
        assert (1 / t) * t == 1
        assert t / (t + 1) == 1 - 1 / (t + 1)
        assert t**-2 == 1 / (t * t)
        assert nmod(3, PRIME) / t * t == 3
        assert -(2 - t) == t - 2
        with pytest.raises(NoResidueError):
            int(t)
        assert int(t - t + 4) == 4
        with pytest.raises(ZeroDivisionError):
            1 / (t - t)
        return True

    assert at_all_roots(polynomial(3, 4, 5, 6), identities) == [True]


def test_fractions_are_found_from_their_values() -> None:
    above, below = polynomial(2, 2, 9), polynomial(1, 4)

    def value(place: Any) -> Any:
        under = below(place)
        return None if under == 0 else above(place) / under

    one, two = fraction_of(value, random.Random(1), PRIME)
    assert one * below == above * two
    assert two.degree() == 2
    constant, _ = fraction_of(lambda place: nmod(5, PRIME), random.Random(1), PRIME)
    assert constant.degree() == 0
    with pytest.raises(NoFractionError):
        fraction_of(lambda place: None, random.Random(1), PRIME)


@pytest.mark.parametrize(
    "text",
    [
        "3*a^2*sin(q) - 1/2*b*cos(q + r)^3 + 7",
        "(a + b*(sin(q) - 2)^2)^3*c - tan(q)*c*a/(b + 1)",
        "a*b^-2 + 2*(1 - cos(2*q))*(a - b)",
        "5",
        "-a",
    ],
)
def test_layouts_have_the_value_of_their_expression(text: str) -> None:
    expression = parse(text)
    ring = ModularRing(3)
    value = evaluate(expression, ring)
    laid = laid_out(expression)
    assert laid.at(ring.prime, lambda atom: evaluate(atom, ring)) == int(value)


def test_layouts_that_are_met_often_have_the_same_values() -> None:
    """From some value on a polynomial of FLINT takes the place of the sum."""
    expression = parse(
        "3*a^2*sin(q) - 1/2*b*cos(q)^3 + 7*a - 5/3*b^2*c + a*b*c - c^4*sin(q) "
        "+ (a + b - c)^2*b^-1 + a*cos(q) - a*cos(q) + 2*c"
    )
    laid = laid_out(expression)
    for seed in range(9):
        ring = ModularRing(seed)
        value = laid.at(ring.prime, partial(evaluate, ring=ring))
        assert value == int(evaluate(expression, ring))
    assert callable(laid.polynomials[ModularRing(0).prime])


def test_layouts_at_roots_have_the_values_at_each() -> None:
    laid = laid_out(parse("3*a^2*b - 1/2*b^3 + (a - 7)^2*c + 4"))

    def at(t: Any) -> bool:
        values = {parse("a"): t, parse("b"): 11, parse("c"): 13}
        half = nmod(1, PRIME) / nmod(2, PRIME)
        expected = t * t * 33 + (t - 7) * (t - 7) * 13 + (4 - half * 11**3)
        return bool(laid.at(PRIME, values.__getitem__) == expected)

    assert at_all_roots(polynomial(3, 4, 5), at) == [True]
