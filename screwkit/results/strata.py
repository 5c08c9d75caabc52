"""What happens where several conditions of singularities hold together."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from screwkit.results.solution import Solution

Part: TypeAlias = Literal["limb", "constraint", "actuation"]


@dataclass(frozen=True)
class Member:
    """A component of the answer that a stratum lies on.

    Attributes:
        part: Whose locus it belongs to.
        limb: Name of the limb; empty for the other parts.
        component: Its number, from 0, in the list of that part.
    """

    part: Part
    limb: str
    component: int


@dataclass(frozen=True)
class PlatformState:
    """What holds the platform, and what it can do.

    Attributes:
        limb_ranks: Dimension of the twists that each limb alone allows the platform,
            in the order of the answer.
        wrench_dimension: Of the platform's constraint wrenches.
        platform_freedom: Dimension of its twists.
        motion_type: Of these, nTmR: translations, and the rest.
        mobility: Of the whole mechanism.
        locked_freedom: Of the platform with the actuated joints locked; None where no
            joint is actuated.
    """

    limb_ranks: tuple[int, ...]
    wrench_dimension: int
    platform_freedom: int
    motion_type: str
    mobility: int
    locked_freedom: int | None


@dataclass(frozen=True)
class ExpectedState:
    """What the conditions of a stratum suggest, each taken alone.

    Each limb has the least rank that one of them gives it, or the largest where none
    takes a freedom from it (loops inside it may give it some); the constraints of the
    limbs depend on each other as much as on one of them, and the locked platform keeps
    as much freedom as on one of them, at most.
    """

    limb_ranks: tuple[int, ...]
    wrench_dimension: int
    platform_freedom: int
    locked_freedom: int | None


@dataclass(frozen=True)
class Stratum:
    """An irreducible set on which all its members hold.

    Attributes:
        members: All components that it lies on.
        itself: Those of them that are this very set.
        around: The widest of them that are not the set itself, one of each; empty
            where the stratum is a component that lies on no other.
        equations: All vanish on the stratum; where they do on another one of the list,
            too, which it does not contain, this one is the rest.
        extra: Those that are no equation of what is around it; empty where it is a
            component itself.
        solved: For each equation a solution, None where there is none.
        codimension: In the space of the free symbols; where loops tie joint variables,
            among closed postures, by tangents: it may be more.
        state: Generic on it.
        expected: None where nothing is around it.
        differs: Whether ``state`` is not what is ``expected``.
        holds: ``everywhere``: the state is proved the same at all its postures;
            ``generally``: at some it is not; ``undecided``: not known.
        real: ``proved``: there is a real posture; ``met``: Newton's steps led to one,
            where loops tie joint variables; ``undecided``: none was found.
        posture: One, in numbers, with the dimensions it was found for.
    """

    members: tuple[Member, ...]
    itself: tuple[Member, ...]
    around: tuple[Member, ...]
    equations: tuple[str, ...]
    extra: tuple[str, ...]
    solved: tuple[Solution | None, ...]
    codimension: int
    state: PlatformState
    expected: ExpectedState | None
    differs: bool
    holds: Literal["everywhere", "generally", "undecided"]
    real: Literal["proved", "met", "undecided"]
    posture: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True)
class Strata:
    """The components and where they meet.

    Attributes:
        together: Sets of up to so many components were intersected.
        deepest: Intersections up to this codimension were looked for; all there are
            where loops tie joint variables.
        generic: At generic postures.
        strata: Those with nothing around them first, then by increasing codimension.
        complete: Whether every intersection of so many of the listed components that
            exists is among ``strata``.
        reason: Why not; empty where it is.
    """

    together: int
    deepest: int
    generic: PlatformState
    strata: tuple[Stratum, ...]
    complete: bool
    reason: str = ""
