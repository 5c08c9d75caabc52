"""Limb singularities of limbs with loops inside.

The twist system of such a limb is what its joints let the platform do while the loops
inside stay closed.  It loses dimensions where more of the joints' motions leave the
platform still; on strata where the loops inside lose a constraint it may win them back.

References: [Zlatanov2002], [Hunt1978] §13.
"""

from __future__ import annotations

from functools import partial
from weakref import WeakKeyDictionary

from screwkit.algebra.branches import Branch
from screwkit.analyses.one_component import limb_component
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.kinematics.loop_columns import loop_columns
from screwkit.kinematics.told_parts import own_parts
from screwkit.loci.exact_equations import Singularity, with_exact_equations
from screwkit.loci.hybrid_strata import HybridStrata, generic_motion, hybrid_strata
from screwkit.loci.meanings import Meanings
from screwkit.loci.mechanism_figures import graph_figures
from screwkit.loci.pieces import Piece
from screwkit.loci.searching_again import searched_again
from screwkit.loci.strata import LimbStrata, limb_strata
from screwkit.results.singularities import LimbSingularities


def strata_of(assembly: Assembly, limb: LimbChain) -> LimbStrata:
    """The strata of any limb, in its own ring."""
    if limb.elements is None:
        return limb_strata(assembly, limb)
    return _strata(assembly, limb).by_equations


_STRATA: WeakKeyDictionary[Assembly, dict[str, HybridStrata]] = WeakKeyDictionary()


def _strata(assembly: Assembly, limb: LimbChain) -> HybridStrata:
    known = _STRATA.setdefault(assembly, {})
    if limb.name not in known:
        ring = assembly.limb_twists[limb.name].ring
        parts, height = own_parts(assembly, limb)
        root, library = assembly.root(ring), assembly.library(ring)
        known[limb.name] = hybrid_strata(root, parts, height, library)
    return known[limb.name]


def hybrid_limb(assembly: Assembly, limb: LimbChain) -> LimbSingularities:
    """Where the twist system of a limb with loops inside loses dimensions."""
    framed = assembly.limb_twists[limb.name]
    root, library = assembly.root(framed.ring), assembly.library(framed.ring)
    strata = _strata(assembly, limb)
    figures = graph_figures(assembly.mechanism, framed, root, library)
    meanings = Meanings(framed, root, library, figures)
    parts, height = own_parts(assembly, limb)
    generic = strata.strata[0].dimension

    def is_singular(branch: Branch) -> bool:
        motion = generic_motion([branch], parts, height)
        return motion is not None and motion.dimension < generic

    def dimension(piece: Piece) -> int:
        motion = generic_motion(piece.branches, parts, height)
        return generic if motion is None else motion.dimension

    singular = Singularity(
        root, partial(loop_columns, [parts, ()], height), is_singular, library
    )
    found = searched_again(
        strata.narrow, partial(with_exact_equations, singular=singular)
    )
    components = tuple(
        limb_component(
            piece,
            root,
            library,
            meanings,
            found.exact.pieces,
            rank=dimension(piece),
            dimension=assembly.dimension,
        )
        for piece in found.exact.pieces
    )
    return LimbSingularities(
        limb=limb.name,
        joints=limb.joints,
        generic_rank=generic,
        complete=found.complete,
        components=components,
        proof=_proof(strata) if found.complete else "",
        reason=found.reason,
    )


def _proof(strata: HybridStrata) -> str:
    count = len(strata.strata) - 1
    if not count:
        return "its twist system, the loops inside closed, is nowhere another one"
    outside = "one stratum, which was searched in turn"
    if count > 1:
        outside = f"{count} strata, each of which was searched in turn"
    return f"the extensor of its twists, loops inside closed, holds outside {outside}"
