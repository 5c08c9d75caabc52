"""Where singularities of tied loops meet, against elementary geometry."""

from __future__ import annotations

from math import isclose, sqrt

import numpy as np
from loci.test_tied_loci import FIVE_BAR

from screwkit.case import load_text
from screwkit.questions import singularities
from screwkit.results.strata import Strata


def strata(text: str) -> Strata:
    found = singularities(load_text(text), strata=2).strata
    assert found is not None
    return found


def test_a_five_bar_is_dead_with_a_pair_in_line_where_four_pivots_are() -> None:
    """B, C, D in line and C, D, E too: |B E| is 2 √10 − √13, or √13 with C on E.

    Both can be reached by a crank of √5 about A, 4 from E; nothing else can.
    """
    found = strata(FIVE_BAR)
    assert found.complete
    (meeting,) = (one for one in found.strata if one.around)
    assert [member.part for member in meeting.members] == ["limb", "actuation"]
    assert meeting.state.limb_ranks == (2, 2)
    assert meeting.state.locked_freedom == 1
    assert meeting.codimension == 2
    assert meeting.real == "met"
    at = dict(meeting.posture)
    b = sqrt(5) * np.exp(1j * (at["q1"] + np.angle(-1 + 2j)))
    reach = abs(4 - b)
    reached = 2 * sqrt(10) - sqrt(13), sqrt(13)
    assert any(isclose(reach, own, abs_tol=1e-6) for own in reached)
    assert all(4 - sqrt(5) < own < 4 + sqrt(5) for own in reached)
    assert sqrt(13) + 2 * sqrt(10) > 4 + sqrt(5)


def test_no_two_conditions_meet_where_lengths_forbid_it() -> None:
    """With a shorter crank B reaches no such distance from E, but at complex angles."""
    found = strata(FIVE_BAR.replace("B: [-1, 2]", "B: [0, 1/10]"))
    lengths = abs(2 + 3.9j), sqrt(10), sqrt(10)
    sums = [abs(lengths[0] + s * lengths[1] + t * lengths[2]) for s, t in SIGNS]
    assert not any(3.9 <= own <= 4.1 for own in sums)
    assert found.complete
    assert not [one for one in found.strata if one.around]


SIGNS = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
