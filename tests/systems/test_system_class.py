"""The class of a system depends on the system alone, and says what it holds."""

from __future__ import annotations

import random
import re
from fractions import Fraction
from itertools import combinations
from math import inf

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from systems.screw_systems import (
    ALL,
    KNOWN,
    ORIGIN,
    OTHERS,
    PRIMES,
    SUBGROUPS,
    Array,
    Row,
    X,
    Y,
    Z,
    both,
    displacements,
    floats,
    free,
    mixed,
    modulo,
    moved,
    screw,
)

from screwkit.algebra.modular import ResampleError
from screwkit.systems.class_words import SUBGROUPS as SUBGROUP_KINDS
from screwkit.systems.class_words import WORDS
from screwkit.systems.principal_screws import principal_screws
from screwkit.systems.screw_shapes import shape_of
from screwkit.systems.screw_structure import ScrewStructure, bracket
from screwkit.systems.system_class import classify, classify_wrenches

names = st.sampled_from(sorted(ALL))
few = settings(max_examples=60)
generic = st.lists(
    st.tuples(*[st.integers(-2, 2).map(Fraction)] * 6), min_size=1, max_size=6
)


def rank(rows: Array) -> int:
    """A second opinion: singular values with a margin."""
    if not rows.size:
        return 0
    sizes = np.linalg.svd(rows, compute_uv=False)
    return int((sizes > 1e-9 * max(1.0, sizes.max())).sum())


def brackets(rows: Array) -> Array:
    """All Lie brackets, by commutators of 4×4 matrices."""

    def matrix(twist: Array) -> Array:
        (a, b, c), v = twist[:3], twist[3:]
        return np.array(
            [[0, -c, b, v[0]], [c, 0, -a, v[1]], [-b, a, 0, v[2]], [0, 0, 0, 0]]
        )

    found = [np.zeros(6)]
    for one, other in combinations(rows, 2):
        a, b = matrix(one), matrix(other)
        c = a @ b - b @ a
        found.append(np.array([c[2, 1], c[0, 2], c[1, 0], *c[:3, 3]]))
    return np.array(found)


@pytest.mark.parametrize("name", ALL)
def test_every_system_is_known_by_its_definition(name: str) -> None:
    found = classify(both(ALL[name]), KNOWN)
    assert found.name == name
    assert found.subgroup == (name in SUBGROUPS)
    assert (found.within == name) == (name in SUBGROUPS)
    assert found.words.startswith(name)
    assert not re.search(
        r"\bone (direction|point|plane|pitch)|\ban? axis\b", found.words[len(name) :]
    )


def test_every_kind_has_a_system() -> None:
    shapes = [shape_of(ScrewStructure.spanned_by(*both(r)[0])) for r in ALL.values()]
    assert {(s.kind, s.reciprocal) for s in shapes} == set(WORDS)
    assert len(SUBGROUP_KINDS) == len(SUBGROUPS)


@few
@given(st.data(), names, displacements())
def test_neither_basis_nor_frame_matters(
    data: st.DataObject, name: str, displacement: np.ndarray
) -> None:
    rows = data.draw(mixed(moved(displacement, ALL[name])))
    before, after = (classify(both(r)) for r in (ALL[name], rows))
    assert (after.name, after.subgroup, after.within, after.motion_type) == (
        before.name,
        before.subgroup,
        before.within,
        before.motion_type,
    )
    assert (after.dimension, after.words) == (before.dimension, before.words)
    wrenches = [classify_wrenches(both(r)) for r in (ALL[name], rows)]
    assert wrenches[0].words == wrenches[1].words


@few
@given(st.data(), names)
def test_the_basis_does_not_show(data: st.DataObject, name: str) -> None:
    rows = data.draw(mixed(ALL[name]))
    assert classify(both(rows), KNOWN) == classify(both(ALL[name]), KNOWN)


@few
@given(generic)
def test_a_second_opinion_of_dimensions_and_closure(rows: list[Row]) -> None:
    found, numbers = classify(both(rows)), floats(rows)
    dimension, directions = rank(numbers), rank(numbers[:, :3])
    assert found.dimension == dimension
    assert found.translations == dimension - directions
    assert found.rotations == directions
    assert found.motion_type == f"{dimension - directions}T{directions}R"
    closed = rank(np.vstack([numbers, brackets(numbers)])) == dimension
    assert found.subgroup == closed


@few
@given(generic)
def test_subgroups_by_name_are_closed_and_only_they(rows: list[Row]) -> None:
    """The list of subalgebras is complete: closure and kind are found apart."""
    system = ScrewStructure.spanned_by(modulo(rows, PRIMES[0]), PRIMES[0])
    shape = shape_of(system)
    assert system.closed == ((shape.kind, shape.reciprocal) in SUBGROUP_KINDS)
    hull = shape_of(system.hull)
    assert (hull.kind, hull.reciprocal) in SUBGROUP_KINDS


@few
@given(st.data(), st.sampled_from(sorted(SUBGROUPS)))
def test_subspaces_of_a_group_lie_within_it(data: st.DataObject, name: str) -> None:
    weights = st.lists(
        st.integers(-3, 3), min_size=len(SUBGROUPS[name]), max_size=len(SUBGROUPS[name])
    )
    matrix = data.draw(st.lists(weights, min_size=1, max_size=3))
    whole = np.array(SUBGROUPS[name], dtype=object).reshape(-1, 6)
    rows = (
        [tuple(Fraction(x) for x in np.array(w, dtype=object) @ whole) for w in matrix]
        if len(whole)
        else []
    )
    part = ScrewStructure.spanned_by(modulo(rows, PRIMES[0]), PRIMES[0])
    both_together = [*part.hull.basis, *modulo(SUBGROUPS[name], PRIMES[0])]
    group = ScrewStructure.spanned_by(both_together, PRIMES[0])
    assert group.dimension == len(whole)


def test_random_systems_are_no_subgroups() -> None:
    source = random.Random(3)
    for dimension in (2, 3, 4, 5):
        for _ in range(10):
            rows = [
                tuple(Fraction(source.randrange(-50, 50)) for _ in range(6))
                for _ in range(dimension)
            ]
            found = classify(both(rows))
            assert not found.subgroup
            assert found.within == "spatial motion"


def test_residues_without_short_numbers_keep_lines_unnamed() -> None:
    source = random.Random(5)
    systems = [([[source.randrange(p) for _ in range(6)]], p) for p in PRIMES]
    found = classify(systems, KNOWN)
    assert found.words == "helical motion about an axis, of one pitch"
    assert found.principal == ()
    assert all(element.texts is None for element in found.elements)


def test_classes_must_agree() -> None:
    (first, p), (_, q) = both([screw(Z)])
    with pytest.raises(ResampleError):
        classify([(first, p), (modulo([screw(Z, ORIGIN, 1)], q), q)])
    with pytest.raises(ValueError, match="different primes"):
        classify(both([screw(Z)])[::-1], KNOWN)


def test_lines_and_planes_are_named() -> None:
    def words(*rows: Row) -> str:
        return classify(both(rows), KNOWN).words

    assert words(screw(Z, (1, 2, 5))) == (
        "rotation about the axis through [1, 2, 0] along [0, 0, 1]"
    )
    assert words(screw(X, (0, 0, 3)), screw(Y, (0, 0, 3)), free(Z)) == (
        "planar field of rotations: rotations about all lines in the plane through "
        "[0, 0, 3] normal to [0, 0, 1], and translation along its normal"
    )
    assert words(screw(Z), free(X), free(Y), free(Z)) == (
        "Schönflies motion: all translations, and rotations about all lines parallel "
        "to the direction [0, 0, 1]"
    )


@pytest.mark.parametrize(
    ("second", "said"),
    [
        (screw(Y, ORIGIN, 0), "flat pencil"),
        (screw(Y, Z), "two rotations on skew axes are among them"),
        (screw(Y, ORIGIN, 1), "a rotation is among them"),
    ],
)
def test_how_many_rotations_a_cylindroid_has(second: Row, said: str) -> None:
    assert said in classify(both([screw(X), second]), KNOWN).words


@pytest.mark.parametrize(
    ("pitches", "said"),
    [
        ((1, 2, 3), "no rotations are among them"),
        ((-1, -2, -3), "no rotations are among them"),
        ((-1, 2, 3), "rotations on the lines of a regulus are among them"),
        ((0, 2, 3), "a rotation is among them"),
        ((0, -2, -3), "a rotation is among them"),
        ((0, -2, 3), "two flat pencils of rotations are among them"),
    ],
)
def test_which_rotations_a_three_system_has(
    pitches: tuple[int, ...], said: str
) -> None:
    rows = [screw(a, (1, 2, 3), h) for a, h in zip((X, Y, Z), pitches, strict=True)]
    assert classify(both(rows), KNOWN).words.endswith(f"; {said}")


@few
@given(st.lists(st.tuples(*[st.integers(-3, 3)] * 6), min_size=2, max_size=3))
def test_signs_of_pitches_by_eigenvalues(rows: list[tuple[int, ...]]) -> None:
    """What is said about rotations holds for principal pitches in floating point."""
    exact = [tuple(map(Fraction, row)) for row in rows]
    words = classify(both(exact), KNOWN).words
    found = [s.pitch for s in principal_screws(floats(exact))]
    if "no rotations" in words:
        assert min(found) > 1e-6 or max(h for h in found if h < inf) < -1e-6
    if "skew axes" in words or "regulus" in words or "two flat" in words:
        assert min(found) < -1e-9 < 1e-9 < max(found)
    if "; a rotation is" in words:
        assert sum(abs(h) < 1e-6 for h in found) == 1


def test_a_cylindroid_without_rotations() -> None:
    rows = [screw(X, ORIGIN, 1), screw(Y, ORIGIN, 2)]
    assert "no rotations are among them" in classify(both(rows), KNOWN).words
    assert "among" not in classify(both(rows)).words


@pytest.mark.parametrize(
    ("rows", "name"),
    [
        ([screw(Z)], "force"),
        ([free(Z)], "couple"),
        ([free(X), free(Y), free(Z)], "all couples"),
        ([screw(X), screw(Y), screw((1, 2, 0))], "flat pencil of forces"),
        ([screw(X), screw(Y), screw((1, 1, 0), (3, 0, 0))], "forces of a plane"),
        ([screw(a, (1, 2, 3)) for a in (X, Y, Z)], "forces through a point"),
        ([screw(Z), screw(Z, X), screw(Z, Y)], "parallel forces"),
        ([screw(Z), screw(Z, X), screw(Z, (5, 0, 0))], "parallel forces of a plane"),
    ],
)
def test_wrenches(rows: list[Row], name: str) -> None:
    found = classify_wrenches(both(rows), KNOWN)
    assert found.name == name
    assert not found.subgroup
    assert "rotation" not in found.words
    assert "translation" not in found.words


@few
@given(st.tuples(*[st.integers(-3, 3)] * 6), st.tuples(*[st.integers(-3, 3)] * 6))
def test_the_bracket_is_the_commutator(a: tuple[int, ...], b: tuple[int, ...]) -> None:
    expected = brackets(np.array([a, b], dtype=float))[1]
    assert list(bracket(a, b)) == list(expected)


def test_every_other_system_is_open() -> None:
    for rows in OTHERS.values():
        numbers = floats(rows)
        assert rank(np.vstack([numbers, brackets(numbers)])) > rank(numbers)
