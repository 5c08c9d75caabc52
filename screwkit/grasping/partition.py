"""Who can move without whom: the seven blocks of all motions of a grasp.

Motions are the null space of [J_a J_p −Gᵀ].  Blocks are filled in the order in which
each adds what the earlier ones lack, so that together they are a basis also where the
column spaces of J_a, J_p and Gᵀ share vectors.

References: [BicchiPrattichizzo] eqs. (2)-(5), with the order of filling corrected;
[BicchiMelchiorri] eqs. (8)-(12).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from screwkit.algebra.modular import (
    annihilator,
    echelon,
    leading,
    null_vectors,
    reduced_rows,
    residue_matrix,
)
from screwkit.algebra.residue_matrices import (
    Rows,
    chosen_columns,
    first_rows,
    identity,
    product,
)
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
    prime, every = grasp.prime, grasp.motions.nrows()
    spanned: Rows = []  # as sums of the rows of all motions, like all spaces below
    basis: dict[str, tuple[tuple[int, ...], ...]] = {}
    for block in BLOCKS:
        parts = MOVING[block]
        known = sum(len(v) for b, v in basis.items() if set(MOVING[b]) <= set(parts))
        if known == grasp.ranks.motions(parts):
            basis[block] = ()  # its motions are sums of those of earlier blocks
            continue
        others = "".join(part for part in "apo" if part not in parts)
        own = identity(every)
        if others:
            own = null_vectors(grasp.resting(others).transpose())
        basis[block] = _beyond(grasp, own, _shared(own, spanned, prime))
        spanned = echelon([*spanned, *own], prime)
    actuated, passive, twists = (len(grasp.places(part)) for part in "apo")
    return Blocks(actuated, passive, twists, basis)


def _shared(own: Rows, spanned: Rows, prime: int) -> Rows:
    """What two spaces have in common."""
    if not spanned:
        return []
    both = [*own, *spanned]
    relations = annihilator(
        [list(c) for c in zip(*both, strict=True)], len(both), prime
    )
    return product([relation[: len(own)] for relation in relations], own, prime)


def _beyond(grasp: ExactGrasp, own: Rows, shared: Rows) -> tuple[tuple[int, ...], ...]:
    """Basis of what some motions add to others, out of their own span.

    Reduced by what their span has in common with these, and by nothing else of them:
    what does not move in these motions does not move in the basis.
    """
    prime, motions = grasp.prime, grasp.motions
    vectors = residue_matrix(own, motions.nrows(), prime) * motions
    if shared:
        common, rank = (residue_matrix(shared, motions.nrows(), prime) * motions).rref()
        chosen = leading(common, rank)
        common = first_rows(common, rank, prime)
        vectors -= chosen_columns(vectors, chosen, prime) * common
    return tuple(map(tuple, reduced_rows(vectors)))
