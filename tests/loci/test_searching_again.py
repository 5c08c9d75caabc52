"""What a component's first equations covered and its last ones do not is still found.

In the loop below, one revolute and three cylindrical joints, the first two axes are
parallel where t is 0 or π and u = 0.  By hand: there the two are a vertical rotation
and a translation along y; the other cylindrical axes are normal to x, so that all
translations of the loop are along y and z; with two more rotations that makes rank 5
of 6.  The first equations that are found of the other component hold there too.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from loci.numeric import value

import screwkit as sk

RCCC = """screwkit: 1
name: rccc
geometry: posture
base: base
platform: last
links: [base, crank, rod, last]
parameters:
  a: {value: 1, positive: true}
  d: {value: 2, positive: true}
variables:
  t: {value: 1/3, angle: true}
  u: 1/4
  v: 1/2
  x: 1
  y: 2
  z: 1
joints:
  - {name: R, type: revolute, parent: base, child: crank, axis: [0, 0, 1],
     point: [0, 0, 0]}
  - {name: C1, type: cylindrical, parent: crank, child: rod,
     axis: [sin(t), 0, cos(t)], point: [a, 0, 0]}
  - {name: C2, type: cylindrical, parent: rod, child: last, axis: [u, v, 1],
     point: [x, y, z]}
  - {name: C3, type: cylindrical, parent: last, child: base, axis: [0, 1, 1],
     point: [0, d, 0]}
"""

NAMES = ("t", "u", "v", "x", "y", "z")


def turn(axis: list[float], point: list[float]) -> list[float]:
    """The twist of a rotation."""
    return [*axis, *np.cross(point, axis)]


def loop_rank(at: dict[str, float]) -> int:
    """Of the seven unit twists (ω; v), written from the file by hand."""
    t, u, v, x, y, z = (at[name] for name in NAMES)
    slides = [[np.sin(t), 0, np.cos(t)], [u, v, 1], [0, 1, 1]]
    points = [[at["a"], 0, 0], [x, y, z], [0, at["d"], 0]]
    twists = [turn([0, 0, 1], [0, 0, 0])]
    for axis, point in zip(slides, points, strict=True):
        twists += [turn(axis, point), [0, 0, 0, *axis]]
    sizes = np.linalg.svd(np.array(twists), compute_uv=False)
    assert not np.any((sizes > 1e-10) & (sizes < 1e-5)), "no clear rank"
    return int(np.sum(sizes > 1e-7))


@pytest.mark.parametrize("t", [0.0, np.pi])
def test_parallel_first_axes_are_a_singularity_of_the_loop(
    t: float, tmp_path: Path
) -> None:
    file = tmp_path / "rccc.yaml"
    file.write_text(RCCC, encoding="utf-8")
    found = sk.singularities(sk.load(file)).constraint
    assert found.complete
    source = np.random.default_rng(2)
    at = dict(zip((*NAMES, "a", "d"), source.uniform(0.5, 2, 8), strict=True))
    assert loop_rank(at) == 6
    at |= {"t": t, "u": 0.0}
    assert loop_rank(at) == 5
    families = [c.equations for c in found.components]
    there = [own for own in families if all(abs(value(e, at)) < 1e-12 for e in own)]
    assert [set(own) for own in there] == [{"sin(t)", "u"}]


LAST = "child: base, axis: [0, 1, 1]"
LINKS = "platform: tool\nlinks: [base, crank, rod, last, tool]"
AGAIN = """  - {name: C2x, type: cylindrical, parent: rod, child: last, axis: [u, v, 1],
     point: [x, y, z]}
"""


def test_the_same_of_a_limb_that_holds_one_of_the_joints_twice(tmp_path: Path) -> None:
    """Two joints on one axis between the same bodies move as one: the twists are 7."""
    file = tmp_path / "hybrid.yaml"
    text = RCCC.replace("platform: last\nlinks: [base, crank, rod, last]", LINKS)
    assert LAST in text
    text = text.replace(LAST, LAST.replace("base", "tool")) + AGAIN
    file.write_text(text, encoding="utf-8")
    (limb,) = sk.singularities(sk.load(file)).limb
    assert (limb.generic_rank, limb.complete) == (6, True)
    source = np.random.default_rng(3)
    at = dict(zip((*NAMES, "a", "d"), source.uniform(0.5, 2, 8), strict=True))
    at |= {"t": 0.0, "u": 0.0}
    assert loop_rank(at) == 5
    families = [c.equations for c in limb.components]
    assert any(all(abs(value(e, at)) < 1e-12 for e in own) for own in families)


LIMB = """screwkit: 1
name: limb
geometry: posture
base: base
platform: platform
links: [base, l1, l2, l3, l4, l5, platform]
parameters:
  b: {value: 1, positive: true}
  d: {value: 2, positive: true}
variables:
  u: 1/3
  v: 1/5
  s: 2
  t: {value: 1/3, angle: true}
  r: 1/2
  m: 3/2
  n: 3/4
joints:
  - {name: P1, type: prismatic, parent: base, child: l1, axis: [0, 0, 1]}
  - {name: U2, type: universal, parent: l1, child: l2, axes: [[0, 0, 1], [1, 0, 0]],
     point: [b, 0, 0]}
  - {name: C3, type: cylindrical, parent: l2, child: l3, axis: [u, v, 1],
     point: [0, 1, s]}
  - {name: R4, type: revolute, parent: l3, child: l4, axis: [cos(t), sin(t), 0],
     point: [r, 0, 0]}
  - {name: R5, type: revolute, parent: l4, child: l5, axis: [m, n, 1],
     point: [0, 2, -2]}
  - {name: R6, type: revolute, parent: l5, child: platform, axis: [1, 1, 0],
     point: [0, d, 0]}
"""


def limb_rank(at: dict[str, float]) -> int:
    """Of the seven unit twists (ω; v), written from the file by hand."""
    u, v = at["u"], at["v"]
    twists = [
        [0, 0, 0, 0, 0, 1],
        turn([0, 0, 1], [at["b"], 0, 0]),
        turn([1, 0, 0], [at["b"], 0, 0]),
        turn([u, v, 1], [0, 1, at["s"]]),
        [0, 0, 0, u, v, 1],
        turn([np.cos(at["t"]), np.sin(at["t"]), 0], [at["r"], 0, 0]),
        turn([at["m"], at["n"], 1], [0, 2, -2]),
        turn([1, 1, 0], [0, at["d"], 0]),
    ]
    sizes = np.linalg.svd(np.array(twists), compute_uv=False)
    return int(np.sum(sizes > 1e-8))


def test_equations_of_a_limb_hold_at_singular_postures_alone(tmp_path: Path) -> None:
    """Two minors vanish where u = v = 0: a slide is doubled, and nothing is lost."""
    file = tmp_path / "limb.yaml"
    file.write_text(LIMB, encoding="utf-8")
    limb = sk.singularities(sk.load(file)).limb[0]
    assert limb.complete
    source = np.random.default_rng(4)
    names = ("u", "v", "s", "t", "r", "m", "n", "b", "d")
    for _ in range(5):
        at = dict(zip(names, source.uniform(0.5, 2, len(names)), strict=True))
        at |= {"u": 0.0, "v": 0.0}
        assert limb_rank(at) == limb.generic_rank == 6
        for component in limb.components:
            assert max(abs(value(e, at)) for e in component.equations) > 1e-6
