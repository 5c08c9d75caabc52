"""The usual kinds of motion, told from displacements that are exact modulo a prime.

The counterpart of `motion_invariants`, which measures; here what vanishes at random
postures of a family vanishes on all of it.

References: [Herve1999], [Schwartz1980].
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.modular import annihilator, rank
from screwkit.finite.lie_closure import Displacement

_SHIFTS = (
    "at rest",
    "straight line",
    "pure translation in a plane",
    "pure translation",
)


def words_of(
    displacements: Sequence[Displacement], prime: int, *, coupled: bool
) -> str | None:
    """The smallest of the kinds of `motion_in_words` that holds all displacements.

    Args:
        displacements: Of one body from one posture, more than the kinds have values.
        prime: Their modulus.
        coupled: Whether the motion has one dimension, so that a body that turns about
            an axis and slides along it does both at once.

    Returns:
        None where the two may be in a fixed ratio: angles are no residues.
    """
    turned = [
        [[row[j] - int(i == j) for j in range(3)] for i, row in enumerate(rotation)]
        for rotation, _ in displacements
    ]
    shifts = [list(shift) for _, shift in displacements]
    rows = [row for matrix in turned for row in matrix]
    turning = rank(rows, prime)
    if not turning:
        return _SHIFTS[rank(shifts, prime)]
    if turning == 3:
        same = _fixed_point(rows, [-x for shift in shifts for x in shift], prime)
        return "rotation about a fixed point" if same else ""
    axis = annihilator(rows, 3, prime)[0]
    square = pow(sum(x * x for x in axis), -1, prime)
    advances = [
        sum(x * y for x, y in zip(axis, shift, strict=True)) * square % prime
        for shift in shifts
    ]
    across = [
        advance * x - y
        for shift, advance in zip(shifts, advances, strict=True)
        for x, y in zip(axis, shift, strict=True)
    ]
    slides = any(advances)
    if not _fixed_point(rows, across, prime):
        return "Schönflies" if slides else "planar"
    if not slides:
        return "rotation about a fixed axis"
    if coupled:
        return None
    return "rotation about and translation along a fixed axis"


def _fixed_point(
    rows: Sequence[Sequence[int]], wanted: Sequence[int], prime: int
) -> bool:
    """Whether (R − 1) c = −p has one solution c for all displacements."""
    beside = [[*row, x] for row, x in zip(rows, wanted, strict=True)]
    return rank(beside, prime) == rank(rows, prime)
