"""Singularities of limbs with loops inside, against floats and against geometry.

The floats know nothing of limbs, blocks or extensors: they are the singular values of
all loop equations at once (`float_loops`).  The geometry is the directions of the rods.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property

import numpy as np
import pytest
from kinematics.float_loops import FloatLoops, counted
from loci.numeric import Array, value, values
from loci.searching import solved
from one_process import grouped

import screwkit as sk
from screwkit.algebra.expression import Expression
from screwkit.algebra.text import expression_text
from screwkit.questions import singularities
from screwkit.results.singularities import Component, Singularities

PLANAR = ("stephenson_six_bar", "watt_six_bar")
CASES = ("delta_ss", "delta_4r", "orthoglide", "h4", *PLANAR)
CLEAR = 1e3
NOISE = 1e-8


@cache
def answer(name: str) -> Singularities:
    return singularities(case(name))


text_of = cache(expression_text)


@dataclass(frozen=True)
class At(FloatLoops):
    """A mechanism at given numbers."""

    given: Mapping[str, float] = field(default_factory=dict)

    def number(self, expression: Expression) -> float:
        return value(text_of(expression), self.values)

    @cached_property
    def values(self) -> dict[str, float]:
        return dict(self.given)

    def platform(self, locked: tuple[str, ...] = ()) -> Array:
        mechanism = self.mechanism
        return self.body_twists(mechanism.platform, mechanism.base, locked)


@cache
def case(name: str) -> sk.Case:
    return sk.load(name)


def at(name: str, given: Mapping[str, float]) -> At:
    return At(case(name).mechanism, given=given)


def limb_at(name: str, limb: str, given: Mapping[str, float]) -> At:
    network = case(name).network
    (own,) = [each for each in network.limbs if each.name == limb]
    ends = network.mechanism.base, network.mechanism.platform
    return At(network.part(own.joints, ends).mechanism, given=given)


def clear_rank(matrix: Array) -> int:
    found = counted(matrix)
    assert found.gap > CLEAR, f"no gap: {found}"
    return found.rank


def freedom(twists: Array) -> int:
    """Dimension of twists for unit joint rates; all of them may be 0."""
    sizes = np.linalg.svd(twists, compute_uv=False)
    kept = sizes[sizes > NOISE]
    dropped = float(np.max(sizes[sizes <= NOISE], initial=0.0))
    assert not len(kept) or kept[-1] > CLEAR * max(dropped, 1e-12)
    return len(kept)


def symbols(name: str) -> list[str]:
    return [p.name for p in case(name).mechanism.parameters]


def drawn(name: str, seed: int) -> dict[str, float]:
    source = np.random.default_rng(seed)
    return {each: float(source.uniform(0.4, 1.9)) for each in symbols(name)}


def variables(name: str) -> list[str]:
    return [p.name for p in case(name).mechanism.parameters if p.free]


def on_component(name: str, component: Component, seed: int) -> dict[str, float]:
    """A random posture on a component, by least Newton steps from a random one."""
    return _where(name, component.equations, seed)


def on_equation(name: str, equation: str, seed: int) -> dict[str, float]:
    return _where(name, (equation,), seed)


def _where(name: str, equations: tuple[str, ...], seed: int) -> dict[str, float]:
    free = variables(name)
    equations = tuple(map(with_single_zeros, equations))
    for number in range(40):
        start = drawn(name, 1000 * seed + number)

        def residuals(x: Array, start: dict[str, float] = start) -> Array:
            posture = {**start, **dict(zip(free, map(float, x), strict=True))}
            return values(equations, posture)

        found = solved(residuals, np.array([start[each] for each in free]))
        if found is not None and np.max(np.abs(found)) < 20:
            return {**start, **dict(zip(free, map(float, found), strict=True))}
    raise AssertionError(f"no posture on {equations}")


def with_single_zeros(equation: str) -> str:
    """Of cos δ = ±1 with half of δ: a double zero is reached half as near."""
    angle = re.fullmatch(r"-?cos\(([^()]*)\) ([+-]) 1", equation)
    if angle is None:
        return equation
    half = "sin" if angle[2] == "-" else "cos"
    return f"{half}(({angle[1]})/2)"


def mobility(whole: At, locked: tuple[str, ...] = ()) -> int:
    passive = whole.loop_matrix(locked)
    return int(passive.shape[1]) - clear_rank(passive)


@pytest.mark.parametrize("name", grouped("loci of", *CASES))
def test_regular_postures_are_generic(name: str) -> None:
    found = answer(name)
    assert found.actuation is not None
    for seed in range(3):
        given = drawn(name, seed)
        whole = at(name, given)
        assert clear_rank(whole.loop_matrix()) == found.constraint.generic_rank
        assert not freedom(whole.platform(found.actuation.actuated))
        for limb in found.limb:
            alone = limb_at(name, limb.limb, given)
            assert freedom(alone.platform()) == limb.generic_rank


@pytest.mark.parametrize("name", grouped("loci of", *CASES))
def test_limbs_lose_what_is_said(name: str) -> None:
    found = answer(name).limb
    assert any(limb.components for limb in found)
    for limb in found:
        for seed, component in enumerate(limb.components):
            given = on_component(name, component, seed)
            alone = limb_at(name, limb.limb, given)
            assert freedom(alone.platform()) == component.rank < limb.generic_rank


@pytest.mark.parametrize("name", grouped("loci of", *CASES[:4], "watt_six_bar"))
def test_loops_lose_what_is_said(name: str) -> None:
    found = answer(name).constraint
    for seed, component in enumerate(found.components):
        whole = at(name, on_component(name, component, seed))
        assert clear_rank(whole.loop_matrix()) == component.rank < found.generic_rank
        assert freedom(whole.platform()) == component.platform_freedom


@pytest.mark.parametrize("name", grouped("loci of", *CASES))
def test_locked_platforms_move_as_is_said(name: str) -> None:
    found = answer(name).actuation
    assert found is not None
    assert found.components
    for seed, component in enumerate(found.components):
        whole = at(name, on_component(name, component, seed))
        left = freedom(whole.platform(found.actuated))
        assert left == component.platform_freedom
        assert left
        assert mobility(whole, found.actuated) == component.mobility


def smallest(matrix: Array, rank: int) -> float:
    """The singular value that vanishes where the rank falls below ``rank``."""
    sizes = np.linalg.svd(matrix, compute_uv=False)
    return float(sizes[rank - 1] / sizes[0])


@dataclass(frozen=True)
class Line:
    """A line in the space of postures, the dimensions fixed."""

    name: str
    start: Mapping[str, float]
    end: Mapping[str, float]
    locked: tuple[str, ...]
    rank: int

    def posture(self, t: float) -> dict[str, float]:
        moved = {
            each: (1 - t) * self.start[each] + t * self.end[each]
            for each in variables(self.name)
        }
        return {**self.start, **moved}

    def dip(self, t: float) -> float:
        matrix = at(self.name, self.posture(t)).loop_matrix(self.locked)
        return smallest(matrix, self.rank)


def minimum(function: Callable[[float], float], low: float, high: float) -> float:
    """Where a function with one dip between two places is smallest (golden section)."""
    golden = (np.sqrt(5) - 1) / 2
    for _ in range(45):
        left, right = high - golden * (high - low), low + golden * (high - low)
        if function(left) < function(right):
            high = right
        else:
            low = left
    return (low + high) / 2


@pytest.mark.parametrize("name", grouped("loci of", *CASES))
@pytest.mark.parametrize("part", ["constraint", "actuation"])
def test_singular_postures_on_lines_are_listed(name: str, part: str) -> None:
    """On random lines the rank falls on listed components and nowhere else."""
    found = answer(name)
    assert found.actuation is not None
    listed = found.constraint if part == "constraint" else found.actuation
    locked = () if part == "constraint" else found.actuation.actuated
    rank = clear_rank(at(name, drawn(name, 0)).loop_matrix(locked))
    met = 0
    for seed in range(2):
        start, end = drawn(name, 50 + seed), drawn(name, 90 + seed)
        for each in variables(name):
            start[each], end[each] = 4 * start[each] - 5, 4 * end[each] - 5

        line = Line(name, start, end, locked, rank)
        steps = np.linspace(-0.5, 1.5, 61)
        sizes = [line.dip(t) for t in steps]
        for i in range(1, len(steps) - 1):
            if sizes[i - 1] > sizes[i] < sizes[i + 1]:
                t = minimum(line.dip, steps[i - 1], steps[i + 1])
                here = line.posture(t)
                on = [
                    c
                    for c in listed.components
                    if np.max(np.abs(values(c.equations, here))) < 1e-6
                ]
                assert (line.dip(t) < 1e-8) == bool(on)
                met += bool(on)
    if any(c.codimension == 1 for c in listed.components):
        assert met


def turned(vector: Array, angle: float) -> Array:
    """About the vertical."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ vector


def delta_rods(v: Mapping[str, float]) -> tuple[list[Array], list[Array]]:
    """Directions of the forearms, and the horizontal axes of their motors."""
    rods, axes = [], []
    for number in range(3):
        angle, theta = 2 * np.pi / 3 * number, v[f"theta{number + 1}"]
        out = v["b"] - v["a"] - v["l"] * np.cos(theta)
        reach = turned(np.array([out, 0, v["l"] * np.sin(theta)]), angle)
        rods.append(reach + np.array([v["x"], v["y"], v["z"]]))
        axes.append(turned(np.array([0.0, 1, 0]), angle))
    return rods, axes


def coplanar_rods(v: Mapping[str, float]) -> float:
    return float(np.linalg.det(delta_rods(v)[0]))


def dependent_couples(v: Mapping[str, float]) -> float:
    """Each pair of rods carries the couple normal to its plane."""
    couples = [np.cross(axis, rod) for rod, axis in zip(*delta_rods(v), strict=True)]
    return float(np.linalg.det(couples))


def orthoglide_rods(v: Mapping[str, float]) -> float:
    rods = np.tile([v["x"], v["y"], v["z"]], (3, 1))
    return float(
        np.linalg.det(rods + np.diag([v[s] - v["b"] for s in ("s1", "s2", "s3")]))
    )


def h4_rods(v: Mapping[str, float]) -> tuple[list[Array], list[Array]]:
    """Directions of the four pairs, and their hinges from the middle of the bar."""
    bar = v["d"] * np.array([np.cos(v["phi"]), np.sin(v["phi"]), 0])
    p, r, e = np.array([v["x"], v["y"], v["z"]]), v["r"], v["e"]
    ends = [p + bar + [r, 0, 0], p + bar + [0, r, 0]]
    ends += [p - bar - [r, 0, 0], p - bar - [0, r, 0]]
    starts = [[v["s1"], e, 0], [e, v["s2"], 0], [v["s3"], -e, 0], [-e, v["s4"], 0]]
    rods = [end - np.array(start) for end, start in zip(ends, starts, strict=True)]
    return rods, [bar, bar, -bar, -bar]


def h4_locked(v: Mapping[str, float]) -> float:
    """A force along each pair: rows u·(velocity of its half), bar turning about k."""
    rods, hinges = h4_rods(v)
    rows = [
        [*u, (np.cross([0, 0, 1], h) @ u)] for u, h in zip(rods, hinges, strict=True)
    ]
    return float(np.linalg.det(rows)) / (
        v["d"] * v["z"]
    )  # factors that are no condition or another


def h4_couples(v: Mapping[str, float]) -> float:
    """Each half could only turn about n × n′; its hinge carries a couple across it."""
    (one, two, three, four), _ = h4_rods(v)
    i, j, _ = np.eye(3)
    first = np.cross(np.cross(j, one), np.cross(i, two))
    second = np.cross(np.cross(j, three), np.cross(i, four))
    return float(np.cross(first, second)[2]) / v["z"] ** 2  # from couples that are 0


GEOMETRY = [
    ("delta_ss", "actuation", coplanar_rods),
    ("delta_ss", "actuation", dependent_couples),
    ("delta_ss", "constraint", dependent_couples),
    ("delta_4r", "actuation", coplanar_rods),
    ("orthoglide", "actuation", orthoglide_rods),
    ("h4", "actuation", h4_locked),
    ("h4", "actuation", h4_couples),
    ("h4", "constraint", h4_couples),
]


@pytest.mark.parametrize(("name", "part", "determinant"), GEOMETRY)
def test_a_component_is_the_known_condition(
    name: str, part: str, determinant: Callable[[Mapping[str, float]], float]
) -> None:
    """One equation is the determinant of the geometry, up to a number."""
    listed = getattr(answer(name), part).components
    postures = [drawn(name, seed) for seed in range(8)]
    expected = np.array([determinant(v) for v in postures])
    alike = []
    for component in listed:
        if len(component.equations) == 1:
            ratios = [value(component.equations[0], v) for v in postures] / expected
            alike.append(np.ptp(ratios) < 1e-9 * abs(ratios[0]))
    assert sum(alike) == 1


def test_what_is_known_to_be_complete() -> None:
    for name in CASES:
        found = answer(name)
        assert all(limb.complete for limb in found.limb)
        assert found.actuation is not None
        assert found.actuation.complete
    for name in ("orthoglide", "h4", "watt_six_bar", "stephenson_six_bar"):
        assert answer(name).constraint.complete
    assert not answer("orthoglide").constraint.components


def parallel_forearms() -> Iterator[dict[str, float]]:
    """Of a Delta, two of its arms in line with their forearms, and these parallel.

    The shoulders at a·e, the elbows at a·e + l·(cos θ·e − sin θ·k), the wrists at
    P + b·e: a forearm is P − (a − b + l·cos θ)·e + l·sin θ·k.
    """
    a, b, arm, z = 1.4, 1.0, 1.1, 0.9
    own = {"a": a, "b": b, "l": arm}
    angle = math.acos((b - a) / arm)  # the elbows come together: P + l·sin θ·k both
    x = 2 * (arm * math.sin(angle) + z) * math.cos(angle) / math.sin(angle)
    yield own | {"theta2": angle, "theta3": angle, "x": x, "y": 0.0, "z": z}
    # All in the plane of the shoulders, where a forearm is P − (a − b + l)·e.
    flat = {"theta2": 0.0, "theta3": 0.0, "x": (b - a - arm) / 2, "y": 0.3, "z": 0.0}
    yield own | flat


def test_two_forearms_of_a_delta_in_line_with_their_arms() -> None:
    found = answer("delta_4r").constraint
    assert found.complete
    # Of each pair equal arms, crossed ones, and four ways to lie flat; all arms flat;
    # all outstretched with their forearms parallel to one plane.
    assert [c.codimension for c in found.components] == [4] * (3 * 6 + 2)
    for posture in parallel_forearms():
        given = drawn("delta_4r", 5) | posture
        on = [
            c
            for c in found.components
            if np.max(np.abs(values(c.equations, given))) < NOISE
        ]
        assert on
        assert clear_rank(at("delta_4r", given).loop_matrix()) < found.generic_rank


def test_a_link_without_length_is_on_no_component() -> None:
    """Where F comes upon E nothing is lost."""
    name = "stephenson_six_bar"
    found = answer(name).constraint
    given = drawn(name, 3)
    given |= {"xf": given["xe"], "yf": given["ye"]}
    on = [
        c
        for c in found.components
        if np.max(np.abs(values(c.equations, given))) < NOISE
    ]
    assert not on
    assert clear_rank(at(name, given).loop_matrix()) == found.generic_rank
