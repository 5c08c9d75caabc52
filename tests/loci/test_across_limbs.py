"""Statements across limbs, planes with a line in common, and figures that are shared.

Two unequal arms: with the long wrist stretched and the short arm upright their platform
keeps a wrench where the line through both centres meets an axis of the wrist.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from itertools import pairwise, product
from pathlib import Path

import numpy as np
from kinematics.float_loops import FloatLoops, counted
from loci.numeric import Array, limb_columns, value

import screwkit as sk
from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.minors import minors_of_size
from screwkit.algebra.parse import parse
from screwkit.algebra.points import residue
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.proved_inside import left_over
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.told_parts import told_parts
from screwkit.loci.common_lines import limb_planes, with_common_line
from screwkit.loci.far_statements import far_statements
from screwkit.loci.loop_drop import loop_state
from screwkit.loci.meanings import Meanings
from screwkit.loci.mechanism_figures import figures_of, figures_on
from screwkit.loci.pieces import Piece, pieces_of
from screwkit.loci.placed_features import bands_of, features_of
from screwkit.loci.surely_singular import all_lost

SOURCE = np.random.default_rng(31)


class Arms:
    """The two unequal arms, and statements about their axes as polynomials."""

    def __init__(self) -> None:
        self.assembly = Assembly(sk.load("unequal_arms").mechanism)
        framed = self.assembly.common_twists
        self.ring = framed.ring
        self.root: Branch = self.assembly.root(self.ring)
        self.library = self.assembly.library(self.ring)
        self.features = features_of(framed)
        self.bands = bands_of(self.ring, self.features)

    def read(self, texts: Sequence[str]) -> list[Polynomial]:
        return [evaluate(parse(text), self.ring) for text in texts]

    def where(self, *equations: Polynomial) -> list[Piece]:
        zeros = common_zeros(self.root, equations, Search(self.library))
        assert zeros.complete
        return pieces_of(zeros.branches)

    def scalars(self, words: str) -> list[Polynomial]:
        found = far_statements(self.features, self.bands)
        (one,) = (s for s in found if s.words == words)
        values = (self.ring.normal(v) for v in one.scalars(self.features))
        return [primitive(self.ring.without_divisors([v])[0]) for v in values if v != 0]


@cache
def arms() -> Arms:
    return Arms()


def _columns(posture: dict[str, float]) -> tuple[Array, Array]:
    mechanism = arms().assembly.mechanism
    limbs = arms().assembly.limbs
    short, long = (limb_columns(mechanism, limb.chain, posture) for limb in limbs)
    return short, long


LENGTHS = {"c": 0.3, "upper": 0.25, "fore": 0.2}


def _drawn() -> dict[str, float]:
    names = [f"qA{i}" for i in range(1, 5)] + [f"qB{i}" for i in range(1, 6)]
    return {**LENGTHS, **dict(zip(names, SOURCE.uniform(-3, 3, 9), strict=True))}


def test_the_catalogue_is_what_it_says() -> None:
    """Planes of parallel axes, and lines parallel to axes, against cross products."""
    posture = _drawn()
    short, long = _columns(posture)
    named = dict(zip(("A1", "A2", "A3", "A4"), short.T, strict=True))
    named |= dict(zip(("B1", "B2", "B3", "B4", "B5"), long.T, strict=True))

    def point(joint: str) -> Array:
        way, moment = named[joint][:3], named[joint][3:]
        return np.asarray(np.cross(way, moment) / (way @ way))

    def normal(i: str, j: str) -> Array:
        return np.asarray(np.cross(named[i][:3], point(j) - point(i)))

    assert set(arms().bands) == {("A1", "B1"), ("A2", "A3")}
    across = np.cross(normal("A1", "B1"), normal("A2", "A3"))
    assert np.linalg.norm(across) > 1e-3
    upright = {**posture, "qA1": math.pi / 2, "qA2": -math.pi / 2}
    short, long = _columns(upright)
    named |= dict(zip(("A1", "A2", "A3", "A4"), short.T, strict=True))
    across = np.cross(normal("A1", "B1"), normal("A2", "A3"))
    assert np.linalg.norm(across) < 1e-9
    words = "the planes of axes A1, B1 and of axes A2, A3 are parallel"
    found = {len(piece.equations) for piece in arms().where(*arms().scalars(words))}
    assert found == {2}


EQUATIONS = (
    "sin(qB4)",
    "sin(qA1) - 1",
    "sin(qA2) + 1",
    "2*c*cos(qB2)*cos(qB3)*sin(qB1 - qA1) + 2*c*sin(qB3)*cos(qB1 - qA1)"
    " + upper*sin(qB2)*cos(qB3)",
)


def test_statements_of_a_component_are_chosen_among_all() -> None:
    """Of a hundred that hold on it, four that are as many conditions."""
    a = arms()
    (piece,) = a.where(*a.read(EQUATIONS))
    framed = a.assembly.common_twists
    limbs = [told_parts(a.assembly, limb) for limb in a.assembly.limbs]
    generic = loop_state(a.root, limbs)
    assert generic is not None
    meanings = Meanings(
        framed,
        a.root,
        a.library,
        figures_of(a.assembly),
        figures_on(a.assembly),
        singular=partial(all_lost, generic, limbs),
    )
    assert meanings.each_of(piece, [piece]) == (
        "axes B3 and B5 are one line; "
        "the common point of axes A3 and A4 lies on axis A1; "
        "the common point of axes B1, B2 and B3 lies on axis A2; "
        "the planes of the common point of axes B1, B2 and B3 with axes A1, A4 and B4 "
        "have a line in common (elsewhere only inside other components)"
    )


def test_wherever_the_sentence_holds_the_loop_has_lost_rank() -> None:
    """The short arm upright and the wrist stretched in every way, and what is left."""
    found = 0
    for one, two, wrist in product((1, -1), (1, -1), (0.0, math.pi)):
        posture = _drawn()
        posture |= {"qA1": one * math.pi / 2, "qA2": two * math.pi / 2, "qB4": wrist}

        def meet(angle: float, posture: dict[str, float] = posture) -> float:
            """Planes of the long shoulder with A1, A4 and B4: their normals."""
            short, long = _columns({**posture, "qB1": angle})
            centre = np.array([-LENGTHS["c"], 0.0, 0.0])
            rows = [
                axis[3:] - np.cross(centre, axis[:3])
                for axis in (short[:, 0], short[:, 3], long[:, 3])
            ]
            return float(np.linalg.det(np.array(rows)))

        for low, high in pairwise(np.linspace(-3, 3, 50)):
            if meet(low) * meet(high) < 0:
                short, long = _columns({**posture, "qB1": _root(meet, low, high)})
                sizes = np.linalg.svd(np.hstack([short, long]), compute_uv=False)
                assert sizes[5] < 1e-9
                assert sizes[4] > 1e-4
                found += 1
    assert found > 7


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    for _ in range(80):
        middle = (low + high) / 2
        if function(low) * function(middle) <= 0:
            high = middle
        else:
            low = middle
    return low


@dataclass(frozen=True)
class At(FloatLoops):
    """A mechanism at given numbers."""

    given: Mapping[str, float] = field(default_factory=dict)

    @property
    def values(self) -> dict[str, float]:
        return dict(self.given)


def _upright(source: np.random.Generator, phi: float) -> dict[str, float]:
    """4-RUU with three first links towards B1, B2 and B3, and h4 along C4 B4."""
    lengths = {"a": 5.0, "b": 2.0, "l1": 2.2, "l2": 1.4, "l3": 3.1, "l4": 2.3}
    x, y, z = source.uniform(-1, 1, 3)
    at = {**lengths, "x": x, "y": y, "z": z - 4, "phi": phi}
    for n in range(4):
        around, turned = (
            np.array([np.cos(n * np.pi / 2 + v), np.sin(n * np.pi / 2 + v)])
            for v in (0.0, phi)
        )
        start, end = 5 * around, [x, y] + 2 * turned
        theta = float(np.arctan2(*(end - start)[::-1]))
        at[f"theta{n + 1}"] = theta if n < 3 else float(source.uniform(-3, 3))
        at[f"eta{n + 1}"] = float(source.uniform(-3, 3))
        if n == 3:
            link = 2.3 * np.array([np.cos(at["theta4"]), np.sin(at["theta4"])])
            at["eta4"] = float(np.arctan2(*(end - start - link)[::-1]))
    return at


def test_planes_of_three_limbs_have_a_line_in_common() -> None:
    """4-RUU: with the platform not turned they do, and the loops lose rank there."""
    assembly = Assembly(sk.load("4ruu").mechanism)
    framed = assembly.common_twists
    features = features_of(framed)
    planes = limb_planes(framed.ring, features, bands_of(framed.ring, features))
    assert [plane.axes for plane in planes] == [
        (f"R{n}1", f"U{n}2:0") for n in (1, 2, 3, 4)
    ]
    source = np.random.default_rng(2)
    for phi, lost in ((0.0, 1), (0.4, 0)):
        at = _upright(source, phi)
        rows = [
            [value(text(framed.ring, entry), at) for entry in plane.column]
            for plane in planes[:3]
        ]
        sizes = np.linalg.svd(np.array(rows), compute_uv=False)
        assert (sizes[2] < 1e-9) == bool(lost)
        # The planes are those of the first links: vertical, through A_n.
        for n, row in enumerate(rows):
            away = np.array([np.cos(n * np.pi / 2), np.sin(n * np.pi / 2), 0])
            assert abs(np.dot(row[:3], 5 * away) - row[3]) < 1e-9
        # Three limbs of dimension 4 and one of 4: regular with the rank 16.
        assert (
            counted(At(assembly.mechanism, given=at).loop_matrix(())).rank == 16 - lost
        )


def test_planes_that_have_a_line_in_common_on_a_component_alone() -> None:
    """Three vertical planes through fixed points, where their directions fit."""
    assembly = Assembly(sk.load("4ruu").mechanism)
    framed = assembly.common_twists
    ring, features = framed.ring, features_of(framed)
    root, library = assembly.root(ring), assembly.library(ring)
    planes = limb_planes(ring, features, bands_of(ring, features))[:3]
    minors = minors_of_size(ring, [plane.column for plane in planes], 3)
    zeros = common_zeros(root, [ring.normal(m) for m in minors], Search(library))
    (piece, *_) = pieces_of(zeros.branches)
    ((words, scalars),) = with_common_line(ring, planes, root, piece)
    assert words == (
        "the planes of axes R11, U12:0, of axes R21, U22:0 and of axes R31, U32:0 have "
        "a line in common or are parallel"
    )
    assert all(residue(s, *at) == 0 for s in scalars for at in piece.branches[0].points)
    (elsewhere,) = pieces_of(root_pieces(root, library, ring))
    assert not list(with_common_line(ring, planes, root, elsewhere))


def root_pieces(
    root: Branch, library: FactorLibrary, ring: TrigonometricRing
) -> Sequence[Branch]:
    """The branch on which the platform is not turned."""
    sine = evaluate(parse("sin(phi)"), ring)
    return common_zeros(root, [sine], Search(library)).branches


def test_what_a_condition_divides_is_inside() -> None:
    """A multiple of a pending condition, hidden by sin² + cos² = 1."""
    a = arms()
    one, factor = a.read(
        (
            "cos(qA1)^2*sin(qA3)*cos(qB4) + sin(qA1)*cos(qA3)^2*sin(qB4)^2"
            " + cos(qB4)^2*sin(qA3)^2",
            "upper*sin(qA1)*sin(qA3) + cos(qA1)*cos(qB4) + fore*cos(qA3)*sin(qB4)",
        )
    )
    multiple = a.ring.normal(one * factor)
    (branch,) = restricted(a.root, one)
    assert branch.pending
    assert left_over(branch, [[multiple]]) == []
    assert left_over(branch, [[multiple + factor]]) is None


LEGS = """
screwkit: 1
name: six_legs
space: spatial
geometry: posture
base: base
platform: platform
links: [base, platform, l1, u1, l2, u2, l3, u3, l4, u4, l5, u5, l6, u6]
variables: {x: 0.1, z: 2, psi: {value: 0.1, angle: true}, th: {value: 0.1, angle: true}}
pose: {translation: [x, 0, z], rotation: {euler: zyx, angles: [psi, th, 0]}}
points:
"""
LEG = """
  - {{name: T{n}, type: spherical, parent: base, child: l{n}, point: A{n}}}
  - {{name: P{n}, type: prismatic, parent: l{n}, child: u{n}, axis: B{n} - A{n}}}
  - {{name: S{n}, type: spherical, parent: u{n}, child: platform, point: B{n}}}
"""
FEET = ((1, 0), (1, 0), (-1, 0), (-1, 0), (0, 2), (0, -2))
HIPS = ((1, 1), (-1, 1), (-1, -1), (1, -1), (1, 1), (-1, -1))


def _six_legs(path: Path) -> Path:
    lines = [LEGS]
    for n, ((a, b), (c, d)) in enumerate(zip(FEET, HIPS, strict=True), 1):
        lines.append(f"  A{n}: [{a}, {b}, 0]\n")
        lines.append(f"  B{n}: {{link: platform, at: [{c}, {d}, 0]}}\n")
    lines.append("joints:\n")
    lines.extend(LEG.format(n=n) for n in range(1, 7))
    lines.append("actuated: [P1, P2, P3, P4, P5, P6]\n")
    path.write_text("".join(lines), encoding="utf-8")
    return path


def _leg_lines(at: Mapping[str, float]) -> Array:
    psi, th = at["psi"], at["th"]
    about_z = np.array(
        [[np.cos(psi), -np.sin(psi), 0], [np.sin(psi), np.cos(psi), 0], [0, 0, 1]]
    )
    about_y = np.array(
        [[np.cos(th), 0, np.sin(th)], [0, 1, 0], [-np.sin(th), 0, np.cos(th)]]
    )
    rows = []
    for foot, hip in zip(FEET, HIPS, strict=True):
        start = np.array([*foot, 0.0])
        end = [at["x"], 0, at["z"]] + about_z @ about_y @ np.array([*hip, 0.0])
        rows.append([*(end - start), *np.cross(start, end - start)])
    return np.array(rows)


def test_a_determinant_of_two_factors_says_so_on_both(tmp_path: Path) -> None:
    answer = sk.singularities(sk.load(_six_legs(tmp_path / "six_legs.yaml"))).actuation
    assert answer is not None
    lines = "lines A1 B1, A1 B2, A3 B3, A3 B4, A5 B1 and A6 B3"
    one, other = answer.components
    assert one.equations == ("sin(th)",)
    assert one.geometry == (
        f"{lines} are lines of one linear complex "
        f"(here and on the other component of the scheme)"
    )
    assert (other.geometry or "").startswith(f"{lines} are lines of one linear complex")
    (longer,) = other.equations
    for _ in range(5):
        at = dict(zip(("x", "z", "psi"), SOURCE.uniform(0.2, 1.5, 3), strict=True))
        ratios = []
        for th in (0.3, 0.9, 2.1):
            posture = {**at, "th": th}
            both = np.sin(th) * value(longer, posture)
            ratios.append(np.linalg.det(_leg_lines(posture)) / both)
        assert np.ptp(ratios) < 1e-9 * abs(ratios[0])
