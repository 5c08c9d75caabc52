"""Where sets meet, in real postures alone."""

from __future__ import annotations

import pytest
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.search import Search
from screwkit.loci.meetings import Meetings, recovered


@pytest.mark.parametrize(
    ("condition", "met"),
    [
        ("sqrt(2)*x*cos(q) - sqrt(3)", 0),  # cos q would be 1.22
        ("cos(q) + x*sin(q) - sqrt(3)", 0),  # and this at most the root of 2
        ("sqrt(2)*x*sin(q) - 1", 2),  # q = pi/4 and 3*pi/4
        ("cos(q) + x*sin(q) - 1", 2),  # q = 0 and q = pi/2
        ("x*y^2 + 3", 0),
        ("x*y^2 - 3", 1),
    ],
)
def test_what_complex_postures_alone_share_is_no_meeting(
    condition: str, met: int
) -> None:
    ring, (first, second) = in_one_ring(condition, "x - 1")
    root = Branch(ring, Assumptions(frozenset()))
    search = Search(FactorLibrary(ring))
    places = [recovered(root, [p], 1, search) for p in (first, second)]
    assert all(places)
    found = Meetings(search, [p for p in places if p], 5, 100).up_to(2)
    assert len(found) == 2 + met
