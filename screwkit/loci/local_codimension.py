"""How large a locus of lost rank is around a posture of it, by first derivatives.

Where a matrix M has lost one of its rank, with left and right null vectors u_i and v_j,
the locus is given to first order by u_i·dM·v_j = 0.  As many of these as are
independent is the codimension of its tangent space, which that of the locus does not
fall below; and where all of them are, they cut out the locus, which is smooth there.

References: [CoxLittleOShea] §9.6 (tangent spaces, smooth points).
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.modular import annihilator, rank
from screwkit.algebra.points import Point, differential, residue
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def codimension_around(
    ring: TrigonometricRing,
    columns: Sequence[Sequence[Polynomial]],
    codimension: int,
    at: tuple[Point, int],
) -> int | None:
    """Codimension, around a posture, of the locus where a matrix loses rank.

    If it is that of a piece of the locus, in general position on which the posture is,
    the piece is a component; if it is smaller the piece is a part of a component, which
    is smooth there, and so real where the piece is.

    Args:
        ring: Of the entries.
        columns: Of the matrix, whose rank at the posture is one less than in general.
        codimension: Of the piece.
        at: An exact posture and its prime.

    Returns:
        None where first derivatives do not tell.
    """
    point, prime = at
    height = len(columns[0])
    values = [[residue(x, point, prime) for x in column] for column in columns]
    left = annihilator(values, height, prime)
    right = annihilator([*zip(*values, strict=True)], len(columns), prime)
    changes = {
        (h, k): differential(ring, entry, point, prime)
        for k, column in enumerate(columns)
        for h, entry in enumerate(column)
        if not entry.is_constant()
    }
    rows = [
        [
            sum(u[h] * v[k] * change[n] for (h, k), change in changes.items()) % prime
            for n in range(len(ring.basis) + len(ring.symbols))
        ]
        for u in left
        for v in right
    ]
    tangent = rank(rows, prime)
    if tangent >= codimension:
        return codimension
    return tangent if tangent == len(rows) else None
