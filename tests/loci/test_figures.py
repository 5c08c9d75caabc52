"""Figures of dependent lines: theorems on random lines, and known conditions."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest
from loci.numeric import Array, values
from one_ring import in_one_ring

import screwkit as sk
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial
from screwkit.analyses.singularities import limb_singularities
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.conjunctions import conjunction
from screwkit.loci.features import Axis, Features, Point, statements
from screwkit.loci.figure_words import dependent, dependent_about
from screwkit.loci.limb_wrenches import wrench_screws
from screwkit.loci.named_screws import AXIS, JOIN, SLIDE, NamedScrew, called
from screwkit.loci.pieces import Piece, pieces_of
from screwkit.loci.said_together import Conjunction
from screwkit.loci.same_zeros import LARGEST, zeros_beside
from screwkit.results.singularities import Singularities

PRIME = 2**31 - 1
SOURCE = np.random.default_rng(4)


def integers(*shape: int) -> Array:
    return SOURCE.integers(1, 40, shape).astype(float)


def line(point: Array, direction: Array) -> Array:
    return np.concatenate([direction, np.cross(point, direction)])


def couple(direction: Array) -> Array:
    return np.concatenate([np.zeros(3), direction])


def words(rows: Sequence[Array], left: int) -> str | None:
    """What is said of screws that lie so in general."""
    screws = [
        NamedScrew((), AXIS if any(row[:3]) else SLIDE, str(n), 0, not any(row[:3]))
        for n, row in enumerate(rows)
    ]
    residues = [[int(x) % PRIME for x in row] for row in rows]
    return dependent(screws, left, residues, PRIME)


def rank(rows: Sequence[Array]) -> int:
    return int(np.linalg.matrix_rank(np.array(rows, dtype=float)))


def test_parallel_lines_become_dependent_in_a_plane() -> None:
    way, p, q = integers(3, 3)
    general = [line(integers(3), way) for _ in range(3)]
    assert rank(general) == 3
    assert words(general, 2) == "axes 0, 1 and 2 lie in one plane"
    assert rank([line(p + k * q, way) for k in (1, 2, 5)]) == 2


def test_lines_of_a_bundle_become_dependent_in_a_plane() -> None:
    centre, u, v = integers(3, 3)
    general = [line(centre, integers(3)) for _ in range(3)]
    assert rank(general) == 3
    assert words(general, 2) == "axes 0, 1 and 2 lie in one plane"
    assert rank([line(centre, u + k * v) for k in (1, 2, 5)]) == 2


def test_lines_of_a_plane_become_dependent_in_a_point() -> None:
    origin, u, v = integers(3, 3)
    general = [
        line(origin + a * u + b * v, c * u + d * v)
        for a, b, c, d in ((1, 2, 3, 1), (4, -1, 1, 2), (-3, 5, 2, -7))
    ]
    assert rank(general) == 3
    assert words(general, 2) == "axes 0, 1 and 2 meet in one point or are parallel"
    assert rank([line(origin, u + k * v) for k in (1, 2, 5)]) == 2
    assert rank([line(origin + k * v, u) for k in (1, 2, 5)]) == 2


def test_other_lines_take_both() -> None:
    general = [line(integers(3), integers(3)) for _ in range(3)]
    said = "axes 0, 1 and 2 lie in one plane and meet in one point or are parallel"
    assert words(general, 2) == said


def test_two_parallel_axes_and_a_slide() -> None:
    p, q, way = integers(3, 3)
    general = [line(p, way), line(q, way), couple(integers(3))]
    assert rank(general) == 3
    assert words(general, 2) == "slide 2 is normal to the plane of axes 0 and 1"
    across = np.cross(q - p, way)
    assert rank([line(p, way), line(q, way), couple(across)]) == 2


def test_regulus_congruence_and_complex() -> None:
    general = [line(integers(3), integers(3)) for _ in range(6)]
    assert rank(general) == 6
    assert "regulus" in (words(general[:4], 3) or "")
    assert "linear congruence" in (words(general[:5], 4) or "")
    assert "linear complex" in (words(general, 5) or "")
    # Rulings of one quadric, z = x y: any four are dependent, any three are not.
    ruling = [line(np.array([k, 0, 0]), np.array([0, 1, k])) for k in (0, 1, 3, 7)]
    assert (rank(ruling), rank(ruling[:3])) == (3, 3)


def about(centre: Array, *rows: Array) -> Array:
    """How screws move a point."""
    return np.array([row[3:] + np.cross(row[:3], centre) for row in rows])


def test_axes_that_move_a_centre_alike() -> None:
    centre, p, u, v, w = integers(5, 3)
    named = [NamedScrew((), AXIS, name, 0) for name in "abc"]
    slide = NamedScrew((), SLIDE, "s", 0, free=True)
    # Two axes in one plane with the centre.
    in_plane = line(centre + u, v), line(centre + 3 * v, u + v)
    assert rank([*about(centre, *in_plane)]) == 1
    said = "axes a and b lie in one plane with C"
    assert dependent_about("C", named[:2], 1) == said
    # Three that meet a line through the centre.
    on_line = [line(centre + k * p, way) for k, way in ((1, u), (2, v), (-1, w))]
    assert rank([*about(centre, *on_line)]) == 2
    said = "the planes of C with axes a, b and c have a line in common"
    assert dependent_about("C", named, 2) == said
    # A slide at right angles to the plane of an axis and the centre.
    moved = about(centre, line(centre + u, v), couple(np.cross(u, v)))
    assert rank([*moved]) == 1
    said = "slide s is normal to the plane of axis a and C"
    assert dependent_about("C", [named[0], slide], 1) == said


def test_lines_through_two_points_are_told_apart() -> None:
    joins = [NamedScrew((), JOIN, f"through {p} and {q}", 0) for p, q in ("AB", "CD")]
    assert called(joins) == "the lines through A and B, and through C and D,"
    axes = [NamedScrew((), AXIS, name, 0) for name in "123"]
    assert called(axes) == "axes 1, 2 and 3"
    assert called([axes[0], joins[0]]) == "axis 1 and the line through A and B"


def test_zeros_elsewhere_are_seen() -> None:
    assembly = Assembly(sk.load("3rpr_planar").mechanism)
    ring = assembly.common_twists.ring
    root, library = assembly.root(ring), assembly.library(ring)
    x, y, c = (ring.symbol(n) for n in ("x", "y", "a3x"))
    piece = Piece((x,), tuple(restricted(root, x)))
    assert zeros_beside(piece, [x * c * 3], root, library) == []
    assert zeros_beside(piece, [x * y], root, library) == [y]
    assert zeros_beside(piece, [x * y, x * (y + x)], root, library) == []
    assert zeros_beside(piece, [x * y, x * y * (y + 1)], root, library) is None
    assert zeros_beside(piece, [x * y, x * (y + c)], root, library) == []
    assert zeros_beside(piece, [y], root, library) is None
    names = ("y", "a2", "a3x", "a3y", "b2", "b3x", "b3y")
    long = x + sum((ring.symbol(n) for n in names), ring.one) ** 6
    assert len(long) > LARGEST
    piece = Piece((long,), tuple(restricted(root, long)))
    assert zeros_beside(piece, [long * 3], root, library) == []
    assert zeros_beside(piece, [long * y], root, library) == [y]
    assert zeros_beside(piece, [long + y], root, library) is None


def test_a_factor_that_half_angles_alone_show_is_told_from_what_is_beside() -> None:
    """With φ = 2 atan t: ((x − 2)·t + z) times cos φ/2, which is zero at φ = π."""
    ring, (value, turned) = in_one_ring(
        "x*sin(p) + z*cos(p) + z - 2*sin(p)", "cos(p) + 1"
    )
    root, library = Branch(ring, Assumptions()), FactorLibrary(ring)
    pieces = pieces_of(common_zeros(root, [value], Search(library)).branches)
    assert sorted(len(piece.equations) for piece in pieces) == [2, 2]
    for piece in pieces:
        found = zeros_beside(piece, [value], root, library)
        assert found is not None
        (beside,) = found
        if turned in piece.equations:  # the other factor, by the sum of two squares
            assert len(beside) > 2
        else:
            assert beside == turned


def test_two_points_are_named_one_after_the_other() -> None:
    axes = tuple(Axis(n, int(n == "R"), (0, 0, 1), (0, 0, 0)) for n in "1245R")
    shoulder, wrist = (Point(own, own, (1, 0, 0)) for own in (("1", "2"), ("4", "5")))
    centre = Point((), (), (0, 1, 0), "the centre of S")
    for points, words in (
        (
            (shoulder, wrist),
            "the common point of axes 1 and 2 and that of axes 4 and 5",
        ),
        ((shoulder, centre), "the common point of axes 1 and 2 and the centre of S"),
        ((centre, wrist), "the centre of S and the common point of axes 4 and 5"),
    ):
        said = {s.words for s in statements(Features(axes, points, ()))}
        assert f"{words} coincide" in said
        assert f"the line through {words} meets axis R" in said


def test_statements_are_kept_that_cut_something_off() -> None:
    assembly = Assembly(sk.load("3rpr_planar").mechanism)
    ring = assembly.common_twists.ring
    root, library = assembly.root(ring), assembly.library(ring)
    x, y = (ring.symbol(n) - 1 for n in "xy")

    def where(*equations: Polynomial) -> Piece:
        zeros = common_zeros(root, equations, Search(library))
        return Piece(equations, zeros.branches)

    corner, line = where(x, y), where(x, y - 1)
    said = [("wide", [x * y]), ("first", [x]), ("second", [y])]
    found = conjunction(corner, said, root, library)
    assert found == Conjunction(("first", "second"))
    # A product that vanishes elsewhere too is not enough; nor is one that is squared.
    assert conjunction(corner, said[:2], root, library) is None
    assert conjunction(corner, [("x", [x, y * (y - 2)])], root, library) is None
    # Real numbers are zero where the sum of their squares is.
    squares = [("both", [x * x + y * y])]
    assert conjunction(corner, squares, root, library) == Conjunction(("both",))
    # Two components that share a statement say so; a third set hides that.
    either = [("either", [x, y * (y - 1)])]
    found = conjunction(corner, either, root, library, [corner, line])
    assert found == Conjunction(("either",), (1,))
    three = [("three", [x, y * (y - 1) * (y - 2)])]
    assert conjunction(corner, three, root, library, [corner, line]) is None


def test_multiples_by_roots_are_one_condition() -> None:
    ring = Assembly(sk.load("delta_ss").mechanism).common_twists.ring
    x, root = ring.symbol("x"), ring.generator("r3")
    y = ring.symbol("y")
    key = condition_key(ring, x + root * y)
    assert condition_key(ring, ring.normal(-5 * root * (x + root * y))) == key
    assert condition_key(ring, ring.normal((1 + root) * (x + root * y))) == key
    assert condition_key(ring, x - root * y) != key
    assert condition_key(ring, x + y) != key


def test_wrenches_behind_a_hinge_are_those_of_rods() -> None:
    """Of four rods and a hinge: what the rods carry and the hinge lets pass."""
    assembly = Assembly(sk.load("h4").mechanism)
    scheme = assembly.mechanism.actuated
    ring = assembly.common_twists.ring
    named = [s for s in wrench_screws(assembly, scheme) if s.limb == 0]
    assert [s.free for s in named] == [False, False, True]
    lengths = {"d": 1.0, "r": 1.3, "c": 0.4, "e": 2.1, "x": 0.3, "y": -0.2, "z": -4.7}
    lengths |= {"s1": 4.4, "s2": 5.2, "s3": -6.1, "s4": -5.3}
    phi = 0.37
    posture = lengths | {"phi": phi}
    rows = [values([text(ring, x) for x in s.column], posture) for s in named]
    # By hand, in the frame of the base: the rods of the first half, and its hinge.
    i, j, k = np.eye(3)
    at = np.array([lengths[n] for n in "xyz"])
    hinge = at + lengths["d"] * np.array([np.cos(phi), np.sin(phi), 0])
    rods = []
    for way, across, slide in (
        (i, j, np.array([lengths["s1"], lengths["e"], 0])),
        (j, i, np.array([lengths["e"], lengths["s2"], 0])),
    ):
        for side in (1, -1):
            ball = hinge + lengths["r"] * way + side * lengths["c"] * across
            rods.append(line(ball, slide + side * lengths["c"] * across - ball))
    turning = line(hinge, k)
    work = np.array([rod[:3] @ turning[3:] + rod[3:] @ turning[:3] for rod in rods])
    passed = [*(np.linalg.svd(work[None])[2][1:] @ np.array(rods))]
    assert rank(passed) == rank(rows) == 3
    assert rank([*passed, *rows]) == 3


@cache
def _answer(case: str) -> Singularities:
    return sk.singularities(sk.load(case))


@pytest.mark.parametrize(
    ("case", "part", "sentence"),
    [
        # Hunt 1978; Sefrioui & Gosselin 1995.
        (
            "3rpr_planar",
            "actuation",
            "lines A1 B1, A2 B2 and A3 B3 meet in one point or are parallel",
        ),
        # Gosselin & Angeles 1990: the distal links.
        (
            "3rrr_planar",
            "actuation",
            "lines B1 C1, B2 C2 and B3 C3 meet in one point or are parallel",
        ),
        # The legs outstretched or folded: each pulls along its line alone.
        (
            "3rrr_planar",
            "constraint",
            "axes A1, C1 and B1 lie in one plane; axes A2, C2 and B2 lie in one plane; "
            "axes A3, C3 and B3 lie in one plane; lines A1 C1, A2 C2 and A3 C3 meet in "
            "one point or are parallel",
        ),
        (
            "3prs",
            "constraint",
            "slide P11 is normal to the plane of axis R12 and the centre of S13; slide "
            "P21 is normal to the plane of axis R22 and the centre of S23; slide P31 "
            "is normal to the plane of axis R32 and the centre of S33; the common "
            "normal of axes P11 and R12 is parallel to the plane of the centre of S13, "
            "the centre of S23 and the centre of S33",
        ),
        ("five_bar", "actuation", "axes B, D and C lie in one plane"),
        ("five_bar", "constraint", "axes A, B, E, D and C lie in one plane"),
        ("scara_serial", "limb", "axes q1, q2 and q3 lie in one plane"),
        ("slider_crank", "actuation", "slide P is normal to the plane of axes A and B"),
        (
            "3prs",
            "limb",
            "slide P11 is normal to the plane of axis R12 and the centre of S13",
        ),
        # Ben-Horin & Shoham 2006: three legs with two wrenches each in a plane.
        (
            "3rps",
            "actuation",
            "the plane of B1, B2 and B3, the plane through B1 and A1 parallel to axis "
            "R11, the plane through B2 and A2 parallel to axis R21 and the plane "
            "through B3 and A3 parallel to axis R31 meet in one point",
        ),
        (
            "spherical_3rrr",
            "actuation",
            "the normals of axes R12 and R13, of axes R22 and R23 and of axes R32 and "
            "R33 are parallel to one plane",
        ),
    ],
)
def test_known_conditions_are_said(case: str, part: str, sentence: str) -> None:
    answer = _answer(case)
    found = answer.limb[0] if part == "limb" else getattr(answer, part)
    assert sentence in {component.geometry for component in found.components}


def test_sentences_count_components_as_the_answer_does() -> None:
    """Of 3-PRS: three limb components come before those that refer to each other."""
    answer = _answer("3prs")
    before = sum(len(limb.components) for limb in answer.limb)
    for number, one in enumerate(answer.constraint.components, before + 1):
        for told in re.findall(r"here and on component (\d+)", one.geometry or ""):
            other = answer.constraint.components[int(told) - before - 1]
            assert f"here and on component {number})" in (other.geometry or "")
    assert "here and on component 5" in (answer.constraint.components[0].geometry or "")


def test_a_statement_of_several_components_names_them_all() -> None:
    """Four axes through one point have rank 2 exactly where one plane holds them."""
    answer = _answer("spherical_four_bar")
    before = sum(len(limb.components) for limb in answer.limb)
    listed = answer.constraint.components
    assert {one.rank for one in listed} == {2}
    plane = "axes a, b, d and c lie in one plane"
    several = [one for one in listed if re.search("on components", one.geometry or "")]
    assert len(several) == 2
    for one in several:
        others = [str(n) for n, o in enumerate(listed, before + 1) if o is not one]
        there = f"{', '.join(others[:-1])} and {others[-1]}"
        assert one.geometry == f"{plane} (here and on components {there})"


def test_a_stretched_arm_is_told_once_for_all_its_components() -> None:
    """Of an arm and a point contact in the plane: its four axes are parallel."""
    arms = Assembly(sk.load("dual_planar_3r").mechanism)
    found = limb_singularities(arms, arms.limbs[0]).components
    assert len(found) == 4
    assert {one.geometry for one in found} == {
        "axes a1, a2, a3 and ca lie in one plane (here and on the other components "
        "of the limb)"
    }
