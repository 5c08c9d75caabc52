"""Sums of conditions without symbols: identities, and what is left of vectors."""

from __future__ import annotations

import random

import pytest

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factors import FactorLibrary, factor
from screwkit.algebra.parse import parse
from screwkit.algebra.sums_by_cramer import sums_by_cramer
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing

NAMES = ("x", "y", "z", "p", "q", "cos(t)", "sin(t)")


def ring_of() -> TrigonometricRing:
    seen = SurveyRing()
    for name in NAMES:
        evaluate(parse(name), seen)
    return TrigonometricRing(seen)


@pytest.mark.parametrize("seed", range(4))
def test_sums_are_sums_and_hold_one_of_the_symbols_at_most(seed: int) -> None:
    source, ring = random.Random(seed), ring_of()
    given = [evaluate(parse(name), ring) for name in NAMES]
    conditions = []
    for _ in range(4):
        slopes = [source.choice(given[3:]) * source.choice((1, -2)) for _ in range(3)]
        rest = source.choice(given[3:]) * source.choice(given[3:])
        pairs = zip(slopes, given[:3], strict=True)
        conditions.append(ring.normal(sum((a * b for a, b in pairs), rest)))
    found = [*sums_by_cramer(ring, conditions)]
    sizes = {len(own.symbols) for own in found}
    assert sizes == {1, 2, 3}
    for own in found:
        pairs = zip(own.combination.times, conditions, strict=True)
        whole = ring.normal(sum((a * b for a, b in pairs), ring.zero))
        assert whole == own.combination.value
        degrees = whole.degrees()
        assert sum(degrees[i] > 0 for i in own.symbols) <= 1


def test_dimensions_are_taken_out_one_by_one() -> None:
    ring = ring_of()
    texts = ("p*x + q*y + 1", "q*x - p*y + 2", "x + y + p")
    conditions = [evaluate(parse(text), ring) for text in texts]
    x = ring.symbol_indices()[ring.symbols.index("x")]
    found = [*sums_by_cramer(ring, conditions, dimensions=(x,))]
    assert found
    assert all(len(own.symbols) == 1 for own in found if x in own.symbols)


def test_parallel_vectors_across_a_normal_tie_its_direction() -> None:
    """(x, y, z) is parallel to (p, q, 1) and across (cos t, 0, sin t).

    So a coordinate is 0 or p cos t + sin t is.
    """
    ring = ring_of()
    texts = ("q*x - p*y", "y - q*z", "x - p*z", "x*cos(t) + z*sin(t)")
    conditions = [evaluate(parse(text), ring) for text in texts]
    wanted = evaluate(parse("z*(p*cos(t) + sin(t))"), ring)
    library = FactorLibrary(ring)
    keys = {f.key for f, _ in factor(ring, wanted, library).factors}
    assert len(keys) == 2
    products = (
        {f.key for f, _ in factor(ring, own.combination.value, library).factors}
        for own in sums_by_cramer(ring, conditions)
    )
    assert keys in [*products]
