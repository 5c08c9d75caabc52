"""Singular loci of mechanisms whose loops tie joint variables, at closed postures.

The matrix is written in the joint variables as if they were free.  If it has the same
rank in general at closed postures, it loses rank at a closed posture exactly where the
posture lies on a piece of the free locus.  So every piece is met with the closing
equations: exact closed postures on it are looked for, and it is dropped only where it
is proved that no loop closes there.

References: [CoxLittleOShea] §3.1, [Zlatanov2002].
"""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from screwkit.algebra.angle_elimination import Elimination, eliminated
from screwkit.algebra.branches import Branch, random_branch_prime
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import Factor, factor
from screwkit.algebra.no_real_angle import never_met
from screwkit.algebra.points import Point, rank_at, residue
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.whole_graph import Row
from screwkit.loci.graph_loci import GraphLocus
from screwkit.loci.matrix_drop import RankAt, matrix_zeros
from screwkit.loci.pieces import Piece, pieces_of

_LONGEST = 60_000  # terms of a polynomial that is factored
_BUDGET = 300  # case distinctions on one locus
_IMPLIED = 40  # case distinctions on what a piece implies
_POINTS = 4  # exact closed postures on a piece


@dataclass(frozen=True)
class TiedPiece:
    """A piece that closed postures lie on.

    Attributes:
        points: Exact closed postures on it, with their primes.
        inputs: Factors of what the closed postures on it imply for the driven
            variables, each met by one of them; empty where that was not found.
    """

    piece: Piece
    points: tuple[tuple[Point, int], ...]
    inputs: tuple[Factor, ...] = ()


@dataclass(frozen=True)
class TiedLocus:
    """What was found.

    Attributes:
        pieces: In the joint variables, each met by closed postures.
        reason: Why there may be more; empty where it is proved that there are none.
    """

    pieces: tuple[TiedPiece, ...]
    reason: str = ""


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
        return TiedLocus(
            (),
            f"closed postures have rank {closed} in general, where joint variables "
            f"that nothing ties would have {free}; such loops are not searched yet",
        )
    search = Search(graph.library, budget=_BUDGET, largest=_LONGEST)
    zeros = matrix_zeros(graph.root, rows, at, search)
    found: list[TiedPiece] = []
    unmet = 0
    for piece in pieces_of(zeros.branches):
        part = graph.closed_where(piece.equations)
        if part.is_empty:
            continue
        equations = [*piece.equations, *graph.closing]
        implied = eliminated(graph.framed.ring, equations, kept)
        if implied is not None and _is_impossible(graph, implied):
            continue
        points = part.points or _points(implied)
        if points:
            found.append(TiedPiece(piece, points, _inputs(graph, implied)))
        else:
            unmet += 1
    reasons = []
    left = [b for b, _ in zeros.open if not _is_shown_empty(graph, b, kept)]
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
    equations = [*branch.conditions, *graph.closing]
    implied = eliminated(graph.framed.ring, equations, kept)
    return implied is not None and _is_impossible(graph, implied)


def _is_impossible(graph: TiedGraph, implied: Elimination) -> bool:
    """Whether it is proved that what is implied holds at no real posture."""
    if never_met(graph.framed.ring, implied.left):
        return True
    if len(implied.left) < 2:
        return False
    search = Search(graph.library, budget=_IMPLIED)
    zeros = common_zeros(graph.root, implied.left, search)
    return zeros.complete and not zeros.branches


def _points(implied: Elimination | None) -> tuple[tuple[Point, int], ...]:
    if implied is None:
        return ()
    source = random.Random(20121)
    found = []
    for _ in range(4 * _POINTS):
        prime = random_branch_prime(source)
        point = implied.point(source, prime)
        if point is not None:
            found.append((point, prime))
        if len(found) == _POINTS:
            break
    return tuple(found)


def _speaks_of_joints(graph: TiedGraph, one: Factor) -> bool:
    """Whether joint variables occur, and not dimensions alone."""
    ring = graph.framed.ring
    dimensions = {parameter.name for parameter in graph.mechanism.parameters}
    names = (
        ring.basis[number][0][0] if kind == "angle" else _symbol(ring, number)
        for kind, number in unknowns(ring, one.polynomial)
    )
    return any(name not in dimensions for name in names)


def _symbol(ring: TrigonometricRing, index: int) -> str:
    places = zip(ring.symbols, ring.symbol_indices(), strict=True)
    return next(name for name, place in places if place == index)


def _inputs(graph: TiedGraph, implied: Elimination | None) -> tuple[Factor, ...]:
    """Factors of what is implied, those alone on which closed postures were found."""
    if implied is None or len(implied.left) != 1 or implied.left[0].is_constant():
        return ()
    met = []
    for one, _ in factor(graph.framed.ring, implied.left[0], graph.library).factors:
        if len(one.equations) > 1 or not _speaks_of_joints(graph, one):
            continue
        own = Elimination(implied.ring, implied.equations, one.equations, implied.steps)
        if any(not residue(one.polynomial, *at) for at in _points(own)):
            met.append(one)
    return tuple(met)
