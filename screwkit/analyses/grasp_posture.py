"""The posture at which manipulability is asked for, exact where it can be.

Symbols take the values of the file, joint variables that nothing ties are 0 unless
they are held elsewhere.  A table that is closed nowhere exact, and a motion that loops
take along, leave numbers only.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from screwkit.algebra.expression import ONE, ZERO, Expression
from screwkit.algebra.expression_building import multiply, quotient
from screwkit.analyses.moved import closed_table
from screwkit.analyses.partition import GraspPair
from screwkit.errors import UndecidedError
from screwkit.finite.moved_posture import Arrival, arrival_at
from screwkit.grasping.exact_grasp import Ranks, exact_grasps
from screwkit.grasping.matrices import GraspMatrices
from screwkit.grasping.symbolic_blocks import GraspFamily
from screwkit.kinematics.exact_postures import at_zero
from screwkit.kinematics.network import Network
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.graph import holding_joints
from screwkit.mechanism.joints import is_actuable
from screwkit.mechanism.model import Joint, JointType, Mechanism, freedom_label
from screwkit.metrics.float_grasp import float_matrices, float_values
from screwkit.metrics.posture_grasp import grasp_on_arrival
from screwkit.results.manipulability import PostureNote


@dataclass(frozen=True)
class GraspPosture:
    """A grasp ready to be measured.

    Attributes:
        symbolic: The mechanism with its symbols, its scheme completed.
        mechanism: With numbers for all of them.
        matrices: J and Gᵀ in floats.
        pair: The grasp modulo two primes; None where the posture is no exact one.
        all_actuated: Whether the file declares no scheme.
        variables: Values of symbols and joint variables.
        arrival: The motion that led there; None where the posture is an exact one.
    """

    symbolic: Mechanism
    mechanism: Mechanism
    matrices: GraspMatrices[Any]
    pair: GraspPair | None
    all_actuated: bool
    variables: Mapping[str, float]
    arrival: Arrival | None = None

    @property
    def ranks(self) -> Ranks | None:
        """Exact, or None."""
        return None if self.pair is None else self.pair.grasps[0].ranks

    @cached_property
    def family(self) -> GraspFamily | None:
        """The grasp for all values of the symbols; None where there are none.

        Where loops tie joint variables together these stay 0, and a table, whose
        closing depends on its parameters, is no family.
        """
        mechanism = self.symbolic
        if self.pair is None:
            return None
        if why_tied(mechanism):
            if mechanism.geometry != "reference":
                return None
            mechanism = at_zero(mechanism)
        free = mechanism.geometry != "posture"
        if mechanism.parameters or (free and mechanism.joint_variables):
            return GraspFamily(mechanism, exact_grasps(mechanism, (1,))[0])
        return None

    def note(self, gap: float | None) -> PostureNote:
        """The posture as the answer gives it."""
        return PostureNote(
            tuple(self.variables), tuple(self.variables.values()), gap is None, gap
        )


@dataclass(frozen=True)
class NumericMechanism:
    """A mechanism with all its numbers, before it stands anywhere.

    Attributes:
        symbolic: With its symbols, its scheme completed.
        numbers: With numbers for them.
        all_actuated: Whether the file declares no scheme.
        variables: Values of symbols.
        start: The closed posture of a table that is not closed at 0; None elsewhere.
    """

    symbolic: Mechanism
    numbers: Mechanism
    all_actuated: bool
    variables: Mapping[str, float]
    start: Mapping[str, float] | None

    def arrived(self, there: Arrival) -> GraspPosture:
        """The grasp where a motion ended, known in floating point alone."""
        matrices = grasp_on_arrival(self.numbers, there)
        variables = {**self.variables, **there.values}
        return GraspPosture(
            self.symbolic,
            self.numbers,
            matrices,
            None,
            self.all_actuated,
            variables,
            there,
        )


def numeric_mechanism(
    network: Network,
    length: Expression | None = None,
    asked: str = "manipulability is a number at a posture",
) -> NumericMechanism:
    """A mechanism with the values of its file.

    Args:
        network: Of the mechanism.
        length: Counts as one radian where the file gives no weights.
        asked: Why numbers are needed, for the refusal.

    Raises:
        UndecidedError: If a symbol has no value or a table closes nowhere.
    """
    mechanism, none_declared = with_scheme(network.mechanism)
    if length is not None:
        mechanism = with_length(mechanism, length)
    values = declared_values(mechanism)
    missing = [p.name for p in mechanism.parameters if p.name not in values]
    if missing:
        raise UndecidedError(
            f"{asked}, and {', '.join(missing)} "
            f"{'has' if len(missing) == 1 else 'have'} no value: --set {missing[0]}=…"
        )
    table = closed_table(Network(mechanism))
    return NumericMechanism(
        mechanism,
        with_values(mechanism, values),
        none_declared,
        float_values(values),
        None if table is None else table.values,
    )


def grasp_posture(
    network: Network,
    wanted: Mapping[str, Expression],
    length: Expression | None,
    asked: str = "manipulability is a number at a posture",
) -> GraspPosture:
    """The grasp of a mechanism at the posture that is asked for.

    Args:
        network: Of the mechanism.
        wanted: Values of joint variables that loops tie together.
        length: Counts as one radian where the file gives no weights.
        asked: Why numbers are needed, for the refusal.

    Raises:
        UndecidedError: If a symbol has no value or the posture is not reached.
    """
    known = numeric_mechanism(network, length, asked)
    mechanism, numbers = known.symbolic, known.numbers
    if wanted or known.start is not None:
        there = arrival_at(numbers, wanted, known.start)
        if not there.found.closed:
            raise UndecidedError(f"the posture was not reached: {there.reason}")
        return known.arrived(there)
    variables = dict(known.variables)
    if mechanism.geometry != "posture":
        free = {
            n: ZERO for n in mechanism.joint_variables if not _is_held(mechanism, n)
        }
        variables |= dict.fromkeys(free, 0.0)
        numbers = at_zero(numbers) if why_tied(numbers) else with_values(numbers, free)
    return GraspPosture(
        mechanism,
        numbers,
        float_matrices(numbers),
        GraspPair.of(numbers),
        known.all_actuated,
        variables,
    )


def _is_held(mechanism: Mechanism, name: str) -> bool:
    for joint in mechanism.joints:
        if name in joint.variables and joint.held:
            return joint.held[joint.variables.index(name)] is not None
    return False


def with_scheme(mechanism: Mechanism) -> tuple[Mechanism, bool]:
    """All joints actuated where the file declares none."""
    if mechanism.actuated:
        return mechanism, False
    joints = tuple(
        replace(joint, actuated=tuple(range(len(joint.variables))))
        if is_actuable(joint.type)
        else joint
        for joint in mechanism.joints
    )
    order = tuple(freedom_label(j, k) for j in joints for k in j.actuated)
    return replace(mechanism, joints=joints, scheme_order=order), True


def with_length(mechanism: Mechanism, length: Expression) -> Mechanism:
    """The mechanism with weights by which a length counts as one radian.

    Weights that the file declares stay.  Twists weigh v by 1/length², rates those of
    translations; wrenches, contact forces and torques are the dual: moments and torques
    by 1/length².
    """
    square = quotient(ONE, multiply(length, length))
    planar = mechanism.space == "planar"
    twist = [ONE, square, square] if planar else [ONE] * 3 + [square] * 3
    wrench = [ONE, ONE, square] if planar else [ONE] * 3 + [square] * 3
    by_name = {joint.name: joint for joint in mechanism.joints}
    slides = [_slides(by_name, label) for label in mechanism.scheme_order]
    weights = dict(mechanism.weights)
    for key, diagonal in (
        ("twist", twist),
        ("wrench", wrench),
        ("rates", [square if slide else ONE for slide in slides]),
        ("torques", [ONE if slide else square for slide in slides]),
        ("contact_forces", wrench * len(holding_joints(mechanism))),
    ):
        weights.setdefault(
            key,
            tuple(
                tuple(x if i == j else ZERO for j in range(len(diagonal)))
                for i, x in enumerate(diagonal)
            ),
        )
    return replace(mechanism, weights=weights)


def _slides(by_name: Mapping[str, Joint], label: str) -> bool:
    """Whether a freedom is a translation."""
    name, _, number = label.rpartition(":")
    joint = by_name.get(label) or by_name[name]
    index = 0 if label in by_name else int(number)
    return joint.type is JointType.PRISMATIC or (
        joint.type in (JointType.CYLINDRICAL, JointType.PLANAR) and index > 0
    )
