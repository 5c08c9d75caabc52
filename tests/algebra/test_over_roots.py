"""Factors over square roots of numbers: products give back what they were made of."""

from __future__ import annotations

from typing import Any

import pytest
from flint import Ordering, fmpq_mpoly_ctx

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factors import factor as factored
from screwkit.algebra.over_roots import Root, factors_over_roots
from screwkit.algebra.parse import parse
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing

NAMES = ("x", "y", "r2", "r3")
CONTEXT = fmpq_mpoly_ctx.get(NAMES, Ordering.lex)
X, Y, R2, R3 = CONTEXT.gens()
TWO, THREE = Root(2, 2), Root(3, 3)


def reduced(value: Any) -> Any:
    """With r2² = 2 and r3² = 3."""
    for root, square in ((R2, 2), (R3, 3)):
        value = divmod(value, root**2 - square)[1]
    return value


def product(factors: list[tuple[Any, int]]) -> Any:
    total = CONTEXT.constant(1)
    for factor, multiplicity in factors:
        for _ in range(multiplicity):
            total = reduced(total * factor)
    return total


def parts(polynomial: Any, roots: tuple[Root, ...]) -> list[tuple[Any, int]]:
    found = factors_over_roots(polynomial, NAMES, roots)
    assert found is not None
    return found


def is_multiple(one: Any, two: Any) -> bool:
    """Proportional by a number of the field: their cross products with it agree."""
    lead_one, lead_two = (
        sum(
            (
                CONTEXT.from_dict({(0, 0, *key[2:]): value})
                for key, value in p.to_dict().items()
                if tuple(key[:2]) == max(tuple(k[:2]) for k in p.to_dict())
            ),
            CONTEXT.constant(0),
        )
        for p in (one, two)
    )
    return bool(reduced(one * lead_two) == reduced(two * lead_one))


@pytest.mark.parametrize(
    ("wanted", "roots"),
    [
        ([(2 * X - R3, 1), (2 * X + R3, 1)], (THREE,)),
        ([(X + R3 * Y, 2), (X - Y, 1)], (THREE,)),
        ([(X + R3 * Y, 1), (X**2 - 2 * R3 * Y + 5, 1)], (THREE,)),
        ([(X - R2 * R3, 1), (X + R2 * R3, 1)], (TWO, THREE)),
        ([(R2 * X + R3 * Y - 1, 1), (R3 * X**2 - R2 * Y + Y**3, 1)], (TWO, THREE)),
    ],
)
def test_a_product_is_taken_apart(
    wanted: list[tuple[Any, int]], roots: tuple[Root, ...]
) -> None:
    """Linear in a variable with coprime coefficients: each factor is irreducible."""
    whole = product(wanted)
    found = parts(whole, roots)
    assert sorted(m for _, m in found) == sorted(m for _, m in wanted)
    for factor, multiplicity in wanted:
        assert any(is_multiple(f, factor) and m == multiplicity for f, m in found)
    assert is_multiple(product(found), whole)


def test_what_has_no_root_there_stays_whole() -> None:
    """√2 lies in Q(√2, √3) and not in Q(√3)."""
    assert [m for _, m in parts(X**2 - 2, (THREE,))] == [1]
    assert len(parts(X**2 - 2, (TWO, THREE))) == 2


def test_the_minimal_polynomial_of_a_sum_of_roots() -> None:
    """x⁴ − 10x² + 1 has the roots ±√2 ± √3."""
    found = parts(X**4 - 10 * X**2 + 1, (TWO, THREE))
    assert len(found) == 4
    for factor, _ in found:
        root = X - factor
        assert reduced((root**2 - 5) ** 2) == 24


def test_the_factors_of_a_ring_multiply_to_the_polynomial() -> None:
    """Also where the leading coefficients are irrational."""
    text = "(sqrt(3)*x + (1 + sqrt(2))*y)*(sqrt(2)*x - sqrt(3)*y*cos(q))"
    seen = SurveyRing()
    evaluate(parse(text), seen)
    ring = TrigonometricRing(seen)
    polynomial = ring.normal(evaluate(parse(text), ring))
    found = factored(ring, polynomial)
    assert found.expand(ring) == polynomial
    assert len(found.factors) == 2
    assert found.certified
