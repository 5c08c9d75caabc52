"""Limbs with loops inside in certificates: ranks, wrenches with reactions, lies."""

from __future__ import annotations

import random
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from certificates.forged import HEAD, certificate
from loci.numeric import value

import screwkit
from screwkit.algebra.points import residue
from screwkit.case import load_text
from screwkit.certificates.checking import check
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.limb_claims import LimbClaims
from screwkit.certificates.loop_equations import LoopEquations
from screwkit.certificates.looped_limbs import wrenches_with_reactions
from screwkit.certificates.part_derivation import PartDerivation
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import Node, OfLimb, Part
from screwkit.certificates.subjects import of_graph
from screwkit.certificates.texts import RefusedError
from screwkit.certificates.written import from_text
from screwkit.kinematics.whole_graph import WholeGraph
from screwkit.results.singularities import (
    ActuationSingularities,
    Component,
    ConstraintSingularities,
    LimbSingularities,
    Singularities,
)
from screwkit.verification import certificate_of

# Left: an arm, and a loop of four hinges between arm and tip.  Right: two hinges.
LINKAGE = f"""{HEAD.replace("arm, fore", "arm, one, two, right")}
variables: {{x: 1, y: 2, u: 3, v: 4, p: 5, q: 7, r: 2, s: 9, g: 4, h: 6}}
joints:
  - {{name: a, type: revolute, parent: ground, child: arm, point: [0, 0]}}
  - {{name: b, type: revolute, parent: arm, child: one, point: [x, y]}}
  - {{name: c, type: revolute, parent: one, child: tip, point: [u, v]}}
  - {{name: d, type: revolute, parent: arm, child: two, point: [p, q]}}
  - {{name: e, type: revolute, parent: two, child: tip, point: [r, s]}}
  - {{name: f, type: revolute, parent: ground, child: right, point: [1, 0]}}
  - {{name: g, type: revolute, parent: right, child: tip, point: [g, h]}}
"""
CONSTRAINT = Part("constraint", "ground", (), 6, (), form="loops")


def left_null(matrix: Any) -> Any:
    """Rows that annihilate all columns."""
    vectors, values, _ = np.linalg.svd(matrix)
    rank = int((values > 1e-9).sum())
    return vectors[:, rank:].T


def test_the_rank_of_all_loops_is_read_from_limbs_with_loops() -> None:
    """Σ rank [P; C] − 6 + dim Σ W agrees with the loop matrix, written out."""
    source = np.random.default_rng(7)
    for _ in range(40):
        limbs = []
        for _ in range(3):
            width, loops = source.integers(2, 9), source.integers(0, 2)
            inner = source.integers(-2, 3, (6 * loops, 3)) @ source.integers(
                -2, 3, (3, width)
            )
            way = source.integers(-2, 3, (6, 4)) @ source.integers(-2, 3, (4, width))
            limbs.append((way, inner))
        first = limbs[0][0]
        blocks = []
        for number, (_, inner) in enumerate(limbs):
            row: list[Any] = [np.zeros((len(inner), w.shape[1])) for w, _ in limbs]
            row[number] = inner
            blocks.append(row)
        for number in (1, 2):
            row = [np.zeros((6, w.shape[1])) for w, _ in limbs]
            row[0], row[number] = first, -limbs[number][0]
            blocks.append(row)
        whole = np.linalg.matrix_rank(np.vstack([np.hstack(row) for row in blocks]))
        stacked = [np.vstack(own) for own in limbs]
        ranks = [np.linalg.matrix_rank(own) for own in stacked]
        wrenches = np.vstack([left_null(own)[:, :6] for own in stacked])
        spanned = np.linalg.matrix_rank(wrenches, tol=1e-9)
        assert whole == sum(ranks) - 6 + spanned


def graph() -> WholeGraph:
    return WholeGraph(load_text(LINKAGE).mechanism)


def test_wrenches_with_reactions_annihilate_and_span() -> None:
    """What the left limb allows: it turns about a, and about where the rods meet."""
    own = graph()
    labels, rows, height = own.limbs[0].led_equations()
    assert (labels, height) == (("a", "b", "c", "d", "e"), 12)
    branch = own.limbs[0].root
    zero = branch.ring.zero
    columns = [
        tuple(rows.get(place, {}).get(k, zero) for place in range(height))
        for k in range(len(labels))
    ]
    at = branch.points[0]
    found = wrenches_with_reactions(branch, columns, at, own.limbs[0].library)
    for vector in found:
        for column in columns:
            products = (a * b for a, b in zip(vector, column, strict=True))
            assert branch.value(sum(products, zero)) == 0
    # One force in the plane: through a and that point; and what is out of the plane.
    point, prime = at
    spanned = [[residue(x, point, prime) for x in own[:6]] for own in found]
    assert rank_modulo(spanned, prime) == 6 - 2


def rank_modulo(rows: list[list[int]], prime: int) -> int:
    rows, rank = [list(row) for row in rows], 0
    for column in range(6):
        pivot = next((r for r in rows[rank:] if r[column] % prime), None)
        if pivot is None:
            continue
        rows.remove(pivot)
        rows.insert(rank, pivot)
        inverse = pow(pivot[column], -1, prime)
        rank += 1
        for row in rows[rank:]:
            factor = row[column] * inverse % prime
            row[:] = [(a - factor * b) % prime for a, b in zip(row, pivot, strict=True)]
    return rank


# A force along the rod from b to c, which the loop of the rods takes up in the rod:
# the way to the platform leads over it.
ROD = ("u - x", "v - y", "0", "0", "0", "x*v - y*u")
NONE = ("0",) * 6


def examined(node: Node, part: Part = CONSTRAINT, text: str = LINKAGE) -> LimbClaims:
    postures = Postures(load_text(text).mechanism, part, random.Random(4))
    claims = LimbClaims(postures, GraphMatrix(postures), ())
    claims.check(node, Way())
    return claims


def of_force(force: tuple[str, ...], reaction: tuple[str, ...], *rest: str) -> Node:
    """One wrench of the left limb, with its reaction, against a minor of size 1."""
    limb = OfLimb("limb_1", wrenches=((*force, *reaction, *rest),))
    return Node(0, rows=(2,), limbs=(limb,), over={})


OUT = ("0", "0", "1", "0", "0", "0")


@pytest.mark.parametrize(
    ("node", "why"),
    [
        # A rod's force does work in a, the arm's own hinge.
        (of_force(ROD, NONE), "does work in limb limb_1"),
        (of_force(OUT, ROD), "does work in limb limb_1"),
        (of_force(OUT, NONE[:5]), "six coordinates"),
        (of_force(OUT, NONE, "0"), "six coordinates"),
        (of_force(OUT, ()), "six coordinates"),
        (of_force(OUT, NONE), "do not bound"),
    ],
)
def test_a_wrench_that_does_work_is_refused(node: Node, why: str) -> None:
    low = CONSTRAINT if why == "do not bound" else replace(CONSTRAINT, rank=-5)
    with pytest.raises(RefusedError, match=why):
        examined(node, low)


def test_a_wrench_out_of_the_plane_does_no_work() -> None:
    examined(of_force(OUT, NONE), replace(CONSTRAINT, rank=-5))


def test_with_a_locked_the_rod_s_force_does_no_work() -> None:
    """Whatever the reaction: the rod carries it alone, the other one nothing."""
    held = Part("actuation", "ground", (), -1, (), form="loops", locked=("a",))
    claims = examined(of_force(ROD, NONE), held)
    point = a_point(held)
    assert int(claims.product(of_force(ROD, NONE), point)) == 0  # no force along z
    lean = replace(of_force(ROD, NONE), rows=(0,))
    known = int(point.symbol("u")) - int(point.symbol("x"))
    assert int(claims.product(lean, point)) == known % claims_prime(held)


def a_point(part: Part) -> Any:
    postures = Postures(load_text(LINKAGE).mechanism, part, random.Random(4))
    return postures.several(Way())[0]


def claims_prime(part: Part) -> int:
    return Postures(load_text(LINKAGE).mechanism, part, random.Random(4)).prime


def test_limbs_say_nothing_where_joints_belong_to_none() -> None:
    """A pendulum hangs on the tip."""
    text = LINKAGE.replace("tip]", "tip, tail]")
    text += "  - {name: t, type: revolute, parent: tip, child: tail, point: [0, 1]}\n"
    with pytest.raises(RefusedError, match="say nothing"):
        examined(of_force(OUT, NONE), replace(CONSTRAINT, rank=-5), text)


# A parallelogram of rods between arm and tip, a distance k apart.
PARALLELOGRAM = f"""{HEAD.replace("arm, fore", "arm, one, two")}
parameters:
  l: {{value: 1, positive: true}}
  k: {{value: 2, positive: true}}
variables: {{u: 3, v: 4}}
joints:
  - {{name: a, type: revolute, parent: ground, child: arm, point: [0, 0]}}
  - {{name: b, type: revolute, parent: arm, child: one, point: [l, 0]}}
  - {{name: c, type: revolute, parent: one, child: tip, point: [u, v]}}
  - {{name: d, type: revolute, parent: arm, child: two, point: [l, k]}}
  - {{name: e, type: revolute, parent: two, child: tip, point: [u, v + k]}}
"""


@cache
def floors() -> Part:
    """The part about the limb, with what rank it keeps."""
    own = WholeGraph(load_text(PARALLELOGRAM).mechanism)
    subject = of_graph(own, own.limbs[0], LoopEquations.of(own, asks_held=True))
    bare = Part("limb", "ground", (), 5, (), form="loops", limb="limb_1")
    found = PartDerivation(subject).with_floors(bare)
    return replace(bare, floors=found.floors)


def test_a_limb_keeps_its_rank_unless_its_rods_have_no_length() -> None:
    """With the tip held nothing moves then, not even in a flat parallelogram."""
    part = floors()
    no_length = {"l - u", "v"}
    assert [floor.rank for floor in part.floors] == [5, 4, 3]
    assert [[{*e} for e in floor.loci] for floor in part.floors] == [
        [no_length],
        [no_length],
        [],
    ]
    for u, v, rank in ((3, 4, 5), (1, 4, 5), (0, 3, 5), (1, 0, 3)):
        places = ((0, 0), (1, 0), (u, v), (1, 2), (u, v + 2))
        a, b, c, d, e = (np.array([1.0, y, -x]) for x, y in places)
        zero = np.zeros(3)
        columns = [[*a, *zero], [*b, *b], [*c, *c], [*zero, *-d], [*zero, *-e]]
        assert np.linalg.matrix_rank(np.array(columns), tol=1e-9) == rank
    check(certificate(PARALLELOGRAM, part), load_text(PARALLELOGRAM).mechanism, 3)


@pytest.mark.parametrize(
    "lie",
    [{"loci": ()}, {"loci": (("l - u", "u - v"),)}, {"rank": 6}, {"rank": 4}],
)
def test_floors_that_are_not_so_are_refused(lie: dict[str, Any]) -> None:
    first, *others = floors().floors
    forged = replace(floors(), floors=(replace(first, **lie), *others))
    with pytest.raises(RefusedError):
        check(certificate(PARALLELOGRAM, forged), load_text(PARALLELOGRAM).mechanism, 3)


def test_forces_and_couples_of_parallelograms_prove_a_list() -> None:
    """Three arms with parallelograms: their loops take up what couples do to rods."""
    answer = screwkit.singularities(screwkit.load("orthoglide"), certificate=True)
    assert answer.certificate is not None
    constraint = from_text(answer.certificate).parts[3]
    assert constraint.question == "constraint"
    assert constraint.proof is not None
    said = [own for node in every(constraint.proof) for own in node.limbs]
    assert {own.rank for own in said} >= {7}
    lengths = {len(wrench) for own in said for wrench in own.wrenches}
    assert lengths == {12}
    assert any({*wrench[6:]} != {"0"} for own in said for wrench in own.wrenches)


def every(proof: Node) -> list[Node]:
    """All nodes of a proof."""
    return [proof, *(node for below in proof.below for node in every(below))]


def rod(angle: str, across: str, up: str) -> tuple[str, str, str]:
    """From an arm's end to the platform, along two horizontal axes and up."""
    reach = f"(b - a - l*cos({angle}))"
    along = f"x + {reach}*({across})" if across != "1" else f"x + {reach}"
    return along, f"y + {reach}*({up})", f"z + l*sin({angle})"


def by_hand() -> Singularities:
    """Three arms with parallelograms: where they stretch; where rods are coplanar."""
    one = rod("theta1", "1", "0")
    two = rod("theta2", "-1/2", "sqrt(3)/2")
    three = rod("theta3", "-1/2", "-sqrt(3)/2")
    volume = " ".join(
        f"{sign} ({one[i]})*({two[j]})*({three[k]})"
        for sign, (i, j, k) in zip(
            "+-+-+-",
            ((0, 1, 2), (0, 2, 1), (1, 2, 0), (1, 0, 2), (2, 0, 1), (2, 1, 0)),
            strict=True,
        )
    )
    stretched = (
        "(a - b - x)*sin(theta1) - z*cos(theta1)",
        "(2*a - 2*b + x - sqrt(3)*y)*sin(theta2) - 2*z*cos(theta2)",
        "(2*a - 2*b + x + sqrt(3)*y)*sin(theta3) - 2*z*cos(theta3)",
    )
    limbs = []
    for number, equation in enumerate(stretched, 1):
        names = [f"{j}{number}" for j in "AEB"]
        names[2:2] = [f"{j}_{number}" for j in ("p1", "m1", "p2", "m2")]
        component = Component((equation,), 1, (), 6)
        limbs.append(
            LimbSingularities(f"limb{number}", tuple(names), 7, True, (component,))
        )
    dependent = Component((volume[2:],), 1, (), 17)
    return Singularities(
        "delta_4r",
        "",
        tuple(limbs),
        ConstraintSingularities(18, False, ()),
        ActuationSingularities(("A1", "A2", "A3"), True, 18, True, (dependent,)),
    )


def test_couples_that_stand_still_spare_cases_of_each_parallelogram() -> None:
    """The normal n of a parallelogram turns; |n|² times a horizontal couple does not.

    So one minor is |n|² (…) times the volume of the three rods: nothing is left where
    a rod is level, or n is.
    """
    case = screwkit.load("delta_4r")
    actuation = certificate_of(case, by_hand()).parts[-1]
    assert actuation.question == "actuation"
    assert actuation.reason == ""
    assert actuation.proof is not None
    assert len([node for node in actuation.proof.every if node.axis]) == 2
    assert len(actuation.proof.every) == 4
    lines = [w for own in actuation.proof.limbs for w in own.wrenches]
    couples = [w for w in lines if {*w[:3]} == {"0"}]
    still = [w for w in couples if [*w[3:6]].count("0") == 2 or w[5] == "0"]
    assert len(couples) == 3
    assert len(still) >= 2
    source = np.random.default_rng(3)
    for own in actuation.proof.limbs:
        for wrench in own.wrenches:
            if wrench in still:
                ratios = [ratio(own.limb, wrench[3:6], source) for _ in range(4)]
                assert ratios[0] > 1e-6
                assert np.allclose(ratios, ratios[0])


def ratio(limb: str, couple: tuple[str, ...], source: np.random.Generator) -> float:
    """Of a couple and c times the squared axis of a parallelogram, at some posture."""
    names = ("a", "b", "c", "l", "x", "y", "z", "theta1", "theta2", "theta3")
    at = dict(zip(names, source.uniform(0.3, 2, len(names)), strict=True))
    turn = {"limb1": 0, "limb2": 120, "limb3": 240}[limb]
    outward = np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn)), 0])
    up = np.array([0, 0, 1])
    angle = at[f"theta{limb[-1]}"]
    arm = (at["a"] + at["l"] * np.cos(angle)) * outward - at["l"] * np.sin(angle) * up
    tip = np.array([at["x"], at["y"], at["z"]]) + at["b"] * outward
    normal = np.cross(np.cross(up, outward), tip - arm)
    size = np.linalg.norm([value(x, at) for x in couple])
    return float(size / (at["c"] * normal @ normal))
