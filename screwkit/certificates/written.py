"""Certificates as JSON documents, and back; what is as usual is not written.

Reading trusts nothing: every value must have the type that its record declares.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import MISSING, Field, fields, is_dataclass
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


@cache
def _hints(kind: type) -> dict[str, Any]:
    return get_type_hints(kind)


def _read(kind: Any, data: Any, place: str, depth: int) -> Any:
    if depth > DEEPEST:
        raise MalformedError(f"{place} is nested too deeply")
    origin = get_origin(kind)
    if origin in (Union, UnionType):
        if data is None:
            return None
        (kind,) = (option for option in get_args(kind) if option is not NoneType)
        return _read(kind, data, place, depth)
    if origin is tuple:
        if not isinstance(data, list):
            raise MalformedError(f"{place} is no list")
        item = get_args(kind)[0]
        return tuple(
            _read(item, value, f"{place}[{number}]", depth + 1)
            for number, value in enumerate(data)
        )
    if origin is not None:  # a mapping of names
        if not isinstance(data, dict):
            raise MalformedError(f"{place} is no object")
        item = get_args(kind)[1]
        return {
            key: _read(item, value, f"{place}.{key}", depth + 1)
            for key, value in data.items()
        }
    if is_dataclass(kind):
        return _record(kind, data, place, depth)
    if type(data) is not kind:
        raise MalformedError(f"{place} is no {kind.__name__}")
    return data


def _record(kind: Any, data: Any, place: str, depth: int) -> Any:
    if not isinstance(data, dict):
        raise MalformedError(f"{place} is no object")
    known: dict[str, Field[Any]] = {f.name: f for f in fields(kind)}
    for key in data:
        if key not in known:
            raise MalformedError(f"{place} has an unknown key {key!r}")
    for name, own in known.items():
        if own.default is MISSING and name not in data:
            raise MalformedError(f"{place} has no {name}")
    hints = _hints(kind)
    return kind(
        **{
            name: _read(hints[name], value, f"{place}.{name}", depth + 1)
            for name, value in data.items()
        }
    )
