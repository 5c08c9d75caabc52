"""One component of an answer: the piece in its fewest words, and what holds there."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.loci.meanings import Meanings
from screwkit.loci.pieces import Piece
from screwkit.loci.reduced_equations import reduced
from screwkit.loci.wording import all_solutions, equations_of, solved_equations
from screwkit.results.singularities import Component


def component_of(
    piece: Piece,
    root: Branch,
    library: FactorLibrary,
    words: Callable[[Piece], str | None] | None,
    *,
    rank: int,
    wrench_dimension: int,
    platform_freedom: int | None = None,
    mobility: int | None = None,
) -> Component:
    """A piece as a component.

    Args:
        piece: As it was found, with equations of limbs as a rule, which have a meaning
            of their own.
        root: The whole configuration space.
        library: Factors met before.
        words: What a piece means, if that is asked; None where no sentence is found.
        rank: That is lower there.
        wrench_dimension: Of the wrenches that hold the platform there.
        platform_freedom: Dimension of its twists.
        mobility: Of the whole mechanism.
    """
    simpler = reduced(piece, root, library)
    geometry = words(piece) if words else None
    if words and geometry is None and simpler is not piece:
        geometry = words(simpler)
    return Component(
        equations=equations_of(simpler),
        codimension=piece.codimension,
        solutions=all_solutions(simpler),
        solved=solved_equations(simpler),
        rank=rank,
        geometry=geometry,
        wrench_dimension=wrench_dimension,
        platform_freedom=platform_freedom,
        mobility=mobility,
    )


def among(
    listed: Sequence[Piece],
    piece: Piece,
    find: Callable[[Piece, Sequence[Piece]], str | None],
) -> Callable[[Piece], str | None]:
    """What a piece means, which may be written by other equations in its list."""

    def words(written: Piece) -> str | None:
        others = [written if other is piece else other for other in listed]
        return find(written, others)

    return words


def limb_component(
    piece: Piece,
    root: Branch,
    library: FactorLibrary,
    meanings: Meanings | None,
    listed: Sequence[Piece],
    *,
    rank: int,
    dimension: int,
) -> Component:
    """A piece on which a limb loses a freedom.

    Args:
        piece: Of the limb's locus.
        root: The whole configuration space.
        library: Factors met before.
        meanings: Of the limb's frame; None where no sentence is looked for.
        listed: All pieces of the locus.
        rank: Of its twists there.
        dimension: Coordinates of a twist that count.
    """
    return component_of(
        piece,
        root,
        library,
        among(listed, piece, meanings.of_limb) if meanings else None,
        rank=rank,
        wrench_dimension=dimension - rank,
    )
