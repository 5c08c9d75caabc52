"""Certificates of actuation schemes: what holds the platform, and nothing else."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from math import comb
from pathlib import Path
from typing import Any

import pytest

import screwkit
from screwkit.certificates.checking import check
from screwkit.certificates.texts import RefusedError
from screwkit.certificates.written import from_text
from screwkit.verification import CertificateError, verify, with_certificate


@cache
def certificate(name: str) -> str:
    answer = screwkit.schemes(screwkit.load(name), work=1, certificate=True)
    assert answer.certificate is not None
    return answer.certificate


# Chains, chains in a plane, one arm alone, and the loop equations of a joint graph.
@pytest.mark.parametrize("name", ["2upr_rpu", "five_bar", "generic_6r", "watt_six_bar"])
def test_every_scheme_is_checked_again(name: str, tmp_path: Path) -> None:
    path = tmp_path / "schemes.json"
    path.write_text(certificate(name), encoding="utf-8")
    found = verify(None, str(path), name)
    assert found.accepted, found.reason
    answer = screwkit.schemes(screwkit.load(name), work=1)
    assert (found.schemes, found.admissible) == (answer.total, answer.admissible)
    assert found.missing == ()
    left = answer.total - answer.admissible
    assert f"{answer.admissible} admissible, {left} not" in str(found)
    assert "every list is complete" not in str(found)


def test_five_bars_are_driven_by_any_two_joints() -> None:
    """With two of five joints locked three in a triangle are left: it cannot move.

    The platform is the body between the second and the third joint, and no joint of
    the loop is outside of its limbs.
    """
    claims = from_text(certificate("five_bar")).schemes
    assert claims is not None
    assert len(claims.schemes) == comb(5, 2)
    assert all(own.freedom == 0 for own in claims.schemes)


def called_admissible(document: dict[str, Any]) -> None:
    own = document["schemes"]["schemes"]
    next(claim for claim in own if claim["freedom"])["freedom"] = 0


def called_inadmissible(document: dict[str, Any]) -> None:
    own = document["schemes"]["schemes"]
    next(claim for claim in own if not claim["freedom"])["freedom"] = 1


def with_another_joint(document: dict[str, Any]) -> None:
    document["schemes"]["schemes"][0]["actuated"][0] = "none"


def with_a_joint_twice(document: dict[str, Any]) -> None:
    own = document["schemes"]["schemes"][0]["actuated"]
    own.append(own[0])


def twice(document: dict[str, Any]) -> None:
    own = document["schemes"]["schemes"]
    own.append({**own[0], "actuated": own[0]["actuated"][::-1]})


def of_other_angles(document: dict[str, Any]) -> None:
    document["schemes"]["angles"] = []


def of_another_form(document: dict[str, Any]) -> None:
    document["schemes"]["form"] = "limbs"


def of_no_scheme(document: dict[str, Any]) -> None:
    document["schemes"]["schemes"] = []


@pytest.mark.parametrize(
    ("forge", "why"),
    [
        (called_admissible, "1 freedoms with these locked, not 0"),
        (called_inadmissible, "0 freedoms with these locked, not 1"),
        (with_another_joint, "not freedoms"),
        (with_a_joint_twice, "not freedoms"),
        (twice, "stands twice"),
        (of_other_angles, "angles"),
        (of_another_form, "no form"),
        (of_no_scheme, "no scheme"),
    ],
)
def test_forged_schemes_are_refused(
    forge: Callable[[dict[str, Any]], None], why: str
) -> None:
    name = "2upr_rpu"
    document = json.loads(certificate(name))
    forge(document)
    with pytest.raises(RefusedError, match=why):
        check(from_text(json.dumps(document)), screwkit.load(name).mechanism, 3)


def test_a_certificate_of_no_scheme_is_not_written() -> None:
    case = screwkit.load("five_bar")
    nothing = replace(screwkit.schemes(case, work=1), schemes=())
    with pytest.raises(CertificateError, match="no scheme"):
        with_certificate(case, nothing)
