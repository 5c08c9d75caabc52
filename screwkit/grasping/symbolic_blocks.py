"""The partition in symbols: basis vectors as polynomials, where they are short.

Which entries of a basis vector vanish is known from residues.  On the others it is the
only vector that the rows annihilate, so its entries are signed minors; nothing is
divided but common factors.  Vectors that would grow too long are left out.

References: [BicchiMelchiorri] eqs. (8)-(9), [BicchiPrattichizzo] eq. (5).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Final, TypeAlias

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.minors import minors_of
from screwkit.algebra.modular import independent
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.errors import TooLargeError
from screwkit.grasping.exact_grasp import ExactGrasp
from screwkit.grasping.matrices import GraspMatrices, grasp_matrices, grasp_rows
from screwkit.grasping.partition import BLOCKS, Blocks, blocks_of
from screwkit.mechanism.model import Mechanism
from screwkit.screw.nullspace import shortened

Vector: TypeAlias = tuple[Polynomial, ...]

VALUE: Final = "x_"
"""The value of an index as a symbol; none of a file ends so."""

LARGEST: Final = 12
"""Entries of a vector up to which its minors are expanded."""

TERMS: Final = 400
"""Terms of all rows together up to which minors are expanded."""

PRODUCTS: Final = 10_000
"""Products of terms that one more row may take; short vectors are found far below."""


def polynomial_matrices(
    mechanism: Mechanism,
) -> tuple[TrigonometricRing, GraspMatrices[Polynomial]]:
    """J and Gᵀ over exact polynomials in the symbols of the file.

    Raises:
        UndecidedError: If a contact has no place.
    """
    seen = SurveyRing()
    grasp_rows(mechanism, seen)
    ring = TrigonometricRing(seen)
    return ring, grasp_matrices(mechanism, ring)


class GraspFamily:
    """A grasp for all values of its symbols: ranks at once, vectors when asked for."""

    def __init__(self, mechanism: Mechanism, generic: ExactGrasp) -> None:
        """Take a mechanism with symbols, and its grasp at a random point of them."""
        self.mechanism = mechanism
        self.generic = generic
        self.blocks = blocks_of(generic)

    @cached_property
    def matrices(self) -> tuple[TrigonometricRing, GraspMatrices[Polynomial]]:
        """J and Gᵀ over a ring that has the weights and `VALUE` too."""
        seen = SurveyRing()
        grasp_rows(self.mechanism, seen)
        for rows in self.mechanism.weights.values():
            for entry in (x for row in rows for x in row):
                evaluate(entry, seen)
        seen.symbol(VALUE)
        ring = TrigonometricRing(seen)
        return ring, grasp_matrices(self.mechanism, ring)

    @cached_property
    def vectors(self) -> Mapping[str, tuple[Vector | None, ...]]:
        """The vectors of each block; None where one is too long."""
        return symbolic_blocks(*self.matrices, self.generic, self.blocks)


def any_is_short(blocks: Blocks) -> bool:
    """Whether some basis vector has few enough entries to be written in symbols."""
    return any(
        sum(map(bool, vector)) <= LARGEST
        for own in blocks.basis.values()
        for vector in own
    )


def symbolic_blocks(
    ring: TrigonometricRing,
    matrices: GraspMatrices[Polynomial],
    grasp: ExactGrasp,
    blocks: Blocks,
) -> Mapping[str, tuple[Vector | None, ...]]:
    """The vectors of each block, (q_a; q_p; u); None where one is too long.

    Args:
        ring: Of the entries.
        matrices: From `polynomial_matrices`.
        grasp: The same at a random exact point.
        blocks: Of that point.
    """
    rows = [
        ring.without_divisors((*j, *(-x for x in gt)))
        for j, gt in zip(matrices.j, matrices.gt, strict=True)
    ]
    residues = grasp.whole
    filled = [frozenset(i for i, x in enumerate(row) if x) for row in residues]
    return {
        block: tuple(
            _vector(ring, rows, residues, filled, vector, grasp.prime)
            for vector in blocks.basis[block]
        )
        for block in BLOCKS
    }


def _vector(
    ring: TrigonometricRing,
    rows: Sequence[Sequence[Polynomial]],
    residues: Sequence[Sequence[int]],
    filled: Sequence[frozenset[int]],
    vector: Sequence[int],
    prime: int,
) -> Vector | None:
    support = [i for i, x in enumerate(vector) if x]
    if len(support) > LARGEST:
        return None
    touching = [r for r, own in enumerate(filled) if not own.isdisjoint(support)]
    order = sorted(touching, key=lambda r: sum(len(rows[r][i]) for i in support))
    known = [[residues[r][i] for i in support] for r in order]
    chosen = [order[k] for k in independent(known, prime)[: len(support) - 1]]
    lines = [[rows[r][i] for i in support] for r in chosen]
    if sum(len(x) for line in lines for x in line) > TERMS:
        return None
    try:
        minors = minors_of(ring, lines, PRODUCTS)
    except TooLargeError:
        return None
    whole = (1 << len(support)) - 1
    found: list[Polynomial] = [ring.zero] * len(vector)
    for number, place in enumerate(support):
        minor: Polynomial = minors.get(whole ^ 1 << number, ring.zero)
        found[place] = -minor if number & 1 else minor
    return shortened(ring, found)
