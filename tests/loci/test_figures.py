"""Figures of dependent lines: theorems on random lines, and known conditions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest
from loci.numeric import Array

import screwkit as sk
from screwkit.algebra.branches import restricted
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.features import Axis, Features, Point, statements
from screwkit.loci.figure_words import dependent, dependent_about
from screwkit.loci.named_screws import AXIS, JOIN, SLIDE, NamedScrew, called
from screwkit.loci.pieces import Piece
from screwkit.loci.same_zeros import LARGEST, zeros_beside

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
    answer = sk.singularities(sk.load(case))
    found = answer.limb[0] if part == "limb" else getattr(answer, part)
    assert sentence in {component.geometry for component in found.components}
