"""Equations that hold at singular postures alone, made so or told.

A piece of codimension two or more may need more equations than its codimension: three
points of the plane are in line with the origin where three determinants vanish, and two
of these vanish at regular postures too.  So do conditions that were solved one after
the other, each where the coefficient of a symbol is not zero: that coefficient may
vanish.  All zeros of a piece's equations are taken apart; each part on which nothing is
singular is excluded, by shorter equations (`shorter_equations`) or by a minor of the
loop equations that is not zero there, or one that tells singular postures where limbs
keep their ranks.  Where the parts could not be told, or no such minor was found, the
piece is counted.

References: [CoxLittleOShea] §9.1 (determinantal varieties), §9.4 (dimension of a part
that so many equations leave).
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros, other_parts
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.fixed_directions import SEVERAL, fixes_angle
from screwkit.algebra.minors import minors_of
from screwkit.algebra.modular import independent
from screwkit.algebra.points import Point, rank_at, residue
from screwkit.algebra.search import Search, imposed
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.algebra.zeros_modulo import exact_zeros
from screwkit.errors import TooLargeError
from screwkit.loci.pieces import Piece
from screwkit.loci.reduced_equations import reduced
from screwkit.loci.shorter_equations import vanishing_on, with_shorter_equations

_BUDGET = 320  # case distinctions for the zeros of one piece's equations
_ROUNDS = 3  # of exclusion: an equation may leave less, but not nothing
_ADDED = 3  # equations in one round
_SETS = 20  # in which parts are looked for: parts beside parts
_TRIED = 6  # choices of rows and columns, of which the shortest minor is taken
_LOOKED_AT = 300  # terms of equations of which points are drawn
_MET = 12  # points of one piece
_SLICES = ((100, 8),)  # monomials that are eliminated together; slices
_PRODUCTS = 20_000  # of terms, in the expansion of a minor by one more column


@dataclass(frozen=True)
class Singularity:
    """What makes a posture singular.

    Attributes:
        root: The whole configuration space.
        equations: Columns of loop equations, one for each freedom.  Wherever it is
            singular they have less than their generic rank: so they do where limbs lose
            twists, loops lose constraints, or a locked platform moves, since what stays
            idle beside that never becomes less.
        holds_on: Whether it is so in general on a branch with exact points.
        library: Factors met before.
        least: Rank of the columns wherever it is not singular; the generic one if None.
        told_on: On a branch, polynomials that tell what is singular there; some that
            vanish on a piece may not on its regular parts.
    """

    root: Branch
    equations: Callable[[], list[list[Polynomial]]]
    holds_on: Callable[[Branch], bool]
    library: FactorLibrary
    least: int | None = None
    told_on: Callable[[Branch], Sequence[Polynomial]] = lambda branch: ()

    @cached_property
    def columns(self) -> list[list[Polynomial]]:
        """Of the loop equations, made when they are asked for."""
        return self.equations()

    @cached_property
    def rank(self) -> int:
        """Of the loop equations at regular postures, or more."""
        if self.least is not None:
            return self.least
        return max(rank_at(self.columns, *point) for point in self.root.points)


@dataclass(frozen=True)
class ExactPieces:
    """Pieces whose equations hold at singular postures alone, as far as known.

    Attributes:
        uncertain: How many of them have equations that may hold at others too.
        narrowed: Whether equations were added or replaced: fewer postures satisfy those
            of a piece.
    """

    pieces: tuple[Piece, ...]
    uncertain: int
    narrowed: bool = False

    @property
    def reason(self) -> str:
        """That some equations may say too much, in words; empty for none."""
        if not self.uncertain:
            return ""
        noun = "component" if self.uncertain == 1 else "components"
        count = "one" if self.uncertain == 1 else self.uncertain
        return f"the equations of {count} {noun} may hold at regular postures too"


def with_exact_equations(pieces: Sequence[Piece], singular: Singularity) -> ExactPieces:
    """The pieces with equations that exclude regular postures, where these are found.

    Args:
        pieces: Singular in general.
        singular: What that means.
    """
    found: list[Piece] = []
    uncertain = 0
    for piece in pieces:
        exact, is_certain = _exact(piece, singular)
        found.append(exact)
        uncertain += not is_certain
    return ExactPieces(tuple(found), uncertain, narrower(found, pieces))


def narrower(pieces: Sequence[Piece], before: Sequence[Piece]) -> bool:
    """Whether some piece has other equations than the one that it was."""
    pairs = zip(pieces, before, strict=True)
    return any(not now.texts <= then.texts for now, then in pairs)


def _exact(piece: Piece, singular: Singularity) -> tuple[Piece, bool]:
    """The piece, more equations added, and whether they are enough."""
    for _ in range(_ROUNDS):
        if piece.is_exact:
            return piece, True
        parts, is_whole = _regular_parts(piece, singular)
        points = [at for part in parts for at in part.points]
        points = points or _regular_points(piece, singular)
        if not points and (is_whole or _is_settled_otherwise(piece, singular)):
            return piece, True
        shorter = with_shorter_equations(piece, singular.root, singular.library)
        if shorter != piece:
            piece = shorter
            continue
        if not points:
            return piece, False
        extra = _excluding(points, piece, singular)
        if not extra:
            return piece, False
        whole = replace(piece, equations=(*piece.equations, *extra))
        piece = without_products(whole, singular)
    parts, is_whole = _regular_parts(piece, singular)
    return piece, is_whole and not parts and not _regular_points(piece, singular)


def without_products(piece: Piece, singular: Singularity) -> Piece:
    """The piece with equations reduced by each other, and of products what it needs.

    A minor may be a product where the other equations hold, which only shows then.
    """
    root, library = singular.root, singular.library
    if not all(branch.points for branch in piece.branches):
        return piece
    shorter = reduced(piece, root, library)
    equations = tuple(
        min(vanishing_on(piece, own, root, library), key=len, default=own)
        for own in shorter.equations
    )
    return replace(piece, equations=equations)


def _regular_parts(
    piece: Piece, singular: Singularity, *, further: bool = False
) -> tuple[list[Branch], bool]:
    """Parts of the zeros on which nothing is singular, and whether these are all."""
    found: list[Branch] = []
    is_whole = True
    waiting = [singular.root]
    for _ in range(_SETS):
        if not waiting:
            break
        branch, search = waiting.pop(), _search(singular, len(piece.equations))
        search.further = further
        values = [branch.value(equation) for equation in piece.equations]
        zeros = common_zeros(branch, values, search)
        is_whole = is_whole and zeros.complete
        for part in zeros.branches:
            others = other_parts(part, search)
            is_whole = is_whole and others is not None and bool(part.points)
            waiting += others or ()
            if part.points and not singular.holds_on(part):
                found.append(part)
    return found, is_whole and not waiting


def _regular_points(piece: Piece, singular: Singularity) -> list[tuple[Point, int]]:
    """Exact points at which the equations hold and nothing is singular, as met.

    Conditions left when a symbol was solved for may have common zeros on which a third
    one vanishes, as large as the piece: no search by factors shows these.
    """
    if sum(map(len, piece.equations)) > _LOOKED_AT:
        return []
    ring = singular.root.ring
    found = exact_zeros(ring, piece.equations, (), _MET, _SLICES)
    return [
        (point, prime)
        for point, prime in found
        if rank_at(singular.columns, point, prime) >= singular.rank
    ]


def _is_settled_otherwise(piece: Piece, singular: Singularity) -> bool:
    """Whether no part is regular, seen with the angles kept that equations fix.

    Or where what would be left open is taken further.
    """
    ring = singular.root.ring
    fixed = {fixes_angle(ring, equation) for equation in piece.equations} - {None}
    if len(fixed) >= SEVERAL:
        kept = replace(singular, root=replace(singular.root, directed=True))
        if _regular_parts(piece, kept) == ([], True):
            return True
    return _regular_parts(piece, singular, further=True) == ([], True)


def _search(singular: Singularity, count: int) -> Search:
    """For parts that are not singular; those whose zeros are one set end there.

    So many equations leave no part of larger codimension.
    """

    def is_settled(part: Branch) -> bool:
        single = len(part.pending) < 2 and bool(part.points)
        return single and singular.holds_on(part)

    own = Search(singular.library, budget=_BUDGET)
    return replace(own, every_part=True, skip=is_settled, deepest=count)


def _excluding(
    points: Sequence[tuple[Point, int]], piece: Piece, singular: Singularity
) -> list[Polynomial]:
    """Equations that hold on the piece and fail at each of these points."""
    extra: list[Polynomial] = []
    told: list[Polynomial] | None = None
    for point, prime in points:
        if rank_at(singular.columns, point, prime) < singular.rank:
            continue
        if len(extra) == _ADDED or any(residue(e, point, prime) for e in extra):
            continue
        minor = _minor_at(singular, point, prime)
        if minor is not None:
            extra.append(_on_piece(minor, piece, singular))
            continue
        if told is None:
            told = _told_beside(piece, singular)
        extra += [p for p in told if residue(p, point, prime)][:1]
    return extra


def _told_beside(piece: Piece, singular: Singularity) -> list[Polynomial]:
    """What tells singular postures where the piece has its longest equation left out.

    Of that the factors that vanish on the piece, short ones first.
    """
    if not all(branch.points for branch in piece.branches):
        return []
    longest = max(piece.equations, key=len)
    search = Search(singular.library)
    branches: list[Branch] = [singular.root]
    for equation in piece.equations:
        if equation is not longest:
            branches = [b for a in branches for b in imposed(a, equation, search)]
    found = {
        str(factor): factor
        for branch in branches
        for told in singular.told_on(branch)
        for factor in vanishing_on(piece, told, singular.root, singular.library)
    }
    return sorted(found.values(), key=len)


def _on_piece(minor: Polynomial, piece: Piece, singular: Singularity) -> Polynomial:
    """The factor that vanishes on the piece; the others say nothing of it."""
    if not any(branch.points for branch in piece.branches):
        return minor
    found = vanishing_on(piece, minor, singular.root, singular.library)
    return next(iter(found), minor)


def _minor_at(singular: Singularity, point: Point, prime: int) -> Polynomial | None:
    """A short minor, as large as the rank at a point, that is not zero there."""
    columns = singular.columns
    source = random.Random(len(columns))
    sizes = [sum(map(len, column)) for column in columns]
    best: Polynomial | None = None
    for number in range(_TRIED):
        noise = 4 if number else 0
        weights = [size * (1 + source.uniform(0, noise)) for size in sizes]
        order = sorted(range(len(columns)), key=weights.__getitem__)
        heights = source.sample(range(len(columns[0])), len(columns[0]))
        values = [
            [residue(columns[k][h], point, prime) for h in heights] for k in order
        ]
        chosen = [order[k] for k in independent(values, prime)]
        across = [
            [residue(columns[k][h], point, prime) for k in chosen] for h in heights
        ]
        kept = [heights[h] for h in independent(across, prime)]
        own = [[columns[k][h] for h in kept] for k in chosen]
        try:
            minors = minors_of(singular.root.ring, own, _PRODUCTS)
        except TooLargeError:
            continue
        minor = minors[(1 << len(kept)) - 1]
        if best is None or len(minor) < len(best):
            best = primitive(minor)
    return best
