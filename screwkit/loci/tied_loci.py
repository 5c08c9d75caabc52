"""Singular loci of mechanisms whose loops tie joint variables, at closed postures.

The matrix is written in the joint variables as if they were free.  If it has the same
rank in general at closed postures, it loses rank at a closed posture exactly where the
posture lies on a piece of the free locus.  So every piece is met with the closing
equations: exact closed postures on it are looked for, and it is dropped only where it
is proved that no loop closes there.

References: [CoxLittleOShea] §3.1, [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.points import Point, rank_at
from screwkit.algebra.points_on import Unknown
from screwkit.algebra.search import Search
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.whole_graph import Row, state_of
from screwkit.loci.closed_pieces import (
    TiedLocus,
    TiedPiece,
    closed_on,
    inputs_where,
    without_repeats,
)
from screwkit.loci.graph_loci import GraphLocus
from screwkit.loci.lower_rank import lower_rank
from screwkit.loci.matrix_drop import RankAt, matrix_zeros
from screwkit.loci.pieces import lies_in, pieces_of

_LONGEST = 60_000  # terms of a polynomial that is factored
_BUDGET = 300  # case distinctions on one locus


@dataclass(frozen=True)
class TiedFinds:
    """What was found of a locus that lies inside that of a matrix.

    Attributes:
        finds: Pieces that belong to it, each met by closed postures.
        others: Pieces on which the matrix loses rank, and which do not.
        reason: Why there may be more finds; empty where it is proved that there are
            none.
    """

    finds: tuple[TiedPiece, ...]
    others: tuple[TiedPiece, ...]
    reason: str = ""


def loop_locus(
    graph: TiedGraph, locked: Collection[str], kept: Collection[Unknown]
) -> TiedLocus:
    """Where the loop equations of the freedoms that are not locked lose rank."""
    return _listed(_searched(graph, *_loop_equations(graph, locked), kept))


def actuation_finds(graph: TiedGraph, actuated: Sequence[str]) -> TiedFinds:
    """Where the platform moves with these freedoms locked; the others: limbs idle."""
    kept = graph.unknowns_of(actuated)
    rows, at = _loop_equations(graph, actuated)

    def moves(one: TiedPiece) -> bool:
        return graph.state_at(one.points, actuated).platform_freedom > 0

    return _found_inside(graph, _searched(graph, rows, at, kept), rows, at, kept, moves)


def _loop_equations(
    graph: TiedGraph, locked: Collection[str]
) -> tuple[Sequence[Row], RankAt]:
    def at(point: Point, prime: int) -> int:
        return graph.motion_at(point, prime, locked).rank

    return graph.equations(locked)[1], at


def tied_actuation_locus(graph: TiedGraph, actuated: Sequence[str]) -> GraphLocus:
    """Where freedoms move with these locked; moving platforms apart from idle limbs."""
    found = actuation_finds(graph, actuated)
    moving, idle = (
        tuple(one.piece for one in pieces) for pieces in (found.finds, found.others)
    )
    return GraphLocus(moving, idle, found.reason, not found.reason)


def limb_locus(graph: TiedGraph, number: int, kept: Collection[Unknown]) -> TiedFinds:
    """Where a limb with loops inside allows the platform less.

    Its freedom is rank [C; P] less rank C of its loop equations without and with the
    platform held, and falls only where the first does: a kernel of constant dimension
    varies continuously.
    """
    limb = graph.limbs_in_place[number]
    _, rows = limb.equations(held=True)

    def at(point: Point, prime: int) -> int:
        return state_of(limb.motion_at(point, prime)).held

    generic = graph.limb_freedom(number, graph.closed.points)

    def loses(one: TiedPiece) -> bool:
        return graph.limb_freedom(number, one.points) < generic

    return _found_inside(graph, _searched(graph, rows, at, kept), rows, at, kept, loses)


def columns_locus(
    graph: TiedGraph, labels: Sequence[str], kept: Collection[Unknown]
) -> TiedLocus:
    """Where the twists of some freedoms lose rank."""
    columns = [graph.framed.column(label) for label in labels]
    rows: list[Row] = [
        {i: column[k] for i, column in enumerate(columns) if column[k] != 0}
        for k in range(6)
    ]

    def at(point: Point, prime: int) -> int:
        return rank_at(columns, point, prime)

    return _listed(_searched(graph, [row for row in rows if row], at, kept))


def _listed(locus: TiedLocus) -> TiedLocus:
    return replace(locus, pieces=without_repeats(locus.pieces))


def _searched(
    graph: TiedGraph, rows: Sequence[Row], at: RankAt, kept: Collection[Unknown]
) -> TiedLocus:
    free = max(at(*point) for point in graph.root.points)
    closed = max(at(*point) for point in graph.closed.points)
    if closed < free:
        return lower_rank(graph, rows, at, kept)
    met = _met(graph, [graph.root], rows, at, kept)
    if met.left and not met.pieces:
        lower = lower_rank(graph, rows, at, kept)
        if not lower.reason:
            return lower
    return TiedLocus(met.pieces, _why_open(met.left, met.unmet))


@dataclass(frozen=True)
class _Met:
    """Zeros of a matrix that closed postures meet.

    Attributes:
        pieces: On each of which exact closed postures were found.
        left: How many branches were not decided.
        unmet: Of how many pieces it is not known whether closed postures meet them.
    """

    pieces: tuple[TiedPiece, ...]
    left: int
    unmet: int


def _met(
    graph: TiedGraph,
    branches: Sequence[Branch],
    rows: Sequence[Row],
    at: RankAt,
    kept: Collection[Unknown],
    known: Sequence[TiedPiece] = (),
) -> _Met:
    """Where a matrix has less than its rank on branches, but for known pieces."""
    search = Search(graph.library, budget=_BUDGET, largest=_LONGEST)
    zeros = [matrix_zeros(branch, rows, at, search) for branch in branches]
    found: list[TiedPiece] = []
    unmet = 0
    for piece in pieces_of(branch for one in zeros for branch in one.branches):
        if all(any(lies_in(b, k.piece) for k in known) for b in piece.branches):
            continue
        there = closed_on(graph, piece.equations, kept)
        if there.points:
            inputs = inputs_where(graph, piece.equations, there.implied)
            found.append(TiedPiece(piece, there.points, inputs, there.branches))
        elif not there.never:
            unmet += 1
    left = [branch for one in zeros for branch, _ in one.open]
    kept_open = [b for b in left if not _is_shown_empty(graph, b, kept)]
    return _Met(tuple(found), len(kept_open), unmet)


def _found_inside(
    graph: TiedGraph,
    locus: TiedLocus,
    rows: Sequence[Row],
    at: RankAt,
    kept: Collection[Unknown],
    is_find: Callable[[TiedPiece], bool],
) -> TiedFinds:
    """The finds among the pieces of a matrix's locus, and inside those that are none.

    Inside of these more is found only where the matrix has less than its rank there.
    """
    judged = [(one, is_find(one)) for one in locus.pieces]
    finds = [one for one, is_one in judged if is_one]
    others = [one for one, is_one in judged if not is_one]
    left = unmet = 0
    waiting = list(others)
    while waiting:
        one = waiting.pop(0)
        branches = one.piece.branches
        closed = max(at(*point) for point in one.points)
        free = {max((at(*p) for p in b.points), default=-1) for b in branches}
        if free != {closed}:
            left += 1
            continue
        inside = _met(graph, branches, rows, at, kept, finds)
        left, unmet = left + inside.left, unmet + inside.unmet
        for part in inside.pieces:
            (finds if is_find(part) else waiting).append(part)
    reasons = [locus.reason, _why_open(left, unmet)]
    reason = "; ".join(filter(None, reasons))
    return TiedFinds(without_repeats(finds), without_repeats(others), reason)


def _why_open(left: int, unmet: int) -> str:
    reasons = []
    if left:
        pieces = "piece" if left == 1 else "pieces"
        reasons.append(f"{left} {pieces} of the locus could not be decided")
    if unmet:
        conditions = "one condition" if unmet == 1 else f"{unmet} conditions"
        reasons.append(f"whether closed postures meet {conditions} was not decided")
    return "; ".join(reasons)


def _is_shown_empty(
    graph: TiedGraph, branch: Branch, kept: Collection[Unknown]
) -> bool:
    """Whether it is proved that no closed posture lies on an undecided branch."""
    if not branch.conditions:
        return False
    return closed_on(graph, branch.conditions, kept).never
