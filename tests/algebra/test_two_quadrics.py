"""Two quadratic conditions in the same unknowns, as directions of a turned body are.

With Rodrigues' parameters x, y, z the condition that a line of the platform is parallel
to a fixed one is two quadrics, which share two real lines.
"""

from __future__ import annotations

from itertools import pairwise

from algebra.test_case_distinctions import POSITIVE
from one_ring import in_one_ring

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.nowhere_zero import is_excluded
from screwkit.algebra.points import residue
from screwkit.algebra.search import Search
from screwkit.algebra.splitting import split_difference
from screwkit.algebra.trigonometric import primitive

# With t = x + z the first is t² + 1 − y² − 2·y + 2·z² − 4·t·z, the second t² − 2·z²
# + y² − 2·y − 1: where t² = 2 and y = 1 − t·z both are 0.  Other lines are not real.
QUADRICS = "x^2 - 2*x*z - y^2 - 2*y - z^2 + 1", "x^2 + 2*x*z + y^2 - 2*y - z^2 - 1"
LINES = "(x + z)^2 - 2", "y - 1 + (x + z)*z"


def test_lines_that_quadrics_share_are_found() -> None:
    ring, (*quadrics, square, line) = in_one_ring(*QUADRICS, *LINES)
    whole = Branch(ring, POSITIVE, thorough=True)
    search = Search(FactorLibrary(ring), further=True)
    zeros = common_zeros(whole, quadrics, search)
    assert zeros.complete
    assert sum(found.codimension == 2 for found in zeros.branches) == 1
    for point, prime in (at for found in zeros.branches for at in found.points):
        assert not any(residue(q, point, prime) for q in (*quadrics, square, line))


def test_a_difference_is_solved_beside_one_of_the_conditions() -> None:
    """First less second: −4·x·z − 2·y² + 2 = 0, solved for x where z is not 0."""
    ring, (first, second, wanted, z, rest) = in_one_ring(
        *QUADRICS, "4*x*z + 2*y^2 - 2", "z", "y^2 - 1"
    )
    (branch,) = restricted(Branch(ring, POSITIVE, thorough=True), first)
    (branch,) = restricted(branch, second)
    parts = split_difference(branch)
    assert parts is not None
    factor, left = parts.left
    assert factor in (4 * z, -4 * z)
    assert left in (2 * rest, -2 * rest)
    assert parts.solved is not None
    assert parts.solved.codimension == 1
    assert parts.solved.value(wanted) == 0
    # What is left of the two is one condition on y and z.
    one, two = (primitive(parts.solved.value(p)) for p in (first, second))
    assert one in (two, -two)
    assert not one.degrees()[ring.names.index("x0")]


def test_points_show_both_parts_of_two_conditions() -> None:
    """(x + z)² = 2 and 2·z² = (y − 1)²: y − 1 is (x + z)·z, or its opposite."""
    ring, (*conditions, one, other) = in_one_ring(
        "(x + z)^2 - 2", "2*z^2 - (y - 1)^2", "y - 1 - (x + z)*z", "y - 1 + (x + z)*z"
    )
    branch = Branch(ring, POSITIVE)
    for condition in reversed(conditions):
        (branch,) = restricted(branch, condition)
    seen = [[not residue(p, *at) for p in (one, other)] for at in branch.points]
    assert all(sum(own) == 1 for own in seen)
    assert any(a != b for a, b in pairwise(seen))


def test_a_branch_is_empty_where_a_step_would_divide_by_zero() -> None:
    """x·sin q = b·cos q is solved for x; sin q = 0 afterwards leaves b = 0."""
    ring, (condition, sine) = in_one_ring("x*sin(q) - b*cos(q)", "sin(q)")
    (solved,) = restricted(Branch(ring, POSITIVE), condition)
    assert not is_excluded(solved, [])
    parts = restricted(solved, sine)
    assert parts
    assert all(is_excluded(part, []) for part in parts)
    assert not any(part.points for part in parts)
