"""What `singularities` answers: exact loci as irreducible components."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.shown import Shown
from screwkit.results.slice import SingularSlice
from screwkit.results.solution import Solution
from screwkit.results.strata import Strata
from screwkit.results.superbracket import Superbracket


@dataclass(frozen=True)
class DrivenCondition:
    """What loops that close on a component ask of the driven joint variables.

    Attributes:
        equation: Grammar text that vanishes.
        solved: The same solved for one of them, if that is known.
    """

    equation: str
    solved: Solution | None = None


@dataclass(frozen=True)
class Component:
    """An irreducible part of a singular locus.

    Attributes:
        equations: Grammar text; the component is where all of them vanish.
        codimension: In the space of the free symbols.
        solutions: Of the equations that can be solved for one variable.
        solved: One for each equation, None where it was not solved for a variable of
            its own; may be empty.
        rank: Of the matrix concerned, generic on the component.
        geometry: What happens there in words; None where no sentence was found.
        wrench_dimension: Of the platform's constraint wrenches (for actuation, with
            the actuated joints locked), generic on the component.
        platform_freedom: Dimension of the platform's twists there.
        mobility: Of the whole mechanism there.
        example: Where loops tie joint variables, these at a posture on the component
            that Newton's steps led to, the dimensions as in the file; empty where
            they led to none, None where it was not looked for.
    """

    equations: tuple[str, ...]
    codimension: int
    solutions: tuple[Solution, ...]
    rank: int
    geometry: str | None = None
    wrench_dimension: int | None = None
    platform_freedom: int | None = None
    mobility: int | None = None
    solved: tuple[Solution | None, ...] = ()
    example: tuple[tuple[str, float], ...] | None = None
    closes: tuple[DrivenCondition, ...] = ()


@dataclass(frozen=True)
class Intersection:
    """What happens where several components of one limb meet.

    Attributes:
        components: Their numbers, from 0, in the list of the limb.
        extra: Further equations that must vanish for this rank; may be empty.
    """

    components: tuple[int, ...]
    extra: tuple[str, ...]
    rank: int


@dataclass(frozen=True)
class LimbSingularities:
    """Where one limb's twist system loses rank.

    Attributes:
        complete: There is no other component: the search left out no case, and where a
            certificate was asked for, it carries a proof.
        proof: How it was searched, in words; empty where cases were left out.
        reason: Why it is not complete, as in ``uncertified`` where only the proof is
            missing; empty where it is.
        certified: Whether a certificate carries a proof of that, which `verify` checks
            from the mechanism alone; None where no certificate was asked for.
        uncertified: Why it carries none; where it does, what it does not show besides.
    """

    limb: str
    joints: tuple[str, ...]
    generic_rank: int
    complete: bool
    components: tuple[Component, ...]
    intersections: tuple[Intersection, ...] = ()
    proof: str = ""
    reason: str = ""
    certified: bool | None = None
    uncertified: str = ""


@dataclass(frozen=True)
class ConstraintSingularities:
    """Where the loop constraint matrix loses rank; fields as of a limb."""

    generic_rank: int
    complete: bool
    components: tuple[Component, ...]
    proof: str = ""
    reason: str = ""
    certified: bool | None = None
    uncertified: str = ""


@dataclass(frozen=True)
class ActuationSingularities:
    """Where, with the actuated joints locked, the platform can move.

    Attributes:
        admissible: Whether locking them stops the platform for generic values.
        idle: Where only a limb moves with the actuated joints locked.
        witness: For an inadmissible scheme: why.
        superbracket: Where six lines hold the platform: when they are dependent, by the
            points that they pass through.
        complete, reason, certified, uncertified: As of a limb.
    """

    actuated: tuple[str, ...]
    admissible: bool
    generic_rank: int
    complete: bool
    components: tuple[Component, ...]
    idle: tuple[Component, ...] = ()
    witness: str = ""
    reason: str = ""
    superbracket: Superbracket | None = None
    certified: bool | None = None
    uncertified: str = ""


@dataclass(frozen=True, repr=False)
class Singularities(Shown):
    """The answer of ``singularities``.

    Attributes:
        actuation: None where the file declares no actuated joint.
        assumptions: What the derivation took for granted, ``d3 > 0``.
        platform_name: What the file calls the platform, for sentences.
        one_posture: Whether the file describes one posture in numbers, so that the
            answer is about that posture and no other.
        certificate: The text of the certificate, or where it was written; None where
            none was asked for.
        slice: What was drawn of a slice of two symbols; the answer is then about the
            slice.
        strata: What happens where components meet; None where it was not asked for.
    """

    case: str
    title: str
    limb: tuple[LimbSingularities, ...]
    constraint: ConstraintSingularities
    actuation: ActuationSingularities | None
    assumptions: tuple[str, ...] = ()
    platform_name: str = ""
    one_posture: bool = False
    certificate: str | None = None
    slice: SingularSlice | None = None
    strata: Strata | None = None
