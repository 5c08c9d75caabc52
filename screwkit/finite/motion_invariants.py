"""What kind of finite motion a body makes, from what its displacements leave fixed.

All displacements of a motion belong to a subgroup of the displacements, or they do
not; the subgroups are told apart by a direction, a point or an axis that stays, and
by a translation that vanishes.

References: [Herve1978], [Hunt1978].
"""

from __future__ import annotations

import numpy as np

from screwkit.algebra.batch import Array

EXACT = 1e-7
"""Largest failure of an invariant, lengths over the mechanism's own.

Closing to 1e-12 leaves about 1e-9 near singular postures; what is no invariant fails by
far more on a walk of some radians."""


VISIBLE = 1e-2
"""Least size of a way whose straightness says anything, in the same lengths."""


def motion_in_words(displacements: Array, tolerance: float = EXACT) -> str:
    """The smallest of the usual kinds of motion that holds all displacements.

    Args:
        displacements: Of one body from one posture, shape (number, 4, 4), in lengths
            of the mechanism's own size.
        tolerance: Largest failure of an invariant.

    Returns:
        ``at rest``, ``straight line``, ``pure translation in a plane``, ``pure
        translation``, ``rotation about a fixed axis``, ``screw motion about a fixed
        axis``, ``rotation about and translation along a fixed axis``, ``planar``,
        ``rotation about a fixed point``, ``Schönflies``, or nothing for what is none
        of these.
    """
    turned = displacements[:, :3, :3] - np.eye(3)
    shifts = displacements[:, :3, 3]
    if np.abs(turned).max(initial=0.0) <= tolerance:
        return _translation(shifts, tolerance)
    stacked = turned.reshape(-1, 3)
    right = np.linalg.svd(stacked, full_matrices=False)[2]
    direction = right[2]
    same_direction = np.abs(stacked @ direction).max() <= tolerance
    if not same_direction:
        fixed = _fixed_point(turned, shifts, tolerance)
        return "rotation about a fixed point" if fixed else ""
    along = shifts @ direction
    across = shifts - along[:, None] * direction
    slides = np.abs(along).max() > tolerance
    if _fixed_point(turned, across, tolerance):
        if not slides:
            return "rotation about a fixed axis"
        if _coupled(turned, direction, along, tolerance):
            return "screw motion about a fixed axis"
        return "rotation about and translation along a fixed axis"
    return "Schönflies" if slides else "planar"


def runs_straight(displacements: Array, points: Array, tolerance: float) -> bool:
    """Whether points of a body all run along straight lines, by the same way.

    Args:
        displacements: Of the body from one posture, shape (number, 4, 4), in lengths of
            the mechanism's own size.
        points: Where they are at that posture, shape (points, 3).
        tolerance: Largest distance from the line.
    """
    turned, shifts = displacements[:, :3, :3] - np.eye(3), displacements[:, None, :3, 3]
    ways = np.einsum("nij,pj->npi", turned, points) + shifts
    if np.abs(ways - ways[:, :1]).max(initial=0.0) > tolerance:
        return False
    way = ways[:, 0] - ways[:, 0].mean(axis=0)
    _, sizes, lines = np.linalg.svd(way, full_matrices=False)
    if sizes[0] < np.sqrt(len(way)) * VISIBLE:
        return False
    return bool(np.abs(way - np.outer(way @ lines[0], lines[0])).max() <= tolerance)


def _translation(shifts: Array, tolerance: float) -> str:
    values = np.linalg.svd(shifts, compute_uv=False) / np.sqrt(len(shifts))
    # Size relative to the motion itself, lest a short motion pass for none.
    rank = int((values > max(tolerance, 1e-6 * values.max(initial=0.0))).sum())
    return (
        "at rest",
        "straight line",
        "pure translation in a plane",
        "pure translation",
    )[rank]


def _fixed_point(turned: Array, shifts: Array, tolerance: float) -> bool:
    """Whether some point c with (R − 1)c + p = 0 for all displacements exists."""
    matrix, wanted = turned.reshape(-1, 3), -shifts.reshape(-1)
    point = np.linalg.lstsq(matrix, wanted, rcond=1e-8)[0]
    return bool(np.abs(matrix @ point - wanted).max() <= tolerance)


def _coupled(turned: Array, direction: Array, along: Array, tolerance: float) -> bool:
    """Whether the advance is one pitch times the angle, up to whole turns."""
    skew = turned - np.swapaxes(turned, -1, -2)
    sines = 0.5 * np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)
    cosines = 0.5 * (np.trace(turned, axis1=1, axis2=2) + 2.0)
    angles = np.arctan2(sines @ direction, cosines)
    small = np.abs(angles) < 1.0
    small &= np.abs(along) <= 2 * np.abs(along[small]).max(initial=0.0)
    if small.sum() < 2:
        return False
    pitch = angles[small] @ along[small] / (angles[small] @ angles[small])
    if pitch == 0:
        return False
    turns = (along - pitch * angles) / (2 * np.pi * pitch)
    return bool(np.abs((turns - turns.round()) * pitch).max() <= 10 * tolerance)
