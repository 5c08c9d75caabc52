"""Configurations in which the platform stands where it is wanted, measured.

The contact point and the orientations of end effectors are given, joint values and
indices come out, for arms and mechanisms of any kind.

References: [ChiacchioEtAl1990] section 4.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from screwkit.algebra.expression import Expression
from screwkit.analyses.grasp_posture import numeric_mechanism
from screwkit.analyses.manipulability import measured
from screwkit.errors import UndecidedError
from screwkit.finite.moved_posture import arrival, departure
from screwkit.finite.reaching import Placed, reached
from screwkit.grasping.matrices import reference_point
from screwkit.kinematics.loops import ring_at
from screwkit.kinematics.network import Network
from screwkit.mechanism.joints import freedom_labels
from screwkit.progress import Progress, silent
from screwkit.results.reach import Reach, TurnedBody


def reach(
    network: Network,
    point: Sequence[float],
    turned: Mapping[str, tuple[float, float, float]],
    length: Expression | None = None,
    progress: Progress = silent,
) -> Reach:
    """Answer ``reach``.

    Args:
        network: The mechanism; every symbol needs a value.
        point: Where the reference point of the platform is wanted, in base
            coordinates; two or three numbers, none to leave it free.
        turned: Rotation vectors in base axes by link, counted from the posture of the
            file.
        length: A length that counts as one radian, where the file weighs nothing.
        progress: Told about each stage.

    Raises:
        UndecidedError: If a symbol has no value, or no configuration is found.
    """
    known = numeric_mechanism(network, length)
    mechanism = known.numbers
    model, before = departure(mechanism, known.start)
    standing = ring_at(
        mechanism, before or dict.fromkeys(mechanism.joint_variables, 0.0)
    )
    places = [Placed(link, turn=turn) for link, turn in turned.items()]
    if len(point):
        a, b, c = (float(x) for x in reference_point(mechanism, standing))
        x, y, z = (*point, c)[:3]
        place = Placed(mechanism.platform, (a, b, c), (x - a, y - b, z - c))
        places.append(place)
    told = known.symbolic.scheme_order
    progress("configurations", f"{len(model.labels)} freedoms")
    found = reached(model, places, told)
    if not found.configurations:
        raise UndecidedError(
            f"no configuration was found from {found.starts} postures: the place is "
            f"out of reach, or hard to come to"
        )
    answers = []
    for number, configuration in enumerate(found.configurations, 1):
        progress("manipulability", f"{number} of {len(found.configurations)}")
        there = arrival(mechanism, model, before, configuration)
        answers.append(measured(known.arrived(there), length))
    variables = tuple(
        variable
        for joint in mechanism.joints
        for variable, label in zip(
            joint.variables, freedom_labels(joint, mechanism.space), strict=False
        )
        if label in told
    )
    return Reach(
        case=mechanism.name,
        title=mechanism.title,
        platform_name=mechanism.platform,
        point=tuple(float(x) for x in point),
        turned=tuple(TurnedBody(link, turn) for link, turn in turned.items()),
        joint_variables=variables,
        configurations=tuple(answers),
        spare=found.spare,
        starts=found.starts,
    )
