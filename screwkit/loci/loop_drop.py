"""Where limbs that hold one body become dependent on each other.

The limbs' wrench systems W_i add up directly for generic values; the loop constraint
matrix loses rank exactly where they do not.  On the set where every limb has its
generic rank, W_1 ⊕ … ⊕ W_k fails exactly where the join of their Plücker coordinates
vanishes, whatever basis is taken.  Where a limb loses rank, its wrench system grows, and
the same question is asked again on that piece.  The pieces form a finite tree, and no
pattern of regular and singular limbs is skipped.

References: [LongCaroKhalil2012] §5.2.1; [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import product

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import Search, common_zeros
from screwkit.algebra.minors import combined, minor_table
from screwkit.algebra.points import rank_at
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.assembly import loop_rows
from screwkit.loci.pieces import Piece, lies_in, pieces_of
from screwkit.loci.rank_drop import Column, extensors, generic_rank, rank_drop


@dataclass(frozen=True)
class LoopState:
    """Ranks on a branch.

    Attributes:
        limbs: Rank of each limb's twists.
        loop: Rank of the loop constraint matrix.
        freedoms: Number of columns.
    """

    limbs: tuple[int, ...]
    loop: int
    freedoms: int

    @property
    def mobility(self) -> int:
        """Joint motions that the loops allow."""
        return self.freedoms - self.loop

    @property
    def platform_freedom(self) -> int:
        """Dimension of the twists the platform can have."""
        return self.mobility - (self.freedoms - sum(self.limbs))

    @property
    def wrench_dimension(self) -> int:
        """Dimension of the platform's constraint wrenches."""
        return 6 - self.platform_freedom


@dataclass(frozen=True)
class LoopDrop:
    """Pieces on which the loop constraint matrix loses rank.

    Attributes:
        open: Branches that were not decided; every further piece lies in one of them.
    """

    generic: LoopState
    pieces: tuple[Piece, ...]
    open: tuple[Branch, ...]


def loop_state(branch: Branch, limbs: Sequence[Sequence[Column]]) -> LoopState | None:
    """Ranks at random exact points of a branch; None where no point was found."""
    points = branch.points
    if not points:
        return None
    rows = _rows(limbs)
    return LoopState(
        tuple(max(rank_at(limb, *point) for point in points) for limb in limbs),
        max(rank_at(rows, *point) for point in points) if rows else 0,
        sum(len(limb) for limb in limbs),
    )


def _rows(limbs: Sequence[Sequence[Column]]) -> list[list[Polynomial]]:
    return loop_rows(limbs)


@dataclass
class _Walk:
    """The tree of pieces under way, shallow ones first."""

    limbs: Sequence[Sequence[Column]]
    generic: LoopState
    search: Search
    found: list[Branch] = field(default_factory=list)
    open: list[Branch] = field(default_factory=list)
    waiting: list[Branch] = field(default_factory=list)
    visited: dict[frozenset[str], None] = field(default_factory=dict)
    signatures: dict[str, Branch] = field(default_factory=dict)
    alike: list[tuple[Branch, Branch]] = field(default_factory=list)
    pieces: list[Piece] = field(default_factory=list)

    def keep(self, branches: Sequence[Branch]) -> None:
        """Take note of branches on which the loops lose rank."""
        if branches:
            self.found.extend(branches)
            self.pieces = pieces_of(self.found)

    def known(self, branch: Branch) -> bool:
        """Whether a branch lies in a piece that was found before."""
        return any(lies_in(branch, piece) for piece in self.pieces)


def loop_drop(
    root: Branch, limbs: Sequence[Sequence[Column]], search: Search
) -> LoopDrop:
    """Every piece of ``root`` on which the loop constraint matrix loses rank.

    Args:
        root: As a rule the whole configuration space.
        limbs: Twists of each limb in one common frame.
        search: Budget and known factors, shared by all steps.
    """
    generic = loop_state(root, limbs)
    if generic is None:
        raise ValueError("the whole space has no exact point")
    walk = _Walk(limbs, generic, search, waiting=[root])
    while walk.waiting:
        walk.waiting.sort(key=lambda branch: branch.codimension)
        _visit(walk.waiting.pop(0), walk)
    pieces = pieces_of([*walk.found, *_other_sheets(walk.found, walk.alike)])
    undecided = [*walk.open, *_other_sheets(walk.open, walk.alike)]
    open_left = tuple(
        branch
        for branch in undecided
        if not any(lies_in(branch, piece) for piece in pieces)
    )
    return LoopDrop(generic, tuple(pieces), open_left)


def _visit(branch: Branch, walk: _Walk) -> None:
    key = frozenset(str(p) for p in (*branch.conditions, *branch.sheets))
    if key in walk.visited or walk.known(branch):
        return
    walk.visited[key] = None
    if _is_like_another_sheet(branch, walk):
        return
    state = loop_state(branch, walk.limbs)
    if state is None:
        walk.open.append(branch)
        return
    if state.loop < walk.generic.loop:
        walk.keep([branch])
        return
    drops = _limb_drops(branch, walk)
    walk.waiting.extend(drops)
    polynomials = _dependence(branch, state, walk)
    if polynomials is None:
        walk.open.append(branch)
        return
    elsewhere = [*pieces_of(drops), *walk.pieces]
    search = replace(
        walk.search,
        found=[],
        unfinished=[],
        skip=lambda b: any(lies_in(b, piece) for piece in elsewhere),
    )
    zeros = common_zeros(branch, polynomials, search)
    walk.keep(zeros.branches)
    walk.open.extend(zeros.open)


def _is_like_another_sheet(branch: Branch, walk: _Walk) -> bool:
    """Whether a sheet of the same conditions has the same twists up to sign.

    Then everything about it is the same, and it is not searched again.
    """
    conditions = sorted(str(condition) for condition in branch.conditions)
    columns = [
        [str(_up_to_sign(branch.column(column))) for column in limb]
        for limb in walk.limbs
    ]
    signature = f"{conditions}{columns}{[str(p) for p in branch.pending]}"
    other = walk.signatures.setdefault(signature, branch)
    if other is branch:
        return False
    walk.alike.append((other, branch))
    return True


def _up_to_sign(column: Sequence[Polynomial]) -> list[Polynomial]:
    for entry in column:
        if entry != 0:
            if entry.coeffs()[0] < 0:
                return [-value for value in column]
            break
    return list(column)


def _other_sheets(
    branches: Sequence[Branch], alike: Sequence[tuple[Branch, Branch]]
) -> list[Branch]:
    """The branches again, below the sheets that were not searched."""
    copies: list[Branch] = []
    waiting = list(branches)
    while waiting:
        branch = waiting.pop()
        for searched, other in alike:
            depth = len(searched.steps)
            if branch.steps[:depth] == searched.steps:
                steps = (*other.steps, *branch.steps[depth:])
                copy = replace(branch, steps=steps)
                if not any(copy.steps == known.steps for known in copies):
                    copies.append(copy)
                    waiting.append(copy)
    return copies


def _limb_drops(branch: Branch, walk: _Walk) -> list[Branch]:
    """The pieces of the branch on which one limb loses rank."""
    found: list[Branch] = []
    search = replace(walk.search, skip=walk.known)
    for limb in walk.limbs:
        drop = rank_drop(branch, limb, search)
        found.extend(drop.decomposition.branches)
        walk.open.extend(drop.decomposition.open)
    return found


def _dependence(
    branch: Branch, state: LoopState, walk: _Walk
) -> list[Polynomial] | None:
    """Polynomials that vanish where limbs of generic rank become dependent.

    None where the branch is too large for the route that it would need.
    """
    if state.loop == 6 * (len(walk.limbs) - 1):
        charts = [
            extensors(branch, limb, rank)
            for limb, rank in zip(walk.limbs, state.limbs, strict=True)
        ]
        polynomials: list[Polynomial] = []
        for chart in product(*charts):
            polynomials.extend(combined(branch.ring, chart, 6).values())
        return polynomials
    rows = [branch.column(column) for column in _rows(walk.limbs)]
    if len(rows) > 10 or len(walk.limbs) != 2:
        return None
    table = minor_table(branch.ring, rows, len(rows[0]), state.loop)
    return [
        minor
        for chosen, minors in table.items()
        if chosen.bit_count() == state.loop
        for minor in minors.values()
    ]


__all__ = ["LoopDrop", "LoopState", "generic_rank", "loop_drop", "loop_state"]
