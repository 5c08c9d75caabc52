"""What was passed over on the zeros of equations that said too much, searched again.

A search passes over what lies on a piece that it has found, and it goes by the piece's
equations.  Where these hold at regular postures too, others are added afterwards
(`exact_equations`); what was passed over need not satisfy them.  So the search is
repeated with the pieces as they are now, until no piece changes any more.

References: [CoxLittleOShea] §4.4 (a variety and the closure of a difference).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from screwkit.loci.exact_equations import ExactPieces
from screwkit.loci.pieces import Piece

_ROUNDS = 3  # searches after the first: each new piece lies in what another one lost


class Found(Protocol):
    """What a search came back with."""

    @property
    def pieces(self) -> Sequence[Piece]:
        """Of the locus."""
        ...

    @property
    def reason(self) -> str:
        """Why the list may have gaps; empty where it has none."""
        ...


F = TypeVar("F", bound=Found)


@dataclass(frozen=True)
class SearchedLocus(Generic[F]):
    """A locus whose pieces have exact equations, as far as known.

    Attributes:
        last: The last search: what it left open is left open.
        exact: The pieces.
        changed: Whether the last pieces were changed and not searched beside again.
    """

    last: F
    exact: ExactPieces
    changed: bool

    @property
    def complete(self) -> bool:
        """Whether the pieces are the whole locus, and nothing else."""
        return not self.reason

    @property
    def reason(self) -> str:
        """Why it is not complete; empty where it is."""
        again = "what lies beside a component was not searched to the end"
        reasons = [self.last.reason, self.exact.reason, again if self.changed else ""]
        return "; ".join(filter(None, reasons))


def searched_again(
    search: Callable[[Sequence[Piece]], F],
    exact: Callable[[Sequence[Piece]], ExactPieces],
) -> SearchedLocus[F]:
    """The pieces of a locus, and what was passed over because of their first equations.

    Args:
        search: Finds a locus, some pieces of which are given.
        exact: Makes their equations exact.
    """
    last = search(())
    found = exact(last.pieces)
    for _ in range(_ROUNDS):
        if not found.narrowed:
            break
        last = search(found.pieces)
        if all(any(p is q for q in found.pieces) for p in last.pieces):
            return SearchedLocus(last, found, changed=False)
        found = exact(last.pieces)
    return SearchedLocus(last, found, changed=found.narrowed)
