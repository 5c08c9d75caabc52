"""Right files: what the model holds, in YAML and JSON alike."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
import yaml

from screwkit.algebra.expression import ZERO, Number, Symbol
from screwkit.algebra.text import expression_text
from screwkit.mechanism.files import mechanism_from_text, read_mechanism
from screwkit.mechanism.graph import limbs
from screwkit.mechanism.model import JointType, Mechanism, freedom_label
from screwkit.mechanism.schema import json_schema

ROOT = Path(__file__).parents[2]
CASES = sorted((ROOT / "cases").glob("*.yaml"))
NAO = ROOT / "cases" / "nao_t14.yaml"

POSTURE = """
screwkit: 1
name: platform
geometry: posture
base: ground
platform: plate
links: [ground, plate]
parameters:
  a: 2
  b: {value: a/4, positive: true}
  c: {value: later}
  later: 0.1
variables: {x: 0.1, phi: {value: pi/6, angle: true}}
pose:
  translation: [x, 0, 1]
  rotation: {axis: z, angle: phi}
points:
  A1: [a, 0, 0]
  B1: {link: plate, at: [b, 0, 0]}
  M: (A1 + B1)/2
vectors:
  u: B1 - A1
  n: {link: plate, at: [0, 0, 2]}
  w: {link: plate, at: [0, 1, 0]}
joints:
  - {name: leg 1, type: prismatic, parent: ground, child: plate, axis: B1 - A1}
  - name: leg 2
    type: universal
    parent: ground
    child: plate
    axes: [[1, 0, 0], "cross(u, n)"]
    point: M
  - {name: leg 3, type: hard_finger, parent: ground, child: plate, point: B1}
reference_point: B1
weights: {rates: [1, 2], twist: [1, 1, 1, 5, 5, a]}
actuated: ["leg 2:1", leg 1]
"""


def written(vector: Any) -> list[str]:
    return [expression_text(part) for part in vector]


@pytest.fixture(scope="module")
def nao() -> Mechanism:
    return read_mechanism(NAO)


class TestNao:
    def test_names(self, nao: Mechanism) -> None:
        assert (nao.name, nao.base, nao.platform) == ("nao_t14", "torso", "object")
        assert len(nao.links) == 12
        assert nao.joint_variables == tuple(f"q{k}" for k in range(1, 11))
        assert nao.actuated == nao.scheme_order == ("1", "2", "3", "7")

    def test_lengths_are_exact(self, nao: Mechanism) -> None:
        values = {p.name: p.value for p in nao.parameters}
        assert values["r5"] == Number(Fraction(1137, 10_000))
        assert all(parameter.positive for parameter in nao.parameters)

    def test_rows(self, nao: Mechanism) -> None:
        row = nao.joint("3").mdh
        assert row is not None
        assert [expression_text(e) for e in (row.d, row.alpha, row.r)] == [
            "-d3",
            "pi/2",
            "r3",
        ]
        assert row.gamma == row.b == row.theta == ZERO
        assert expression_text(nao.joint("7").offsets[0]) == "pi/2"
        assert nao.joint("1").offsets == (ZERO,)
        assert nao.joint("grasp_left").mdh is None
        assert nao.joint("grasp_left").variables == ()

    def test_claims_keep_numbers_and_text_apart(self, nao: Mechanism) -> None:
        claims = {claim.question: claim for claim in nao.claims}
        assert claims["mobility.counts.grubler"].value == 4
        assert claims["singularities.limb.0.complete"].value is True
        assert claims["singularities.limb.0.components#elbow"].value == ["0", "pi"]
        assert claims["mobility.platform.motion_type"].value == "1T3R"
        assert not claims["schemes.admissible#remain"].holds
        assert claims["schemes.admissible#remain"].note

    def test_every_refuted_claim_is_published_and_explained(
        self, nao: Mechanism
    ) -> None:
        refuted = [claim for claim in nao.claims if not claim.holds]
        assert len(refuted) >= 8
        assert all(c.status == "published" and c.note and c.source for c in refuted)


class TestPosture:
    mechanism = mechanism_from_text(POSTURE, "platform.yaml")

    def test_parameters_are_closed(self) -> None:
        values = {p.name: p for p in self.mechanism.parameters}
        assert values["b"].value == Number(Fraction(1, 2))
        assert values["c"].value == Number(Fraction(1, 10))
        assert values["phi"].angle
        assert values["phi"].free
        assert not values["a"].free

    def test_the_pose_moves_what_the_platform_owns(self) -> None:
        points = self.mechanism.points
        assert written(points["A1"]) == ["a", "0", "0"]
        assert written(points["B1"]) == ["x + cos(phi)*b", "sin(phi)*b", "1"]
        assert written(points["M"])[2] == "1/2"
        assert written(self.mechanism.vectors["n"]) == ["0", "0", "2"]
        assert written(self.mechanism.vectors["w"]) == ["-sin(phi)", "cos(phi)", "0"]

    def test_joints(self) -> None:
        first, second, third = self.mechanism.joints
        assert written(first.axes[0]) == ["x + cos(phi)*b - a", "sin(phi)*b", "1"]
        assert first.variables == ("q1",)
        assert second.variables == ("q2_1", "q2_2")
        assert second.actuated == (1,)
        assert third.type is JointType.HARD_FINGER
        assert third.variables == ()
        assert freedom_label(second, 1) == "leg 2:1"
        assert self.mechanism.actuated == ("leg 1", "leg 2:1")
        assert self.mechanism.scheme_order == ("leg 2:1", "leg 1")

    def test_weights_are_full_matrices(self) -> None:
        rates = self.mechanism.weights["rates"]
        assert rates == (
            (Number(Fraction(1)), ZERO),
            (ZERO, Number(Fraction(2))),
        )
        assert self.mechanism.weights["twist"][5][5] == Symbol("a")

    @pytest.mark.parametrize(
        ("rotation", "expected"),
        [
            ("{euler: zyx, angles: [phi, 0, 0]}", None),
            ("{axis: [0, 0, 3], angle: phi}", ["x + cos(phi)*b", "sin(phi)*b", "1"]),
            ("{quaternion: [1, 0, 0, 0]}", ["x + b", "0", "1"]),
            ("{quaternion: [2, 0, 0, 2]}", ["x", "b", "1"]),
            ("{quaternion: [0, 0, 3, 0]}", ["x - b", "0", "1"]),
            ("{axis: y, angle: phi}", ["x + cos(phi)*b", "0", "1 - sin(phi)*b"]),
        ],
    )
    def test_rotations(self, rotation: str, expected: list[str] | None) -> None:
        text = POSTURE.replace("{axis: z, angle: phi}", rotation)
        point = mechanism_from_text(text, "platform.yaml").points["B1"]
        if expected is not None:
            assert written(point) == expected
        else:
            assert written(point)[0] == "x + cos(phi)*cos(0)*b"

    def test_reference_point(self) -> None:
        assert self.mechanism.reference_point == self.mechanism.points["B1"]


def _as_json(value: Any) -> Any:
    """The YAML as JSON would hold it: numbers where YAML has plain numbers."""
    if isinstance(value, dict):
        return {str(key): _as_json(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [_as_json(entry) for entry in value]
    return value


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_json_and_yaml_give_the_same_mechanism(path: Path) -> None:
    content = yaml.safe_load(path.read_text(encoding="utf-8"))
    text = json.dumps(_as_json(content))
    assert mechanism_from_text(text, "case.json", json=True) == read_mechanism(path)


def test_numbers_of_json_stay_exact() -> None:
    text = json.dumps(
        {
            **{"screwkit": 1, "name": "n", "geometry": "mdh", "base": "a"},
            **{"platform": "b", "links": ["a", "b"], "joints": []},
            "parameters": {"k": 0.1, "l": {"value": 12345678901234567890}},
        }
    )
    found = mechanism_from_text(text, "n.json", json=True).parameters
    assert found[0].value == Number(Fraction(1, 10))
    assert found[1].value == Number(Fraction(12345678901234567890))


def test_reading_a_json_file(tmp_path: Path) -> None:
    content = yaml.safe_load(NAO.read_text(encoding="utf-8"))
    path = tmp_path / "nao.JSON"
    path.write_text("\ufeff" + json.dumps(content), encoding="utf-8")
    assert read_mechanism(path) == read_mechanism(NAO)


class TestBundledCases:
    def test_there_are_several(self) -> None:
        assert len(CASES) >= 6

    @pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
    def test_each_says_what_it_is(self, path: Path) -> None:
        mechanism = read_mechanism(path)
        assert mechanism.name == path.stem
        assert mechanism.title
        assert mechanism.source
        assert mechanism.claims
        assert all(claim.source.strip() for claim in mechanism.claims)
        found = limbs(mechanism)
        assert set(mechanism.limb_names) <= {limb.name for limb in found}


def test_a_lone_body_is_base_and_platform() -> None:
    text = "{screwkit: 1, name: lone, geometry: posture, base: b, platform: b, "
    lone = mechanism_from_text(text + "links: [b], joints: []}", "lone")
    assert lone.joints == ()
    assert limbs(lone) == ()


def test_names_of_joints_are_any_text() -> None:
    text = NAO.read_text(encoding="utf-8")
    odd = r"\input{/etc/passwd} $x$ 左"
    found = mechanism_from_text(text.replace("grasp_left", f"'{odd}'"), "odd")
    assert found.joint(odd).type is JointType.FIXED


def test_models_are_frozen() -> None:
    mechanism = mechanism_from_text(POSTURE, "platform.yaml")
    with pytest.raises(AttributeError):
        mechanism.name = "other"  # type: ignore[misc]
    assert replace(mechanism, name="other") != mechanism


def test_schema_knows_every_key_of_the_format() -> None:
    schema = json_schema()
    keys = set(schema["properties"])
    assert keys >= {
        *("screwkit", "name", "title", "source", "units", "space", "geometry"),
        *("base", "platform", "links", "parameters", "variables", "points"),
        *("vectors", "pose", "joints", "actuated", "reference_point", "weights"),
        *("limbs", "expected"),
    }
    assert schema["additionalProperties"] is False
    text = json.dumps(schema)
    for joint_type in JointType:
        assert f'"{joint_type}"' in text


def test_the_model_is_light_to_import() -> None:
    program = (
        "import sys; import screwkit.mechanism.model, screwkit.mechanism.graph; "
        "heavy = {'pydantic', 'yaml', 'networkx', 'sympy', 'flint', 'numpy'}; "
        "sys.exit(', '.join(heavy & set(sys.modules)) or 0)"
    )
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
