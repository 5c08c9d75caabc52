"""A mechanism as frozen data: links, joints, geometry, and what is asked of it.

The model holds what a file says and nothing that follows from it.  Names are unique
and every reference resolves: `mechanism.files` refuses anything else.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from fractions import Fraction
from functools import cached_property
from typing import Any, Literal, TypeAlias

from screwkit.algebra.expression import ZERO, Expression, Symbol
from screwkit.mechanism.requirements import Requirement

VectorExpression: TypeAlias = tuple[Expression, Expression, Expression]
Space: TypeAlias = Literal["spatial", "planar"]
Geometry: TypeAlias = Literal["posture", "reference", "mdh"]


class JointType(StrEnum):
    """The joints and contacts of the file format."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    HELICAL = "helical"
    CYLINDRICAL = "cylindrical"
    UNIVERSAL = "universal"
    SPHERICAL = "spherical"
    PLANAR = "planar"
    FIXED = "fixed"
    POINT = "point"
    HARD_FINGER = "hard_finger"
    SOFT_FINGER = "soft_finger"
    LINE = "line"
    LINE_FRICTION = "line_friction"
    PLANE = "plane"
    COMPLETE = "complete"


@dataclass(frozen=True)
class Parameter:
    """A symbol of the file that is no joint variable.

    Attributes:
        value: For numbers and pictures; None where the file gives none.
        positive: Assumed > 0 in every derivation.
        nonzero: Assumed ≠ 0 (implied by ``positive``).
        angle: Declared as an angle (``variables: {phi: {angle: true}}``).
        free: Declared under ``variables``, not under ``parameters``.
    """

    name: str
    value: Expression | None = None
    positive: bool = False
    nonzero: bool = False
    angle: bool = False
    free: bool = False


@dataclass(frozen=True)
class MdhRow:
    """Modified Denavit-Hartenberg parameters of a joint [KhalilKleinfinger1986].

    The transform from the antecedent's frame is
    rot_z(gamma) trans_z(b) rot_x(alpha) trans_x(d) rot_z(theta) trans_z(r).
    """

    gamma: Expression = ZERO
    b: Expression = ZERO
    alpha: Expression = ZERO
    d: Expression = ZERO
    theta: Expression = ZERO
    r: Expression = ZERO


@dataclass(frozen=True)
class Joint:
    """One joint or contact; its motion is that of ``child`` relative to ``parent``.

    Attributes:
        variables: One name per freedom, in the order of interface.md.
        offsets: One per freedom; the angle or length used is variable + offset.
        actuated: The actuated freedoms, from 0, ascending.
        mdh: The row of an ``mdh`` file; None for joints that carry none.
        axes: Directions: one for R P H C, two for U (in parent, in child).
        point: A point of the axis, the centre, or the contact point.
        normal: Common normal of a contact or of a planar joint.
        sides: Two directions at right angles to each other and to a normal that moves
            with the posture, zero nowhere; None where the normal does not move, or none
            are known.
        line: Line of contact.
        pitch: Advance per radian of a helical joint.
        held: The value at which each variable is held, None where it is free; empty
            where all are.
    """

    name: str
    type: JointType
    parent: str
    child: str
    variables: tuple[str, ...] = ()
    offsets: tuple[Expression, ...] = ()
    actuated: tuple[int, ...] = ()
    mdh: MdhRow | None = None
    axes: tuple[VectorExpression, ...] = ()
    point: VectorExpression | None = None
    normal: VectorExpression | None = None
    sides: tuple[VectorExpression, VectorExpression] | None = None
    line: VectorExpression | None = None
    pitch: Expression | None = None
    held: tuple[Expression | None, ...] = ()


@dataclass(frozen=True)
class Claim:
    """One expected value of a case.

    Attributes:
        question: Dotted path into the JSON results, ``mobility.loop_rank``; positions
            in lists are numbers from 0, and ``#word`` tells claims on one path apart.
        value: Plain data as written in the file.
        status: ``published``, ``derived`` or ``regression``.
        source: Where the value comes from, or the argument for it.
        holds: False for a printed value that does not hold; ``note`` says what does.
        tolerance: Relative, for numbers; 0 where the value is exact.
    """

    question: str
    value: Any
    status: str
    source: str
    holds: bool = True
    note: str = ""
    tolerance: float = 0.0


@dataclass(frozen=True)
class Variant:
    """The same mechanism at other values of its symbols.

    Attributes:
        name: What `load` and the commands call it.
        title: In words; the name where the file gives none.
        values: Closed expressions that replace those of the parameters.
        claims: In the place of the file's own.
    """

    name: str
    title: str
    values: Mapping[str, Expression]
    claims: tuple[Claim, ...] = ()


@dataclass(frozen=True)
class Demand:
    """What must hold at every value of the symbols, also at those from outside.

    Attributes:
        where: What of the file demands it, ``joint 'A', axis``.
    """

    where: str
    requirement: Requirement


@dataclass(frozen=True)
class Pose:
    """The platform's frame in that of the base, in a ``posture`` file.

    Attributes:
        translation: The platform's origin.
        rotation: Rows of the matrix that takes platform to base coordinates.
    """

    translation: VectorExpression
    rotation: tuple[VectorExpression, VectorExpression, VectorExpression]


@dataclass(frozen=True)
class Mechanism:
    """Everything that a mechanism file declares, resolved and checked.

    Attributes:
        parameters: Declared under ``parameters``, then under ``variables``.
        limb_names: The joints of each named limb, as the file lists them.
        points: Named points in base coordinates, the pose already applied.
        vectors: Named vectors in base coordinates, the pose already applied.
        weights: Full matrices by key (``twist``, ``rates`` …), as rows.
        scheme_order: The actuated freedoms in the order in which the file lists them;
            the order of the weights.
        known_for: What the mechanism is known for, in one line.
        variants: The same mechanism at other values, as the file lists them.
        written: Values as the file writes them, in which other symbols may occur.
        demands: What depends on symbols and must hold at their values.
    """

    name: str
    title: str
    base: str
    platform: str
    links: tuple[str, ...]
    joints: tuple[Joint, ...]
    geometry: Geometry
    space: Space = "spatial"
    source: str = ""
    units: str = ""
    parameters: tuple[Parameter, ...] = ()
    limb_names: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    claims: tuple[Claim, ...] = ()
    reference_point: VectorExpression | None = None
    points: Mapping[str, VectorExpression] = field(default_factory=dict)
    vectors: Mapping[str, VectorExpression] = field(default_factory=dict)
    pose: Pose | None = None
    weights: Mapping[str, tuple[tuple[Expression, ...], ...]] = field(
        default_factory=dict
    )
    scheme_order: tuple[str, ...] = ()
    known_for: str = ""
    variants: tuple[Variant, ...] = ()
    written: Mapping[str, Expression] = field(default_factory=dict)
    demands: tuple[Demand, ...] = ()

    def joint(self, name: str) -> Joint:
        """The joint of that name.

        Raises:
            KeyError: If there is none.
        """
        return self._by_name[name]

    @cached_property
    def _by_name(self) -> Mapping[str, Joint]:
        return {joint.name: joint for joint in self.joints}

    @property
    def joint_variables(self) -> tuple[str, ...]:
        """All joint variables, joint by joint."""
        return tuple(name for joint in self.joints for name in joint.variables)

    @property
    def actuated(self) -> tuple[str, ...]:
        """The declared scheme, each freedom as in `freedom_label`."""
        return tuple(
            freedom_label(joint, index)
            for joint in self.joints
            for index in joint.actuated
        )


def variable_value(joint: Joint, index: int) -> Expression:
    """The variable of a freedom as an expression: its symbol, or what it is held at."""
    held = joint.held[index] if joint.held else None
    return Symbol(joint.variables[index]) if held is None else held


def freedom_label(joint: Joint, index: int) -> str:
    """How a freedom is written: ``name``, or ``name:k`` where a joint has several."""
    return joint.name if len(joint.variables) == 1 else f"{joint.name}:{index}"


def exact_value(parameter: Parameter) -> Fraction | None:
    """The value of a parameter where it is a plain rational."""
    value = parameter.value
    return getattr(value, "value", None) if value is not None else None
