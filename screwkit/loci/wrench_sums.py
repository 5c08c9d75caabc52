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
from dataclasses import dataclass, replace
from functools import reduce
from itertools import islice, product
from math import prod
from typing import TypeAlias

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.minors import combined, joined
from screwkit.algebra.modular import annihilator, echelon, independent
from screwkit.algebra.modular import rank as residue_rank
from screwkit.algebra.points import Point, rank_at, residue
from screwkit.algebra.ring import Ring
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.assembly import loop_rows
from screwkit.loci.rank_drop import Column, extensors
from screwkit.loci.wrench_vectors import overlap_minors, spanning_wrenches

Extensor: TypeAlias = Mapping[int, Polynomial]
Units: TypeAlias = tuple[tuple[int, ...], ...]  # by limb: coordinates that are filled

TRIED = 24
"""Orders of rows from which the cheapest minor is chosen."""

COSTLIEST = 10**13
"""Products of terms in the expansion of one minor."""

CHEAP = 200
"""Products of terms in a minor of wrenches, which tells more than a join does."""

TOGETHER, MOST = 6, 24
"""Fillings of each chart, and minors in all, that are asked at once."""

LONGEST = 4_000
"""Terms of all minors that are asked at once; the first is taken however long."""


@dataclass(frozen=True)
class Dependence:
    """Where limbs become dependent.

    Attributes:
        branches: On each the loop constraint matrix has lost rank, at exact points.
        open: Branches that were not decided; every further zero lies on one of them.
    """

    branches: tuple[Branch, ...]
    open: tuple[Branch, ...]


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
    """The minors of the loop constraint matrix that belong to some unit twists."""
    filled = [
        reduce(
            lambda all_, unit: joined(ring, all_, {1 << unit: ring.one}), own, extensor
        )
        for extensor, own in zip(limbs, units, strict=True)
    ]
    return list(combined(ring, filled, height).values())


def cost(limbs: Sequence[Extensor], units: Units) -> int:
    """Products of terms that expanding these minors takes, at most."""
    sizes = []
    for extensor, own in zip(limbs, units, strict=True):
        filled = sum(1 << unit for unit in own)
        sizes.append(
            sum(len(value) for rows, value in extensor.items() if not rows & filled)
        )
    return prod(sizes)


def dependent_zeros(
    branch: Branch,
    limbs: Sequence[Sequence[Column]],
    search: Search,
    *,
    within: bool = False,
) -> Dependence:
    """Where on a branch the loop constraint matrix has less than its rank there.

    Args:
        branch: Irreducible.
        limbs: Twists of each limb, in coordinates that tell them apart.
        search: Budget, known factors, and what to leave out.
        within: Look only where the limbs keep their ranks; their common factors are
            left out.
    """
    points = branch.points
    if len(limbs) < 2 or not any(limbs):
        return Dependence((), ())
    if not points:
        return Dependence((), (branch,))
    rows = loop_rows(limbs)
    rank = max(rank_at(rows, *point) for point in points)
    found: list[Branch] = []
    left: list[Branch] = []
    waiting = [branch]
    while waiting:
        here = waiting.pop()
        polynomials = _telling(here, limbs, search, within=within)
        if polynomials is None or search.budget <= 0:
            left.append(here)
            continue
        own = replace(search, found=[], unfinished=[], special=[])
        zeros = common_zeros(here, polynomials, own)
        search.budget = own.budget - 1
        left.extend(zeros.open)
        for part in zeros.branches:
            places = part.points
            if not places:
                left.append(part)
            elif max(rank_at(rows, *point) for point in places) < rank:
                found.append(part)
            else:
                waiting.append(part)
    return Dependence(tuple(found), tuple(left))


def _telling(
    branch: Branch,
    limbs: Sequence[Sequence[Column]],
    search: Search,
    *,
    within: bool,
) -> list[Polynomial] | None:
    """Minors of the rank on a branch, one of them not zero at a point of it.

    None where there is no point, or all minors are too long.
    """
    if not branch.points:
        return None
    point, prime = max(
        branch.points, key=lambda at: sum(rank_at(limb, *at) for limb in limbs)
    )
    at_point: list[list[list[int]]] = []
    charts: list[list[Extensor]] = []
    for limb in limbs:
        if not limb:
            at_point.append([])
            charts.append([{0: branch.ring.one}])
            continue
        rank = rank_at(limb, point, prime)
        residues = [[residue(x, point, prime) for x in column] for column in limb]
        own = extensors(branch, limb, rank, search.library if within else None)
        own.sort(key=lambda chart: not _is_there(chart, point, prime))
        if not own or not _is_there(own[0], point, prime):
            return None
        at_point.append(echelon(residues, prime))
        charts.append(list(own))
    columns = [column for limb in limbs for column in limb]
    height = len(columns[0])
    units = list(filling_units(at_point, height, prime))
    first = [own[0] for own in charts]
    units.sort(key=lambda one: (cost(first, one), one))
    if within and _overlap(at_point, height, prime):
        vectors = [
            vector
            for own, twists in zip(charts, at_point, strict=True)
            for vector in spanning_wrenches(branch, own[0], height, len(twists))
        ]
        dearest = max(CHEAP, min(cost(first, one) for one in units))
        minors = overlap_minors(branch, vectors, (point, prime), dearest, LONGEST)
        if minors:
            return minors
    polynomials: list[Polynomial] = []
    for chosen, one in islice(product(product(*charts), units[:TOGETHER]), MOST):
        if cost(chosen, one) > COSTLIEST:
            continue
        polynomials += sum_minors(branch.ring, chosen, one, height)
        if sum(map(len, polynomials)) > LONGEST:
            break
    return polynomials or None


def _overlap(limbs: Sequence[Sequence[Sequence[int]]], height: int, prime: int) -> bool:
    """Whether the wrench systems of limbs share wrenches, at a point."""
    systems = [
        annihilator(limb, height, prime) if limb else _units(height) for limb in limbs
    ]
    together = [wrench for system in systems for wrench in system]
    return residue_rank(together, prime) < len(together)


def _units(height: int) -> list[list[int]]:
    return [[int(i == k) for i in range(height)] for k in range(height)]


def _is_there(chart: Extensor, point: Point, prime: int) -> bool:
    """Whether a chart is not zero at a point."""
    return any(residue(value, point, prime) for value in chart.values())
