"""Where wrenches of limbs span less than they do in general: minors chosen by points.

The loop constraint matrix loses rank where the wrench systems W_1 … W_k of the limbs,
each of constant dimension, span less than their generic sum.  If they overlap in
general, most minors of that matrix say the same; a few are enough to find candidates,
and a candidate on which the rank stays, at an exact point, shows which minor does not
vanish there.  So the locus is cut out by as few minors as it needs, and what is kept
has lost rank at exact points.

A minor is the join of the duals of the limbs' twists, filled up by unit twists until
the wrenches that are left are as many as the rank (Grassmann–Cayley meet).

References: [CoxLittleOShea] §9.1, [LongCaroKhalil2012] §5.2.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping, Sequence
from functools import reduce
from itertools import islice, product
from math import prod
from typing import TypeAlias

from screwkit.algebra.branches import Branch
from screwkit.algebra.cases import MOST_TERMS
from screwkit.algebra.minors import combined, held, joined
from screwkit.algebra.modular import annihilator, independent, rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.ring import Ring
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.errors import TooLargeError
from screwkit.kinematics.assembly import loop_rows
from screwkit.kinematics.limb_parts import (
    Parts,
    PartsMotion,
    SideBySide,
    columns_of,
    has_loops,
    motion_at,
)
from screwkit.loci.limb_systems import UnclearError, limb_system
from screwkit.loci.predicted_size import predicted_terms
from screwkit.loci.rank_drop import extensors
from screwkit.loci.reciprocal_meets import how_long, reciprocal_meets
from screwkit.loci.standing_screws import standing_minors
from screwkit.loci.wrench_vectors import Vector, overlap_minors, spanning_wrenches

Extensor: TypeAlias = Mapping[int, Polynomial]
Units: TypeAlias = tuple[tuple[int, ...], ...]  # by limb: coordinates that are filled

TRIED = 24
"""Orders of rows from which the cheapest minor is chosen."""

COSTLIEST = 10**13
"""Products of terms in the expansion of one minor."""

LARGE = 10**9
"""Products beyond which terms are predicted; no more are expanded than may be."""

PRODUCTS = 30_000_000
"""Of terms, in one join of two extensors."""

CHEAP = 200
"""Products of terms in a minor of wrenches, which tells more than a join does."""

TOGETHER, MOST = 6, 24
"""Fillings of each chart, and minors in all, that are asked at once."""

LONGEST = 4_000
"""Terms of all minors that are asked at once; the first is taken however long."""


def filling_units(
    limbs: Sequence[Sequence[Sequence[int]]], height: int, prime: int, seed: int = 0
) -> Iterator[Units]:
    """Unit twists by limb that fill up the loop equations at an exact point.

    The minor that belongs to them is not zero at the point.

    Args:
        limbs: Twists of each limb at the point, independent within a limb.
        height: Coordinates of a twist.
        prime: Modulus of the point.
        seed: Of the order in which rows are preferred.
    """
    source = random.Random(seed)
    count = len(limbs)
    seen: set[Units] = set()
    for number in range(TRIED):
        first = number % count
        order = [first, *(i for i in range(count) if i != first)]
        rows = loop_rows([limbs[i] for i in order])
        width = height * (count - 1)
        places = list(range(width))
        if number >= count:
            source.shuffle(places)
        across = [[row[p] for row in rows] for p in places]
        pivots = {places[k] for k in independent(across, prime)}
        units: list[tuple[int, ...]] = [()] * count
        for block, limb in enumerate(order[1:]):
            units[limb] = tuple(
                row for row in range(height) if block * height + row not in pivots
            )
        found = tuple(units)
        if found not in seen:
            seen.add(found)
            yield found


def sum_minors(
    ring: Ring[Polynomial], limbs: Sequence[Extensor], units: Units, height: int
) -> list[Polynomial]:
    """The minors of the loop constraint matrix that belong to some unit twists.

    Raises:
        TooLargeError: If a join would take too many products of terms.
    """
    filled = [
        reduce(
            lambda all_, unit: joined(ring, all_, {1 << unit: ring.one}), own, extensor
        )
        for extensor, own in zip(limbs, units, strict=True)
    ]
    return list(combined(ring, filled, height, PRODUCTS).values())


def cost(limbs: Sequence[Extensor], units: Units) -> int:
    """Products of terms that expanding these minors takes, at most."""
    sizes = []
    for extensor, own in zip(limbs, units, strict=True):
        filled = sum(1 << unit for unit in own)
        sizes.append(
            sum(len(value) for rows, value in extensor.items() if not rows & filled)
        )
    return prod(sizes)


def height_of(limbs: Sequence[Parts]) -> int:
    """Coordinates of the twists of these limbs."""
    return max((len(c) for limb in limbs for c in columns_of(limb)), default=0)


def _motions(
    limbs: Sequence[Parts], height: int, point: Point, prime: int
) -> list[PartsMotion]:
    return [motion_at(limb, height, point, prime) for limb in limbs]


def loop_rank_at(limbs: Sequence[Parts], height: int, point: Point, prime: int) -> int:
    """Rank of the equations that the limbs' twists must agree."""
    motions = _motions(limbs, height, point, prime)
    return rank(loop_rows([motion.twists for motion in motions]), prime)


def telling_minors(
    branch: Branch,
    limbs: Sequence[Parts],
    search: Search,
    *,
    within: bool,
) -> list[Polynomial] | None:
    """Minors of the rank on a branch, one of them not zero at a point of it.

    None where there is no point.

    Raises:
        TooLargeError: If all minors are too long; none of them was expanded then.
    """
    if not branch.points:
        return None
    height = height_of(limbs)
    point, prime = max(
        branch.points,
        key=lambda at: sum(m.dimension for m in _motions(limbs, height, *at)),
    )
    motions = _motions(limbs, height, point, prime)
    charts: list[list[Extensor]] = []
    for limb, motion in zip(limbs, motions, strict=True):
        own = _charts(branch, limb, motion, search, reduced=within)
        own.sort(key=lambda chart: not _is_there(chart, point, prime))
        if not own or not _is_there(own[0], point, prime):
            return None
        charts.append(own)
    at_point = [motion.twists for motion in motions]
    units = list(filling_units(at_point, height, prime))
    first = [own[0] for own in charts]
    units.sort(key=lambda one: (cost(first, one), one))
    if within and _overlap(at_point, height, prime):
        vectors = [
            vector
            for own, twists in zip(charts, at_point, strict=True)
            for vector in spanning_wrenches(
                branch, own[0], height, len(twists), search.library
            )
        ]
        dearest = max(CHEAP, min(cost(first, one) for one in units))
        minors = overlap_minors(branch, vectors, (point, prime), dearest, LONGEST)
        if minors:
            return minors
    elif within and not any(map(has_loops, limbs)):
        meets = reciprocal_meets(branch, _twists(branch, limbs), first, height)
        systems = [
            spanning_wrenches(branch, chart, height, len(twists), search.library)
            for chart, twists in zip(first, at_point, strict=True)
            if len(twists) < height
        ]
        limits = (PRODUCTS, LONGEST)
        standing = standing_minors(
            branch, systems, (point, prime), limits, search.library
        )
        told = [
            minors
            for minors in (meets, standing)
            if any(residue(value, point, prime) for value in minors)
        ]
        if told:
            never = (m for own in told for m in own if _is_nonzero(branch, m))
            sure = next(never, None)
            return min(told, key=how_long) if sure is None else [sure]
    polynomials: list[Polynomial] = []
    refused: list[TooLargeError] = []
    for chosen, one in islice(product(product(*charts), units[:TOGETHER]), MOST):
        try:
            polynomials += _expanded(branch, chosen, one, height)
        except TooLargeError as error:
            refused.append(error)
            continue
        if sum(map(len, polynomials)) > LONGEST:
            break
    if refused and not polynomials:
        raise refused[0]
    return polynomials or None


def _expanded(
    branch: Branch, chosen: Sequence[Extensor], units: Units, height: int
) -> list[Polynomial]:
    """`sum_minors`, refused before they are expanded if they have too many terms."""
    products = cost(chosen, units)

    def expand(limbs: Sequence[Extensor]) -> list[Polynomial]:
        return sum_minors(branch.ring, limbs, units, height)

    try:
        terms = predicted_terms(branch.ring, chosen, expand) if products > LARGE else 0
        if not terms or terms <= MOST_TERMS:
            held(products, COSTLIEST)
            return expand(chosen)
    except TooLargeError as error:
        raise TooLargeError(
            f"a determinant takes {error}, and was not expanded"
        ) from error
    raise TooLargeError(
        f"a determinant has about {terms / 1e6:,.0f} million terms, and was not "
        f"expanded"
    )


def _twists(branch: Branch, limbs: Sequence[Parts]) -> list[list[Vector]]:
    """Of each limb on a branch, loops inside left out."""
    return [
        [tuple(branch.column(p)) for p in limb if not isinstance(p, SideBySide)]
        for limb in limbs
    ]


def wrenches_overlap(
    limbs: Sequence[Parts], height: int, point: Point, prime: int
) -> bool:
    """Whether the wrench systems of limbs share wrenches, at a point."""
    motions = _motions(limbs, height, point, prime)
    return _overlap([motion.twists for motion in motions], height, prime)


def _overlap(limbs: Sequence[Sequence[Sequence[int]]], height: int, prime: int) -> bool:
    """Whether the wrench systems of limbs share wrenches, at a point."""
    systems = [
        annihilator(limb, height, prime) if limb else _units(height) for limb in limbs
    ]
    together = [wrench for system in systems for wrench in system]
    return rank(together, prime) < len(together)


def _units(height: int) -> list[list[int]]:
    return [[int(i == k) for i in range(height)] for k in range(height)]


def _charts(
    branch: Branch,
    limb: Parts,
    motion: PartsMotion,
    search: Search,
    *,
    reduced: bool,
) -> list[Extensor]:
    """Extensors of a limb's twists that hold in general on a branch."""
    if not limb:
        return [{0: branch.ring.one}]
    columns = [part for part in limb if not isinstance(part, SideBySide)]
    if len(columns) == len(limb):
        library = search.library if reduced else None
        return list(extensors(branch, columns, motion.dimension, library))
    try:
        return [limb_system(branch, limb, motion.height, search.library).extensor]
    except UnclearError:
        return []


def _is_nonzero(branch: Branch, minor: Polynomial) -> bool:
    return branch.assumptions.is_nonzero(branch.ring, minor)


def _is_there(chart: Extensor, point: Point, prime: int) -> bool:
    """Whether a chart is not zero at a point."""
    return any(residue(value, point, prime) for value in chart.values())
