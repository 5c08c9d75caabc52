"""Exact proofs of the finite mobility at a posture.

Every argument compares the instantaneous mobility, which no finite mobility around the
posture exceeds, with a family of closed postures that is proved to exist, or shows by
higher orders that the rates lead nowhere.  Parts of the mechanism whose loops share no
joint are taken one by one.  Ranks are exact modulo two primes; where no argument
applies nothing is claimed.

References: [Herve1999], [RicoRavani2003], [ConnellyWhiteley1996].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.kinematics.chain_graph import INNER, ChainGraph, chain_graph
from screwkit.kinematics.closing_groups import (
    Closing,
    all_postures,
    smooth_family,
)
from screwkit.kinematics.exact_postures import ExactPosture
from screwkit.kinematics.higher_order import (
    cone_dimension,
    continuation,
    second_order_forms,
)
from screwkit.kinematics.network import Motion, Network, motion
from screwkit.kinematics.real_forms import (
    Matrix,
    definite_combination,
    indefinite,
    real_forms,
)

LARGEST_FOR_ORDERS = 60
"""Freedoms of a block up to which higher orders are computed."""

LARGEST_FORM = 14
"""Mobility of a block up to which second-order conditions are."""


@dataclass(frozen=True)
class Proof:
    """A finite mobility that is proved.

    Attributes:
        mobility: Of the branches through the posture, ascending; one where the closed
            postures around it are a manifold.
        reason: The argument as a sentence without capital and full stop.
    """

    mobility: tuple[int, ...]
    reason: str


@dataclass(frozen=True)
class UpperBound:
    """What no branch through the posture exceeds.

    Attributes:
        mobility: The bound.
        reason: The argument as a sentence without capital and full stop.
    """

    mobility: int
    reason: str


def proved_mobility(network: Network, at: Motion) -> Proof | None:
    """The finite mobility around a posture, if an exact argument gives it.

    Args:
        network: The mechanism.
        at: Its motion at the posture.

    Returns:
        None where no argument applies.
    """
    twin = _twin(network, at)
    graph = chain_graph(at)
    if twin is None or graph.mobility != at.mobility:
        return None
    equations = len(network.rows)
    whole = _of_first_order(graph, equations)
    if whole is not None:
        return whole
    blocks = graph.blocks()
    postures = at.posture, twin.posture
    dimension = free = graph.width - sum(block.width for block in blocks)
    reasons: dict[str, int] = {}
    for block, other in zip(blocks, chain_graph(twin).blocks(), strict=True):
        proof = _of_first_order(block, equations)
        if proof is None and not _has_contact(network, block):
            ends = network.mechanism.base, network.mechanism.platform
            proof = _of_family(block, ends)
            proof = proof or _of_higher_order((block, other), postures)
        if proof is None:
            return None
        dimension += proof.mobility[0]
        reasons[proof.reason] = reasons.get(proof.reason, 0) + 1
    told = "; ".join(
        f"{reason} ({count} times)" if count > 1 else reason
        for reason, count in reasons.items()
    )
    if len(blocks) > 1:
        told = f"the loops fall into {len(blocks)} parts that share no joint: {told}"
    if free:
        told += f"; joints on no loop add {free}"
    return Proof((dimension,), told)


def upper_bound(network: Network, at: Motion) -> UpperBound | None:
    """A bound of all finite mobilities, if one below the rates' dimension is proved."""
    graph = chain_graph(at)
    if _twin(network, at) is None or graph.mobility != at.mobility:
        return None
    blocks = graph.blocks()
    dimension = graph.width - sum(block.width for block in blocks)
    for block in blocks:
        contact = _has_contact(network, block)
        dimension += block.mobility if contact else _second_order(block)
    if dimension >= at.mobility:
        return None
    return UpperBound(
        dimension,
        f"of the {at.mobility}-dimensional joint rates at this posture only a cone of "
        f"dimension {dimension} keeps the loops closed to second order",
    )


def _twin(network: Network, at: Motion) -> Motion | None:
    """The motion modulo another prime; None where the ranks disagree."""
    if any(at is known for known in network.motions):
        motions: Sequence[Motion] = network.motions
    else:
        postures = network.postures
        motions = [motion(network, posture, at.locked) for posture in postures]
    if any(other.rank != at.rank for other in motions):
        return None
    return next(m for m in motions if m.posture.prime != at.posture.prime)


def _of_first_order(graph: ChainGraph, equations: int) -> Proof | None:
    """Ranks alone, valid whatever the joints are beyond first order."""
    if not graph.rank and not any(block.width for block in graph.blocks()):
        return Proof(
            (graph.mobility,), "no loop restrains the joints: every joint moves freely"
        )
    if not graph.mobility:
        return Proof(
            (0,), "no joint rates keep the loops closed: rigid already to first order"
        )
    count = equations * len(graph.fundamental_cycles)
    if graph.rank < count:
        return None
    return Proof(
        (graph.mobility,),
        f"the {count} closure equations are independent at this posture, "
        f"{_smooth(graph.mobility)}",
    )


def _of_family(block: ChainGraph, ends: Sequence[str]) -> Proof | None:
    """A smooth family of the full instantaneous mobility."""
    closing = smooth_family(block, ends)
    if closing is None:
        return None
    return Proof((block.mobility,), _in_words(closing, block.mobility))


def _of_higher_order(
    blocks: tuple[ChainGraph, ChainGraph],
    postures: tuple[ExactPosture, ExactPosture],
) -> Proof | None:
    """Loops that close identically, or rates that lead nowhere or not everywhere."""
    block = blocks[0]
    if block.width > LARGEST_FOR_ORDERS:
        return None
    followed = continuation(block)
    if followed.fails_at is None:
        if not followed.identical:
            return None
        return Proof(
            (block.mobility,),
            f"{_IDENTICAL.format('the loops close', followed.checked)}, "
            f"{_smooth(block.mobility)}",
        )
    if block.mobility == 1:
        return Proof(
            (0,),
            f"the one motion that first order allows opens a loop at order "
            f"{followed.fails_at}: the posture is isolated, the structure shaky",
        )
    if block.mobility > LARGEST_FORM:
        return None
    forms = second_order_forms(block)
    if not cone_dimension(forms, block.mobility, block.prime):
        return Proof((0,), _SHAKY)
    twins = second_order_forms(blocks[1])
    real = real_forms(postures, (forms, twins)) if forms else None
    return None if real is None else _of_real_forms(block, real)


def _of_real_forms(block: ChainGraph, real: Sequence[Matrix]) -> Proof | None:
    """By the signs of the second-order conditions, where the geometry is in numbers.

    A definite combination leaves no rates.  If one equation f = 0 alone is left beyond
    first order and its form is indefinite, then f = x² − y² + g(z) in suitable
    coordinates (the splitting lemma), and the solutions y² = x² + g(z) have dimension
    m − 1 wherever they are, since a larger |x| leads away from every edge.
    """
    if definite_combination(real):
        return Proof((0,), _SHAKY)
    if len(real) != 1 or not indefinite(real[0]) or all_postures(block).deficit != 1:
        return None
    one_less = block.mobility - 1
    where = (
        "two branches cross here"
        if one_less == 1
        else f"every branch through this posture has dimension {one_less}"
    )
    return Proof(
        (one_less,),
        f"beyond first order one equation is left for the {block.mobility}-dimensional "
        f"joint rates, and its second-order part takes both signs: {where}",
    )


_IDENTICAL = (
    "along the motion {} through order {}, and equations of such degrees that hold so "
    "far hold identically"
)

_SHAKY = (
    "no joint rates keep the loops closed to second order: the posture is isolated, "
    "the structure shaky"
)


def _second_order(block: ChainGraph) -> int:
    """Dimension of the rates that second order allows, or an upper bound of it."""
    if not 0 < block.mobility <= LARGEST_FORM:
        return block.mobility
    forms = second_order_forms(block)
    return cone_dimension(forms, block.mobility, block.prime)


def _has_contact(network: Network, block: ChainGraph) -> bool:
    """Whether fingers touch in it, whose surfaces decide all but the first order."""
    return any(edge.name in network.contact_labels for edge in block.edges)


def _in_words(closing: Closing, mobility: int) -> str:
    said = []
    if closing.tied:
        said.append("with parallel joints kept at equal or opposite angles")
    if closing.held:
        said.append("with the joints that are at rest held")
    if closing.virtual:
        pairs = [f"{_body(b)} relative to {_body(a)}" for a, b in closing.virtual]
        said.append(f"with {_listed(pairs)} guided in the group of its motions")
    if closing.followed and len(closing.basis) == 1:
        said.append(_IDENTICAL.format("the loop closes", closing.followed[0]))
        return f"{', '.join(said)}, {_smooth(mobility)}"
    if closing.followed:
        orders = _listed([str(order) for order in closing.followed])
        which = "one loop closes" if len(closing.followed) == 1 else "some loops close"
        said.append(_IDENTICAL.format(which, orders))
        said.append(
            f"with these the loops leave {_listed(list(map(str, closing.dimensions)))} "
            f"equations, all of them independent"
        )
        return f"{', '.join(said)}, {_smooth(mobility)}"
    free = closing.dimensions.count(0)
    groups = [str(d) for d in closing.dimensions if d]
    if free:
        loops = "a loop closes" if free == 1 else f"{free} loops close"
        said.append(f"{loops} identically")
    rest = "the others" if free else "the loops"
    if len(groups) > 3 and len(set(groups)) == 1:
        said.append(f"{len(groups)} loops close in groups of dimension {groups[0]}")
    elif len(groups) > 1:
        said.append(f"{rest} close in groups of dimension {_listed(groups)}")
    elif groups:
        rest = "one more" if free else "the loop"
        said.append(f"{rest} closes in a group of dimension {groups[0]}")
    if groups:
        total = sum(closing.dimensions)
        said.append(f"where their {total} equations are independent")
    return f"{', '.join(said)}, {_smooth(mobility)}"


def _body(name: str) -> str:
    """A body, or what is between two freedoms of a joint."""
    inner = name.startswith(INNER)
    return f"what follows {name.removeprefix(INNER)}" if inner else name


def _smooth(mobility: int) -> str:
    return f"so all postures around it form a smooth family of dimension {mobility}"


def _listed(items: Sequence[str]) -> str:
    return " and ".join(filter(None, (", ".join(items[:-1]), items[-1])))
