"""The limbs of an assembly as parts in series, in its frames.

Joints that are locked are left out; what their chain then still allows is what its
other joints do.
"""

from __future__ import annotations

from collections.abc import Collection

from screwkit.algebra.telling_coordinates import telling_coordinates
from screwkit.conventions import SCREW_DIMENSION
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.kinematics.frames import FramedTwists
from screwkit.kinematics.limb_parts import Column, Part, parts_of


def told_parts(
    assembly: Assembly, limb: LimbChain, locked: Collection[str] = ()
) -> list[Part]:
    """A limb in the common frame, in the coordinates that tell all limbs apart."""
    framed = assembly.common_twists
    return _parts(assembly, limb, framed, assembly.telling, locked)


def whole_parts(
    assembly: Assembly, limb: LimbChain, locked: Collection[str] = ()
) -> list[Part]:
    """A limb in the common frame, with all six coordinates of its twists."""
    framed = assembly.common_twists
    return _parts(assembly, limb, framed, range(SCREW_DIMENSION), locked)


def own_parts(assembly: Assembly, limb: LimbChain) -> tuple[list[Part], int]:
    """A limb in its own frame, and the number of coordinates that tell its twists."""
    framed = assembly.limb_twists[limb.name]
    telling = telling_coordinates(framed.column(joint) for joint in limb.joints)
    return _parts(assembly, limb, framed, telling, ()), len(telling)


def _parts(
    assembly: Assembly,
    limb: LimbChain,
    framed: FramedTwists,
    telling: Collection[int],
    locked: Collection[str],
) -> list[Part]:
    columns: dict[str, list[Column]] = {}
    own = [joint for joint in limb.joints if joint not in locked]
    for label in own:
        twist = framed.column(label)
        told = [twist[place] for place in telling]
        columns.setdefault(assembly.joint_of(label).name, []).append(told)
    if limb.elements is None:
        return [column for of_joint in columns.values() for column in of_joint]
    return parts_of(limb.elements, columns)
