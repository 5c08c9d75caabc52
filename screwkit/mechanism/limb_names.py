"""Names of limbs: each must name the joints of one limb, rigid ones aside."""

from __future__ import annotations

from screwkit.algebra.names import shown
from screwkit.mechanism.graph import has_freedom, limbs
from screwkit.mechanism.model import Mechanism
from screwkit.mechanism.nodes import Path
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.structure import Draft


def check_limb_names(mechanism: Mechanism, draft: Draft, reading: Reading) -> None:
    """Report unknown joints, and lists that are not the joints of one limb."""
    by_name = {joint.name: joint for joint in mechanism.joints}
    lost = draft.lost("name")
    sound = not draft.broken and not draft.lost_joints and not reading.faults.found
    owners: dict[str, str] = {}
    for limb_name, names in mechanism.limb_names.items():
        for position, name in enumerate(names):
            path: Path = ("limbs", limb_name, position)
            if name not in by_name and name not in lost:
                reading.fault(path, reading.unknown_joint(name, list(by_name)))
                sound = False
            elif name in owners:
                reading.fault(
                    path,
                    f"joint {shown(name)} belongs to limb {owners[name]!r} already",
                )
                sound = False
            owners.setdefault(name, limb_name)
        if not names:
            reading.fault(("limbs", limb_name), "a limb has at least one joint")
            sound = False
    if not sound:
        return  # the graph cannot be trusted
    home = {name: limb for limb in limbs(mechanism) for name in limb.joints}
    for limb_name, names in mechanism.limb_names.items():
        path = ("limbs", limb_name)
        limb = home.get(names[0])
        if limb is None or any(home.get(name) is not limb for name in names):
            reading.fault(
                path,
                "these joints do not form one limb; a limb is a component of the "
                "graph without base and platform, with its joints to both",
            )
            continue
        moving = [n for n in limb.joints if has_freedom(by_name[n])]
        forgotten = [name for name in moving if owners.get(name) != limb_name]
        if forgotten:
            reading.fault(path, f"the limb has also the joint {forgotten[0]!r}")
