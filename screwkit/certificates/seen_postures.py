"""What is seen of a component at closed postures, as whoever checks will see it."""

from __future__ import annotations

import random
from collections.abc import Sequence

from screwkit.certificates.closed_postures import ClosedPostures
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Locus, Part, Reach
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.texts import RefusedError, read
from screwkit.mechanism.model import Mechanism


class SeenPostures:
    """Closed postures of one part.

    Args:
        mechanism: As read.
        part: Without its components.
    """

    def __init__(self, mechanism: Mechanism, part: Part) -> None:
        self._part = part
        self._postures = Postures(mechanism, part, random.Random(17))
        self._closed = ClosedPostures(mechanism, self._postures)
        self._matrix: ScrewMatrix | GraphMatrix = ScrewMatrix(self._postures)
        if part.form == "loops":
            self._matrix = GraphMatrix(self._postures)

    def locus(self, equations: tuple[str, ...], reach: Sequence[Reach]) -> Locus:
        """A component with its rank and the freedom of the platform.

        Args:
            equations: Of the component.
            reach: How closed postures on it may be found.

        Raises:
            RefusedError: If none are found so.
        """
        points = [
            point
            for own in reach
            for point in self._closed.on(Way(own.steps), own.roots)
        ]
        if not points or any(p.value(read(e)) != 0 for p in points for e in equations):
            raise RefusedError("no closed posture on it was found")
        freedom = -1
        if self._part.question != "limb":
            freedom = min(map(self._matrix.freedom, points))
        rank = max(map(self._matrix.rank, points))
        return Locus(equations, rank, freedom, tuple(reach))
