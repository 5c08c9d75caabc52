"""Steps along a branch of closed postures, each of which stays on that branch.

Where branches meet or nearly meet, a step can close on another assembly with much the
same tangent.  Around a regular curve the determinant of the equations bordered by the
tangent keeps its sign, and behind a branch point it does not: a step that changes it
has left the branch, or has passed where branches truly meet.

References: [AllgowerGeorg2003] ch. 8 on branch points and the sign of the determinant.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import Stance, loop_jacobian
from screwkit.finite.loop_split import Split
from screwkit.finite.projection import projected
from screwkit.finite.spanning_forest import Forest

Verdict: TypeAlias = Literal["good", "open", "far", "rank", "turned", "crossed"]
"""Of a step: on the branch; not closed; not where it was to go; at a posture of another
rank; with a tangent that has turned too far; on the other side of a branch point."""

LEAP, LONGEST = 0.5, 0.3
"""By which part of a step closing may change it, and the largest change of a
coordinate in a step."""

CUT = 1e-7
"""Relative size of singular values that count as zero."""

TURNED, STRAIGHT = 0.9, 0.99
"""Smallest cosines between tangents at the ends of a step, and of one that passes a
branch point."""

MEETING = 1e-5
"""Branches that come nearer than this meet, as far as floating point can tell."""


@dataclass(frozen=True, eq=False)
class Posed:
    """A posture, and how it can move within given directions.

    Attributes:
        sums: Coordinates of all freedoms, summed up to here, shape (freedoms,).
        basis: Orthonormal directions in which the motion may go, (freedoms, m).
        matrix: The loop equations along these, shape (rows, m).
        left: Combinations of the equations that hold their rank, shape (rows, rank).
        kernel: Orthonormal motions that they allow, shape (m, m − rank).
    """

    stance: Stance
    sums: Array
    basis: Array
    matrix: Array
    left: Array
    kernel: Array

    @property
    def rank(self) -> int:
        """Of the loop equations."""
        return int(self.left.shape[1])

    def allowed(self, direction: Array) -> Array:
        """The part of a direction that the loops allow, both along the basis."""
        return np.asarray(self.kernel @ (self.kernel.T @ direction))


def posed(forest: Forest, stance: Stance, sums: Array, basis: Array) -> Posed:
    """The posture with its tangents."""
    matrix = loop_jacobian(forest, stance)[0] @ basis
    if not matrix.size:
        empty = np.zeros((len(matrix), 0))
        return Posed(stance, sums, basis, matrix, empty, np.eye(basis.shape[1]))
    left, values, right = np.linalg.svd(matrix)
    rank = int((values > CUT * max(values[0], CUT)).sum())
    return Posed(stance, sums, basis, matrix, left[:, :rank], right[rank:].T)


def stepped(
    forest: Forest, here: Posed, step: Array, held: Array | None = None
) -> tuple[Posed, Verdict]:
    """One step, closed again.

    Args:
        forest: Of the mechanism, scaled.
        here: Where it starts.
        step: Along the directions of ``here``.
        held: One of these that closing may not change.
    """
    basis = here.basis
    closing = basis if held is None else _without(basis, basis @ held)
    wanted = basis @ step
    split = whole_split(forest, closing)
    found = projected(forest, here.stance, wanted[None], split)
    there = posed(forest, found.stance, here.sums + found.travelled[0], basis)
    asked = np.abs(wanted).max(initial=0.0)
    way = np.abs(found.travelled[0] - wanted).max(initial=0.0)
    if not found.closed[0]:
        return there, "open"
    if way > LEAP * asked or asked > LONGEST:
        return there, "far"
    return there, _agreement(here, there)


def whole_split(forest: Forest, basis: Array) -> Split:
    """No equations in front: all of them are asked at once, within some directions."""
    rows = 6 * len(forest.closing_joints)
    size = np.array([max(1.0, float(np.abs(forest.loop_signs).sum()) ** 0.5)])
    return Split(np.eye(rows)[None], basis[None], 0, size)


def passes_branch_point(here: Posed, there: Posed) -> bool:
    """Whether a step that crossed went straight on, and was as short as that takes."""
    length = np.abs(there.sums - here.sums).max(initial=0.0)
    return bool(length <= MEETING and _cosine(here, there) > STRAIGHT)


def _without(basis: Array, direction: Array) -> Array:
    """An orthonormal basis of the directions at right angles to one of them."""
    left, values, _ = np.linalg.svd(
        basis - np.outer(direction, direction @ basis), full_matrices=False
    )
    return np.asarray(left[:, values > 0.5])


def _agreement(here: Posed, there: Posed) -> Verdict:
    if there.rank > here.rank:
        return "good"  # away from a singular posture, where it could only start
    if there.rank < here.rank:
        return "rank"
    if _cosine(here, there) < TURNED:
        return "turned"
    turn = np.linalg.slogdet(here.kernel.T @ there.kernel)[0]
    before = _orientation(here.left, here)
    behind = _orientation(here.left, there) * turn
    return "good" if before == behind else "crossed"


def _orientation(left: Array, place: Posed) -> float:
    bordered = np.concatenate([left.T @ place.matrix, place.kernel.T])
    return float(np.linalg.slogdet(bordered)[0])


def _cosine(here: Posed, there: Posed) -> float:
    """The smallest between the tangent spaces."""
    overlap = here.kernel.T @ there.kernel
    if not overlap.size:
        return 1.0
    return float(np.linalg.svd(overlap, compute_uv=False).min())
