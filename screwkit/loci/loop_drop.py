"""Where limbs that hold one body become dependent on each other.

The limbs' wrench systems W_i add up directly for generic values; the loop constraint
matrix loses rank exactly where they do not.  On the set where every limb has the rank
that is generic on a stratum, W_1 ⊕ … ⊕ W_k fails exactly where the join of their
Plücker coordinates vanishes, whatever basis is taken.  So every combination of strata
of the limbs is taken in turn, and no pattern of regular and singular limbs is skipped.

References: [LongCaroKhalil2012] §5.2.1; [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from itertools import product
from typing import TypeAlias

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import beside_special, common_zeros, other_parts
from screwkit.algebra.effort import Effort
from screwkit.algebra.points import rank_at
from screwkit.algebra.search import Search, imposed
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.limb_parts import Parts, motion_at
from screwkit.kinematics.loop_columns import loop_columns
from screwkit.kinematics.loop_state import LoopState, state_of
from screwkit.loci.alike_sheets import AlikeSheets
from screwkit.loci.dependence import minors_on
from screwkit.loci.either_way import zeros_either_way
from screwkit.loci.local_codimension import codimension_around
from screwkit.loci.loop_drop_found import LoopDrop
from screwkit.loci.open_branches import lying_where
from screwkit.loci.pieces import (
    Piece,
    has_equations_of,
    lies_in,
    pieces_of,
    surely_in,
    without_contained,
)
from screwkit.loci.strata import LimbStrata, Stratum
from screwkit.loci.what_is_left import parts_left
from screwkit.loci.wrench_sums import height_of

_EFFORT = 1_200  # case distinctions in all; long polynomials count more
_BUDGET = 150  # case distinctions on one branch
_EARNED = 400  # more, for each branch that was decided with angles kept
_TOGETHER = 120  # case distinctions to meet the equations of some strata
_AGAIN = 40  # branches left open that are looked at again
_LINEAR = 5_000_000_000  # products of residues for all of these
_BESIDE = 30  # case distinctions for parts of a branch that its points do not show


Lost: TypeAlias = Callable[[LoopState, LoopState], bool]
"""Of the state on a branch and the generic one: whether the branch is a find."""


def loop_state(branch: Branch, limbs: Sequence[Parts]) -> LoopState | None:
    """Ranks at random exact points of a branch; None where no point was found."""
    height = height_of(limbs)
    states = [
        state_of([motion_at(limb, height, point, prime) for limb in limbs], prime)
        for point, prime in branch.points
    ]
    return max(states, key=lambda s: (s.inner, sum(s.limbs), s.loop), default=None)


_Left: TypeAlias = tuple[Branch, Branch, Sequence[Stratum]]
"""A branch that was left open, the one on which it was, and what strata that is of."""


@dataclass
class _Walk:
    """The combinations of strata under way, shallow ones first."""

    limbs: Sequence[Parts]
    height: int
    generic: LoopState
    search: Search
    strata: Sequence[LimbStrata]
    lost: Lost
    given: Sequence[Piece] = ()
    found: list[Branch] = field(default_factory=list)
    passed: list[Branch] = field(default_factory=list)
    open: list[Branch] = field(default_factory=list)
    left: list[_Left] = field(default_factory=list)
    places: list[tuple[list[Polynomial], list[Branch]]] = field(default_factory=list)
    linear: Effort = field(default_factory=lambda: Effort(_LINEAR))
    sheets: AlikeSheets = field(default_factory=AlikeSheets)
    pieces: list[Piece] = field(default_factory=list)
    effort: int = _EFFORT
    kept_first: bool = False

    def keep(self, branches: Sequence[Branch]) -> None:
        """Take note of branches on which the loops lose rank."""
        if self.kept_first:
            self._keep_new(branches)
        elif branches:
            self.found.extend(branches)
            self.pieces = without_contained([*self.given, *pieces_of(self.found)])

    def _keep_new(self, branches: Sequence[Branch]) -> None:
        """The same for many branches, most of which lie in larger pieces.

        These are passed over; at the end all are compared with each other.
        """
        outside = [b for b in branches if not self._lies_in_larger(b)]
        pieces = pieces_of(outside)
        own = [branch for piece in pieces for branch in piece.branches]
        self.found.extend(own)
        self.passed.extend(b for b in branches if not any(b is o for o in own))
        self.pieces = [*self.pieces, *pieces]

    def known(self, branch: Branch) -> bool:
        """Whether a branch lies in a piece that was found before."""
        return any(lies_in(branch, piece) for piece in self.pieces)

    def _lies_in_larger(self, branch: Branch) -> bool:
        return any(
            piece.codimension < branch.codimension and lies_in(branch, piece)
            for piece in self.pieces
        )


def rank_is_lost(state: LoopState, generic: LoopState) -> bool:
    """Whether the loop constraint matrix has lost rank."""
    return state.loop < generic.loop


def platform_is_freer(state: LoopState, generic: LoopState) -> bool:
    """Whether the platform can move in more ways."""
    return state.platform_freedom > generic.platform_freedom


def loop_drop(
    root: Branch,
    limbs: Sequence[Parts],
    strata: Sequence[LimbStrata],
    search: Search,
    lost: Lost = rank_is_lost,
    given: Sequence[Piece] = (),
    early: Callable[[Sequence[Piece], LoopState], None] = lambda pieces, generic: None,
) -> LoopDrop:
    """Every piece of ``root`` on which the loop constraint matrix loses rank.

    Args:
        root: The whole configuration space.
        limbs: Parts of each limb in one common frame, in coordinates that tell all
            twists apart.
        strata: Of each limb, in the ring of the common frame.
        search: Budget and known factors, shared by all steps.
        lost: What is looked for instead; it must hold wherever, on some combination of
            strata, the limbs' wrench systems together lose dimensions.
        given: Pieces that are known; they are among the pieces of the answer.
        early: Given the pieces found so far, some of which may lie in others, and the
            generic state, whenever the search of a combination found some.
    """
    generic = loop_state(root, limbs)
    if generic is None:
        raise ValueError("the whole space has no exact point")
    walk = _Walk(limbs, height_of(limbs), generic, search, strata, lost, given)
    walk.pieces = list(given)
    combinations = sorted(
        product(*(limb.strata for limb in strata)),
        key=lambda chosen: sum(stratum.codimension for stratum in chosen),
    )
    searched, unsearched = None, 0
    for position, chosen in enumerate(combinations):
        if walk.effort <= 0:
            searched = sum(s.codimension for s in chosen) - 1
            unsearched = len(combinations) - position
            break
        known = len(walk.found)
        with _noted(chosen, walk):
            _visit(root, chosen, walk)
        if len(walk.found) > known:
            early(walk.pieces, generic)
    _look_again(walk)
    pieces, parts = _told_from_parts(_found_pieces(walk), walk)
    left = [*walk.open, *search.unfinished]
    undecided = [*left, *walk.sheets.others(left)]
    if not all(limb.complete for limb in strata):
        undecided.append(root)
    undecided += [branch for part, _ in parts for branch in part.branches]
    open_left = tuple(
        branch
        for branch in undecided
        if not any(surely_in(branch, piece) for piece in pieces)
    )
    around = tuple(size for _, size in parts)
    kept = {branch.texts for branch in open_left}
    told = [
        (equations, {branch.texts for branch in branches})
        for equations, branches in walk.places
    ]
    places = [equations for equations, own in told if own & kept]
    # Words that do not speak of every open branch would mislead.
    is_whole = kept <= set().union(*(own for _, own in told))
    where = lying_where(root.ring, places) if is_whole else ""
    return LoopDrop(
        generic, tuple(pieces), open_left, searched, unsearched, around, where
    )


@contextmanager
def _noted(chosen: Sequence[Stratum], walk: _Walk) -> Iterator[None]:
    """Take note of where branches lie that are left open."""
    before = len(walk.open)
    yield
    if walk.open[before:]:
        conditions = [e for stratum in chosen for e in stratum.equations]
        walk.places.append((conditions, walk.open[before:]))


def _look_again(walk: _Walk) -> None:
    """What was left open, where more pieces are known by now."""
    walk.left.sort(key=lambda own: -own[0].codimension)  # small ones cost little
    for _ in range(_AGAIN):
        if not walk.left or walk.linear.left <= 0:
            break
        branch, around, chosen = walk.left.pop(0)
        known = [p.equations for p in (*_deeper(chosen, walk), *walk.pieces)]
        lists = minors_on(around, walk.limbs, walk.search)
        library, effort = walk.search.library, walk.linear
        parts = parts_left(branch, lists, known, library, effort) if lists else None
        if parts is None:
            continue
        walk.open = [own for own in walk.open if own is not branch]
        walk.effort = max(walk.effort, _BUDGET)
        with _noted(chosen, walk):
            for part in parts:
                for own in _untied(part, walk):
                    if not walk.known(own):
                        _examine(own, chosen, walk)


def _found_pieces(walk: _Walk) -> list[Piece]:
    """The pieces found, with what was passed over and lies in none of them."""

    def of(branches: Sequence[Branch]) -> list[Piece]:
        found = pieces_of([*branches, *walk.sheets.others(branches)])
        return without_contained([*walk.given, *found])

    pieces = of(walk.found)
    passed = [*walk.passed, *walk.sheets.others(walk.passed)]
    left = [b for b in passed if not any(lies_in(b, piece) for piece in pieces)]
    return of([*walk.found, *left]) if left else pieces


def _told_from_parts(
    pieces: Sequence[Piece], walk: _Walk
) -> tuple[list[Piece], list[tuple[Piece, int]]]:
    """Pieces, and those that are parts of larger ones, with the codimension of these.

    Larger ones are among the pieces where these are all; else the search has not found
    them, and what was taken for a component is none.
    """
    if walk.lost is not rank_is_lost:
        return list(pieces), []
    columns = loop_columns(walk.limbs, walk.height)
    kept: list[Piece] = []
    parts: list[tuple[Piece, int]] = []
    for piece in pieces:
        size = _size_around(piece, columns, walk)
        if size is not None and size < piece.codimension:
            parts.append((piece, size))
        else:
            kept.append(piece)
    return kept, parts


def _size_around(
    piece: Piece, columns: Sequence[Sequence[Polynomial]], walk: _Walk
) -> int | None:
    """Codimension of the locus around a piece, where it is known."""
    branch = piece.branches[0]
    for at in branch.points:
        if rank_at(columns, *at) == walk.generic.loop - 1:
            return codimension_around(branch.ring, columns, piece.codimension, at)
    return None


def _visit(root: Branch, chosen: Sequence[Stratum], walk: _Walk) -> None:
    if not _can_depend(chosen, walk):
        return
    for branch in _branches_where(root, chosen, walk.search):
        # Where a divisor or the length of an axis is zero there is nothing to look at.
        if any(divisor == 0 for divisor in branch.divisors):
            continue
        for part in _untied(branch, walk):
            if not walk.known(part):
                _examine(part, chosen, walk)


def _unshown(branch: Branch, search: Search) -> Sequence[Branch]:
    """Parts of a branch that its points do not show, as far as they are found.

    Two legs from one place to one place are stretched along one line, or of length 0:
    where the former is known, the latter is not.
    """
    if len(branch.pending) < 2:
        return ()
    own = replace(search, found=[], unfinished=[], special=[], budget=_BESIDE)
    found = other_parts(branch, own) or ()
    return [part for part in found if part.points]


def _untied(branch: Branch, walk: _Walk) -> Sequence[Branch]:
    """The branch, or what of it ties no dimensions."""
    if not branch.is_special:
        return [branch]
    parts = beside_special(branch, walk.search)
    if parts is None:
        walk.open.append(branch)
        return []
    return parts


def _branches_where(
    root: Branch, chosen: Sequence[Stratum], search: Search
) -> Sequence[Branch]:
    """Where all equations of some strata hold.

    Equations of one stratum may follow from others: imposed one after the other they
    leave branches without points, and all are taken apart together.
    """
    branches: Sequence[Branch] = [root]
    for stratum in chosen:
        for equation in stratum.equations:
            branches = [b for a in branches for b in imposed(a, equation, search)]
        branches = [*branches, *(p for b in branches for p in _unshown(b, search))]
    if all(len(b.pending) < 2 or b.points for b in branches):
        return branches
    equations = [equation for stratum in chosen for equation in stratum.equations]
    own = Search(search.library, budget=_TOGETHER, every_part=True)
    zeros = common_zeros(root, equations, own)
    if not zeros.complete or not all(b.points for b in zeros.branches):
        return branches
    return [*zeros.branches, *zeros.special]


def _can_depend(chosen: Sequence[Stratum], walk: _Walk) -> bool:
    """At least two limbs must constrain the platform, or loops lie inside limbs."""
    if walk.generic.inner or walk.generic.loop < walk.height * (len(walk.limbs) - 1):
        return True
    return sum(stratum.rank < walk.height for stratum in chosen) > 1


def _examine(branch: Branch, chosen: Sequence[Stratum], walk: _Walk) -> None:
    deeper = _deeper(chosen, walk)
    # Of limbs with lower ranks all of it is searched elsewhere.
    if any(has_equations_of(branch, piece) for piece in deeper):
        return
    below = [text for piece in deeper for text in sorted(piece.texts)]
    if walk.sheets.has_like(branch, walk.limbs, below):
        return
    state = loop_state(branch, walk.limbs)
    if state is None:
        walk.open.append(branch)
        return
    if walk.lost(state, walk.generic):
        walk.keep([branch])
        return
    elsewhere = deeper + walk.pieces
    search = replace(
        walk.search,
        found=[],
        unfinished=[],
        special=[],
        budget=min(_BUDGET, walk.effort),
        skip=lambda b: any(lies_in(b, piece) for piece in elsewhere),
        surely=lambda b: any(has_equations_of(b, piece) for piece in elsewhere),
        inside=lambda b: (
            piece.equations for piece in elsewhere if b.directed and lies_in(b, piece)
        ),
        away=tuple(p.equations[0] for p in walk.pieces if len(p.equations) == 1),
    )
    before = search.budget
    zeros, kept = zeros_either_way(
        branch, walk.limbs, search, kept_first=walk.kept_first
    )
    walk.effort -= 1 + before - search.budget
    if kept:
        walk.kept_first = True
        walk.effort += _EARNED
    walk.keep(zeros.branches)
    walk.open.extend(zeros.open)
    walk.left.extend((own, branch, chosen) for own in zeros.open)


def _deeper(chosen: Sequence[Stratum], walk: _Walk) -> list[Piece]:
    """Where limbs have lower ranks than on their strata."""
    return [
        Piece(equations, ())
        for limb, own in zip(walk.strata, chosen, strict=True)
        for equations in limb.below(own)
    ]
