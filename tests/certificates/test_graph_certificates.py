"""Certificates by loop equations: limbs with loops inside, and any joint graph."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import islice
from pathlib import Path
from typing import Any

import pytest
from certificates import test_certificates as chains

import screwkit
from screwkit.algebra.constants import ConstantField
from screwkit.case import load_text
from screwkit.certificates.certification import certified_graph
from screwkit.certificates.checking import check
from screwkit.certificates.equations_told import Step
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.records import (
    Case,
    Certificate,
    Locus,
    Node,
    Part,
    Reach,
    Sheet,
    Source,
)
from screwkit.certificates.texts import RefusedError
from screwkit.certificates.written import SCHEMA, from_text, to_text
from screwkit.kinematics.exact_postures import ExactPosture
from screwkit.kinematics.network import Network, motion
from screwkit.kinematics.whole_graph import WholeGraph
from screwkit.mechanism.graph import limbs
from screwkit.verification import certificate_of, verify

PROVED = (
    "generic_k33",
    "generic_octahedron",
    "palletizer_scara",
    "scissor_chain3",
    "watt_six_bar",
    "stephenson_six_bar",
    "orthoglide",
)


@cache
def certificate(name: str) -> str:
    answer = screwkit.singularities(screwkit.load(name), certificate=True)
    assert answer.certificate is not None
    return answer.certificate


@pytest.mark.parametrize("name", PROVED)
def test_every_list_of_these_cases_is_proved_complete(
    name: str, tmp_path: Path
) -> None:
    path = tmp_path / "certificate.json"
    path.write_text(certificate(name), encoding="utf-8")
    found = verify(None, str(path), name)
    assert found.accepted, found.reason
    assert all(part.proved for part in found.parts)
    answer = screwkit.singularities(screwkit.load(name))
    listed = [limb.components for limb in answer.limb]
    listed.append(answer.constraint.components)
    if answer.actuation is not None and answer.actuation.admissible:
        listed.append(answer.actuation.components)
    written = from_text(certificate(name)).parts
    assert [[c.equations for c in own] for own in listed] == [
        [locus.equations for locus in part.components] for part in written
    ]
    assert to_text(from_text(certificate(name))) == certificate(name)


def test_smaller_minors_are_used_where_a_limb_allows_no_less() -> None:
    limb = json.loads(certificate("palletizer_scara"))["parts"][0]
    ranks = {node.get("rank", limb["rank"]) for node in chains.nodes(limb)}
    assert min(ranks) < limb["rank"]


def test_an_open_list_is_not_proved() -> None:
    case = screwkit.load("peaucellier")
    answer = screwkit.singularities(case)
    limb = tuple(replace(own, complete=False) for own in answer.limb)
    part = certificate_of(case, replace(answer, limb=limb)).parts[0]
    assert part.question == "limb"
    assert part.proof is None
    assert "gaps" in part.reason


@pytest.mark.parametrize("name", ["palletizer_scara", "watt_six_bar", "generic_k33"])
def test_a_list_without_one_of_its_components_has_no_proof(name: str) -> None:
    case = screwkit.load(name)
    answer = screwkit.singularities(case)
    constraint = replace(answer.constraint, components=answer.constraint.components[1:])
    limb = tuple(replace(own, components=own.components[1:]) for own in answer.limb)
    shorter = replace(answer, limb=limb, constraint=constraint)
    whole = from_text(certificate(name)).parts
    for part, full in zip(certificate_of(case, shorter).parts, whole, strict=True):
        if len(part.components) < len(full.components):
            assert part.proof is None
            assert part.reason


# -- forgeries -----------------------------------------------------------------------


FORGERIES = [
    chains.without_a_component,
    chains.without_a_case,
    chains.another_power,
    chains.a_case_called_positive,
    chains.a_case_called_special,
    chains.another_rank,
    chains.another_equation,
    chains.an_earlier_node_that_is_not,
    chains.other_columns,
    chains.a_proof_cut_off,
    chains.a_larger_locus,
]


@pytest.mark.parametrize("forge", FORGERIES)
def test_forgeries_are_refused(forge: Callable[[dict[str, Any]], None]) -> None:
    forged = 0
    for name in ("palletizer_scara", "watt_six_bar", "generic_k33"):
        document = json.loads(certificate(name))
        for number in range(len(document["parts"])):
            # Each part for itself, so that each question is forged.
            alone = json.loads(certificate(name))
            alone["parts"] = [alone["parts"][number]]
            try:
                forge(alone)
            except StopIteration:  # this proof has nothing of the kind
                continue
            forged += 1
            assert chains.refused(alone, name)
    assert forged > 2


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"form": ""}, "no serial chain"),
        ({"form": "rows"}, "no form"),
        ({"question": "constraint", "limb": ""}, ""),
        ({"limb": "limb_2"}, "no limb"),
    ],
)
def test_a_part_is_about_its_own_matrix(change: dict[str, str], why: str) -> None:
    document = json.loads(certificate("palletizer_scara"))
    document["parts"] = document["parts"][:1]
    document["parts"][0].update(change)
    assert why in chains.refused(document, "palletizer_scara")


def test_free_angles_are_no_closed_postures() -> None:
    """What is claimed where loops tie joint variables is looked at where they close."""
    text = BARS.replace("posture", "reference").replace("{x: 0.2, y: 1,", "{")
    text = text.replace("variables: { u: 1.3, v: 1.2}\n", "")
    text = text.replace("[x, y]", "[0, 1]").replace("[u, v]", "[2, 1]")
    mechanism = load_text(text).mechanism
    angles = tuple({f"q{name}": 1} for name in "ABCD")
    part = Part("constraint", mechanism.base, angles, 3, (), form="loops")
    with pytest.raises(RefusedError, match="no loop closes"):
        check(Certificate(SCHEMA, "", "0", Source(""), (part,)), mechanism, 1)


# -- proofs by hand ------------------------------------------------------------------


BARS = """
screwkit: 1
name: bars
space: planar
base: ground
platform: tip
links: [ground, left, right, coupler, tip]
geometry: posture
parameters: {d: {value: 1, positive: true}}
variables: {x: 0.2, y: 1, u: 1.3, v: 1.2}
joints:
  - {name: A, type: revolute, parent: ground, child: left, point: [0, 0]}
  - {name: B, type: revolute, parent: ground, child: right, point: [d, 0]}
  - {name: C, type: revolute, parent: left, child: coupler, point: [x, y]}
  - {name: D, type: revolute, parent: right, child: coupler, point: [u, v]}
  - {name: E, type: fixed, parent: coupler, child: tip}
"""


def bars(*components: Locus, proof: Node) -> Certificate:
    part = Part("constraint", "ground", (), 3, components, form="loops", proof=proof)
    return Certificate(SCHEMA, "bars", "0", Source(BARS), (part,))


def zero(name: str) -> Step:
    return Step("symbol", symbol=name, value="0", over="1")


# Four joints on one line: rank 2 of three rows, and the coupler turns about any point
# of it while its joints' rates are two more than the line allows.
FLAT = Locus(("y", "v"), 2, 2, (Reach((zero("y"), zero("v"))),))


def minor(number: int, third: str, coordinate: str, below: Node) -> Node:
    """Det [1 1 1; 0 0 −y; 0 −d −x] of A, B and a third joint is ±d·y."""
    return Node(
        number,
        rank=3,
        rows=(2, 3, 4),
        columns=("A", "B", third),
        over={},
        cases=(
            Case(("d",), 1, end="positive"),
            Case((coordinate,), 1, sheets=(Sheet(zero(coordinate), below),)),
        ),
    )


WHOLE = minor(0, "C", "y", minor(1, "D", "v", Node(2, component=0)))


def test_the_hand_made_proof_of_a_four_bar_is_accepted() -> None:
    check(bars(FLAT, proof=WHOLE), load_text(BARS).mechanism, 1)


@pytest.mark.parametrize(
    ("components", "proof", "why"),
    [
        # y = 0 alone is no component: D may be off the line.
        ((FLAT,), minor(0, "C", "y", Node(1, component=0)), "does not vanish"),
        ((FLAT,), minor(0, "C", "v", Node(1, component=0)), "product"),
        ((replace(FLAT, rank=1),), WHOLE, "rank"),
        ((replace(FLAT, freedom=3),), WHOLE, "freedoms"),
        ((replace(FLAT, equations=("y",), reach=(Reach((zero("y"),)),)),), WHOLE, "as"),
        ((), WHOLE, "component"),
    ],
)
def test_false_proofs_of_the_four_bar_are_refused(
    components: tuple[Locus, ...], proof: Node, why: str
) -> None:
    with pytest.raises(RefusedError, match=why):
        check(bars(*components, proof=proof), load_text(BARS).mechanism, 1)


# -- conditions in numbers -----------------------------------------------------------

TRIANGLE = """
screwkit: 1
name: triangle
space: planar
base: ground
platform: far
links: [ground, near, far]
geometry: posture
variables: {x: 5}
joints:
  - {name: A, type: revolute, parent: ground, child: near, point: [0, 0]}
  - {name: B, type: revolute, parent: near, child: far, point: [x, 1]}
  - {name: C, type: revolute, parent: far, child: ground, point: [PLACE, x - 1]}
"""


def triangle(place: int, tmp_path: Path) -> screwkit.Case:
    """Three joints, on one line where x·(x − 1) = place."""
    path = tmp_path / "triangle.yaml"
    path.write_text(TRIANGLE.replace("PLACE", str(place)), encoding="utf-8")
    return screwkit.load(path)


def test_what_no_real_posture_meets_is_not_listed(tmp_path: Path) -> None:
    """x² − x + 2 has the discriminant −7."""
    case = triangle(-2, tmp_path)
    constraint = screwkit.singularities(case).constraint
    assert constraint.complete
    assert not constraint.components


def test_irrational_postures_are_met_modulo_every_prime(tmp_path: Path) -> None:
    """x² − x − 3 has the discriminant 13, no square modulo every other prime."""
    case = triangle(3, tmp_path)
    answer = screwkit.singularities(case)
    assert [c.equations for c in answer.constraint.components] == [("x^2 - x - 3",)]
    graph = WholeGraph(case.mechanism)
    found = certified_graph(graph, answer, Source(""), "0")
    assert all(part.proof is not None for part in found.parts)
    for seed in range(12):
        check(found, case.mechanism, seed)


def test_sheets_of_special_dimensions_are_no_part_of_a_component() -> None:
    """At y = 1 the condition is (a − 1)(x − 1) = 0, and a is a dimension.

    At a = 1, y = 1 the rank is the generic one, at x = 1, y = 1 it is not: by joint
    rates.
    """
    lines = [
        "screwkit: 1",
        "name: drawn",
        "space: planar",
        "base: b0",
        "platform: b5",
        "links: [b0, b1, b2, b3, b4, b5]",
        "parameters: {a: {value: 2, positive: true}}",
        "geometry: posture",
        "variables: {x: 1, y: 2}",
        "joints:",
    ]
    joints = (
        ("0", "1", "point: [y, x]"),
        ("1", "2", "point: [a, -2]"),
        ("1", "3", "axis: [1, y]"),
        ("1", "4", "point: [0, x]"),
        ("3", "5", "point: [a, 0]"),
        ("0", "2", "point: [1, y]"),
        ("0", "3", "point: [1, y]"),
        ("3", "4", "point: [1, 0]"),
    )
    for number, (parent, child, place) in enumerate(joints):
        kind = "prismatic" if "axis" in place else "revolute"
        lines.append(
            f"  - {{name: j{number}, type: {kind}, parent: b{parent}, "
            f"child: b{child}, {place}}}"
        )
    case = load_text("\n".join(lines) + "\n")
    answer = screwkit.singularities(case)
    assert len(answer.constraint.components) == 1
    graph = WholeGraph(case.mechanism)
    found = certified_graph(graph, answer, Source(""), "0")
    assert all(part.proof is not None for part in found.parts)
    check(found, case.mechanism, 3)
    special = Network(load_text(text_at(lines, a=1, y=1)).mechanism)
    assert special.motion.rank == answer.constraint.generic_rank
    singular = Network(load_text(text_at(lines, x=1, y=1)).mechanism)
    assert singular.motion.rank < answer.constraint.generic_rank


def text_at(lines: list[str], **values: int) -> str:
    """A mechanism with numbers for some of its symbols; others stay."""
    text = "\n".join(lines) + "\n"
    for name, number in values.items():
        for before, after in (("[", ","), (" ", "]"), ("[", "]")):
            text = text.replace(f"{before}{name}{after}", f"{before}{number}{after}")
    return text


# -- a limb by its loop equations ----------------------------------------------------


def arm(proof: Node, *components: Locus) -> Certificate:
    whole = chains.arm_certificate(proof, *components)
    part = replace(whole.parts[0], form="loops")
    return replace(whole, parts=(part,))


STRAIGHT = replace(chains.STRAIGHT, freedom=2)


def test_a_chain_is_a_limb_without_loops() -> None:
    proof = chains.arm_proof(*chains.FACTORS)
    check(arm(proof, STRAIGHT), chains.arm_mechanism(), 1)
    with pytest.raises(RefusedError, match="freedoms"):
        check(arm(proof, chains.STRAIGHT), chains.arm_mechanism(), 1)


def test_a_smaller_minor_does_not_show_that_a_limb_allows_no_less() -> None:
    """Straight, the arm allows two freedoms; a minor of size 2 must not hide that."""
    sheets = tuple(
        Sheet(
            sheet.step,
            Node(
                k + 1,
                rank=2,
                rows=(2, 4),
                columns=("1", "2"),
                over={},
                cases=(Case(("a",), 1, end="positive"),),
            ),
        )
        for k, sheet in enumerate(chains.SHEETS)
    )
    proof = chains.arm_proof(*chains.FACTORS[:2], Case(("sin(q)",), 1, sheets=sheets))
    with pytest.raises(RefusedError, match="allow less"):
        check(arm(proof), chains.arm_mechanism(), 1)


def test_loops_outside_limbs_are_not_passed_over() -> None:
    """A part by limbs would miss the loop that hangs on the base alone."""
    lines = BARS.replace("platform: tip", "platform: left").replace(
        "parent: coupler, child: tip", "parent: ground, child: tip"
    )
    extra = "  - {name: F, type: fixed, parent: ground, child: tip}\n"
    mechanism = load_text(lines + extra).mechanism
    part = Part("constraint", "ground", (), 3, ())
    with pytest.raises(RefusedError, match="other loops"):
        check(Certificate(SCHEMA, "bars", "0", Source(""), (part,)), mechanism, 1)


# -- the matrix ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "question"),
    [
        ("palletizer_scara", "constraint"),
        ("palletizer_scara", "actuation"),
        ("watt_six_bar", "actuation"),
        ("stephenson_six_bar", "limb"),
        ("h4", "limb"),
        ("delta_ss", "actuation"),
    ],
)
def test_ranks_are_those_of_the_motions_of_the_graph(name: str, question: str) -> None:
    """A second route: joint rates that close all loops, and what the platform feels."""
    mechanism = screwkit.load(name).mechanism
    written = claims_of(name, question)
    network = Network(mechanism)
    if question == "limb":
        limb = next(own for own in limbs(mechanism) if own.name == written.limb)
        network = network.part(limb.joints, (mechanism.base, mechanism.platform))
    postures = Postures(mechanism, written, random.Random(9))
    matrix = GraphMatrix(postures)
    for point in islice(postures.on(Way()), 2):
        twists = {k: tuple(map(int, t)) for k, t in matrix.twists(point).items()}
        posture = ExactPosture(twists, postures.prime, {}, ConstantField((), 0))
        found = motion(network, posture, written.locked)
        freedom = len(found.platform_twists)
        assert matrix.freedom(point) == freedom
        assert matrix.loop_rank(point) == found.rank
        assert matrix.rank(point) == found.rank + (freedom if question == "limb" else 0)


def claims_of(name: str, question: str) -> Part:
    """A part without claims."""
    graph = WholeGraph(screwkit.load(name).mechanism)
    mechanism = graph.mechanism
    own = graph.limbs[0] if question == "limb" else graph
    return Part(
        question,
        mechanism.base,
        tuple(dict(form) for form in own.framed.ring.basis),
        0,
        (),
        form="loops",
        limb=limbs(mechanism)[0].name if question == "limb" else "",
        locked=tuple(mechanism.actuated) if question == "actuation" else (),
    )
