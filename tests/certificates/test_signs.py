"""Expressions that vanish nowhere, against values at random places."""

from __future__ import annotations

import pytest

from screwkit.algebra.parse import parse
from screwkit.certificates.signs import Signs

SIGNS = Signs({"a", "b"}, {"a", "b", "c"})


@pytest.mark.parametrize(
    "text",
    [
        "a",
        "-a*b^2",
        "c",
        "a^2 + x^2",
        "a*x^2 + b",
        "c*x^2 + c*a",
        "sqrt(2)*a + b",
        "3 + sin(q)^2",
        "-a - b*cos(q)^4",
        "sqrt(a^2 + x^2)",
        "cos(pi/5)*a",
        "x^2 - x + 2",
        "a*x^4 - a*x + a",
        "3 + sin(p)*sin(q)",
        "3*a + b + a*sin(p)*sin(q)",
        "-3*c + c*sin(p)^2*cos(q) - c*cos(p)",
        "3/2 + sin(p)*sin(q) + cos(q)",  # −√2 at least, of what follows 3/2
    ],
)
def test_never_zero(text: str) -> None:
    assert SIGNS.never_zero(parse(text))


@pytest.mark.parametrize(
    "text",
    [
        "x",
        "a - b",
        "x^2",
        "a + c",
        "a*x",
        "x^2 + y^2",
        "sin(q) + 1",
        "cos(q) + 1",
        "sin(q) + sin(p) + 2",
        "c*x^2 + a",
        "sqrt(x)",
        "a + b*x",
        "0*a",
        "cos(2*pi/3)*a - b",
        "x^2 - 3*x + 1",
        "x^2 - 2*x + 1",
        "x^3 - x + 7",
        "x^2 - x*y + 2",
        "x^50 - x + 2",
        "1 + sin(p)*sin(q)",
        "3*a - b + a*sin(p)*sin(q)",
        "c + 3*a + c*sin(q)",
        "7/5 + sin(p)*sin(q) + cos(q)",
        "3 + x*sin(q)",
    ],
)
def test_no_proof_where_it_may_vanish_or_is_not_plain(text: str) -> None:
    assert not SIGNS.never_zero(parse(text))
