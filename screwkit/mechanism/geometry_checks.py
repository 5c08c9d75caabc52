"""Whether every joint is placed: axes present, not zero, not parallel; rows complete.

An axis with symbols in it is refused only where it is zero for all their values, or at
those that the file gives them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Final

from screwkit.algebra.expression_building import symbols_of
from screwkit.algebra.names import shown
from screwkit.algebra.vector_expression import VectorExpression, cross, dot
from screwkit.mechanism.joints import (
    CATALOGUE,
    MDH_TYPES,
    RIGID,
    freedoms_of_type,
    is_actuable,
)
from screwkit.mechanism.model import Joint, JointType
from screwkit.mechanism.nodes import Path, find
from screwkit.mechanism.ordering import in_order_of_need
from screwkit.mechanism.plane_checks import check_joint_plane
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.requirements import Requirement, nonzero
from screwkit.mechanism.structure import Draft
from screwkit.mechanism.vanishing import is_zero

_NEEDED: Final[dict[JointType, tuple[str, ...]]] = {
    JointType.REVOLUTE: ("axis", "point"),
    JointType.PRISMATIC: ("axis",),
    JointType.HELICAL: ("axis", "point", "pitch"),
    JointType.CYLINDRICAL: ("axis", "point"),
    JointType.UNIVERSAL: ("axes", "point"),
    JointType.SPHERICAL: ("point",),
    JointType.PLANAR: ("normal",),
    JointType.FIXED: (),
    JointType.COMPLETE: (),
    JointType.POINT: ("point", "normal"),
    JointType.HARD_FINGER: ("point",),
    JointType.SOFT_FINGER: ("point", "normal"),
    JointType.LINE: ("point", "normal", "line"),
    JointType.LINE_FRICTION: ("point", "normal", "line"),
    JointType.PLANE: ("point", "normal"),
}
"""What a joint must say in a `posture` or `reference` file."""
_GIVEN_IN_PLANE: Final = {
    JointType.REVOLUTE: ("axis",),
    JointType.PLANAR: ("normal",),
    JointType.LINE: ("line",),
}
"""What follows from the plane of a planar file: the axis is z."""


def check_kind(entry_type: str, path: Path, draft: Draft, reading: Reading) -> bool:
    """Whether the joint may stand in this file at all."""
    joint_type = JointType(entry_type)
    words = CATALOGUE[joint_type].words
    try:
        freedoms_of_type(joint_type, draft.entry.space)
    except ValueError as error:
        reading.fault((*path, "type"), str(error))
        return False
    is_mdh = draft.entry.geometry == "mdh" and "geometry" not in draft.broken
    if is_mdh and is_actuable(joint_type) and joint_type not in MDH_TYPES:
        reading.fault(
            (*path, "type"),
            f"a {words} cannot stand in an mdh file: a row of the table places joints "
            f"of one freedom only; write it as revolute and prismatic joints",
        )
        return False
    return True


def check_joint(joint: Joint, path: Path, draft: Draft, reading: Reading) -> None:
    """Everything that can be said of one joint's geometry alone."""
    if "geometry" in draft.broken:
        return
    planar = draft.entry.space == "planar"
    if draft.entry.geometry == "mdh":
        _check_row(joint, path, reading)
        if planar and joint.mdh is None:
            check_joint_plane(joint, path, reading)
        return
    if find(reading.root, (*path, "mdh")) is not None:
        reading.fault(
            (*path, "mdh"),
            f"an mdh row belongs to `geometry: mdh`; this file is "
            f"{draft.entry.geometry!r}",
        )
    _check_offsets(joint, path, draft, reading)
    given = _GIVEN_IN_PLANE.get(joint.type, ()) if planar else ()
    words = CATALOGUE[joint.type].words
    for key in _NEEDED[joint.type]:
        if key not in given and find(reading.root, (*path, key)) is None:
            reading.fault(path, f"the key {key!r} is missing; a {words} needs it")
    _check_directions(joint, path, reading)
    if planar:
        check_joint_plane(joint, path, reading)


def _check_offsets(joint: Joint, path: Path, draft: Draft, reading: Reading) -> None:
    """Only a table has a zero of its own that an offset could move."""
    if any(is_zero(offset) is False for offset in joint.offsets):
        at = {
            "posture": "axes and points hold at the posture of the file",
            "reference": "axes and points hold at joint variables 0",
        }[draft.entry.geometry]
        reading.fault(
            (*path, "offset"),
            f"an offset belongs to `geometry: mdh`; in this file {at}, and joint "
            f"variables are measured from there",
        )


def _check_row(joint: Joint, path: Path, reading: Reading) -> None:
    words = CATALOGUE[joint.type].words
    if joint.type in MDH_TYPES:
        if joint.mdh is None and find(reading.root, (*path, "mdh")) is None:
            reading.fault(
                path, f"the key 'mdh' is missing; a {words} of an mdh file needs a row"
            )
        for key in ("axis", "point"):
            if find(reading.root, (*path, key)) is not None:
                reading.fault(
                    (*path, key),
                    f"the mdh row places this joint; {key!r} belongs to "
                    f"`geometry: posture` or `reference`",
                )
        if joint.type is JointType.HELICAL and joint.pitch is None:
            reading.fault(path, f"the key 'pitch' is missing; a {words} needs it")
    _check_directions(joint, path, reading)


def _check_directions(joint: Joint, path: Path, reading: Reading) -> None:
    named: list[tuple[str, VectorExpression | None]] = [
        ("normal", joint.normal),
        ("line", joint.line),
    ]
    if len(joint.axes) == 1:
        named.append(("axis", joint.axes[0]))
    for key, direction in named:
        if direction is not None:
            reading.require((*path, key), _direction(f"the {key}", direction))
    if len(joint.axes) == 2:
        present = [
            reading.require((*path, "axes", i), _direction("the axis", axis))
            for i, axis in enumerate(joint.axes)
        ]
        if all(present):
            words = "the two axes of a universal joint are parallel"
            advice = "give two directions, or write a revolute joint"
            crossed = nonzero(cross(*joint.axes), words, advice)
            reading.require((*path, "axes"), crossed)
    if joint.normal is not None and joint.line is not None:
        product = dot(joint.normal, joint.line)
        if not symbols_of(product) and is_zero(product) is False:
            reading.fault(
                (*path, "line"), "the line of contact is not at right angles to normal"
            )


def _direction(what: str, direction: VectorExpression) -> Requirement:
    return nonzero(direction, f"{what} is zero", "write a direction such as [0, 0, 1]")


def check_antecedents(
    joints: Sequence[Joint], positions: Sequence[int], draft: Draft, reading: Reading
) -> None:
    """In an mdh file every row hangs on a body that is placed, down to the base."""
    entry = draft.entry
    if entry.geometry != "mdh" or draft.broken & {"geometry", "joints", "base"}:
        return
    placing = [joint for joint in joints if _places(joint)]
    placed = _placed_bodies(placing, entry.base) | draft.lost("child")
    parent_of = {joint.child: joint.parent for joint in reversed(placing)}
    circling = parent_of.keys() - set(
        in_order_of_need({child: {parent} for child, parent in parent_of.items()})
    )
    for joint, position in zip(joints, positions, strict=True):
        if joint.mdh is None or joint.parent in placed:
            continue
        if joint.parent not in entry.links or joint.parent == joint.child:
            continue  # reported already
        path: Path = ("joints", position, "mdh")
        if joint.parent not in parent_of:
            reading.fault(
                path,
                f"the row hangs on {shown(joint.parent)}, a body that no joint "
                f"places: the antecedent is the joint whose child is the parent",
            )
        elif joint.parent in circling:
            reading.fault(
                path,
                f"the antecedents of this row run in a circle and never reach the "
                f"base {shown(entry.base)}",
            )


def _places(joint: Joint) -> bool:
    """Whether the child's frame follows; a row that is missing is another fault."""
    return joint.type in MDH_TYPES | RIGID


def _placed_bodies(placing: Iterable[Joint], base: str) -> set[str]:
    children: dict[str, list[str]] = {}
    for joint in placing:
        children.setdefault(joint.parent, []).append(joint.child)
    placed = {base}
    waiting = [base]
    while waiting:
        for child in children.get(waiting.pop(), ()):
            if child not in placed:
                placed.add(child)
                waiting.append(child)
    return placed
