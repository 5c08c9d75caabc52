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
from dataclasses import dataclass, replace

from screwkit.finite.chain_graph import INNER, ChainGraph, chain_graph
from screwkit.finite.closing_groups import Closing, smooth_family
from screwkit.finite.family_motion import FamilyMotion, family_motion
from screwkit.finite.idle_freedoms import idle_freedoms, idle_motions
from screwkit.finite.implied_rods import implied_rods, without_rods
from screwkit.finite.order_proofs import (
    IDENTICAL,
    Proved,
    bound_by_order,
    of_a_part,
    proved_by_order,
    smooth,
)
from screwkit.finite.own_axes import in_own_axes
from screwkit.finite.tied_families import subfamily
from screwkit.kinematics.network import Motion, Network, motion


@dataclass(frozen=True)
class Proof:
    """A finite mobility that is proved.

    Attributes:
        mobility: Of the branches through the posture, ascending; one where the closed
            postures around it are a manifold.  The largest is that of the family.
        reason: The argument as a sentence without capital and full stop.
        motion: How the platform moves along a family of that mobility, where that is
            exact.
        whole: Whether that family is all there is around the posture.
    """

    mobility: tuple[int, ...]
    reason: str
    motion: FamilyMotion | None = None
    whole: bool = True


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
    if twin is None:
        return None
    given, at, twin = at, in_own_axes(at), in_own_axes(twin)
    graph = chain_graph(at)
    if graph.mobility != at.mobility:
        return None
    equations = len(network.rows)
    whole = _of_first_order(graph, equations)
    if whole is not None:
        moved = None if graph.rank else _motion(at, graph, [], [], ())
        return Proof((whole.mobility,), whole.reason, moved)
    spins = idle_motions(at)
    idle = tuple(label for spin in spins for label in spin.held)
    implied = implied_rods(at, spins)
    graph, other_graph = (
        without_rods(each, chain_graph(each, idle), implied) for each in (at, twin)
    )
    if graph.mobility + len(idle) != at.mobility:
        return None
    blocks, others = _moving_blocks(graph), _moving_blocks(other_graph)
    free = graph.width - sum(block.width for block in blocks)
    dimensions = {free + len(idle)}
    postures = at.posture, twin.posture
    reasons: dict[str, int] = {}
    proofs: list[Proved] = []
    for block, other in zip(blocks, others, strict=True):
        proof = _of_first_order(block, equations)
        if proof is None and not _has_contact(network, block):
            ends = network.mechanism.base, network.mechanism.platform
            proof = _of_family(block, ends)
            proof = proof or _of_family_askew(block, given, ends)
            proof = proof or proved_by_order((block, other), postures)
        if proof is None:
            return None
        own = proof.mobility, *proof.others
        dimensions = {one + other for one in dimensions for other in own}
        proofs.append(proof)
        reasons[proof.reason] = reasons.get(proof.reason, 0) + 1
    partial = len(blocks) > 1 or free > 0 or bool(idle)
    arguments = {of_a_part(r) if partial else r: n for r, n in reasons.items()}
    told = "; ".join(
        f"{reason} ({count} times)" if count > 1 else reason
        for reason, count in arguments.items()
    )
    if len(blocks) > 1:
        told = f"the loops fall into {len(blocks)} parts that share no joint: {told}"
    apart = []
    if free:
        apart.append(f"the freedom of joints on no loop ({free})")
    apart += _shared(at, len(idle))
    if implied:
        apart.append(f"rods whose lengths follow from those of others ({len(implied)})")
    if apart:
        told = f"apart from {_listed(apart)}, {told}"
    alone = all(proof.whole or not proof.mobility for proof in proofs)
    moved = _motion(at, graph, blocks, proofs, idle)
    return Proof(tuple(sorted(dimensions)), told, moved, alone)


def _shared(at: Motion, count: int) -> list[str]:
    """Whose two joints share the freedoms held; idle are those of neither end alone."""
    base, platform = at.network.mechanism.base, at.network.mechanism.platform
    others = len(idle_freedoms(at, {base}))
    idle = len(idle_freedoms(at, {base, platform}))
    apart = [
        f"the freedom that the two joints of {body} share ({shared})"
        for body, shared in ((base, count - others), (platform, others - idle))
        if shared
    ]
    if idle:
        apart.append(f"the idle freedom of bodies between two joints ({idle})")
    return apart


def _motion(
    at: Motion,
    graph: ChainGraph,
    blocks: Sequence[ChainGraph],
    proofs: Sequence[Proved],
    idle: tuple[str, ...],
) -> FamilyMotion | None:
    """The platform's motion, where families of all blocks are known."""
    network = at.network
    base, platform = network.mechanism.base, network.mechanism.platform
    ends = {base, platform}
    if network.contact_labels or len(ends) == 1:
        return None
    if idle != idle_freedoms(at, ends):
        return None  # what spins is one of the two bodies themselves
    families = []
    for block, proof in zip(blocks, proofs, strict=True):
        if not proof.mobility:
            families.append(subfamily(block, (), frozenset(range(block.width))))
        elif proof.closing and proof.closing.identical:
            families.append(proof.closing.graph)
        else:
            return None
    found = family_motion(graph, families, base, platform)
    return found and replace(found, mobility=found.mobility + len(idle))


def upper_bound(network: Network, at: Motion) -> UpperBound | None:
    """A bound of all finite mobilities, if one below the rates' dimension is proved."""
    idle = idle_freedoms(at)
    graph = chain_graph(at, idle)
    if _twin(network, at) is None or graph.mobility + len(idle) != at.mobility:
        return None
    blocks = graph.blocks()
    dimension = len(idle) + graph.width - sum(block.width for block in blocks)
    highest = 0
    for block in blocks:
        contact = _has_contact(network, block)
        bound, order = (block.mobility, 0) if contact else bound_by_order(block)
        dimension, highest = dimension + bound, max(highest, order)
    if dimension >= at.mobility:
        return None
    return UpperBound(
        dimension,
        f"of the {at.mobility}-dimensional joint rates at this posture no more than a "
        f"cone of dimension {dimension} keeps the loops closed through order {highest}",
    )


def rests_on_contacts(network: Network, at: Motion) -> bool:
    """Whether contacts lie in loops of which first order does not tell the motion."""
    return any(
        _has_contact(network, block)
        for block in chain_graph(at).blocks()
        if block.width and _of_first_order(block, len(network.rows)) is None
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


def _of_first_order(graph: ChainGraph, equations: int) -> Proved | None:
    """Ranks alone, valid whatever the joints are beyond first order."""
    if not graph.rank and not any(block.width for block in graph.blocks()):
        told = "no loop restrains the joints: every joint moves freely"
        if not graph.mobility:
            told = "no joint has a freedom"
        return Proved(graph.mobility, told)
    if not graph.mobility:
        return Proved(
            0, "no joint rates keep the loops closed: rigid already to first order"
        )
    count = equations * len(graph.fundamental_cycles)
    if graph.rank < count:
        return None
    return Proved(
        graph.mobility,
        f"the {count} closure equations are independent at this posture, "
        f"{smooth(graph.mobility)}",
    )


def _of_family(block: ChainGraph, ends: Sequence[str]) -> Proved | None:
    """A smooth family of the full instantaneous mobility."""
    closing = smooth_family(block, ends)
    if closing is None:
        return None
    return Proved(
        block.mobility, _in_words(closing, block.mobility), closing, whole=True
    )


def _of_family_askew(
    block: ChainGraph, given: Motion, ends: Sequence[str]
) -> Proved | None:
    """The same with other axes of its ball joints, if it has any."""
    askew = in_own_axes(given, askew=True)
    if askew is given:
        return None
    names = {edge.name for edge in block.edges}
    for other in _moving_blocks(chain_graph(askew, idle_freedoms(askew))):
        if names == {edge.name for edge in other.edges}:
            same = {e.name: e.screw for e in block.edges}
            changed = any(same[edge.name] != edge.screw for edge in other.edges)
            return _of_family(other, ends) if changed else None
    return None


def _moving_blocks(graph: ChainGraph) -> tuple[ChainGraph, ...]:
    return tuple(block for block in graph.blocks() if block.width)


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
        said.append(IDENTICAL.format("the loop closes", closing.followed[0]))
        return f"{', '.join(said)}, {smooth(mobility)}"
    if closing.followed:
        orders = _listed([str(order) for order in closing.followed])
        which = "one loop closes" if len(closing.followed) == 1 else "some loops close"
        said.append(IDENTICAL.format(which, orders))
        said.append(
            f"with these the loops leave {_listed(list(map(str, closing.dimensions)))} "
            f"equations, all of them independent"
        )
        return f"{', '.join(said)}, {smooth(mobility)}"
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
        whose = "their" if len(groups) > 1 else "its"
        said.append(f"where {whose} {total} equations are independent")
    return f"{', '.join(said)}, {smooth(mobility)}"


def _body(name: str) -> str:
    """A body, or what is between two freedoms of a joint."""
    inner = name.startswith(INNER)
    return f"what follows {name.removeprefix(INNER)}" if inner else name


def _listed(items: Sequence[str]) -> str:
    return " and ".join(filter(None, (", ".join(items[:-1]), items[-1])))
