"""The motion type of the platform, and where it changes without a singularity.

n of nTmR is 3 less the rank of the constraint forces' directions; it changes exactly
where that rank drops while the constraint wrenches stay independent.  Two constraint
forces are skew, meet or are parallel, and each is told apart.

References: [LongCaroKhalil2012] §4.4.2, with the generic case of skew forces added.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.minors import minors_of
from screwkit.algebra.points import residue
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.subspaces import PlatformSystem
from screwkit.loci.loop_drop import loop_state
from screwkit.loci.pieces import Piece, lies_in, pieces_of
from screwkit.loci.rank_drop import rank_drop
from screwkit.loci.wording import conditions_of, equations_of
from screwkit.loci.wrenches import null_wrench
from screwkit.results.mobility import MotionCase

_BUDGET = 60


def motion_cases(assembly: Assembly, generic: str) -> tuple[MotionCase, ...]:
    """The generic motion type, then where it is another, or for another reason."""
    if any(limb.elements is not None for limb in assembly.limbs):
        return (MotionCase((), (), generic, ""),)
    forces = _constraint_forces(assembly)
    if forces is None:
        return (MotionCase((), (), generic, ""),)
    root, wrenches, library, limbs = forces
    pure = [w for w in wrenches if _pitch(root, w) == 0]
    two = len(wrenches) == 2 and len(pure) == 2
    singular = [
        piece
        for limb in limbs
        for piece in pieces_of(
            rank_drop(root, limb, Search(library)).decomposition.branches
        )
    ]

    def search() -> Search:
        return Search(
            library,
            budget=_BUDGET,
            skip=lambda branch: any(lies_in(branch, piece) for piece in singular),
        )

    cases = []
    if two:
        meeting = common_zeros(root, [_product(root, *wrenches)], search())
        met = _changed(meeting.branches, limbs, generic)
        cases += [
            _case(piece, kind, "they meet: rotations about their common point")
            for piece, kind in met
            if kind == generic
        ]
    drops = _direction_drops(root, wrenches)
    fewer = common_zeros(root, drops, search()) if drops else None
    if fewer is not None:
        for piece, kind in _changed(fewer.branches, limbs, generic):
            reason = (
                "they are parallel" if two else "directions of forces become dependent"
            )
            cases.append(_case(piece, kind, reason))
    first = "the two constraint forces are skew" if two and cases else ""
    return (MotionCase((), (), generic, first), *cases)


def _constraint_forces(
    assembly: Assembly,
) -> (
    tuple[
        Branch,
        list[list[Polynomial]],
        FactorLibrary,
        list[list[tuple[Polynomial, ...]]],
    ]
    | None
):
    """One wrench of every limb that has just one; None where a limb has more."""
    framed = assembly.common_twists
    root = assembly.root(framed.ring)
    library = assembly.library(framed.ring)
    limbs, wrenches = [], []
    for limb in assembly.limbs:
        columns = [framed.column(joint) for joint in limb.joints]
        rank = assembly.generic_rank(limb.joints)
        limbs.append(columns)
        if rank == 6:
            continue
        if rank != 5 or len(columns) != 5:
            return None
        wrenches.append(null_wrench(framed.ring, columns))
    if not wrenches or not limbs:
        return None
    return root, wrenches, library, limbs


def _pitch(root: Branch, wrench: Sequence[Polynomial]) -> Polynomial:
    terms = zip(wrench[DIRECTION], wrench[MOMENT], strict=True)
    return root.ring.normal(sum((f * m for f, m in terms), root.ring.zero))


def _product(
    root: Branch, left: Sequence[Polynomial], right: Sequence[Polynomial]
) -> Polynomial:
    pairs = [
        *zip(left[DIRECTION], right[MOMENT], strict=True),
        *zip(left[MOMENT], right[DIRECTION], strict=True),
    ]
    return root.ring.normal(sum((a * b for a, b in pairs), root.ring.zero))


def _direction_drops(
    root: Branch, wrenches: Sequence[Sequence[Polynomial]]
) -> list[Polynomial]:
    """Maximal minors of the directions; empty where they are dependent everywhere."""
    directions = [wrench[DIRECTION] for wrench in wrenches]
    size = min(3, len(directions))
    found: list[Polynomial] = []
    for chosen in combinations(directions, size):
        found.extend(minors_of(root.ring, chosen).values())
    return found


def _changed(
    branches: Sequence[Branch],
    limbs: Sequence[Sequence[tuple[Polynomial, ...]]],
    generic: str,
) -> list[tuple[Piece, str]]:
    """The pieces with regular limbs and independent wrenches, and their types."""
    pieces = []
    for piece in pieces_of(branches):
        kinds = set()
        for branch in piece.branches:
            state = loop_state(branch, limbs)
            if state is None:
                continue
            point, prime = branch.points[0]
            rows = [
                [[residue(x, point, prime) for x in column] for column in limb]
                for limb in limbs
            ]
            kinds.add(PlatformSystem.held_by(rows, prime).motion_type)
        if len(kinds) == 1:
            pieces.append((piece, kinds.pop()))
    return pieces


def _case(piece: Piece, kind: str, reason: str) -> MotionCase:
    return MotionCase(equations_of(piece), conditions_of(piece), kind, reason)
