"""Which lists are certified: roots, divisors, pairs of equations; and no proof."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from one_answer import with_strata

import screwkit
from screwkit.case import load_text
from screwkit.certificates.checking import check
from screwkit.certificates.roots import NotProvedError
from screwkit.certificates.texts import RefusedError
from screwkit.certificates.written import from_text
from screwkit.results.singularities import Singularities
from screwkit.verification import certificate_of, certified_answer

ARM = """
screwkit: 1
name: arm
space: planar
geometry: posture
base: ground
platform: hand
links: [ground, upper, fore, hand]
parameters:
  r: {value: 3, positive: true}
  s: {value: 4, positive: true}
variables: {u: 5, v: 1}
vectors:
  w: [u, v]
  n: [-v, u]
points:
  D: [0, 0]
  W: [u, v]
  E: "(dot(w, w) + r^2 - s^2)/(2*dot(w, w))*w
    + sqrt(r^2/dot(w, w) - ((dot(w, w) + r^2 - s^2)/(2*dot(w, w)))^2)*n"
joints:
  - {name: "1", type: revolute, parent: ground, child: upper, point: D}
  - {name: "2", type: revolute, parent: upper, child: fore, point: E}
  - {name: "3", type: revolute, parent: fore, child: hand, point: W}
actuated: ["1", "2"]
"""


@cache
def answered(folder: Path) -> Singularities:
    file = folder / "arm.yaml"
    file.write_text(ARM, "utf-8")
    return screwkit.singularities(screwkit.load(file), certificate=True)


@pytest.fixture(scope="module")
def answer(tmp_path_factory: pytest.TempPathFactory) -> Singularities:
    return answered(tmp_path_factory.getbasetemp())


def test_equations_too_long_to_be_read_leave_one_list_uncertified(
    answer: Singularities, tmp_path_factory: pytest.TempPathFactory
) -> None:
    case = screwkit.load(tmp_path_factory.getbasetemp() / "arm.yaml")
    (limb,) = answer.limb
    assert limb.certified
    whole, *others = limb.components
    long = replace(whole, equations=(" + ".join(["u"] * 20_000),))
    changed = replace(limb, components=(long, *others))
    (told,) = certified_answer(case, replace(answer, limb=(changed,))).limb
    assert told.certified is False
    assert "too many terms" in told.uncertified


def test_an_arm_whose_elbow_is_a_square_root_is_certified(
    answer: Singularities,
) -> None:
    """By hand: stretched or folded, the hand is r + s or |r − s| from the shoulder."""
    limb = answer.limb[0]
    assert limb.certified
    wanted = {"r^2 + 2*r*s + s^2 - u^2 - v^2", "r^2 - 2*r*s + s^2 - u^2 - v^2"}
    assert {equation for c in limb.components for equation in c.equations} == wanted
    assert "complete, certified" in str(answer)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        # Another length than the one that the geometry divides by.
        ('"x^2 + y^2"], "power": 2', '"x^2 + 2*y^2"], "power": 2'),
        # No divisor has that number.
        ('"divisor": {"equation": 1', '"divisor": {"equation": 7'),
        # The root of something else.
        ("sqrt(r^2", "sqrt(2*r^2"),
        # A factor less.
        ("u^4*sqrt", "u^2*sqrt"),
    ],
)
def test_another_divisor_or_root_is_refused(
    answer: Singularities, old: str, new: str
) -> None:
    certificate = answer.certificate or ""
    old, new = (text.replace("x^", "u^").replace("y^", "v^") for text in (old, new))
    assert old in certificate
    forged = json.loads(certificate)
    forged["parts"] = json.loads(json.dumps(forged["parts"]).replace(old, new))
    case = load_text(ARM)
    check(from_text(certificate), case.mechanism, 3)
    with pytest.raises(RefusedError):
        check(from_text(json.dumps(forged)), case.mechanism, 3)


def test_nothing_may_be_called_undefined_that_is_not(answer: Singularities) -> None:
    """The root itself, 0 where the arm is stretched, is no divisor."""
    forged = json.loads(answer.certificate or "")
    undefined, root = forged["parts"][0]["proof"]["cases"]
    if undefined.get("end") != "undefined":
        undefined, root = root, undefined
    del root["kept"]
    root |= {"end": "undefined", "divisor": undefined["divisor"]}
    with pytest.raises(RefusedError, match="in no divisor"):
        check(from_text(json.dumps(forged)), load_text(ARM).mechanism, 3)


def test_a_list_without_a_proof_is_not_called_certified(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "arm.yaml"
    file.write_text(ARM, "utf-8")
    case = screwkit.load(file)
    plain = screwkit.singularities(case)
    assert plain.limb[0].complete
    assert plain.limb[0].certified is None
    assert "--certificate FILE looks for proofs" in str(plain)

    def fails(*_: object, **__: object) -> None:
        raise NotProvedError("nothing was tried")

    monkeypatch.setattr("screwkit.certificates.part_derivation.proof_of", fails)
    searched = screwkit.singularities(case, certificate=True)
    assert not searched.limb[0].complete  # without a proof nothing is called so
    assert (
        searched.limb[0].reason == searched.limb[0].uncertified == "nothing was tried"
    )
    assert searched.limb[0].certified is False
    assert "complete by search, not certified (nothing was tried)" in str(searched)


def test_a_component_that_starts_with_a_pair_in_half_angles_has_postures() -> None:
    """Its first two equations are one condition times sin ½φ and cos ½φ."""
    arm = screwkit.singularities(screwkit.load("panda"), certificate=True)
    (limb,) = arm.limb
    assert any(len(c.equations) > c.codimension for c in limb.components)
    assert limb.certified, limb.uncertified


def test_of_a_very_long_list_no_component_is_listed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("screwkit.certificates.part_derivation.MOST", 1)
    limb = answered.__wrapped__(tmp_path).limb[0]
    assert not limb.complete
    assert not limb.certified
    assert limb.uncertified == "of more than 1 components none is listed; there are 2"


@pytest.mark.xdist_group("strata of isoglide4_t3r1")
def test_many_limbs_are_certified_by_what_ranks_they_keep(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The list of Isoglide4's constraints; nothing inside another, but beside it.

    That equations of components hold at singular postures alone is left out.
    """
    where = "screwkit.certificates.part_derivation.with_covers"
    monkeypatch.setattr(where, lambda mechanism, part, *others: part)
    answer, _ = with_strata("isoglide4_t3r1")
    case = screwkit.load("isoglide4_t3r1")
    certificate = certificate_of(case, replace(answer, strata=None))
    constraint = certificate.parts[4]
    assert constraint.question == "constraint"
    assert constraint.proof is not None
    floors = [own for part in certificate.parts for own in part.floors]
    # Two of a limb's parallel axes are l apart: it loses one freedom at most.
    assert {(own.rank, own.loci) for own in floors} == {(4, ()), (3, ())}
    *_, found, _ = check(certificate, case.mechanism, 11)
    # Where z, sin θ3 and sin θ1 (or sin θ2) are 0 two limbs lie along one line.
    ratio = "cos(phi)*sin(theta4) + 2*sin(phi)*cos(theta4)"
    alike = [
        own.equations
        for own in constraint.components
        if any(e.startswith(ratio) for e in own.equations)
    ]
    flat = [own for own in alike if "z" in own]
    assert len(flat) == 2
    assert {*found.wider_components} == {*alike} - {*flat}
    without = replace(certificate.parts[0], floors=())
    parts = (without, *certificate.parts[1:])
    with pytest.raises(RefusedError, match="no part proves rank 4 of limb limb1"):
        check(replace(certificate, parts=parts), case.mechanism, 11)


UPRIGHT = """
screwkit: 1
name: upright
geometry: posture
base: base
platform: platform
links: [base, platform, slider, rod]
variables: {p: {value: 1/5, angle: true}, q: {value: 0, angle: true}}
pose: {translation: [0, 0, 2], rotation: {euler: yxy, angles: [p, q, 0]}}
points:
  A: [3, -1, 0]
  B: {link: platform, at: [0, -1, 0]}
vectors: {i: [1, 0, 0], w: "cross(i, B - A)"}
joints:
  - {name: P, type: prismatic, parent: base, child: slider, axis: i, point: A}
  - {name: U, type: universal, parent: slider, child: rod, axes: [i, w], point: A}
  - {name: S, type: spherical, parent: rod, child: platform, point: B}
"""


def test_a_rod_that_cannot_stand_across_its_slide_is_never_singular(
    tmp_path: Path,
) -> None:
    """The ball stands at −sin p sin q along the slide, the slider at 3."""
    file = tmp_path / "upright.yaml"
    file.write_text(UPRIGHT, "utf-8")
    (limb,) = screwkit.singularities(screwkit.load(file), certificate=True).limb
    assert limb.generic_rank == 6
    assert limb.complete
    assert limb.certified
    assert not limb.components


STRUT = """
screwkit: 1
name: strut
geometry: posture
base: base
platform: platform
links: [base, platform, lower, upper]
variables:
  y: 0.1
  z: 1.5
  b: {value: 0.2, angle: true}
  c: {value: 0.3, angle: true}
pose: {translation: [0, y, z], rotation: {euler: xyz, angles: [b, c, 0]}}
points:
  A: [2, 0, 0]
  B: {link: platform, at: [1, 0, 0]}
vectors:
  i: [1, 0, 0]
  p: {link: platform, at: [0, 1, 0]}
joints:
  - {name: U, type: universal, parent: base, child: lower, axes: [i, p], point: A}
  - {name: P, type: prismatic, parent: lower, child: upper, axis: B - A}
  - {name: R, type: revolute, parent: upper, child: platform, axis: p, point: B}
"""


def test_where_only_a_strut_of_complex_length_0_would_be_singular(
    tmp_path: Path,
) -> None:
    """B stands cos c along i, A at 2: the strut s has a length, 1 at least.

    The hinges at A and B differ by a translation across s and p, which is 0 where s is
    along p: never, as p is across i.
    """
    file = tmp_path / "strut.yaml"
    file.write_text(STRUT, "utf-8")
    (limb,) = screwkit.singularities(screwkit.load(file), certificate=True).limb
    assert (limb.generic_rank, limb.complete, limb.certified) == (4, True, True)
    assert not limb.components
    source = np.random.default_rng(5)
    for _ in range(200):
        y, z, b, c = source.uniform(-3, 3, 4)
        p = np.array([0, np.cos(b), np.sin(b)])
        u = np.array([np.cos(c), np.sin(b) * np.sin(c), -np.cos(b) * np.sin(c)])
        i, place, end = np.eye(3)[0], np.array([2, 0, 0]), np.array([0, y, z]) + u
        columns = [
            [*i, *np.cross(place, i)],
            [*p, *np.cross(place, p)],
            [0, 0, 0, *(end - place)],
            [*p, *np.cross(end, p)],
        ]
        assert np.linalg.svd(np.array(columns))[1][3] > 1e-3
