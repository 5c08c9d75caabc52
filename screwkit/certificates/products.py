"""Whether the cases of a node cover it: a minor, or a condition, is their product.

Checked by values at random postures, after the divisors of the steps before.
"""

from __future__ import annotations

from typing import Any

from screwkit.algebra.exact_point import PointRing
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.limb_claims import LimbClaims
from screwkit.certificates.multiples import condition_of, divided
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Case, Node
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.texts import RefusedError, read


class Products:
    """Examines the products of one part.

    Args:
        postures: Of the mechanism and the part.
        matrix: Of the part.
        limbs: Claims about them.
    """

    def __init__(
        self,
        postures: Postures,
        matrix: ScrewMatrix | GraphMatrix,
        limbs: LimbClaims,
    ) -> None:
        self._postures, self._matrix, self._limbs = postures, matrix, limbs

    def check(self, node: Node, way: Way, size: int) -> None:
        """What a node takes apart is a number times the product of its cases.

        Args:
            node: With cases.
            way: To the node.
            size: What the minor must have, if it is one.

        Raises:
            RefusedError: If it is not.
        """
        if is_minor(node):
            if len(node.rows) != size or len(node.columns) != size:
                raise RefusedError(f"its minor is not of size {size}")
            if min(node.rows, default=0) < 0 or not {*node.columns} <= {
                *self._matrix.columns
            }:
                raise RefusedError("its minor is none of the matrix")
        ratios: set[int] = set()
        paired = any(len(case.equations) > 1 for case in node.cases)
        for point in self._postures.several(way):
            if node.combination:
                left = point.zero
                for own in node.combination:
                    condition = point.value(read(condition_of(way, own.condition)))
                    term = point.value(read(own.times)) * condition
                    left = left + term * divided(own.over, way, point)
            elif node.condition >= 0:
                left = point.value(read(condition_of(way, node.condition)))
            elif node.limbs:
                left = self._limbs.product(node, point)
            else:
                try:
                    left = self._matrix.minor(point, node.rows, node.columns)
                except IndexError:
                    raise RefusedError("its minor is none of the matrix") from None
            left = left * divided(node.over or {}, way, point)
            right = point.one
            for case in node.cases:
                right = right * self._factor(case, point, paired=paired) ** case.power
            if right == 0 or left == 0:
                raise RefusedError("its product vanishes at a random posture")
            ratio = left * left / right if paired else left / right
            ratios.add(int(ratio))
        if len(ratios) > 1:
            raise RefusedError("its minor is not the product of its cases")

    def _factor(self, case: Case, point: PointRing, *, paired: bool) -> Any:
        """A factor's value; its square where some factor is a half-angle form."""
        values = [point.value(read(text)) for text in case.equations]
        if not values or case.power < 1:
            raise RefusedError("a case without equation or power")
        if not paired:
            return values[0]
        return sum((value * value for value in values), point.zero)


def is_minor(node: Node) -> bool:
    """Whether the product of a node is a minor of the matrix."""
    return node.condition < 0 and not node.combination and not node.limbs
