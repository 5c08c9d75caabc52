"""What `mobility` answers: the counts side by side, and the freedoms themselves."""

from __future__ import annotations

from dataclasses import dataclass


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
class FullCycle:
    """Whether the instantaneous freedoms integrate to finite motion.

    Attributes:
        status: ``proved``, ``sampled`` or ``undecided``.
        mobility: Finite mobilities of the branches, ascending; empty if undecided.
        reason: The argument, or why it is open.
    """

    status: str
    mobility: tuple[int, ...]
    reason: str = ""


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
class Platform:
    """The platform's freedoms and the constraint wrenches that leave them.

    Attributes:
        motion_type: nTmR; n translations, m = dimension − n.
        couples: Dimension of the subspace of pure couples among the wrenches.
    """

    twist_dimension: int
    translations: int
    rotations: int
    motion_type: str
    wrench_dimension: int
    couples: int
    finite_motion_types: tuple[str, ...]
    cases: tuple[MotionCase, ...] = ()


@dataclass(frozen=True)
class Actuation:
    """What stays movable when the actuated joints are locked."""

    actuated: tuple[str, ...]
    remaining_mobility: int
    remaining_platform_freedom: int


@dataclass(frozen=True)
class Partition:
    """Mobility, connectivity, redundancy and indeterminacy [BicchiMelchiorri]."""

    mobility: int
    connectivity: int
    redundancy: int
    indeterminacy: int


@dataclass(frozen=True)
class SpecialValues:
    """The answer again at the values that the file gives to its symbols.

    Attributes:
        differences: One sentence per number that differs from the generic answer.
    """

    loop_rank: int
    redundant_constraints: int
    instantaneous_mobility: int
    platform: Platform
    actuation: Actuation | None
    full_cycle: FullCycle
    differences: tuple[str, ...] = ()


@dataclass(frozen=True)
class Mobility:
    """The answer of ``mobility``; ranks are exact and generic over the free symbols.

    Attributes:
        platform_name: What the file calls the platform, for sentences.
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
