"""A piece with unsolved conditions taken apart: solved where a coefficient is not zero.

A condition A·x + B = 0 that could not be solved outright, since A and B may vanish
together, gives x = −B/A where A ≠ 0; the rest, A = B = 0, is smaller.  After a few such
steps nothing is pending, and what is asked of the piece factors in the unknowns that
are left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch, Pending, without
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.search import Search, irreducible_parts
from screwkit.algebra.splitting import split
from screwkit.algebra.substitution import linear_parts
from screwkit.algebra.trigonometric import Polynomial


@dataclass(frozen=True)
class Apart:
    """Parts that together are a piece.

    Attributes:
        parts: Irreducible, as far as conditions that are still pending show.
        open: Parts of the rest that were not decided.
    """

    parts: tuple[Branch, ...]
    open: tuple[Branch, ...]


def taken_apart(branch: Branch, search: Search) -> Apart | None:
    """A piece by one pending condition solved for a symbol of the posture.

    The condition and the symbol are those of the shortest coefficient.

    Args:
        branch: The piece.
        search: Budget, known factors, and what to leave out.

    Returns:
        None where no pending condition is linear in such a symbol.
    """
    choice = min(_choices(branch), key=lambda one: one[0], default=None)
    if choice is None:
        return None
    _, pending, index = choice
    before = without(branch, pending)
    halves = split(before, pending.value, (index,))
    own = replace(search, found=[], unfinished=[], special=[])
    parts: list[Branch] = []
    if halves is None:
        return None
    if halves.solved is not None:
        parts += [
            _as_imposed(part, branch)
            for part in irreducible_parts(halves.solved, own)
            if all(divisor != 0 for divisor in part.divisors)
        ]
    rest = common_zeros(before, halves.left, own)
    search.budget = own.budget - 1
    return Apart((*parts, *rest.branches), rest.open)


def _choices(branch: Branch) -> Iterator[tuple[tuple[int, int], Pending, int]]:
    """Pending conditions that are linear in a symbol, with what that costs."""
    ring = branch.ring
    for pending in branch.pending:
        if pending.companions:
            continue
        degrees = pending.value.degrees()
        for index in ring.symbol_indices():
            if degrees[index] == 1 and index not in branch.dimensions:
                size = len(linear_parts(ring, pending.value, index)[0])
                yield (size, len(pending.value)), pending, index


def _as_imposed(part: Branch, branch: Branch) -> Branch:
    """A part with its conditions as they were imposed on the whole branch.

    Of what a pending condition has become, one factor is left where the others are
    divisors; on the part it says the same.
    """
    known = set(map(str, branch.conditions))
    fresh = [c for c in part.conditions if str(c) not in known]
    present = set(map(str, part.conditions))
    gone = [c for c in branch.conditions if str(c) not in present]
    if len(fresh) != 1 or len(gone) != 1:
        return part
    old, new = str(fresh[0]), gone[0]

    def renamed(condition: Polynomial) -> Polynomial:
        return new if str(condition) == old else condition

    return replace(
        part,
        conditions=tuple(map(renamed, part.conditions)),
        steps=tuple(
            s if s.condition is None else replace(s, condition=renamed(s.condition))
            for s in part.steps
        ),
        pending=tuple(replace(p, condition=renamed(p.condition)) for p in part.pending),
    )
