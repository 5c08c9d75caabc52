"""Figures of lines that several components of a list have in common, and no others.

A determinant that has several factors is zero on as many components: the lines become
dependent on each of them, and nowhere else.

References: [Merlet1989].
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.loci.figures import Figures
from screwkit.loci.pieces import Piece
from screwkit.loci.said_together import others_in_words
from screwkit.loci.same_zeros import one_of, proviso


def shared_figure(
    ring: TrigonometricRing,
    figures: Sequence[Figures],
    piece: Piece,
    others: Sequence[Piece],
    before: int | str,
    sizes: tuple[int, int] = (1, 5),
) -> str | None:
    """A sentence that holds on a piece and on further components, which it names.

    Args:
        ring: Of the equations.
        figures: What may become dependent.
        piece: A component with one equation.
        others: All components of its list, in their order.
        before: See `where_else`.
        sizes: Of the sets of lines.
    """
    number_of = {
        condition_key(ring, one_of(ring, other.equations)): n
        for n, other in enumerate(others)
        if other is not piece and other.codimension == 1
    }
    for own in figures if number_of else ():
        for sentence, beside in own.compared(piece, *sizes):
            keyed = [(condition_key(ring, e), e) for e in beside]
            on = sorted(number_of[key] for key, _ in keyed if key in number_of)
            rest = [e for key, e in keyed if key not in number_of]
            given = proviso(ring, rest) if rest else ""
            if on and given is not None:
                told = f"here and on {others_in_words(on, len(others), before)}"
                return f"{sentence} ({', '.join(filter(None, [given, told]))})"
    return None
