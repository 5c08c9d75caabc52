"""What all entries of a column share is found, even where a normal form hides it."""

from __future__ import annotations

from typing import Any

import pytest
from one_ring import in_one_ring

from screwkit.algebra import common_factors
from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.factors import FactorLibrary, factor


@pytest.mark.parametrize(
    "shared",
    ["sin(q)", "cos(q)", "a*sin(q) + b*cos(q)", "sin(q)^2", "a + sin(q)", "sin(p - q)"],
)
@pytest.mark.parametrize(
    "rest",
    [
        ("sin(q)", "cos(q)", "a"),
        ("a*sin(q)", "b", "1 + a*b"),
        ("cos(p)", "sin(q)", "0"),
    ],
)
def test_a_shared_factor_is_divided_out(shared: str, rest: tuple[str, ...]) -> None:
    texts = [f"({shared})*({entry})" for entry in rest]
    ring, both = in_one_ring(*texts, *rest, shared)
    product, plain = both[: len(rest)], both[len(rest) : 2 * len(rest)]
    found = list(without_common_factors(ring, product))
    assert max(map(len, found)) <= max(map(len, plain))
    for one, other in ((found, plain), (found, product)):
        for a, b in zip(one, other, strict=True):
            for c, d in zip(one, other, strict=True):
                assert ring.normal(a * d - c * b) == 0


def test_the_same_column_is_asked_once_for_each_library(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    ring, column = in_one_ring("a*sin(q)", "b*sin(q)", "sin(q)^2")
    asked = []

    def counted(*given: Any) -> Any:
        asked.append(given)
        return factor(*given)

    monkeypatch.setattr(common_factors, "factor", counted)
    first, second = FactorLibrary(ring), FactorLibrary(ring)
    found = [
        without_common_factors(ring, column, library)
        for library in (first, second, first, None, None, second)
    ]
    assert len(asked) == 3
    assert all(one == found[0] for one in found)
    assert without_common_factors(ring, column[1:], first) != found[0]


def test_columns_without_a_shared_factor_stay() -> None:
    ring, column = in_one_ring("sin(q)", "cos(q)", "a")
    assert list(without_common_factors(ring, column)) == column
