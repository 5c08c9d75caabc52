"""The 4-RUU robot: couples of all limbs, and a force of each limb that is singular.

A limb carries the couple across h.  Where its first link points to its platform joint B
it also carries the force along its second link CB; where the plan of CB is parallel to
h, a vertical force.  The couples being horizontal and two of them independent, forces
count by their direction and their moment about the vertical alone.
"""

from __future__ import annotations

from functools import cache
from itertools import combinations

import numpy as np
import pytest
from loci import nao
from loci.numeric import Array, value

from screwkit.algebra.branches import Branch
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search, imposed
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.limb_parts import Parts
from screwkit.kinematics.told_parts import told_parts
from screwkit.loci.dependence import Dependence, dependent_zeros
from screwkit.loci.strata import Stratum, in_ring, limb_strata
from screwkit.loci.wrench_blocks import block_minors
from screwkit.loci.wrench_sums import loop_rank_at
from screwkit.mechanism.files import read_mechanism

A, B = 5.0, 2.0
LENGTHS = (2.2, 1.4, 3.1, 2.6)
K = np.array([0.0, 0.0, 1.0])


def turned(angle: float) -> Array:
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def line(axis: Array, point: Array) -> Array:
    return np.concatenate([axis, np.cross(point, axis)])


def loop_rank(at: dict[str, float]) -> int:
    """Of the three loops, from the drawing of the robot, by singular values."""
    place = np.array([at["x"], at["y"], at["z"]])
    limbs = []
    for k in range(4):
        out = k * np.pi / 2
        start, end = A * turned(out), place + B * turned(out + at["phi"])
        middle = start + LENGTHS[k] * turned(at[f"theta{k + 1}"])
        h = turned(at[f"eta{k + 1}"])
        axes = [(K, start), (K, middle), (h, middle), (h, end), (K, end)]
        limbs.append(np.array([line(*axis) for axis in axes]).T)
    first, others = limbs[0], limbs[1:]
    beside = np.zeros((18, 15))
    for k, limb in enumerate(others):
        beside[6 * k : 6 * k + 6, 5 * k : 5 * k + 5] = limb
    whole = np.hstack([np.vstack([first] * 3), beside])
    singular = np.linalg.svd(whole, compute_uv=False)
    kept = int(np.sum(singular > 1e-7))
    assert singular[kept:].max(initial=0) < 1e-10
    return kept


@cache
def robot() -> tuple[Assembly, list[Parts], list[dict[int, Stratum]]]:
    """The limbs, and by limb its strata of codimension one: 1 the force along CB."""
    case = Assembly(read_mechanism(nao.ROOT / "cases" / "4ruu.yaml"))
    ring = case.common_twists.ring
    strata = []
    for limb in case.limbs:
        own = in_ring(
            limb_strata(case, limb), case.limb_twists[limb.name].ring, ring
        ).strata
        one, two = (s for s in own if s.codimension == 1)
        angle = f"eta{case.limbs.index(limb) + 1}"
        has_eta = angle in text(ring, one.equations[0]).replace("theta", "")
        strata.append({1: two, 2: one} if has_eta else {1: one, 2: two})
    return case, [told_parts(case, limb) for limb in case.limbs], strata


def on(kinds: tuple[int, ...]) -> Branch:
    """Where limbs carry a force along CB (1), a vertical one (2), or none (0)."""
    case, _, strata = robot()
    ring = case.common_twists.ring
    branch = case.root(ring)
    for own, kind in zip(strata, kinds, strict=True):
        if kind:
            condition, search = own[kind].equations[0], Search(case.library(ring))
            (branch,) = imposed(branch, condition, search)
    return branch


def zeros(kinds: tuple[int, ...]) -> Dependence:
    case, limbs, _ = robot()
    search = Search(case.library(case.common_twists.ring))
    return dependent_zeros(on(kinds), limbs, search, within=True, in_blocks=True)


def posture(place: Array, phi: float, thetas: Array, etas: Array) -> dict[str, float]:
    found = {"a": A, "b": B, "phi": phi}
    found |= {f"l{k + 1}": length for k, length in enumerate(LENGTHS)}
    found |= dict(zip("xyz", map(float, place), strict=True))
    for k in range(4):
        found |= {f"theta{k + 1}": float(thetas[k]), f"eta{k + 1}": float(etas[k])}
    return found


def lists_that_vanish(kinds: tuple[int, ...], at: dict[str, float]) -> int:
    case, limbs, _ = robot()
    ring = case.common_twists.ring
    lists = block_minors(on(kinds), limbs, 6, Search(case.library(ring)))
    assert lists is not None
    return sum(
        all(abs(value(text(ring, minor), at)) < 1e-9 for minor in minors)
        for minors in lists
    )


def towards(limb: int, place: Array, phi: float) -> float:
    """The direction of the first link along which it points to B."""
    out = limb * np.pi / 2
    gap = place + B * turned(out + phi) - A * turned(out)
    return float(np.arctan2(gap[1], gap[0]))


def drawn(source: np.random.Generator, along: tuple[int, ...]) -> dict[str, float]:
    """A random posture at which the first links of these limbs point to B."""
    place, phi = source.uniform(-1, 1, 3), float(source.uniform(-3, 3))
    thetas, etas = source.uniform(-3, 3, 4), source.uniform(-3, 3, 4)
    for limb in along:
        thetas[limb] = towards(limb, place, phi)
    return posture(place, phi, thetas, etas)


@pytest.mark.parametrize("along", [(1,), (1, 3), (0, 1, 2)])
def test_at_other_postures_no_list_vanishes(along: tuple[int, ...]) -> None:
    source = np.random.default_rng(len(along))
    kinds = tuple(int(limb in along) for limb in range(4))
    for _ in range(2):
        at = drawn(source, along)
        assert loop_rank(at) == 16
        assert lists_that_vanish(kinds, at) == 0


@pytest.mark.parametrize("along", [(1,), (1, 3), (0, 1, 2)])
def test_a_list_vanishes_where_all_couples_are_parallel(along: tuple[int, ...]) -> None:
    at = drawn(np.random.default_rng(5), along)
    at |= {"eta1": 0.4, "eta2": 0.4, "eta3": 0.4 + np.pi, "eta4": 0.4}
    assert loop_rank(at) == 15
    kinds = tuple(int(limb in along) for limb in range(4))
    assert lists_that_vanish(kinds, at) == 1


def flat(phi: float, place: Array, along: tuple[int, ...]) -> dict[str, float]:
    """The posture at which B lies at the height of the first links."""
    thetas, etas = np.array([0.3, -1.2, 2.2, 0.9]), np.array([0.2, 1.1, -0.8, 2.0])
    for limb in along:
        thetas[limb] = towards(limb, place, phi)
    return posture(place * [1, 1, 0], phi, thetas, etas)


@pytest.mark.parametrize(
    ("along", "at"),
    [
        # Two forces on one line: the platform straight between the limbs.
        ((1, 3), flat(0.0, np.array([0.0, 0.7, 0.0]), (1, 3))),
        ((0, 2), flat(np.pi, np.array([-0.4, 0.0, 0.0]), (0, 2))),
        # Three through one point of a plane: the platform is the base, made smaller.
        ((0, 1, 2), flat(0.0, np.array([0.3, -0.6, 0.0]), (0, 1, 2))),
    ],
)
def test_a_list_vanishes_where_forces_are_dependent(
    along: tuple[int, ...], at: dict[str, float]
) -> None:
    assert loop_rank(at) == 15
    assert lists_that_vanish(tuple(int(i in along) for i in range(4)), at) == 1


def test_two_vertical_forces_are_always_dependent() -> None:
    """All couples beside, a vertical force is the same wherever it acts."""
    for one, two in combinations(range(4), 2):
        kinds = tuple(2 * (limb in (one, two)) for limb in range(4))
        _, limbs, _ = robot()
        assert loop_rank_at(limbs, 6, *on(kinds).points[0]) == 15


@pytest.mark.parametrize("kinds", [(0, 1, 0, 1), (0, 1, 2, 0)])
def test_pairs_of_singular_limbs_are_searched_to_the_end(
    kinds: tuple[int, ...],
) -> None:
    found = zeros(kinds)
    assert found.branches
    assert not found.open


def test_forces_on_one_line_are_listed() -> None:
    """Of limbs 2 and 4: B at their height, and all four points on the y axis."""
    case, _, _ = robot()
    ring = case.common_twists.ring
    at = flat(0.0, np.array([0.0, 0.7, 0.0]), (1, 3))
    near = at | {"z": 0.1}
    assert loop_rank(near) == 16
    listed = [
        [text(ring, condition) for condition in branch.conditions]
        for branch in zeros((0, 1, 0, 1)).branches
    ]
    assert any(all(abs(value(e, at)) < 1e-9 for e in own) for own in listed)
    assert not any(all(abs(value(e, near)) < 1e-9 for e in own) for own in listed)
