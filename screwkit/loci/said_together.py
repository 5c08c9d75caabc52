"""Statements that hold together: what they say, on what they hold, and where else.

What satisfies them all is searched on the whole space at once: a search that goes on
from what some of them left would miss where its divisors vanish.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from screwkit.algebra.branches import Branch, without
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.points import residue
from screwkit.algebra.proved_inside import left_over
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.loci.features import listed
from screwkit.loci.pieces import Piece, surely_in

_BUDGET = 200  # case distinctions for several statements on the whole space
_PENDING = 40  # and beside a multiplier
_ADDED = 2  # statements that are added
_INSIDE = 3  # other components, inside which a sentence may hold too, that are named

Said = tuple[str, Sequence[Polynomial]]
"""A statement in words, and what vanishes where it holds."""


@dataclass(frozen=True)
class Conjunction:
    """Statements that together hold on a piece, and where else.

    Attributes:
        words: None of them to spare.
        elsewhere: Numbers of other components on which they hold too.
        inside: Numbers of others inside which they may hold at special postures.
        further: Whether they may hold inside others that are not told.
    """

    words: tuple[str, ...]
    elsewhere: tuple[int, ...] = ()
    inside: tuple[int, ...] = ()
    further: bool = False


def where_else(found: Conjunction, count: int, before: int | str) -> str:
    """On which other components sentences hold, in brackets; empty if on none.

    Args:
        found: The sentences.
        count: Components in the list.
        before: Components that are counted before these; whose they are where that
            is not known, and they are told by how many they are.
    """
    told = []
    if found.elsewhere:
        told.append(f"here and on {others_in_words(found.elsewhere, count, before)}")
    if found.further or len(found.inside) > _INSIDE:
        told.append("elsewhere only inside other components")
    elif found.inside:
        told.append(f"elsewhere only inside {_numbered(found.inside, before)}")
    return f" ({', '.join(told)})" if told else ""


def others_in_words(components: Sequence[int], count: int, before: int | str) -> str:
    """Components of a list in words; see `where_else`."""
    if isinstance(before, str) and len(components) == count - 1:
        noun = "component" if count == 2 else "components"
        return f"the other {noun} of {before}"
    return _numbered(components, before)


def _numbered(components: Sequence[int], before: int | str) -> str:
    """Components by the numbers under which they are listed."""
    noun = "component" if len(components) == 1 else "components"
    if isinstance(before, str):
        return f"{len(components)} other {noun} of {before}"
    return f"{noun} {listed([str(before + n + 1) for n in components])}"


def is_met(said: Said, piece: Piece) -> bool:
    """Whether a statement holds at the exact points of a piece."""
    return not any(residue(s, *at) for s in said[1] for at in points_of(piece))


def words_of(said: Sequence[Said]) -> tuple[str, ...]:
    """The statements in words."""
    return tuple(words for words, _ in said)


def holds_on(said: Sequence[Said], piece: Piece, library: FactorLibrary) -> bool:
    """Whether statements hold on all of a piece.

    Where several conditions are pending its exact points may lie on one part of it.
    Then they hold outside the zeros of a multiplier, which must be no part as large.
    """
    own = {str(primitive(equation)) for equation in piece.equations}
    scalars = [s for s in all_of(said)[1] if str(primitive(s)) not in own]
    for branch in piece.branches if scalars else ():
        if len(branch.pending) < 2:
            continue
        systems = left_over(branch, [scalars])
        if systems is None:
            return False
        before = branch
        for pending in branch.pending:
            before = without(before, pending)
        equations = [v for v in map(before.value, piece.equations) if v != 0]
        for system in systems:
            search = Search(library, budget=_PENDING)
            zeros = common_zeros(before, [*system, *equations], search)
            if not zeros.complete or any(
                b.codimension <= branch.codimension for b in zeros.branches
            ):
                return False
    return True


def points_of(piece: Piece) -> list[tuple[Sequence[int], int]]:
    """The exact points of a piece, of all its branches."""
    return [at for branch in piece.branches for at in branch.points]


def all_of(said: Sequence[Said]) -> Said:
    """Statements as one."""
    return "; ".join(words for words, _ in said), [s for _, own in said for s in own]


def stated(
    said: Sequence[Said],
    piece: Piece,
    root: Branch,
    library: FactorLibrary,
    others: Sequence[Piece] = (),
    more: Sequence[Said] = (),
    singular: Callable[[Branch], bool] | None = None,
) -> Conjunction | None:
    """Statements with where else they hold, if that is proved to be all.

    Args:
        said: That hold at the exact points of a piece, and near them nowhere else.
        piece: A component.
        root: The space in which it lies.
        library: Factors met before, of the same ring.
        others: The components of its list, in their order.
        more: Statements that hold there too, added where that cuts off what lies
            inside no component.
        singular: Whether all of a branch is singular, where the list is complete: it
            then lies inside its components, whichever these are.

    Returns:
        None where they are not proved to hold on all of the piece, or where what else
        satisfies them is not known, or lies inside no other component.
    """
    for _ in range(_ADDED + 1):
        if not holds_on(said, piece, library):
            return None
        zeros = common_zeros(root, all_of(said)[1], Search(library, budget=_BUDGET))
        # What is left open contains all further zeros.
        found = [
            branch
            for branch in (*zeros.branches, *zeros.open)
            if not surely_in(branch, piece)
        ]
        if not found:
            return Conjunction(words_of(said))
        beside = [n for n, other in enumerate(others) if other is not piece]
        # Those on which they hold all over first: these need not be said to be wider.
        whole = [n for n in beside if _hold_all_over(said, others[n], library)]
        beside.sort(key=lambda n: (n not in whole, others[n].codimension))
        met: list[int] = []
        strays = [b for b in found if not _is_met(b, others, beside, met)]
        regular = [b for b in strays if singular is None or not singular(b)]
        if not regular:
            inside = tuple(sorted(n for n in met if n not in whole))
            on = tuple(sorted(n for n in met if n in whole))
            return Conjunction(words_of(said), on, inside, bool(strays))
        if not zeros.complete or not all(branch.points for branch in regular):
            return None
        places = [at for branch in regular for at in branch.points]
        cuts = (one for one in more if one not in said and _fails(one, places))
        added = next(cuts, None)
        if added is None:
            return None
        said = [*said, added]
    return None


def _is_met(
    branch: Branch, others: Sequence[Piece], beside: Sequence[int], met: list[int]
) -> bool:
    """Whether a branch lies on one of the other components, which is noted."""
    if any(surely_in(branch, others[n]) for n in met):
        return True
    found = next((n for n in beside if surely_in(branch, others[n])), None)
    if found is not None:
        met.append(found)
    return found is not None


def _fails(said: Said, places: Sequence[tuple[Sequence[int], int]]) -> bool:
    """Whether a statement holds at none of some exact points."""
    return all(any(residue(s, *at) for s in said[1]) for at in places)


def _hold_all_over(said: Sequence[Said], piece: Piece, library: FactorLibrary) -> bool:
    return (
        all(branch.points for branch in piece.branches)
        and all(is_met(one, piece) for one in said)
        and holds_on(said, piece, library)
    )
