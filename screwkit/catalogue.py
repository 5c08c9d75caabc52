"""What needs no exact work: checking a file, the bundled cases, the schemas."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

from screwkit import errors
from screwkit.errors import MechanismFileError
from screwkit.terminal import emit, emit_json, faulty, line_of, note, text_of

_TWO_LINES: Final = 80
"""Characters of a title in the list of cases."""


def check_case(
    case: str, changes: Mapping[str, Any], *, as_json: bool, quiet: bool
) -> int:
    """Read a file and say whether it is right.

    Args:
        case: File or bundled case.
        changes: As of `screwkit.load`; entries may be empty.
        as_json: Whether a document is wanted.
        quiet: Whether the exit code is answer enough.
    """
    try:
        mechanism = _read(case, {k: v for k, v in changes.items() if v})
    except MechanismFileError as error:
        return faulty(case, error.source, error.faults, as_json=as_json)
    from screwkit.algebra.names import counted  # noqa: PLC0415

    counts = _counts(mechanism)
    if as_json:
        title = {"title": mechanism.title}
        emit_json(mechanism.name, {"valid": True, **title, **counts})
    elif not quiet:
        bodies = counted(counts["links"], "body", "bodies")
        joints = counted(counts["joints"], "joint")
        freedoms = counted(counts["freedoms"], "freedom")
        loops = counted(counts["loops"], "loop")
        said = (
            f"{case}: right. {bodies}, {joints} with {freedoms}, {loops}; base "
            f"{mechanism.base}, platform {mechanism.platform}"
        )
        emit(line_of(said))
    return errors.EXIT_DONE


def _read(case: str, changes: Mapping[str, Any] | None = None) -> Any:
    """The mechanism of a file, or of a bundled case."""
    from screwkit.case import load  # noqa: PLC0415

    return load(case, **changes or {}).mechanism


def _counts(mechanism: Any) -> dict[str, int]:
    from screwkit.mechanism.graph import independent_loops  # noqa: PLC0415
    from screwkit.mechanism.joints import freedom_labels  # noqa: PLC0415

    return {
        "links": len(mechanism.links),
        "joints": len(mechanism.joints),
        "freedoms": sum(
            len(freedom_labels(joint, mechanism.space)) for joint in mechanism.joints
        ),
        "loops": independent_loops(mechanism),
    }


def list_cases(*, as_json: bool) -> int:
    """All bundled cases with their titles and sources."""
    from screwkit.case import bundled_cases  # noqa: PLC0415

    entries = []
    for name in bundled_cases():
        try:
            mechanism = _read(name)
        except errors.ScrewkitError as error:
            note(f"screwkit: {name}: {error}")
            continue
        counts = _counts(mechanism)
        entries.append(
            {
                "name": name,
                "title": mechanism.title,
                "source": mechanism.source,
                "known_for": mechanism.known_for,
                "variants": [variant.name for variant in mechanism.variants],
                "joints": counts["joints"],
                "loops": counts["loops"],
            }
        )
    if as_json:
        emit_json("", {"cases": entries})
        return errors.EXIT_DONE
    from screwkit.reports.sections import CaseEntry, CaseList  # noqa: PLC0415

    listed = tuple(
        CaseEntry(
            name=entry["name"],
            title=_headline(entry["title"], entry["known_for"]),
            source=entry["source"],
            joints=entry["joints"],
            loops=entry["loops"],
        )
        for entry in entries
    )
    emit(text_of(CaseList(listed)))
    return errors.EXIT_DONE


def _headline(title: str, known_for: str) -> str:
    """The title, with what the mechanism is known for where two lines hold both."""
    both = " – ".join(filter(None, (title, known_for)))
    return both if len(both) <= _TWO_LINES else title


def print_schema(which: str) -> int:
    """The JSON Schemas, both in one document or one alone."""
    import json  # noqa: PLC0415

    schemas: dict[str, Any] = {}
    if which != "results":
        from screwkit.mechanism.schema import json_schema  # noqa: PLC0415

        schemas["mechanism"] = json_schema()
    if which != "mechanism":
        from screwkit.reports.records import json_schema_of_results  # noqa: PLC0415

        schemas["results"] = json_schema_of_results()
    if which == "both":
        emit_json("", schemas)
    else:
        emit(json.dumps(schemas[which], indent=1) + "\n")
    return errors.EXIT_DONE
