"""What a node of a proof may say: a product that vanishes nowhere off the locus."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass

from screwkit.algebra.branches import Branch
from screwkit.algebra.points import Point
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.loop_equations import LoopEquations
from screwkit.certificates.minor_choice import Matrix
from screwkit.certificates.records import Node


@dataclass(frozen=True)
class Offer:
    """What may be said.

    Attributes:
        parts: The product on the branch, by powers.
        node: Without its number and its cases.
        fallen: Components of limbs that are looked at besides, limb by limb, in the
            order in which the node names them.
    """

    parts: tuple[tuple[Polynomial, int], ...]
    node: Node
    fallen: tuple[tuple[tuple[Polynomial, ...], ...], ...] = ()

    @property
    def terms(self) -> int:
        """Of all parts together."""
        return sum(len(part) for part, _ in self.parts)


def minor_offers(
    matrix: Matrix | LoopEquations,
    branch: Branch,
    at: tuple[Point, int],
    source: random.Random,
) -> Iterator[Offer]:
    """Minors of the matrix that do not vanish at a point of a branch."""
    labels = [x for own in matrix.labels for x in own]
    rank = matrix.rank_at(*at)
    for minor in matrix.minors(branch, *at, source):
        node = Node(
            -1,
            rank=rank,
            rows=tuple(matrix.row(row) for row in minor.rows),
            columns=tuple(labels[k] for k in minor.columns),
            over=minor.over,
        )
        yield Offer(minor.parts, node)
