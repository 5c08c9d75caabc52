"""The grasp at a posture to which a mechanism has been moved.

Where loops take joint variables along, the posture is known in floating point alone;
contacts go with the bodies that carry them.

References: [MurrayLiSastry1994] §3.2.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.finite.exponentials import placed_nodes
from screwkit.finite.moved_posture import Arrival
from screwkit.finite.spanning_forest import forest_of
from screwkit.grasping.matrices import GraspMatrices, grasp_matrices
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.loops import ring_at
from screwkit.kinematics.placement import joint_twists
from screwkit.mechanism.model import Mechanism
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement


def grasp_on_arrival(mechanism: Mechanism, there: Arrival) -> GraspMatrices[Array]:
    """The grasp where a motion ended.

    Args:
        mechanism: All its symbols with values.
        there: The motion, closed.

    Raises:
        UndecidedError: If a contact has no place.
    """
    start = dict(there.before)
    if mechanism.geometry == "reference":
        start = dict.fromkeys(mechanism.joint_variables, 0.0)
    ring = ring_at(mechanism, start)
    carried = _carried(there)
    old = joint_twists(mechanism, ring, mechanism.base)
    new = dict(zip(there.found.model.labels, there.found.model.screws, strict=True))
    twists = {}
    for label, twist in old.items():
        moved = carried[mechanism.joint(twist.joint).parent]
        turned = vector.rotate(moved.rotation, twist.point)
        point = vector.add(turned, moved.translation)
        a, b, c, x, y, z = (np.asarray(float(v)) for v in new[label])
        twists[label] = JointTwist(
            twist.joint, twist.freedom, (a, b, c), (x, y, z), point, label
        )
    return grasp_matrices(mechanism, ring, twists, carried)


def _carried(there: Arrival) -> Mapping[str, Displacement[Array]]:
    """How far every link has been displaced."""
    forest = forest_of(there.start)
    placed = placed_nodes(
        forest, there.start.screws[None], there.found.coordinates[-1:]
    )[0]
    return {link: _displacement(placed[node]) for link, node in forest.nodes.items()}


def _displacement(matrix: Array) -> Displacement[Array]:
    rows = [[np.asarray(float(x)) for x in row] for row in matrix]
    first, second, third = ((r[0], r[1], r[2]) for r in rows[:3])
    x, y, z = (row[3] for row in rows[:3])
    return Displacement((first, second, third), (x, y, z))
