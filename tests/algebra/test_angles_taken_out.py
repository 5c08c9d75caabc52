"""One angle after the other taken out of conditions that share all of theirs.

A spherical robot with three R-R-R legs, two of which are stretched or folded: each of
the first two conditions fixes the turn of such a leg up to half a turn, and the third
one says that the normals of all legs are parallel to one plane.  Without q and r that
is a curve in p and t.
"""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin

import numpy as np
import pytest
from loci.numeric import value
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.decomposition import common_zeros, other_parts
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search

LEGS = (
    "sin(p)*sin(q)*cos(t) + cos(p)*sin(q) + cos(q)*sin(t)",
    "cos(p)*cos(r)*sin(t) - sin(p)*cos(r) - sin(r)*cos(t)",
)
ONE_PLANE = "sin(p)*sin(q)*sin(r) - cos(p)*cos(q)*cos(r)"


def postures() -> list[dict[str, float]]:
    """Solved by hand: q and r by the legs, t by what that leaves of the third."""
    source = np.random.default_rng(5)
    found = []
    for p in source.uniform(-pi, pi, 12):
        # sin²p·sin t − cos²p·cos t = sin p·cos p
        a, b, c = sin(p) ** 2, -(cos(p) ** 2), sin(p) * cos(p)
        t = atan2(a, b) + source.choice([-1, 1]) * np.arccos(c / hypot(a, b))
        q = atan2(-sin(t), sin(p) * cos(t) + cos(p)) + pi * source.integers(2)
        r = atan2(cos(p) * sin(t) - sin(p), cos(t)) + pi * source.integers(2)
        found.append({"p": float(p), "t": float(t), "q": float(q), "r": float(r)})
    return found


@pytest.mark.parametrize("budget", [80, 600])
def test_a_curve_that_no_factor_shows(budget: int) -> None:
    """All of it is found; where the search comes back to a branch it is known."""
    ring, conditions = in_one_ring(*LEGS, ONE_PLANE)
    search = Search(FactorLibrary(ring), budget=budget, further=True)
    zeros = common_zeros(Branch(ring, Assumptions(frozenset())), conditions, search)
    assert zeros.complete
    curves = [b for b in zeros.branches if b.codimension == 3]
    told = [[text(ring, e) for e in branch.equations(())] for branch in curves]
    for at in postures():
        assert all(abs(value(e, at)) < 1e-9 for e in (*LEGS, ONE_PLANE))
        assert any(all(abs(value(e, at)) < 1e-9 for e in own) for own in told)
        beside = at | {"t": at["t"] + 0.1}
        assert not any(all(abs(value(e, beside)) < 1e-9 for e in own) for own in told)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 0, 1), (1, 2, 0)])
def test_parts_are_told_in_any_order(order: tuple[int, int, int]) -> None:
    """Two legs fix q and r, and m is on its own in the third condition."""
    texts = (*LEGS, "sin(m)*sin(q)*sin(r) - cos(m)*cos(q)*cos(r)")
    ring, conditions = in_one_ring(*texts)
    branch = Branch(ring, Assumptions(frozenset()))
    for place in order:
        (branch,) = restricted(branch, conditions[place])
    assert len(branch.pending) == 3
    assert other_parts(branch, Search(FactorLibrary(ring))) == ()
