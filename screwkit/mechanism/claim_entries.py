"""Expected values as a file writes them: numbers, truths, text and lists of these.

A claim says where its value comes from; whether it holds is for the analyses to find.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from screwkit.algebra.closed_values import closed_value
from screwkit.mechanism import nodes
from screwkit.mechanism.model import Claim
from screwkit.mechanism.nodes import Node, Path, Scalar, find
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.schema import ClaimEntry


def read_claims(
    entries: Mapping[str, ClaimEntry], holder: Path, reading: Reading
) -> tuple[Claim, ...]:
    """The claims that stand at ``holder``, of the file or of one of its variants."""
    found = []
    for question, claim in entries.items():
        path: Path = (*holder, question)
        if reason := reading.outside.why_no_place(question):
            reading.fault_at_key(path, f"{', '.join(map(str, holder))}: {reason}")
        tolerance = 0.0
        if claim.tolerance is not None:
            expression = reading.scalar((*path, "tolerance"), claim.tolerance, ())
            value = closed_value(expression) if expression is not None else None
            tolerance = value or 0.0
            if expression is not None and (value is None or value < 0):
                reading.fault((*path, "tolerance"), "a tolerance is a number from 0")
        node = find(reading.root, (*path, "value"))
        found.append(
            Claim(
                question,
                claim_value(node) if node is not None else None,
                claim.status,
                claim.source,
                claim.holds,
                claim.note,
                tolerance,
            )
        )
    return tuple(found)


def claim_value(node: Node) -> Any:
    """The value of a claim: unquoted numbers and truths are such, the rest is text."""
    match node:
        case Scalar(text, quoted=quoted):
            return text if quoted else _literal(text)
        case nodes.Sequence(items):
            return [claim_value(item) for item in items]
        case nodes.Mapping(entries):
            return {entry.key: claim_value(entry.value) for entry in entries}


def _literal(text: str) -> Any:
    if text in {"true", "false"}:
        return text == "true"
    for convert in (int, float):
        try:
            number = convert(text)
        except ValueError:
            continue
        plain_digits = text.lstrip("+-").replace(".", "", 1)[:1].isdigit()
        return number if plain_digits and "_" not in text else text
    return text
