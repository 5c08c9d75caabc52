"""How fast, strong and accurate the object is: partition, statics, indices, arms.

Dimensions are exact at the values of the file; where a motion was asked for that loops
carry along, the posture is known in floating point and they are counts of singular
values.  Finite index values are numbers, with their exact polynomial where it is short.

References: [BicchiMelchiorri], [BicchiPrattichizzo], [ChiacchioEtAl1990], as corrected.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict

from screwkit.algebra.expression import Expression
from screwkit.analyses.block_words import meaning
from screwkit.analyses.exact_indices import exact_indices, with_polynomial
from screwkit.analyses.grasp_notes import (
    arms_refused,
    contact_places,
    differences,
    units_note,
    why_no_rule,
)
from screwkit.analyses.grasp_posture import GraspPosture, grasp_posture
from screwkit.analyses.partition import gamma_of, motion_blocks
from screwkit.grasping.exact_grasp import Ranks
from screwkit.grasping.symbolic_indices import kinematic_polynomial, value_name
from screwkit.kinematics.network import Network
from screwkit.mechanism.graph import limbs
from screwkit.mechanism.joints import freedom_labels
from screwkit.metrics.answers import ArmJoints, PostureAnswers, posture_answers
from screwkit.metrics.scenes import scene_of
from screwkit.progress import Progress, silent
from screwkit.results.manipulability import (
    Manipulability,
    Statics,
    SymbolicIndices,
)
from screwkit.results.partition import Gamma, MotionBlock, Partition
from screwkit.results.undecided import Undecided


def manipulability(
    network: Network,
    wanted: Mapping[str, Expression] | None = None,
    length: Expression | None = None,
    progress: Progress = silent,
) -> Manipulability:
    """Answer ``manipulability``.

    Args:
        network: The mechanism; every symbol needs a value.
        wanted: Joint variables to which it is moved first, where loops take others
            along.
        length: A length that counts as one radian, where the file weighs nothing.
        progress: Told about each stage.

    Raises:
        UndecidedError: If a symbol has no value, or the posture is not reached.
    """
    progress("manipulability", f"{len(network.labels)} freedoms")
    return measured(grasp_posture(network, wanted or {}, length), length)


def measured(at: GraspPosture, length: Expression | None = None) -> Manipulability:
    """The answer for a grasp at its posture; ``length`` is told where it was given."""
    arms = _arms(at)
    refusal = arms_refused(at, arms)
    answers = posture_answers(
        at.mechanism,
        at.matrices,
        at.ranks,
        () if refusal else arms,
        "" if refusal else why_no_rule(at, arms),
    )
    exact = None if at.pair is None else exact_indices(at.mechanism, at.pair)
    kinematic, force = answers.kinematic, answers.force
    internal = answers.internal
    if exact is not None:
        kinematic = with_polynomial(kinematic, exact.kinematic)
        force = with_polynomial(force, exact.force)
        internal = with_polynomial(internal, exact.internal)
    ranks = answers.ranks
    return Manipulability(
        case=at.mechanism.name,
        title=at.mechanism.title,
        contacts=contact_places(at),
        actuated=at.matrices.actuated,
        passive=at.matrices.passive,
        all_actuated=at.all_actuated,
        space=at.mechanism.space,
        order="direction-moment",
        frame=at.mechanism.base,
        point=tuple(float(x) for x in at.matrices.reference_point),
        posture=at.note(answers.gap),
        partition=_partition(at, answers),
        statics=Statics(
            ranks.admissible,
            ranks.coordinated,
            ranks.internal,
            ranks.structural,
            ranks.static_indeterminacy,
            () if exact is None else exact.structural_wrenches,
            () if exact is None else exact.internal_torques,
            ranks.indeterminacy == 0,
        ),
        kinematic=kinematic,
        force=force,
        active_force=answers.active,
        passive_force=answers.passive,
        internal_force=internal,
        translation=answers.translation,
        rotation=answers.rotation,
        forces=answers.forces,
        scene=scene_of(at.mechanism, at.matrices),
        cooperative=answers.cooperative or Undecided(refusal),
        symbolic=_symbolic(at),
        platform_name=at.mechanism.platform,
        units=units_note(at, answers, length),
        differences=differences(at, answers),
    )


def _partition(at: GraspPosture, answers: PostureAnswers) -> Partition:
    ranks, alone = answers.ranks, answers.alone or 0
    if at.pair is None:
        gamma = Gamma(*answers.gamma)
    else:
        gamma = gamma_of(at.pair.blocks[0])
        alone = at.pair.grasps[0].object_alone
    mobility = sum(asdict(gamma).values())
    redundancy = ranks.actuated + ranks.passive - ranks.ap
    blocks: tuple[MotionBlock, ...] = ()
    symbolic = False
    if at.pair is not None:
        blocks, symbolic = motion_blocks(at.family, at.pair)
    return Partition(
        mobility,
        mobility - redundancy,
        redundancy,
        alone,
        gamma,
        blocks or _unnamed(gamma),
        symbolic,
    )


def _symbolic(at: GraspPosture) -> SymbolicIndices:
    """Where the posture is one of a family."""
    if at.family is None:
        return SymbolicIndices()
    mechanism = at.family.mechanism
    symbols = [p.name for p in mechanism.parameters]
    called = value_name([*symbols, *mechanism.joint_variables])
    return SymbolicIndices(kinematic_polynomial(at.family, called), called)


def _unnamed(gamma: Gamma) -> tuple[MotionBlock, ...]:
    """The blocks where a posture in floats leaves their vectors without texts."""
    return tuple(
        MotionBlock(name, dimension, meaning(name), ())
        for name, dimension in asdict(gamma).items()
        if dimension
    )


def _arms(at: GraspPosture) -> tuple[ArmJoints, ...]:
    """The limbs that hold the object with joints of their own."""
    found = []
    holds = at.matrices.holds.contacts
    for limb in limbs(at.mechanism):
        own = tuple(
            label
            for name in limb.joints
            for label in freedom_labels(at.mechanism.joint(name), at.mechanism.space)
            if label in at.matrices.freedoms
        )
        contacts = tuple(hold.joint for hold in holds if hold.joint in limb.joints)
        if own and contacts:
            found.append(
                ArmJoints(limb.name, contacts, own, _ranks_of(at, contacts, own))
            )
    return tuple(found)


def _ranks_of(
    at: GraspPosture, contacts: Sequence[str], freedoms: Sequence[str]
) -> Ranks | None:
    if at.pair is None:
        return None
    return at.pair.grasps[0].only(contacts, freedoms).ranks
