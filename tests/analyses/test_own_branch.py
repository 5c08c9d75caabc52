"""Closing equations with several components, and the one that a mechanism moves on."""

from __future__ import annotations

from screwkit.analyses.graph_schemes import graph_schemes
from screwkit.analyses.own_branch import MOVES_ALL_ALONG
from screwkit.analyses.tied_branch import tied_graph
from screwkit.analyses.tied_singularities import tied_actuation
from screwkit.case import load_text

KITE = """
screwkit: 1
name: kite
title: Spherical four-bar of arcs 45, 45, 60 and 60 degrees, turned about a side's axis
geometry: reference
base: b3
platform: b0
links: [b0, b1, b2, b3]
joints:
  - {name: J0, type: revolute, parent: b1, child: b0, point: [0, 0, 0],
     axis: [1, 1, 0], variable: x0}
  - {name: J1, type: revolute, parent: b2, child: b1, point: [0, 0, 0],
     axis: [0, 1, 1], variable: x1}
  - {name: J2, type: universal, parent: b3, child: b2, point: [0, 0, 0],
     axes: [[1, 0, 0], [1, 0, 1]], variable: [x2_1, x2_2]}
  - {name: J3, type: revolute, parent: b3, child: b0, point: [0, 0, 0],
     axis: [1, 0, 0], variable: x3}
actuated: ["J2:0"]
"""


def test_what_holds_on_a_folded_branch_is_not_said_of_the_open_one() -> None:
    """J3 and the first axis of J2 both turn about x, the four-bar with them.

    With another joint locked all turns about x as one; with J2:0 locked the four-bar
    moves.  Folded, with J0 on the second axis of J2, the platform would be still; from
    the posture of the file it is folded at single postures alone.
    """
    graph = tied_graph(load_text(KITE).network)
    answer, _ = tied_actuation(graph, ["J2:0"])
    assert not answer.admissible
    assert answer.witness == MOVES_ALL_ALONG
    found = {scheme.actuated: scheme for scheme in graph_schemes(graph).schemes}
    assert [x for x, scheme in found.items() if scheme.admissible] == [("J3",)]
    assert found["J2:0",].reason == MOVES_ALL_ALONG
