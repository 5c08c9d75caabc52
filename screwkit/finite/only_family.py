"""Families of closed postures beside which second order leaves nothing.

Rates may be more than motions wherever one stands: rods that are equal and parallel let
a plate turn for an instant in every posture, though it only translates.  Let F be a
smooth family of closed postures of dimension b, through a posture at which the rates of
second order have dimension b and are those of F.

* Where the rank is the same all over F, the equations beyond the rank vanish on F with
  their first derivatives.  They are quadratic forms in coordinates normal to F; at the
  posture these have no common zero but 0, hence none near by: F is all there is.
* Where one equation f is left in m = b + 1 unknowns, f = w g with F given by w = 0.
  Its second-order part is not zero, so that g = 0 is smooth too: each branch has
  dimension b.
* Where b is 1, no branch has more, and the posture is not isolated.

References: [ConnellyWhiteley1996] (second order), [GolubitskySchaeffer1985] §I.3 (the
equations beyond the rank).
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import replace

from screwkit.algebra.modular import annihilator
from screwkit.finite.chain_graph import ChainGraph
from screwkit.finite.closing_groups import (
    Closing,
    all_postures,
    smooth_subfamilies,
)
from screwkit.finite.higher_order import Form
from screwkit.finite.lie_closure import (
    UNMOVED,
    Displacement,
    carried,
    composed,
    random_step,
)


def only_family(block: ChainGraph, forms: Sequence[Form], bound: int) -> str | None:
    """How it is proved that all branches of a block have one dimension; None if not.

    Args:
        block: Of the mechanism, modulo a prime.
        forms: Its second-order forms.
        bound: The dimension b of the common zeros of the forms, less than the mobility.
    """
    rates = _without_second_order(block, forms)
    if not bound or len(rates) != bound:
        return None
    families = tuple(smooth_subfamilies(block, rates))
    if not families:
        return None
    there = (
        f"second order leaves {bound} of the {block.mobility} dimensions of the joint "
        f"rates, and a smooth family of dimension {bound} keeps the loops closed"
    )
    if any(_rank_on(block, family) == block.rank for family in families):
        return (
            f"{there}; the rank stays the same on it, so that no other postures are "
            f"around"
        )
    if bound == 1:
        return f"{there}: no motion through the posture has more dimensions"
    if block.mobility == bound + 1 and all_postures(block).deficit == 1:
        return (
            f"{there}; beyond first order one equation is left, which vanishes on it: "
            f"every branch through this posture has dimension {bound}"
        )
    return None


def _without_second_order(
    block: ChainGraph, forms: Sequence[Form]
) -> list[dict[int, int]]:
    """Basis of the rates that every form, as a bilinear one, maps to zero."""
    rows = [row for form in forms for row in form]
    prime = block.prime
    found = []
    for vector in annihilator(rows, block.mobility, prime):
        total: dict[int, int] = {}
        for factor, rates in zip(vector, block.rates, strict=True):
            for parameter, rate in rates.items():
                value = (total.get(parameter, 0) + factor * rate) % prime
                total[parameter] = value
        found.append({p: x for p, x in total.items() if x})
    return found


def _rank_on(block: ChainGraph, closing: Closing) -> int | None:
    """The rank at a random posture of a family whose loops all close identically."""
    if any(closing.dimensions) or closing.virtual:
        return None
    family, prime = closing.graph, block.prime
    source = random.Random(family.width)
    values = [
        (source.randrange(1, prime), source.randrange(prime))
        for _ in range(family.width)
    ]
    moved = dict(_displacements(family, values))
    edges = tuple(
        replace(edge, screw=carried(moved[edge.tail], edge.screw, prime))
        if edge.screw
        else edge
        for edge in block.edges
    )
    return ChainGraph(edges, block.width, prime, block.loops).rank


def _displacements(
    family: ChainGraph, values: Sequence[tuple[int, int]]
) -> Mapping[str, Displacement]:
    """Where every body goes from the first of its component."""
    found: dict[str, Displacement] = {}
    for body, path in family.paths.items():
        if not path:
            found[body] = UNMOVED
            continue
        number, sign = path[-1]
        edge = family.edges[number]
        here = found[edge.tail if sign > 0 else edge.head]
        if edge.screw:
            screw = tuple(sign * x for x in edge.screw)
            step = random_step(screw, *values[edge.parameter], family.prime)
            here = composed(here, step, family.prime)
        found[body] = here
    return found
