"""From a tree to the models: every structural fault, and what is left without them.

Faults of pydantic become sentences with a place.  Entries at fault are taken out and
the rest is validated again, so that faults of meaning in the rest are found in the same
run.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Final, get_args

from pydantic import BaseModel, ValidationError

from screwkit.algebra.names import did_you_mean, shown
from screwkit.mechanism import schema
from screwkit.mechanism.joints import CATALOGUE
from screwkit.mechanism.model import JointType
from screwkit.mechanism.nodes import (
    Faults,
    Mapping,
    Node,
    Path,
    Place,
    find,
    key_place_of,
    place_of,
    plain,
)
from screwkit.mechanism.schema import JointEntry, MechanismEntry

_TAGS: Final = frozenset(str(joint_type) for joint_type in JointType)
_STAND_INS: Final[dict[str, Any]] = {
    "screwkit": "1",
    "name": "unnamed",
    "geometry": "mdh",
    "base": "?",
    "platform": "?",
    "links": ["?"],
    "joints": [],
}
_IN_FILES: Final = (
    *("name", "type", "parent", "child", "axis", "axes", "point", "normal", "line"),
    *("pitch", "mdh", "variable", "offset", "actuated"),
)
"""Keys of joints in the order of the format's page."""
_IDENTITY: Final = ("name", "type", "parent", "child")
_BY_NAME: Final = ("parameters", "variables", "points", "vectors", "limbs", "expected")


@dataclass(frozen=True)
class Draft:
    """A file whose structure is right, as far as it goes.

    Attributes:
        entry: The models of what is right.
        root: The whole tree, for places.
        positions: For each joint of ``entry`` its position in the file.
        broken: Top-level keys that are missing or wrong; what ``entry`` says there is
            a stand-in.
        lost_joints: The joints that were taken out, as plain data.
        lost_names: Names of parameters, points … that were taken out.
    """

    entry: MechanismEntry
    root: Mapping
    positions: tuple[int, ...]
    broken: frozenset[str]
    lost_joints: tuple[Any, ...]
    lost_names: frozenset[str]

    def lost(self, key: str) -> frozenset[str]:
        """What the joints that were taken out say under ``key``, where it is text."""
        values = (raw.get(key) for raw in self.lost_joints if isinstance(raw, dict))
        return frozenset(value for value in values if isinstance(value, str) and value)


def draft_of(root: Node, faults: Faults) -> Draft | None:
    """Validate a tree; what is wrong goes to ``faults``.

    Returns:
        What is right, or None where nothing can be made of the file.
    """
    if not isinstance(root, Mapping):
        found = "a list" if not hasattr(root, "text") else "plain text"
        faults.add(
            root.place,
            f"a mechanism file is a mapping that starts with `screwkit: 1`; "
            f"this is {found}",
        )
        return None
    content: dict[str, Any] = plain(root)
    try:
        entry = MechanismEntry.model_validate(content)
    except ValidationError as error:
        found_faults = error.errors(include_url=False)
    else:
        positions = tuple(range(len(entry.joints)))
        return Draft(entry, root, positions, frozenset(), (), frozenset())
    for fault in found_faults:
        if fault["type"] == "version":
            # What the keys of another version mean is not known here.
            faults.add(*_sentence(root, fault))
            return None
    for fault in found_faults:
        faults.add(*_sentence(root, fault))
    return _remainder(
        content,
        root,
        [(_path(fault["loc"]), str(fault["type"])) for fault in found_faults],
    )


def _remainder(
    content: dict[str, Any], root: Mapping, found: list[tuple[Path, str]]
) -> Draft:
    """Take out as little as possible of what is at fault and validate the rest."""
    lost_joints: set[int] = set()
    lost_names: set[str] = set()
    broken: set[str] = set()
    for path, kind in found:
        match path:
            case (*_, str(key)) if kind == "extra_forbidden":
                _holder(content, path).pop(key, None)
            case ("joints", int(position), str(key), *_) if key not in _IDENTITY:
                content["joints"][position].pop(key, None)
            case ("joints", int(position), *_):
                lost_joints.add(position)
            case ("variants", str(name), str(group), str(key), *_):
                content["variants"][name][group].pop(key, None)
            case ("variants", str(name), *_):
                content["variants"].pop(name, None)
            case (str(key), str(name), *_) if key in _BY_NAME:
                if isinstance(content.get(key), dict):
                    content[key].pop(name, None)
                lost_names.add(name)
            case ("weights", str(key), *_):
                content["weights"].pop(key, None)
            case (str(key), *_):
                content.pop(key, None)
                broken.add(key)
    for key in broken:
        if key in _STAND_INS:
            content[key] = _STAND_INS[key]
    joints = content["joints"]
    positions = tuple(i for i in range(len(joints)) if i not in lost_joints)
    content["joints"] = [joints[i] for i in positions]
    return Draft(
        MechanismEntry.model_validate(content),
        root,
        positions,
        frozenset(broken),
        tuple(joints[i] for i in sorted(lost_joints)),
        frozenset(lost_names),
    )


def _holder(content: Any, path: Path) -> dict[str, Any]:
    """What holds the last key of ``path``; an empty mapping where it is gone."""
    for step in path[:-1]:
        try:
            content = content[step]
        except (KeyError, IndexError, TypeError):
            return {}
    return content if isinstance(content, dict) else {}


def _path(location: Iterable[str | int]) -> Path:
    """A location of pydantic without the tag of the joint's model."""
    path = tuple(location)
    if len(path) > 2 and path[0] == "joints" and path[2] in _TAGS:
        return (*path[:2], *path[3:])
    return path


def subject(root: Node, path: Path) -> str:
    """What a path is called in a sentence: ``joint 'J2': `` and the like."""
    match path:
        case ("joints", int(position), *_):
            node = find(root, ("joints", position, "name"))
            text = getattr(node, "text", None)
            own = f"joint {shown(text)}" if text else f"joint no. {position + 1}"
            return ", ".join([own, *map(_step, path[2:])])
        case (key, *rest):
            return ", ".join([str(key), *map(_step, rest)])
    return "the file"


def _step(step: str | int) -> str:
    """A key as it stands, in quotes where it has characters that do not show."""
    text = str(step)
    return text if text.isprintable() else shown(text)


def _sentence(root: Mapping, fault: Any) -> tuple[Place, str]:
    path = _path(fault["loc"])
    kind: str = fault["type"]
    found = fault["input"]
    match kind:
        case "missing":
            return place_of(root, path), _missing(root, path)
        case "extra_forbidden":
            options = _keys_of(path[:-1], root)
            holder = f"{subject(root, path[:-1])}: " if len(path) > 1 else ""
            key = str(path[-1])
            whose = "; the pose is that of the platform" if path[0] == "pose" else ""
            near = _owners(path) or did_you_mean(key, options)
            return key_place_of(root, path), (
                f"{holder}unknown key {shown(key)}{near}; "
                f"allowed: {', '.join(options)}{whose}"
            )
        case "union_tag_invalid" | "union_tag_not_found":
            return _wrong_type(root, path, found)
        case "literal_error":
            options = _options(path)
            return place_of(root, path), (
                f"{subject(root, path)}: unknown {shown(str(found))}"
                f"{did_you_mean(str(found), options)}; allowed: {', '.join(options)}"
            )
        case "string_pattern_mismatch" | "string_too_long":
            return place_of(root, path), (
                f"{subject(root, path)}: {shown(str(found))} is no name: up to 80 "
                f"letters, digits, _ and -"
            )
        case "too_short" if path == ("links",):
            return place_of(root, path), (
                "links: no body is listed; name every body once, the base included"
            )
        case "too_short" | "too_long":
            return place_of(root, path), (
                f"{subject(root, path)}: two entries are expected, but {len(found)} "
                f"were found"
            )
    return place_of(root, path), f"{subject(root, path)}: {_shape(kind, fault)}"


def _missing(root: Mapping, path: Path) -> str:
    key = path[-1]
    if path == ("screwkit",):
        return "the format version is missing; start the file with `screwkit: 1`"
    holder = f"{subject(root, path[:-1])}: " if len(path) > 1 else ""
    if isinstance(key, int):
        found = "one was found" if key == 1 else "none was found"
        return f"{holder}two entries are expected, but {found}"
    return f"{holder}the key {key!r} is missing"


def _wrong_type(root: Mapping, path: Path, found: Any) -> tuple[Place, str]:
    written = find(root, (*path, "type"))
    if not isinstance(found, dict) or written is None:
        place = place_of(root, path)
        if isinstance(found, dict):
            return place, f"{subject(root, path)}: the key 'type' is missing"
        return place, f"{subject(root, path)}: a mapping is expected"
    name = getattr(written, "text", "a list or a mapping")
    options = [str(joint_type) for joint_type in JointType]
    near = did_you_mean(name, options) or _by_letter(name)
    return written.place, (
        f"{subject(root, path)}, type: unknown {shown(name)}{near}; "
        f"allowed: {', '.join(options)}"
    )


def _by_letter(name: str) -> str:
    for joint_type, kind in CATALOGUE.items():
        if kind.letter and kind.letter == name.upper():
            return f" (did you mean {str(joint_type)!r}?)"
    return ""


def _shape(kind: str, fault: Any) -> str:
    expected = {
        "dict_type": "a mapping",
        "model_type": "a mapping",
        "model_attributes_type": "a mapping",
        "list_type": "a list",
        "tuple_type": "a list",
        "string_type": "text",
    }.get(kind)
    if expected is None:
        return str(fault["msg"])
    found = fault["input"]
    if isinstance(found, list):
        what = "a list"
    elif isinstance(found, dict):
        what = "a mapping"
    else:
        what = shown(str(found)) if found else "nothing"
    return f"{expected} is expected, but {what} was found"


def _keys_of(path: Path, root: Mapping) -> list[str]:
    """The keys allowed at ``path``."""
    if path[:1] == ("joints",) and len(path) == 2:
        written = getattr(find(root, (*path, "type")), "text", "")
        for model in get_args(get_args(JointEntry)[0]):
            if written in _literals(model, "type"):
                return sorted(model.model_fields, key=_IN_FILES.index)
    model = _model_at(path, root)
    return list(model.model_fields) if model else []


def _owners(path: Path) -> str:
    """Which joints have the key that ends ``path``, where this one has it not."""
    if path[0] != "joints" or len(path) != 3:
        return ""
    models = get_args(get_args(JointEntry)[0])
    having = [model for model in models if path[-1] in model.model_fields]
    owners = [name for model in having for name in _literals(model, "type")]
    return f": it belongs to {', '.join(owners)} joints" if owners else ""


def _literals(model: type[BaseModel], field: str) -> tuple[str, ...]:
    return tuple(get_args(model.model_fields[field].annotation))


def _options(path: Path) -> list[str]:
    """The words allowed at a path that ends in a literal."""
    if path[-1] == "status":
        return list(_literals(schema.ClaimEntry, "status"))
    return list(_literals(MechanismEntry, str(path[0])))


def _model_at(path: Path, root: Mapping) -> type[BaseModel] | None:
    match path:
        case ():
            return MechanismEntry
        case ("joints", int(), "mdh"):
            return schema.MdhEntry
        case ("parameters", str()):
            return schema.ParameterEntry
        case ("variables", str()):
            return schema.VariableEntry
        case ("points" | "vectors", str()):
            return schema.VectorEntry
        case ("expected", str()) | ("variants", str(), "expected", str()):
            return schema.ClaimEntry
        case ("variants", str()):
            return schema.VariantEntry
        case ("pose",):
            return schema.PoseEntry
        case ("pose", "rotation"):
            return schema.RotationEntry
        case ("weights",):
            return schema.WeightsEntry
    return None
