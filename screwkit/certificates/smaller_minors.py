"""Why minors below the generic rank show that a node holds no posture of a locus.

Where the rank of a matrix is constant its kernel varies continuously.  On a node the
rank is the generic one of the node outside a proper subset, never higher.
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.exact_point import PointRing
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.texts import RefusedError


def still(
    matrix: ScrewMatrix | GraphMatrix, size: int, points: Sequence[PointRing]
) -> None:
    """Whether the platform keeps still where a minor of a node does not vanish.

    The rank there is the generic one of the node, hence the mobility.  Of the joint
    rates the platform feels no more than in general on the node: the motions with the
    platform held are no fewer anywhere.

    Args:
        matrix: Of a part about actuation.
        size: Of the minor.
        points: Random ones of the node.

    Raises:
        RefusedError: If it may move.
    """
    for point in points:
        rank = matrix.rank(point)
        if rank > size:
            raise RefusedError(f"the rank on it is {rank}")
        if rank == size and matrix.freedom(point):
            raise RefusedError("the platform moves on it")


def wide(matrix: GraphMatrix, most: int, points: Sequence[PointRing]) -> None:
    """Whether a limb allows no less where a minor of a node does not vanish.

    The rank of [C; P] there is the size of the minor or more, and that of C nowhere on
    the node above its generic one there.

    Args:
        matrix: Of a limb by its loop equations.
        most: Size of the minor less the limb's generic freedom.
        points: Random ones of the node.

    Raises:
        RefusedError: If it may allow less.
    """
    for point in points:
        rank = matrix.loop_rank(point)
        if rank > most:
            raise RefusedError(f"the rank of the loop equations on it is {rank}")
