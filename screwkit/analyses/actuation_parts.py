"""The pieces of an actuation locus as components of an answer."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import partial

from screwkit.analyses.one_component import among, component_of
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.joints_aside import freedoms_aside
from screwkit.kinematics.loop_state import LoopState
from screwkit.loci.actuation_locus import ActuationLocus
from screwkit.loci.pieces import Piece
from screwkit.results.singularities import Component
from screwkit.results.superbracket import Superbracket

SCHEME = "the scheme"
"""Whose components sentences count, as these do not know how many come before."""


def actuation_parts(
    assembly: Assembly, locus: ActuationLocus, actuated: Collection[str]
) -> tuple[tuple[Piece, Component], ...]:
    """Each piece with its component; idle where the platform has no freedom there.

    Args:
        assembly: The mechanism.
        locus: Of one scheme.
        actuated: That scheme.
    """
    aside = freedoms_aside(assembly, actuated)
    ring = assembly.common_twists.ring
    written = partial(
        component_of, root=assembly.root(ring), library=assembly.library(ring)
    )
    moving = [
        piece
        for piece, state in zip(locus.pieces, locus.states, strict=True)
        if state.platform_freedom
    ]
    each_of = partial(locus.meanings.each_of, before=SCHEME) if locus.meanings else None

    def described(piece: Piece, state: LoopState) -> Component:
        # Idle components are listed apart: sentences say nothing of them.
        listed = moving if state.platform_freedom else [piece]
        held = assembly.dimension - state.platform_freedom
        return written(
            piece,
            words=among(listed, piece, each_of) if each_of else None,
            rank=held,
            wrench_dimension=held,
            platform_freedom=state.platform_freedom,
            mobility=state.mobility + aside,
        )

    return tuple(
        (piece, described(piece, state))
        for piece, state in zip(locus.pieces, locus.states, strict=True)
    )


def six_lines(
    number: int,
    pieces: Sequence[Piece],
    locus: ActuationLocus,
    bracket: Superbracket | None,
) -> str | None:
    """How the six lines lie that hold the platform, where no shorter figure is it.

    Args:
        number: Of the piece.
        pieces: On which the platform moves.
        locus: Of the scheme.
        bracket: Its superbracket, if there is one.
    """
    for factor in bracket.factors if bracket else ():
        if factor.holds == "exactly" and factor.components == (number,):
            return factor.words
    if locus.meanings is None:
        return None
    return locus.meanings.of_six_lines(pieces[number], pieces, SCHEME)
