"""A condition that falls apart on another one: every part of its zeros is found."""

from __future__ import annotations

from math import sqrt

from loci.numeric import value

import screwkit as sk
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.search import Search
from screwkit.loci.pieces import pieces_of

# D, C and E in line, and B, C and D: all four are in line, or C is at D.
CONDITIONS = (
    "d*yc - d*yd + xc*yd - xd*yc",
    "xb*yc - xb*yd - xc*yb + xc*yd + xd*yb - xd*yc",
)


def test_points_in_line_and_points_that_coincide_are_two_pieces() -> None:
    assembly = sk.load("five_bar").assembly
    ring = assembly.common_twists.ring
    root, library = assembly.root(ring), assembly.library(ring)
    first, second = (ring.normal(evaluate(parse(t), ring)) for t in CONDITIONS)
    one = common_zeros(root, [first], Search(library)).branches
    assert len(one) == 1
    zeros = common_zeros(one[0], [one[0].value(second)], Search(library))
    assert zeros.complete
    pieces = pieces_of(zeros.branches)
    assert [piece.codimension for piece in pieces] == [2, 2]
    pairs = (("xc", "xd"), ("yc", "yd"))
    coincide = {str(ring.symbol(a) - ring.symbol(b)) for a, b in pairs}
    assert sum({str(e) for e in piece.equations} == coincide for piece in pieces) == 1


def test_what_turns_into_each_other_is_found_three_times() -> None:
    """The head has three legs alike: so do the sets on which two of them are singular.

    In u and v a third of a turn leads from u = 0 to u = √3 v and to u = -√3 v.
    """
    part = sk.singularities(sk.load("sprint_z3")).constraint
    assert part.complete
    legs = [
        c.equations for c in part.components if sum("h" in e for e in c.equations) == 2
    ]
    last = [equations[-1] for equations in legs]
    short = [text for text in last if not set(text) & set("bhz")]
    for u in (0.0, sqrt(3), -sqrt(3)):
        on = [t for t in short if abs(value(t, {"u": u, "v": 1.0})) < 1e-12]
        assert len(on) == 1
