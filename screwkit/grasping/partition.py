"""Who can move without whom: the seven blocks of all motions of a grasp.

Motions are the null space of [J_a J_p −Gᵀ].  Blocks are filled in the order in which
each adds what the earlier ones lack, so that together they are a basis also where the
column spaces of J_a, J_p and Gᵀ share vectors.

References: [BicchiPrattichizzo] eqs. (2)-(5), with the order of filling corrected;
[BicchiMelchiorri] eqs. (8)-(12).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from screwkit.algebra.modular import annihilator, echelon, null_vectors
from screwkit.algebra.residue_matrices import Rows, product
from screwkit.grasping.exact_grasp import ExactGrasp

BLOCKS: Final = ("a_r", "p_r", "o_i", "po_i", "ap_c", "ao_c", "apo_c")
"""In the order of filling."""

MOVING: Final[Mapping[str, str]] = {
    "a_r": "a",
    "p_r": "p",
    "o_i": "o",
    "po_i": "po",
    "ap_c": "ap",
    "ao_c": "ao",
    "apo_c": "apo",
}
"""What moves in a block: actuated joints, passive joints, the object."""


@dataclass(frozen=True)
class Blocks:
    """Bases of the seven blocks, as residues.

    Attributes:
        actuated, passive, twists: Lengths of the parts of a vector (q_a; q_p; u).
        basis: Of each block.
    """

    actuated: int
    passive: int
    twists: int
    basis: Mapping[str, tuple[tuple[int, ...], ...]]

    def dimension(self, block: str) -> int:
        """Columns of a block."""
        return len(self.basis[block])

    @property
    def dimensions(self) -> tuple[int, ...]:
        """Of all blocks, in the order of `BLOCKS`; their sum is the mobility."""
        return tuple(len(self.basis[block]) for block in BLOCKS)


def blocks_of(grasp: ExactGrasp) -> Blocks:
    """The partition at an exact point.

    The basis of a block depends on the spaces alone: reduced echelon vectors of its
    own motions, with those that are sums of earlier blocks' motions taken out.
    """
    prime, width = grasp.prime, len(grasp.matrices.freedoms) + grasp.twists
    places = _places(grasp)
    spanned: list[list[int]] = []
    basis: dict[str, tuple[tuple[int, ...], ...]] = {}
    for block in BLOCKS:
        parts = MOVING[block]
        known = sum(len(v) for b, v in basis.items() if set(MOVING[b]) <= set(parts))
        if known == grasp.ranks.motions(parts):
            basis[block] = ()  # its motions are sums of those of earlier blocks
            continue
        where = [i for part in "apo" if part in parts for i in places[part]]
        vectors = [
            _spread(vector, where, width) for vector in null_vectors(grasp.part(parts))
        ]
        added = _beyond(spanned, vectors, prime)
        basis[block] = tuple(tuple(vector) for vector in added)
        spanned += added
    actuated, passive, twists = (len(places[part]) for part in "apo")
    return Blocks(actuated, passive, twists, basis)


def _places(grasp: ExactGrasp) -> dict[str, range]:
    moving = len(grasp.matrices.freedoms)
    return {
        "a": range(grasp.actuated),
        "p": range(grasp.actuated, moving),
        "o": range(moving, moving + grasp.twists),
    }


def _spread(vector: Sequence[int], where: Sequence[int], width: int) -> list[int]:
    whole = [0] * width
    for place, value in zip(where, vector, strict=True):
        whole[place] = value
    return whole


def _beyond(spanned: Rows, vectors: Rows, prime: int) -> list[list[int]]:
    """Basis of what ``vectors`` add to a space, out of their own span.

    Reduced by what their span has in common with the space, and by nothing else of it:
    what does not move in these vectors does not move in the basis.
    """
    if not spanned or not vectors:
        return echelon(vectors, prime)
    both = [*vectors, *spanned]
    relations = annihilator(
        [list(c) for c in zip(*both, strict=True)], len(both), prime
    )
    own = [relation[: len(vectors)] for relation in relations]
    shared = echelon(product(own, vectors, prime), prime)
    pivots = [next(i for i, x in enumerate(row) if x) for row in shared]
    reduced = []
    for vector in vectors:
        left = list(vector)
        for pivot, row in zip(pivots, shared, strict=True):
            factor = left[pivot]
            if factor:
                left = [
                    (x - factor * y) % prime for x, y in zip(left, row, strict=True)
                ]
        reduced.append(left)
    return echelon(reduced, prime)
