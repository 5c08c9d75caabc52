"""Pieces of a locus that closed postures lie on, and proofs that none does.

References: [CoxLittleOShea] §3.1.
"""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.algebra.angle_elimination import Elimination
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import Factor, factor
from screwkit.algebra.no_real_angle import never_met
from screwkit.algebra.points import Point, residue
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.kinematics.tied_graph import TiedGraph, points_of
from screwkit.loci.pieces import Piece

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


def is_impossible(graph: TiedGraph, implied: Elimination) -> bool:
    """Whether it is proved that what is implied holds at no real posture."""
    if never_met(graph.framed.ring, implied.left):
        return True
    if len(implied.left) < 2:
        return False
    search = Search(graph.library, budget=_IMPLIED)
    zeros = common_zeros(graph.root, implied.left, search)
    return zeros.complete and all(
        never_met(graph.framed.ring, branch.conditions) for branch in zeros.branches
    )


def points_where(implied: Elimination | None) -> tuple[tuple[Point, int], ...]:
    """Exact closed postures at which what was eliminated holds; empty without any."""
    return () if implied is None else points_of(implied, _POINTS)


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


def inputs_where(graph: TiedGraph, implied: Elimination | None) -> tuple[Factor, ...]:
    """Factors of what is implied, those alone on which closed postures were found."""
    if implied is None or len(implied.left) != 1 or implied.left[0].is_constant():
        return ()
    met = []
    for one, _ in factor(graph.framed.ring, implied.left[0], graph.library).factors:
        if len(one.equations) > 1 or not _speaks_of_joints(graph, one):
            continue
        own = Elimination(implied.ring, implied.equations, one.equations, implied.steps)
        if any(not residue(one.polynomial, *at) for at in points_where(own)):
            met.append(one)
    return tuple(met)
