"""A point of every joint at an exact posture: its centre, or a point of its axis.

The points of the file are taken where they hold at the posture.  Where they are drawn
at random with the symbols in them, they follow from the twists.

References: [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from screwkit.algebra.modular import ModularRing, ResampleError, Residue
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.errors import UndecidedError
from screwkit.kinematics.exact_postures import ExactPosture, at_zero
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.network import Network
from screwkit.kinematics.placement import joint_twists
from screwkit.reasons.residue_spaces import reduced_echelon
from screwkit.screw.vector import cross, dot

Point = tuple[int, int, int]


def joint_points(network: Network, posture: ExactPosture) -> dict[str, Point]:
    """A point of each joint modulo the prime; joints that only slide have none."""
    written = _written(network, posture)
    points: dict[str, Point] = {}
    for joint in network.mechanism.joints:
        labels = network.labels_of[joint.name]
        twists = [posture.twists[label] for label in labels]
        turning = [twist for twist in twists if any(twist[DIRECTION])]
        if not turning:
            continue
        known = [written[label] for label in labels if label in written]
        if len(known) == len(labels) and all(
            tuple(map(int, own.coordinates)) == twist
            for own, twist in zip(known, twists, strict=True)
        ):
            x, y, z = map(int, known[0].point)
            points[joint.name] = (x, y, z)
            continue
        point = _common(turning, posture.prime)
        if point is not None:
            points[joint.name] = point
    return points


def _written(
    network: Network, posture: ExactPosture
) -> Mapping[str, JointTwist[Residue]]:
    """The joints where the file puts them, with other residues for its symbols."""
    mechanism = at_zero(network.mechanism) if network.tied else network.mechanism
    ring = ModularRing(0, posture.prime, posture.field)
    try:
        return joint_twists(mechanism, ring, mechanism.base)
    except (ResampleError, ZeroDivisionError, UndecidedError):
        return {}


def _common(twists: Sequence[Sequence[int]], prime: int) -> Point | None:
    """A point p with v = p × ω for all; the foot of the first axis if there is none."""
    if len(twists) > 1:
        equations = []
        for twist in twists:
            x, y, z = twist[DIRECTION]
            lines = (0, z, -y), (-z, 0, x), (y, -x, 0)
            for line, moment in zip(lines, twist[MOMENT], strict=True):
                row = {i: c % prime for i, c in enumerate((*line, moment)) if c % prime}
                equations.append(row)
        solved = reduced_echelon(equations, prime, lambda i: i)
        if 3 not in (min(row) for row in solved):
            found = {min(row): row.get(3, 0) for row in solved}
            return found.get(0, 0), found.get(1, 0), found.get(2, 0)
    return foot(twists[0], prime)


def foot(screw: Sequence[int], prime: int) -> Point | None:
    """The point of a screw's axis nearest to the origin; None for free vectors."""
    direction, moment = screw[DIRECTION], screw[MOMENT]
    square = dot(direction, direction) % prime
    if not square:
        return None
    inverse = pow(square, -1, prime)
    x, y, z = (c * inverse % prime for c in cross(direction, moment))
    return x, y, z
