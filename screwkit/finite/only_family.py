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

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.algebra.modular import annihilator
from screwkit.algebra.series_modulo import common_roots
from screwkit.finite.chain_graph import ChainGraph
from screwkit.finite.closing_groups import (
    Closing,
    all_postures,
    smooth_subfamilies,
)
from screwkit.finite.family_posture import (
    displacements,
    moved_graph,
    random_values,
)
from screwkit.finite.higher_order import Form


@dataclass(frozen=True)
class OnlyFamily:
    """A family of closed postures of the dimension that no branch exceeds.

    Attributes:
        closing: The family.
        reason: The argument as a sentence without capital and full stop.
        whole: Whether there are no other postures around.
    """

    closing: Closing
    reason: str
    whole: bool


def only_family(
    block: ChainGraph, forms: Sequence[Form], bound: int
) -> OnlyFamily | None:
    """The family that proves all branches to have one dimension; None without one.

    Args:
        block: Of the mechanism, modulo a prime.
        forms: Its second-order forms.
        bound: The dimension b of the common zeros of the forms, less than the mobility.
    """
    rates = _without_second_order(block, forms)
    if not bound or len(rates) != bound:
        return None
    first: Closing | None = None
    there = (
        f"second order leaves {bound} of the {block.mobility} dimensions of the joint "
        f"rates, and a smooth family of dimension {bound} keeps the loops closed"
    )
    for family in smooth_subfamilies(block, rates):
        if rank_on(block, family) == block.rank:
            told = (
                f"{there}; the rank stays the same on it, so that no other postures "
                f"are around"
            )
            return OnlyFamily(family, told, whole=True)
        first = first or family
    if first is None:
        return None
    if bound == 1:
        told = f"{there}: no motion through the posture has more dimensions"
        return OnlyFamily(first, told, whole=False)
    if block.mobility == bound + 1 and all_postures(block).deficit == 1:
        told = (
            f"{there}; beyond first order one equation is left, which vanishes on it: "
            f"every branch through this posture has dimension {bound}"
        )
        return OnlyFamily(first, told, whole=False)
    return None


def family_on_the_cone(block: ChainGraph, forms: Sequence[Form]) -> Closing | None:
    """A family of dimension 1 along one of the zeros of forms in two variables."""
    if block.mobility != 2:
        return None
    prime = block.prime
    one, other = block.rates
    zeros = [(0, 1)] if all(form[1][1] == 0 for form in forms) else []
    slopes = [(form[0][0], 2 * form[0][1], form[1][1]) for form in forms]
    zeros += [(1, root) for root in common_roots(slopes, prime)]
    for x, y in zeros:
        rates = {
            p: (x * one.get(p, 0) + y * other.get(p, 0)) % prime for p in {*one, *other}
        }
        moving = {p: rate for p, rate in rates.items() if rate}
        for family in smooth_subfamilies(block, [moving]):
            return family
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


def rank_on(block: ChainGraph, closing: Closing) -> int | None:
    """The rank at a random posture of a family whose loops all close identically."""
    if not closing.identical:
        return None
    family = closing.graph
    places = displacements(family, random_values(family))
    return moved_graph(block, places).rank
