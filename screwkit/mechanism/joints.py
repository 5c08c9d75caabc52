"""The catalogue of joints and contacts: letter, freedoms, and whether a motor fits.

A contact is a joint without coordinates: it has freedoms, which count, but no
variables and no actuator.  Freedoms follow the selector tables of
[BicchiPrattichizzo]: six (three in the plane) less the constraints.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Final

from screwkit.mechanism.model import Joint, JointType, Space


@dataclass(frozen=True)
class JointKind:
    """What the catalogue knows of a joint type.

    Attributes:
        letter: The usual one; empty for contacts.
        spatial_freedoms: In space.
        planar_freedoms: In the plane; None where the type does not exist there.
        contact: Whether it is a contact; then it has no variables.
        words: How a sentence calls it.
    """

    letter: str
    spatial_freedoms: int
    planar_freedoms: int | None
    contact: bool
    words: str


CATALOGUE: Final[dict[JointType, JointKind]] = {
    JointType.REVOLUTE: JointKind("R", 1, 1, False, "revolute joint"),
    JointType.PRISMATIC: JointKind("P", 1, 1, False, "prismatic joint"),
    JointType.HELICAL: JointKind("H", 1, None, False, "helical joint"),
    JointType.CYLINDRICAL: JointKind("C", 2, None, False, "cylindrical joint"),
    JointType.UNIVERSAL: JointKind("U", 2, None, False, "universal joint"),
    JointType.SPHERICAL: JointKind("S", 3, None, False, "spherical joint"),
    JointType.PLANAR: JointKind("E", 3, 3, False, "planar joint"),
    JointType.FIXED: JointKind("", 0, 0, False, "fixed joint"),
    JointType.POINT: JointKind("", 5, 2, True, "frictionless point contact"),
    JointType.HARD_FINGER: JointKind("", 3, 1, True, "hard-finger contact"),
    JointType.SOFT_FINGER: JointKind("", 2, None, True, "soft-finger contact"),
    JointType.LINE: JointKind("", 4, 1, True, "frictionless line contact"),
    JointType.LINE_FRICTION: JointKind("", 1, None, True, "line contact with friction"),
    JointType.PLANE: JointKind("", 3, 1, True, "frictionless plane contact"),
    JointType.COMPLETE: JointKind("", 0, 0, True, "complete contact"),
}
RIGID: Final = frozenset({JointType.FIXED, JointType.COMPLETE})
"""Joints that leave no freedom at all."""
MDH_TYPES: Final = frozenset(
    {JointType.REVOLUTE, JointType.PRISMATIC, JointType.HELICAL}
)
"""Joints of one freedom, which a row of an mdh table places."""


def freedoms_of_type(joint_type: JointType, space: Space = "spatial") -> int:
    """The freedoms that a joint of this type leaves.

    Raises:
        ValueError: If the type does not exist in the plane.
    """
    kind = CATALOGUE[joint_type]
    if space == "spatial":
        return kind.spatial_freedoms
    if kind.planar_freedoms is None:
        raise ValueError(f"a {kind.words} does not exist in a planar file")
    return kind.planar_freedoms


def freedoms(joint: Joint, space: Space = "spatial") -> int:
    """The freedoms of one joint, contacts included.

    Raises:
        ValueError: If its type does not exist in the plane.
    """
    return freedoms_of_type(joint.type, space)


def is_actuable(joint_type: JointType) -> bool:
    """Whether a motor can drive a joint of this type: it has freedoms, no contact."""
    kind = CATALOGUE[joint_type]
    return not kind.contact and kind.spatial_freedoms > 0


def variable_count(joint_type: JointType, space: Space = "spatial") -> int:
    """How many variables a joint of this type has: its freedoms, none for contacts.

    Raises:
        ValueError: If the type does not exist in the plane.
    """
    return freedoms_of_type(joint_type, space) if is_actuable(joint_type) else 0


def freedom_labels(joint: Joint, space: Space = "spatial") -> tuple[str, ...]:
    """How its freedoms are written: ``name``, or ``name:0``, ``name:1`` … if several.

    Raises:
        ValueError: If its type does not exist in the plane.
    """
    return _labels(joint.name, freedoms(joint, space))


@lru_cache(maxsize=4096)
def _labels(name: str, count: int) -> tuple[str, ...]:
    if count == 1:
        return (name,)
    return tuple(f"{name}:{index}" for index in range(count))
