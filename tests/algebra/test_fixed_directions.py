"""Polynomials where links point along lines, with the angles kept that these fix.

The lines A_i B_i of three limbs of the 4-RUU, A = a·e and B = P + b·R(φ)·e on two
right-angled triangles, pass through one point where sin φ = 0 (the triangles are alike)
or where x² + y² = a² + b² − 2·a·b·cos φ: row i of the determinant of the lines is
affine in e_i, which leaves (P, a·b·sin φ) ∧ (b·R·i − a·i, a·y) ∧ (b·R·j − a·j, −a·x).
"""

from __future__ import annotations

import pytest
from algebra.test_case_distinctions import POSITIVE
from one_ring import in_one_ring

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.decomposition import common_zeros, other_parts
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.fixed_directions import (
    fixed_directions,
    parted,
    vanish_on_directions,
)
from screwkit.algebra.points import residue
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial

FIXED = "x*sin(q) + y*cos(q)"


def where_fixed(*texts: str) -> tuple[Branch, list[Polynomial]]:
    """A branch on which q is fixed and kept, and other polynomials."""
    ring, (condition, *others) = in_one_ring(FIXED, *texts)
    (branch,) = restricted(Branch(ring, POSITIVE, directed=True), condition)
    return branch, others


def test_concurrent_lines_are_a_condition_of_the_pose() -> None:
    turned = ("cos(f)", "sin(f)"), ("-sin(f)", "cos(f)"), ("-cos(f)", "-sin(f)")
    bases = [("a", "0"), ("0", "a"), ("-a", "0")]
    along, moments = [], []
    for k, ((c, s), (u, v)) in enumerate(zip(turned, bases, strict=True)):
        x, y = f"(x + b*({c}) - ({u}))", f"(y + b*({s}) - ({v}))"
        along.append(f"{x}*sin(t{k}) - {y}*cos(t{k})")
        moments.append(f"(({u})*sin(t{k}) - ({v})*cos(t{k}))")
    determinant = " + ".join(
        f"{moments[k]}*sin(t{(k + 2) % 3} - t{(k + 1) % 3})" for k in range(3)
    )
    circle = "a*b*sin(f)*(x^2 + y^2 - a^2 - b^2 + 2*a*b*cos(f))"
    ring, (lines, concurrent, *conditions) = in_one_ring(determinant, circle, *along)
    branch = Branch(ring, POSITIVE, directed=True)
    for condition in conditions:
        (branch,) = restricted(branch, condition)
    fixed = fixed_directions(branch)
    assert len(fixed) == 3
    parts = parted(ring, lines, fixed, FactorLibrary(ring))
    assert parts is not None
    assert condition_key(ring, parts.content) == condition_key(ring, concurrent)
    assert parts.rest.is_constant()


def test_what_is_left_is_written_in_the_angle_again() -> None:
    """On the branch the first is y·(t + l·(u·cos q − v·sin q)).

    The second is x·y·(1 − l/w); w is written where l is no sum of multiples of x and y.
    """
    branch, (turned, length, *left) = where_fixed(
        f"y*(t + l*(u*cos(q) - v*sin(q))) + z*({FIXED})",
        "x*(l*sin(q) + y)",
        "t + l*(u*cos(q) - v*sin(q))",
        "x*cos(q) - y*sin(q) - l",
    )
    ring, fixed = branch.ring, fixed_directions(branch)
    for polynomial, rest in zip((turned, length), left, strict=True):
        parts = parted(ring, polynomial, fixed, FactorLibrary(ring))
        assert parts is not None
        assert condition_key(ring, parts.rest) == condition_key(ring, rest)


def test_a_condition_that_divides_as_it_stands_is_left_alone() -> None:
    branch, (height,) = where_fixed("z*(sin(q) + 1)")
    ring = branch.ring
    fixed = fixed_directions(branch)
    assert len(fixed) == 1
    assert parted(ring, height, fixed, FactorLibrary(ring)) is None


def test_nothing_is_lost_where_an_angle_is_free() -> None:
    """The first is z·u·w on the branch; where x = y = 0 it vanishes with any z and u.

    There the second says t·z·cos q = 0, although z = 0 is a case elsewhere.
    """
    branch, (*left, x, y, z, t) = where_fixed(
        f"z*u*(x*cos(q) - y*sin(q)) + t*({FIXED})", "x^2 + y^2 + t*z*cos(q)", *"xyzt"
    )
    found = common_zeros(branch, left, Search(FactorLibrary(branch.ring)))
    assert found.complete
    for last in (z, t):
        assert any(
            part.codimension == 3
            and not any(residue(e, *at) for e in (x, y, last) for at in part.points)
            for part in found.branches
        )


def test_a_part_as_large_where_an_angle_is_free_is_seen() -> None:
    """Where x = y = 0 the second condition holds too, and shares no factor elsewhere.

    Both have codimension two, and the points of the branch show one alone.
    """
    branch, (second,) = where_fixed("x*z*sin(q) + y*t + x*u*cos(q)")
    (both,) = restricted(branch, second)
    assert len(both.pending) == 2
    search = Search(FactorLibrary(both.ring))
    parts = other_parts(both, search)
    names = {"x", "y"}
    assert parts is None or any(
        names <= {text(both.ring, c) for c in part.conditions} for part in parts
    )


@pytest.mark.parametrize(
    ("polynomial", "is_zero"),
    [
        # w² = x² + y² for w = x·cos q − y·sin q.
        ("(x*cos(q) - y*sin(q))^2 - 16", True),
        ("((x*cos(q) - y*sin(q))^2 - 16)*(u + cos(q))", True),
        ("x*cos(q) - y*sin(q) - 4", False),  # on one of two sheets
        ("(x*cos(q) - y*sin(q))^2 - 9", False),
    ],
)
def test_what_vanishes_over_a_circle(polynomial: str, is_zero: bool) -> None:
    """Where a direction is not (0, 0) and x² + y² = 16 no factor shows it."""
    branch, (circle, own) = where_fixed("x^2 + y^2 - 16", polynomial)
    (branch,) = restricted(branch, circle)
    directions = fixed_directions(branch)
    assert vanish_on_directions(branch, [own], directions) is is_zero
