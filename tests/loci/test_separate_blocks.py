"""Couples and forces of a Delta robot, six in all and none of them redundant.

Where every arm is in line with its rod, seen along its axes, a limb holds a couple and
a force along its rod.  The six are dependent where the couples are, or where the rods
are parallel to one plane: two short determinants for one long one.
"""

from __future__ import annotations

import numpy as np
import pytest
from algebra.test_only_part import posture, singular_postures
from loci.numeric import value

from screwkit.algebra.branches import Branch
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search, imposed
from screwkit.case import load_text
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.wrench_blocks import block_minors

OUT = [("1", "0"), ("-1/2", "sqrt(3)/2"), ("-1/2", "-sqrt(3)/2")]


def delta() -> Assembly:
    """With rods on two universal joints, and platforms of one size."""
    points, vectors, joints = [], ["  k: [0, 0, 1]"], []
    links = ["base", "platform"]
    for n, (a, b) in enumerate(OUT):
        links += [f"arm{n}", f"rod{n}"]
        vectors += [
            f"  e{n}: [{a}, {b}, 0]",
            f"  t{n}: [-({b}), {a}, 0]",
            f"  w{n}: cross(t{n}, B{n} - C{n})",
        ]
        points += [
            f"  A{n}: 1*e{n}",
            f"  C{n}: A{n} + cos(q{n})*e{n} + sin(q{n})*k",
            f"  B{n}: P + 1*e{n}",
        ]
        joints += [
            f"  - {{name: R{n}, type: revolute, parent: base, child: arm{n}, "
            f"axis: t{n}, point: A{n}}}",
            f"  - {{name: U{n}, type: universal, parent: arm{n}, child: rod{n}, "
            f"axes: [t{n}, w{n}], point: C{n}}}",
            f"  - {{name: V{n}, type: universal, parent: rod{n}, child: platform, "
            f"axes: [w{n}, t{n}], point: B{n}}}",
        ]
    case = [
        "screwkit: 1",
        "name: delta",
        "space: spatial",
        "geometry: posture",
        "base: base",
        "platform: platform",
        f"links: [{', '.join(links)}]",
        "variables: {x: 0, y: 0, z: -2, q0: {value: 0.1, angle: true}, "
        "q1: {value: 0.2, angle: true}, q2: {value: 0.3, angle: true}}",
        "pose: {translation: [x, y, z]}",
        "vectors:",
        *vectors,
        "points:",
        *points,
        "  P: {link: platform, at: [0, 0, 0]}",
        "joints:",
        *joints,
        "actuated: [R0, R1, R2]",
    ]
    return Assembly(load_text("\n".join(case)).mechanism)


@pytest.fixture(scope="module")
def lists() -> list[list[str]]:
    """The minors of each block, where all arms are in line with their rods."""
    assembly = delta()
    ring = assembly.common_twists.ring
    search = Search(assembly.library(ring))
    branches: list[Branch] = [assembly.root(ring)]
    places = dict(zip(ring.symbols, ring.symbol_indices(), strict=True))
    x, y, z = (ring.context.gen(places[name]) for name in "xyz")
    root = ring.generator(ring.names[-1])
    for n, (a, b) in enumerate(((2, 0), (-1, 1), (-1, -1))):
        along = a * x + (b * root * y if b else 0)
        arm = ring.normal(ring.sines[n] * along - 2 * ring.cosines[n] * z)
        branches = [part for own in branches for part in imposed(own, arm, search)]
    (branch,) = branches
    limbs = [assembly.told(limb.joints) for limb in assembly.limbs]
    assert block_minors(branch, limbs, 6, search) is None
    found = block_minors(branch, limbs, 6, search, overlapping=False)
    assert found is not None
    return [[text(ring, minor) for minor in minors] for minors in found]


def test_rods_parallel_to_one_plane_are_a_block(lists: list[list[str]]) -> None:
    """One list vanishes there, and none at other postures."""

    def vanish(at: dict[str, float]) -> int:
        return sum(max(abs(value(e, at)) for e in own) < 1e-8 for own in lists)

    for at in singular_postures():
        assert vanish(at) == 1
    source = np.random.default_rng(1)
    for _ in range(5):
        x, y, z = (float(v) for v in source.uniform(-2, 2, 3))
        assert vanish(posture(x, y, z, (0, 1, 0))) == 0
