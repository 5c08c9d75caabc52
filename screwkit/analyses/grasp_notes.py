"""What has to be said beside the numbers: where, in which measure, what is special."""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.expression import Expression
from screwkit.algebra.modular import rank
from screwkit.algebra.text import expression_text
from screwkit.analyses.grasp_posture import GraspPosture
from screwkit.mechanism.graph import limbs
from screwkit.mechanism.joints import CATALOGUE, RIGID
from screwkit.metrics.answers import ArmJoints, PostureAnswers
from screwkit.metrics.float_grasp import float_weights
from screwkit.results.manipulability import ContactPlace

NEARLY = 1e-11
"""Relative size of a singular value below which decimals may hide a zero."""


def contact_places(at: GraspPosture) -> tuple[ContactPlace, ...]:
    """Where the object is held."""
    limb_of = {name: limb.name for limb in limbs(at.mechanism) for name in limb.joints}
    found = []
    for hold in at.matrices.holds.contacts:
        rows = [row for row in at.matrices.rows if row.hold.joint == hold.joint]
        joint = at.mechanism.joint(hold.joint)
        rigid = joint.type in RIGID
        words = CATALOGUE[joint.type].words
        kind = words if hold.selective or rigid else f"rigid behind a {words}"
        found.append(
            ContactPlace(
                hold.joint,
                kind,
                limb_of.get(hold.joint, ""),
                tuple(float(x) for x in rows[0].wrench.point),
                tuple(row.wrench.label for row in rows),
            )
        )
    return tuple(found)


def units_note(
    at: GraspPosture, answers: PostureAnswers, length: Expression | None
) -> str:
    """By which measure rotations and translations are compared, if they are."""
    mixed = []
    if answers.translation.semi_axes and answers.rotation.semi_axes:
        mixed.append("the motion mixes rotations and translations")
    strokes = {label in at.matrices.turning for label in at.matrices.actuated}
    if len(strokes) > 1:
        mixed.append("the actuators turn and slide")
    if not mixed:
        return ""
    said = " and ".join(mixed)
    unit = at.mechanism.units or "unit of length"
    if length is not None:
        return f"{said}: {expression_text(length)} {unit} counts as 1 rad"
    declared = [
        key
        for key in ("twist", "wrench", "rates", "torques")
        if key in at.mechanism.weights
    ]
    if declared:
        return f"{said}: weighed by the file's weights of {', '.join(declared)}"
    return (
        f"{said}: 1 {unit} counts as 1 rad; declare weights, or give a length with "
        f"--length, if it should not"
    )


def differences(at: GraspPosture, answers: PostureAnswers) -> tuple[str, ...]:
    """What is special about the posture, against generic values of the symbols."""
    found = []
    family = at.family
    if family is not None and at.pair is not None:
        before, here = family.generic.ranks, at.pair.grasps[0].ranks
        for name, words in (
            ("indeterminacy", "motions of the object with the actuators locked"),
            ("redundancy", "actuated motions at which the object can rest"),
            ("coordinated", "coordinated motions"),
            ("internal", "internal torques"),
            ("structural", "structural wrenches"),
            ("static_indeterminacy", "statically indeterminate contact forces"),
        ):
            one, other = getattr(before, name), getattr(here, name)
            if one != other:
                found.append(f"{words}: {other} here, {one} in general")
    if at.pair is not None and answers.least < NEARLY:
        found.append(
            f"up to the rounding of its decimals the posture is singular (a singular "
            f"value is {answers.least:.1g} of the largest): write exact numbers, such "
            f"as sqrt(3)/2, if it is meant to be"
        )
    return tuple(found)


def arms_refused(at: GraspPosture, arms: Sequence[ArmJoints]) -> str:
    """Why there are no ellipsoids of arms; empty where there are."""
    if len(arms) < 2:
        return "fewer than two limbs hold the platform with joints of their own"
    if at.matrices.holds.closures:
        return (
            "limbs with loops inside are no arms: what they exert on the platform is "
            "no matter of their contacts alone"
        )
    return ""


def why_no_rule(at: GraspPosture, arms: Sequence[ArmJoints]) -> str:
    """Why arms do not combine in parallel and in series; empty where they do."""
    matrices = at.matrices
    slipping = [h.joint for h in matrices.holds.contacts if h.selective]
    if slipping and not _held_alike(at, arms):
        return (
            f"contact {slipping[0]} slips, so the arms do not hold the platform rigidly"
        )
    passive = [
        label for arm in arms for label in arm.freedoms if label in matrices.passive
    ]
    if passive:
        return f"joint {passive[0]} is passive"
    for arm in arms:
        if arm.ranks is not None and arm.ranks.a < arm.ranks.rows:
            return f"the Jacobian of {arm.name} has not full row rank"
    held = {hold.joint for hold in matrices.holds.contacts}
    if held - {name for arm in arms for name in arm.contacts}:
        return "a contact belongs to no arm"
    return _coupled(at, arms)


def _coupled(at: GraspPosture, arms: Sequence[ArmJoints]) -> str:
    """Which weight measures joints of two arms together; empty where none does."""
    weights = float_weights(at.mechanism, None, {})
    order = at.matrices.actuated
    arm_of = {label: arm.name for arm in arms for label in arm.freedoms}
    for key, weight in (("rates", weights.rates), ("torques", weights.torques)):
        if weight is None:
            continue
        for i, j in zip(*weight.nonzero(), strict=True):
            one, other = order[i], order[j]
            if arm_of.get(one) != arm_of.get(other):
                return (
                    f"the weight of {key} couples joints {one} and {other} of "
                    f"different arms"
                )
    return ""


def _held_alike(at: GraspPosture, arms: Sequence[ArmJoints]) -> bool:
    """Whether every arm transmits the same wrenches, independent of each other.

    As two hard fingers do that touch the object in one point: then velocities and
    forces of that point count, and the rules hold for them.
    """
    if at.pair is None:
        return False
    grasp = at.pair.grasps[0]
    spans = [grasp.only(arm.contacts, arm.freedoms) for arm in arms]
    together = [row for part in spans for row in part.gt]
    common = rank(together, grasp.prime)
    return all(part.ranks.o == len(part.gt) == common for part in spans)
