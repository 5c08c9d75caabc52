"""What rank a limb keeps where it is singular: found, checked, and lied about."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
import pytest
from certificates.forged import HEAD, certificate

from screwkit.case import load_text
from screwkit.certificates.checking import check
from screwkit.certificates.containment import is_whole_part
from screwkit.certificates.equations_told import Step
from screwkit.certificates.part_derivation import PartDerivation
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Floor, Locus, Node, Part, Reach
from screwkit.certificates.subjects import of_limb
from screwkit.certificates.texts import RefusedError

# Hinges at O, (x, y) and (u, v).
THREE = f"""{HEAD}
variables: {{x: 1, y: 2, u: 3, v: 5}}
joints:
  - {{name: "1", type: revolute, parent: ground, child: arm, point: [0, 0]}}
  - {{name: "2", type: revolute, parent: arm, child: fore, point: [x, y]}}
  - {{name: "3", type: revolute, parent: fore, child: tip, point: [u, v]}}
"""
# The same with links of lengths that are not 0.
LINKS = """
screwkit: 1
name: links
space: planar
base: ground
platform: tip
links: [ground, arm, fore, tip]
geometry: reference
parameters: {l: {value: 1, positive: true}, m: {value: 2, positive: true}}
joints:
  - {name: "1", type: revolute, parent: ground, child: arm, point: [0, 0]}
  - {name: "2", type: revolute, parent: arm, child: fore, point: [l, 0]}
  - {name: "3", type: revolute, parent: fore, child: tip, point: [l + m, 0]}
"""


def floors(text: str) -> tuple[Part, tuple[Floor, ...]]:
    """A part about a limb without components, with its floors."""
    assembly = load_text(text).assembly
    subject = of_limb(assembly, assembly.limbs[0])
    angles = tuple(dict(form) for form in subject.framed.ring.basis)
    bare = Part("limb", subject.framed.origin, angles, 3, (), limb="limb_1")
    found = PartDerivation(subject).with_floors(bare)
    assert found.told.floors == ()  # nothing asked for them
    return replace(bare, floors=found.floors), found.floors


def test_three_hinges_keep_two_freedoms_unless_they_are_one() -> None:
    part, (two, one) = floors(THREE)
    assert (two.rank, one.rank) == (2, 1)
    assert [{*own} for own in two.loci] == [{"x", "y", "u", "v"}]
    assert one.loci == ()
    check(certificate(THREE, part), load_text(THREE).mechanism, 3)


def test_links_that_have_lengths_keep_two_freedoms_everywhere() -> None:
    part, (two, _) = floors(LINKS)
    assert (two.rank, two.loci) == (2, ())
    check(certificate(LINKS, part), load_text(LINKS).mechanism, 3)
    source = np.random.default_rng(2)
    for q in source.uniform(-3, 3, 20):  # outstretched and folded
        for last in (1 + 2, 1 - 2):
            points = np.outer([0, 1, last], [np.cos(q), np.sin(q)])
            twists = [[1, y, -x] for x, y in points]
            assert np.linalg.matrix_rank(np.array(twists), tol=1e-9) == 2


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        ({"loci": ()}, "no component 0"),
        ({"loci": (("x", "y", "u", "v", "x - 1"),)}, "does not vanish"),
        ({"rank": 3}, "not of size 3"),
        ({"rank": 0}, "only limbs"),
        ({"proof": Node(0, sheet=True)}, "no sheets are known"),
        ({"proof": Node(0, component=0)}, "does not vanish"),
    ],
)
def test_false_floors_are_refused(changes: dict[str, object], why: str) -> None:
    part, (two, _) = floors(THREE)
    forged = replace(part, floors=(replace(two, **changes),))  # type: ignore[arg-type]
    with pytest.raises(RefusedError, match=why):
        check(certificate(THREE, forged), load_text(THREE).mechanism, 3)


def zero(*names: str) -> Locus:
    steps = tuple(Step("symbol", symbol=name, value="0") for name in names)
    return Locus(names, 0, 0, (Reach(steps),))


@pytest.mark.parametrize(
    ("locus", "equations", "whole"),
    [
        (zero("y"), ("x*y",), True),  # x = 0 may be the other component
        (zero("y", "u"), ("x*y",), False),  # it lies in y = 0
        (zero("y", "u"), ("x*y", "x*u"), True),  # x = 0, or y = u = 0
        (zero("y"), ("y^2",), False),  # not seen by derivatives
        (zero("x", "y"), ("x*v - y*u",), False),
    ],
)
def test_a_whole_part_lies_in_no_larger_one(
    locus: Locus, equations: tuple[str, ...], *, whole: bool
) -> None:
    part = Part("limb", "ground", (), 3, (), limb="limb_1")
    postures = Postures(load_text(THREE).mechanism, part, random.Random(1))
    point = next(postures.on(Way(locus.reach[0].steps)))
    other = Locus(equations, 2, 0, ())
    assert is_whole_part(postures, locus, other, point) is whole
