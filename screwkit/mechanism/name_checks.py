"""Names of bodies, joints and limbs: fit to be read, listed once, and resolved.

Any text a person can see is a name.  Text that a terminal would obey, or that cannot be
told from another, is none; nor is a joint called like a freedom of another one.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator
from typing import Any, Final

from screwkit.algebra.names import shown
from screwkit.mechanism.joints import CATALOGUE
from screwkit.mechanism.model import JointType
from screwkit.mechanism.nodes import Path
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.structure import Draft

LONGEST_NAME: Final = 200


def why_no_name(name: str) -> str | None:
    """Why a body, a joint or a limb cannot be called so; None where it can.

    >>> why_no_name("θ left wrist")
    >>> why_no_name(" a")
    "' a' begins with a blank"
    """
    if not name.strip():
        return f"{shown(name)} shows nothing"
    if hidden := next((c for c in name if not c.isprintable()), ""):
        kind = unicodedata.name(hidden, "a control character").lower()
        return f"{shown(name)} has a character that does not show: {kind}"
    for where, end in (("begins", name[0]), ("ends", name[-1])):
        if end.isspace():
            return f"{shown(name)} {where} with a blank"
    if len(name) > LONGEST_NAME:
        return f"{shown(name)} is longer than {LONGEST_NAME} characters"
    return None


def check_names(draft: Draft, reading: Reading) -> None:
    """Report names that cannot be read, and joints called like a freedom."""
    for path, name, is_key in _declared(draft):
        reason = why_no_name(name)
        if reason is None:
            continue
        words = f"{reason}; a name is text that shows, up to {LONGEST_NAME} characters"
        if is_key:
            reading.fault_at_key(path, f"limbs: {words}")
        else:
            reading.fault(path, words)
    freedoms = _freedoms(draft)
    for joint, position in zip(draft.entry.joints, draft.positions, strict=True):
        if joint.name in freedoms:
            owner = freedoms[joint.name]
            reading.fault(
                ("joints", position, "name"),
                f"{shown(joint.name)} is how a freedom of joint {shown(owner)} is "
                f"written; rename one of the two",
            )


def _declared(draft: Draft) -> Iterator[tuple[Path, str, bool]]:
    for position, link in enumerate(draft.entry.links):
        yield ("links", position), link, False
    for joint, position in zip(draft.entry.joints, draft.positions, strict=True):
        yield ("joints", position, "name"), joint.name, False
    for limb in draft.entry.limbs:
        yield ("limbs", limb), limb, True


def _freedoms(draft: Draft) -> dict[str, str]:
    """``name:0``, ``name:1`` … of all joints, also of those with a single freedom."""
    found: dict[str, str] = {}
    for joint in draft.entry.joints:
        entry: Any = joint
        kind = CATALOGUE[JointType(entry.type)]
        planar = draft.entry.space == "planar"
        count = kind.planar_freedoms if planar else kind.spatial_freedoms
        for k in range(count or 0):
            found[f"{joint.name}:{k}"] = joint.name
    return found


def check_links(draft: Draft, reading: Reading) -> None:
    """Links and joints are named once; joints, base and platform name links."""
    entry = draft.entry
    links_known = "links" not in draft.broken
    listed: set[str] = set()
    for position, link in enumerate(entry.links):
        if link in listed:
            reading.fault(
                ("links", position),
                f"the link {shown(link)} stands twice; list every body once",
            )
        listed.add(link)
    for key, link in (("base", entry.base), ("platform", entry.platform)):
        if links_known and key not in draft.broken and link not in listed:
            reading.fault((key,), reading.unknown_link(link, entry.links))
    # A lone body is base and platform in one; anywhere else this is a slip.
    same = entry.base == entry.platform and not draft.broken & {"base", "platform"}
    if same and len(entry.links) > 1:
        reading.fault(
            ("platform",), "base and platform are the same link; name two bodies"
        )
    first: dict[str, int] = {}
    for joint, position in zip(entry.joints, draft.positions, strict=True):
        path: Path = ("joints", position)
        if joint.name in first:
            line = reading.place(("joints", first[joint.name])).line
            reading.fault(
                (*path, "name"),
                f"a joint of this name stands in line {line} already; rename one",
            )
        first.setdefault(joint.name, position)
        for key, link in (("parent", joint.parent), ("child", joint.child)):
            if links_known and link not in listed:
                reading.fault((*path, key), reading.unknown_link(link, entry.links))
        if joint.parent == joint.child:
            reading.fault(
                (*path, "child"),
                f"the joint connects {shown(joint.parent)} to itself; parent and child "
                f"are two bodies",
            )
