"""Of limbs with loops inside: wrenches with the reactions of loops, and minors.

The rows of [P; C] are those of the way to the platform, then those of the loops.  What
annihilates all of its columns is a wrench of the platform with reactions of the loops
that do no work together in any joint.

References: [LongCaroKhalil2012] (4)-(9), (26).
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import combinations, islice
from math import comb

from screwkit.algebra.branches import Branch
from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.minors import minors_of
from screwkit.algebra.modular import independent, rank
from screwkit.algebra.points import Point, branch_primes, random_point, residue
from screwkit.algebra.quotients import quotient_of
from screwkit.algebra.remembered import RememberedColumns
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.certificates.short_minors import ShortMinor, short_minors
from screwkit.conventions import SCREW_DIMENSION
from screwkit.kinematics.whole_graph import Row
from screwkit.loci.shorter_vectors import shorter_vectors
from screwkit.loci.sparse_rank import reduced
from screwkit.loci.wrench_vectors import (
    Vector,
    shortened_vector,
    size_of,
    spanning_wrenches,
)

FILLED = 300_000
"""Products of terms that one more column of a minor may take."""

MANY = 60
"""Choices of rows, each of which gives a wrench."""

ORDERS = 4
"""Of rows, where there are more choices than that."""

HELPERS = 6
"""Reactions of loops alone that may be added to others, the shortest ones."""

MORE = 5
"""Wrenches that are kept besides those that span."""

TRIED = 1_000
"""Choices of columns that are left out."""

SETS = 4
"""Of columns, from each of which wrenches are taken."""

Columns = Sequence[Sequence[Polynomial]]

_KNOWN: RememberedColumns[FactorLibrary, list[Vector]] = RememberedColumns()
"""Of the same twists on branches that differ elsewhere."""


def wrenches_with_reactions(
    branch: Branch, columns: Columns, at: tuple[Point, int], library: FactorLibrary
) -> list[Vector]:
    """What annihilates all columns, reactions alone left out.

    Args:
        branch: Where the columns are taken.
        columns: Of [P; C], the same number of rows each.
        at: A point at which the wrenches span all that there are.
        library: Of the branch's ring.

    Raises:
        TooLargeError: If they are too long, or too many.
    """
    entries = [x for own in columns for x in own]
    symbols = _symbols(*entries)
    said = (str(p.value) for p in branch.pending if _symbols(p.value) <= symbols)
    given = len(columns), rank(_at(columns, at), at[1]), tuple(said)
    found = _KNOWN.answer(
        library, entries, given, lambda: _wrenches(branch, columns, at, library)
    )
    if _span(found, columns, at):
        return found
    return _wrenches(branch, columns, at, library)


def _at(vectors: Columns, at: tuple[Point, int]) -> list[list[int]]:
    return [[residue(x, *at) for x in own] for own in vectors]


def _symbols(*values: Polynomial) -> set[int]:
    """The places of the symbols that polynomials are in."""
    return {k for own in values for k, d in enumerate(own.degrees()) if d > 0}


def _span(vectors: Sequence[Vector], columns: Columns, at: tuple[Point, int]) -> bool:
    """Whether vectors span the wrenches that there are at a point."""
    whole, prime = _at(columns, at), at[1]
    loops = [own[SCREW_DIMENSION:] for own in whole]
    needed = SCREW_DIMENSION - rank(whole, prime) + rank(loops, prime)
    bare = [own[:SCREW_DIMENSION] for own in vectors]
    return rank(_at(bare, at), prime) == needed


def _wrenches(
    branch: Branch, columns: Columns, at: tuple[Point, int], library: FactorLibrary
) -> list[Vector]:
    """What `wrenches_with_reactions` looks up."""
    wrenches: dict[tuple[str, ...], Vector] = {}
    reactions: dict[tuple[str, ...], Vector] = {}
    for kept in _telling_columns(branch, columns, at):
        for own in _annihilators(branch, [columns[k] for k in kept], at, library):
            key = tuple(map(str, own[:SCREW_DIMENSION]))
            if branch.vanishes(own[:SCREW_DIMENSION]):
                reactions.setdefault(tuple(map(str, own)), own)
            else:
                wrenches.setdefault(key, own)
    known = sorted(wrenches.values(), key=lambda own: size_of(own[:SCREW_DIMENSION]))
    helpers = sorted(reactions.values(), key=size_of)[:HELPERS]
    found = shorter_vectors(branch.ring, _spanning(known, at), helpers)
    left = [own for own in found if not branch.vanishes(own[:SCREW_DIMENSION])]
    return [*left, *_still(branch, left, library)]


def _still(
    branch: Branch, vectors: Sequence[Vector], library: FactorLibrary
) -> list[Vector]:
    """Sums of two of them in which a coordinate vanishes, on a line that stands still.

    Of a couple n along the axis of a parallelogram and of one across it one sum is |n|²
    times a couple whose direction is the same everywhere: it vanishes at no real
    posture, where each coordinate of the two may.
    """
    ring, first = branch.ring, slice(SCREW_DIMENSION)
    prime, source = branch_primes()[0], random.Random(len(vectors))
    points = [random_point(ring, source, prime) for _ in range(2)]
    there = [_at([own[first] for own in vectors], (p, prime)) for p in points if p]
    if len(there) < 2:
        return []
    pairs = [*zip(*there, strict=True)]
    known = [one for one, two in pairs if rank([one, two], prime) == 1]
    found = []
    for (one, a), (two, b) in combinations(zip(vectors, pairs, strict=True), 2):
        for place in range(SCREW_DIMENSION):
            if one[place] == 0 or two[place] == 0:
                continue
            lines = [
                [
                    (v[place] * x - u[place] * y) % prime
                    for x, y in zip(u, v, strict=True)
                ]
                for u, v in zip(a, b, strict=True)
            ]
            # The same at two random postures, and none that is there already.
            if not all(map(any, lines)) or rank(lines, prime) > 1:
                continue
            if any(rank([lines[0], own], prime) == 1 for own in known):
                continue
            known.append(lines[0])
            times = two[place], one[place]
            terms = zip(one, two, strict=True)
            whole = [ring.normal(times[0] * x - times[1] * y) for x, y in terms]
            found.append(shortened_vector(branch, whole, library))
    return found


def line_of(
    ring: TrigonometricRing, vector: Vector, library: FactorLibrary
) -> tuple[Vector, Polynomial]:
    """A wrench without reactions and common factors, and what it is multiplied by.

    Args:
        ring: Of the coordinates.
        vector: Six coordinates, not all zero, and reactions.
        library: Of the ring; factors met before.
    """
    whole = vector[:SCREW_DIMENSION]
    found = without_common_factors(ring, whole, library)
    value, below = next((a, b) for a, b in zip(whole, found, strict=True) if b != 0)
    weight = quotient_of(ring, value, below)
    return (whole, ring.one) if weight is None else (found, weight)


def stands_still(ring: TrigonometricRing, line: Vector) -> bool:
    """Whether the coordinates of a line are numbers.

    Args:
        ring: Of the coordinates.
        line: Six of them, without common factors.
    """
    numbers = {k for k, own in ring.algebraic_relations if isinstance(own, tuple)}
    return _symbols(*line) <= numbers


def _spanning(vectors: Sequence[Vector], at: tuple[Point, int]) -> list[Vector]:
    """The first ones that span what all of them do at a point, and a few more."""
    needed = independent(_at([own[:SCREW_DIMENSION] for own in vectors], at), at[1])
    return [*vectors[: max(needed, default=-1) + 1 + MORE]]


def _telling_columns(
    branch: Branch, columns: Columns, at: tuple[Point, int]
) -> list[tuple[int, ...]]:
    """Columns on which the others depend where the unsolved conditions hold.

    What annihilates them is written without these conditions: as a rod's force for
    which an arm is outstretched, not times the sine of an angle.
    """
    wider = next(iter(replace(branch, pending=()).points), at)
    here, there = _at(columns, at), _at(columns, wider)
    every = range(len(columns))
    wanted = rank(here, at[1])
    over = rank(there, wider[1]) - wanted
    found = []
    for gone in islice(combinations(every, over), TRIED):
        kept = tuple(k for k in every if k not in gone)
        if (
            rank([there[k] for k in kept], wider[1]) == wanted
            and rank([here[k] for k in kept], at[1]) == wanted
        ):
            found.append(kept)
            if len(found) == SETS:
                break
    return found


def _annihilators(
    branch: Branch, columns: Columns, at: tuple[Point, int], library: FactorLibrary
) -> list[Vector]:
    """What annihilates some columns."""
    ring, width = branch.ring, len(columns)
    rows = _rows(columns)
    for number, row in enumerate(rows):
        row[width + number] = ring.one  # keeps what was done with the row
    left = reduced(branch, rows, width).rows
    small = [{c: x for c, x in row.items() if c < width} for row in left]
    kept = [{c - width: x for c, x in row.items() if c >= width} for row in left]
    found = [own for row, own in zip(small, kept, strict=True) if not row]
    # Those of the loops alone first: with them reactions are known from the others.
    held = [k for k, row in enumerate(small) if row]
    held.sort(key=lambda k: (min(kept[k]) < SCREW_DIMENSION, len(kept[k])))
    for vector in _annihilating(branch, [small[k] for k in held], at, library):
        whole: Row = {}
        for factor, k in zip(vector, held, strict=True):
            for place, value in kept[k].items() if factor != 0 else ():
                whole[place] = whole.get(place, ring.zero) + factor * value
        found.append({place: ring.normal(value) for place, value in whole.items()})
    vectors = (
        tuple(own.get(place, ring.zero) for place in range(len(rows))) for own in found
    )
    return [
        shortened_vector(branch, vector, library)
        for vector in vectors
        if not branch.vanishes(vector)
    ]


def _annihilating(
    branch: Branch, rows: Sequence[Row], at: tuple[Point, int], library: FactorLibrary
) -> list[Vector]:
    """What annihilates the columns of some rows, by Cramer's rule."""
    if not rows:
        return []
    ring = branch.ring
    weight: dict[int, int] = {}
    for row in rows:
        for column, entry in row.items():
            weight[column] = weight.get(column, 0) + len(entry)
    order = sorted(weight, key=lambda column: weight[column])
    across = [[row.get(column, ring.zero) for row in rows] for column in order]
    chosen = [across[k] for k in independent(_at(across, at), at[1])]
    if comb(len(rows), len(chosen) + 1) <= MANY:
        extensor = minors_of(ring, chosen, FILLED)
        return spanning_wrenches(branch, extensor, len(rows), len(chosen), library)
    return [
        vector
        for places in _dependent(len(rows), _at(chosen, at), at[1])
        for vector in _of_places(branch, chosen, places, library)
    ]


def _dependent(
    height: int, columns: Sequence[Sequence[int]], prime: int
) -> list[tuple[int, ...]]:
    """Rows of which one depends on the others, which are independent.

    As many as rows depend on earlier ones, in some orders of the rows.
    """
    found: dict[tuple[int, ...], None] = {}
    source = random.Random(height)
    for number in range(ORDERS):
        order = [*range(height)]
        if number:
            source.shuffle(order)
        lines = [[column[k] for column in columns] for k in order]
        basis = [order[i] for i in independent(lines, prime)]
        for k in order:
            if k not in basis:
                found.setdefault(tuple(sorted((*basis, k))))
    return [*found]


def _of_places(
    branch: Branch,
    columns: Columns,
    places: Sequence[int],
    library: FactorLibrary,
) -> list[Vector]:
    """What annihilates columns in some rows alone."""
    bare = [[column[k] for k in places] for column in columns]
    extensor = minors_of(branch.ring, bare, FILLED)
    found = spanning_wrenches(branch, extensor, len(places), len(columns), library)
    height, zero = len(columns[0]), branch.ring.zero
    return [
        tuple(vector[places.index(k)] if k in places else zero for k in range(height))
        for vector in found
    ]


def minors_of_limb(
    branch: Branch,
    columns: Columns,
    at: tuple[Point, int],
    source: random.Random,
) -> list[ShortMinor]:
    """Minors of [P; C] that do not vanish at a point, of the rank there."""
    return [*short_minors(branch, _rows(columns), *at, source)]


def _rows(columns: Columns) -> list[Row]:
    height = len(columns[0]) if columns else 0
    return [
        {k: own[place] for k, own in enumerate(columns) if own[place] != 0}
        for place in range(height)
    ]


def led_columns(
    rows: Mapping[int, Row], width: int, height: int, zero: Polynomial
) -> tuple[tuple[Polynomial, ...], ...]:
    """The columns of rows that are given by their numbers; the others are empty."""
    none: Row = {}
    return tuple(
        tuple(rows.get(place, none).get(k, zero) for place in range(height))
        for k in range(width)
    )
