"""The screw systems of the bundled cases: what is printed is reciprocal and right."""

from __future__ import annotations

import json
from fractions import Fraction
from functools import cache
from itertools import chain
from pathlib import Path

import numpy as np
import pytest
from kinematics.float_loops import FloatLoops, counted
from loci.numeric import values

import screwkit as sk
from screwkit.algebra.batch import BatchRing
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.analyses import identified
from screwkit.mechanism.model import freedom_label
from screwkit.questions import screws
from screwkit.reports.records import from_json
from screwkit.reports.verdict import is_plain_yes
from screwkit.results.screws import (
    IdentifiedScrew,
    LimbScrews,
    PlatformScrews,
    Screws,
)
from screwkit.screw.nullspace import has_pitch, reciprocal_basis
from screwkit.screw.vector import dot

REFERENCE = Path(__file__).parents[1] / "reference" / "nao_screws.json"
DIMENSIONS = {  # twists of the limbs; platform
    "dual_iiwa": ([6, 6], 6),
    "dual_planar_arm": ([3, 3], 3),
    "dual_puma": ([6, 6], 6),
    "dual_scara": ([4, 4], 4),
    "nao_t14": ([5, 5], 4),
    "three_arms": ([5, 5, 5], 3),
    "unequal_arms": ([4, 5], 3),
}


@pytest.fixture(scope="module")
def answers() -> dict[str, Screws]:
    return {name: screws(sk.load(name)) for name in DIMENSIONS}


@pytest.fixture(scope="module")
def nao(answers: dict[str, Screws]) -> Screws:
    return answers["nao_t14"]


def every_screw(answer: Screws) -> list[IdentifiedScrew]:
    systems = [s for limb in answer.limbs for s in (limb.twists, limb.wrenches)]
    systems += [answer.platform.twists, answer.platform.wrenches]
    actuation = [w.screw for w in answer.actuation_wrenches if w.screw is not None]
    return [*chain.from_iterable(systems), *actuation]


def posture(name: str, seed: int) -> BatchRing:
    mechanism = sk.load(name).mechanism
    source = np.random.default_rng(seed)
    names = [*mechanism.joint_variables, *(p.name for p in mechanism.parameters)]
    return BatchRing({n: float(source.uniform(0.3, 1.4)) for n in names})


def numbers(texts: tuple[str, ...], at: BatchRing) -> np.ndarray:
    return np.array(
        [float(evaluate(parse(t, limits=RESULT_LIMITS), at)) for t in texts]
    )


def matrix(system: tuple[IdentifiedScrew, ...], at: BatchRing) -> np.ndarray:
    return np.array([numbers(s.coordinates, at) for s in system]).reshape(-1, 6)


def swapped(rows: np.ndarray) -> np.ndarray:
    return rows[:, [3, 4, 5, 0, 1, 2]]


def rank(rows: np.ndarray) -> int:
    """With a clear gap between what counts and what does not."""
    if not rows.size:
        return 0
    rows = rows / np.linalg.norm(rows, axis=1, keepdims=True)
    values = np.linalg.svd(rows, compute_uv=False)
    clear = values[(values < 1e-11) | (values > 1e-5)]
    assert len(clear) == len(values)
    return int((values > 1e-5).sum())


@pytest.mark.parametrize("name", sorted(DIMENSIONS))
def test_dimensions(name: str, answers: dict[str, Screws]) -> None:
    answer = answers[name]
    limbs, platform = DIMENSIONS[name]
    assert [limb.twist_dimension for limb in answer.limbs] == limbs
    assert [limb.wrench_dimension for limb in answer.limbs] == [6 - d for d in limbs]
    assert answer.platform.twist_dimension == platform == len(answer.platform.twists)
    assert answer.platform.wrench_dimension == 6 - platform
    assert (answer.order, answer.point) == ("direction-moment", "origin")


@pytest.mark.parametrize("name", sorted(DIMENSIONS))
def test_systems_agree_with_null_spaces_by_singular_values(
    name: str, answers: dict[str, Screws]
) -> None:
    answer = answers[name]
    for seed in (1, 2):
        at = posture(name, seed)
        systems: list[LimbScrews | PlatformScrews] = [*answer.limbs, answer.platform]
        for system in systems:
            twists, wrenches = matrix(system.twists, at), matrix(system.wrenches, at)
            assert rank(twists) == system.twist_dimension
            assert rank(wrenches) == len(system.wrenches) == system.wrench_dimension
            scale = np.abs(twists).max(initial=1) * np.abs(wrenches).max(initial=1)
            assert np.abs(twists @ swapped(wrenches).T).max(initial=0) < 1e-12 * scale
        together = [matrix(limb.wrenches, at) for limb in answer.limbs]
        stacked = np.vstack([*together, matrix(answer.platform.wrenches, at)])
        assert rank(stacked) == answer.platform.wrench_dimension


@pytest.mark.parametrize("name", sorted(DIMENSIONS))
def test_actuation_wrenches_lock_their_joint_alone(
    name: str, answers: dict[str, Screws]
) -> None:
    answer, at = answers[name], posture(name, 3)
    limbs = {limb.name: limb for limb in answer.limbs}
    for entry in answer.actuation_wrenches:
        limb = limbs[entry.limb]
        twists = matrix(limb.twists, at)
        place = limb.joints.index(entry.joint)
        if entry.screw is None:
            assert rank(np.delete(twists, place, 0)) == limb.twist_dimension
            continue
        wrench = matrix((entry.screw,), at)
        power = (twists @ swapped(wrench).T).ravel()
        scale = np.abs(twists).max() * np.abs(wrench).max()
        assert abs(power[place]) > 1e-6 * scale
        assert np.abs(np.delete(power, place)).max() < 1e-12 * scale
    assert [w.joint for w in answer.actuation_wrenches] == [
        joint for limb in answer.limbs for joint in limb.joints
    ]


@pytest.mark.parametrize("name", sorted(DIMENSIONS))
def test_kind_axis_point_and_pitch_describe_the_coordinates(
    name: str, answers: dict[str, Screws]
) -> None:
    at = posture(name, 4)
    for screw in every_screw(answers[name]):
        f, m = np.split(numbers(screw.coordinates, at), 2)
        axis = numbers(screw.axis, at)
        if screw.kind in ("couple", "translation"):
            assert not f.any()
            assert (screw.point, screw.pitch) == ((), "")
            assert axis == pytest.approx(m)
            continue
        assert axis == pytest.approx(f)
        pitch = float(numbers((screw.pitch,), at)[0])
        assert (screw.pitch == "0") == (screw.kind in ("force", "rotation"))
        expected = np.cross(numbers(screw.point, at), f) + pitch * f
        assert m == pytest.approx(expected, rel=1e-8, abs=1e-8 * np.abs(f).max())


@pytest.mark.parametrize("name", sorted(DIMENSIONS))
def test_linear_order_exchanges_the_halves(
    name: str, answers: dict[str, Screws]
) -> None:
    other = screws(sk.load(name), order="linear")
    assert other.order == "moment-direction"
    for here, there in zip(every_screw(answers[name]), every_screw(other), strict=True):
        assert there.coordinates == (*here.coordinates[3:], *here.coordinates[:3])
        assert there.axis == here.axis


def test_an_order_is_one_of_two() -> None:
    with pytest.raises(ValueError, match="neither"):
        screws(sk.load("nao_t14"), order="alphabetical")


@pytest.mark.parametrize("name", sorted(DIMENSIONS))
def test_no_screw_is_longer_than_a_few_lines(
    name: str, answers: dict[str, Screws]
) -> None:
    for screw in every_screw(answers[name]):
        assert sum(map(len, screw.coordinates)) < 4000


# -- the same for postures ---------------------------------------------------------

POSTURES = (
    "2upr_rpu",
    "3crr",
    "3prs",
    "3rpr_planar",
    "4ruu",
    "4H_equal_pitch",
    "agile_eye",
    "bennett",
    "dymo",
    "exechon",
    "rssr",
    "spherical_3rrr",
    "tricept",
    "tripteron",
)
"""Limbs are chains of joints: of rotations, translations and helices of all sorts."""


@cache
def drawn(name: str) -> tuple[Screws, FloatLoops]:
    """The answer, and the second opinion at drawn values of all symbols.

    What is generic may vanish at the values of the file: 3prs stands level there.
    """
    case = sk.load(name)
    answer = screws(case)
    assert answer.generic
    return answer, FloatLoops(case.mechanism, generic=True)


def unit_rows(system: tuple[IdentifiedScrew, ...], floats: FloatLoops) -> np.ndarray:
    rows = [floats.in_its_size(values(s.coordinates, floats.values)) for s in system]
    return np.array([row / np.linalg.norm(row) for row in rows]).reshape(-1, 6)


def unit_twists(labels: tuple[str, ...], floats: FloatLoops) -> np.ndarray:
    rows = [floats.twists[label] for label in labels]
    return np.array([row / np.linalg.norm(row) for row in rows]).reshape(-1, 6)


def annihilated(wrenches: np.ndarray) -> np.ndarray:
    """Orthonormal twists on which none of the wrenches does work."""
    return np.asarray(np.linalg.svd(swapped(wrenches))[2][rank(wrenches) :])


@pytest.mark.parametrize("name", POSTURES)
def test_limbs_of_postures_span_what_their_joints_do(name: str) -> None:
    answer, floats = drawn(name)
    for limb in answer.limbs:
        joints = unit_twists(limb.joints, floats)
        assert rank(joints) == limb.twist_dimension
        twists, wrenches = (unit_rows(s, floats) for s in (limb.twists, limb.wrenches))
        assert rank(twists) == rank(np.vstack([twists, joints])) == rank(joints)
        assert rank(wrenches) == limb.wrench_dimension == len(limb.wrenches)
        assert limb.wrench_dimension == 6 - limb.twist_dimension
        assert np.abs(joints @ swapped(wrenches).T).max(initial=0) < 1e-9


@pytest.mark.parametrize("name", POSTURES)
def test_platforms_of_postures_move_as_all_limbs_let_them(name: str) -> None:
    """By the intersection of the limbs' spans, and by the loop equations."""
    answer, floats = drawn(name)
    mechanism = floats.mechanism
    forces = []
    for limb in answer.limbs:
        joints = unit_twists(limb.joints, floats)
        null = np.linalg.svd(joints)[2][rank(joints) :]
        forces.append(swapped(null))
    together = np.vstack(forces)
    platform = answer.platform
    wrenches = unit_rows(platform.wrenches, floats)
    assert rank(together) == platform.wrench_dimension == rank(wrenches)
    assert rank(np.vstack([together, wrenches])) == platform.wrench_dimension
    twists = unit_rows(platform.twists, floats)
    by_loops = floats.body_twists(mechanism.platform, mechanism.base).T
    assert counted(by_loops).rank == platform.twist_dimension == rank(twists)
    free = annihilated(together) if len(together) else np.eye(6)
    assert rank(np.vstack([free, twists])) == len(free) == platform.twist_dimension


@pytest.mark.parametrize("name", POSTURES)
def test_actuation_wrenches_of_postures_lock_their_freedom_alone(name: str) -> None:
    answer, floats = drawn(name)
    limbs = {limb.name: limb for limb in answer.limbs}
    for entry in answer.actuation_wrenches:
        labels = limbs[entry.limb].joints
        own = freedom_label(floats.mechanism.joint(entry.joint), entry.freedom)
        others = unit_twists(tuple(x for x in labels if x != own), floats)
        if entry.screw is None:
            assert rank(others) == limbs[entry.limb].twist_dimension
            continue
        wrench = swapped(unit_rows((entry.screw,), floats))
        assert np.abs(others @ wrench.T).max(initial=0) < 1e-9
        assert np.abs(unit_twists((own,), floats) @ wrench.T).max() > 1e-6


# -- what the paper and geometry say of the NAO --------------------------------------


def test_nao_constraint_forces_join_the_centres(nao: Screws) -> None:
    right, left = (limb.wrenches for limb in nao.limbs)
    assert [w.description for w in (*right, *left)] == [
        "force along the line through the common point of axes 1 and 2 and "
        "the common point of axes 3, 4 and 5",
        "force along the line through the common point of axes 6 and 7 and "
        "the common point of axes 8, 9 and 10",
    ]


@pytest.mark.parametrize(
    ("joint", "words"),
    [
        ("1", "force through the common point of axes 3, 4 and 5, parallel to axis 2"),
        ("2", "force through the common point of axes 3, 4 and 5, parallel to axis 1"),
        ("6", "force through the common point of axes 8, 9 and 10, parallel to axis 7"),
        ("7", "force through the common point of axes 8, 9 and 10, parallel to axis 6"),
        (
            "3",
            "force along the intersection line of the planes of axes 1, 2 and of "
            "axes 4, 5",
        ),
        (
            "8",
            "force along the intersection line of the planes of axes 6, 7 and of "
            "axes 9, 10",
        ),
    ],
)
def test_nao_actuation_forces(nao: Screws, joint: str, words: str) -> None:
    screw = next(w.screw for w in nao.actuation_wrenches if w.joint == joint)
    assert screw is not None
    assert screw.description == words


def test_nao_platform_translates_normal_to_both_forces(nao: Screws) -> None:
    kinds = [twist.kind for twist in nao.platform.twists]
    assert sorted(kinds) == ["rotation"] * 3 + ["translation"]
    axis = nao.platform.twists[kinds.index("rotation")]
    assert axis.coordinates == ("0", "1", "0", "-b1", "0", "0")


@pytest.fixture(scope="module")
def published() -> dict[str, dict[str, list[str]]]:
    found: dict[str, dict[str, list[str]]] = json.loads(REFERENCE.read_text())
    return found


@pytest.fixture(scope="module")
def rational_posture(published: dict[str, dict[str, str]]) -> BatchRing:
    values: dict[str, float] = {
        name: float(Fraction(str(value)))
        for name, value in published["lengths"].items()
        if name in ("b1", "r1", "d3", "r3", "r5")
    }
    for joint, tangent in published["tan_half_theta"].items():
        offset = np.pi / 2 if joint in ("2", "7") else 0
        values[f"q{joint}"] = float(2 * np.arctan(float(Fraction(tangent))) - offset)
    return BatchRing(values)


def test_nao_twists_at_the_published_posture(
    nao: Screws, published: dict[str, dict[str, list[str]]], rational_posture: BatchRing
) -> None:
    for limb in nao.limbs:
        for joint, twist in zip(limb.joints, limb.twists, strict=True):
            exact = [float(Fraction(x)) for x in published["twists_base_frame"][joint]]
            assert numbers(twist.coordinates, rational_posture) == pytest.approx(exact)


def test_nao_wrenches_at_the_published_posture(
    nao: Screws, published: dict[str, dict[str, list[str]]], rational_posture: BatchRing
) -> None:
    for limb in nao.limbs:
        exact = [
            float(Fraction(x)) for x in published["constraint_wrenches"][limb.name]
        ]
        ours = numbers(limb.wrenches[0].coordinates, rational_posture)
        assert rank(np.array([exact, ours])) == 1
    places = published["points"]
    for joint, (point, axis) in published["directions_of_actuation_forces"].items():
        screw = next(w.screw for w in nao.actuation_wrenches if w.joint == joint)
        assert screw is not None
        p = [float(Fraction(x)) for x in places[point]]
        s = [float(Fraction(x)) for x in published["twists_base_frame"][axis][:3]]
        force = np.array([*s, *np.cross(p, s)])
        ours = numbers(screw.coordinates, rational_posture)
        assert rank(np.array([force, ours])) == 1


# -- the other cases -----------------------------------------------------------------


def test_scara_arms_carry_horizontal_couples(answers: dict[str, Screws]) -> None:
    answer = answers["dual_scara"]
    for limb in answer.limbs:
        assert [w.kind for w in limb.wrenches] == ["couple", "couple"]
    kinds = sorted(twist.kind for twist in answer.platform.twists)
    assert kinds == ["rotation", "translation", "translation", "translation"]


def test_planar_arms_carry_a_normal_force(answers: dict[str, Screws]) -> None:
    for limb in answers["dual_planar_arm"].limbs:
        assert sorted(w.kind for w in limb.wrenches) == ["couple", "couple", "force"]


def test_only_the_elbow_of_a_seven_joint_arm_is_not_idle(
    answers: dict[str, Screws],
) -> None:
    """Shoulder and wrist centre stay at a distance when the elbow is locked."""
    entries = answers["dual_iiwa"].actuation_wrenches
    found = {w.joint: w.screw.description for w in entries if w.screw is not None}
    assert set(found) == {"A4", "B4"}
    assert found["A4"] == (
        "force along the line through the common point of axes A1, A2 and A3 and "
        "the common point of axes A5, A6 and A7"
    )


def test_three_skew_forces_leave_rotations_about_lines_that_meet_them(
    answers: dict[str, Screws],
) -> None:
    twists = answers["three_arms"].platform.twists
    assert [twist.kind for twist in twists] == ["rotation"] * 3
    forces = [limb.wrenches for limb in answers["three_arms"].limbs]
    assert [[f.description for f in of_limb] for of_limb in forces] == [
        [f"force along axis {letter}3"] for letter in "ABC"
    ]
    for twist, pair in zip(
        twists, ("B3 and C3", "A3 and C3", "A3 and B3"), strict=True
    ):
        assert twist.description.endswith(f" meeting axes {pair}")


# -- single limbs --------------------------------------------------------------------

HEADER = """screwkit: 1
name: one_limb
geometry: mdh
base: base
platform: tool
"""


def one_limb(tmp_path: Path, rows: list[tuple[str, str]]) -> Screws:
    """An arm with a table of (type, row)."""
    links = ["base", *(f"l{i}" for i in range(1, len(rows) + 1)), "tool"]
    text = HEADER + f"links: [{', '.join(links)}]\n"
    symbols = sorted({"a", "b"} & set(" ".join(row for _, row in rows)))
    text += "parameters:\n" + "".join(f"  {s}: {{positive: true}}\n" for s in symbols)
    text += "joints:\n"
    for i, (kind, row) in enumerate(rows):
        text += (
            f'  - {{name: "{i + 1}", type: {kind}, parent: {links[i]}, '
            f"child: {links[i + 1]}, mdh: {{{row}}}}}\n"
        )
    text += f"  - {{name: hold, type: fixed, parent: {links[-2]}, child: tool}}\n"
    path = tmp_path / "one.yaml"
    path.write_text(text)
    return screws(sk.load(path))


def test_prismatic_joints_are_locked_by_forces(tmp_path: Path) -> None:
    cartesian = [
        ("prismatic", "d: a"),
        ("prismatic", "alpha: pi/2"),
        ("prismatic", "gamma: pi/2, alpha: pi/2"),
    ]
    answer = one_limb(tmp_path, cartesian)
    assert [w.kind for w in answer.limbs[0].wrenches] == ["couple"] * 3
    assert [t.kind for t in answer.platform.twists] == ["translation"] * 3
    kinds = [w.screw and w.screw.kind for w in answer.actuation_wrenches]
    assert kinds == ["force"] * 3


def test_a_general_arm_has_a_constraint_of_some_pitch(tmp_path: Path) -> None:
    """Five axes without any common point: no line of the geometry is reciprocal."""
    skew = [("revolute", f"d: {k}, alpha: pi/3, r: {k + 1}") for k in range(1, 6)]
    answer = one_limb(tmp_path, skew)
    (wrench,) = answer.limbs[0].wrenches
    assert wrench.kind == "screw"
    assert wrench.pitch not in ("", "0")
    parse(wrench.pitch, limits=RESULT_LIMITS)


def test_parallel_axes_twice_on_one_line_are_idle(tmp_path: Path) -> None:
    answer = one_limb(
        tmp_path, [("revolute", "d: a"), ("revolute", "r: b"), ("revolute", "d: a")]
    )
    assert answer.limbs[0].twist_dimension == 2
    assert len(answer.limbs[0].wrenches) == 4
    assert [w.screw is None for w in answer.actuation_wrenches] == [True, True, False]


def test_what_nobody_reads_is_not_written(monkeypatch: pytest.MonkeyPatch) -> None:
    """Long screws keep their kind and say how long they are, in text and JSON."""
    whole = sk.screws(sk.load("nao_t14"))
    monkeypatch.setattr(identified, "WRITTEN", 12)
    short = sk.screws(sk.load("nao_t14"))
    left = 0
    for before, after in zip(
        whole.actuation_wrenches, short.actuation_wrenches, strict=True
    ):
        assert before.screw is not None
        assert after.screw is not None
        assert after.screw.kind == before.screw.kind
        if not after.screw.coordinates:
            left += 1
            assert "terms); --set gives numbers" in after.screw.description
    assert left
    assert "too long to be written" in str(short)
    assert from_json(json.loads(json.dumps(short.to_json()))) == short


@pytest.mark.parametrize("name", ["nao_t14", "3upu_tsai", "bennett"])
def test_a_pitch_is_known_without_multiplying_out(name: str) -> None:
    assembly = sk.load(name).assembly
    framed = assembly.base_twists
    ring = framed.ring
    columns = [*framed.columns, *reciprocal_basis(ring, framed.columns[:4]).columns]
    for column in columns:
        product = ring.normal(dot(column[:3], column[3:]))
        assert has_pitch(ring, column) == (product != 0)


def free_arms(limbs: int, joints: int) -> dict[str, object]:
    """Limbs of revolute joints with axes and points of symbols alone."""
    variables: dict[str, object] = {}
    links, entries = ["base", "tool"], []
    for limb in range(limbs):
        for number in range(joints):
            name = f"{limb}_{number}"
            last = number == joints - 1
            if not last:
                links.append(f"l{name}")
            variables |= {f"{letter}{name}": {} for letter in "xyzuvw"}
            entries.append(
                {
                    "name": f"J{name}",
                    "type": "revolute",
                    "parent": f"l{limb}_{number - 1}" if number else "base",
                    "child": "tool" if last else f"l{name}",
                    "point": [f"{letter}{name}" for letter in "xyz"],
                    "axis": [f"{letter}{name}" for letter in "uvw"],
                }
            )
    return {
        "screwkit": 1,
        "name": "free",
        "geometry": "posture",
        "base": "base",
        "platform": "tool",
        "links": links,
        "variables": variables,
        "joints": entries,
        "actuated": ["J0_0"],
    }


@pytest.mark.parametrize(("limbs", "joints"), [(2, 4), (2, 5), (3, 5)])
def test_what_would_be_too_long_is_counted_and_sized(
    limbs: int, joints: int, tmp_path: Path
) -> None:
    """General axes: the dimensions are those of general subspaces."""
    path = tmp_path / "free.json"
    path.write_text(json.dumps(free_arms(limbs, joints)))
    answer = sk.screws(sk.load(path))
    held = limbs * (6 - joints)
    platform = answer.platform
    assert platform.wrench_dimension == len(platform.wrenches) == held
    assert platform.twist_dimension == len(platform.twists) == 6 - held
    left = [twist for twist in platform.twists if not twist.coordinates]
    assert left
    for twist in left:
        assert "million products of terms" in twist.description
    assert not is_plain_yes(answer)
    assert from_json(json.loads(json.dumps(answer.to_json()))) == answer


@pytest.mark.parametrize("name", ["3rps", "agile_eye", "nao_t14", "4H_equal_pitch"])
def test_screws_are_written_without_fractions_or_a_leading_minus(name: str) -> None:
    """Wrenches and the platform's twists; those of joints keep their sense."""
    answer = sk.screws(sk.load(name))
    systems = [*(limb.wrenches for limb in answer.limbs), answer.platform.wrenches]
    systems.append(answer.platform.twists)
    for screw in (s for system in systems for s in system):
        first = next(c for c in screw.coordinates if c != "0")
        assert not first.startswith("-")
    twists = [twist for limb in answer.limbs for twist in limb.twists]
    for screw in (*(s for system in systems for s in system), *twists):
        assert not any("/" in coordinate for coordinate in screw.coordinates)


def test_the_twist_of_a_joint_keeps_its_sense() -> None:
    """The axis of R21 is k × e2 = (−√3/2, −1/2, 0) as the file has it."""
    limb = sk.screws(sk.load("3rps")).limbs[1]
    assert limb.twists[0].coordinates == ("-sqrt(3)", "-1", "0", "0", "0", "2*a")
