"""Certificates: proofs that hold are accepted, and nothing else is."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest

import screwkit
from screwkit.algebra.expression_building import symbols_of
from screwkit.case import find, load_text
from screwkit.certificates.checking import check
from screwkit.certificates.equations_told import Step
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
from screwkit.certificates.texts import RefusedError, read
from screwkit.certificates.written import SCHEMA, MalformedError, from_text, to_text
from screwkit.verification import CertificateError, verify

PROVED = (
    "3rpr_planar",
    "five_bar_15",
    "spherical_3rrr",
    "agile_eye",
    "3upu_tsai",
    "generic_6r",
    "scara_pair_hard",
    "dual_planar_arm",
    "gough_6ups",
    "exechon",
    "2upr_rpu",
    "rssr",
    "4H_equal_pitch",
    "3prs",
    "gough_33_octahedral",
    "gough_6sps",
    "tricept",
    "3upu_wrist",
)


@cache
def certificate(name: str) -> str:
    answer = screwkit.singularities(screwkit.load(name), certificate=True)
    assert answer.certificate is not None
    return answer.certificate


def refused(document: dict[str, Any], name: str) -> str:
    """Why a document is refused."""
    try:
        found = from_text(json.dumps(document))
    except MalformedError as error:
        return str(error)
    with pytest.raises(RefusedError) as caught:
        check(found, screwkit.load(name).mechanism, 7)
    return str(caught.value)


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
    if len(answer.limb) > 1:
        listed.append(answer.constraint.components)
        if answer.actuation is not None and answer.actuation.admissible:
            listed.append(answer.actuation.components)
    written = from_text(certificate(name)).parts
    assert [[c.equations for c in own] for own in listed] == [
        [locus.equations for locus in part.components] for part in written
    ]


def test_what_a_certificate_leaves_out_is_named(tmp_path: Path) -> None:
    document = json.loads(certificate("3rpr_planar"))
    path = tmp_path / "certificate.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    assert verify(None, str(path)).missing == ()
    (rested,) = (p["proof"] for p in document["parts"] if p["question"] == "constraint")
    needed = {own["limb"] for own in rested["limbs"]}
    (spare,) = {"leg1", "leg2", "leg3"} - needed
    document["parts"] = [
        part
        for part in document["parts"]
        if part["question"] != "actuation" and part.get("limb") != spare
    ]
    path.write_text(json.dumps(document), encoding="utf-8")
    found = verify(None, str(path))
    assert found.accepted
    assert found.missing == (f"limb {spare}", "actuation")
    assert "every list is complete" not in str(found)
    # What the proof of the constraints rests on cannot be left out.
    document["parts"] = [p for p in document["parts"] if p.get("limb") not in needed]
    path.write_text(json.dumps(document), encoding="utf-8")
    assert "no part proves" in verify(None, str(path)).reason


def test_a_mechanism_without_limbs_has_nothing_to_prove() -> None:
    check(from_text(certificate("lone_body")), screwkit.load("lone_body").mechanism, 1)
    nothing = from_text(certificate("lone_body"))
    with pytest.raises(RefusedError, match="claims nothing"):
        check(nothing, screwkit.load("3rpr_planar").mechanism, 1)


def test_reading_gives_back_what_was_written() -> None:
    text = certificate("agile_eye")
    assert to_text(from_text(text)) == text


# -- forgeries -----------------------------------------------------------------------


def nodes(part: dict[str, Any]) -> Iterator[dict[str, Any]]:
    waiting = [part["proof"]]
    while waiting:
        node = waiting.pop()
        yield node
        for case in node.get("cases", ()):
            waiting += [sheet["node"] for sheet in case.get("sheets", ())]
            waiting += [case["kept"]] if "kept" in case else []
        waiting += [n for own in node.get("limbs", ()) for n in own.get("fallen", ())]


def every_case(document: dict[str, Any]) -> Iterator[dict[str, Any]]:
    for part in document["parts"]:
        for node in nodes(part):
            yield from node.get("cases", ())


def without_a_component(document: dict[str, Any]) -> None:
    part = next(p for p in document["parts"] if p["components"])
    del part["components"][0]


def without_a_case(document: dict[str, Any]) -> None:
    first = next(n for p in document["parts"] for n in nodes(p) if n.get("cases"))
    del first["cases"][0]


def without_a_sheet(document: dict[str, Any]) -> None:
    sheets = next(
        c["sheets"] for c in every_case(document) if len(c.get("sheets", ())) > 1
    )
    del sheets[1]


def another_power(document: dict[str, Any]) -> None:
    next(every_case(document))["power"] += 1


def a_case_called_positive(document: dict[str, Any]) -> None:
    case = next(c for c in every_case(document) if "sheets" in c or "kept" in c)
    case.pop("sheets", None)
    case.pop("kept", None)
    case["end"] = "positive"


def a_case_called_special(document: dict[str, Any]) -> None:
    case = next(c for c in every_case(document) if "sheets" in c or "kept" in c)
    case.pop("sheets", None)
    case.pop("kept", None)
    case["end"] = "special"


def another_rank(document: dict[str, Any]) -> None:
    document["parts"][0]["rank"] -= 1


def another_equation(document: dict[str, Any]) -> None:
    part = next(p for p in document["parts"] if p["components"])
    part["components"][0]["equations"][0] += " + 1"


def an_earlier_node_that_is_not(document: dict[str, Any]) -> None:
    leaf = next(n for p in document["parts"] for n in nodes(p) if "component" in n)
    del leaf["component"]
    leaf["earlier"] = 0


def other_columns(document: dict[str, Any]) -> None:
    node = next(n for p in document["parts"] for n in nodes(p) if n.get("columns"))
    node["columns"] = [node["columns"][0]] * len(node["columns"])


def a_proof_cut_off(document: dict[str, Any]) -> None:
    node = next(n for p in document["parts"] for n in nodes(p) if n.get("cases"))
    node["cases"] = []


def a_sum(document: dict[str, Any]) -> dict[str, Any]:
    found = (n for p in document["parts"] for n in nodes(p) if n.get("combination"))
    return next(found)


def a_sum_without_a_term(document: dict[str, Any]) -> None:
    del a_sum(document)["combination"][0]


def a_sum_of_other_multiples(document: dict[str, Any]) -> None:
    a_sum(document)["combination"][0]["times"] += " + 1"


def a_sum_of_other_conditions(document: dict[str, Any]) -> None:
    term = a_sum(document)["combination"][0]
    term["condition"] = 1 - min(term["condition"], 1)


def a_sum_without_a_case(document: dict[str, Any]) -> None:
    del a_sum(document)["cases"][-1]


def a_case_called_elsewhere(document: dict[str, Any]) -> None:
    case = next(c for c in every_case(document) if "sheets" in c or "kept" in c)
    case.pop("sheets", None)
    case.pop("kept", None)
    case.update(end="elsewhere", angle=0, numbers=["1", "0", "-2"])


def a_larger_locus(document: dict[str, Any]) -> None:
    part = next(p for p in document["parts"] if p["components"])
    part["components"].append(part["components"][0])


@pytest.mark.parametrize(
    "forge",
    [
        without_a_component,
        without_a_case,
        without_a_sheet,
        another_power,
        a_case_called_positive,
        a_case_called_special,
        another_rank,
        another_equation,
        an_earlier_node_that_is_not,
        other_columns,
        a_proof_cut_off,
        a_sum_without_a_term,
        a_sum_of_other_multiples,
        a_sum_of_other_conditions,
        a_sum_without_a_case,
        a_case_called_elsewhere,
        a_larger_locus,
    ],
)
def test_forgeries_are_refused(forge: Callable[[dict[str, Any]], None]) -> None:
    forged = 0
    for name in (
        "spherical_3rrr",
        "dual_planar_arm",
        "3upu_tsai",
        "4H_equal_pitch",
    ):
        document = json.loads(certificate(name))
        try:
            forge(document)
        except StopIteration:  # this proof has nothing of the kind
            continue
        forged += 1
        assert refused(document, name)
    assert forged


def test_a_certificate_is_about_one_mechanism(tmp_path: Path) -> None:
    path = tmp_path / "certificate.json"
    path.write_text(certificate("3rpr_planar"), encoding="utf-8")
    assert not verify(None, str(path), "five_bar_15").accepted
    case = tmp_path / "case.yaml"
    own = find("3rpr_planar").read_text("utf-8")
    for written, accepted in (
        (own, True),
        (f"# The same mechanism in another text.\n{own}", True),
        (own.replace("[a2, 0", "[2*a2, 0", 1), False),
    ):
        case.write_text(written, "utf-8")
        assert verify(None, str(path), str(case)).accepted == accepted
    document = json.loads(certificate("3rpr_planar"))
    text = document["mechanism"]["text"]
    # Another base point of a leg: the conditions are no longer those of the file.
    document["mechanism"]["text"] = text.replace("[a2, 0", "[2*a2, 0", 1)
    assert document["mechanism"]["text"] != text
    path.write_text(json.dumps(document), encoding="utf-8")
    assert not verify(None, str(path)).accepted


@pytest.mark.parametrize(
    "change",
    [
        lambda d: d.pop("schema"),
        lambda d: d.update(extra=1),
        lambda d: d["parts"][0].update(rank="3"),
        lambda d: d["parts"][0].update(rank=True),
        lambda d: d["parts"][0].pop("angles"),
        lambda d: d.update(parts=3),
    ],
)
def test_documents_of_another_shape_are_none(change: Callable[[Any], None]) -> None:
    document = json.loads(certificate("3rpr_planar"))
    change(document)
    with pytest.raises(MalformedError):
        from_text(json.dumps(document))


def test_files_that_are_no_certificates_are_refused_by_name(tmp_path: Path) -> None:
    path = tmp_path / "c.json"
    with pytest.raises(CertificateError, match=r"c\.json"):
        verify(None, str(path))
    path.write_bytes(b"\xff\xfe")
    with pytest.raises(CertificateError, match="UTF-8"):
        verify(None, str(path))
    path.write_text("[" * 100_000, encoding="utf-8")
    with pytest.raises(CertificateError, match="JSON"):
        verify(None, str(path))


# -- a proof by hand -----------------------------------------------------------------

ARM = """
screwkit: 1
name: arm
space: planar
base: ground
platform: tip
links: [ground, arm, fore, tip]
geometry: posture
parameters: {a: {value: 1, positive: true}, b: {value: 1, positive: true}}
variables:
  q: {value: 0.3, angle: true}
joints:
  - {name: "1", type: revolute, parent: ground, child: arm, point: [0, 0]}
  - {name: "2", type: revolute, parent: arm, child: fore, point: [a, 0]}
  - name: "3"
    type: revolute
    parent: fore
    child: tip
    point: [a + b*cos(q), b*sin(q)]
"""


def arm_certificate(proof: Node, *components: Locus) -> Certificate:
    part = Part(
        "limb", "ground", ({"q": 1},), 3, components, limb="limb_1", proof=proof
    )
    return Certificate(SCHEMA, "arm", "0", Source(ARM), (part,))


def turned(sine: str, cosine: str) -> Step:
    return Step("angle", angle=0, sine=sine, cosine=cosine)


STRAIGHT = Locus(
    ("sin(q)",), 2, -1, (Reach((turned("0", "1"),)), Reach((turned("0", "-1"),)))
)
# det [[1 1 1], [0 0 y], [0 -a -x]] = a·y with y = b·sin(q): rows ωz, vx, vy.
SHEETS = (
    Sheet(turned("0", "1"), Node(1, component=0)),
    Sheet(turned("0", "-1"), Node(2, component=0)),
)
FACTORS = (
    Case(("a",), 1, end="positive"),
    Case(("b",), 1, end="positive"),
    Case(("sin(q)",), 1, sheets=SHEETS),
)


def arm_proof(*cases: Case) -> Node:
    return Node(
        0, rank=3, rows=(2, 3, 4), columns=("1", "2", "3"), over={}, cases=cases
    )


def arm_mechanism() -> Any:
    return load_text(ARM).mechanism


def test_the_hand_made_proof_of_an_arm_is_accepted() -> None:
    check(arm_certificate(arm_proof(*FACTORS), STRAIGHT), arm_mechanism(), 1)


@pytest.mark.parametrize(
    ("proof", "components", "why"),
    [
        (arm_proof(*FACTORS[:2]), (STRAIGHT,), "product"),
        (arm_proof(*FACTORS), (), "component"),
        (
            arm_proof(
                *FACTORS[:2], Case(("sin(q)",), 1, sheets=(SHEETS[0], SHEETS[0]))
            ),
            (STRAIGHT,),
            "otherwise",
        ),
        (
            arm_proof(*FACTORS[:2], Case(("sin(q)",), 1, end="positive")),
            (STRAIGHT,),
            "vanish",
        ),
        (arm_proof(*FACTORS), (STRAIGHT, STRAIGHT), "another"),
        (
            arm_proof(*FACTORS),
            (Locus(("sin(q)", "cos(q)"), 2, -1, STRAIGHT.reach),),
            "satisfy",
        ),
        (
            arm_proof(*FACTORS),
            (Locus(("sin(q)",), 1, -1, STRAIGHT.reach),),
            "rank",
        ),
        (
            # One of its two sheets is no posture of lost rank.
            arm_proof(*FACTORS),
            (
                Locus(
                    ("sin(q)*cos(q)",),
                    3,
                    -1,
                    (STRAIGHT.reach[0], Reach((turned("1", "0"),))),
                ),
            ),
            "as in general",
        ),
        (
            arm_proof(*FACTORS[:2], Case(("sin(unknown)",), 1, sheets=SHEETS)),
            (STRAIGHT,),
            "fit",
        ),
    ],
)
def test_false_proofs_of_the_arm_are_refused(
    proof: Node, components: tuple[Locus, ...], why: str
) -> None:
    with pytest.raises(RefusedError, match=why):
        check(arm_certificate(proof, *components), arm_mechanism(), 1)


def test_texts_of_a_certificate_are_read_by_the_grammar_alone() -> None:
    assert symbols_of(read("sin(q) + a^2")) == {"q", "a"}
    with pytest.raises(Exception, match=r"name|grammar|unexpected|expected"):
        read("__import__('os')")
