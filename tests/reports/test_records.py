"""JSON: the keys of the public interface, and the way back without loss."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from reports import samples
from reports.schema_reading import fits

from screwkit.reports.records import (
    Result,
    from_json,
    json_schema_of_results,
    part_from_json,
    to_json,
)
from screwkit.reports.wire import part_to_json
from screwkit.results.mobility import FullCycle

EVERY = [
    samples.MOBILITY,
    samples.SCREWS,
    samples.SINGULARITIES,
    samples.SCHEMES,
    samples.ANALYSIS,
    samples.REFUSED,
    replace(samples.MOBILITY, at_values=None, actuation=None),
    replace(samples.SINGULARITIES, actuation=None),
    replace(samples.SCHEMES, balanced=None, mirror=None),
    replace(samples.ANALYSIS, schemes=samples.REFUSED, screws=samples.REFUSED),
]

# Every key that the interface promises, by path.
PROMISED: dict[str, list[str]] = {
    "mobility": [
        *(f"topology.{k}" for k in ("links", "joints", "freedoms")),
        "topology.independent_loops",
        "topology.components",
        *(f"counts.{k}" for k in ("grubler", "grubler_planar", "moroskine")),
        "counts.gogu",
        "counts.screw",
        "loop_rank",
        "redundant_constraints",
        "instantaneous_mobility",
        "full_cycle.status",
        "full_cycle.mobility",
        *(f"platform.{k}" for k in ("twist_dimension", "translations", "rotations")),
        *(f"platform.{k}" for k in ("motion_type", "wrench_dimension", "couples")),
        "platform.finite_motion_types",
        *(f"actuation.{k}" for k in ("actuated", "remaining_mobility")),
        "actuation.remaining_platform_freedom",
        *(f"partition.{k}" for k in ("mobility", "connectivity", "redundancy")),
        "partition.indeterminacy",
        *(
            f"at_values.{k}"
            for k in (
                "loop_rank",
                "redundant_constraints",
                "instantaneous_mobility",
                "platform",
                "actuation",
                "full_cycle",
            )
        ),
    ],
    "screws": [
        "order",
        "frame",
        "point",
        *(f"limbs.0.{k}" for k in ("name", "joints", "twist_dimension", "twists")),
        "limbs.0.wrench_dimension",
        *(
            f"limbs.0.wrenches.0.{k}"
            for k in ("coordinates", "kind", "axis", "point", "pitch")
        ),
        *(f"platform.{k}" for k in ("twist_dimension", "twists")),
        *(f"platform.{k}" for k in ("wrench_dimension", "wrenches")),
        *(
            f"actuation_wrenches.0.{k}"
            for k in ("joint", "freedom", "coordinates", "kind")
        ),
    ],
    "singularities": [
        *(f"limb.0.{k}" for k in ("limb", "generic_rank", "complete")),
        *(
            f"limb.0.components.0.{k}"
            for k in ("equations", "codimension", "solutions", "rank", "geometry")
        ),
        "limb.0.components.0.solutions.0.variable",
        "limb.0.components.0.solutions.0.values",
        *(f"constraint.{k}" for k in ("generic_rank", "complete", "components")),
        *(f"actuation.{k}" for k in ("actuated", "admissible", "complete")),
        "actuation.components",
    ],
    "schemes": [
        "size",
        "total",
        "admissible",
        "balanced.total",
        "balanced.admissible",
        *(
            f"schemes.2.{k}"
            for k in ("actuated", "admissible", "generic_rank", "locus", "idle")
        ),
        "schemes.2.reason",
    ],
}
SAMPLES: dict[str, Result] = {
    "mobility": samples.MOBILITY,
    "screws": samples.SCREWS,
    "singularities": samples.SINGULARITIES,
    "schemes": samples.SCHEMES,
}


@pytest.mark.parametrize("result", EVERY, ids=lambda r: type(r).__name__)
def test_the_way_back_is_lossless(result: Any) -> None:
    assert from_json(json.loads(json.dumps(to_json(result)))) == result
    assert part_from_json(json.loads(json.dumps(part_to_json(result)))) == result


@pytest.mark.parametrize(
    ("question", "path"),
    [(question, path) for question, paths in PROMISED.items() for path in paths],
)
def test_the_promised_keys_are_there(question: str, path: str) -> None:
    data: Any = to_json(SAMPLES[question])
    assert {"schema", "case", "version"} <= set(data)
    for key in path.split("."):
        data = data[int(key)] if key.isdecimal() else data[key]


def test_twists_are_bare_coordinates() -> None:
    limb = to_json(samples.SCREWS)["limbs"][0]
    assert limb["twists"][0] == ["0", "1", "0", "-b1", "0", "0"]
    assert limb["twist_details"][0]["kind"] == "rotation"


def test_a_file_of_numbers_has_no_values() -> None:
    assert "at_values" not in to_json(replace(samples.MOBILITY, at_values=None))


def test_undecided_is_said_in_place() -> None:
    half = replace(samples.ANALYSIS, schemes=samples.REFUSED)
    schemes = to_json(half)["schemes"]
    assert schemes["status"] == "undecided"
    assert schemes["reason"].startswith("expanding")
    open_cycle = FullCycle("undecided", (), "why")
    cycle = to_json(replace(samples.MOBILITY, full_cycle=open_cycle))["full_cycle"]
    assert cycle.pop("branches") == []
    assert cycle == {"status": "undecided", "mobility": [], "reason": "why"}


def test_an_unknown_document_is_refused() -> None:
    with pytest.raises(ValueError, match="schema 'other/9' is unknown"):
        from_json({"schema": "other/9"})
    with pytest.raises(ValueError, match="question None is none of mobility"):
        from_json({"schema": "screwkit/1"})


@pytest.mark.parametrize("result", EVERY, ids=lambda r: type(r).__name__)
def test_documents_fit_their_schema(result: Any) -> None:
    schema = json_schema_of_results()
    definitions = schema["$defs"]
    data = to_json(result)
    assert fits(definitions[type(result).__name__], data, definitions)
    assert not fits(definitions["Mobility"], {**data, "loop_rank": "6"}, definitions)
