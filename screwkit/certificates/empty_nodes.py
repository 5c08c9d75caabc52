"""Nodes at which nothing is: no axis, a length 0 that is not 0, a false condition."""

from __future__ import annotations

from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.multiples import condition_of, divided, follows
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Node
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.signs import Signs
from screwkit.certificates.texts import RefusedError, read


class EmptyNodes:
    """Examines them.

    Args:
        postures: Of the mechanism and the part.
        matrix: Of the part.
        signs: That are declared.
    """

    def __init__(
        self, postures: Postures, matrix: ScrewMatrix | GraphMatrix, signs: Signs
    ) -> None:
        self._postures, self._matrix, self._signs = postures, matrix, signs

    def without_axis(self, node: Node, way: Way) -> None:
        """An axis has no length, or each of its coordinates is 0: no mechanism."""
        free, label = self._matrix.twists(next(self._postures.on(Way()))), node.axis
        if label not in free:
            raise RefusedError(f"there is no freedom {label!r}")
        turning = any(x != 0 for x in free[label][:3])
        place = slice(0, 3) if turning else slice(3, 6)
        multiples = {multiple.equation: multiple for multiple in node.multiples}
        for point in self._postures.several(way):
            direction = self._matrix.twists(point)[label][place]
            square = sum((x * x for x in direction), point.zero)
            if not follows(square, multiples.get(0), way, point) and not all(
                follows(x, multiples.get(k), way, point)
                for k, x in enumerate(direction)
            ):
                raise RefusedError(f"the axis of {label} has a direction on it")

    def vanishing(self, name: str, way: Way) -> None:
        """A symbol that is declared not to be 0 is 0 by the steps of a way."""
        if name not in self._signs.nonzero:
            raise RefusedError(f"{name} may be 0")
        value = read(name)
        if any(point.value(value) != 0 for point in self._postures.several(way)):
            raise RefusedError(f"{name} is not 0 on it")

    def impossible(self, node: Node, way: Way) -> None:
        """A condition of a way becomes what vanishes nowhere."""
        condition = read(condition_of(way, node.impossible))
        value = read(node.impossible_value)
        if not self._signs.never_zero(value):
            raise RefusedError(f"{node.impossible_value} may vanish")
        for point in self._postures.several(way):
            left = point.value(condition)
            left = left * divided(node.over or {}, way, point)
            if left != point.value(value):
                raise RefusedError("a condition is not what it is said to be")
