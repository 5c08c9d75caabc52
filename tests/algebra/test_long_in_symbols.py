"""Long polynomials in symbols alone, beside a symbol whose inverse the ring has."""

from __future__ import annotations

import pytest
from one_ring import in_one_ring

from screwkit.algebra.factors import factor

SQUARES = "(1 + 2*x^2 + 3*y^2 + 5*z^2 + 7*u^2 + 11*v^2)^9"


@pytest.mark.parametrize(
    ("last", "parts"),
    [
        ("x^2*y^4 + 1", 1),  # linear in no symbol: factored as it stands
        ("w*(x^2*y^4 + 1)", 1),  # linear in w, with coprime coefficients
    ],
)
def test_factors_are_proved_irreducible(last: str, parts: int) -> None:
    ring, (polynomial, _) = in_one_ring(f"{SQUARES} + {last}", "1/(1 + u^2)")
    assert len(polynomial) > 2_000
    found = factor(ring, polynomial)
    assert found.certified
    assert len(found.factors) == parts


def test_a_factor_free_of_the_linear_symbol_is_found() -> None:
    ring, (polynomial, _) = in_one_ring(
        f"(t^2 + x)*({SQUARES} + w*(x^2*y^4 + 1))", "1/(1 + u^2)"
    )
    found = factor(ring, polynomial)
    assert found.certified
    assert len(found.factors) == 2
    assert found.expand(ring) == polynomial
