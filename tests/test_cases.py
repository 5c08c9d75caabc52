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
from screwkit.claims import agreement, checked_claims, value_at
from screwkit.mechanism.model import Claim
from screwkit.metric_questions import manipulability
from screwkit.questions import (
    mobility,
    schemes,
    screws,
    singularities,
)
from screwkit.reports.wire import part_to_json

STATUSES = {"published", "derived", "regression"}
QUESTIONS: dict[str, Callable[..., Any]] = {
    "mobility": mobility,
    "screws": screws,
    "singularities": singularities,
    "schemes": schemes,
    "manipulability": manipulability,
}


loaded = cache(load)  # frozen; collecting alone asks for each several times


def claims() -> Iterator[Any]:
    """The claims of every file and of every variant in it."""
    for name in bundled_cases():
        variants = (f"{name}#{variant}" for variant in loaded(name).variants)
        for case in (name, *variants):
            together = pytest.mark.xdist_group(case)  # one process answers
            for claim in loaded(case).claims:
                said = f"{case}:{claim.question}"
                yield pytest.param(case, claim, id=said, marks=together)


@cache
def answer(name: str, question: str) -> Any:
    return part_to_json(QUESTIONS[question](loaded(name)))["value"]


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


@pytest.mark.parametrize(
    ("claimed", "computed", "tolerance", "agrees"),
    [
        (4, 4, 0.0, True),
        (4, 5, 0.0, False),
        (200.0, 201.0, 0.01, True),
        (0.02, 0.03, 0.01, False),
        (0, 0.005, 0.01, True),
        ([9.736, 0.5135], [9.736466686, 0.5135333136], 1e-3, True),
        ([9.736, 0.5135], [9.736466686, 0.6], 1e-3, False),
        ([1, 2], [1, 2, 3], 0.1, False),
        ([3], [3], 0.0, True),
        (True, 1, 0.0, None),
        ("1T3R", "1T3R", 0.0, True),
        ("2*a + b", "b + 2*a", 0.0, False),
        (3, None, 0.0, None),
    ],
)
def test_agreement(
    claimed: Any, computed: Any, tolerance: float, agrees: bool | None
) -> None:
    assert agreement(claimed, computed, tolerance, partly=False) is agrees


def test_claims_of_variants_replace_those_of_the_file() -> None:
    named = [param.values[0] for param in claims()]
    for name in bundled_cases():
        for variant in loaded(name).variants:
            own = load(name, variant=variant).claims
            assert named.count(f"{name}#{variant}") == len(own)
