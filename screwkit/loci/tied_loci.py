"""Singular loci of mechanisms whose loops tie joint variables, at closed postures.

The matrix is written in the joint variables as if they were free.  If it has the same
rank in general at closed postures, it loses rank at a closed posture exactly where the
posture lies on a piece of the free locus.  So every piece is met with the closing
equations: exact closed postures on it are looked for, and it is dropped only where it
is proved that no loop closes there.

References: [CoxLittleOShea] §3.1, [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Collection, Sequence

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
)
from screwkit.loci.graph_loci import GraphLocus
from screwkit.loci.lower_rank import lower_rank
from screwkit.loci.matrix_drop import RankAt, matrix_zeros
from screwkit.loci.pieces import Piece, pieces_of

_LONGEST = 60_000  # terms of a polynomial that is factored
_BUDGET = 300  # case distinctions on one locus


def loop_locus(
    graph: TiedGraph, locked: Collection[str], kept: Collection[Unknown]
) -> TiedLocus:
    """Where the loop equations of the freedoms that are not locked lose rank."""
    _, rows = graph.equations(locked)

    def at(point: Point, prime: int) -> int:
        return graph.motion_at(point, prime, locked).rank

    return _searched(graph, rows, at, kept)


def tied_actuation_locus(graph: TiedGraph, actuated: Sequence[str]) -> GraphLocus:
    """Where freedoms move with these locked; moving platforms apart from idle limbs."""
    locus = loop_locus(graph, actuated, graph.unknowns_of(actuated))
    moving: list[Piece] = []
    idle: list[Piece] = []
    for one in locus.pieces:
        state = graph.state_at(one.points, actuated)
        (moving if state.platform_freedom else idle).append(one.piece)
    return GraphLocus(tuple(moving), tuple(idle), locus.reason, not locus.reason)


def limb_locus(
    graph: TiedGraph, number: int, kept: Collection[Unknown]
) -> tuple[TiedLocus, bool]:
    """Where a limb with loops inside allows the platform less.

    Its freedom is rank [C; P] less rank C of its loop equations without and with the
    platform held, and falls only where the first does: a kernel of constant dimension
    varies continuously.

    Returns:
        The locus, and whether that rank falls on pieces on which the freedom does not,
        so that it may fall inside them.
    """
    limb = graph.limbs_in_place[number]
    _, rows = limb.equations(held=True)

    def at(point: Point, prime: int) -> int:
        return state_of(limb.motion_at(point, prime)).held

    locus = _searched(graph, rows, at, kept)
    generic = graph.limb_freedom(number, graph.closed.points)
    found = tuple(
        one for one in locus.pieces if graph.limb_freedom(number, one.points) < generic
    )
    return TiedLocus(found, locus.reason), len(found) < len(locus.pieces)


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

    return _searched(graph, [row for row in rows if row], at, kept)


def _searched(
    graph: TiedGraph, rows: Sequence[Row], at: RankAt, kept: Collection[Unknown]
) -> TiedLocus:
    free = max(at(*point) for point in graph.root.points)
    closed = max(at(*point) for point in graph.closed.points)
    if closed < free:
        return lower_rank(graph, rows, at, kept)
    search = Search(graph.library, budget=_BUDGET, largest=_LONGEST)
    zeros = matrix_zeros(graph.root, rows, at, search)
    found: list[TiedPiece] = []
    unmet = 0
    for piece in pieces_of(zeros.branches):
        there = closed_on(graph, piece.equations, kept)
        if there.points:
            inputs = inputs_where(graph, there.implied)
            found.append(TiedPiece(piece, there.points, inputs))
        elif not there.never:
            unmet += 1
    reasons = []
    left = [b for b, _ in zeros.open if not _is_shown_empty(graph, b, kept)]
    if left and not found:
        lower = lower_rank(graph, rows, at, kept)
        if not lower.reason:
            return lower
    if left:
        number = len(left)
        pieces = "piece" if number == 1 else "pieces"
        reasons.append(f"{number} {pieces} of the locus could not be decided")
    if unmet:
        conditions = "one condition" if unmet == 1 else f"{unmet} conditions"
        reasons.append(f"whether closed postures meet {conditions} was not decided")
    return TiedLocus(tuple(found), "; ".join(reasons))


def _is_shown_empty(
    graph: TiedGraph, branch: Branch, kept: Collection[Unknown]
) -> bool:
    """Whether it is proved that no closed posture lies on an undecided branch."""
    if not branch.conditions:
        return False
    return closed_on(graph, branch.conditions, kept).never
