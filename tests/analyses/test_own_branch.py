"""Closing equations with several components, and the one that a mechanism moves on."""

from __future__ import annotations

from screwkit.analyses.graph_schemes import graph_schemes
from screwkit.analyses.own_branch import MOVES_ALL_ALONG
from screwkit.analyses.tied_branch import tied_graph
from screwkit.analyses.tied_singularities import tied_actuation
from screwkit.case import load_text
from screwkit.results.schemes import Schemes

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


COAXIAL = """
screwkit: 1
name: coaxial
title: A hinge on the line of a cross's arm
geometry: reference
base: b2
platform: b0
links: [b0, b1, b2]
joints:
  - {name: J0, type: revolute, parent: b0, child: b1, point: [0, 0, 0],
     axis: [0, 0, 1], variable: x0}
  - {name: J2, type: universal, parent: b0, child: b2, point: [0, 0, 0],
     axes: [[1, 1, 1], [3, 4, 0]], variable: [x2_1, x2_2]}
  - {name: J1, type: revolute, parent: b2, child: b1, point: [0, 0, 0],
     axis: [1, 1, 1], variable: x1}
actuated: [J1, J0]
"""

SLIDER_CRANK = """
screwkit: 1
name: slider_crank
space: planar
geometry: reference
base: ground
platform: rod
links: [ground, crank, rod, block]
joints:
  - {name: crank, type: revolute, parent: ground, child: crank, point: [0, 0]}
  - {name: pin, type: revolute, parent: crank, child: rod, point: [0, 1]}
  - {name: wrist, type: revolute, parent: rod, child: block, point: [3, 0]}
  - {name: slide, type: prismatic, parent: ground, child: block, axis: [1, 0]}
actuated: [crank]
"""


def test_exact_postures_of_least_freedom_are_special() -> None:
    """J3 and the first axis of J2 both turn about x, the four-bar with them.

    With another joint locked all turns about x as one; with J2:0 locked the four-bar
    moves.  Folded, with J0 on the second axis of J2, the platform would be still.
    """
    graph = tied_graph(load_text(KITE).network)
    answer, _ = tied_actuation(graph, ["J2:0"])
    assert not answer.admissible
    found = graph_schemes(graph).schemes
    assert [x.actuated for x in found if x.admissible] == [("J3",)]


def test_what_holds_on_another_branch_is_not_said_of_the_own() -> None:
    """From the posture of the file b0 and b1 spin about [1, 1, 1] as one.

    J0 and the second axis of J2 never turn then; on the other branch they do.
    """
    graph = tied_graph(load_text(COAXIAL).network)
    answer, _ = tied_actuation(graph, ["J0"])
    assert (answer.admissible, answer.witness) == (False, MOVES_ALL_ALONG)
    found = {x.actuated: x for x in graph_schemes(graph).schemes}
    holding = {x for (x,), scheme in found.items() if scheme.admissible}
    assert holding == {"J1", "J2:0"}
    assert found["J2:1",].reason == MOVES_ALL_ALONG


def test_schemes_without_a_locus_yet_are_not_said_to_be_never_singular() -> None:
    """A crank with a rod on a slide is dead in line, whatever time there was."""
    early: list[Schemes] = []
    found = graph_schemes(
        tied_graph(load_text(SLIDER_CRANK).network),
        finished=lambda name, part: early.append(part),
    )
    assert {x.actuated: len(x.locus) for x in found.schemes}["slide",] == 1
    (known,) = early
    assert not known.complete
    assert all(scheme.undecided for scheme in known.schemes if scheme.admissible)
    assert known.admissible == found.admissible
