"""Ranks and wrenches of limbs in certificates: what follows from them, and lies."""

from __future__ import annotations

import random
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from certificates.forged import HEAD, certificate

from screwkit.case import load_text
from screwkit.certificates.checking import check
from screwkit.certificates.equations_told import Multiple
from screwkit.certificates.limb_claims import LimbClaims
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.products import Products
from screwkit.certificates.records import Case, Floor, Locus, Node, OfLimb, Part
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.texts import RefusedError

# Two limbs of two revolute joints each: at O and (x, y), at (c, 0) and (u, v).
FOUR_BAR = f"""{HEAD.replace("fore", "right")}
parameters: {{c: {{value: 1, positive: true}}}}
variables: {{x: 1, y: 2, u: 3, v: 4}}
joints:
  - {{name: a1, type: revolute, parent: ground, child: arm, point: [0, 0]}}
  - {{name: a2, type: revolute, parent: arm, child: tip, point: [x, y]}}
  - {{name: b1, type: revolute, parent: ground, child: right, point: [c, 0]}}
  - {{name: b2, type: revolute, parent: right, child: tip, point: [u, v]}}
"""
CONSTRAINT = Part("constraint", "ground", (), 3, ())
# The force along the line of a1 and a2, and what shows that these are two twists:
# columns (ω_z; v_x, v_y) = (1; 0, 0) and (1; y, -x).
FORCE = ("x", "y", "0", "0", "0", "0")
LEFT = OfLimb("limb_1", 2, (2, 3), ("a1", "a2"), wrenches=(FORCE,))
# b1 moves the point at the origin with (0, -c): the force does work -c·y.
WORK = Node(0, columns=("b1",), limbs=(LEFT,), over={})


def examined(node: Node, part: Part = CONSTRAINT, *parts: Part) -> LimbClaims:
    postures = Postures(load_text(FOUR_BAR).mechanism, part, random.Random(4))
    claims = LimbClaims(postures, ScrewMatrix(postures), parts)
    claims.check(node, Way())
    return claims


def test_the_rank_of_all_loops_is_read_from_limbs() -> None:
    """Both formulas of `limb_claims` agree with the loop matrix, written out."""
    source = np.random.default_rng(7)
    for _ in range(40):
        limbs = [
            source.integers(-3, 4, (6, k)) @ source.integers(-3, 4, (k, k + 1))
            for k in source.integers(1, 6, 3)
        ]
        zero = [np.zeros_like(limb) for limb in limbs]
        loops = np.block([[limbs[0], limbs[1], zero[2]], [limbs[0], zero[1], limbs[2]]])
        whole = np.linalg.matrix_rank(loops)
        ranks = [np.linalg.matrix_rank(limb) for limb in limbs]
        wrenches = [
            np.linalg.svd(t)[0][:, r:] for t, r in zip(limbs, ranks, strict=True)
        ]
        spanned = np.linalg.matrix_rank(np.hstack(wrenches))
        assert whole == sum(ranks) - 6 + spanned
        for k, twists in enumerate(limbs):
            rest = np.hstack([w for i, w in enumerate(wrenches) if i != k])
            work = np.linalg.matrix_rank(rest.T @ twists, tol=1e-9)
            assert whole == sum(ranks) - ranks[k] + work


def test_a_force_that_does_work_in_the_other_limb_bounds_the_rank() -> None:
    postures = Postures(load_text(FOUR_BAR).mechanism, CONSTRAINT, random.Random(4))
    matrix = ScrewMatrix(postures)
    products = Products(postures, matrix, examined(WORK))
    # The minor of the twists is y, the work c·y.
    cases = (Case(("y",), 2, end="positive"), Case(("c",), 1, end="positive"))
    products.check(replace(WORK, cases=cases), Way(), 3)
    with pytest.raises(RefusedError, match="product"):
        products.check(replace(WORK, cases=cases[:1]), Way(), 3)


SUM = Node(
    0,
    # All forces but those in the plane and all couples but the last do no work.
    rows=(0, 1, 2, 3, 4),
    limbs=(
        replace(
            LEFT,
            wrenches=(
                FORCE,
                ("0", "0", "1", "0", "0", "0"),
                ("0", "0", "0", "1", "0", "0"),
                ("0", "0", "0", "0", "1", "0"),
            ),
        ),
        OfLimb(
            "limb_2",
            2,
            (2, 4),
            ("b1", "b2"),
            wrenches=(("u - c", "v", "0", "0", "0", "c*v"),),
        ),
    ),
    over={},
)


def test_independent_wrenches_bound_the_rank() -> None:
    """2 + 2 − 6 + 5 = 3: two forces in the plane that are not parallel."""
    assert int(examined(SUM).product(SUM, a_point())) != 0


def a_point() -> Any:
    postures = Postures(load_text(FOUR_BAR).mechanism, CONSTRAINT, random.Random(4))
    return postures.several(Way())[0]


def changed(node: Node, **changes: Any) -> Node:
    """The node with another first limb."""
    return replace(node, limbs=(replace(node.limbs[0], **changes), *node.limbs[1:]))


@pytest.mark.parametrize(
    ("node", "why"),
    [
        (changed(WORK, wrenches=(("x", "y + 1", *FORCE[2:]),)), "does work in"),
        (changed(WORK, wrenches=(FORCE[:5],)), "six coordinates"),
        (changed(WORK, rows=(2,)), "another size"),
        (changed(WORK, rank=3), "another size"),
        (changed(WORK, rows=(2, 6)), "none of limb"),
        (changed(WORK, columns=("a1", "b1")), "none of limb"),
        (changed(WORK, columns=(), rows=()), "no part proves"),
        (changed(WORK, rank=-1, columns=(), rows=()), "no part proves"),
        (changed(WORK, fallen=(Node(1, component=0),)), "no reason"),
        (changed(WORK, limb="limb_3"), "none of the mechanism"),
        (changed(WORK, work=(Multiple(0, 0, "1", {}),)), "no condition"),
        (replace(WORK, limbs=(LEFT, LEFT)), "twice"),
        (replace(WORK, columns=("a1",)), "one limb that is left"),
        (replace(WORK, columns=("b1", "b2")), "work of 1"),
        (replace(WORK, rows=(0,)), "work of 1"),
        (replace(WORK, columns=(), rows=(0,)), "do not bound"),
        (replace(WORK, columns=(), rows=(6,)), "none of 1 wrenches"),
        (replace(changed(WORK, wrenches=()), columns=()), "do not bound"),
        (replace(SUM, rows=(0, 1, 2, 3)), "none of 5"),
        (
            replace(changed(SUM, wrenches=(FORCE,)), rows=(0, 1)),
            "do not bound",
        ),
    ],
)
def test_what_does_not_follow_from_limbs_is_refused(node: Node, why: str) -> None:
    with pytest.raises(RefusedError, match=why):
        examined(node)


def test_a_platform_is_held_by_six_wrenches_alone() -> None:
    """With a1 locked a2 does no work against forces through (x, y)."""
    held = replace(CONSTRAINT, question="actuation", locked=("a1",), rank=3)
    first = replace(SUM.limbs[0], rank=0, rows=(), columns=())
    second = replace(SUM.limbs[1], rank=0, rows=(), columns=())
    node = replace(SUM, limbs=(first, second))
    with pytest.raises(RefusedError, match="do not bound"):
        examined(node, held)
    another = ("1", "0", "0", "0", "0", "-y")
    six = replace(first, wrenches=(*first.wrenches, another))
    examined(replace(node, limbs=(six, second), rows=(0, 1, 2, 3, 4, 5)), held)


LIMB = Part(
    "limb",
    "ground",
    (),
    2,
    (Locus(("x", "y"), 1, -1, ()),),
    limb="limb_1",
    proof=Node(0),
)
BY_PART = changed(WORK, columns=(), rows=(), fallen=(Node(1, component=0),))


def test_a_limb_s_own_part_shows_its_rank() -> None:
    claims = examined(BY_PART, CONSTRAINT, LIMB)
    assert [*claims.fallen(BY_PART)] == [(("x", "y"), Node(1, component=0))]


@pytest.mark.parametrize(
    ("node", "part", "why"),
    [
        (changed(BY_PART, fallen=()), LIMB, "elsewhere"),
        (changed(BY_PART, rank=3), LIMB, "no part proves rank 3"),
        (changed(BY_PART, rank=1), LIMB, "no part proves rank 1"),
        (BY_PART, replace(LIMB, proof=None), "no part proves"),
        (BY_PART, replace(LIMB, limb="limb_2"), "no part proves"),
        (BY_PART, replace(LIMB, question="constraint"), "no part proves"),
        (BY_PART, replace(LIMB, form="loops"), "no part proves"),
    ],
)
def test_a_limb_s_own_part_shows_no_more_than_it_proves(
    node: Node, part: Part, why: str
) -> None:
    with pytest.raises(RefusedError, match=why):
        examined(node, CONSTRAINT, part)


FLOOR = Floor(1, (("c", "x"),), Node(0))
BY_FLOOR = changed(BY_PART, rank=1, fallen=(Node(1, component=0),))


def test_a_floor_shows_a_lower_rank() -> None:
    """Of forces and couples of both limbs five are independent: 1 + 2 - 6 + 5 = 2."""
    low = replace(CONSTRAINT, rank=2)
    node = replace(SUM, limbs=(*changed(SUM, **BY_SUM).limbs[:1], SUM.limbs[1]))
    claims = examined(node, low, replace(LIMB, floors=(FLOOR,)))
    assert [*claims.fallen(node)] == [(("c", "x"), Node(1, component=0))]
    more = replace(FLOOR, loci=(("c", "x"), ("y",)))
    with pytest.raises(RefusedError, match="elsewhere"):
        examined(node, low, replace(LIMB, floors=(more,)))
    with pytest.raises(RefusedError, match="no part proves rank 1"):
        examined(node, low, LIMB)


BY_SUM = {"rank": 1, "rows": (), "columns": (), "fallen": BY_FLOOR.limbs[0].fallen}


def test_loops_have_no_floor() -> None:
    part = replace(CONSTRAINT, floors=(FLOOR,))
    with pytest.raises(RefusedError, match="only limbs keep a rank"):
        check(certificate(FOUR_BAR, part), load_text(FOUR_BAR).mechanism, 1)


def test_a_part_about_all_joints_says_nothing_of_a_limb_with_locked_ones() -> None:
    held = replace(CONSTRAINT, question="actuation", locked=("a1",))
    with pytest.raises(RefusedError, match="no part proves"):
        examined(BY_PART, held, LIMB)


def test_limbs_say_nothing_of_a_limb() -> None:
    postures = Postures(load_text(FOUR_BAR).mechanism, LIMB, random.Random(4))
    claims = LimbClaims(postures, ScrewMatrix(postures), ())
    with pytest.raises(RefusedError, match="say nothing"):
        claims.check(WORK, Way())
