"""What `reach` answers: configurations that bring the platform where it is wanted."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.manipulability import Manipulability
from screwkit.results.shown import Shown


@dataclass(frozen=True)
class TurnedBody:
    """A body and the rotation vector by which it is turned, in base axes."""

    body: str
    turn: tuple[float, float, float]


@dataclass(frozen=True, repr=False)
class Reach(Shown):
    """The answer.

    Attributes:
        point: Where the reference point is wanted, in base coordinates; empty where it
            is free.
        turned: Bodies of given orientation, turned from the posture of the file.
        joint_variables: Those whose values tell configurations apart.
        configurations: The nearest to the posture of the file first; their values of
            joint variables are in ``posture``.
        spare: Actuated freedoms that could still move; where there are some, the
            configuration is one of infinitely many.
        starts: From how many postures configurations were looked for.
    """

    case: str
    title: str
    platform_name: str
    point: tuple[float, ...]
    turned: tuple[TurnedBody, ...]
    joint_variables: tuple[str, ...]
    configurations: tuple[Manipulability, ...]
    spare: int
    starts: int
