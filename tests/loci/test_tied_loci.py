"""Singularities where loops tie joint variables, against elementary geometry.

Positions come from the law of cosines and from complex numbers; nothing of the engine's
kinematics is used.  A linkage of four pivots is dead for the joint that drives it where
the other three pivots are on one line.
"""

from __future__ import annotations

import cmath
from functools import cache
from itertools import product
from math import acos, atan, cos, isclose, pi, sin, sqrt

import numpy as np
import pytest
from loci.numeric import Array, value
from loci.searching import solved

from screwkit.algebra.points import residue
from screwkit.analyses.tied_singularities import tied_actuation
from screwkit.case import load_text
from screwkit.errors import UndecidedError
from screwkit.kinematics import tied_graph
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.questions import schemes, singularities
from screwkit.reports.conditions import at_closed_postures
from screwkit.results.singularities import Component, Singularities
from screwkit.results.solution import Solution

FOUR_BAR = """
screwkit: 1
name: four_bar
space: planar
geometry: mdh
base: ground
platform: coupler
links: [ground, crank, coupler, tip, rocker]
parameters:
  l1: {value: 4, positive: true}
  l2: {value: 3, positive: true}
  l3: {value: 4, positive: true}
  l4: {value: 4, positive: true}
joints:
  - {name: "1", type: revolute, parent: ground, child: crank, mdh: {}}
  - {name: "2", type: revolute, parent: crank, child: coupler, mdh: {d: l1}}
  - {name: t, type: fixed, parent: coupler, child: tip, mdh: {d: l2}}
  - {name: "3", type: revolute, parent: rocker, child: tip, mdh: {d: l3}}
  - {name: "4", type: revolute, parent: ground, child: rocker, mdh: {d: l4}}
actuated: ["1"]
"""
LENGTHS = {"l1": 4.0, "l2": 3.0, "l3": 4.0, "l4": 4.0}

CRANK_ROCKER = """
screwkit: 1
name: crank_rocker
space: planar
geometry: reference
base: ground
platform: coupler
links: [ground, crank, coupler, rocker]
points: {A: [0, 0], B: [0, 1], C: [3, 4], D: [5, 0]}
joints:
  - {name: "1", type: revolute, parent: ground, child: crank, point: A}
  - {name: "2", type: revolute, parent: crank, child: coupler, point: B}
  - {name: "3", type: revolute, parent: coupler, child: rocker, point: C}
  - {name: "4", type: revolute, parent: ground, child: rocker, point: D}
actuated: ["1"]
"""

FIVE_BAR = """
screwkit: 1
name: five_bar
space: planar
geometry: reference
base: ground
platform: left
links: [ground, one, two, left, right]
points: {A: [0, 0], B: [-1, 2], C: [2, 4], D: [5, 3], E: [4, 0]}
joints:
  - {name: "1", type: revolute, parent: ground, child: one, point: A}
  - {name: "2", type: revolute, parent: one, child: left, point: B}
  - {name: "3", type: revolute, parent: left, child: right, point: C}
  - {name: "4", type: revolute, parent: two, child: right, point: D}
  - {name: "5", type: revolute, parent: ground, child: two, point: E}
actuated: ["1", "5"]
"""

ROD_BETWEEN_BALLS = """
screwkit: 1
name: rssr
geometry: reference
base: ground
platform: rocker
links: [ground, crank, coupler, rocker]
points: {A: [0, 0, 0], B: [1, 0, 0], C: [3, 4, 1], D: [3, 0, 0]}
joints:
  - {name: A, type: revolute, parent: ground, child: crank, axis: [0, 0, 1], point: A}
  - {name: B, type: spherical, parent: crank, child: coupler, point: B}
  - {name: C, type: spherical, parent: coupler, child: rocker, point: C}
  - {name: D, type: revolute, parent: ground, child: rocker, axis: [0, 1, 0], point: D}
actuated: [A]
"""

SLIDER_CRANK = """
screwkit: 1
name: slider_crank
space: planar
geometry: reference
base: ground
platform: coupler
links: [ground, crank, coupler, slider]
parameters: {r: {value: 1, positive: true}, l: {value: 3, positive: true}}
points: {A: [0, 0], B: [r, 0], C: [r + l, 0]}
joints:
  - {name: "1", type: revolute, parent: ground, child: crank, point: A}
  - {name: "2", type: revolute, parent: crank, child: coupler, point: B}
  - {name: "3", type: revolute, parent: coupler, child: slider, point: C}
  - {name: "4", type: prismatic, parent: ground, child: slider, axis: [1, 0]}
actuated: ["4"]
"""


@cache
def answer(text: str) -> Singularities:
    return singularities(load_text(text))


def four_bar(q1: float, side: int) -> dict[str, float] | None:
    """Joint variables of `FOUR_BAR` for a crank angle; None where it cannot close."""
    l1, l2, l3, l4 = LENGTHS.values()
    b, d = l1 * cmath.exp(1j * q1), complex(l4)
    gap = abs(d - b)
    if not abs(l2 - l3) < gap < l2 + l3:
        return None
    turn = acos((gap**2 + l2**2 - l3**2) / (2 * gap * l2))
    coupler = cmath.phase(d - b) + side * turn
    rocker = cmath.phase(b + l2 * cmath.exp(1j * coupler) - d)
    return {
        "q1": q1,
        "q2": coupler - q1,
        "q4": rocker,
        "q3": coupler - rocker,
        **LENGTHS,
    }


def pivots(at: dict[str, float]) -> dict[str, complex]:
    """The four pivots by the joint there."""
    b = at["l1"] * cmath.exp(1j * at["q1"])
    c = at["l4"] + at["l3"] * cmath.exp(1j * at["q4"])
    return {"1": 0j, "2": b, "3": c, "4": complex(at["l4"])}


def area(one: complex, two: complex, three: complex) -> float:
    return ((two - one).conjugate() * (three - one)).imag


def test_a_four_bar_is_dead_where_coupler_and_rocker_are_in_line() -> None:
    found = answer(FOUR_BAR).actuation
    assert found is not None
    assert found.admissible
    assert found.complete
    (component,) = found.components
    (equation,) = component.equations
    ratios = []
    for q1 in (0.5, 1.0, -0.7):
        for side in (1, -1):
            at = four_bar(q1, side)
            assert at is not None
            p = pivots(at)
            ratios.append(value(equation, at) / area(p["2"], p["3"], p["4"]))
    assert np.ptp(ratios) < 1e-9 * abs(ratios[0])


def test_its_dead_points_are_those_of_the_law_of_cosines() -> None:
    """|B D| is the sum of coupler and rocker, or their difference."""
    found = answer(FOUR_BAR).actuation
    assert found is not None
    (component,) = found.components
    solved = [own.solved for own in component.closes]
    values = sorted(
        value(text, LENGTHS) for one in solved if one for text in one.values[:1]
    )
    l1, l2, l3, l4 = LENGTHS.values()
    reach = [(l1**2 + l4**2 - gap**2) / (2 * l1 * l4) for gap in (l2 + l3, l3 - l2)]
    assert np.allclose(values, sorted(map(acos, reach)))


def test_no_change_point_without_a_special_length() -> None:
    """All four pivots are in line only where l1 ± l2 ± l3 ± l4 = 0 (Grashof)."""
    found = answer(FOUR_BAR).constraint
    assert found.complete
    assert found.generic_rank == 3
    assert not found.components


def test_schemes_of_a_four_bar_fail_where_the_other_pivots_are_in_line() -> None:
    found = schemes(load_text(FOUR_BAR))
    assert (found.total, found.admissible) == (4, 4)
    postures = [four_bar(q1, side) for q1 in (0.5, 1.0, -0.7) for side in (1, -1)]
    for scheme in found.schemes:
        (driven,) = scheme.actuated
        (equation,) = scheme.locus
        ratios = []
        for at in postures:
            assert at is not None
            three = [p for name, p in pivots(at).items() if name != driven]
            ratios.append(value(equation, at) / area(*three))
        assert np.ptp(ratios) < 1e-9 * abs(ratios[0])


def test_a_crank_that_turns_fully_meets_no_dead_point() -> None:
    """Lengths 1, √18, √20, 5: the crank is shortest, and shortest + longest is less.

    Driven by the rocker, the dead points are the ends of its swing.
    """
    found = answer(CRANK_ROCKER).actuation
    assert sqrt(18) + sqrt(20) > 1 + 5
    assert found is not None
    assert found.complete
    assert not found.components
    other = singularities(load_text(CRANK_ROCKER.replace('["1"]', '["4"]'))).actuation
    assert other is not None
    assert len(other.components) == 1


def five_bar(q1: float, q5: float) -> tuple[complex, complex]:
    """B and D of `FIVE_BAR`."""
    b = cmath.exp(1j * q1) * (-1 + 2j)
    d = 4 + cmath.exp(1j * q5) * (1 + 3j)
    return b, d


def test_singular_postures_of_a_five_bar_are_listed() -> None:
    """From random starts: B, C, D in line, at the lengths of the file."""
    found = answer(FIVE_BAR).actuation
    assert found is not None
    assert found.complete
    (component,) = found.components
    lengths = abs(3 + 2j), abs(3 - 1j)
    met = 0
    for seed in range(12):
        source = np.random.default_rng(seed)
        start = source.uniform(-pi, pi, 3)

        def residuals(x: Array) -> Array:
            b, d = five_bar(x[0], x[1])
            c = b + cmath.exp(1j * (x[0] + x[2])) * (3 + 2j)
            return np.array([abs(c - d) ** 2 - lengths[1] ** 2, area(b, c, d)])

        here = solved(residuals, start)
        if here is not None:
            met += 1
            at = {"q1": here[0], "q2": here[2], "q5": here[1]}
            assert abs(value(component.equations[0], at)) < 1e-6
    assert met > 3


def test_a_five_bar_is_told_in_words() -> None:
    """Driven at both ends it is dead with B, C and D in line.

    No sum of its sides ±√5 ± √13 ± √10 ± √10 ± 4 is 0, so that not all are in line.
    """
    found = answer(FIVE_BAR)
    assert found.actuation is not None
    (dead,) = found.actuation.components
    assert dead.geometry == "axes 2, 3 and 4 lie in one plane"
    one, two = found.limb
    assert not one.components  # two pivots a side apart
    assert one.complete
    (folded,) = two.components
    assert folded.geometry == "axes 3, 4 and 5 lie in one plane"
    sides = [abs(-1 + 2j), abs(3 + 2j), abs(3 - 1j), abs(1 + 3j), 4.0]
    sums = [np.dot(s, sides) for s in product((1, -1), repeat=5)]
    assert min(map(abs, sums)) > 0.1
    assert found.constraint.complete
    assert not found.constraint.components


def test_schemes_of_a_five_bar_fail_where_the_passive_pivots_are_in_line() -> None:
    found = schemes(load_text(FIVE_BAR))
    meanings = {factor.equation: factor.meaning for factor in found.factors}
    assert found.admissible == 10
    for scheme in found.schemes:
        (equation,) = scheme.locus
        *first, last = (j for j in "12345" if j not in scheme.actuated)
        passive = f"axes {', '.join(first)} and {last} lie in one plane"
        assert meanings[equation] == passive


def test_a_ball_joint_is_a_point_in_words_not_three_axes() -> None:
    """Dead where the rod lies in the crank's plane, at right angles with its axis."""
    found = answer(ROD_BETWEEN_BALLS).actuation
    assert found is not None
    (component,) = found.components
    assert component.equations == ("cos(qD)",)
    rod = "the line through the centre of B and the centre of C"
    assert component.geometry == f"{rod} is perpendicular to axis A"
    # C is at (3 + sin qD, 4, cos qD), B on the unit circle, and the rod's square is 21:
    # from (4, 4) no point of the circle is that near, from (2, 4) two are.
    assert 33 - 8 * sqrt(2) > 21
    (driven,) = component.closes
    assert driven.solved == Solution("qA", ("atan(-1/2)", "atan(-1/2) + pi"), "pi")
    for q in (atan(-1 / 2), atan(-1 / 2) + pi):
        assert isclose((2 - cos(q)) ** 2 + (4 - sin(q)) ** 2, 21)


def test_a_slider_crank_is_dead_where_crank_and_rod_are_in_line() -> None:
    found = answer(SLIDER_CRANK).actuation
    assert found is not None
    (component,) = found.components
    assert component.equations == ("sin(q2)",)
    given = {"r": 1.0, "l": 3.0}
    solved = [own.solved for own in component.closes]
    slides = sorted(value(one.values[0], given) for one in solved if one)
    places = sorted(sign * 3 + other * 1 - 4 for sign in (1, -1) for other in (1, -1))
    assert np.allclose(slides, places)


RODS_ON_TWO_RAILS = """
screwkit: 1
name: rods_on_two_rails
space: planar
geometry: reference
base: ground
platform: rod1
links: [ground, slide1, rod1, rod2, slide2]
joints:
  - {name: X, type: prismatic, parent: ground, child: slide1, axis: [1, 0]}
  - {name: a, type: revolute, parent: slide1, child: rod1, point: [0, 0]}
  - {name: b, type: revolute, parent: rod1, child: rod2, point: [2, 3/2]}
  - {name: c, type: revolute, parent: rod2, child: slide2, point: [4, 0]}
  - {name: Y, type: prismatic, parent: ground, child: slide2, axis: [3, 4]}
actuated: [X, Y]
"""


def test_rods_of_one_length_are_dead_where_they_fold_and_where_they_stretch() -> None:
    """|a c| = 5, or a lies on c: that is no curve of slides, but the one posture."""
    found = answer(RODS_ON_TWO_RAILS).actuation
    assert found is not None
    (component,) = found.components

    def told(x: float, y: float) -> bool:
        at = {"qX": x, "qY": y}
        return any(abs(value(one.equation, at)) < 1e-9 for one in component.closes)

    def apart(x: float, y: float) -> float:
        return abs(complex(4 + 0.6 * y - x, 0.8 * y))

    stretched = [(4 + 0.6 * y + sqrt(25 - 0.64 * y * y), y) for y in (0.0, 2.0, -5.0)]
    assert all(isclose(apart(*at), 5) and told(*at) for at in stretched)
    assert apart(4, 0) == 0
    assert told(4, 0)
    assert not told(4, 1)


CRANK_AS_LONG_AS_THE_FRAME = """
screwkit: 1
name: crank_as_long_as_the_frame
space: planar
geometry: reference
base: ground
platform: lever
links: [ground, crank, block, lever]
joints:
  - {name: O, type: revolute, parent: ground, child: crank, point: [0, 0]}
  - {name: B, type: revolute, parent: crank, child: block, point: [1, 0]}
  - {name: S, type: prismatic, parent: lever, child: block, axis: [1, 1]}
  - {name: C, type: revolute, parent: ground, child: lever, point: [0, -1]}
actuated: [O]
"""


def test_conditions_that_closed_postures_meet_in_one_set_are_listed_once() -> None:
    """B lies on the slide's line through C; the lever is free where B is C.

    Elsewhere the line turns at half the crank's rate, and a slide normal to it, which
    joints without ties could have, would have no length to lie along.
    """
    found = answer(CRANK_AS_LONG_AS_THE_FRAME).actuation
    assert found is not None
    assert found.complete
    (component,) = found.components
    for lever in (-2.0, 0.3, 1.0):
        at = {"qO": -pi / 2, "qC": lever, "qB": lever + pi / 2}
        assert all(abs(value(e, at)) < 1e-9 for e in component.equations)
    elsewhere = {"qO": 0.4, "qC": 0.2, "qB": -0.2}
    assert any(abs(value(e, elsewhere)) > 1e-3 for e in component.equations)


def test_a_square_says_where_it_is_folded_in_one_equation() -> None:
    """Equal sides: B lies on D at one crank angle, and nowhere else on the circle."""
    text = FOUR_BAR
    for name in LENGTHS:
        text = text.replace(f"d: {name}", "d: 1")
    head, _, joints = text.partition("joints:")
    text = head.partition("parameters:")[0] + "joints:" + joints
    (scheme,) = schemes(load_text(text), candidates=["1"]).schemes
    folded = [e for e in scheme.locus if "q4" not in e]
    assert len(folded) == 1
    zeros = [
        q for q in np.linspace(-3, 3, 61) if abs(value(folded[0], {"q1": q})) < 1e-9
    ]
    assert np.allclose(zeros, [0])


BENNETT = """
screwkit: 1
name: bennett
geometry: mdh
base: ground
platform: c
links: [ground, a, b, c, tip]
joints:
  - {name: A, type: revolute, parent: ground, child: a, mdh: {}}
  - {name: B, type: revolute, parent: a, child: b, mdh: {d: 1, alpha: pi/6}}
  - {name: C, type: revolute, parent: b, child: c, mdh: {d: 2, alpha: pi/2}}
  - {name: D, type: revolute, parent: c, child: tip, mdh: {d: 1, alpha: pi/6}}
  - {name: E, type: fixed, parent: ground, child: tip, mdh: {d: -2, alpha: -pi/2}}
actuated: [A]
"""

BENNETT_REFERENCE = """
screwkit: 1
name: bennett
geometry: reference
base: L0
platform: L2
links: [L0, L1, L2, L3]
points: {A: [3, 0, 1], B: [1, 2, -1], C: [-3, 0, 1], D: [-1, -2, -1]}
joints:
  - {name: A, type: revolute, parent: L0, child: L1, point: A,
     axis: "cross(D - A, B - A)"}
  - {name: B, type: revolute, parent: L1, child: L2, point: B,
     axis: "cross(A - B, C - B)"}
  - {name: C, type: revolute, parent: L2, child: L3, point: C,
     axis: "cross(B - C, D - C)"}
  - {name: D, type: revolute, parent: L3, child: L0, point: D,
     axis: "cross(C - D, A - D)"}
actuated: [A]
"""


@pytest.mark.parametrize("text", [BENNETT, BENNETT_REFERENCE])
def test_a_bennett_linkage_is_never_singular(text: str) -> None:
    """Its hinges are generators of one regulus, any three of them independent."""
    found = answer(text)
    assert found.constraint.generic_rank == 3
    assert found.constraint.complete
    assert not found.constraint.components
    assert found.actuation is not None
    assert found.actuation.admissible
    assert found.actuation.complete
    assert not found.actuation.components
    assert not found.actuation.idle
    assert sum(limb.generic_rank for limb in found.limb) == 4  # one joint each
    for limb in found.limb:
        assert limb.complete
        assert not limb.components


def bennett_lines(qa: float) -> Array:
    """(ω; v) of the hinges of `BENNETT`: tan(A/2) tan(B/2) = 3 there, C = A, D = B.

    Bennett's relation, sin ½(β + α) / sin ½(β − α) = sin 60° / sin 30° = √3, up to the
    sense of the axes; which product closes is found by trying.
    """
    table = [(0.0, 0.0), (1.0, pi / 6), (2.0, pi / 2), (1.0, pi / 6), (2.0, pi / 2)]

    half = np.tan(qa / 2)
    for ratio in (sqrt(3), 1 / sqrt(3), -sqrt(3), -1 / sqrt(3)):
        for one, other in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
            for qb in (2 * np.arctan(ratio * half), 2 * np.arctan2(ratio, half)):
                turns = [qa, float(qb), one * qa, other * float(qb), 0.0]
                places = chained(table, turns)
                if np.allclose(places[-1], np.eye(4)):
                    axes = [p[:3, 2] for p in places[:-1]]
                    points = [p[:3, 3] for p in places[:-1]]
                    return np.array(
                        [
                            [*a, *np.cross(p, a)]
                            for a, p in zip(axes, points, strict=True)
                        ]
                    )
    raise AssertionError("no closed posture")


def test_any_three_hinges_of_bennett_are_independent_in_floats() -> None:
    """All four of rank 3 and any three too, whole turn, nowhere near less."""
    for qa in np.linspace(-3.1, 3.1, 41):
        lines = bennett_lines(float(qa))
        sizes = np.linalg.svd(lines, compute_uv=False)
        assert sizes[3] < 1e-9
        assert sizes[2] > 0.05
        for left_out in range(4):
            three = np.delete(lines, left_out, axis=0)
            assert np.linalg.svd(three, compute_uv=False)[2] > 0.02


GOLDBERG = """
screwkit: 1
name: goldberg
geometry: mdh
base: ground
platform: c
links: [ground, a, b, c, d, tip]
joints:
  - {name: P, type: revolute, parent: ground, child: a, mdh: {}}
  - {name: T, type: revolute, parent: a, child: b, mdh: {d: 1 + sqrt(3), alpha: pi/2}}
  - {name: V, type: revolute, parent: b, child: c, mdh: {d: 2, alpha: pi/2}}
  - {name: R, type: revolute, parent: c, child: d, mdh: {d: sqrt(3), alpha: pi/3}}
  - {name: S, type: revolute, parent: d, child: tip, mdh: {d: 1, alpha: pi/6}}
  - {name: E, type: fixed, parent: ground, child: tip, mdh: {d: -2, alpha: -pi/2}}
actuated: [P]
"""


def test_goldberg_keeps_its_rank_at_all_closed_postures() -> None:
    """Two Bennett loops with a link in common; floats see no fifth and four ranks."""
    constraint = answer(GOLDBERG).constraint
    assert (constraint.generic_rank, constraint.complete) == (4, True)
    assert not constraint.components
    table = [(0.0, 0.0), (1 + sqrt(3), pi / 2), (2.0, pi / 2)]
    table += [(sqrt(3), pi / 3), (1.0, pi / 6), (2.0, pi / 2)]
    source = np.random.default_rng(4)
    seen = 0
    for _ in range(40):

        def gap(x: Array) -> Array:
            return np.asarray(chained(table, [*x, 0.0])[-1][:3] - np.eye(4)[:3]).ravel()

        closed = solved(gap, source.uniform(-pi, pi, 5))
        if closed is None:
            continue
        places = chained(table, [*closed, 0.0])[:5]
        lines = np.array([[*p[:3, 2], *np.cross(p[:3, 3], p[:3, 2])] for p in places])
        sizes = np.linalg.svd(lines, compute_uv=False)
        assert sizes[4] < 1e-7
        assert sizes[3] > 1e-3
        seen += 1
    assert seen > 3


def chained(table: list[tuple[float, float]], angles: list[float]) -> list[Array]:
    """Frames of a table of distances and twists, each turned by its angle."""
    place = np.eye(4)
    found = []
    for (d, alpha), q in zip(table, angles, strict=True):
        c, s, ca, sa = cos(q), np.sin(q), cos(alpha), np.sin(alpha)
        tilt = np.array([[1, 0, 0, d], [0, ca, -sa, 0], [0, sa, ca, 0], [0, 0, 0, 1]])
        turn = np.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
        place = place @ tilt @ turn
        found.append(place)
    return found


SPHERICAL = """
screwkit: 1
name: spherical
geometry: reference
base: L0
platform: L2
links: [L0, L1, L2, L3]
joints:
  - {name: A, type: revolute, parent: L0, child: L1, point: [0, 0, 0], axis: [0, 0, 1]}
  - {name: B, type: revolute, parent: L1, child: L2, point: [0, 0, 0], axis: [1, 0, 2]}
  - {name: C, type: revolute, parent: L2, child: L3, point: [0, 0, 0], axis: [2, 2, 1]}
  - {name: D, type: revolute, parent: L3, child: L0, point: [0, 0, 0], axis: [0, 1, 1]}
actuated: [A]
"""
ARCS = [
    acos(2 / sqrt(5)),
    acos(4 / (3 * sqrt(5))),
    acos(1 / sqrt(2)),
    acos(1 / sqrt(2)),
]


def test_a_spherical_crank_that_turns_fully_meets_no_dead_point() -> None:
    """Grashof on the sphere: shortest and longest arc are less than the other two."""
    crank, longest, *others = ARCS
    assert crank == min(ARCS)
    assert longest == max(ARCS)
    assert crank + longest < sum(others)
    found = answer(SPHERICAL)
    assert found.actuation is not None
    assert found.actuation.complete
    assert not found.actuation.components
    assert found.constraint.complete
    assert not found.constraint.components  # no arcs add up, so that none is flat


def test_a_spherical_rocker_is_dead_where_crank_and_coupler_are_in_line() -> None:
    """The arc from A to C is then the sum or the difference of the two."""
    found = answer(SPHERICAL.replace("actuated: [A]", "actuated: [D]"))
    assert found.actuation is not None
    assert found.actuation.complete
    (component,) = found.actuation.components
    assert component.example
    at = dict(component.example)
    assert abs(value(component.equations[0], at)) < 1e-8
    axes = [np.array(x) for x in ([0, 0, 1.0], [1, 0, 2.0], [2, 2, 1.0], [0, 1, 1.0])]
    a, b, c, d = (axis / np.linalg.norm(axis) for axis in axes)
    # C where the rocker has it (D turns the base against it), as far from A as the two
    # arcs say.
    end = turned(c, d, -at["qD"])
    apart = acos(float(a @ end))
    sums = (ARCS[0] + ARCS[1], ARCS[1] - ARCS[0])
    assert min(abs(apart - one) for one in sums) < 1e-6
    # B where the crank A has it, on the circle through both.
    middle = turned(b, a, at["qA"])
    assert abs(np.linalg.det(np.array([a, middle, end]))) < 1e-6


def turned(vector: Array, axis: Array, angle: float) -> Array:
    """By Rodrigues' formula."""
    along = axis * float(axis @ vector) * (1 - cos(angle))
    return np.asarray(
        vector * cos(angle) + np.cross(axis, vector) * np.sin(angle) + along
    )


def test_an_example_is_a_closed_dead_posture() -> None:
    (component,) = _components(FOUR_BAR)
    assert component.example
    p = pivots({**LENGTHS, **dict(component.example)})
    assert isclose(abs(p["3"] - p["2"]), LENGTHS["l2"], abs_tol=1e-8)
    assert abs(area(p["2"], p["3"], p["4"])) < 1e-6


def test_a_component_that_the_values_do_not_meet_says_so() -> None:
    """Arms that are too short for each other: the parts are in line nowhere."""
    crank = FOUR_BAR.replace("l1: {value: 4", "l1: {value: 1")
    crank = crank.replace("l2: {value: 3", "l2: {value: 4")
    (component,) = _components(crank)
    assert component.example == ()
    said = at_closed_postures(component)
    assert any("no real posture was met" in str(span) for span in said)


def _components(text: str) -> tuple[Component, ...]:
    found = answer(text).actuation
    assert found is not None
    return found.components


def test_postures_that_do_not_close_are_not_taken_for_closed() -> None:
    """Points of what was left open need not satisfy the closing equations."""
    for text in (BENNETT, BENNETT_REFERENCE, SPHERICAL):
        graph = TiedGraph(load_text(text).mechanism)
        assert graph.closed.points
        for point, prime in graph.closed.points:
            assert not any(residue(e, point, prime) for e in graph.closing)
            assert graph.motion_at(point, prime).rank == 3


def test_invariants_of_links_hold_where_loops_close() -> None:
    """They follow from closure: at exact closed postures they vanish, elsewhere not."""
    checked = 0
    for text in (BENNETT_REFERENCE, SPHERICAL, CRANK_ROCKER):
        graph = TiedGraph(load_text(text).mechanism)
        assert graph.invariants
        for equation in graph.invariants:
            assert all(not residue(equation, *point) for point in graph.closed.points)
            checked += any(residue(equation, *point) for point in graph.root.points)
    assert checked


RSSR = """
screwkit: 1
name: rssr
geometry: reference
base: g
platform: r
links: [g, a, c, r]
joints:
  - {name: "1", type: revolute, parent: g, child: a, point: [0, 0, 0], axis: [0, 0, 1]}
  - {name: "2", type: spherical, parent: a, child: c, point: [1, 0, 0]}
  - {name: "3", type: spherical, parent: c, child: r, point: [3, 2, 1]}
  - {name: "4", type: revolute, parent: g, child: r, point: [3, 0, 0], axis: [0, 1, 3]}
actuated: ["1"]
"""


def rocker_end(q4: float) -> Array:
    """C, turned about the axis through (3, 0, 0) by Rodrigues' formula."""
    axis = np.array([0, 1, 3]) / sqrt(10)
    arm = np.array([0.0, 2, 1])
    turned = arm * cos(q4) + np.cross(axis, arm) * np.sin(q4)
    along = axis * float(axis @ arm) * (1 - cos(q4))
    return np.asarray(np.array([3.0, 0, 0]) + turned + along)


def rssr_rocker(q1: float) -> list[float]:
    """Rocker angles at which the rod fits: |B C|² = p cos q4 + q sin q4 + r = 9."""
    end = np.array([cos(q1), np.sin(q1), 0])

    def gap(q4: float) -> float:
        return float(np.sum((rocker_end(q4) - end) ** 2)) - 9

    p = (gap(0) - gap(pi)) / 2
    r = (gap(0) + gap(pi)) / 2
    q = gap(pi / 2) - r
    size = np.hypot(p, q)
    if abs(r) >= size:
        return []
    middle = np.arctan2(q, p)
    return [float(middle + sign * acos(-r / size)) for sign in (1, -1)]


def test_a_spatial_crank_never_stops_its_rocker() -> None:
    """Two rocker angles at every crank angle: nowhere do they fall together."""
    found = answer(RSSR)
    assert found.actuation is not None
    assert found.actuation.admissible
    assert found.actuation.complete
    assert not found.actuation.components
    assert all(len(rssr_rocker(q1)) == 2 for q1 in np.linspace(-pi, pi, 400))


def test_the_rod_in_the_plane_of_the_crank_is_the_limbs_singularity() -> None:
    """Crank axis, B and C in one plane: det(k, B, C) = 0, at closed postures."""
    limb = answer(RSSR).limb[0]
    assert limb.complete
    (component,) = limb.components
    (equation,) = component.equations
    ratios = []
    for q1 in (0.4, 1.3, -2.0):
        end = np.array([cos(q1), np.sin(q1), 0])
        for q4 in rssr_rocker(q1):
            plane = np.linalg.det(np.array([[0, 0, 1], end, rocker_end(q4)]))
            ratios.append(value(equation, {"q1": q1, "q4": q4}) / plane)
    assert np.ptp(ratios) < 1e-9 * abs(ratios[0])


UNIVERSAL_ROD = RSSR.replace(
    'name: "3", type: spherical, parent: c, child: r, point: [3, 2, 1]',
    'name: "3", type: universal, parent: c, child: r, point: [3, 2, 1], '
    "axes: [[1, 0, 0], [0, 1, 0]]",
)


def test_loops_without_closed_points_are_left_open(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(tied_graph, "exact_zeros", lambda *_: ())
    with pytest.raises(UndecidedError, match="no exact closed posture"):
        singularities(load_text(UNIVERSAL_ROD))


def test_a_universal_joint_on_a_rod_closes_and_moves() -> None:
    """Seven freedoms in one loop: its angles are not linear in few equations."""
    graph = TiedGraph(load_text(UNIVERSAL_ROD).mechanism)
    state = graph.generic_state()
    assert (state.loop, state.mobility) == (6, 1)
    for point, prime in graph.points:
        assert not any(residue(e, point, prime) for e in graph.closing)


THREE_RRS = """
screwkit: 1
name: three_rrs
geometry: reference
base: base
platform: plate
links: [base, plate, l1, u1, l2, u2, l3, u3]
vectors: {d1: [0, 1, 0], d2: [4, -3, 0], d3: [4, 3, 0]}
points:
  A1: [4, 0, 0]
  B1: [6, 0, 2]
  C1: [2, 0, 4]
  A2: [-3, -4, 0]
  B2: [-3, -4, 3]
  C2: [-1, -2, 4]
  A3: [-3, 4, 0]
  B3: [-3, 4, 2]
  C3: [-1, 2, 4]
joints:
  - {name: A1, type: revolute, parent: base, child: l1, axis: d1, point: A1}
  - {name: B1, type: revolute, parent: l1, child: u1, axis: d1, point: B1}
  - {name: C1, type: spherical, parent: u1, child: plate, point: C1}
  - {name: A2, type: revolute, parent: base, child: l2, axis: d2, point: A2}
  - {name: B2, type: revolute, parent: l2, child: u2, axis: d2, point: B2}
  - {name: C2, type: spherical, parent: plate, child: u2, point: C2}
  - {name: A3, type: revolute, parent: base, child: l3, axis: d3, point: A3}
  - {name: B3, type: revolute, parent: l3, child: u3, axis: d3, point: B3}
  - {name: C3, type: spherical, parent: u3, child: plate, point: C3}
actuated: [A1, A2, A3]
"""


def test_of_a_plate_on_three_balls_only_the_sides_close_loops() -> None:
    """Two loops of fifteen freedoms; Grübler's count gives three."""
    graph = TiedGraph(load_text(THREE_RRS).mechanism)
    assert len(graph.closing) == 3
    state = graph.generic_state()
    assert (state.loop, state.mobility, state.platform_freedom) == (12, 3, 3)


def test_a_planar_3rpr_in_numbers_is_complete_inside_idle_limbs_too() -> None:
    """Its lines meet in the posture of the file; nothing else moves the plate."""
    case = load_text(THREE_RPR)
    graph = TiedGraph(case.mechanism)
    answer, _ = tied_actuation(graph, case.mechanism.actuated)
    assert (answer.complete, answer.reason) == (True, "")
    assert len(answer.components) == 1
    assert len(answer.idle) == 3
    lines = [((0, 0), (3, 2)), ((8, 0), (5, 2)), ((4, 7), (4, 4))]
    moments = [(x1 - x, y1 - y, x * y1 - y * x1) for (x, y), (x1, y1) in lines]
    assert abs(np.linalg.det(np.array(moments, float))) < 1e-9
    (component,) = answer.components
    here = {f"q{joint}": 0.0 for joint in ("A1", "A2", "A3", "P1", "P2", "P3")}
    assert abs(value(component.equations[0], here)) < 1e-9


THREE_RPR = """
screwkit: 1
name: three_rpr
space: planar
geometry: reference
base: ground
platform: plate
links: [ground, c1, c2, c3, r1, r2, r3, plate]
points: {A1: [0, 0], A2: [8, 0], A3: [4, 7], B1: [3, 2], B2: [5, 2], B3: [4, 4]}
joints:
  - {name: A1, type: revolute, parent: ground, child: c1, point: A1}
  - {name: P1, type: prismatic, parent: c1, child: r1, axis: B1 - A1, point: A1}
  - {name: B1, type: revolute, parent: r1, child: plate, point: B1}
  - {name: A2, type: revolute, parent: ground, child: c2, point: A2}
  - {name: P2, type: prismatic, parent: c2, child: r2, axis: B2 - A2, point: A2}
  - {name: B2, type: revolute, parent: r2, child: plate, point: B2}
  - {name: A3, type: revolute, parent: ground, child: c3, point: A3}
  - {name: P3, type: prismatic, parent: c3, child: r3, axis: B3 - A3, point: A3}
  - {name: B3, type: revolute, parent: r3, child: plate, point: B3}
actuated: [P1, P2, P3]
"""


SIX_BAR = """
screwkit: 1
name: six_bar
space: planar
geometry: reference
base: O
platform: coupler
links: [O, crank, ternary, rocker, coupler, output]
points: {A: [0, 0], B: [1, 2], C: [5, 3], D: [6, 0], E: [4, 6], F: [9, 4], G: [10, -1]}
joints:
  - {name: A, type: revolute, parent: O, child: crank, point: A}
  - {name: B, type: revolute, parent: crank, child: ternary, point: B}
  - {name: C, type: revolute, parent: ternary, child: rocker, point: C}
  - {name: D, type: revolute, parent: O, child: rocker, point: D}
  - {name: E, type: revolute, parent: ternary, child: coupler, point: E}
  - {name: F, type: revolute, parent: coupler, child: output, point: F}
  - {name: G, type: revolute, parent: O, child: output, point: G}
actuated: [A]
"""


def test_two_loops_are_dead_where_the_first_one_is() -> None:
    """B, C, D in line is a dead point of the first loop; E, F, G never are in line."""
    found = answer(SIX_BAR)
    assert found.actuation is not None
    assert found.actuation.complete
    (component,) = found.actuation.components
    for q1, q2 in ((0.3, 0.4), (-1.0, 2.0)):
        b = cmath.exp(1j * q1) * (1 + 2j)
        c = b + cmath.exp(1j * (q1 + q2)) * (4 + 1j)
        at = {"qA": q1, "qB": q2}
        expected = value(component.equations[0], {"qA": 0.0, "qB": 0.0}) / area(
            1 + 2j, 5 + 3j, 6
        )
        assert isclose(value(component.equations[0], at) / area(b, c, 6), expected)
    first, second = found.limb
    assert (first.generic_rank, first.complete, first.components) == (2, True, ())
    assert (second.generic_rank, second.complete) == (2, True)
    sums = abs(9 + 4j - (4 + 6j)) + abs(9 + 4j - (10 - 1j))
    differences = abs(abs(9 + 4j - (4 + 6j)) - abs(9 + 4j - (10 - 1j)))
    postures = postures_of_the_first_loop()
    # The first limb would lose a freedom with the pole of its ternary link at E: on
    # the lines A B and D C.
    assert all(abs(area(0, b, e)) + abs(area(6, c, e)) > 0.1 for b, c, e in postures)
    apart = [abs(e - (10 - 1j)) for _, _, e in postures]
    assert len(apart) > 1000
    assert differences + 0.1 < min(apart)
    assert max(apart) < sums - 0.1


def postures_of_the_first_loop() -> list[tuple[complex, complex, complex]]:
    """B, C, and E on the coupler, by the law of cosines, all round."""
    crank, coupler, rocker = 1 + 2j, 4 + 1j, abs(5 + 3j - 6)
    found = []
    for q1 in np.linspace(-pi, pi, 2001):
        b = crank * cmath.exp(1j * q1)
        away = 6 - b
        along = (abs(coupler) ** 2 - rocker**2 + abs(away) ** 2) / (2 * abs(away))
        if abs(along) > abs(coupler):
            continue
        across = sqrt(abs(coupler) ** 2 - along**2)
        for side in (1, -1):
            arm = away / abs(away) * complex(along, side * across)
            found.append((b, b + arm, b + arm / coupler * (3 + 4j)))
    return found


STEPHENSON = """
screwkit: 1
name: stephenson
space: planar
geometry: reference
base: ground
platform: tool
links: [ground, a, t, b, c, tool]
points: {A: [0, 0], B: [0, 4], C: [3, 6], D: [5, 0], E: [0, 4], F: [8, 6], G: [9, 1]}
joints:
  - {name: "1", type: revolute, parent: ground, child: a, point: A}
  - {name: "2", type: revolute, parent: a, child: t, point: B}
  - {name: "3", type: revolute, parent: t, child: b, point: C}
  - {name: "4", type: revolute, parent: ground, child: b, point: D}
  - {name: "5", type: revolute, parent: t, child: tool, point: E}
  - {name: "6", type: revolute, parent: tool, child: c, point: F}
  - {name: "7", type: revolute, parent: ground, child: c, point: G}
actuated: ["1"]
"""


def test_a_limb_with_a_loop_loses_a_freedom_where_its_last_pivot_is_a_pole() -> None:
    """The tool hangs on the coupler at B, which is the pole where B, C, D line up.

    There |B D| is √40 − √13; the sum is more than crank and ground are together.
    """
    one, two = answer(STEPHENSON).limb
    assert one.generic_rank == 2
    assert one.complete
    (component,) = one.components
    assert component.rank == 1
    at = dict(component.example or ())
    gap = abs(4j * cmath.exp(1j * at["q1"]) - 5)
    assert isclose(gap, sqrt(40) - sqrt(13), abs_tol=1e-6)
    assert sqrt(40) + sqrt(13) > 4 + 5
    assert two.complete
    assert not two.components


def test_certificates_of_schemes_of_tied_loops_are_refused_with_the_reason() -> None:
    with pytest.raises(UndecidedError, match="without --certificate"):
        schemes(load_text(CRANK_ROCKER), certificate=True)


def test_numbers_of_closed_postures() -> None:
    """A closed posture closes: the pivots are as far apart as told."""
    at = four_bar(0.8, 1)
    assert at is not None
    p = pivots(at)
    assert isclose(abs(p["3"] - p["2"]), LENGTHS["l2"])
    assert isclose(p["2"].real, 4 * cos(0.8))
