"""Links that point along lines, with their angles kept: the 4-RUU robot.

Its first, second and third limb: the second link of one has no length in the plan, and
no height; the first links of the two others point to their joints B.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from loci.numeric import value
from loci.test_wrench_blocks import (
    LENGTHS,
    A,
    B,
    loop_rank,
    on,
    posture,
    robot,
    towards,
    turned,
)

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.fixed_directions import fixed_directions, parted
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search, imposed
from screwkit.kinematics.loop_columns import loop_columns
from screwkit.loci.either_way import zeros_either_way
from screwkit.loci.exact_equations import Singularity, with_exact_equations
from screwkit.loci.loop_drop import loop_state, rank_is_lost
from screwkit.loci.pieces import Piece
from screwkit.loci.strata import in_ring, limb_strata
from screwkit.loci.wrench_blocks import block_minors


def folded_and_along() -> Branch:
    """Where limb 1 has C on B, and limbs 2 and 3 point to B."""
    case, _, along = robot()
    ring = case.common_twists.ring
    limb = case.limbs[0]
    own = in_ring(limb_strata(case, limb), case.limb_twists[limb.name].ring, ring)
    (folded,) = (s for s in own.strata if s.codimension == 3)
    branches = [case.root(ring)]
    for stratum in (folded, along[1][1], along[2][1]):
        for equation in stratum.equations:
            search = Search(case.library(ring))
            branches = [b for a in branches for b in imposed(a, equation, search)]
    (branch,) = branches
    return branch


def postures() -> list[dict[str, float]]:
    """Drawn on that branch."""
    source = np.random.default_rng(3)
    found = []
    for _ in range(3):
        phi, theta = (float(v) for v in source.uniform(-3, 3, 2))
        place = A * turned(0) + LENGTHS[0] * turned(theta) - B * turned(phi)
        thetas, etas = source.uniform(-3, 3, 4), source.uniform(-3, 3, 4)
        thetas[0] = theta
        for limb in (1, 2):
            thetas[limb] = towards(limb, place, phi)
        found.append(posture(place, phi, thetas, etas))
    return found


def test_with_angles_kept_nothing_is_left_open() -> None:
    """Regular postures lie on no find, those with parallel axes h on one."""
    case, limbs, _ = robot()
    ring = case.common_twists.ring
    branch = folded_and_along()
    search = Search(case.library(ring), budget=150)
    found, kept = zeros_either_way(branch, limbs, search, kept_first=True)
    assert kept
    assert not found.open
    assert not any(part.directed for part in found.branches)
    listed = {
        tuple(text(ring, condition) for condition in part.conditions)
        for part in found.branches
    }

    def lies_on_one(at: dict[str, float]) -> bool:
        return any(all(abs(value(e, at)) < 1e-9 for e in own) for own in listed)

    for at in postures():
        parallel = at | {f"eta{k}": 0.7 for k in range(1, 5)}
        assert loop_rank(at) == 16
        assert loop_rank(parallel) == 15
        assert not lies_on_one(at)
        assert lies_on_one(parallel)


def test_equations_of_four_stretched_links_are_exact() -> None:
    """With t = 1 − l/w, where the link of a limb is l of w: 1/t₁ + 1/t₃ = 1/t₂ + 1/t₄.

    The forces along the four second links have the determinant z·sin φ times the circle
    on which the lines meet times that.
    """
    case, limbs, _ = robot()
    ring = case.common_twists.ring
    root, library = case.root(ring), case.library(ring)
    stretched = replace(on((1, 1, 1, 1)), directed=True)
    lists = block_minors(stretched, limbs, 6, Search(library))
    assert lists is not None
    parts = parted(ring, lists[-1][0], fixed_directions(stretched), FactorLibrary(ring))
    assert parts is not None
    for at in postures():
        place, phi = np.array([at["x"], at["y"], 0.0]), at["phi"]
        here, ratios = at, []
        for k in range(4):
            here = here | {f"theta{k + 1}": towards(k, place, phi)}
            gap = place + B * turned(k * np.pi / 2 + phi) - A * turned(k * np.pi / 2)
            ratios.append(1 - LENGTHS[k] / np.linalg.norm(gap))
        first, second, third, fourth = ratios
        wanted = (first + third) * second * fourth - (second + fourth) * first * third
        lengths = np.prod([LENGTHS[k] / (1 - ratios[k]) for k in range(4)])
        got = value(text(ring, parts.rest), here) / lengths
        assert abs(got + wanted) < 1e-9 * abs(wanted)
    (branch,) = restricted(stretched, parts.rest)
    piece = Piece(branch.conditions, (replace(branch, directed=False),))
    generic = loop_state(root, limbs)
    assert generic is not None

    def holds_on(part: Branch) -> bool:
        state = loop_state(part, limbs)
        return state is not None and rank_is_lost(state, generic)

    singular = Singularity(root, lambda: loop_columns(limbs, 6), holds_on, library)
    exact = with_exact_equations([piece], singular)
    assert not exact.uncertain
    assert not exact.narrowed
