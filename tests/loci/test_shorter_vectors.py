"""Null vectors without factors of the way they were found."""

from __future__ import annotations

import random

import pytest

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.loci.shorter_vectors import shorter_vectors

NAMES = ("x", "y", "z", "p", "q", "cos(t)", "sin(t)")
FORCE = ("x - p*cos(t)", "y", "z + p*sin(t)", "y*q", "p - x*q", "z")
COUPLE = ("0", "0", "0", "x + cos(t)", "y - q", "z*p")


def ring_of() -> TrigonometricRing:
    seen = SurveyRing()
    for name in NAMES:
        evaluate(parse(name), seen)
    return TrigonometricRing(seen)


def vector(ring: TrigonometricRing, texts: tuple[str, ...]) -> tuple[Polynomial, ...]:
    return tuple(ring.normal(evaluate(parse(text), ring)) for text in texts)


@pytest.mark.parametrize("times", ["p", "q*sin(t) - z", "p^2*cos(t) + q", "0"])
def test_a_force_is_found_in_its_sums_with_a_couple(times: str) -> None:
    ring = ring_of()
    force, couple = vector(ring, FORCE), vector(ring, COUPLE)
    k = evaluate(parse(times), ring)
    pivot = couple[3]
    mixed = tuple(
        ring.normal(pivot * f + k * c) for f, c in zip(force, couple, strict=True)
    )
    found = shorter_vectors(ring, [mixed, couple])
    assert {tuple(map(str, own)) for own in found} == {
        tuple(map(str, own)) for own in (force, couple)
    }


def test_with_a_helper_that_carries_the_rest() -> None:
    """A reaction alone takes up what the couple leaves over."""
    ring = ring_of()
    force, couple = vector(ring, FORCE), vector(ring, COUPLE)
    reaction = vector(ring, ("0", "0", "0", "0", "1", "q"))
    pivot, k = couple[3], evaluate(parse("p*z - 2"), ring)
    mixed = tuple(
        ring.normal(pivot * f + c + k * r)
        for f, c, r in zip(force, couple, reaction, strict=True)
    )
    assert len(shorter_vectors(ring, [mixed, couple])) == 2
    found = shorter_vectors(ring, [mixed, couple], [reaction])
    sizes = [sum(map(len, own)) for own in found]
    assert max(sizes) <= sum(map(len, force)) + 4
    # Up to the reaction it is the force.
    longest = max(found, key=lambda own: sum(map(len, own)))
    assert [str(x) for x in longest[:4]] == [str(x) for x in force[:4]]


@pytest.mark.parametrize("seed", range(3))
def test_vectors_that_share_nothing_stay(seed: int) -> None:
    source, ring = random.Random(seed), ring_of()
    given = [evaluate(parse(name), ring) for name in NAMES]
    vectors = [
        tuple(source.choice(given) + source.choice(given) for _ in range(6))
        for _ in range(3)
    ]
    found = shorter_vectors(ring, vectors)
    assert sorted(map(str, found)) == sorted(map(str, vectors))
