"""Where limbs become dependent, on a branch: the zeros of a few minors.

A branch on which several conditions of limbs are pending, and that could not be
decided, is taken apart: the unknowns in which those conditions are linear go first.
That counts where it decides everything; otherwise what was open stays as it was.

References: [CoxLittleOShea] §9.1, [LongCaroKhalil2012] §5.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.cases import is_too_long
from screwkit.algebra.decomposition import beside_special, common_zeros
from screwkit.algebra.search import Search
from screwkit.algebra.taken_apart import Apart, taken_apart
from screwkit.algebra.trigonometric import Polynomial
from screwkit.errors import TooLargeError
from screwkit.kinematics.limb_parts import Parts
from screwkit.loci.determinantal import largest_codimension
from screwkit.loci.pieces import Piece, lies_in
from screwkit.loci.wrench_blocks import block_minors
from screwkit.loci.wrench_sums import (
    height_of,
    loop_rank_at,
    telling_minors,
    wrenches_overlap,
)

_APART = 70
"""Case distinctions for a branch that is taken apart."""

_FAILED = 10
"""What it costs the others where that did not decide everything."""

_LONG = 2_000
"""Terms of the shortest minor on a part, beyond which it is not searched."""


@dataclass(frozen=True)
class Dependence:
    """Where limbs become dependent.

    Attributes:
        branches: On each the loop constraint matrix has lost rank, at exact points.
        open: Branches that were not decided; every further zero lies on one of them.
        reason: Why, where a determinant was too long.
    """

    branches: tuple[Branch, ...]
    open: tuple[Branch, ...]
    reason: str = ""


def dependent_zeros(
    branch: Branch,
    limbs: Sequence[Parts],
    search: Search,
    *,
    within: bool = False,
    in_blocks: bool = False,
    overlapping: bool = True,
) -> Dependence:
    """Where on a branch the loop constraint matrix has less than its rank there.

    Args:
        branch: Irreducible.
        limbs: Parts of each limb, in coordinates that tell their twists apart.
        search: Budget, known factors, and what to leave out.
        within: Look only where the limbs keep their ranks; their common factors are
            left out.  Of limbs with loops inside nothing else is known.
        in_blocks: Compare wrenches that limbs share in a few coordinates on their own,
            where ``within``: it goes further, and decides less of a single piece.
        overlapping: In blocks only where some wrench is redundant.
    """
    if len(limbs) < 2 or not any(limbs):
        return Dependence((), ())
    if not branch.points:
        return Dependence((), (branch,))
    bound = largest_codimension(branch, limbs, height_of(limbs), within=within)
    own = search if bound is None else replace(search, bound=bound)
    zeros = _Zeros(limbs, own, within, in_blocks, overlapping=overlapping)
    found = zeros.on(branch)
    search.budget = own.budget
    return found


def has_separate_blocks(branch: Branch, limbs: Sequence[Parts], search: Search) -> bool:
    """Whether wrenches, none of them redundant, are blocks (`wrench_blocks`)."""
    height = height_of(limbs)
    if not branch.points or wrenches_overlap(limbs, height, *branch.points[0]):
        return False
    lists = block_minors(branch, limbs, height, search, overlapping=False)
    return lists is not None and len(lists) > 1


def minors_on(
    branch: Branch, limbs: Sequence[Parts], search: Search
) -> list[list[Polynomial]]:
    """Minors that vanish where limbs that keep their ranks become dependent.

    All of one list do; none where they are too long.
    """
    lists = block_minors(branch, limbs, height_of(limbs), search)
    if lists is not None:
        return lists
    try:
        return [telling_minors(branch, limbs, search, within=True) or []]
    except TooLargeError:
        return []


@dataclass(frozen=True)
class _Zeros:
    limbs: Sequence[Parts]
    search: Search
    within: bool
    in_blocks: bool = False
    is_part: bool = False
    overlapping: bool = True

    def on(self, branch: Branch) -> Dependence:
        generic = self._rank(branch)
        found: list[Branch] = []
        left: list[Branch] = []
        waiting = [branch]
        reasons: list[str] = []
        while waiting:
            here = waiting.pop()
            blocks = self._in_blocks(here, generic)
            if blocks is not None:
                found += blocks.branches
                left += self._left(here, blocks.open, generic, found)
                continue
            try:
                minors = telling_minors(
                    here, self.limbs, self.search, within=self.within
                )
            except TooLargeError as error:
                reasons.append(str(error))
                minors = None
            if minors is None or self.search.budget <= 0:
                left.append(here)
                continue
            shortest = min(minors, key=len)
            if self.is_part and len(shortest) > _LONG:
                return Dependence((), (here,))
            if is_too_long(here.ring, shortest, self.search.largest):
                reasons.append(
                    f"a determinant has {len(shortest):,} terms, too many to factor"
                )
            own = replace(self.search, found=[], unfinished=[], special=[])
            zeros = common_zeros(here, minors, own)
            self.search.budget = own.budget - 1
            for part in zeros.branches:
                if not part.points:
                    left.append(part)
                elif self._rank(part) < generic:
                    found.append(part)
                else:
                    waiting.append(part)
            left += self._left(here, zeros.open, generic, found)
        return Dependence(tuple(found), tuple(left), "; ".join(dict.fromkeys(reasons)))

    def _left(
        self,
        here: Branch,
        undecided: Sequence[Branch],
        generic: int,
        found: list[Branch],
    ) -> Sequence[Branch]:
        """What stays undecided on a branch; what is decided is added to the finds."""
        decided = self._apart(here, undecided, generic) if undecided else []
        if decided is None:
            return undecided
        found += decided
        return ()

    def _in_blocks(self, here: Branch, generic: int) -> Dependence | None:
        """Zeros on a branch where the limbs' wrenches are blocks; None where not."""
        if not (self.within and self.in_blocks) or self.is_part:
            return None
        lists = block_minors(
            here,
            self.limbs,
            height_of(self.limbs),
            self.search,
            overlapping=self.overlapping,
        )
        if lists is None:
            return None
        found: list[Branch] = []
        left: list[Branch] = []
        for minors in lists:
            own = replace(self.search, found=[], unfinished=[], special=[])
            zeros = common_zeros(here, minors, own)
            self.search.budget = own.budget - 1
            left += zeros.open
            for part in zeros.branches:
                if not part.points:
                    left.append(part)
                elif self._rank(part) < generic:
                    found.append(part)
                elif part.codimension <= here.codimension:
                    return None  # a block that tells nothing on the branch itself
                else:
                    below = self.on(part)
                    found += below.branches
                    left += below.open
        if left and self.search.budget > 0:  # what is left can be taken apart
            self.search.budget = max(self.search.budget, _APART)
        return Dependence(tuple(found), tuple(left))

    def _rank(self, branch: Branch) -> int:
        height = height_of(self.limbs)
        return max(loop_rank_at(self.limbs, height, *at) for at in branch.points)

    def _apart(
        self, here: Branch, left: Sequence[Branch], generic: int
    ) -> list[Branch] | None:
        """All zeros on undecided parts of a branch; None where some stay open.

        The branch itself is taken apart where it can be.
        """
        budget = min(_APART, self.search.budget)
        if budget <= 0:
            return None
        inner = replace(self.search, found=[], unfinished=[], special=[], budget=budget)
        zeros = replace(self, search=inner, is_part=True)
        whole = taken_apart(here, inner)
        found: list[Branch] = []
        for branch in [here] if whole else left:
            apart = whole or taken_apart(branch, inner)
            own = None if apart is None else zeros._on_parts(apart, generic)
            if own is None:
                self.search.budget -= _FAILED
                return None
            found += own
        self.search.budget -= budget - inner.budget
        return [_as_asked(part, left) for part in found]

    def _on_parts(self, apart: Apart, generic: int) -> list[Branch] | None:
        if apart.open:
            return None
        found: list[Branch] = []
        for part in apart.parts:
            if self.search.skip(part):
                continue
            if part.is_special:
                if beside_special(part, self.search) != ():
                    return None
                continue
            if not part.points:
                return None
            if self._rank(part) < generic:
                found.append(part)
                continue
            below = self.on(part)
            if below.open:
                return None
            found += below.branches
        return found


def _as_asked(part: Branch, asked: Sequence[Branch]) -> Branch:
    """A part in the conditions of what was taken apart to find it.

    It is one of the parts on which they hold, and they are shorter.
    """
    if any(step.sheet is not None or step.companions for step in part.steps):
        return part
    for whole in asked:
        same = whole.codimension == part.codimension
        if same and lies_in(part, Piece(whole.conditions, (whole,))):
            return replace(part, conditions=whole.conditions)
    return part
