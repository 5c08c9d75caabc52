"""Pieces of a locus that closed postures lie on, and proofs that none does.

References: [CoxLittleOShea] §3.1.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

from screwkit.algebra.angle_elimination import Elimination
from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import Factor, factor
from screwkit.algebra.no_real_angle import never_met
from screwkit.algebra.points import Point, residue
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.kinematics.tied_graph import TiedGraph, points_of
from screwkit.loci.pieces import Piece, surely_in

_IMPLIED = 40  # case distinctions on what a piece implies
_POINTS = 4  # exact closed postures on a piece
_SHORT = 1_000  # terms of what is left, with which points are looked for
_ALONE = 4  # angles to which conditions are brought one by one


@dataclass(frozen=True)
class TiedPiece:
    """A piece that closed postures lie on.

    Attributes:
        points: Exact closed postures on it, with their primes.
        inputs: Factors of what the closed postures on it imply for the driven
            variables, each met by one of them; empty where that was not found.
        branches: On which all closed postures on it lie; None where they were not
            taken apart.
    """

    piece: Piece
    points: tuple[tuple[Point, int], ...]
    inputs: tuple[Factor, ...] = ()
    branches: tuple[Branch, ...] | None = None


@dataclass(frozen=True)
class TiedLocus:
    """What was found.

    Attributes:
        pieces: In the joint variables, each met by closed postures.
        reason: Why there may be more; empty where it is proved that there are none.
    """

    pieces: tuple[TiedPiece, ...]
    reason: str = ""


@dataclass(frozen=True)
class ClosedPostures:
    """What is known of closed postures at which equations hold.

    Attributes:
        never: It is proved that there is none, special dimensions aside.
        points: Exact ones, with their primes.
        implied: What the equations imply there for the unknowns that were kept; None
            where that was not found.
        branches: On which all of them lie; None where they were not taken apart.
    """

    never: bool
    points: tuple[tuple[Point, int], ...] = ()
    implied: Elimination | None = None
    branches: tuple[Branch, ...] | None = None


def closed_on(
    graph: TiedGraph,
    equations: Sequence[Polynomial],
    kept: Collection[Unknown],
    *,
    thorough: bool = False,
) -> ClosedPostures:
    """Closed postures at which equations hold, or a proof that there is none.

    Args:
        graph: The mechanism.
        equations: In its ring.
        kept: Unknowns for which their consequences are wanted.
        thorough: Look for a proof that complex postures alone meet them, too.
    """
    if graph.is_never_closed_where(equations):
        return ClosedPostures(True)
    part = graph.closed_where(equations)
    if part.is_empty:
        return ClosedPostures(True)
    first: Elimination | None = None
    points = part.points or graph.met_where(equations)
    for number, chosen in enumerate(_choices(graph, kept)):
        if number and points and not thorough:
            break
        implied = graph.implied(equations, chosen)
        if implied is None:
            continue
        if is_impossible(graph, implied):
            return ClosedPostures(True)
        if not number:
            first = implied
        points = points or points_where(implied)
    return ClosedPostures(False, points, first, part.branches)


def _choices(
    graph: TiedGraph, kept: Collection[Unknown]
) -> Iterator[Collection[Unknown]]:
    """Unknowns to keep: those asked for, none but dimensions, or one angle alone."""
    dimensions = graph.unknowns_of(())
    yield kept
    yield dimensions
    angles = (("angle", number) for number in range(len(graph.framed.ring.basis)))
    for angle in islice((a for a in angles if a not in dimensions), _ALONE):
        yield (*dimensions, angle)


def without_repeats(pieces: Sequence[TiedPiece]) -> tuple[TiedPiece, ...]:
    """Pieces without those whose closed postures lie on others.

    Two conditions of free joint variables may meet the closed postures in one set.
    """
    kept = list(pieces)
    for one in reversed(pieces):
        others = [other.piece for other in kept if other is not one]
        if one.branches is not None and all(
            any(surely_in(branch, other) for other in others) for branch in one.branches
        ):
            kept.remove(one)
    return tuple(kept)


def is_impossible(graph: TiedGraph, implied: Elimination) -> bool:
    """Whether it is proved that what is implied holds at no real posture."""
    ring = graph.framed.ring
    if never_met(ring, implied.left):
        return True
    if any(p != 0 and not _speaks_of_joints(graph, p) for p in implied.left):
        return True
    if len(implied.left) < 2:
        return False
    search = Search(graph.library, budget=_IMPLIED)
    zeros = common_zeros(graph.root, implied.left, search)
    return zeros.complete and all(
        never_met(ring, branch.conditions) for branch in zeros.branches
    )


def points_where(implied: Elimination | None) -> tuple[tuple[Point, int], ...]:
    """Exact closed postures at which what was eliminated holds; empty without any."""
    if implied is None or sum(map(len, implied.left)) > _SHORT:
        return ()
    return points_of(implied, _POINTS)


def _speaks_of_joints(graph: TiedGraph, polynomial: Polynomial) -> bool:
    """Whether joint variables occur, and not dimensions alone."""
    ring = graph.framed.ring
    dimensions = {parameter.name for parameter in graph.mechanism.parameters}
    names = (
        ring.basis[number][0][0] if kind == "angle" else _symbol(ring, number)
        for kind, number in unknowns(ring, polynomial)
    )
    return any(name not in dimensions for name in names)


def _symbol(ring: TrigonometricRing, index: int) -> str:
    places = zip(ring.symbols, ring.symbol_indices(), strict=True)
    return next(name for name, place in places if place == index)


def inputs_where(
    graph: TiedGraph, equations: Sequence[Polynomial], implied: Elimination | None
) -> tuple[Factor, ...]:
    """Factors of what equations imply that closed postures on them meet.

    Each closed posture at which the equations hold lies on one of them: a factor is
    left out only where it is proved that none does.  Complex ones may bend out of
    sight: of pivots that coincide the squared distance is a sum of squares, and general
    zeros of it are no postures.  Such a factor is asked for once more, with the
    closing equations.

    Returns:
        Nothing where that was not found, or not of each factor.
    """
    if implied is None or len(implied.left) != 1 or implied.left[0].is_constant():
        return ()
    met = []
    for one, _ in factor(graph.framed.ring, implied.left[0], graph.library).factors:
        if not any(_speaks_of_joints(graph, p) for p in one.equations):
            continue
        if never_met(graph.framed.ring, one.equations):
            continue
        own = Elimination(implied.ring, implied.equations, one.equations, implied.steps)
        if not any(_holds(one, *at) for at in points_where(own)):
            there = closed_on(graph, [*equations, *one.equations], ())
            if there.never:
                continue
            if not there.points:
                return ()
        if len(one.equations) > 1:  # in half angles, and no equation says it
            return ()
        met.append(one)
    return tuple(met)


def _holds(one: Factor, point: Point, prime: int) -> bool:
    return not any(residue(equation, point, prime) for equation in one.equations)
