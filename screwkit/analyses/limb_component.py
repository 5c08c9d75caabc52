"""One component of a limb's singularities, of limbs with and without loops inside."""

from __future__ import annotations

from screwkit.loci.meanings import Meanings
from screwkit.loci.pieces import Piece
from screwkit.loci.wording import all_solutions, equations_of, solved_equations
from screwkit.results.singularities import Component


def limb_component(
    piece: Piece, rank: int, meanings: Meanings | None, dimension: int
) -> Component:
    """What holds on a piece.

    Args:
        piece: Where the limb loses a freedom.
        rank: Of its twists there.
        meanings: Of the limb's frame; None where no sentence is looked for.
        dimension: Coordinates of a twist that count.
    """
    return Component(
        equations=equations_of(piece),
        codimension=piece.codimension,
        solutions=all_solutions(piece),
        solved=solved_equations(piece),
        rank=rank,
        geometry=meanings.of_limb(piece) if meanings else None,
        wrench_dimension=dimension - rank,
    )
