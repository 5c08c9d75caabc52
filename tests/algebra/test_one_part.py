"""What a condition leaves where angles are fixed up to half a turn.

With w = ±√N the condition x·sin q + y·cos q = 0 has the points cos q = x/w and
sin q = −y/w, N = x² + y²; m = x·cos q − y·sin q is w.
"""

from __future__ import annotations

import pytest
from algebra.test_case_distinctions import POSITIVE
from one_ring import in_one_ring

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.fixed_directions import Direction, fixed_directions
from screwkit.algebra.one_part import are_one_part, leaves_one_part
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

FIXED = "x*sin(q) + y*cos(q)"
SECOND = "z*sin(p) + t*cos(p)"


def where_fixed(
    condition: str, *fixed: str
) -> tuple[TrigonometricRing, Polynomial, Branch, list[Direction]]:
    ring, (last, *conditions) = in_one_ring(condition, *fixed)
    branch = Branch(ring, POSITIVE, directed=True)
    for own in conditions:
        (branch,) = restricted(branch, own)
    directions = fixed_directions(branch)
    assert len(directions) == len(fixed)
    return ring, last, branch, directions


@pytest.mark.parametrize(
    ("condition", "is_one"),
    [
        # l = −w·u, a graph.
        ("l + u*(x*cos(q) - y*sin(q))", True),
        # (w − u)·(l + w): both coefficients of l vanish where w = u.
        ("l*(x*cos(q) - y*sin(q)) - u*l + x^2 + y^2 - u*(x*cos(q) - y*sin(q))", False),
        # (w − u)·l + w + u: their norms are one, those of (l + 1)·w and l − 1 are not.
        ("l*(x*cos(q) - y*sin(q) - u) + x*cos(q) - y*sin(q) + u", True),
        # (x + u)·l + (x + u)·w
        ("(x + u)*(l + x*cos(q) - y*sin(q))", False),
        # l² = w² is two parts; nothing else is linear.
        ("l^2 - x^2 - y^2", False),
    ],
)
def test_norms_show_what_two_coefficients_share(condition: str, is_one: bool) -> None:
    _, last, branch, directions = where_fixed(condition, FIXED)
    assert leaves_one_part(branch, last, directions) is is_one


@pytest.mark.parametrize(
    ("second", "is_one"),
    [
        (SECOND, True),
        # Two links along one line have q = p or q = p + π.
        ("x*sin(p) + y*cos(p)", False),
        ("u*x*sin(p) + u*y*cos(p)", False),
        ("(x + y)*sin(p) + (x - y)*cos(p)", True),  # √2: q − p = π/4 and −3π/4
        ("(3*x + 4*y)*sin(p) + (4*x - 3*y)*cos(p)", False),
        # w² = (x² + z²)/2, no square whose denominator is one.
        ("(x + z)*sin(p)/2 + (x - z)*cos(p)/2", True),
    ],
)
def test_angles_that_fix_each_other_are_told(second: str, is_one: bool) -> None:
    _, _, branch, directions = where_fixed("l", FIXED, second)
    assert are_one_part(branch, directions) is is_one
