"""Results as JSON documents with the keys of the public interface, and back.

Every document carries ``schema``, ``case`` and ``version``, and under ``question`` the
name of what was asked; exact quantities stay strings of the expression grammar.  The
JSON Schema is generated from the same dataclasses, so that it cannot drift.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from importlib import metadata
from typing import Any, Final, TypeAlias

from screwkit.conventions import RESULT_SCHEMA
from screwkit.errors import Fault
from screwkit.reports import showing  # noqa: F401 -- answers show themselves
from screwkit.reports.wire import Json, decode, encode, schema
from screwkit.results.analysis import Analysis, Description
from screwkit.results.distance import Distance
from screwkit.results.manipulability import Manipulability
from screwkit.results.mobility import Mobility
from screwkit.results.reach import Reach
from screwkit.results.schemes import Schemes
from screwkit.results.screws import RelativeMotion, Screws
from screwkit.results.singularities import (
    ActuationSingularities,
    ConstraintSingularities,
    LimbSingularities,
    Singularities,
)
from screwkit.results.sweep import Sweep
from screwkit.results.undecided import Undecided
from screwkit.results.verification import Verification
from screwkit.results.view import View

Result: TypeAlias = (
    Mobility
    | Screws
    | RelativeMotion
    | Singularities
    | Distance
    | Schemes
    | Manipulability
    | Reach
    | Sweep
    | Verification
    | View
    | Analysis
    | Undecided
)

QUESTIONS: Final[dict[str, type]] = {
    "mobility": Mobility,
    "screws": Screws,
    "relative_motion": RelativeMotion,
    "singularities": Singularities,
    "distance": Distance,
    "schemes": Schemes,
    "manipulability": Manipulability,
    "reach": Reach,
    "sweep": Sweep,
    "verify": Verification,
    "view": View,
    "analyze": Analysis,
}
_NAMES: Final = {kind: name for name, kind in QUESTIONS.items()}
_PARTS: Final[dict[str, type]] = {
    kind.__name__: kind
    for kind in (
        *QUESTIONS.values(),
        Undecided,
        Description,
        LimbSingularities,
        ConstraintSingularities,
        ActuationSingularities,
    )
}


@cache
def version() -> str:
    """The installed version of the package."""
    import screwkit  # noqa: PLC0415 -- the package must not load while it loads

    declared = getattr(screwkit, "__version__", None)
    if declared is not None:
        return str(declared)
    try:
        return metadata.version("screwkit")
    except metadata.PackageNotFoundError:
        return "0"


def document(case: str, content: Mapping[str, Any]) -> Json:
    """A JSON document of this package with that content."""
    return {"schema": RESULT_SCHEMA, "case": case, "version": version(), **content}


def to_json(result: Result, case: str = "") -> Json:
    """A result as plain data for ``json.dumps``.

    Args:
        result: Any answer, or the refusal of one.
        case: Name of the case, for answers that do not carry it.
    """
    content = encode(result)
    name = content.pop("case", case)
    if type(result) in _NAMES:
        content = {"question": _NAMES[type(result)], **content}
    return document(name, content)


def from_json(data: Mapping[str, Any]) -> Result:
    """The result that `to_json` wrote.

    Raises:
        ValueError: If the document is of another schema or shape.
    """
    if data.get("schema") != RESULT_SCHEMA:
        raise ValueError(
            f"schema {data.get('schema')!r} is unknown; this is {RESULT_SCHEMA!r}"
        )
    if data.get("status") == "undecided" and "question" not in data:
        return decode(Undecided, dict(data))  # type: ignore[no-any-return]
    question = data.get("question")
    if question not in QUESTIONS:
        known = ", ".join(QUESTIONS)
        raise ValueError(f"question {question!r} is none of {known}")
    return decode(QUESTIONS[question], dict(data))  # type: ignore[no-any-return]


def part_from_json(data: Mapping[str, Any]) -> Any:
    """The part that `wire.part_to_json` wrote; None for a type unknown here."""
    kind = _PARTS.get(str(data.get("type")))
    return None if kind is None else decode(kind, data["value"])


def faults_to_json(source: str, faults: tuple[Fault, ...]) -> Json:
    """What is wrong in a file, as the content of a document."""
    return {
        "error": {
            "kind": "file",
            "source": source,
            "faults": [encode(fault) for fault in faults],
        }
    }


def json_schema_of_results() -> Json:
    """JSON Schema of every document that `to_json` writes."""
    definitions: Json = {}
    head = {
        "schema": {"const": RESULT_SCHEMA},
        "case": {"type": "string"},
        "version": {"type": "string"},
    }
    options = [
        {
            "allOf": [schema(kind, definitions)],
            "properties": {"question": {"const": name}},
            "required": ["question"],
        }
        for name, kind in QUESTIONS.items()
    ]
    undecided = schema(Undecided, definitions)
    definitions["Undecided"]["required"] = ["status", "reason"]
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "An answer of screwkit",
        "type": "object",
        "properties": head,
        "required": list(head),
        "anyOf": [*options, undecided],
        "$defs": definitions,
    }
