"""What added actuators do on the components of a scheme's singularities.

On a component the platform can move with the scheme locked.  An added actuator removes
the component if, locked too, it leaves the platform no freedom at an exact point of
each of its sheets: then there is none in general on it.

References: [Merlet1989] (singularities of an actuated platform), [Schwartz1980].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import combinations
from typing import NamedTuple, TypeAlias

from screwkit.results.schemes import AddedActuators, Redundancy
from screwkit.results.singularities import ActuationSingularities, Component

FreedomAt: TypeAlias = Callable[[Sequence[str]], int]
"""The platform's freedom at one exact point, by what is locked."""

Sheets: TypeAlias = Sequence[Sequence[FreedomAt]]
"""Of the exact points of each sheet of a component."""


class Place(NamedTuple):
    """A component on which the platform moves, and its points."""

    component: Component
    sheets: Sheets

    def freedom(self, locked: Sequence[str]) -> int:
        """In general on it: on the sheet where it is largest.

        Points of one sheet differ only if it has parts that no factor showed; then too
        nothing is removed that stays on one of them.
        """
        return max(at(locked) for sheet in self.sheets for at in sheet)


def everywhere(answer: ActuationSingularities, size: int, sheets: Sheets) -> Place:
    """All postures, at which the scheme leaves the platform some freedom.

    Args:
        answer: Of a scheme that is not admissible.
        size: Coordinates of a twist.
        sheets: Random postures.
    """
    rank = answer.generic_rank
    return Place(Component((), 0, (), rank, answer.witness, rank, size - rank), sheets)


def with_added(
    answer: ActuationSingularities, places: Sequence[Place], candidates: Sequence[str]
) -> Redundancy:
    """What one added actuator does, and two where none alone suffices.

    Args:
        answer: Singularities of the scheme.
        places: Its components with points, all postures if it is not admissible.
        candidates: Freedoms that may be actuated too.
    """
    actuated = answer.actuated
    free = [joint for joint in candidates if joint not in actuated]

    def effect(added: tuple[str, ...]) -> AddedActuators:
        locked = (*actuated, *added)
        return AddedActuators(added, tuple(place.freedom(locked) for place in places))

    single = [effect((joint,)) for joint in free] if places else []
    pairs: list[AddedActuators] = []
    asked = bool(places) and not any(one.suffices for one in single)
    if asked and max(place.component.platform_freedom or 0 for place in places) <= 2:
        for one, other in combinations(single, 2):
            pair = (*one.actuators, *other.actuators)
            alone = zip(places, one.freedoms, other.freedoms, strict=True)
            # Who is held by one of them is held by both.
            if all(
                0 in rest or not place.freedom((*actuated, *pair))
                for place, *rest in alone
            ):
                pairs.append(AddedActuators(pair, (0,) * len(places)))
    return Redundancy(
        actuated=tuple(actuated),
        admissible=answer.admissible,
        components=tuple(place.component for place in places),
        single=tuple(single),
        pairs=tuple(pairs),
        pairs_asked=asked,
        complete=answer.complete,
        reason=answer.reason,
    )
