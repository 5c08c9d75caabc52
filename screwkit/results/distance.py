"""How far a posture is from the nearest singularity of each kind."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.shown import Shown
from screwkit.results.singularities import Component


@dataclass(frozen=True)
class DistanceMeasure:
    """What a distance is: the root of a sum of squares.

    Attributes:
        platform: Whether the pose of the platform is measured: the angle of one
            rotation, and the shift of its origin over ``length``.
        angles: Symbols or freedoms whose change in radians is squared.
        lengths: Those whose change is first divided by ``length``.
        pose: Symbols that are measured by the pose that they give.
        length: That counts as one radian, in file lengths; None where no length occurs.
        given: Whether the length was given, not chosen.
        unit: Of lengths in the file.
    """

    platform: bool
    angles: tuple[str, ...]
    lengths: tuple[str, ...]
    pose: tuple[str, ...]
    length: float | None
    given: bool
    unit: str


@dataclass(frozen=True)
class NearestPosture:
    """A singular posture, and how far it is.

    Attributes:
        distance: By the measure of the answer.
        exact: The distance as a closed expression, where it is known exactly.
        values: Of the variables of the answer, or of the ``freedoms`` where they are
            measured.
        connected: Whether a way along the motion from the posture to it is known.
        rank: Of the matrix concerned, there.
        platform_freedom: Dimension of the platform's twists there, with the actuated
            joints locked where actuation is asked about.
        gap: Ratio of the least singular value that counts to the next; None where all
            count.
    """

    distance: float
    exact: str
    values: tuple[float, ...]
    connected: bool
    rank: int
    platform_freedom: int
    gap: float | None


@dataclass(frozen=True)
class SingularityDistance:
    """One singularity: a component, or all of a kind together.

    Attributes:
        kind: ``limb``, ``constraint`` or ``actuation``.
        limb: Its name; empty for the other kinds.
        number: Of the component as `singularities` numbers it; None where ranks alone
            were looked at.
        component: Its equations and what they mean; None where ranks alone were.
        generic_rank: Of the matrix concerned, in general.
        nearest: None where no posture was found.
        starts: From how many postures the nearest was looked for; 0 where it is exact.
        by_freedoms: Whether ``values`` are of the freedoms and not of the variables.
        reason: Why there is no posture, or what is not clear about it.
        met: How many of these led to the distance; 0 where it is exact or none.
    """

    kind: str
    limb: str
    number: int | None
    component: Component | None
    generic_rank: int
    nearest: NearestPosture | None
    starts: int
    by_freedoms: bool = False
    reason: str = ""
    met: int = 0


@dataclass(frozen=True)
class Within:
    """The limits of a variable, or of how far a freedom moves from the posture.

    Attributes:
        name: Of a variable or a freedom of the answer.
        low: In radians or file lengths.
        high: The same.
    """

    name: str
    low: float
    high: float


@dataclass(frozen=True, repr=False)
class Distance(Shown):
    """The answer of ``singularities --distance``.

    Attributes:
        variables: The symbols that move the mechanism; empty where its joints are
            measured alone.
        posture: Their values where distances begin, in radians and file lengths.
        freedoms: All freedoms, whose coordinates count from the posture; empty where
            none is measured.
        measure: Of distances by variables; None without any.
        by_freedoms: Of distances by freedoms; None where none is measured.
        singularities: Components in their order, then the kinds looked at by ranks.
        remarks: What the answer leaves out, in sentences.
        within: Limits; a singularity outside them does not count.
        unfinished: What was not looked at yet, as words, where time ran out.
    """

    case: str
    title: str
    platform_name: str
    variables: tuple[str, ...]
    posture: tuple[float, ...]
    freedoms: tuple[str, ...]
    measure: DistanceMeasure | None
    by_freedoms: DistanceMeasure | None
    singularities: tuple[SingularityDistance, ...]
    remarks: tuple[str, ...] = ()
    within: tuple[Within, ...] = ()
    unfinished: tuple[str, ...] = ()
