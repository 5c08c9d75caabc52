"""The declared actuation scheme, from flags on joints or from the list, and weights.

Freedoms are written as everywhere: the joint's name, or ``name:k`` where a joint has
several.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from screwkit.algebra.expression import Expression
from screwkit.algebra.names import shown
from screwkit.mechanism.joints import CATALOGUE, is_actuable
from screwkit.mechanism.model import Joint, freedom_label
from screwkit.mechanism.nodes import Path
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.structure import Draft


def read_actuation(
    joints: tuple[Joint, ...], draft: Draft, reading: Reading
) -> tuple[tuple[Joint, ...], tuple[str, ...]]:
    """The joints with their actuated freedoms, and these in the order of the file."""
    flagged = {
        joint.name: _flags(joint, number, draft, reading)
        for number, joint in enumerate(joints)
    }
    by_flags = tuple(
        freedom_label(joint, k) for joint in joints for k in flagged[joint.name]
    )
    listed = _listed(joints, draft, reading)
    if listed is None:
        order = by_flags
    else:
        by_name = {joint.name: joint for joint in joints}
        order = tuple(freedom_label(by_name[name], k) for name, k in listed)
        if by_flags and set(by_flags) != set(order):
            reading.fault(
                ("actuated",),
                "the list and the flags on the joints name different freedoms; "
                "declare the scheme in one place",
            )
        flagged = {joint.name: () for joint in joints}
        for name, k in sorted(listed):
            flagged[name] = (*flagged[name], k)
    marked = tuple(replace(joint, actuated=flagged[joint.name]) for joint in joints)
    return marked, order


def _flags(
    joint: Joint, number: int, draft: Draft, reading: Reading
) -> tuple[int, ...]:
    declared = draft.entry.joints[number].actuated
    if declared is None or declared is False:
        return ()
    path: Path = ("joints", draft.positions[number], "actuated")
    if not is_actuable(joint.type):
        words = CATALOGUE[joint.type].words
        reading.fault(path, f"a {words} cannot be actuated")
        return ()
    count = len(joint.variables)
    if declared is True:
        return tuple(range(count))
    for position, index in enumerate(declared):
        if index >= count:
            reading.fault(
                (*path, position),
                f"there is no freedom {index}; this joint has {_range(count)}",
            )
        elif index in declared[:position]:
            reading.fault((*path, position), f"the freedom {index} stands twice")
    return tuple(sorted({index for index in declared if index < count}))


def _range(count: int) -> str:
    return "only freedom 0" if count == 1 else f"freedoms 0 to {count - 1}"


def _listed(
    joints: tuple[Joint, ...], draft: Draft, reading: Reading
) -> tuple[tuple[str, int], ...] | None:
    if draft.entry.actuated is None:
        return None
    by_name = {joint.name: joint for joint in joints}
    found: dict[tuple[str, int], None] = {}
    for position, label in enumerate(draft.entry.actuated):
        path: Path = ("actuated", position)
        freedom = _resolved(label, path, by_name, draft, reading)
        if freedom is None:
            continue
        if freedom in found:
            reading.fault(path, f"{shown(label)} stands twice")
        else:
            found[freedom] = None
    return tuple(found)


def _resolved(
    label: str,
    path: Path,
    by_name: Mapping[str, Joint],
    draft: Draft,
    reading: Reading,
) -> tuple[str, int] | None:
    joint, index = by_name.get(label), None
    if joint is None:
        stem, colon, digits = label.rpartition(":")
        if colon and digits.isascii() and digits.isdigit() and stem in by_name:
            joint, index = by_name[stem], int(digits[:3])
    if joint is None:
        if not {label, label.rpartition(":")[0]} & draft.lost("name"):
            usable = [n for n, j in by_name.items() if is_actuable(j.type)]
            reading.fault(path, reading.unknown_joint(label, usable))
        return None
    if not is_actuable(joint.type):
        words = CATALOGUE[joint.type].words
        reading.fault(path, f"{shown(label)} is a {words} and cannot be actuated")
        return None
    count = len(joint.variables)
    if index is None and count > 1:
        options = " or ".join(f'"{joint.name}:{k}"' for k in range(count))
        reading.fault(
            path, f"joint {shown(label)} has {count} freedoms; write {options}"
        )
        return None
    if index is not None and index >= count:
        reading.fault(
            path,
            f"joint {shown(joint.name)} has no freedom {index}, {_range(count)}",
        )
        return None
    return joint.name, index or 0


def read_weights(
    draft: Draft, order: tuple[str, ...], reading: Reading
) -> dict[str, tuple[tuple[Expression, ...], ...]]:
    """The weights as full matrices; their sizes fit what they weigh.

    One with an entry that cannot be read is left out: that is all its fault.
    """
    if draft.entry.weights is None:
        return {}
    space = 3 if draft.entry.space == "planar" else 6
    sizes = {
        "twist": space,
        "wrench": space,
        "rates": len(order),
        "torques": len(order),
    }
    found = {}
    for key in ("twist", "rates", "wrench", "torques", "contact_forces"):
        written = getattr(draft.entry.weights, key)
        if written is None:
            continue
        path: Path = ("weights", key)
        size = len(written)
        expected = sizes.get(key, size)
        if size != expected and "joints" not in draft.broken and not draft.lost_joints:
            reading.fault(path, f"{expected} entries are expected, not {size}")
            continue
        rows = [
            [_entry(written, row, column, path, reading) for column in range(size)]
            for row in range(size)
        ]
        matrix = tuple(tuple(x for x in row if x is not None) for row in rows)
        if all(len(row) == size for row in matrix):
            found[key] = matrix
    return found


def _entry(
    written: tuple[str, ...] | tuple[tuple[str, ...], ...],
    row: int,
    column: int,
    path: Path,
    reading: Reading,
) -> Expression | None:
    line = written[row]
    if isinstance(line, str):
        inner: Path = (*path, row)
        text = line if row == column else "0"
    else:
        inner = (*path, row, column)
        text = line[column]
    return reading.scalar(inner, text)
