"""Where a scheme fails when limbs have loops inside.

With the actuated joints locked every combination of strata of the limbs is searched for
postures where the platform can move (`loop_drop`).  Rods that spin, and whatever else
moves with the platform held, are told apart from that: they are strata of one limb, on
which more of its joints move.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from screwkit.algebra.branches import Branch
from screwkit.algebra.search import Search
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.limb_parts import Parts
from screwkit.kinematics.loop_columns import loop_columns
from screwkit.kinematics.loop_state import LoopState
from screwkit.kinematics.told_parts import told_parts
from screwkit.loci.actuation_locus import ActuationLocus
from screwkit.loci.exact_equations import Singularity, with_exact_equations
from screwkit.loci.hybrid_strata import HybridStrata, hybrid_strata
from screwkit.loci.loop_drop import (
    loop_drop,
    loop_state,
    platform_is_freer,
)
from screwkit.loci.loop_drop_found import LoopDrop
from screwkit.loci.meanings import Meanings
from screwkit.loci.mechanism_figures import figures_of
from screwkit.loci.pieces import Piece, lies_in, without_contained
from screwkit.loci.searching_again import searched_again

_LONGEST = 60_000  # terms of a polynomial that is factored


def hybrid_actuation_locus(
    assembly: Assembly, actuated: Sequence[str]
) -> ActuationLocus:
    """The singular locus of a scheme that stops the platform in general, decomposed."""
    framed = assembly.common_twists
    root, library = assembly.root(framed.ring), assembly.library(framed.ring)
    limbs = [told_parts(assembly, limb, actuated) for limb in assembly.limbs]
    height = len(assembly.telling)
    strata = [hybrid_strata(root, limb, height, library) for limb in limbs]

    def is_singular(branch: Branch) -> bool:
        state = loop_state(branch, limbs)
        return state is not None and state.platform_freedom > 0

    singular = Singularity(
        root, partial(loop_columns, limbs, height), is_singular, library
    )

    def search(given: Sequence[Piece]) -> LoopDrop:
        return loop_drop(
            root,
            limbs,
            [own.by_equations for own in strata],
            Search(library, largest=_LONGEST),
            platform_is_freer,
            given,
        )

    found = searched_again(search, partial(with_exact_equations, singular=singular))
    moving = found.exact.pieces
    pieces = (*moving, *_idle(root, limbs, strata, moving))
    return ActuationLocus(
        True,
        0,
        found.complete,
        pieces,
        tuple(state_on(piece, limbs) for piece in pieces),
        Meanings(framed, root, library, figures_of(assembly, actuated)),
        reason=found.reason,
    )


def _idle(
    root: Branch,
    limbs: Sequence[Parts],
    strata: Sequence[HybridStrata],
    moving: Sequence[Piece],
) -> list[Piece]:
    """The largest pieces on which more joints move, and the platform does not."""
    generic = loop_state(root, limbs)
    found: list[Piece] = []
    for own in strata:
        for stratum in own.strata:
            piece = stratum.piece
            if piece is None or any(lies_in(piece.branches[0], x) for x in moving):
                continue
            state = state_on(piece, limbs)
            more = generic is not None and state.mobility > generic.mobility
            if more and not state.platform_freedom:
                found.append(piece)
    return without_contained(found)


def state_on(piece: Piece, limbs: Sequence[Parts]) -> LoopState:
    """The ranks that are generic on a piece.

    Raises:
        ArithmeticError: If the piece has no exact point.
    """
    for branch in piece.branches:
        state = loop_state(branch, limbs)
        if state is not None:
            return state
    raise ArithmeticError("a piece without an exact point was accepted")
