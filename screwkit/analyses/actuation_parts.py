"""The pieces of an actuation locus as components of an answer."""

from __future__ import annotations

from collections.abc import Collection
from functools import partial

from screwkit.analyses.one_component import component_of
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.joints_aside import freedoms_aside
from screwkit.loci.actuation_locus import ActuationLocus
from screwkit.loci.pieces import Piece
from screwkit.results.singularities import Component


def actuation_parts(
    assembly: Assembly, locus: ActuationLocus, actuated: Collection[str]
) -> tuple[tuple[Piece, Component], ...]:
    """Each piece with its component; idle where the platform has no freedom there.

    Args:
        assembly: The mechanism.
        locus: Of one scheme.
        actuated: That scheme.
    """
    aside = freedoms_aside(assembly, actuated)
    ring = assembly.common_twists.ring
    written = partial(
        component_of, root=assembly.root(ring), library=assembly.library(ring)
    )
    held = [assembly.dimension - state.platform_freedom for state in locus.states]
    return tuple(
        (
            piece,
            written(
                piece,
                words=locus.meanings.each_of if locus.meanings else None,
                rank=rank,
                wrench_dimension=rank,
                platform_freedom=state.platform_freedom,
                mobility=state.mobility + aside,
            ),
        )
        for piece, state, rank in zip(locus.pieces, locus.states, held, strict=True)
    )
