"""Proofs by second and higher orders: motions that go on, and rates that do not.

Where ranks and groups decide nothing, a loop may still close identically, which series
show; or the rates may open a loop at some order, so that the posture is isolated or the
finite motions through it are fewer.

References: [ConnellyWhiteley1996].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.finite.chain_graph import ChainGraph
from screwkit.finite.closing_groups import Closing, all_postures, smooth_family
from screwkit.finite.double_family import double_family
from screwkit.finite.higher_order import (
    cone_dimension,
    continuation,
    second_order_forms,
)
from screwkit.finite.only_family import family_on_the_cone, only_family
from screwkit.finite.real_forms import (
    Matrix,
    definite_combination,
    indefinite,
    real_forms,
    turns_around,
)
from screwkit.finite.tied_families import subfamily
from screwkit.kinematics.exact_postures import ExactPosture

LARGEST_FOR_ORDERS = 60
"""Freedoms of a block up to which higher orders are computed."""

LARGEST_FORM = 14
"""Mobility of a block up to which second-order conditions are."""

MOST_TRIALS = 24

IDENTICAL = (
    "along the motion {} through order {}, and equations of such degrees that hold so "
    "far hold identically"
)


@dataclass(frozen=True)
class Proved:
    """The finite mobility of a block, with the argument.

    Attributes:
        mobility: Of all branches, or of the largest.
        reason: The argument as a sentence without capital and full stop.
        closing: A family of postures of that dimension, where one is known.
        whole: Whether that family is all there is around the posture.
        others: Of further branches.
    """

    mobility: int
    reason: str
    closing: Closing | None = None
    whole: bool = False
    others: tuple[int, ...] = ()


_ALL = "so all postures around it form a smooth family"
_ISOLATED = "the posture is isolated, the structure shaky"


def smooth(mobility: int) -> str:
    """How sentences end that prove a manifold."""
    return f"{_ALL} of dimension {mobility}"


def of_a_part(reason: str) -> str:
    """The argument where it is about a part of a mechanism that moves otherwise too."""
    found = reason.replace(_ALL, "so that its own postures form a smooth family")
    return found.replace(_ISOLATED, "this part is shaky and rests")


def proved_by_order(
    blocks: tuple[ChainGraph, ChainGraph],
    postures: tuple[ExactPosture, ExactPosture],
) -> Proved | None:
    """Loops that close identically, or rates that lead nowhere or not everywhere.

    Args:
        blocks: The same block modulo two primes.
        postures: Of both.
    """
    block = blocks[0]
    if block.width > LARGEST_FOR_ORDERS:
        return None
    followed = continuation(block)
    if followed.fails_at is None:
        if not followed.identical:
            return None
        return Proved(
            block.mobility,
            f"{IDENTICAL.format('the loops close', followed.checked)}, "
            f"{smooth(block.mobility)}",
        )
    if block.mobility == 1:
        return Proved(
            0,
            f"the one motion that first order allows opens a loop at order "
            f"{followed.fails_at}: {_ISOLATED}",
        )
    if block.mobility > LARGEST_FORM:
        return None
    forms = second_order_forms(block)
    bound = cone_dimension(forms, block.mobility, block.prime)
    if not bound:
        return Proved(0, _SHAKY)
    single = (
        f"second order leaves no more than single motions of the {block.mobility}-"
        f"dimensional joint rates, and one of them is finite"
    )
    ends = "the postures form a smooth family of dimension 1"
    if bound == 1 and _moves_with_joints_held(block):
        return Proved(1, f"{single}: with some joints held {ends}")
    only = only_family(block, forms, bound) if bound < block.mobility else None
    if only is not None:
        return Proved(bound, only.reason, only.closing, only.whole)
    if not forms:
        left = all_postures(block).deficit
        return _of_double_family(blocks, postures, followed.fails_at, left)
    twins = second_order_forms(blocks[1])
    real = real_forms(postures, (forms, twins)) if forms else None
    of_signs = None if real is None else _of_real_forms(block, real)
    if of_signs is not None or bound != 1:
        return of_signs
    tied = family_on_the_cone(block, forms)
    told = f"{single}: with joints tied or held {ends}"
    return None if tied is None else Proved(1, told, tied)


def _moves_with_joints_held(block: ChainGraph) -> bool:
    """Whether a family of dimension one is found with some joints at rest."""
    every = frozenset(range(block.width))
    held = [every - frozenset(rates) for rates in block.rates]
    if block.mobility == 2:
        held += [frozenset({p}) for p in sorted(every)]
    for still in dict.fromkeys(held[:MOST_TRIALS]):
        part = subfamily(block, (), still)
        if part.mobility != 1:
            continue
        if smooth_family(part, ()) is not None:
            return True
        followed = continuation(part)
        if followed.fails_at is None and followed.identical:
            return True
    return False


def _of_real_forms(block: ChainGraph, real: Sequence[Matrix]) -> Proved | None:
    """By the signs of the second-order conditions, where the geometry is in numbers.

    A definite combination leaves no rates.  If one equation f = 0 alone is left beyond
    first order and its form is indefinite, then f = x² − y² + g(z) in suitable
    coordinates (the splitting lemma), and the solutions y² = x² + g(z) have dimension
    m − 1 wherever they are, since a larger |x| leads away from every edge.
    """
    if definite_combination(real):
        return Proved(0, _SHAKY)
    if len(real) != 1 or not indefinite(real[0]) or all_postures(block).deficit != 1:
        return None
    one_less = block.mobility - 1
    where = (
        "two branches cross here"
        if one_less == 1
        else f"every branch through this posture has dimension {one_less}"
    )
    return Proved(
        one_less,
        f"beyond first order one equation is left for the {block.mobility}-dimensional "
        f"joint rates, and its second-order part takes both signs: {where}",
    )


def _of_double_family(
    blocks: tuple[ChainGraph, ChainGraph],
    postures: tuple[ExactPosture, ExactPosture],
    order: int,
    left: int,
) -> Proved | None:
    """By the other factors of equations that vanish twice on a family."""
    one = double_family(blocks[0], order, left)
    if one is None:
        return None
    mobility = blocks[0].mobility
    equations = "one equation is" if left == 1 else f"{left} equations are"
    begin = "which begins at" if left == 1 else "which begin at"
    told = (
        f"beyond first order {equations} left for the {mobility}-dimensional joint "
        f"rates, {begin} order {order} and vanish{'es' * (left == 1)} twice on a "
        f"smooth family of dimension {mobility - 1} that keeps the loops closed"
    )
    ends = f": every branch through this posture has dimension {mobility - 1}"
    if order == 3:
        return Proved(
            mobility - 1, f"{told}; its other factor is regular{ends}", one.closing
        )
    two = double_family(blocks[1], order, left)
    if not one.rest or two is None or not two.rest:
        return None
    real = real_forms(postures, (one.rest, two.rest))
    if real is None:
        return None
    if left == 1:
        if not indefinite(real[0]):
            return None
        told = f"{told}; its other factor takes both signs{ends}"
        return Proved(mobility - 1, told, one.closing)
    if not one.crossed or not turns_around(real):
        return None
    return Proved(
        mobility - 1,
        f"{told}; their other factors, which turn around it, leave branches of "
        f"dimension {mobility - 2} beside it",
        one.closing,
        others=(mobility - 2,),
    )


_SHAKY = f"no joint rates keep the loops closed to second order: {_ISOLATED}"


def bound_by_order(block: ChainGraph) -> tuple[int, int]:
    """What no motion of a block exceeds, and the order that shows it; 0 where none.

    To second order the dimension of the cone of rates; where every rate is good to
    second order, one less than all of them if a generic motion fails at a higher one.
    """
    mobility = block.mobility
    if not 0 < mobility <= LARGEST_FORM:
        return mobility, 0
    forms = second_order_forms(block)
    bound = cone_dimension(forms, mobility, block.prime)
    if bound < mobility:
        return bound, 2
    if block.width > LARGEST_FOR_ORDERS:
        return mobility, 0
    order = continuation(block).fails_at
    return (mobility, 0) if order is None else (mobility - 1, order)
