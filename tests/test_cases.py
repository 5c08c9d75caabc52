"""Every claim of the bundled cases, beside what the engine finds.

A claim says where it comes from.  One that is said to hold must not be contradicted;
one that is printed and does not hold must say what holds instead.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

import pytest

from screwkit.case import bundled_cases, load
from screwkit.claims import checked_claims, value_at
from screwkit.mechanism.model import Claim
from screwkit.questions import mobility, schemes, screws, singularities
from screwkit.reports.records import part_to_json

STATUSES = {"published", "derived", "regression"}
QUESTIONS: dict[str, Callable[..., Any]] = {
    "mobility": mobility,
    "screws": screws,
    "singularities": singularities,
    "schemes": schemes,
}


def claims() -> Iterator[Any]:
    """The claims of every file and of every variant in it."""
    for name in bundled_cases():
        variants = (f"{name}#{variant}" for variant in load(name).variants)
        for case in (name, *variants):
            for claim in load(case).claims:
                yield pytest.param(case, claim, id=f"{case}:{claim.question}")


@cache
def answer(name: str, question: str) -> Any:
    return part_to_json(QUESTIONS[question](load(name)))["value"]


def section(claim: Claim) -> str:
    return claim.question.partition("#")[0].partition(".")[0]


def test_there_are_claims() -> None:
    assert len(list(claims())) > 80


@pytest.mark.parametrize(("name", "claim"), list(claims()))
def test_claim(name: str, claim: Claim) -> None:
    assert claim.status in STATUSES
    assert claim.source.strip(), "a value must say where it comes from"
    if not claim.holds:
        assert claim.note.strip(), "what holds instead must be said"
    question = section(claim)
    documents = {question: answer(name, question)}
    (check,) = checked_claims([claim], documents)
    place, _, word = claim.question.partition("#")
    if not word:
        assert value_at(documents, place) is not None, f"nothing stands at {place}"
        assert check.agrees is not None
    if claim.holds:
        assert check.agrees is not False, (check.claimed, check.computed)
