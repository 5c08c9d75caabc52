"""Redundant actuation of limbs: which added actuators remove which singularities.

References: [Merlet1989] (singularities of an actuated platform), [Schwartz1980].
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.analyses.actuation_parts import actuation_parts
from screwkit.analyses.added_actuators import FreedomAt, Place, everywhere, with_added
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.actuation import actuation_locus, passive_joints
from screwkit.loci.passive import PassiveSystem, Ranks
from screwkit.results.schemes import Redundancy
from screwkit.results.singularities import ActuationSingularities


def redundancy(
    assembly: Assembly, actuated: Sequence[str], candidates: Sequence[str]
) -> Redundancy:
    """What one added actuator does, and two where none alone suffices.

    Args:
        assembly: The mechanism.
        actuated: The scheme.
        candidates: Freedoms that may be actuated too.
    """

    def freedom(table: Ranks) -> FreedomAt:
        return lambda locked: (
            table.state(passive_joints(assembly, locked)).platform_freedom
        )

    system = PassiveSystem(assembly)
    locus = actuation_locus(assembly, actuated)
    answer = ActuationSingularities(
        tuple(actuated),
        locus.admissible,
        assembly.dimension - locus.platform_freedom,
        locus.complete,
        (),
        witness=locus.witness,
        reason=locus.reason,
    )
    places: list[Place] = []
    if not locus.admissible:
        generic = [freedom(table) for table in system.generic]
        places.append(everywhere(answer, assembly.dimension, [generic]))
    parts = actuation_parts(assembly, locus, actuated)
    for piece, component in sorted(parts, key=lambda part: part[1].codimension):
        sheets = [
            [freedom(system.table_at(*point)) for point in branch.points]
            for branch in piece.branches
            if branch.points
        ]
        if component.platform_freedom and sheets:
            places.append(Place(component, sheets))
    return with_added(answer, places, candidates)
