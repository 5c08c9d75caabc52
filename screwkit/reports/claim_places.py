"""Whether the place that a claim names exists in the JSON results.

The places are those of the JSON Schema, which comes from the types of the results: a
slip in a path is a fault of the file and not a claim that nobody ever compares.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from typing import Final

from screwkit.algebra.names import did_you_mean, shown
from screwkit.reports.wire import Json, schema
from screwkit.results.manipulability import Manipulability
from screwkit.results.mobility import Mobility
from screwkit.results.schemes import Schemes
from screwkit.results.screws import Screws
from screwkit.results.singularities import Singularities
from screwkit.results.undecided import Undecided

_QUESTIONS: Final[dict[str, type]] = {
    "mobility": Mobility,
    "screws": Screws,
    "singularities": Singularities,
    "schemes": Schemes,
    "manipulability": Manipulability,
}
"""What `analyze` answers, and so what claims are compared with."""


@cache
def why_no_place(question: str) -> str:
    """Why a claim on this path could never be compared; empty where it can.

    Args:
        question: A dotted path; what stands behind ``#`` is free.

    >>> why_no_place("mobility.loop_rank"), why_no_place("screws.limbs.0.name#right")
    ('', '')
    >>> why_no_place("mobility.loop_rnk").partition(";")[0]
    "no 'loop_rnk' in mobility (did you mean 'loop_rank'?)"
    """
    definitions, roots = _schemas()
    here: list[Json] = [roots]
    done: list[str] = []
    for step in question.partition("#")[0].split("."):
        here = [one for node in here for one in _plainly(node, definitions)]
        if any(_is_free(node) for node in here):
            return ""
        below = [one for node in here for one in _below(node, step)]
        if not below:
            return _explained(step, ".".join(done), here)
        here = below
        done.append(step)
    return ""


@cache
def _schemas() -> tuple[Json, Json]:
    """Definitions, and one property a question."""
    definitions: Json = {}
    answers = {
        name: {"anyOf": [schema(kind, definitions), schema(Undecided, definitions)]}
        for name, kind in _QUESTIONS.items()
    }
    return definitions, {"properties": answers}


def _plainly(node: Json, definitions: Json) -> Iterator[Json]:
    """The schemas of which a value may be, without references and choices."""
    if "$ref" in node:
        yield from _plainly(definitions[node["$ref"].rpartition("/")[2]], definitions)
    elif "anyOf" in node:
        for option in node["anyOf"]:
            yield from _plainly(option, definitions)
    else:
        yield node


def _is_free(node: Json) -> bool:
    """Whether anything may stand there."""
    return not node or (node.get("type") == "object" and "properties" not in node)


def _below(node: Json, step: str) -> Iterator[Json]:
    if step in node.get("properties", {}):
        yield node["properties"][step]
    if step.isascii() and step.isdigit():
        if "items" in node:
            yield node["items"]
        yield from node.get("prefixItems", [])[int(step[:9]) :][:1]


def _explained(step: str, done: str, here: list[Json]) -> str:
    names = list(dict.fromkeys(name for n in here for name in n.get("properties", ())))
    where = f"in {done}" if done else "among the questions"
    if names:
        hint = did_you_mean(step, names)
        return f"no {shown(step)} {where}{hint}; allowed: {', '.join(names)}"
    if any("items" in node or "prefixItems" in node for node in here):
        return f"{done} is a list; a position from 0 is expected, not {shown(step)}"
    return f"{done} is a single value; there is no {shown(step)} in it"
