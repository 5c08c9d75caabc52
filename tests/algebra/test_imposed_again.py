"""Conditions in half angles whose equations are imposed again, and what has no root."""

from __future__ import annotations

import pytest
from loci.numeric import value
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.no_common_root import have_no_common_root
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search, imposed


def test_a_half_angle_that_is_a_product_later() -> None:
    """tan(q/2) = a/b, and then b = 0: q = π, or a is 0 too and q is free."""
    ring, (turn, length) = in_one_ring("a*sin(q) - b*(1 - cos(q))", "b")
    search = Search(FactorLibrary(ring))
    root = Branch(ring, Assumptions(frozenset()))
    (along,) = [
        branch
        for branch in imposed(root, turn, search)
        if any(pending.companions for pending in branch.pending)
    ]
    parts = imposed(along, length, search)
    assert not search.unfinished
    told = [[text(ring, e) for e in part.equations(part_of(part))] for part in parts]

    def lies_on_one(**at: float) -> bool:
        return any(all(abs(value(e, at)) < 1e-9 for e in own) for own in told)

    assert lies_on_one(a=2.0, b=0.0, q=3.141592653589793)
    assert lies_on_one(a=0.0, b=0.0, q=0.7)
    assert not lies_on_one(a=2.0, b=0.0, q=0.0)
    assert not lies_on_one(a=2.0, b=1.0, q=3.141592653589793)


def part_of(branch: Branch) -> list[str]:
    """Texts of all sheets: those that tell q = π from q = 0."""
    return [str(sheet) for sheet in branch.sheets]


@pytest.mark.parametrize(
    ("texts", "is_empty"),
    [
        (("x^2 - 2", "x - 1"), True),
        (("x^2 - 2", "x^3 - 2*x"), False),
        (("x^2 - 2", "y - 1"), False),
        (("cos(q)^3 - 4*cos(q)^2 + 2*cos(q)", "7*cos(q)^2 - 28*cos(q) + 23"), True),
        (("x*y - 1", "x"), False),  # nothing is said of two unknowns
    ],
)
def test_one_unknown_with_two_values(texts: tuple[str, ...], is_empty: bool) -> None:
    _, polynomials = in_one_ring(*texts)
    assert have_no_common_root(polynomials, ()) is is_empty
