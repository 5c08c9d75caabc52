"""Frozen result types as JSON values and back, driven by their annotations.

A dataclass becomes an object with one key a field, a tuple an array; reading goes the
same way and is lossless.  The few types whose contract asks for another shape (twists
as bare coordinates, a wrench flattened into its joint's entry) are listed by hand.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import (
    Any,
    Final,
    Literal,
    TypeAlias,
    Union,
    get_args,
    get_origin,
    get_type_hints,
)

from screwkit.results.mobility import Mobility
from screwkit.results.screws import (
    ActuationWrench,
    IdentifiedScrew,
    LimbScrews,
    PlatformScrews,
    RelativeMotion,
)
from screwkit.results.undecided import Undecided

Json: TypeAlias = dict[str, Any]


def encode(value: Any) -> Any:
    """A result, or a part of one, as a JSON value."""
    if is_dataclass(value) and not isinstance(value, type):
        plain = {f.name: encode(getattr(value, f.name)) for f in fields(value)}
        shape = _SHAPES.get(type(value))
        return shape.written(plain) if shape else plain
    if isinstance(value, tuple | list):
        return [encode(item) for item in value]
    if isinstance(value, dict):
        return {str(key): encode(item) for key, item in value.items()}
    return value


def part_to_json(part: Any) -> Json:
    """A finished part of an answer, with the name of its type."""
    return {"type": type(part).__name__, "value": encode(part)}


def decode(annotation: Any, data: Any) -> Any:
    """The value of that type which `encode` wrote.

    Raises:
        ValueError: If the data is not of that shape.
    """
    if annotation is Any:
        return data
    origin = get_origin(annotation)
    if origin in (Union, UnionType):
        return _decode_union(get_args(annotation), data)
    if origin is tuple:
        items = get_args(annotation)
        if items[-1] is Ellipsis:
            return tuple(decode(items[0], item) for item in data)
        return tuple(decode(a, item) for a, item in zip(items, data, strict=True))
    if isinstance(annotation, type) and is_dataclass(annotation):
        return _decode_object(annotation, data)
    if origin is Literal and data not in get_args(annotation):
        raise ValueError(f"expected one of {get_args(annotation)}, got {data!r}")
    if annotation is NoneType and data is not None:
        raise ValueError(f"expected null, got {data!r}")
    return data


def _decode_union(options: tuple[Any, ...], data: Any) -> Any:
    if data is None:
        return None
    left = [option for option in options if option is not NoneType]
    if Undecided in left:
        if isinstance(data, dict) and data.get("status") == "undecided":
            return decode(Undecided, data)
        left.remove(Undecided)
    return decode(left[0], data)


def _decode_object(annotation: type, data: Any) -> Any:
    if not isinstance(data, dict):
        raise ValueError(f"expected an object for {annotation.__name__}")  # noqa: TRY004
    shape = _SHAPES.get(annotation)
    plain = shape.read(data) if shape else data
    hints = _hints(annotation)
    known = {
        f.name: decode(hints[f.name], plain[f.name])
        for f in fields(annotation)
        if f.name in plain
    }
    try:
        return annotation(**known)
    except TypeError as error:
        raise ValueError(f"{annotation.__name__}: {error}") from error


def schema(annotation: Any, definitions: Json) -> Json:
    """JSON Schema of what `encode` writes for a type; classes go to ``definitions``."""
    simple: dict[Any, Json] = {
        Any: {},
        str: {"type": "string"},
        int: {"type": "integer"},
        float: {"type": "number"},
        bool: {"type": "boolean"},
        NoneType: {"type": "null"},
    }
    if annotation in simple:
        return simple[annotation]
    origin = get_origin(annotation)
    if origin in (Union, UnionType):
        return {
            "anyOf": [schema(option, definitions) for option in get_args(annotation)]
        }
    if origin is tuple:
        items = get_args(annotation)
        if items[-1] is Ellipsis:
            return {"type": "array", "items": schema(items[0], definitions)}
        entries = [schema(item, definitions) for item in items]
        return {
            "type": "array",
            "prefixItems": entries,
            "minItems": len(items),
            "maxItems": len(items),
        }
    if origin is Literal:
        return {"enum": list(get_args(annotation))}
    name = annotation.__name__
    if name not in definitions:
        definitions[name] = {}
        definitions[name] = _object_schema(annotation, definitions)
    return {"$ref": f"#/$defs/{name}"}


def _object_schema(annotation: type, definitions: Json) -> Json:
    hints = _hints(annotation)
    properties = {
        f.name: schema(hints[f.name], definitions) for f in fields(annotation)
    }
    required = [
        f.name
        for f in fields(annotation)
        if f.default is MISSING and f.default_factory is MISSING
    ]
    written: Json = {
        "type": "object",
        "description": (annotation.__doc__ or "").split("\n", maxsplit=1)[0],
        "properties": properties,
        "required": required,
    }
    shape = _SHAPES.get(annotation)
    return shape.described(written) if shape else written


@cache
def _hints(annotation: type) -> dict[str, Any]:
    return get_type_hints(annotation)


# The shapes that differ from the fields of the dataclass.


@dataclass(frozen=True)
class _Shape:
    written: Callable[[Json], Json]
    read: Callable[[Json], Json]
    described: Callable[[Json], Json]


def _twists_apart(plain: Json) -> Json:
    """``twists`` as bare coordinates, what is known of them in ``twist_details``."""
    screws = plain["twists"]
    details = [{k: v for k, v in s.items() if k != "coordinates"} for s in screws]
    return {
        **plain,
        "twists": [screw["coordinates"] for screw in screws],
        "twist_details": details,
    }


def _twists_together(data: Json) -> Json:
    details = data.get("twist_details") or [
        {"kind": "", "axis": [], "point": [], "pitch": ""} for _ in data["twists"]
    ]
    pairs = zip(data["twists"], details, strict=True)
    return {**data, "twists": [{**d, "coordinates": c} for c, d in pairs]}


def _twists_described(written: Json) -> Json:
    properties = dict(written["properties"])
    strings = {"type": "array", "items": {"type": "string"}}
    properties["twist_details"] = {"type": "array", "items": {"type": "object"}}
    properties["twists"] = {"type": "array", "items": strings}
    return {**written, "properties": properties}


_SCREW_KEYS: Final = tuple(f.name for f in fields(IdentifiedScrew))


def _wrench_flat(plain: Json) -> Json:
    screw = plain.pop("screw") or dict.fromkeys(_SCREW_KEYS)
    return {**plain, **screw}


def _wrench_nested(data: Json) -> Json:
    known = data.get("coordinates") is not None
    screw = {key: data[key] for key in _SCREW_KEYS if key in data} if known else None
    return {**data, "screw": screw}


def _wrench_described(written: Json) -> Json:
    properties = dict(written["properties"])
    del properties["screw"]
    for key in _SCREW_KEYS:
        kind = "array" if key in ("coordinates", "axis", "point") else "string"
        properties[key] = {"type": [kind, "null"]}
    required = [key for key in written["required"] if key != "screw"]
    return {**written, "properties": properties, "required": required}


def _values_optional(plain: Json) -> Json:
    for key in ("at_values", "at_posture"):
        if plain[key] is None:
            del plain[key]
    return plain


def _same(data: Json) -> Json:
    return data


_TWISTS: Final = _Shape(_twists_apart, _twists_together, _twists_described)
_SHAPES: Final[dict[type, _Shape]] = {
    LimbScrews: _TWISTS,
    PlatformScrews: _TWISTS,
    RelativeMotion: _TWISTS,
    ActuationWrench: _Shape(_wrench_flat, _wrench_nested, _wrench_described),
    Mobility: _Shape(_values_optional, _same, _same),
}
