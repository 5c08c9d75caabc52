"""A platform that is the base itself, and one that no limb holds."""

from __future__ import annotations

from pathlib import Path

import pytest

import screwkit as sk
from screwkit.errors import MechanismFileError, UndecidedError
from screwkit.reports.sections import answer_blocks
from screwkit.reports.text import render

LOOSE = """screwkit: 1
name: loose
geometry: posture
base: base
platform: tool
links: [base, arm, tool]
vectors: {z: [0, 0, 1], o: [0, 0, 0]}
joints:
  - {name: A, type: revolute, parent: base, child: arm, axis: z, point: o}
actuated: [A]
"""


def test_a_lone_body_has_no_freedom_and_takes_every_wrench() -> None:
    answer = sk.screws(sk.load("lone_body"))
    assert (answer.platform.twist_dimension, answer.platform.wrench_dimension) == (0, 6)
    kinds = sorted(wrench.kind for wrench in answer.platform.wrenches)
    assert kinds == ["couple"] * 3 + ["force"] * 3
    about = sk.mobility(sk.load("lone_body")).platform
    assert (about.twist_dimension, about.wrench_dimension) == (0, 6)


def test_a_lone_body_in_the_plane(tmp_path: Path) -> None:
    path = tmp_path / "flat.yaml"
    case = Path(__file__).parents[2] / "cases" / "lone_body.yaml"
    text = case.read_text(encoding="utf-8").partition("expected:")[0]
    path.write_text(text.replace("space: spatial", "space: planar"), encoding="utf-8")
    answer = sk.screws(sk.load(path))
    found = {wrench.coordinates for wrench in answer.platform.wrenches}
    assert found == {("1", "0", "0"), ("0", "1", "0"), ("0", "0", "1")}
    assert answer.platform.twist_dimension == 0


def test_nothing_can_be_actuated_in_a_lone_body_and_nothing_need_be() -> None:
    answer = sk.schemes(sk.load("lone_body"))
    assert (answer.size, answer.total, answer.admissible) == (0, 1, 1)
    assert answer.schemes[0].actuated == ()
    assert answer.schemes[0].generic_rank == 6
    whole = sk.analyze(sk.load("lone_body"))
    assert all(claim.agrees for claim in whole.claims)
    with pytest.raises(UndecidedError, match="base and platform are one body, 'base'"):
        sk.manipulability(sk.load("lone_body"))


def test_the_words_about_a_lone_body() -> None:
    text = render(answer_blocks(sk.mobility(sk.load("lone_body"))))
    assert "1 body, no joint, no loop" in text
    assert "base and platform are one body, which has no freedom" in text
    assert "nothing moves: no joint has a freedom" in text
    for nonsense in ("shaky", "every joint moves", "no joint with", "no limb connects"):
        assert nonsense not in text


def test_what_is_rigid_is_not_called_shaky() -> None:
    text = render(answer_blocks(sk.mobility(sk.load("generic_6r"))))
    assert "nothing moves: no joint rates keep the loops closed: rigid" in text


def test_a_platform_on_nothing_is_told_by_its_line(tmp_path: Path) -> None:
    path = tmp_path / "loose.yaml"
    path.write_text(LOOSE, encoding="utf-8")
    case = sk.load(path)
    assert sk.screws(case).platform.twist_dimension == 6
    assert sk.mobility(case).platform.twist_dimension == 6
    for question in (sk.schemes, sk.singularities, sk.manipulability):
        with pytest.raises(MechanismFileError, match=r"5:11  no limb holds .* 'tool'"):
            question(case)
    assert "no limb holds the platform" in str(sk.analyze(case).schemes)
