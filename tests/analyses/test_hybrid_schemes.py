"""Schemes of limbs with loops inside, against all loop equations in floats."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from loci.numeric import value
from loci.test_hybrid_loci import at, drawn, freedom, mobility, on_equation

import screwkit as sk
from screwkit.questions import schemes
from screwkit.results.schemes import Scheme, Schemes

NAME = "orthoglide"


@cache
def answer(*candidates: str) -> Schemes:
    return schemes(sk.load(NAME), candidates=list(candidates))


def few() -> tuple[Scheme, ...]:
    return answer("P1", "P2", "P3", "Rb2").schemes


@pytest.mark.parametrize("number", range(4))
def test_loci_are_where_more_moves(number: int) -> None:
    scheme = few()[number]
    generic = at(NAME, drawn(NAME, 5))
    assert scheme.admissible == (not freedom(generic.platform(scheme.actuated)))
    assert scheme.locus
    for seed, equation in enumerate(scheme.locus):
        here = at(NAME, on_equation(NAME, equation, seed))
        assert mobility(here, scheme.actuated) > mobility(generic, scheme.actuated)
        moves = freedom(here.platform(scheme.actuated))
        assert (not moves) == (equation in scheme.idle)


def test_the_locus_is_not_a_square() -> None:
    """The slides alone: one irreducible factor, which changes its sign."""
    (scheme,) = [s for s in few() if s.actuated == ("P1", "P2", "P3")]
    (equation,) = scheme.locus
    values = [value(equation, drawn(NAME, seed)) for seed in range(30)]
    assert np.min(values) < 0 < np.max(values)


def test_the_declared_scheme_is_looked_at_first() -> None:
    """With work for one locus alone it is that of the actuators of the file."""
    case = sk.load(NAME)
    found = schemes(case, candidates=["P1", "P2", "Rb2", "P3"], work=1)
    decided = [s.actuated for s in found.schemes if not s.undecided]
    assert decided == [case.mechanism.actuated] == [("P1", "P2", "P3")]


def test_two_joints_of_a_parallelogram_hold_the_same() -> None:
    found = answer("P1", "P2", "p1_1", "m1_1")
    wasted = [s for s in found.schemes if {"p1_1", "m1_1"} <= {*s.actuated}]
    assert len(wasted) == 2
    for scheme in wasted:
        assert freedom(at(NAME, drawn(NAME, 1)).platform(scheme.actuated))
        assert not scheme.admissible
        assert "p1_1 and m1_1 hold the same freedom" in str(scheme.reason)
