"""Where components of singular loci meet: irreducible sets with all they lie on.

A place is a component, or several that are one and the same set.  Places are
intersected one at a time; each intersection is split into irreducible sets, which are
compared by their exact points, so that a set that is met in several ways is kept once.

References: [CoxLittleOShea] §4.6 (decomposition into irreducibles).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros, other_parts
from screwkit.algebra.no_real_angle import never_met
from screwkit.algebra.search import Search, imposed
from screwkit.algebra.trigonometric import Polynomial
from screwkit.loci.lifting import with_sheets_together
from screwkit.loci.pieces import Piece, is_part, pieces_of, sheets_of

BRANCHES = 64
"""Sheets of one component that are followed."""

CASES = 60
"""Case distinctions for one intersection."""


@dataclass(frozen=True)
class Meeting:
    """An irreducible set.

    Attributes:
        piece: Its equations and sheets.
        places: Numbers of all places that it lies on.
    """

    piece: Piece
    places: frozenset[int]


@dataclass
class Meetings:
    """Places, and what was found where they meet.

    Attributes:
        search: With known factors.
        places: Components, no two the same set.
        deepest: Sets of a higher codimension are left out.
        budget: Intersections of two sets that may still be tried.
        state: What holds on a sheet in general; sets are told apart by it, and by the
            places that they lie on.
        open: How many of them were not decided.
        untried: How many were not tried within the budget.
    """

    search: Search
    places: Sequence[Piece]
    deepest: int
    budget: int
    state: Callable[[Branch], object]
    open: int = 0
    untried: int = 0
    found: list[Meeting] = field(default_factory=list)

    def up_to(self, together: int) -> list[Meeting]:
        """The places, then all sets in which up to so many of them meet."""
        level = [Meeting(piece, self._on(piece)) for piece in self.places]
        self.found = list(level)
        tried: set[frozenset[int]] = set()
        for _ in range(together - 1):
            lower: list[Meeting] = []
            for meeting in level:
                for number, place in enumerate(self.places):
                    key = meeting.places | {number}
                    if number in meeting.places or key in tried:
                        continue
                    if max(meeting.piece.codimension, place.codimension) >= (
                        self.deepest
                    ):
                        continue
                    tried.add(key)
                    if is_inside(place, meeting.piece):
                        continue
                    if self.budget <= 0:
                        self.untried += 1
                        continue
                    self.budget -= 1
                    lower += self._fresh(self._meet(meeting.piece, place))
            level = lower
        return self.found

    def _fresh(self, pieces: Sequence[Piece]) -> list[Meeting]:
        """Those that were not met before, taken note of."""
        fresh = []
        for piece in pieces:
            places = self._on(piece)
            new = [b for b in piece.branches if not self._is_met(b, piece, places)]
            for part in sheets_of(piece, new) if new else ():
                fresh.append(Meeting(part, places))
                self.found.append(fresh[-1])
        return fresh

    def _is_met(self, branch: Branch, piece: Piece, places: frozenset[int]) -> bool:
        return any(
            known.piece.codimension == piece.codimension
            and known.places == places
            and is_part(branch, piece, known.piece)
            for known in self.found
        )

    def _kind(self, branch: Branch) -> object:
        """What a sheet is told apart from others by."""
        if not branch.points:
            return None
        return self.state(branch), self._on(Piece((), (branch,)))

    def _on(self, piece: Piece) -> frozenset[int]:
        return frozenset(
            number
            for number, place in enumerate(self.places)
            if is_inside(piece, place)
        )

    def _meet(self, one: Piece, other: Piece) -> list[Piece]:
        found: list[Branch] = []
        for branch in one.branches:
            search = replace(
                self.search, found=[], unfinished=[], special=[], budget=CASES
            )
            equations = [branch.value(e) for e in other.equations]
            zeros = common_zeros(branch, equations, search)
            parts = list(zeros.branches)
            undecided = bool(zeros.open)
            for part in zeros.branches:
                # A condition may hold on two parts at once: both are meant here.
                beside = other_parts(part, search)
                undecided = undecided or beside is None
                parts += [b for b in beside or () if b.points and not b.is_special]
            self.open += undecided
            found += [b for b in parts if b.codimension <= self.deepest]
        pieces = with_sheets_together(pieces_of(found), self._kind)
        met = (p for p in pieces if is_inside(p, other) and is_inside(p, one))
        return [p for p in met if not all(map(_is_complex, p.branches))]


def _is_complex(branch: Branch) -> bool:
    """Whether it is proved that a branch has no real posture."""
    left = [pending.value for pending in branch.pending]
    return never_met(branch.ring, [*branch.conditions, *left])


def is_inside(inner: Piece, outer: Piece) -> bool:
    """Whether all exact points of all sheets of a set lie on another."""
    return all(
        branch.points and all(outer.contains(*point) for point in branch.points)
        for branch in inner.branches
    )


def same_set(one: Piece, other: Piece) -> bool:
    """Whether two irreducible sets are the same."""
    return (
        one.codimension == other.codimension
        and is_inside(one, other)
        and is_inside(other, one)
    )


def recovered(
    root: Branch, equations: Sequence[Polynomial], codimension: int, search: Search
) -> Piece | None:
    """The set of that codimension on which equations vanish; None without points.

    Args:
        root: The whole configuration space.
        equations: Of an irreducible component, in the ring of the root.
        codimension: Of the component.
        search: With known factors.
    """
    branches = [root]
    for equation in equations:
        branches = [
            part for branch in branches for part in imposed(branch, equation, search)
        ]
        if not branches or len(branches) > BRANCHES:
            return None
    # The equations may leave out what no posture meets, as that axes are not zero.
    own = [
        b
        for b in branches
        if b.codimension == codimension and b.points and all(b.divisors)
    ]
    return Piece(tuple(equations), tuple(own)) if own else None
