"""Where a scheme fails: the zeros of the determinant of the passive twists.

On each of its factors either the platform can move with the actuated joints locked, or
only a limb idles; the two are told apart by exact ranks.

References: [LongCaroKhalil2012] §5.2.2, with the global wrench system taken from the
locked limbs, not from literal wrenches.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.search import Search
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.loop_columns import loop_columns
from screwkit.kinematics.loop_state import LoopState
from screwkit.loci.actuation_locus import ActuationLocus
from screwkit.loci.dependence import Dependence, dependent_zeros
from screwkit.loci.exact_equations import (
    ExactPieces,
    Singularity,
    with_exact_equations,
)
from screwkit.loci.hybrid_actuation import hybrid_actuation_locus
from screwkit.loci.lasting_wrenches import all_are_held
from screwkit.loci.loop_drop import loop_state
from screwkit.loci.many_wrenches import ManyWrenches, many_wrenches
from screwkit.loci.meanings import Meanings
from screwkit.loci.mechanism_figures import figures_of, figures_on
from screwkit.loci.passive import PassiveSystem
from screwkit.loci.pieces import (
    Piece,
    alike,
    lies_in,
    pieces_of,
    surely_in,
    without_contained,
)
from screwkit.loci.rank_drop import Column, rank_drop
from screwkit.loci.searching_again import searched_again
from screwkit.loci.surely_singular import all_move
from screwkit.loci.witness import Witnesses
from screwkit.loci.wrench_sums import height_of

_LONGEST = 60_000  # terms of a polynomial that is factored
_APART = 300  # case distinctions where the whole determinant is too long
_BLOCKS = 40  # on wrenches in blocks
_IDLE = 300  # case distinctions on all idle pieces


def passive_joints(assembly: Assembly, actuated: Collection[str]) -> tuple[str, ...]:
    """The joints of the limbs that are not locked."""
    return tuple(joint for joint in assembly.joints if joint not in actuated)


def actuation_locus(assembly: Assembly, actuated: Sequence[str]) -> ActuationLocus:
    """The singular locus of one scheme, decomposed."""
    system = PassiveSystem(assembly)
    passive = passive_joints(assembly, actuated)
    generic = system.generic_state(passive)
    freedom = generic.platform_freedom
    if freedom:
        why = Witnesses(assembly, system).of(passive)
        return ActuationLocus(False, freedom, True, (), (), None, why)
    if assembly.has_blocks:
        return hybrid_actuation_locus(assembly, actuated)
    framed = assembly.common_twists
    root, library = assembly.root(framed.ring), assembly.library(framed.ring)
    limbs = [
        assembly.told([joint for joint in limb.joints if joint in passive])
        for limb in assembly.limbs
    ]
    scheme = _Scheme(root, library, limbs, partial(_state, system, passive=passive))
    found = searched_again(scheme.search, scheme.exactly)
    pieces = found.exact.pieces
    meanings = Meanings(
        framed,
        root,
        library,
        figures_of(assembly, actuated),
        figures_on(assembly, actuated),
        singular=partial(all_move, limbs) if found.complete else None,
    )
    return ActuationLocus(
        True,
        freedom,
        found.complete,
        pieces,
        tuple(map(scheme.state, pieces)),
        meanings,
        reason=found.reason,
    )


@dataclass(frozen=True)
class _Found:
    """Where something moves with the actuated joints locked."""

    pieces: tuple[Piece, ...]
    reason: str


@dataclass(frozen=True)
class _Scheme:
    """One scheme that stops the platform in general.

    Attributes:
        limbs: Passive twists of each.
        state: Generic on a piece.
    """

    root: Branch
    library: FactorLibrary
    limbs: Sequence[Sequence[Column]]
    state: Callable[[Piece], LoopState]

    def ranks(self, branch: Branch) -> LoopState | None:
        """At random exact points of a branch; None where no point was found."""
        return loop_state(branch, self.limbs)

    def search(self, given: Sequence[Piece]) -> _Found:
        """All pieces, some of which are given."""

        def is_given(branch: Branch) -> bool:
            return _known(branch, given)

        root, limbs = self.root, self.limbs
        whole = Search(self.library, largest=_LONGEST, skip=is_given)
        zeros = self._zeros_of_many(whole) or dependent_zeros(root, limbs, whole)
        if zeros.open:
            apart = replace(whole, budget=_APART, found=[], unfinished=[], special=[])
            zeros = _by_limbs(root, limbs, zeros, apart)
        whole_pieces = without_contained([*given, *pieces_of(zeros.branches)])
        outside = self._moving_outside(zeros.branches, whole_pieces)
        pieces = alike([*whole_pieces, *outside], self.ranks)
        complete = all(_is_decided(branch, pieces) for branch in zeros.open)
        undecided = "the zeros of the determinant were not all decided"
        reasons = dict.fromkeys(() if complete else (zeros.reason or undecided,))
        moving = [piece for piece in pieces if self.state(piece).platform_freedom]
        idle = [p for p in pieces if not self.state(p).platform_freedom]
        plain = Search(self.library, largest=_LONGEST)
        held = self._many is not None or (
            bool(idle)
            and all_are_held(root, limbs, moving, idle, plain, all_known=complete)
        )
        inside, is_whole = ([], True) if held else self._moving_inside(idle, moving)
        if not is_whole:
            reasons.setdefault("an idle piece was not searched to the end")
        # A later piece inside an idle one may contain an earlier one.
        found = [*without_contained([*moving, *inside]), *idle]
        return _Found(tuple(found), "; ".join(reasons))

    @cached_property
    def _many(self) -> ManyWrenches | None:
        """Where more wrenches than are needed let the platform go."""
        search = Search(self.library, largest=_LONGEST)
        return many_wrenches(self.root, self.limbs, search)

    def _zeros_of_many(self, search: Search) -> Dependence | None:
        """Where wrenches, more than needed, let the platform go, or limbs idle."""
        if self._many is None:
            return None
        own = replace(search, found=[], unfinished=[], special=[])
        drops = [rank_drop(self.root, limb, own).decomposition for limb in self.limbs]
        idle = [branch for drop in drops for branch in drop.branches]
        left = tuple(branch for drop in drops for branch in drop.open)
        parts = [part for part in self._many.parts if not search.skip(part)]
        return Dependence((*parts, *idle), left)

    def _moving_outside(
        self, branches: Sequence[Branch], kept: Sequence[Piece]
    ) -> list[Piece]:
        """Moving pieces that only equations of idle ones, which say more, contain."""
        texts = {piece.texts for piece in kept}
        known = [piece for piece in kept if self.state(piece).platform_freedom]
        found: list[Piece] = []
        for piece in pieces_of(branches, surely=True):
            if piece.texts in texts or not self.state(piece).platform_freedom:
                continue
            if not all(_known(branch, known) for branch in piece.branches):
                found.append(piece)
        return without_contained(found)

    def _moving_inside(
        self, idle: Sequence[Piece], moving: Sequence[Piece]
    ) -> tuple[list[Piece], bool]:
        """More pieces on which the platform moves, inside those on which limbs idle.

        Args:
            idle: To be searched.
            moving: Pieces that are known.

        Returns:
            Those in none of the known ones, and whether they are all.
        """
        known, waiting, is_whole = [*moving], [*idle], True
        search = Search(self.library, budget=_IDLE)
        search.skip = lambda branch: _known(branch, known)
        search.inside = lambda branch: (
            own.equations for own in known if lies_in(branch, own)
        )
        seen: dict[frozenset[str], Piece] = {}
        while waiting:
            here = waiting.pop()
            inside, left = _inside(here, self.limbs, search)
            for inner in alike(inside, self.ranks):
                freedom = self.state(inner).platform_freedom
                if freedom and not _known(inner.branches[0], known):
                    known.append(inner)
                elif not freedom and inner.texts not in seen:
                    seen[inner.texts] = inner
                    waiting.append(inner)
            # What lies on a piece inside is searched with that.
            deeper = (p for p in seen.values() if p.codimension > here.codimension)
            searched = [*known, *deeper]
            is_whole &= all(_is_decided(branch, searched) for branch in left)
        return known[len(moving) :], is_whole

    def exactly(self, pieces: Sequence[Piece]) -> ExactPieces:
        """Equations at whose zeros the platform moves, or more joints than in general.

        The first where it moves in general on the piece.
        """
        each = [
            ExactPieces((p,), 0)
            if self._many is not None and self._many.is_all_of(p)
            else with_exact_equations([p], self._singularity(p))
            for p in pieces
        ]
        return ExactPieces(
            tuple(piece for one in each for piece in one.pieces),
            sum(one.uncertain for one in each),
            any(one.narrowed for one in each),
        )

    def _singularity(self, piece: Piece) -> Singularity:
        generic = self.ranks(self.root)
        moves = bool(self.state(piece).platform_freedom)

        def is_singular(branch: Branch) -> bool:
            state = self.ranks(branch)
            if state is None or generic is None:
                return False
            if moves:
                return state.platform_freedom > 0
            return state.mobility > generic.mobility

        columns = partial(loop_columns, self.limbs, height_of(self.limbs))
        return Singularity(self.root, columns, is_singular, self.library)


def _by_limbs(
    root: Branch,
    limbs: Sequence[Sequence[Column]],
    whole: Dependence,
    search: Search,
) -> Dependence:
    """What the determinant, too long as a whole, says in parts that are shorter.

    It vanishes where the passive twists of a limb become dependent, or where limbs
    whose twists keep their ranks do.  Where that leaves something open too, the pieces
    that the whole left open stay, unless they are everything.
    """

    def afresh(budget: int) -> Search:
        return replace(search, budget=budget, found=[], unfinished=[], special=[])

    kept = dependent_zeros(root, limbs, search, within=True)
    if kept.open:  # blocks of wrenches are short, where they tell anything
        own = afresh(_BLOCKS)
        blocks = dependent_zeros(root, limbs, own, within=True, in_blocks=True)
        kept = kept if blocks.open else blocks
    if not kept.open:  # one long determinant may have used up what there was
        search = afresh(_APART)
    drops = [rank_drop(root, limb, search).decomposition for limb in limbs if limb]
    branches = [*whole.branches, *kept.branches]
    left = [*kept.open]
    for drop in drops:
        branches += drop.branches
        left += drop.open
    if left and all(branch.conditions for branch in whole.open):
        return replace(whole, branches=tuple(branches))
    return Dependence(tuple(branches), tuple(left), kept.reason)


def _inside(
    piece: Piece, limbs: Sequence[Sequence[Column]], search: Search
) -> tuple[list[Piece], list[Branch]]:
    """Where more moves than on all of a piece on which limbs idle, and what is open.

    Either limbs that keep their ranks there become dependent, or a limb loses more.
    """
    found: list[Branch] = []
    left: list[Branch] = []
    for branch in piece.branches:
        zeros = dependent_zeros(branch, limbs, search, within=True)
        found += zeros.branches
        left += zeros.open
        for limb in limbs:
            if limb:
                drop = rank_drop(branch, limb, search).decomposition
                found += drop.branches
                left += drop.open
    return pieces_of(found), left


def _known(branch: Branch, pieces: Sequence[Piece]) -> bool:
    return any(lies_in(branch, piece) for piece in pieces)


def _is_decided(branch: Branch, pieces: Sequence[Piece]) -> bool:
    return any(surely_in(branch, piece) for piece in pieces)


def _state(system: PassiveSystem, piece: Piece, passive: Collection[str]) -> LoopState:
    """Generic on the piece: the ranks at its points, the larger of each."""
    states = [
        system.table_at(*point).state(passive)
        for branch in piece.branches[:2]
        for point in branch.points
    ]
    return min(states, key=lambda state: state.platform_freedom)
