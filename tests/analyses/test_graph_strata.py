"""Where components of joint graphs and limbs with loops inside meet, against floats."""

from __future__ import annotations

import numpy as np
import pytest
from analyses.test_strata import component_of, flagged
from loci.numeric import value
from loci.test_hybrid_loci import at, drawn, freedom, limb_at, mobility
from one_answer import with_strata

from screwkit.results.strata import Stratum

NAMES = ("watt_six_bar", "orthoglide", "palletizer_scara", "peaucellier")


@pytest.mark.parametrize("name", NAMES)
def test_all_numbers_are_those_of_a_real_posture_in_floats(name: str) -> None:
    answer, strata = with_strata(name)
    assert answer.actuation is not None
    locked = answer.actuation.actuated
    real = [one for one in strata.strata if one.real == "proved"]
    assert len(real) > len(strata.strata) / 2
    for one in real:
        here = dict(one.posture)
        for member in one.members:
            for text in component_of(answer, member).equations:
                assert value(text, here) == pytest.approx(0, abs=1e-9)
        state = one.state
        ranks = [freedom(limb_at(name, x.limb, here).platform()) for x in answer.limb]
        assert ranks == list(state.limb_ranks), one.equations
        assert freedom(at(name, here).platform()) == state.platform_freedom
        assert freedom(at(name, here).platform(locked)) == state.locked_freedom
        assert mobility(at(name, here)) == state.mobility


@pytest.mark.parametrize("name", NAMES)
def test_the_generic_state_is_that_of_a_random_posture(name: str) -> None:
    """Limbs count with the loops inside them closed, not by their joints."""
    answer, strata = with_strata(name)
    here = drawn(name, 7)
    ranks = [freedom(limb_at(name, x.limb, here).platform()) for x in answer.limb]
    assert ranks == list(strata.generic.limb_ranks)
    assert ranks == [limb.generic_rank for limb in answer.limb]
    assert mobility(at(name, here)) == strata.generic.mobility


def between(name: str, members: set[tuple[str, str, int]]) -> list[Stratum]:
    """The strata of codimension 2 on exactly these components."""
    _, strata = with_strata(name)
    return [
        one
        for one in strata.strata
        if {(m.part, m.limb, m.component) for m in one.members} == members
        and one.codimension == 2
    ]


def test_a_six_bar_with_its_first_crank_and_rocker_in_line() -> None:
    """B and C on the line of A and D: the four-bar is flat, and gains a freedom.

    The rank of the limb is lost where A, B and C are in line, and is back where D is on
    that line too: four pivots in line let coupler and rocker turn against each other.
    """
    members = {("limb", "limb_1", 0), ("constraint", "", 1), ("actuation", "", 1)}
    (flat,) = between("watt_six_bar", members)
    assert set(flat.equations) == {"yb", "yc"}
    assert flat.expected is not None
    assert flat.expected.limb_ranks == (1, 2)
    assert flat.state.limb_ranks == (2, 2)
    assert flat.differs


def test_a_flat_parallelogram_adds_to_a_limb() -> None:
    """One that gives the limb a freedom, one that gives none: together it has it."""
    name = "palletizer_scara"
    _, strata = with_strata(name)
    generic = strata.generic.limb_ranks
    checked = 0
    for one in strata.strata:
        alone = [
            s.state.limb_ranks
            for s in strata.strata
            if len(one.around) == 2 and set(s.itself) & set(one.around)
        ]
        if one.expected is None or not alone or min(min(x) for x in alone) < generic[0]:
            continue
        assert one.expected.limb_ranks == max(alone)
        checked += max(alone) > generic
    assert checked


@pytest.mark.parametrize("name", ["watt_six_bar", "peaucellier"])
def test_what_is_everywhere_does_not_change(name: str) -> None:
    _, strata = with_strata(name)
    for one in strata.strata:
        for inner in strata.strata:
            inside = set(one.members) < set(inner.members)
            if inside and one.holds == "everywhere":
                assert inner.state == one.state


def test_on_a_stratum_that_holds_everywhere_random_postures_agree() -> None:
    """Peaucellier's rods folded on each other: whatever m and w, six freedoms."""
    _, strata = with_strata("peaucellier")
    folded = next(s for s in strata.strata if s.equations == ("cos(phi) + 1",))
    assert folded.holds == "everywhere"
    for seed in range(6):
        here = {**drawn("peaucellier", seed), "phi": np.pi}
        assert mobility(at("peaucellier", here)) == folded.state.mobility


def test_flags_of_a_graph_are_raised_where_numbers_differ() -> None:
    _, strata = with_strata("orthoglide")
    assert not flagged(strata)  # its limbs are independent of each other
    _, six_bar = with_strata("watt_six_bar")
    assert flagged(six_bar)
