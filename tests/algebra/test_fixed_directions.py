"""Polynomials where links point along lines, with the angles kept that these fix.

The lines A_i B_i of three limbs of the 4-RUU, A = a·e and B = P + b·R(φ)·e on two
right-angled triangles, pass through one point where sin φ = 0 (the triangles are alike)
or where x² + y² = a² + b² − 2·a·b·cos φ: row i of the determinant of the lines is
affine in e_i, which leaves (P, a·b·sin φ) ∧ (b·R·i − a·i, a·y) ∧ (b·R·j − a·j, −a·x).
"""

from __future__ import annotations

import numpy as np
from algebra.test_case_distinctions import POSITIVE
from loci.numeric import value
from loci.test_wrench_blocks import A, B, drawn, on, robot
from one_ring import in_one_ring

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.decomposition import common_zeros, other_parts
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.fixed_directions import fixed_directions, occurs, parted
from screwkit.algebra.points import residue
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.wrench_blocks import block_minors

FIXED = "x*sin(q) + y*cos(q)"


def where_fixed(*texts: str) -> tuple[Branch, list[Polynomial]]:
    """A branch on which q is fixed and kept, and other polynomials."""
    ring, (condition, *others) = in_one_ring(FIXED, *texts)
    (branch,) = restricted(Branch(ring, POSITIVE, directed=True), condition)
    return branch, others


def test_concurrent_lines_are_a_condition_of_the_pose() -> None:
    case, limbs, _ = robot()
    ring = case.common_twists.ring
    library = case.library(ring)
    branch = on((1, 1, 1, 2))
    lists = block_minors(branch, limbs, 6, Search(library))
    assert lists is not None
    (concurrent,) = lists[-1]  # written in the angles of the three links alone
    fixed = [d for d in fixed_directions(branch) if occurs(ring, concurrent, d.angle)]
    assert len(fixed) == 3
    parts = parted(ring, concurrent, fixed, library)
    assert parts is not None
    condition, rest = text(ring, parts.content), text(ring, parts.rest)
    source = np.random.default_rng(11)
    for _ in range(4):
        at = drawn(source, (0, 1, 2))
        by_hand = np.sin(at["phi"]) * (
            at["x"] ** 2 + at["y"] ** 2 - A**2 - B**2 + 2 * A * B * np.cos(at["phi"])
        )
        # In either form: the content up to a constant, and the lines' determinant.
        assert abs(value(condition, at) - A * B * by_hand) < 1e-6 * abs(A * B * by_hand)
        assert abs(value(text(ring, concurrent), at)) > 1e-9
        assert abs(value(rest, at)) > 1e-9
    alike = drawn(source, (0, 1, 2)) | {"phi": 0.0}
    assert abs(value(condition, alike)) < 1e-9


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
