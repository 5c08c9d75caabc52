"""Whether the checker will find on a sheet what is claimed of a component."""

from __future__ import annotations

import random
from collections.abc import Sequence

from screwkit.algebra.all_roots import NoResidueError
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.checking import PartCheck
from screwkit.certificates.postures import Way
from screwkit.certificates.records import Locus, Node, Part, Step
from screwkit.certificates.texts import RefusedError
from screwkit.mechanism.model import Mechanism


class SheetTrials:
    """Asks about sheets of one component before a tree is written.

    Args:
        mechanism: As read.
        part: What is claimed, without a proof.
        locus: The component.
    """

    def __init__(self, mechanism: Mechanism, part: Part, locus: Locus) -> None:
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
