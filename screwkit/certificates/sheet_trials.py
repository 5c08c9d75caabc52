"""Whether the checker will find on a sheet what is claimed of a component."""

from __future__ import annotations

import random
from collections.abc import Sequence

from screwkit.algebra.all_roots import NoResidueError
from screwkit.algebra.modular import ResampleError
from screwkit.algebra.polynomial_text import text
from screwkit.certificates.checking import PartCheck
from screwkit.certificates.conditions import Place
from screwkit.certificates.equations_told import Step
from screwkit.certificates.postures import Way
from screwkit.certificates.records import Locus, Node, Part
from screwkit.certificates.steps import written_step
from screwkit.certificates.texts import RefusedError
from screwkit.mechanism.model import Mechanism


def on_the_way(place: Place) -> tuple[list[Step], list[str]]:
    """The steps and conditions of a node as they are written."""
    branch = place.branch
    steps = [written_step(branch, number) for number in range(len(branch.steps))]
    return steps, [text(branch.ring, own) for own in place.conditions]


class SheetTrials:
    """Asks about sheets before a tree is written.

    Args:
        mechanism: As read.
        part: What is claimed, without a proof.
        locus: The component whose sheets are met; None: those of a proof are.
    """

    def __init__(
        self, mechanism: Mechanism, part: Part, locus: Locus | None = None
    ) -> None:
        self._check = PartCheck(mechanism, part, random.Random(23))
        self._check.loci.generic()
        self._locus = locus

    def seen(
        self, steps: Sequence[Step], conditions: Sequence[str], node: Node
    ) -> int | None:
        """How many parts of the component are seen on a sheet that will be taken.

        Args:
            steps: On the way to it.
            conditions: On the way to it.
            node: The sheet, its cases left open; or that of tied dimensions.

        Returns:
            None where it will not be taken.
        """
        loci, locus = self._check.loci, self._locus
        if locus is None:
            return None
        loci.forget(locus)
        way = Way(tuple(steps), tuple(conditions))
        try:
            if node.special:
                self._check.general.special(node, way)
            else:
                loci.sheet(locus, way, node)
        except (RefusedError, NoResidueError, ResampleError):
            return None
        return None if locus.equations in loci.sampled else loci.count(locus)

    def lie_on_components(
        self, steps: Sequence[Step], conditions: Sequence[str], node: Node
    ) -> bool:
        """Whether a sheet of a proof will be taken.

        Args:
            steps: On the way to it.
            conditions: On the way to it.
            node: The sheet, its cases left open.
        """
        way = Way(tuple(steps), tuple(conditions))
        try:
            self._check.loci.on_components(node, way)
        except (RefusedError, NoResidueError, ResampleError):
            return False
        return True
