"""Ranks and dimensions by singular values, where a posture is known in floats alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.grasping.exact_grasp import Ranks
from screwkit.metrics.indices import FloatGrasp
from screwkit.metrics.spans import split


def float_ranks(grasp: FloatGrasp) -> tuple[Ranks, tuple[int, ...], float]:
    """The seven ranks, the dimensions of the seven blocks, and the smallest gap.

    References: [BicchiPrattichizzo] eq. (5), in the order of `partition.BLOCKS`.
    """
    gaps = []
    parts = {"a": grasp.ja, "p": grasp.jp, "o": -grasp.gt}

    def rank(names: str) -> int:
        found = split(np.concatenate([parts[name] for name in names], axis=1))
        gaps.append(found.gap)
        return found.rank

    rows, actuated = grasp.ja.shape
    passive, twists = grasp.jp.shape[1], grasp.gt.shape[1]
    ranks = Ranks(
        rows,
        actuated,
        passive,
        twists,
        *(rank(names) for names in ("a", "p", "o", "ap", "ao", "po", "apo")),
    )
    if grasp.held is not None and grasp.held < rows:
        loops = [part[grasp.held :] for part in (grasp.jp, grasp.ja)]
        found = [split(loops[0]), split(np.concatenate(loops, axis=1))]
        gaps += [each.gap for each in found]
        ranks = replace(
            ranks,
            inside=rows - grasp.held,
            inside_p=found[0].rank,
            inside_ap=found[1].rank,
        )
    beside = split(_without_passive(grasp))
    gaps.append(beside.gap)
    return ranks, dimensions(ranks, actuated + twists - beside.rank), min(gaps)


def _without_passive(grasp: FloatGrasp) -> Array:
    """Rows whose null space is what a and o do together that p could take over."""
    known = split(grasp.jp)
    off = known.left_null_space.T
    zero = np.zeros((off.shape[0], grasp.gt.shape[1]))
    return np.concatenate(
        [
            np.concatenate([grasp.ja, -grasp.gt], axis=1),
            np.concatenate([off @ grasp.ja, zero], axis=1),
        ]
    )


def dimensions(ranks: Ranks, replaced: int) -> tuple[int, ...]:
    """The dimensions of the seven blocks from the ranks.

    Args:
        ranks: All seven.
        replaced: Dimension of the motions of actuated joints and object alone that
            passive joints can do as well: in ker [J_a −Gᵀ], with J_a q_a in im J_p.
    """
    a_r = ranks.actuated - ranks.a
    p_r = ranks.passive - ranks.p
    o_i = ranks.twists - ranks.o
    po_i = ranks.passive + ranks.twists - ranks.po - p_r - o_i
    ap_c = ranks.actuated + ranks.passive - ranks.ap - a_r - p_r
    ao_c = ranks.actuated + ranks.twists - ranks.ao - replaced
    total = ranks.actuated + ranks.passive + ranks.twists - ranks.apo
    before = a_r + p_r + o_i + po_i + ap_c + ao_c
    return a_r, p_r, o_i, po_i, ap_c, ao_c, total - before
