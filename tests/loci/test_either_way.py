"""Links that point along lines, with their angles kept: the 4-RUU robot.

Its first, second and third limb: the second link of one has no length in the plan, and
no height; the first links of the two others point to their joints B.
"""

from __future__ import annotations

import numpy as np
from loci.numeric import value
from loci.test_wrench_blocks import (
    LENGTHS,
    A,
    B,
    loop_rank,
    posture,
    robot,
    towards,
    turned,
)

from screwkit.algebra.branches import Branch
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search
from screwkit.loci.either_way import zeros_either_way
from screwkit.loci.loop_drop import imposed
from screwkit.loci.strata import in_ring, limb_strata


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
