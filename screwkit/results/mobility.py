"""What `mobility` answers: the counts side by side, and the freedoms themselves."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.partition import Partition
from screwkit.results.shown import Shown


@dataclass(frozen=True)
class Topology:
    """The graph in numbers.

    Attributes:
        freedoms: Sum of the joint freedoms.
        independent_loops: joints − links + components.
    """

    links: int
    joints: int
    freedoms: int
    independent_loops: int
    components: int


@dataclass(frozen=True)
class Counts:
    """Mobility by each count; None where a count does not apply."""

    grubler: int
    grubler_planar: int | None
    moroskine: int
    gogu: int | None
    screw: int | None


@dataclass(frozen=True)
class Working:
    """How one count comes about: ``10 − rank Jc = 10 − 6`` and ``4``.

    Attributes:
        remark: Why it differs from the true mobility, or what was chosen; may be empty.
        equation: Citation key and equation number, for the report.
    """

    name: str
    formula: str
    value: int | None
    remark: str = ""
    equation: str = ""


@dataclass(frozen=True)
class MotionBranch:
    """One of the finite motions that meet at the posture.

    Attributes:
        mobility: Its dimension.
        instantaneous_mobility: Joint freedoms less loop rank at its points; above
            ``mobility`` where rank alone never tells the truth.
        motion_type: nTmR of the platform's twists at its points.
        finite_type: nTmR of the platform's twists along the branch, fewer where rank
            alone never tells the truth; empty where they are not known.
        couples: Pure couples among the platform's constraint wrenches there.
        motion: The finite motion of the platform in words; may be empty.
        starts: How many of the samples fell on it; 0 where none were needed.
        modes: How many branches look like this one from outside but differ in the
            joints that move.
        straight: Joints of the platform that run along a straight line though it turns.
    """

    mobility: int
    instantaneous_mobility: int
    loop_rank: int
    redundant_constraints: int
    motion_type: str
    couples: int = 0
    motion: str = ""
    starts: int = 0
    modes: int = 1
    finite_type: str = ""
    straight: tuple[str, ...] = ()


@dataclass(frozen=True)
class FullCycle:
    """Whether the instantaneous freedoms integrate to finite motion.

    Attributes:
        status: ``proved``, ``sampled`` or ``undecided``.
        mobility: Finite mobilities of the branches, ascending; empty if undecided.
        reason: The argument, or why it is open.
        branches: What was found on each branch, where it was looked at.
    """

    status: str
    mobility: tuple[int, ...]
    reason: str = ""
    branches: tuple[MotionBranch, ...] = ()


@dataclass(frozen=True)
class MotionCase:
    """A motion type of the platform and where it holds.

    Attributes:
        conditions: Equations (grammar text) that must all vanish; empty: in general.
        solutions: The same as readable conditions, ``q6 = q1 (mod pi)``; may be empty.
        reason: In words: ``the two constraint forces are skew``.
    """

    conditions: tuple[str, ...]
    solutions: tuple[str, ...]
    motion_type: str
    reason: str


@dataclass(frozen=True)
class PrincipalScrew:
    """A principal screw of a system, in numbers.

    Attributes:
        axis: Unit direction.
        point: A point of the axis; empty for pure translations or couples.
        pitch: None where infinite.
    """

    axis: tuple[float, ...]
    point: tuple[float, ...]
    pitch: float | None


@dataclass(frozen=True)
class MotionClass:
    """The class of a twist system, whatever basis it is given in.

    Attributes:
        name: ``Schönflies motion``, ``spherical motion``, ``general 2-system``, …
        description: One sentence.
        subgroup: Whether the system is closed under the bracket, so that it is the
            algebra of a group of displacements.
        principal: Principal screws, at numbers.
    """

    name: str
    description: str
    subgroup: bool
    principal: tuple[PrincipalScrew, ...] = ()


@dataclass(frozen=True)
class Platform:
    """The platform's freedoms and the constraint wrenches that leave them.

    Attributes:
        motion_type: nTmR; n translations, m = dimension − n.
        couples: Dimension of the subspace of pure couples among the wrenches.
        motion_class: The class of its twist system.
    """

    twist_dimension: int
    translations: int
    rotations: int
    motion_type: str
    wrench_dimension: int
    couples: int
    finite_motion_types: tuple[str, ...]
    cases: tuple[MotionCase, ...] = ()
    motion_class: MotionClass | None = None


@dataclass(frozen=True)
class Actuation:
    """What stays movable when the actuated joints are locked."""

    actuated: tuple[str, ...]
    remaining_mobility: int
    remaining_platform_freedom: int


@dataclass(frozen=True)
class CarriedWrench:
    """What joints in series transmit while a redundant constraint is prestressed.

    Attributes:
        joints: Names of the joints.
        limb: The limb they belong to; empty where they belong to none.
        kind: ``force``, ``couple`` or ``screw``.
        coordinates: (f; m) about the base origin as texts; empty where the posture is
            not given in numbers.
        description: ``a force along [0, 0, 1] through [1, 2, 0]``; may be empty.
    """

    joints: tuple[str, ...]
    limb: str
    kind: str
    coordinates: tuple[str, ...] = ()
    description: str = ""


@dataclass(frozen=True)
class AddedFreedom:
    """A joint freedom that would remove a redundant constraint.

    Attributes:
        kind: ``rotation`` or ``translation``.
        axis: Its direction, as texts.
        point: A point of a rotation's axis.
    """

    joint: str
    kind: str
    axis: tuple[str, ...]
    point: tuple[str, ...] = ()
    description: str = ""


@dataclass(frozen=True)
class Redundancy:
    """One constraint that follows from the others: a state of self-stress.

    Attributes:
        carried: Who transmits what; together they balance.
        removed_by: Freedoms each of which alone would remove it.
        description: One sentence.
    """

    carried: tuple[CarriedWrench, ...]
    removed_by: tuple[AddedFreedom, ...]
    description: str = ""


@dataclass(frozen=True)
class RemainingFreedom:
    """One of the freedoms that the closed loops leave.

    Attributes:
        idle: Whether the platform stays at rest.
        joints: The freedoms that turn or slide, as written in schemes.
        bodies: The bodies that move.
        kind: ``rotation``, ``translation`` or ``screw``; of the platform, or of the
            bodies that move where they all move alike; empty otherwise.
        axis: Direction, as texts; empty where the posture is not given in numbers.
        point: A point of the axis.
        pitch: ``"0"`` for rotations, empty for translations.
        description: One sentence.
    """

    idle: bool
    joints: tuple[str, ...]
    bodies: tuple[str, ...]
    kind: str = ""
    axis: tuple[str, ...] = ()
    point: tuple[str, ...] = ()
    pitch: str = ""
    description: str = ""


@dataclass(frozen=True)
class Connectivity:
    """The freedom of every body relative to every other.

    Attributes:
        bodies: Row and column headings.
        table: Dimension of the relative twist system; 6 between bodies that nothing
            connects (3 in planar files).
    """

    bodies: tuple[str, ...]
    table: tuple[tuple[int, ...], ...]


@dataclass(frozen=True)
class SpecialValues:
    """The answer again at the values that the file gives to its symbols.

    Or at the posture of the file, where the whole answer is that on the motion.

    Attributes:
        differences: One sentence per number that differs from the generic answer.
        redundancies: By name, where the whole answer has none because it is that on
            the motion.
        remaining_freedoms: The same of what is free.
    """

    loop_rank: int
    redundant_constraints: int
    instantaneous_mobility: int
    platform: Platform
    actuation: Actuation | None
    full_cycle: FullCycle
    differences: tuple[str, ...] = ()
    redundancies: tuple[Redundancy, ...] = ()
    remaining_freedoms: tuple[RemainingFreedom, ...] = ()


@dataclass(frozen=True)
class AtPosture:
    """The answer at a posture to which the mechanism was moved, in floating point.

    Attributes:
        closed: Whether the posture was reached; the numbers hold only then.
        reason: Why it was not reached, or why a rank is unclear; else empty.
        variables: Names of the joint variables, in the order of ``values``.
        values: In radians and file lengths, from the posture of the file.
        gap: Smallest ratio of singular values that count to those that do not; None
            where none is small.
    """

    closed: bool
    reason: str
    variables: tuple[str, ...]
    values: tuple[float, ...]
    loop_rank: int
    redundant_constraints: int
    instantaneous_mobility: int
    motion_type: str
    couples: int
    remaining_mobility: int | None = None
    remaining_platform_freedom: int | None = None
    gap: float | None = None


@dataclass(frozen=True, repr=False)
class Mobility(Shown):
    """The answer of ``mobility``; ranks are exact and generic over the free symbols.

    Attributes:
        platform_name: What the file calls the platform, for sentences.
        redundancies: The redundant constraints by name: as many as
            ``redundant_constraints`` unless ``unnamed`` says why not.
        remaining_freedoms: What is free: as many as ``instantaneous_mobility``.
        unnamed: Why redundancies or freedoms are not listed; else empty.
        connectivity: None where there are too many bodies for a table.
        loose_bodies: Bodies that no joint connects with the base.
        generic: Whether the answer holds for generic values of free symbols; else it
            holds at the posture of the file.
        on_motion: Whether the posture of the file is special, so that the answer holds
            on the motion through it, of several on that of the first branch; what
            holds at the posture is in ``at_values``.
        at_posture: The answer where ``--at`` asked the mechanism to be moved.
    """

    case: str
    title: str
    topology: Topology
    counts: Counts
    workings: tuple[Working, ...]
    loop_rank: int
    redundant_constraints: int
    instantaneous_mobility: int
    full_cycle: FullCycle
    platform: Platform
    actuation: Actuation | None
    partition: Partition
    at_values: SpecialValues | None = None
    platform_name: str = ""
    redundancies: tuple[Redundancy, ...] = ()
    remaining_freedoms: tuple[RemainingFreedom, ...] = ()
    unnamed: str = ""
    connectivity: Connectivity | None = None
    loose_bodies: tuple[str, ...] = ()
    generic: bool = True
    on_motion: bool = False
    at_posture: AtPosture | None = None
