"""What `schemes` answers: every actuation scheme of a size, admissible or why not."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.shown import Shown
from screwkit.results.singularities import Component
from screwkit.results.undecided import Undecided


@dataclass(frozen=True)
class Scheme:
    """One choice of actuated freedoms.

    Attributes:
        generic_rank: Of the global wrench system (constraint plus actuation).
        locus: The hypersurfaces on which it fails: irreducible factors common to all
            maximal minors of the passive twists.
        multiplicities: One per entry of ``locus``.
        idle: Those of ``locus`` on which a limb idles and the platform stays fixed.
        reason: Why it is never admissible; None for admissible schemes.
        balanced: The same number of freedoms from every limb.
        undecided: Whether ``locus`` was not found, or not all of it.
        deeper: Whether it may fail elsewhere too, where several conditions hold at
            once; false where ``locus`` is proved to be all.
        mirror: The scheme that the mechanism's symmetry maps this one to; empty where
            no symmetry is known.
    """

    actuated: tuple[str, ...]
    admissible: bool
    generic_rank: int
    locus: tuple[str, ...] = ()
    multiplicities: tuple[int, ...] = ()
    idle: tuple[str, ...] = ()
    reason: str | None = None
    balanced: bool = False
    undecided: bool = False
    deeper: bool = False
    mirror: tuple[str, ...] = ()


@dataclass(frozen=True)
class LocusFactor:
    """A factor that occurs in loci.

    Attributes:
        equation: Grammar text.
        meaning: In geometry's words; None where no sentence was found.
        terms: Number of terms of ``equation``.
        schemes: In how many loci it occurs.
    """

    equation: str
    meaning: str | None
    terms: int
    schemes: int


@dataclass(frozen=True)
class Balanced:
    """The schemes with the same number of actuated freedoms in every limb."""

    total: int
    admissible: int


@dataclass(frozen=True)
class MirrorClasses:
    """Schemes counted up to the mechanism's symmetry: (classes, self-mirror)."""

    joints: tuple[tuple[str, str], ...]
    total: tuple[int, int]
    admissible: tuple[int, int]
    balanced: tuple[int, int]
    balanced_admissible: tuple[int, int]


@dataclass(frozen=True)
class Refusal:
    """A reason shared by inadmissible schemes, and how many it explains."""

    reason: str
    schemes: int
    example: tuple[str, ...]


@dataclass(frozen=True)
class SampledRange:
    """Which values of a symbol postures were drawn from.

    Attributes:
        angle: Whether they are radians; else in the units of the file.
        given: Whether they were asked for; else the whole circle or a surrounding.
    """

    symbol: str
    start: float
    stop: float
    angle: bool
    given: bool


@dataclass(frozen=True)
class RankedScheme:
    """How well one admissible scheme drives the platform.

    Attributes:
        median: Of the index over the postures, 0 to 1; half of them are better.
        worst: The least of them.
    """

    actuated: tuple[str, ...]
    median: float
    worst: float


@dataclass(frozen=True)
class Ranking:
    """The admissible schemes, best conditioned first.

    The index of a scheme at a posture is the least singular value over the largest of
    the map from the platform's twists (ω; v/L) to the actuated rates, slides over L:
    1 where the platform moves equally fast in all its directions, 0 where the scheme
    fails or the platform has lost a freedom.

    Attributes:
        schemes: By descending median.
        postures: How many the numbers are taken over.
        undefined: Postures drawn at which the mechanism cannot be assembled; left out.
        seed: Of the random numbers.
        length: L, which counts as one radian, in the units of the file.
        length_given: Whether it was asked for; else it is the root mean square distance
            of the axes from the reference point.
        ranges: The symbols that differ between the postures; none where there is one
            posture, that of the file.
    """

    schemes: tuple[RankedScheme, ...]
    postures: int
    undefined: int
    seed: int
    length: float
    length_given: bool
    units: str
    ranges: tuple[SampledRange, ...] = ()


@dataclass(frozen=True)
class AddedActuators:
    """Actuators added to a scheme, and what is left of its singularities.

    Attributes:
        freedoms: Of the platform with these locked too, in general on each component.
    """

    actuators: tuple[str, ...]
    freedoms: tuple[int, ...]

    @property
    def suffices(self) -> bool:
        """Whether every component is removed in general."""
        return not any(self.freedoms)


@dataclass(frozen=True)
class Redundancy:
    """Which added actuators remove which singularities of one scheme.

    Attributes:
        admissible: Of the scheme; where it is not, the one component is the whole
            space, without equations.
        components: Where the platform moves with the scheme locked.
        single: What each further actuator does alone.
        pairs: Those that remove every component, where no single one does.
        pairs_asked: Whether no single one does.
        complete: Whether the components are proved to be all.
        reason: Why not, where not.
    """

    actuated: tuple[str, ...]
    admissible: bool
    components: tuple[Component, ...]
    single: tuple[AddedActuators, ...] = ()
    pairs: tuple[AddedActuators, ...] = ()
    pairs_asked: bool = False
    complete: bool = True
    reason: str = ""


@dataclass(frozen=True, repr=False)
class Schemes(Shown):
    """The answer of ``schemes``.

    Attributes:
        balanced: None when the size does not divide by the number of limbs.
        mirror: None where no symmetry was found.
        left_out: Parameters that divide determinants and cannot vanish.
        complete: Whether every locus was expanded and factored.
        reason: Why not, where not.
        one_posture: Whether the file describes one posture in numbers, so that the
            answer is about that posture and no other.
        redundancy: What added actuators do to the file's own scheme; None where not
            asked for.
        certificate: Text of one, or where it was written; None where not asked for.
        ranking: By conditioning over a set of postures; None where not asked for.
    """

    case: str
    title: str
    size: int
    total: int
    admissible: int
    balanced: Balanced | None
    schemes: tuple[Scheme, ...]
    factors: tuple[LocusFactor, ...] = ()
    refusals: tuple[Refusal, ...] = ()
    mirror: MirrorClasses | None = None
    left_out: tuple[str, ...] = ()
    complete: bool = True
    reason: str = ""
    one_posture: bool = False
    ranking: Ranking | Undecided | None = None
    redundancy: Redundancy | Undecided | None = None
    certificate: str | None = None
