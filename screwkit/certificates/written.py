"""Certificates as JSON documents, and back; what is as usual is not written.

Reading trusts nothing: every value must have the type that its record declares.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields, is_dataclass
from functools import cache
from types import NoneType, UnionType
from typing import Any, Final, Union, get_args, get_origin, get_type_hints

from screwkit.certificates.records import Certificate

SCHEMA: Final = "screwkit-certificate/1"
LARGEST: Final = 400_000_000
"""Bytes of a certificate that is read."""
DEEPEST: Final = 200
"""Records within each other."""


class MalformedError(Exception):
    """A text is no certificate; says where and why."""


def to_text(certificate: Certificate) -> str:
    """The document, one line a part."""
    return json.dumps(_plain(certificate), ensure_ascii=False, indent=None) + "\n"


def from_text(text: str) -> Certificate:
    """The certificate of a document.

    Raises:
        MalformedError: If it is none.
    """
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise MalformedError(f"it is no JSON: {error}") from None
    if not isinstance(data, dict) or data.get("schema") != SCHEMA:
        raise MalformedError(f"it is no document of schema {SCHEMA!r}")
    found: Certificate = _read(Certificate, data, "certificate", 0)
    return found


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        return {
            f.name: _plain(own)
            for f in fields(value)
            for own in [getattr(value, f.name)]
            if f.default is MISSING or own != f.default
        }
    if isinstance(value, tuple | list):
        return [_plain(item) for item in value]
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    return value


@dataclass(frozen=True)
class _Record:
    """What a record may hold.

    Attributes:
        kinds: Of its fields.
        needed: Fields that must be there.
    """

    kinds: Mapping[str, Any]
    needed: tuple[str, ...]


@cache
def _record_of(kind: type) -> _Record | None:
    if not is_dataclass(kind):
        return None
    needed = tuple(f.name for f in fields(kind) if f.default is MISSING)
    return _Record(get_type_hints(kind), needed)


@cache
def _parts_of(kind: Any) -> tuple[Any, tuple[Any, ...]]:
    """What a type is made from: tuple, mapping or union, and of what."""
    return get_origin(kind), get_args(kind)


def _read(kind: Any, data: Any, place: str, depth: int) -> Any:
    if type(data) is kind:
        return data
    if depth > DEEPEST:
        raise MalformedError(f"{place} is nested too deeply")
    origin, inner = _parts_of(kind)
    if origin in (Union, UnionType):
        if data is None:
            return None
        (kind,) = (option for option in inner if option is not NoneType)
        return _read(kind, data, place, depth)
    if origin is tuple:
        if not isinstance(data, list):
            raise MalformedError(f"{place} is no list")
        return tuple(
            _read(inner[0], value, f"{place}[{number}]", depth + 1)
            for number, value in enumerate(data)
        )
    if origin is not None:  # a mapping of names
        if not isinstance(data, dict):
            raise MalformedError(f"{place} is no object")
        return {
            key: _read(inner[1], value, f"{place}.{key}", depth + 1)
            for key, value in data.items()
        }
    record = _record_of(kind)
    if record is not None:
        return _made(kind, record, data, place, depth)
    raise MalformedError(f"{place} is no {kind.__name__}")


def _made(kind: Any, record: _Record, data: Any, place: str, depth: int) -> Any:
    if not isinstance(data, dict):
        raise MalformedError(f"{place} is no object")
    values = {}
    for name, value in data.items():
        own = record.kinds.get(name)
        if own is None:
            raise MalformedError(f"{place} has an unknown key {name!r}")
        values[name] = _read(own, value, f"{place}.{name}", depth + 1)
    for name in record.needed:
        if name not in data:
            raise MalformedError(f"{place} has no {name}")
    return kind(**values)
