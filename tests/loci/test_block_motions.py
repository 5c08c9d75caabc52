"""What blocks let through, and the sentences that it gives: against vectors by hand.

Two halves stand on pairs of rods between universal joints and carry a bar between two
hinges, as in H4.  With the slides locked a half translates normal to its rods; without,
it turns about the line that the planes of its joints have in common.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path

import numpy as np
import pytest
from loci.numeric import Array, value

import screwkit as sk
from screwkit.algebra.polynomial_text import text
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.block_motions import block_motions
from screwkit.loci.figure_words import dependent
from screwkit.loci.named_screws import AXIS, SLIDE, NamedScrew
from screwkit.results.singularities import Singularities

pytestmark = pytest.mark.xdist_group("halves on pairs of rods")
SOURCE = np.random.default_rng(12)
EX, EY, EZ = np.eye(3)
FIXED = {1: (0.0, 3.0), 2: (3.0, 0.0), 3: (-3.0, -3.0), 4: (-3.0, -2.0)}

HEAD = """
screwkit: 1
name: two_halves
space: spatial
geometry: posture
base: base
platform: bar
links: [base, half1, half2, bar, a1, b1, a2, b2, a3, b3, a4, b4]
variables: {y: 0.2, z: -3, phi: {value: 0.3, angle: true}, s1: 2, s2: 2}
pose: {translation: [0, y, z], rotation: {axis: z, angle: phi}}
vectors: {i: [1, 0, 0], j: [0, 1, 0], k: [0, 0, 1]}
points:
  H1: {link: bar, at: [1, 0, 0]}
  H2: {link: bar, at: [-1, 0, 0]}
  S1: [s1, 3, 0]
  S2: [3, s2, 0]
  S3: [-3, -3, 0]
  S4: [-3, -2, 0]
  B1: H1 + i
  B2: H1 + j
  B3: H2 - i
  B4: H2 - j
joints:
  - {name: Rh1, type: revolute, parent: half1, child: bar, axis: k, point: H1}
  - {name: Rh2, type: revolute, parent: half2, child: bar, axis: k, point: H2}
"""
LIMB = """
  - {{name: P{n}, type: prismatic, parent: base, child: a{n}, axis: {way}, point: S{n}}}
  - {{name: U{n}, type: universal, parent: a{n}, child: b{n}, point: S{n},
     axes: [{fixed}, "cross({fixed}, B{n} - S{n})"]}}
  - {{name: V{n}, type: universal, parent: b{n}, child: half{half}, point: B{n},
     axes: ["cross({fixed}, B{n} - S{n})", {fixed}]}}
"""


@cache
def written() -> str:
    limbs = [
        LIMB.format(n=n, way=way, fixed=fixed, half=half)
        for n, way, fixed, half in (
            (1, "i", "j", 1),
            (2, "j", "i", 1),
            (3, "i", "j", 2),
            (4, "j", "i", 2),
        )
    ]
    return HEAD + "".join(limbs) + "actuated: [P1, P2, P3, P4]\n"


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    found = tmp_path_factory.mktemp("halves") / "two_halves.yaml"
    found.write_text(written(), encoding="utf-8")
    return found


@pytest.fixture(scope="module")
def answer(path: Path) -> Singularities:
    return sk.singularities(sk.load(path))


class Halves:
    """Points and rods at a posture, by hand."""

    def __init__(self, at: dict[str, float]) -> None:
        centre = np.array([0.0, at["y"], at["z"]])
        bar = np.array([np.cos(at["phi"]), np.sin(at["phi"]), 0.0])
        self.hinges = centre + bar, centre - bar
        one, other = self.hinges
        ends = [one + EX, one + EY, other - EX, other - EY]
        starts = {n: np.array([*place, 0.0]) for n, place in FIXED.items()}
        starts[1][0], starts[2][1] = at["s1"], at["s2"]
        self.ends = ends
        self.rods = [end - starts[n + 1] for n, end in enumerate(ends)]

    def moving_on(self) -> float:
        """Of the directions normal to two rods each and to the plane of the hinges."""
        one, two, three, four = self.rods
        across = np.cross(EZ, self.hinges[0] - self.hinges[1])
        return _det(np.cross(one, two), np.cross(three, four), across)

    def tilting(self) -> float:
        """Of the hinges and the lines about which the halves turn."""
        normals = [
            np.cross(way, np.cross(way, rod))
            for way, rod in zip((EY, EX, EY, EX), self.rods, strict=True)
        ]
        one, two = (np.cross(normals[n], normals[n + 1]) for n in (0, 2))
        return _det(one, two, EZ)


def _det(*rows: Array) -> float:
    return float(np.linalg.det(np.array(rows)))


def _posture() -> dict[str, float]:
    return dict(
        zip(("y", "z", "phi", "s1", "s2"), SOURCE.uniform(1, 3, 5), strict=True)
    )


def _zero(equation: str, at: dict[str, float]) -> float:
    """The value of s1, in which it is linear, at which an equation holds."""
    low, high = (value(equation, {**at, "s1": s}) for s in (0.0, 1.0))
    return -low / (high - low)


def test_halves_translate_normal_to_their_rods(answer: Singularities) -> None:
    part = answer.actuation
    assert part is not None
    assert part.complete
    (found,) = (c for c in part.components if "and the normal of" in (c.geometry or ""))
    assert found.geometry == (
        "the directions normal to lines B1 S1 and B2 S2, and to lines B3 S3 and B4 S4, "
        "and the normal of the plane of axes Rh1 and Rh2 are parallel to one plane "
        "(given z ≠ 0)"
    )
    (equation,) = found.equations
    # The same polynomial but for a power of z, so the same zeros where z is not 0.
    ratios = []
    for _ in range(6):
        at = _posture()
        ratios.append(Halves(at).moving_on() / value(equation, at) / at["z"])
    assert np.ptp(ratios) < 1e-9 * abs(ratios[0])


def test_halves_turn_about_the_line_common_to_two_planes(
    answer: Singularities,
) -> None:
    (found,) = (
        c for c in answer.constraint.components if "meet, and in" in (c.geometry or "")
    )
    sentence = (
        "the lines in which the planes of axes U1:0, U1:1 and of axes U2:0, U2:1 meet, "
        "and in which the planes of axes U3:0, U3:1 and of axes U4:0, U4:1 meet, and "
        "axis Rh1 are parallel to one plane (given z ≠ 0)"
    )
    assert found.geometry == sentence
    # With the slides locked the condition is the same, and so is what it means.
    part = answer.actuation
    assert part is not None
    assert {c.equations for c in part.components if c.geometry == sentence} == {
        found.equations
    }
    (equation,) = found.equations
    for _ in range(6):
        at = _posture()
        on = {**at, "s1": _zero(equation, at)}
        assert abs(Halves(on).tilting()) < 1e-6 * abs(Halves(at).tilting())


def test_a_block_lets_through_what_is_named(path: Path) -> None:
    """Rods between universal joints: forces along them, couples across the joints."""
    assembly = Assembly(sk.load(path).mechanism)
    framed = assembly.common_twists
    at = _posture()
    halves = Halves(at)
    for locked in (assembly.mechanism.actuated, ()):
        named = [s for s in block_motions(assembly, locked) if s.name[0] != "R"]
        assert {s.limb for s in named} == {0, 1}
        for screw in named:
            texts = [text(framed.ring, entry) for entry in screw.column]
            twist = np.array([value(entry, at) for entry in texts])
            for n in (2 * screw.limb, 2 * screw.limb + 1):
                rod, end, way = halves.rods[n], halves.ends[n], (EY, EX)[n % 2]
                force, moment = rod, np.cross(end, rod)
                couple = np.cross(way, np.cross(way, rod))
                works = [couple @ twist[:3]]
                works += [force @ twist[3:] + moment @ twist[:3]] if locked else []
                assert np.allclose(works, 0, atol=1e-9 * np.linalg.norm(twist))


def test_two_translations_and_two_parallel_lines() -> None:
    """Dependent where the translations and the normal of the lines are coplanar."""
    way, place, other, one = SOURCE.integers(1, 9, (4, 3))
    across = np.cross(way, other - place)
    rows = [
        [*way, *np.cross(place, way)],
        [*way, *np.cross(other, way)],
        [0, 0, 0, *one],
        [0, 0, 0, *(2 * across - 3 * one)],
    ]
    assert np.linalg.matrix_rank(np.array(rows, dtype=float)) == 3
    screws = [NamedScrew((), AXIS, n, 0) for n in "ab"]
    screws += [NamedScrew((), SLIDE, n, 0, free=True) for n in "st"]
    general = [*rows[:3], [0, 0, 0, *SOURCE.integers(1, 9, 3)]]
    assert dependent(screws, 3, [[int(x) for x in row] for row in general], 10007) == (
        "slides s and t and the normal of the plane of axes a and b are parallel to "
        "one plane"
    )
