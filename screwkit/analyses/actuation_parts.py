"""The pieces of an actuation locus as components of an answer."""

from __future__ import annotations

from screwkit.loci.actuation_locus import ActuationLocus
from screwkit.loci.pieces import Piece
from screwkit.loci.wording import all_solutions, equations_of, solved_equations
from screwkit.results.singularities import Component


def actuation_parts(
    locus: ActuationLocus, dimension: int
) -> tuple[tuple[Piece, Component], ...]:
    """Each piece with its component; idle where the platform has no freedom there.

    Args:
        locus: Of one scheme.
        dimension: Of all twists: six, or three in the plane.
    """
    meanings = locus.meanings
    return tuple(
        (
            piece,
            Component(
                equations=equations_of(piece),
                codimension=piece.codimension,
                solutions=all_solutions(piece),
                solved=solved_equations(piece),
                rank=dimension - state.platform_freedom,
                geometry=meanings.each_of(piece) if meanings else None,
                wrench_dimension=dimension - state.platform_freedom,
                platform_freedom=state.platform_freedom,
                mobility=state.mobility,
            ),
        )
        for piece, state in zip(locus.pieces, locus.states, strict=True)
    )
