"""More actuators than freedoms: four links of a planar robot hold its platform.

With the cranks locked each link carries a force along its line.  The platform moves
exactly where all four lines meet in one point or are parallel; a link of length 0 turns
idly, and the other three hold the platform unless their lines meet in one point.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from loci.numeric import Array, value
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search
from screwkit.case import load_text
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.actuation import actuation_locus
from screwkit.loci.actuation_locus import ActuationLocus

BASE = np.array([(3, 0), (0, 3), (-3, 0), (0, -3)])
PLATFORM = np.array([(1, 0), (0, 1), (-1, 0), (0, -1)])
CRANK = 2


@cache
def locus() -> tuple[Assembly, ActuationLocus]:
    """Of four R-R-R limbs whose first joints are actuated."""
    links, points, vectors, joints = ["base", "platform"], [], [], []
    for k in range(4):
        ax, ay = BASE[k]
        bx, by = PLATFORM[k]
        links += [f"crank{k}", f"link{k}"]
        vectors.append(f"  c{k}: [cos(q{k}), sin(q{k})]")
        vectors.append(f"  a{k}: [{ax}, {ay}]")
        points.append(f"  A{k}: [{ax}, {ay}]")
        points.append(f"  C{k}: a{k} + {CRANK}*c{k}")
        points.append(f"  B{k}: {{link: platform, at: [{bx}, {by}]}}")
        chain = ("base", f"crank{k}", f"link{k}", "platform")
        joints += [
            f"  - {{name: {at}{k}, type: revolute, parent: {parent}, child: {child}, "
            f"point: {at}{k}}}"
            for at, parent, child in zip("ACB", chain, chain[1:], strict=False)
        ]
    variables = ", ".join(f"q{k}: {{value: 0.{k + 1}, angle: true}}" for k in range(4))
    case = "\n".join(
        [
            "screwkit: 1",
            "name: four_cranks",
            "space: planar",
            "geometry: posture",
            "base: base",
            "platform: platform",
            f"links: [{', '.join(links)}]",
            f"variables: {{x: 0.3, y: 0.2, phi: {{value: 0.1, angle: true}}, "
            f"{variables}}}",
            "pose: {translation: [x, y], rotation: {axis: z, angle: phi}}",
            "vectors:",
            *vectors,
            "points:",
            *points,
            "joints:",
            *joints,
            "actuated: [A0, A1, A2, A3]",
        ]
    )
    assembly = Assembly(load_text(case).mechanism)
    return assembly, actuation_locus(assembly, assembly.mechanism.actuated)


def platform_points(pose: Array) -> Array:
    """B of all limbs for (x, y, φ)."""
    turn = np.array(
        [[np.cos(pose[2]), -np.sin(pose[2])], [np.sin(pose[2]), np.cos(pose[2])]]
    )
    return np.array(pose[:2] + PLATFORM @ turn.T)


def posture(pose: Array, turns: Array) -> dict[str, float]:
    """By name."""
    named = dict(zip(("x", "y", "phi"), map(float, pose), strict=True))
    return named | {f"q{k}": float(q) for k, q in enumerate(turns)}


def freedoms(at: dict[str, float]) -> tuple[int, int]:
    """Of the platform, and of links of length 0, by singular values."""
    ends = platform_points(np.array([at["x"], at["y"], at["phi"]]))
    rows: list[list[float]] = []
    idle = 0
    for k in range(4):
        q = at[f"q{k}"]
        along = ends[k] - BASE[k] - CRANK * np.array([np.cos(q), np.sin(q)])
        length = np.hypot(*along)
        forces = [along / length] if length > 1e-9 else [*np.eye(2)]
        idle += length <= 1e-9
        rows += [[*f, ends[k][0] * f[1] - ends[k][1] * f[0]] for f in forces]
    return 3 - int(np.linalg.matrix_rank(np.array(rows), 1e-9)), idle


def cranks_towards(pose: Array, centre: Array, sheets: Array) -> Array | None:
    """Turns of all cranks at which the lines of the links go through a point."""
    turns = []
    for k, end in enumerate(platform_points(pose)):
        along = (end - centre) / np.hypot(*(end - centre))
        offset = centre - BASE[k]
        square = (along @ offset) ** 2 + CRANK**2 - offset @ offset
        if square < 0:
            return None
        out = offset + (-(along @ offset) + sheets[k] * np.sqrt(square)) * along
        turns.append(np.arctan2(out[1], out[0]))
    return np.array(turns)


def lies_on(at: dict[str, float], equations: list[str]) -> bool:
    """Whether all of them vanish there."""
    return all(abs(value(equation, at)) < 1e-7 for equation in equations)


def told(*, moving: bool) -> list[list[str]]:
    """Equations of the pieces on which the platform moves, or of the others."""
    assembly, found = locus()
    ring = assembly.common_twists.ring
    pairs = zip(found.pieces, found.states, strict=True)
    return [
        [text(ring, equation) for equation in piece.equations]
        for piece, state in pairs
        if bool(state.platform_freedom) == moving
    ]


def test_lines_that_meet_are_the_one_component() -> None:
    """Its codimension is 2; links of length 0 idle, four times."""
    _, found = locus()
    assert found.complete, found.reason
    assert [piece.codimension for piece in found.pieces] == [2] * 5
    assert len(told(moving=True)) == 1


def test_postures_with_lines_through_one_point() -> None:
    """The platform moves there, and the equations hold; elsewhere neither."""
    source = np.random.default_rng(3)
    (equations,) = told(moving=True)
    met = 0
    for _ in range(60):
        pose, centre = source.uniform(-1, 1, 3), source.uniform(-2, 2, 2)
        turns = cranks_towards(pose, centre, source.choice([-1, 1], 4))
        if turns is None:
            continue
        met += 1
        at = posture(pose, turns)
        assert freedoms(at) == (1, 0)
        assert lies_on(at, equations)
        beside = at | {"q3": at["q3"] + 0.1}
        assert freedoms(beside) == (0, 0)
        assert not lies_on(beside, equations)
    assert met > 5


@pytest.mark.parametrize("limb", range(4))
def test_a_link_of_length_zero(limb: int) -> None:
    """It idles, and the platform is held: told apart from what moves."""
    source = np.random.default_rng(limb)
    turns = source.uniform(-3, 3, 4)
    phi = source.uniform(-1, 1)
    arm = platform_points(np.array([0.0, 0.0, phi]))[limb]
    end = BASE[limb] + CRANK * np.array([np.cos(turns[limb]), np.sin(turns[limb])])
    at = posture(np.array([*(end - arm), phi]), turns)
    assert freedoms(at) == (0, 1)
    assert not any(lies_on(at, equations) for equations in told(moving=True))
    assert sum(lies_on(at, equations) for equations in told(moving=False)) == 1


def test_no_part_of_three_minors_is_smaller_than_two() -> None:
    """Of a 2 × 3 matrix; without the bound pairs of entries are searched too."""
    ring, minors = in_one_ring("a*d - b*c", "a*f - b*e", "c*f - d*e")
    root = Branch(ring, Assumptions(frozenset()))
    zeros = common_zeros(root, minors, Search(FactorLibrary(ring), bound=2))
    assert zeros.complete
    assert {branch.codimension for branch in zeros.branches} == {2}


def test_real_zeros_may_be_smaller() -> None:
    """Two squares leave complex zeros of codimension 1, and real ones of 2."""
    ring, equations = in_one_ring("(x^2 + y^2)*z")
    root = Branch(ring, Assumptions(frozenset()))
    zeros = common_zeros(root, equations, Search(FactorLibrary(ring), bound=1))
    assert zeros.complete
    assert sorted(branch.codimension for branch in zeros.branches) == [1, 2]
