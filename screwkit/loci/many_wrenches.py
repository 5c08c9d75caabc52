"""Where wrenches, more than are needed to hold the platform, let it go.

The minors of the wrenches that limbs have at every posture vanish together wherever the
platform can move.  Every part of these zeros has at most the codimension that the size
of their matrix allows (`determinantal`).  If the platform moves in general on all parts
that are so large, these are all that there is: at smaller sets inside them, where a
limb idles, postures at which the platform moves come as near as one likes.

References: [EagonNorthcott1962].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.cases import possible_factors
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.kinematics.limb_parts import Parts
from screwkit.loci.lasting_wrenches import lasting_minors
from screwkit.loci.loop_drop import loop_state
from screwkit.loci.pieces import Piece, pieces_of


@dataclass(frozen=True)
class ManyWrenches:
    """Where more wrenches than are needed let the platform go.

    Attributes:
        parts: On each the platform moves in general; it moves nowhere else.
        equations: Those that hold on the parts and nowhere else; none if not found.
    """

    parts: tuple[Branch, ...]
    equations: tuple[Polynomial, ...] = ()

    def is_all_of(self, piece: Piece) -> bool:
        """Whether the zeros of a piece's equations are these parts."""
        return bool(self.equations) and set(map(str, self.equations)) <= piece.texts


def many_wrenches(
    root: Branch, limbs: Sequence[Parts], search: Search
) -> ManyWrenches | None:
    """The parts of the zeros of the lasting wrenches' minors.

    Args:
        root: The whole configuration space.
        limbs: Passive twists of each, that hold the platform in general.
        search: Budget and known factors.

    Returns:
        None where the wrenches are not more than needed, where something was left open,
        or where the platform is held in general on some part.
    """
    minors, bound = lasting_minors(root, limbs, search)
    if not minors:
        return None
    own = replace(search, found=[], unfinished=[], special=[], bound=bound)
    zeros = common_zeros(root, minors, own)
    states = [loop_state(part, limbs) for part in zeros.branches]
    if zeros.open or not all(s is not None and s.platform_freedom for s in states):
        return None
    if len(pieces_of(zeros.branches)) != 1:
        return ManyWrenches(zeros.branches)
    equations = []
    for minor in minors:
        factors = possible_factors(root, minor, search.library)
        if len(factors) != 1 or len(factors[0].equations) > 1:
            return ManyWrenches(zeros.branches)
        equations.append(factors[0].equations[0])
    parts = tuple(replace(part, extra=tuple(equations)) for part in zeros.branches)
    return ManyWrenches(parts, tuple(equations))
