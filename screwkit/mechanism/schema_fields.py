"""The kinds of text a file holds, as fields of the models: expressions, names, flags.

Each validator checks shape alone and says what was expected; each carries the JSON
Schema of what a person may write, which for most of them is text or a number.
"""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from screwkit.conventions import FORMAT_VERSION

SCALAR_SCHEMA: dict[str, Any] = {"type": ["string", "number"]}
VECTOR_SCHEMA: dict[str, Any] = {
    "anyOf": [
        {"type": "string"},
        {"type": "array", "items": SCALAR_SCHEMA, "minItems": 2, "maxItems": 3},
    ]
}
_LIST_SCHEMA: dict[str, Any] = {"type": "array", "items": SCALAR_SCHEMA}


def _kind(value: object) -> str:
    if isinstance(value, list | tuple):
        return "a list"
    if isinstance(value, dict):
        return "a mapping"
    return f"{value!r}" if value != "" else "nothing"


def _wrong(expected: str, value: object) -> PydanticCustomError:
    return PydanticCustomError(
        "shape",
        "{expected} is expected, but {found} was found",
        {"expected": expected, "found": _kind(value)},
    )


def _formula(value: object) -> str:
    if not isinstance(value, str) or not value:
        raise _wrong("an expression", value)
    return value


def _word(value: object) -> str:
    if not isinstance(value, str) or not value:
        raise _wrong("a name", value)
    return value


def _flag(value: object) -> bool:
    if value not in ("true", "false"):
        raise _wrong("true or false", value)
    return value == "true"


def _formulas(value: object) -> tuple[str, ...]:
    if isinstance(value, str) and value:
        return (value,)
    if not isinstance(value, list) or not all(_is_text(item) for item in value):
        raise _wrong("an expression or a list of them", value)
    return tuple(value)


def _vector(value: object) -> str | tuple[str, ...]:
    if isinstance(value, str) and value:
        return value
    if not isinstance(value, list):
        raise _wrong("a vector [x, y, z] or an expression of named ones", value)
    if len(value) not in (2, 3):
        raise PydanticCustomError(
            "shape",
            "a vector has three coordinates, but {count} found",
            {"count": "one was" if len(value) == 1 else f"{len(value)} were"},
        )
    for letter, item in zip("xyz", value, strict=False):
        if not _is_text(item):
            raise _wrong(f"an expression for {letter}", item)
    return tuple(value)


def _refuse_ragged(rows: list[object]) -> None:
    """Of rows that do not make a square, the first that is too long or too short."""
    for number, row in enumerate(rows, 1):
        if not isinstance(row, list):
            return
        if len(row) != len(rows):
            raise PydanticCustomError(
                "shape",
                "a square matrix is expected: there are {rows} rows, and row {number} "
                "has {count}",
                {
                    "rows": len(rows),
                    "number": number,
                    "count": "one entry" if len(row) == 1 else f"{len(row)} entries",
                },
            )


def _matrix(value: object) -> tuple[str, ...] | tuple[tuple[str, ...], ...]:
    if isinstance(value, list) and value:
        if all(_is_text(item) for item in value):
            return tuple(value)
        if all(
            isinstance(row, list)
            and len(row) == len(value)
            and all(_is_text(item) for item in row)
            for row in value
        ):
            return tuple(tuple(row) for row in value)
        _refuse_ragged(value)
    raise _wrong("a diagonal (a list) or a square matrix (a list of rows)", value)


def _freedoms(value: object) -> bool | tuple[int, ...]:
    if value in ("true", "false"):
        return value == "true"
    if isinstance(value, list) and all(
        isinstance(item, str) and item.isascii() and item.isdigit() and len(item) < 3
        for item in value
    ):
        return tuple(int(item) for item in value)
    raise _wrong("true, false or a list of freedoms from 0", value)


def _version(value: object) -> int:
    if not _is_text(value):
        raise _wrong("the version of the format, `screwkit: 1`,", value)
    if value != str(FORMAT_VERSION):
        raise PydanticCustomError(
            "version",
            "format version {found} is not known; this screwkit reads version "
            f"{FORMAT_VERSION}: write `screwkit: {FORMAT_VERSION}` or update screwkit",
            {"found": _kind(value)},
        )
    return FORMAT_VERSION


def _is_text(value: object) -> bool:
    return isinstance(value, str) and value != ""


Formula: TypeAlias = Annotated[
    str, PlainValidator(_formula), WithJsonSchema(SCALAR_SCHEMA)
]
Word: TypeAlias = Annotated[
    str, PlainValidator(_word), WithJsonSchema({"type": ["string", "number"]})
]
Flag: TypeAlias = Annotated[
    bool, PlainValidator(_flag), WithJsonSchema({"type": "boolean"})
]
Formulas: TypeAlias = Annotated[
    tuple[str, ...],
    PlainValidator(_formulas),
    WithJsonSchema({"anyOf": [SCALAR_SCHEMA, _LIST_SCHEMA]}),
]
Vector: TypeAlias = Annotated[
    str | tuple[str, ...], PlainValidator(_vector), WithJsonSchema(VECTOR_SCHEMA)
]
Weight: TypeAlias = Annotated[
    tuple[str, ...] | tuple[tuple[str, ...], ...],
    PlainValidator(_matrix),
    WithJsonSchema({"anyOf": [_LIST_SCHEMA, {"type": "array", "items": _LIST_SCHEMA}]}),
]
Freedoms: TypeAlias = Annotated[
    bool | tuple[int, ...],
    PlainValidator(_freedoms),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "boolean"},
                {"type": "array", "items": {"type": "integer", "minimum": 0}},
            ]
        }
    ),
]
Version: TypeAlias = Annotated[
    int, PlainValidator(_version), WithJsonSchema({"const": FORMAT_VERSION})
]
