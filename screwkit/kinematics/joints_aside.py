"""Joints on no limb: of bodies that only hang on the mechanism, in trees.

No loop holds them, so that each adds its freedoms to the mobility at every posture.
"""

from __future__ import annotations

from collections.abc import Collection

from screwkit.kinematics.assembly import Assembly
from screwkit.mechanism.joints import freedom_labels


def freedoms_aside(assembly: Assembly, locked: Collection[str] = ()) -> int:
    """How many freedoms stand on no limb, of a mechanism whose loops are its limbs'.

    Args:
        assembly: The mechanism.
        locked: Freedoms that do not move.
    """
    own = assembly.mechanism
    held = {*assembly.joints, *locked}
    labels = (x for joint in own.joints for x in freedom_labels(joint, own.space))
    return sum(label not in held for label in labels)
