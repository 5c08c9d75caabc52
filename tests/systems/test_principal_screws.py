"""Principal screws span the system, are extreme in pitch, and move with the body."""

from __future__ import annotations

from fractions import Fraction
from math import inf, isinf

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from systems.screw_systems import (
    ALL,
    KNOWN,
    ORIGIN,
    PRIMES,
    Array,
    Row,
    X,
    Y,
    Z,
    displacements,
    floats,
    free,
    mixed,
    modulo,
    moved,
    screw,
)

from screwkit.algebra.parse import parse
from screwkit.systems.exact_principal_screws import Pair, known_principal_screws
from screwkit.systems.principal_screws import PrincipalScrew, principal_screws
from screwkit.systems.screw_structure import ScrewStructure

names = st.sampled_from(sorted(ALL))
few = settings(max_examples=60)
CLOSE = 1e-7


def pair(rows: list[Row]) -> Pair:
    first, second = (ScrewStructure.spanned_by(modulo(rows, p), p) for p in PRIMES)
    return first, second


def spanned(screws: tuple[PrincipalScrew, ...]) -> Array:
    return np.array([s.coordinates for s in screws]).reshape(-1, 6)


def same_space(a: Array, b: Array) -> bool:
    """Equal ranks, also together, by singular values of unit rows."""

    def rank(rows: Array) -> int:
        if not rows.size:
            return 0
        rows = rows / np.linalg.norm(rows, axis=1, keepdims=True)
        return int((np.linalg.svd(rows, compute_uv=False) > CLOSE).sum())

    return rank(a) == rank(b) == rank(np.vstack([a, b]))


def pitches(screws: tuple[PrincipalScrew, ...]) -> list[float]:
    return [s.pitch for s in screws]


@few
@given(st.data(), names, displacements())
def test_laws(data: st.DataObject, name: str, displacement: np.ndarray) -> None:
    rows = data.draw(mixed(moved(displacement, ALL[name])))
    before, after = principal_screws(floats(ALL[name])), principal_screws(floats(rows))
    assert same_space(spanned(after), floats(rows))
    assert pitches(after) == pytest.approx(pitches(before), abs=CLOSE)
    for part in (True, False):
        chosen = [s.direction for s in after if isinf(s.pitch) == part]
        gram = np.array([[np.dot(a, b) for b in chosen] for a in chosen])
        assert gram == pytest.approx(np.eye(len(chosen)).reshape(gram.shape), abs=CLOSE)
    turning = [np.array(s.coordinates) for s in after if not isinf(s.pitch)]
    for i, a in enumerate(turning):
        for b in turning[:i]:
            assert a[:3] @ b[3:] + a[3:] @ b[:3] == pytest.approx(0, abs=1e-6)


@few
@given(names, displacements())
def test_axes_move_with_the_body(name: str, displacement: np.ndarray) -> None:
    """Where no two pitches are equal and no pure moment can shift an axis."""
    before = principal_screws(floats(ALL[name]))
    distinct = len({round(s.pitch, 6) for s in before}) == len(before)
    if not distinct or any(isinf(s.pitch) for s in before):
        return
    after = principal_screws(floats(moved(displacement, ALL[name])))
    matrix = displacement.astype(float)
    for a, b in zip(before, after, strict=True):
        image = matrix @ np.array(a.coordinates)
        found = np.array(b.coordinates)
        sign = np.sign(image[:3] @ found[:3])
        assert sign * image == pytest.approx(found, abs=1e-6)


@few
@given(st.data(), names)
def test_the_basis_does_not_show(data: st.DataObject, name: str) -> None:
    rows = data.draw(mixed(ALL[name]))
    one, other = principal_screws(floats(ALL[name])), principal_screws(floats(rows))
    assert spanned(one) == pytest.approx(spanned(other), abs=1e-6)


@few
@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 6), min_size=2, max_size=3))
def test_pitches_are_extreme(rows: list[tuple[int, ...]]) -> None:
    """No screw of a system without pure moments has a pitch beyond the principal."""
    numbers = np.array(rows, dtype=float)
    found = principal_screws(numbers)
    if not found or isinf(found[-1].pitch):
        return
    source = np.random.default_rng(0)
    samples = source.normal(size=(200, len(rows))) @ numbers
    samples = samples[np.linalg.norm(samples[:, :3], axis=1) > 1e-3]
    product = (samples[:, :3] * samples[:, 3:]).sum(axis=1)
    values = product / (samples[:, :3] ** 2).sum(axis=1)
    least, largest = min(pitches(found)), max(pitches(found))
    margin = 1e-6 * (1 + abs(least) + abs(largest))
    assert values.min() >= least - margin
    assert values.max() <= largest + margin


@few
@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 6), min_size=1, max_size=2))
def test_four_systems_mirror_their_reciprocal(rows: list[tuple[int, ...]]) -> None:
    """Definite pitches of a system are minus those of its reciprocal system."""
    exact = [tuple(Fraction(x) for x in row) for row in rows]
    whole = pair(exact)[0]
    if len(whole.turning) < whole.dimension:
        return
    numbers = np.array(rows, dtype=float)
    _, sizes, basis = np.linalg.svd(numbers)
    kernel = basis[int((sizes > 1e-9).sum()) :]
    other = principal_screws(np.roll(kernel, 3, axis=1))
    count = whole.dimension
    assert len(other) == 6 - count
    mirrored = sorted(-h for h in pitches(principal_screws(numbers)))
    assert pitches(other)[:count] == pytest.approx(mirrored, abs=1e-6)


def test_principal_screws_of_known_systems() -> None:
    a, b = principal_screws(floats([screw(X), screw(Y, Z)]))
    # two skew rotations at right angles, 1 apart: pitches ±1/2, axes at 45°
    assert (a.pitch, b.pitch) == pytest.approx((-0.5, 0.5))
    assert (abs(a.direction[0]), abs(a.direction[1])) == pytest.approx((0.5**0.5,) * 2)
    assert a.point == pytest.approx((0, 0, 0.5))
    assert b.point == pytest.approx((0, 0, 0.5))
    (only,) = principal_screws(floats([free((3, 4, 0))]))
    assert only.direction == pytest.approx((0.6, 0.8, 0))
    assert (only.point, only.pitch) == (None, inf)
    three = principal_screws(
        floats([screw(X, ORIGIN, 3), screw(Y, ORIGIN, -2), screw(Z, ORIGIN, 1)])
    )
    assert pitches(three) == pytest.approx([-2, 1, 3])


def test_nothing_and_nonsense() -> None:
    assert principal_screws([]) == ()
    assert principal_screws([[0.0] * 6]) == ()
    with pytest.raises(ValueError, match="six finite coordinates"):
        principal_screws([[1.0, 0, 0, float("nan"), 0, 0]])


@few
@given(names, displacements())
def test_exact_and_floating_screws_agree(name: str, displacement: np.ndarray) -> None:
    rows = moved(displacement, ALL[name])
    exact = known_principal_screws(pair(rows), KNOWN)
    assert pitches(exact) == pytest.approx(
        pitches(principal_screws(floats(rows))), abs=1e-6
    )
    assert same_space(spanned(exact), floats(rows))
    for found in exact:
        if found.exact is None or found.exact.pitch is None:
            continue
        assert found.exact.point is not None
        for text in (*found.exact.direction, *found.exact.point, found.exact.pitch):
            parse(text, [])


def test_exact_pitches_with_roots() -> None:
    """Trace 3 and determinant 7/4 of the pitches: 3/2 ± 1/√2, by hand."""
    rows = [(1, 0, 0, 1, 0, 0), (0, 1, 0, 1, 2, 1)]
    found = known_principal_screws(
        pair([tuple(map(Fraction, row)) for row in rows]), KNOWN
    )
    texts = [s.exact.pitch for s in found if s.exact]
    assert texts == ["3/2 - sqrt(2)/2", "3/2 + sqrt(2)/2"]


def test_pitches_outside_the_field_are_floats() -> None:
    """h² = 5/4: the field has no √5."""
    rows = [screw(X, ORIGIN, 1), (*screw(Y)[:3], *map(Fraction, (1, -1, 0)))]
    found = known_principal_screws(pair(rows), KNOWN)
    assert [s.exact for s in found] == [None, None]
    assert pitches(found) == pytest.approx([-(5**0.5) / 2, 5**0.5 / 2])
