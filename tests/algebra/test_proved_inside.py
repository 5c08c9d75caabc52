"""What is passed over for the points of a branch is proved to lie in a known set."""

from __future__ import annotations

from algebra.test_case_distinctions import POSITIVE
from one_ring import in_one_ring

from screwkit.algebra.branches import Branch, Pending, restricted
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.points import residue
from screwkit.algebra.proved_inside import left_over
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.pieces import Piece, lies_in, surely_in

# sin r times the third is a·(second) + cos(p)·(first): the third vanishes with them, or
# sin r = 0; and then cos s = 0, since cos r is not 0 as well.
FIRST = "b*sin(r) + a*cos(r)*cos(s)"
SECOND = "sin(p)*sin(r) - cos(p)*cos(r)*cos(s)"
KNOWN = "a*sin(p) + b*cos(p)"


def system(*texts: str) -> tuple[Branch, list[Polynomial]]:
    """A branch on which the first two are pending, and the others."""
    ring, (first, second, *others) = in_one_ring(*texts)
    pending = Pending(first, first), Pending(second, second)
    conditions = first, second
    return Branch(ring, POSITIVE, conditions=conditions, pending=pending), others


def test_points_of_a_branch_show_one_part_of_it() -> None:
    branch, (known,) = system(FIRST, SECOND, KNOWN)
    root = Branch(branch.ring, POSITIVE)
    piece = Piece((known,), tuple(restricted(root, known)))
    assert lies_in(branch, piece)
    assert not surely_in(branch, piece)


def test_what_is_left_over_holds_the_other_part() -> None:
    branch, (known, *other) = system(FIRST, SECOND, KNOWN, "sin(r)", "cos(s)")
    systems = left_over(branch, [(known,)])
    assert systems is not None
    root, search = Branch(branch.ring, POSITIVE), Search(FactorLibrary(branch.ring))
    parts: list[Branch] = []
    for one in systems:
        zeros = common_zeros(root, one, search)
        assert zeros.complete
        parts += zeros.branches
    assert parts
    for part in parts:
        assert {str(c) for c in part.conditions} == {str(c) for c in other}
        assert any(residue(known, *point) for point in part.points)


def test_a_search_goes_on_where_a_branch_leaves_the_known_set() -> None:
    branch, (known, sine, cosine) = system(FIRST, SECOND, KNOWN, "sin(r)", "cos(s)")
    root, library = Branch(branch.ring, POSITIVE), FactorLibrary(branch.ring)
    piece = Piece((known,), tuple(restricted(root, known)))
    search = Search(library, skip=lambda own: lies_in(own, piece))
    search.inside = lambda own: [piece.equations] if lies_in(own, piece) else []
    found = common_zeros(root, list(branch.conditions), search)
    assert found.complete
    assert any(
        {str(c) for c in part.conditions} == {str(sine), str(cosine)}
        for part in found.branches
    )


def test_a_sum_of_the_conditions_leaves_nothing_over() -> None:
    """The third is x times the first, less the second."""
    branch, (both,) = system(
        "x^2 + y^3 + a*sin(p)",
        "x*y^3 + b*cos(p)*y + a*sin(s)",
        "x^3 + a*x*sin(p) - b*cos(p)*y - a*sin(s)",
    )
    assert left_over(branch, [(both,)]) == []
    assert surely_in(branch, Piece((both,), ()))


def test_points_on_a_condition_with_an_angle_that_is_a_number() -> None:
    """On cos p = 1/3 the sine is a root, whatever else is moved."""
    ring, (number, circle) = in_one_ring("3*cos(p) - 1", "x^2 + y^2*sin(p) - a^2")
    (on_number,) = restricted(Branch(ring, POSITIVE), number)
    (both,) = restricted(on_number, on_number.value(circle))
    assert both.pending
    assert both.points
    assert not any(residue(e, *at) for at in both.points for e in (number, circle))
