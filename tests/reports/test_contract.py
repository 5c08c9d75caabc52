"""Real answers about the humanoid have every key that the public interface samples."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from typing import Any

import pytest

import screwkit as sk
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.reports.records import from_json, to_json

Shape = Any


def optional(shape: Shape) -> Shape:
    return ("optional", shape)


NUMBER, TEXT, YES = int, str, bool
PLATFORM = {
    "twist_dimension": NUMBER,
    "translations": NUMBER,
    "rotations": NUMBER,
    "motion_type": TEXT,
    "wrench_dimension": NUMBER,
    "couples": NUMBER,
    "finite_motion_types": [TEXT],
}
ACTUATION = {
    "actuated": [TEXT],
    "remaining_mobility": NUMBER,
    "remaining_platform_freedom": NUMBER,
}
FREEDOMS = {
    "loop_rank": NUMBER,
    "redundant_constraints": NUMBER,
    "instantaneous_mobility": NUMBER,
    "full_cycle": {"status": TEXT, "mobility": [NUMBER]},
    "platform": PLATFORM,
    "actuation": ACTUATION,
}
WRENCH = {
    "coordinates": [TEXT],
    "kind": TEXT,
    "axis": [TEXT],
    "point": [TEXT],
    "pitch": TEXT,
}
SYSTEM = {
    "twist_dimension": NUMBER,
    "twists": [[TEXT]],
    "wrench_dimension": NUMBER,
    "wrenches": [WRENCH],
}
COMPONENTS = [
    {
        "equations": [TEXT],
        "codimension": NUMBER,
        "solutions": [{"variable": TEXT, "values": [TEXT]}],
        "rank": NUMBER,
        "geometry": optional(TEXT),
    }
]
HEAD = {"schema": TEXT, "case": TEXT, "version": TEXT}
CONTRACT: dict[str, dict[str, Shape]] = {
    "mobility": {
        "topology": dict.fromkeys(
            ("links", "joints", "freedoms", "independent_loops", "components"), NUMBER
        ),
        "counts": {
            "grubler": NUMBER,
            "grubler_planar": optional(NUMBER),
            "moroskine": NUMBER,
            "gogu": NUMBER,
            "screw": NUMBER,
        },
        **FREEDOMS,
        "partition": dict.fromkeys(
            ("mobility", "connectivity", "redundancy", "indeterminacy"), NUMBER
        ),
        "at_values": FREEDOMS,
    },
    "screws": {
        "order": TEXT,
        "frame": TEXT,
        "point": TEXT,
        "limbs": [{"name": TEXT, "joints": [TEXT], **SYSTEM}],
        "platform": SYSTEM,
        "actuation_wrenches": [
            {"joint": TEXT, "freedom": NUMBER, "coordinates": [TEXT], "kind": TEXT}
        ],
    },
    "singularities": {
        "limb": [
            {
                "limb": TEXT,
                "generic_rank": NUMBER,
                "complete": YES,
                "components": COMPONENTS,
            }
        ],
        "constraint": {
            "generic_rank": NUMBER,
            "complete": YES,
            "components": COMPONENTS,
        },
        "actuation": {
            "actuated": [TEXT],
            "admissible": YES,
            "complete": YES,
            "components": COMPONENTS,
        },
    },
    "schemes": {
        "size": NUMBER,
        "total": NUMBER,
        "admissible": NUMBER,
        "balanced": {"total": NUMBER, "admissible": NUMBER},
        "schemes": [
            {
                "actuated": [TEXT],
                "admissible": YES,
                "generic_rank": NUMBER,
                "locus": [TEXT],
                "idle": [TEXT],
                "reason": optional(TEXT),
            }
        ],
    },
}
EXACT = {"twists", "coordinates", "axis", "point", "pitch", "equations", "values"}
EXACT |= {"locus", "idle"}
QUESTIONS: dict[str, Callable[[Any], Any]] = {
    "mobility": sk.mobility,
    "screws": sk.screws,
    "singularities": sk.singularities,
    "schemes": sk.schemes,
}


@pytest.fixture(scope="module")
def documents() -> dict[str, dict[str, Any]]:
    """The answers as they are printed and read again."""
    case = sk.load("nao_t14")
    return {
        name: json.loads(json.dumps(to_json(ask(case))))
        for name, ask in QUESTIONS.items()
    }


def departures(value: Any, shape: Shape, place: str) -> Iterator[str]:
    """Where a value is not of a shape; further keys are allowed."""
    if isinstance(shape, tuple):
        if value is not None:
            yield from departures(value, shape[1], place)
    elif isinstance(shape, dict):
        if not isinstance(value, dict):
            yield f"{place}: {value!r} is no object"
            return
        for key, inner in shape.items():
            if key not in value:
                yield f"{place}.{key} is missing"
            else:
                yield from departures(value[key], inner, f"{place}.{key}")
    elif isinstance(shape, list):
        if not isinstance(value, list):
            yield f"{place}: {value!r} is no array"
            return
        for index, item in enumerate(value):
            yield from departures(item, shape[0], f"{place}.{index}")
    elif type(value) is not shape:
        yield f"{place}: {value!r} is not {shape.__name__}"


def exact_texts(value: Any, key: str = "") -> Iterator[str]:
    """Every string under a key that promises the grammar."""
    if isinstance(value, dict):
        for name, item in value.items():
            yield from exact_texts(item, name if name in EXACT else "")
    elif isinstance(value, list):
        for item in value:
            yield from exact_texts(item, key)
    elif isinstance(value, str) and key in EXACT and value:
        yield value


@pytest.mark.parametrize("question", list(CONTRACT))
def test_every_promised_key_is_there_with_its_type(
    question: str, documents: dict[str, dict[str, Any]]
) -> None:
    shape = {**HEAD, **CONTRACT[question]}
    assert list(departures(documents[question], shape, question)) == []


@pytest.mark.parametrize("question", ["screws", "singularities", "schemes"])
def test_every_exact_text_can_be_read_back(
    question: str, documents: dict[str, dict[str, Any]]
) -> None:
    found = set()
    for key in CONTRACT[question]:
        content = documents[question][key]
        if isinstance(content, dict | list):
            found |= set(exact_texts(content))
    assert len(found) > 20
    for text in found:
        parse(text, limits=RESULT_LIMITS)


@pytest.mark.parametrize("question", list(CONTRACT))
def test_documents_read_back_are_the_same_answers(
    question: str, documents: dict[str, dict[str, Any]]
) -> None:
    document = documents[question]
    assert json.loads(json.dumps(to_json(from_json(document)))) == document


def test_the_numbers_are_those_of_the_interface(
    documents: dict[str, dict[str, Any]],
) -> None:
    mobility = documents["mobility"]
    assert mobility["counts"] == {
        "grubler": 4,
        "grubler_planar": None,
        "moroskine": 4,
        "gogu": 4,
        "screw": 4,
    }
    assert mobility["platform"]["motion_type"] == "1T3R"
    assert mobility["full_cycle"]["mobility"] == [4]
    schemes = documents["schemes"]
    assert (schemes["total"], schemes["admissible"]) == (210, 139)
    assert (schemes["balanced"]["total"], schemes["balanced"]["admissible"]) == (
        100,
        63,
    )
