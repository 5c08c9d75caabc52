"""Superbrackets: identities on random points, and classical conditions of robots."""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from loci.numeric import Array, value

import screwkit as sk
from screwkit.algebra.points import residue
from screwkit.algebra.text import expression_text
from screwkit.analyses.superbracket import superbracket
from screwkit.analyses.unexpanded import six_lines_in_words
from screwkit.loci.bracket_forms import Form, Sample, product_of
from screwkit.loci.brackets import bracket, monomials_of, plane, shortest_monomials
from screwkit.loci.placed_points import wrench_through
from screwkit.loci.superbracket import SixLines, six_lines
from screwkit.reports.records import from_json, to_json
from screwkit.results.singularities import Singularities
from screwkit.results.superbracket import BracketFactor, Superbracket

PRIME = 2**61 - 1
DISTINCT = [(2 * i, 2 * i + 1) for i in range(6)]

# Points 0 1 2 of the platform, 3 4 5 of the base: legs along edges of an octahedron.
OCTAHEDRON = [(0, 3), (1, 3), (1, 4), (2, 4), (2, 5), (0, 5)]


def never(_: object) -> bool:
    return False


def random_points(count: int, seed: int) -> list[list[int]]:
    source = random.Random(seed)
    return [[source.randrange(-99, 99) for _ in range(4)] for _ in range(count)]


def determinant(rows: Sequence[Sequence[int]]) -> Fraction:
    """By elimination over the rationals."""
    left = [[Fraction(x) for x in row] for row in rows]
    total = Fraction(1)
    while left:
        pivot = next((row for row in left if row[0]), None)
        if pivot is None:
            return Fraction(0)
        place = left.index(pivot)
        left.pop(place)
        total *= pivot[0] * (-1) ** place
        left = [
            [a - row[0] / pivot[0] * b for a, b in zip(row[1:], pivot[1:], strict=True)]
            for row in left
        ]
    return total


def of_lines(lines: Sequence[tuple[int, int]], points: Sequence[Sequence[int]]) -> int:
    """The determinant of six wrenches along lines."""
    rows = [wrench_through(points[a], points[b]) for a, b in lines]
    return int(determinant(rows))


def samples(count: int, seeds: Sequence[int] = (1, 2, 3)) -> list[Sample]:
    return [Sample(random_points(count, seed), PRIME) for seed in seeds]


def test_a_bracket_is_the_determinant_of_four_points() -> None:
    for seed in range(5):
        points = random_points(4, seed)
        assert bracket(points) == determinant(points)
        normal = plane(points[1:])
        assert sum(map(int.__mul__, normal, points[0])) in (
            determinant(points),
            -determinant(points),
        )


@pytest.mark.parametrize("lines", [DISTINCT, OCTAHEDRON])
def test_the_monomials_are_the_determinant_of_the_lines(
    lines: list[tuple[int, int]],
) -> None:
    """McMillan and White's 24 monomials against elimination, up to one constant."""
    ratios = set()
    for sample in samples(12, range(1, 7)):
        whole = of_lines(lines, sample.points)
        total = sum(
            count
            * np.prod([bracket([sample.points[i] for i in b]) for b in m], dtype=object)
            for m, count in monomials_of(lines, never).items()
        )
        ratios.add(Fraction(whole, int(total)))
    assert len(ratios) == 1
    assert len(monomials_of(DISTINCT, never)) == 24


def test_an_octahedron_is_four_planes_that_meet() -> None:
    """[DowningSamuelHunt2002], [BenHorinShoham2006]: four faces meet in one point."""
    found = shortest_monomials(OCTAHEDRON, never)
    forms = product_of(found, OCTAHEDRON, [False] * 6, samples(6))
    assert forms is not None
    (form,) = forms
    faces = {frozenset(group) for group in form.groups}
    platform, base = frozenset((0, 1, 2)), frozenset((3, 4, 5))
    alternate = {frozenset(f) for f in ((0, 3, 5), (1, 3, 4), (2, 4, 5))}
    others = {frozenset(f) for f in ((0, 1, 3), (1, 2, 4), (0, 2, 5))}
    # The other four faces meet under the same condition.
    assert faces in ({platform, *alternate}, {base, *others})


def test_pairs_of_lines_through_three_points_are_four_planes() -> None:
    """[BenHorinShoham2006]: the planes of three pairs, and that of their points."""
    lines = [(0, 3), (0, 4), (1, 5), (1, 6), (2, 7), (2, 8)]
    found = shortest_monomials(lines, never)
    forms = product_of(found, lines, [False] * 9, samples(9))
    assert forms is not None
    (form,) = forms
    wanted = ((0, 1, 2), (0, 3, 4), (1, 5, 6), (2, 7, 8))
    assert set(form.groups) == set(wanted)


def test_six_lines_without_a_common_point_have_no_simple_form() -> None:
    found = shortest_monomials(DISTINCT, never)
    assert product_of(found, DISTINCT, [False] * 12, samples(12)) is None


def test_two_planes_and_a_line_vanish_where_they_meet() -> None:
    form = Form(((0, 1, 2), (3, 4, 5), (6, 7)))
    points = random_points(8, 3)
    assert form.value(points) != 0
    # The planes x = 0 and y = 0 meet in the z axis.
    planes = [[0, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [0, 0, 0, 1], [1, 0, 0, 1]]
    planes.append([0, 0, 1, 1])
    crossing, along, skew = ([-5, -6, 1, 1], [5, 6, 9, 1], [1, 6, 9, 1])
    start = [5, 6, 7, 1]
    assert form.value([*planes, start, crossing]) == 0  # at (0, 0, 4)
    assert form.value([*planes, start, along]) == 0  # at infinity
    assert form.value([*planes, start, skew]) != 0


@cache
def answered(name: str) -> tuple[Singularities, Superbracket | None]:
    answer = sk.singularities(sk.load(name))
    assert answer.actuation is not None
    return answer, answer.actuation.superbracket


@pytest.mark.parametrize(
    ("name", "expressions", "exact"),
    [
        # [DowningSamuelHunt2002]; [BenHorinShoham2006], the 3-3 structure
        ("gough_33_octahedral", 1, {(0, 1)}),
        # planes of the limbs and that of the platform's centres [BenHorinShoham2009]
        ("3rps", 1, {(0,)}),
        # forces and couples apart: two determinants of size three
        ("3upu_tsai", 2, {(0,), (0, 1)}),
        ("nao_t14", 3, {(1,), (2,)}),
    ],
)
def test_factors_are_compared_with_the_components(
    name: str, expressions: int, exact: set[tuple[int, ...]]
) -> None:
    _, found = answered(name)
    assert found is not None
    assert len(found.factors) == expressions
    assert {f.components for f in found.factors if f.holds == "exactly"} == exact


def test_a_factor_that_says_more_is_told_from_one_that_says_it_all() -> None:
    """[abcd] of the arms vanishes where shoulders and wrists are in one plane.

    So they are where both arms are turned alike, and where the left wrist lies on axis
    6: there the left arm idles with 1 2 3 7 locked, and the object stays.
    """
    answer, found = answered("nao_t14")
    assert found is not None
    assert answer.actuation is not None
    (one,) = (f for f in found.factors if f.holds == "wider")
    assert one.components == (0, 1)
    assert ("r3*cos(q7) - d3*sin(q7)",) in [c.equations for c in answer.actuation.idle]
    _, found = answered("3prs")
    assert found is not None
    assert [f.holds for f in found.factors] == ["exactly"]  # of 476 terms


@pytest.mark.parametrize("name", ["gough_6ups", "3rpr_planar", "exechon"])
def test_nothing_is_claimed_where_no_form_is_known(name: str) -> None:
    _, found = answered(name)
    assert found is None or (not found.factors and found.reason)


def test_what_is_known_of_a_determinant_that_is_not_written() -> None:
    """A cubic in the position for any six struts [MayerStOngeGosselin2000]."""
    case = sk.load("gough_6ups")
    given = case.assembly, case.mechanism.actuated
    bracket = superbracket(*given, [])
    assert bracket is not None
    told = six_lines_in_words(*given, bracket)
    assert told == (
        "while limbs keep their ranks the platform moves only where lines A1 B1, "
        "A2 B2, A3 B3, A4 B4, A5 B5 and A6 B6 are lines of one linear complex: a "
        "determinant of degree 3 in x, y and z"
    )
    four = replace(bracket, factors=(BracketFactor("[abcd]", "P", "elsewhere", ()),))
    assert "moves only where P: a" in six_lines_in_words(*given, four)


def test_wrenches_of_limbs_with_loops_inside_are_those_of_their_closed_loops() -> None:
    """What an Orthoglide's loops forbid is reciprocal to no joint alone: the rods."""
    case = sk.load("orthoglide")
    lines = six_lines(case.assembly, ["P1", "P2", "P3"])
    assert isinstance(lines, SixLines)
    names = {
        "".join(sorted(lines.points[i].name for i in line)) for line in lines.lines
    }
    assert names == {f"B{k}{side}S{k}{side}" for k in "123" for side in "pm"}


def numbers(name: str, seed: int) -> dict[str, float]:
    source = np.random.default_rng(seed)
    mechanism = sk.load(name).mechanism
    return {p.name: float(source.uniform(0.3, 1.7)) for p in mechanism.parameters}


def named_points(name: str, at: dict[str, float]) -> dict[str, Array]:
    """The points of the file in floats, from its expressions."""
    points = sk.load(name).mechanism.points
    return {
        key: np.array([value(expression_text(part), at) for part in written])
        for key, written in points.items()
    }


@pytest.mark.parametrize("seed", range(3))
def test_four_planes_of_the_octahedral_platform_in_floats(seed: int) -> None:
    """Planes of named points meet exactly where Fichter's condition cos φ = 0 says."""
    at = numbers("gough_33_octahedral", seed)

    def meet(phi: float) -> float:
        p = named_points("gough_33_octahedral", {**at, "phi": phi})
        rows = []
        for three in ("B1 B2 B3", "B1 A1 A3", "B2 A1 A2", "B3 A2 A3"):
            a, b, c = (p[x] for x in three.split())
            normal = np.cross(b - a, c - a)
            rows.append([*normal, normal @ a])
        return float(np.linalg.det(rows) / np.prod(np.linalg.norm(rows, axis=1)))

    assert abs(meet(np.pi / 2)) < 1e-14
    assert abs(meet(0.4)) > 1e-4


def found_lines(name: str) -> SixLines:
    case = sk.load(name)
    found = six_lines(case.assembly, case.mechanism.actuated)
    assert not isinstance(found, str)
    return found


@pytest.mark.parametrize(
    "name", ["gough_33_octahedral", "3rps", "3upu_tsai", "nao_t14"]
)
def test_the_product_is_the_determinant_of_the_lines_at_new_postures(name: str) -> None:
    """Lines are expanded in Plücker coordinates; new random postures confirm."""
    found = found_lines(name)
    case = sk.load(name)
    root = case.assembly.root(case.assembly.common_twists.ring)
    monomials = shortest_monomials(found.lines, found.always_in_a_plane)
    ideal = [point.ideal for point in found.points]
    forms = product_of(monomials, found.lines, ideal, found.samples)
    assert forms is not None
    source, ratios = random.Random(99), list[tuple[int, int, int]]()
    for _ in range(3):
        at = root.point(source)
        assert at is not None
        place, prime = at
        points = [
            [residue(x, place, prime) for x in p.coordinates] for p in found.points
        ]
        whole = of_lines(found.lines, points) % prime
        sample, product = Sample(points, prime), 1
        for form in forms:
            product = product * sample.of(form) % prime
        ratios.append((whole, product, prime))
    for whole, product, prime in ratios:
        ratio = whole * pow(product, -1, prime) % prime
        assert min(ratio, prime - ratio) <= 4  # a small integer up to its sign


def test_the_text_and_the_json_carry_it() -> None:
    answer, found = answered("gough_33_octahedral")
    again = from_json(to_json(answer))
    assert isinstance(again, Singularities)
    assert again.actuation is not None
    assert again.actuation.superbracket == found
    text = " ".join(str(answer).split())
    assert "six lines hold it" in text
    assert "the plane of B3, A2 and A3 meet in one point: exactly 1 and 2" in text


def test_nothing_is_said_of_lines_where_locked_joints_hold_by_all_wrenches() -> None:
    """An arm that is locked is one body; lines through its centres may be dependent."""
    answer, found = answered("puma")
    assert answer.actuation is not None
    assert answer.actuation.complete
    assert not answer.actuation.components
    assert found is None
    assert "six lines" not in str(answer)
