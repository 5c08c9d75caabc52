"""Redundant actuation: which added actuators remove which singularities of a scheme.

On a component of the actuation locus the platform can move with the scheme locked.  An
added actuator removes the component if, locked too, it leaves the platform no freedom
at an exact point of each of its sheets: then there is none in general on it.

References: [Merlet1989] (singularities of an actuated platform), [Schwartz1980].
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

from screwkit.analyses.actuation_parts import actuation_parts
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.actuation import actuation_locus, passive_joints
from screwkit.loci.passive import PassiveSystem, Ranks
from screwkit.results.schemes import AddedActuators, Redundancy
from screwkit.results.singularities import Component

Sheets = Sequence[Sequence[Ranks]]
"""Ranks at the exact points of each sheet of a component."""


def redundancy(
    assembly: Assembly, actuated: Sequence[str], candidates: Sequence[str]
) -> Redundancy:
    """What one added actuator does, and two where none alone suffices.

    Args:
        assembly: The mechanism, its limbs serial chains.
        actuated: The scheme.
        candidates: Freedoms that may be actuated too.
    """
    system = PassiveSystem(assembly)
    locus = actuation_locus(assembly, actuated)
    places: list[Sheets] = []
    components: list[Component] = []
    if not locus.admissible:
        places.append([list(system.generic)])
        components.append(
            Component(
                (),
                0,
                (),
                assembly.dimension - locus.platform_freedom,
                locus.witness,
                assembly.dimension - locus.platform_freedom,
                locus.platform_freedom,
            )
        )
    parts = actuation_parts(locus, assembly.dimension)
    for piece, component in sorted(parts, key=lambda part: part[1].codimension):
        sheets = [
            [system.table_at(*point) for point in branch.points]
            for branch in piece.branches
        ]
        if component.platform_freedom and any(sheets):
            places.append([sheet for sheet in sheets if sheet])
            components.append(component)
    free = [joint for joint in candidates if joint not in actuated]

    def effect(added: tuple[str, ...]) -> AddedActuators:
        passive = passive_joints(assembly, (*actuated, *added))
        return AddedActuators(added, tuple(_freedom(p, passive) for p in places))

    single = [effect((joint,)) for joint in free] if places else []
    pairs: list[AddedActuators] = []
    asked = bool(places) and not any(one.suffices for one in single)
    if asked and max(c.platform_freedom or 0 for c in components) <= 2:
        for one, other in combinations(single, 2):
            pair = (*one.actuators, *other.actuators)
            passive = passive_joints(assembly, (*actuated, *pair))
            alone = zip(places, one.freedoms, other.freedoms, strict=True)
            # Who is held by one of them is held by both.
            if all(
                0 in rest or not _freedom(sheets, passive) for sheets, *rest in alone
            ):
                pairs.append(AddedActuators(pair, (0,) * len(places)))
    return Redundancy(
        actuated=tuple(actuated),
        admissible=locus.admissible,
        components=tuple(components),
        single=tuple(single),
        pairs=tuple(pairs),
        pairs_asked=asked,
        complete=locus.complete,
        reason=locus.reason,
    )


def _freedom(sheets: Sheets, passive: Sequence[str]) -> int:
    """Of the platform in general on a component: on the sheet where it is largest."""
    return max(
        min(table.state(passive).platform_freedom for table in sheet)
        for sheet in sheets
    )
