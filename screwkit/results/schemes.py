"""What `schemes` answers: every actuation scheme of a size, admissible or why not."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.shown import Shown


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
