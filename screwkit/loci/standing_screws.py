"""Coordinates of wrenches by screws that limbs allow at every posture.

An arm whose first axes meet in a point lets its platform turn about that point whatever
its posture, so its wrenches do no work on these rotations.  A screw that two limbs
allow at every posture is reciprocal to the wrenches of both.  Wrenches are told apart
by the work they do on any six independent screws; by such ones most of it is zero, and
minors of a few wrenches become products of short factors.  Of three forces through
three fixed points each works on one line only of the three through two of these points:
a minor is the product of these works.

References: [Hunt1978] §12; [CoxLittleOShea] §9.1.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point
from screwkit.algebra.trigonometric import Polynomial
from screwkit.conventions import SCREW_DIMENSION
from screwkit.loci.wrench_vectors import Vector, overlap_minors, shortened_vector
from screwkit.screw.nullspace import annihilator, independent, residues, sample

_LIMBS = 4  # of which all subsets are asked

_LONG = 60  # terms of a screw's coordinates together, beyond which it is left out


def standing_screws(
    branch: Branch, limbs: Sequence[Sequence[Vector]]
) -> list[Vector] | None:
    """Six independent screws, constant, that limbs allow wherever the branch goes.

    Independent for generic dimensions.  Those that most limbs allow come first; unit
    screws fill up.

    Args:
        branch: Where the wrenches are taken.
        limbs: Wrenches of each limb as linear forms of twists, some for each limb.

    Returns:
        None where no limb allows any but the units.
    """
    ring = branch.ring
    moved = [_independent_coefficients(branch, wrenches) for wrenches in limbs]
    chosen: list[Vector] = []
    units = [
        tuple(ring.one if i == k else ring.zero for i in range(SCREW_DIMENSION))
        for k in range(SCREW_DIMENSION)
    ]
    sets = [
        together
        for count in range(len(limbs), 0, -1)
        for together in combinations(moved, count)
    ]
    for together in sets:
        columns = [column for limb in together for column in limb]
        own = [columns[i] for i in independent(ring, columns)]
        if len(own) == SCREW_DIMENSION:
            continue
        allowed = annihilator(ring, own).columns
        # A unit among them is as good, and shorter.
        first = [unit for unit in units if _annihilates(branch, unit, own)]
        _add(branch, chosen, [*first, *allowed])
    found = len(chosen)
    _add(branch, chosen, units)
    if all(screw in units for screw in chosen[:found]):
        return None
    return chosen


def _add(branch: Branch, chosen: list[Vector], screws: Sequence[Vector]) -> None:
    """Those of the screws that are independent of what was chosen before."""
    _, prime = sample(branch.ring)
    rows = [residues(branch.ring, screw) for screw in chosen]
    for screw in screws:
        if sum(map(len, screw)) > _LONG:
            continue
        row = residues(branch.ring, screw)
        if rank([*rows, row], prime) > len(rows):
            chosen.append(screw)
            rows.append(row)


def _annihilates(branch: Branch, form: Vector, columns: Sequence[Vector]) -> bool:
    return all(_work(branch, form, column) == 0 for column in columns)


def _work(branch: Branch, screw: Vector, wrench: Sequence[Polynomial]) -> Polynomial:
    ring = branch.ring
    pairs = zip(screw, wrench, strict=True)
    return ring.normal(sum((a * b for a, b in pairs), ring.zero))


def _independent_coefficients(
    branch: Branch, wrenches: Sequence[Vector]
) -> list[Vector]:
    """Constant wrenches that span those of a limb at all postures of the branch."""
    ring = branch.ring
    constants = {*branch.dimensions, *map(ring.names.index, ring.constant_generators)}
    found: list[Vector] = []
    for wrench in wrenches:
        parts: dict[tuple[int, ...], list[dict[tuple[int, ...], object]]] = {}
        for row, entry in enumerate(wrench):
            for exponents, coefficient in entry.to_dict().items():
                whole = tuple(map(int, exponents))
                moving = tuple(0 if i in constants else e for i, e in enumerate(whole))
                fixed = tuple(e if i in constants else 0 for i, e in enumerate(whole))
                rows = parts.setdefault(moving, [{} for _ in wrench])
                rows[row][fixed] = coefficient
        found += [tuple(map(ring.context.from_dict, rows)) for rows in parts.values()]
    return [found[i] for i in independent(ring, found)]


def standing_minors(
    branch: Branch,
    limbs: Sequence[Sequence[Vector]],
    at: tuple[Point, int],
    limits: tuple[int, int],
    library: FactorLibrary,
) -> list[Polynomial]:
    """Zero together where wrenches of limbs without overlap become dependent.

    Args:
        branch: Where the wrenches are taken.
        limbs: Of each limb that has any, wrenches that span its system.
        at: An exact point of the branch and its prime.
        limits: See `overlap_minors`.
        library: Factors met before.

    Returns:
        Nothing where no screws stand, or minors are too long.
    """
    if not 2 <= len(limbs) <= _LIMBS or len(limbs[0][0]) != SCREW_DIMENSION:
        return []
    screws = standing_screws(branch, limbs)
    if screws is None:
        return []
    vectors = [
        shortened_vector(branch, [_work(branch, s, w) for s in screws], library)
        for wrenches in limbs
        for w in wrenches
    ]
    return overlap_minors(branch, vectors, at, *limits)
