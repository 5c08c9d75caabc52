"""Some joints of a mechanism as a mechanism of their own."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from screwkit.mechanism.model import Mechanism


def part_of(
    mechanism: Mechanism, joints: Collection[str], ends: Sequence[str]
) -> Mechanism:
    """Some joints with the links they touch.

    Args:
        mechanism: The whole.
        joints: Names of the joints.
        ends: Links that stay in any case, base first and platform last.
    """
    chosen = frozenset(joints)
    own = tuple(j for j in mechanism.joints if j.name in chosen)
    met = {link for joint in own for link in (joint.parent, joint.child)}
    kept = tuple(x for x in mechanism.links if x in met or x in ends)
    return replace(
        mechanism,
        base=ends[0],
        platform=ends[-1],
        joints=own,
        links=kept,
        limb_names={},
    )
