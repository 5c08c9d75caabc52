"""Singularities of joint graphs that are no sum of limbs, against geometry and floats.

The geometry is classical: a K(3,3) on a conic, the triangular prism of Desargues, the
octahedron whose alternate faces meet, the six-bar by its instant centres.  The floats
are those of `test_hybrid_loci`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from loci.frameworks import framework
from loci.numeric import Array, value, values
from loci.test_hybrid_loci import (
    Line,
    answer,
    at,
    clear_rank,
    drawn,
    freedom,
    limb_at,
    minimum,
    mobility,
    on_component,
    variables,
)

import screwkit as sk
from screwkit.case import load_text
from screwkit.questions import schemes, singularities
from screwkit.results.singularities import Component

GRAPHS = ("palletizer_scara", "peaucellier")

PRISM = {
    "A": (0, 0, 0),
    "B": (4, 1, 0),
    "C": (1, 5, 0),
    "D": ("x", "y", 0),
    "E": (7, 3, 0),
    "F": (3, 9, 0),
}
PRISM_BARS = ("AB", "BC", "AC", "DE", "EF", "DF", "AD", "BE", "CF")
OCTAHEDRON = {
    "A": (0, 0, 0),
    "B": (4, 1, 0),
    "C": (1, 5, 0),
    "D": ("x", "y", "z"),
    "E": (7, 3, 5),
    "F": (3, 9, 7),
}
OCTAHEDRON_BARS = (*PRISM_BARS, "AE", "BF", "CD")
K33 = {
    "P": (0, 0, 0),
    "Q": (2, 1, 0),
    "R": (-1, 3, 0),
    "U": (5, 0, 0),
    "V": (1, -2, 0),
    "W": ("x", "y", 0),
}
K33_BARS = tuple(one + other for one in "PQR" for other in "UVW")


def bars_of(names: Sequence[str]) -> list[tuple[str, str]]:
    return [(name[0], name[1]) for name in names]


@cache
def constraint(kind: str) -> sk.results.singularities.ConstraintSingularities:
    kinds: dict[str, tuple[Mapping[str, Sequence[object]], tuple[str, ...], str]] = {
        "prism": (PRISM, PRISM_BARS, "revolute"),
        "k33": (K33, K33_BARS, "revolute"),
        "octahedron": (OCTAHEDRON, OCTAHEDRON_BARS, "spherical"),
    }
    points, bars, joint = kinds[kind]
    symbols = {s: 1 for at in points.values() for s in at if isinstance(s, str)}
    case = framework(
        points, bars_of(bars), ends=(0, len(bars) - 1), joint=joint, symbols=symbols
    )
    return singularities(case).constraint


def placed(points: Mapping[str, Sequence[object]], here: Mapping[str, int]) -> Array:
    return np.array(
        [[float(here.get(str(x), x)) for x in at] for at in points.values()]  # type: ignore[arg-type]
    )


def prism_condition(here: Mapping[str, int]) -> float:
    """Three lines through one point, times the area of the triangle D E F."""
    flat = placed(PRISM, here).copy()
    flat[:, 2] = 1
    a, b, c, d, e, f = flat
    lines = [np.cross(a, d), np.cross(b, e), np.cross(c, f)]
    return float(np.linalg.det(lines) * np.linalg.det([d, e, f]))


def k33_condition(here: Mapping[str, int]) -> float:
    """Six points on a conic: their Veronese images are dependent."""
    rows = [[x * x, x * y, y * y, x, y, 1] for x, y, _ in placed(K33, here)]
    return float(np.linalg.det(rows))


def octahedron_condition(here: Mapping[str, int]) -> float:
    """The planes of four alternate faces pass through one point."""
    solid = placed(OCTAHEDRON, here)
    a, b, c, d, e, f = solid
    planes = []
    for one, two, three in ((a, b, c), (a, d, e), (b, e, f), (c, f, d)):
        normal = np.cross(two - one, three - one)
        planes.append([*normal, -float(normal @ one)])
    return float(np.linalg.det(planes))


GEOMETRY: dict[str, Callable[[Mapping[str, int]], float]] = {
    "prism": prism_condition,
    "k33": k33_condition,
    "octahedron": octahedron_condition,
}


@pytest.mark.parametrize("kind", GEOMETRY)
def test_frameworks_are_singular_where_geometry_says(kind: str) -> None:
    """The listed equations together are the classical condition, up to a number."""
    found = constraint(kind)
    assert found.complete
    assert all(component.codimension == 1 for component in found.components)
    ratios = []
    for x, y, z in [(2, 3, 5), (-4, 1, 7), (6, -5, 2), (11, 8, -3), (-2, -7, 4)]:
        here = {"x": x, "y": y, "z": z}
        product = np.prod([value(c.equations[0], here) for c in found.components])
        ratios.append(GEOMETRY[kind](here) / product)
    assert np.ptp(ratios) < 1e-9 * abs(ratios[0])
    assert abs(ratios[0]) > 0


@pytest.mark.parametrize("name", GRAPHS)
def test_regular_postures_are_generic(name: str) -> None:
    found = answer(name)
    assert found.actuation is not None
    for seed in range(2):
        given = drawn(name, seed)
        whole = at(name, given)
        assert clear_rank(whole.loop_matrix()) == found.constraint.generic_rank
        assert not freedom(whole.platform(found.actuation.actuated))
        for limb in found.limb:
            alone = limb_at(name, limb.limb, given)
            assert freedom(alone.platform()) == limb.generic_rank


@pytest.mark.parametrize("name", GRAPHS)
def test_components_lose_what_is_said(name: str) -> None:
    found = answer(name)
    assert found.actuation is not None
    assert found.actuation.components
    assert found.constraint.components
    locked = found.actuation.actuated
    for seed, component in enumerate(found.constraint.components):
        whole = at(name, exactly_on(name, component, seed))
        assert clear_rank(whole.loop_matrix()) == component.rank
        assert component.rank < found.constraint.generic_rank
        assert freedom(whole.platform()) == component.platform_freedom
    for seed, component in enumerate(found.actuation.components):
        whole = at(name, exactly_on(name, component, seed))
        assert freedom(whole.platform(locked)) == component.platform_freedom
        assert component.platform_freedom
        assert mobility(whole, locked) == component.mobility


def test_limbs_lose_what_is_said() -> None:
    """The palletizer's one limb holds all its parallelograms."""
    (limb,) = answer("palletizer_scara").limb
    assert limb.complete
    assert limb.components
    for seed, component in enumerate(limb.components):
        given = on_component("palletizer_scara", component, seed)
        alone = limb_at("palletizer_scara", limb.limb, given)
        assert freedom(alone.platform()) == component.rank < limb.generic_rank


def exactly_on(name: str, component: Component, seed: int) -> dict[str, float]:
    """As `on_component`, but numbers as they are solved for: zeros may be double."""
    found = on_component(name, component, seed)
    for solution in filter(None, component.solved):
        if solution.values[0] in ("0", "pi", "1"):
            found[solution.variable] = value(solution.values[0], {})
    return found


def singular_on_line(
    name: str, locked: tuple[str, ...], seed: int
) -> list[dict[str, float]]:
    """Postures on a random line at which the loop equations lose rank, in floats."""
    rank = clear_rank(at(name, drawn(name, 0)).loop_matrix(locked))
    start, end = drawn(name, 150 + seed), drawn(name, 190 + seed)
    for each in variables(name):
        start[each], end[each] = 4 * start[each] - 5, 4 * end[each] - 5
    line = Line(name, start, end, locked, rank)
    steps = [float(t) for t in np.linspace(-0.5, 1.5, 61)]
    sizes = [line.dip(t) for t in steps]
    found = []
    for i in range(1, len(steps) - 1):
        if sizes[i - 1] > sizes[i] < sizes[i + 1]:
            t = minimum(line.dip, steps[i - 1], steps[i + 1])
            here = line.posture(t)
            if line.dip(t) < 1e-8 and not is_excluded(name, here):
                found.append(here)
    return found


def is_excluded(name: str, here: Mapping[str, float]) -> bool:
    """Whether a symbol is 0 that the file says is not."""
    declared = sk.load(name).mechanism.parameters
    return any(abs(here[p.name]) < 1e-6 for p in declared if p.nonzero or p.positive)


def lies_on(components: Sequence[Component], here: Mapping[str, float]) -> bool:
    return any(np.max(np.abs(values(c.equations, here))) < 1e-6 for c in components)


@pytest.mark.parametrize("name", GRAPHS)
def test_singular_postures_on_lines_are_listed(name: str) -> None:
    found = answer(name)
    assert found.actuation is not None
    met = 0
    for seed in range(2):
        for here in singular_on_line(name, (), seed):
            met += 1
            assert lies_on(found.constraint.components, here)
        locked = found.actuation.actuated
        for here in singular_on_line(name, locked, seed):
            met += 1
            both = (*found.actuation.components, *found.actuation.idle)
            assert lies_on(both, here)
    assert met


SIX_BAR = """
screwkit: 1
name: six_bar
space: planar
geometry: posture
base: O
platform: coupler
links: [O, crank, ternary, rocker, coupler, output]
variables: {x: 1, y: 2}
points:
  A: [0, 0]
  B: [1, 2]
  C: [5, 3]
  D: [6, 0]
  E: [x, y]
  F: [9, 4]
  G: [10, -1]
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


def test_a_six_bar_by_its_instant_centres() -> None:
    """Crank held, B stands still and C moves across B C and across C D: both stand.

    With the triangle still, E F and F G must be on one line for F to move.
    """
    found = singularities(load_text(SIX_BAR)).actuation
    assert found is not None
    assert found.complete
    (component,) = found.components
    # E on the line through F (9, 4) and G (10, -1): (x - 9)·(-5) = (y - 4)·1.
    for x in (Fraction(0), Fraction(7, 2)):
        y = 4 - 5 * (x - 9)
        assert abs(value(component.equations[0], {"x": float(x), "y": float(y)})) < 1e-9
    assert abs(value(component.equations[0], {"x": 0.0, "y": 0.0})) > 1e-3


SCISSORS = """
screwkit: 1
name: two_ways
space: planar
geometry: posture
base: g
platform: p
links: [g, a, b, c, d, e, f, p]
variables: {x: 1, y: 2, u: 4, v: 3}
points:
  A: [0, 0]
  B: [6, 0]
  C: [x, y]
  D: [u, v]
  E: [3, 7]
joints:
  - {name: A, type: revolute, parent: g, child: a, point: A}
  - {name: B, type: revolute, parent: g, child: b, point: B}
  - {name: C, type: revolute, parent: a, child: c, point: C}
  - {name: C2, type: revolute, parent: c, child: d, point: C}
  - {name: D, type: revolute, parent: b, child: d, point: D}
  - {name: D2, type: revolute, parent: d, child: e, point: D}
  - {name: E, type: revolute, parent: c, child: e, point: E}
  - {name: E2, type: revolute, parent: e, child: p, point: E}
actuated: [A, E2]
"""


def test_a_dyad_on_a_four_bar_falls_into_planes() -> None:
    """The triangle C D E on the four-bar A C D B: dead where B, D and C are in line.

    And where C, D and E are, for then E leaves the line C D at first order.
    """
    case = load_text(SCISSORS.replace(", f, p]", ", p]"))
    found = singularities(case).actuation
    assert found is not None
    assert found.admissible
    assert found.complete
    listed = (*found.components, *found.idle)

    def area(
        one: Sequence[float], two: Sequence[float], three: Sequence[float]
    ) -> float:
        return float(np.linalg.det([[*one, 1], [*two, 1], [*three, 1]]))

    ratios = []
    for x, y, u, v in [(2, 3, 5, 7), (-4, 1, 7, 3), (6, -5, 2, 1), (11, 8, -3, 2)]:
        here = {"x": x, "y": y, "u": u, "v": v}
        c, d = (x, y), (u, v)
        product = np.prod([value(one.equations[0], here) for one in listed])
        ratios.append(area((6, 0), d, c) * area(c, d, (3, 7)) / product)
    assert np.ptp(ratios) < 1e-9 * abs(ratios[0])


def test_schemes_of_a_graph_agree_with_floats() -> None:
    """Peaucellier's cell: any one joint drives it, and fails where the floats do."""
    found = schemes(sk.load("peaucellier"))
    assert (found.total, found.admissible) == (10, 10)
    for scheme in found.schemes:
        locked = scheme.actuated
        whole = at("peaucellier", drawn("peaucellier", 3))
        assert not freedom(whole.platform(locked))
        for here in singular_on_line("peaucellier", locked, 1):
            near = [abs(value(equation, here)) for equation in scheme.locus]
            assert scheme.undecided or min(near) < 1e-6


def test_inadmissible_schemes_keep_what_floats_find() -> None:
    case = sk.load("palletizer_scara")
    found = schemes(case, work=0)
    assert not found.complete
    whole = at("palletizer_scara", drawn("palletizer_scara", 5))
    for scheme in found.schemes[::37]:
        left = freedom(whole.platform(scheme.actuated))
        assert scheme.generic_rank == 6 - left
        assert scheme.admissible == (left == 0)


def test_names_of_consecutive_pins_are_unique() -> None:
    """The writer of frameworks: as many pins as bars meet, less one."""
    case = framework(PRISM, bars_of(PRISM_BARS), ends=(0, 8), symbols={"x": 1, "y": 1})
    names = sorted(joint.name for joint in case.mechanism.joints)
    assert all(one != other for one, other in pairwise(names))
    assert len(names) == 6 * 2
