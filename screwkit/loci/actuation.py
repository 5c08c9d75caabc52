"""Where a scheme fails: the zeros of the determinant of the passive twists.

On each of its factors either the platform can move with the actuated joints locked, or
only a limb idles; the two are told apart by exact ranks.

References: [LongCaroKhalil2012] §5.2.2, with the global wrench system taken from the
locked limbs, not from literal wrenches.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from screwkit.algebra.decomposition import Search, common_zeros
from screwkit.algebra.minors import joined
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.meanings import Meanings
from screwkit.loci.passive import PassiveState, PassiveSystem
from screwkit.loci.pieces import Piece, lies_in, pieces_of
from screwkit.loci.rank_drop import extensors
from screwkit.loci.witness import witness


@dataclass(frozen=True)
class ActuationLocus:
    """Pieces on which something moves with the actuated joints locked.

    Attributes:
        generic_rank: Of the global wrench system.
        pieces: With their ``states``; where the platform's freedom there is 0, only
            limbs move.
        witness: Why the scheme is not admissible.
        reason: Why ``complete`` is false.
    """

    admissible: bool
    generic_rank: int
    complete: bool
    pieces: tuple[Piece, ...]
    states: tuple[PassiveState, ...]
    meanings: Meanings | None
    witness: str = ""
    reason: str = ""


def passive_joints(assembly: Assembly, actuated: Collection[str]) -> tuple[str, ...]:
    """The joints of the limbs that are not locked."""
    return tuple(joint for joint in assembly.joints if joint not in actuated)


def actuation_locus(assembly: Assembly, actuated: Sequence[str]) -> ActuationLocus:
    """The singular locus of one scheme, decomposed."""
    system = PassiveSystem(assembly)
    passive = passive_joints(assembly, actuated)
    generic = system.generic_state(passive)
    rank = 6 - generic.platform_freedom
    if generic.platform_freedom:
        why = witness(assembly, system, passive)
        return ActuationLocus(False, rank, True, (), (), None, why)
    framed = assembly.common_twists
    root, library = assembly.root(framed.ring), assembly.library(framed.ring)
    meanings = Meanings(framed, root, library)
    minors = system.maximal_minors(passive)
    if minors is None:
        return ActuationLocus(
            True,
            rank,
            False,
            (),
            (),
            meanings,
            reason="redundant actuation of more than two limbs is not expanded",
        )
    zeros = common_zeros(root, minors, Search(library))
    pieces = pieces_of(zeros.branches)
    states = [_state(system, piece, passive) for piece in pieces]
    complete = zeros.complete
    reason = "" if complete else "the zeros of the determinant were not all decided"
    moving = [p for p, s in zip(pieces, states, strict=True) if s.platform_freedom]
    for piece, state in list(zip(pieces, states, strict=True)):
        if state.platform_freedom:
            continue
        deeper = _inside_idle(assembly, system, piece, passive, moving)
        if deeper is None:
            complete, reason = False, "an idle piece was not searched further"
            continue
        found, finished = deeper
        if not finished:
            complete, reason = False, "an idle piece was not searched to the end"
        for inner in found:
            inner_state = _state(system, inner, passive)
            if inner_state.platform_freedom:
                pieces.append(inner)
                states.append(inner_state)
                moving.append(inner)
    return ActuationLocus(
        True, rank, complete, tuple(pieces), tuple(states), meanings, reason=reason
    )


def _state(
    system: PassiveSystem, piece: Piece, passive: Collection[str]
) -> PassiveState:
    """Generic on the piece: the ranks at its points, the larger of each."""
    states = [
        system.table_at(*point).state(passive)
        for branch in piece.branches[:2]
        for point in branch.points
    ]
    return min(states, key=lambda state: state.platform_freedom)


def _inside_idle(
    assembly: Assembly,
    system: PassiveSystem,
    piece: Piece,
    passive: Collection[str],
    moving: Sequence[Piece],
) -> tuple[list[Piece], bool] | None:
    """Pieces of an idle piece on which the platform moves after all; two limbs only."""
    if len(assembly.limbs) != 2:
        return None
    framed = assembly.common_twists
    library = assembly.library(framed.ring)
    found: list[Piece] = []
    finished = True
    for branch in piece.branches:
        limbs = [
            [framed.column(j) for j in limb.joints if j in passive]
            for limb in assembly.limbs
        ]
        state = _state(system, Piece(piece.equations, (branch,)), passive)
        charts = [
            extensors(branch, columns, rank) if columns else [{0: branch.ring.one}]
            for columns, rank in zip(limbs, state.limbs, strict=True)
        ]
        polynomials = [
            value
            for left in charts[0]
            for right in charts[1]
            for value in joined(branch.ring, left, right).values()
        ]
        search = Search(
            library,
            budget=80,
            skip=lambda b: any(lies_in(b, known) for known in moving),
        )
        zeros = common_zeros(branch, polynomials, search)
        pieces = pieces_of(zeros.branches)
        finished = finished and all(
            any(lies_in(left, known) for known in (*moving, *pieces))
            for left in zeros.open
        )
        found.extend(pieces)
    return found, finished
