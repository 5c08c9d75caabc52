"""All 210 schemes of the NAO's arms against published data and float determinants."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from fractions import Fraction
from functools import cache

import numpy as np
import pytest
from loci import nao
from loci.numeric import Array, freedoms, loop_matrix, value

import screwkit as sk
from screwkit.algebra.expression import Number
from screwkit.analyses.schemes import schemes
from screwkit.case import load_text
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.values import with_values
from screwkit.results.schemes import Scheme, Schemes

SAMPLES = 6
LENGTHS_ONLY = {"d3", "r1", "r3"}


@cache
def postures() -> list[dict[str, float]]:
    source = np.random.default_rng(11)
    return [
        {**nao.LENGTHS, **{n: float(source.uniform(-3, 3)) for n in nao.VARIABLES}}
        for _ in range(SAMPLES)
    ]


@cache
def fingerprint(condition: str) -> tuple[int, ...]:
    """Values at random postures up to a constant, rounded: equal for equal zeros."""
    found = np.array([value(condition, at) for at in postures()])
    return tuple(int(x) for x in np.rint(1e7 * found / found[0]))


def of(actuated: Sequence[str]) -> Scheme:
    return next(s for s in nao.the_schemes().schemes if s.actuated == tuple(actuated))


def as_numbers(scheme: Scheme) -> list[int]:
    return [int(name) for name in scheme.actuated]


def test_counts() -> None:
    known = nao.expected()["schemes"]["counts"]
    found = nao.the_schemes()
    assert (found.size, found.total) == (4, known["total"])
    assert found.admissible == known["admissible"]
    assert found.balanced is not None
    assert found.balanced.total == known["two_per_arm_total"]
    assert found.balanced.admissible == known["two_per_arm_admissible"]
    assert found.complete
    by_right: Counter[int] = Counter()
    admissible: Counter[int] = Counter()
    for scheme in found.schemes:
        right = sum(n <= 5 for n in as_numbers(scheme))
        by_right[right] += 1
        admissible[right] += scheme.admissible
    assert known["by_actuated_right"] == {
        str(k): [admissible[k], by_right[k]] for k in range(5)
    }


def test_inadmissible_schemes_and_the_rule() -> None:
    refused = [as_numbers(s) for s in nao.the_schemes().schemes if not s.admissible]
    assert refused == nao.expected()["schemes"]["inadmissible"]
    for scheme in nao.the_schemes().schemes:
        names = set(scheme.actuated)
        rule = bool(names & {"1", "6"}) and names != {"1", "2", "6", "7"}
        assert scheme.admissible is rule
        assert scheme.generic_rank == (6 if rule else 5)
        assert (scheme.reason is None) is rule
    reasons = sorted(r.schemes for r in nao.the_schemes().refusals)
    assert reasons == [1, 70]


def test_mirror_classes() -> None:
    known = nao.expected()["schemes"]["counts"]["mirror_classes"]
    mirror = nao.the_schemes().mirror
    assert mirror is not None
    assert list(mirror.total) == known["all"]
    assert list(mirror.admissible) == known["admissible"]
    assert list(mirror.balanced) == known["two_per_arm"]
    assert list(mirror.balanced_admissible) == known["two_per_arm_admissible"]
    images = nao.expected_ranks()["mirror"]
    for scheme in nao.the_schemes().schemes:
        assert sorted(scheme.mirror) == sorted(images[",".join(scheme.actuated)])


def test_factors_are_those_of_the_reference() -> None:
    """Per scheme, with multiplicities; conditions compared at random postures."""
    factors = nao.expected_schemes()["factors"]
    for actuated, _, listed in nao.expected_schemes()["schemes"]:
        wanted = Counter(
            {
                fingerprint(factors[name]): count
                for name, count in listed
                if factors[name] not in LENGTHS_ONLY
            }
        )
        scheme = of(actuated)
        found = Counter(
            {
                fingerprint(text): count
                for text, count in zip(scheme.locus, scheme.multiplicities, strict=True)
            }
        )
        assert found == wanted, actuated


def test_each_factor_is_listed_with_the_number_of_its_schemes() -> None:
    counted = Counter(text for s in nao.the_schemes().schemes for text in s.locus)
    listed = nao.the_schemes().factors
    assert {f.equation: f.schemes for f in listed} == dict(counted)
    known = nao.expected()["schemes"]["counts"]
    lengths = sum(text in LENGTHS_ONLY for text in nao.expected_schemes()["factors"])
    assert len(listed) == known["distinct_irreducible_factors"] - lengths
    for name in ("T2", "T7", "s4", "s9", "sD", "cD"):
        assert counted[nao.NAMES[name]] == known[f"schemes_with_factor_{name}"]


def determinant(scheme: Scheme, at: dict[str, float]) -> float:
    passive = [[j not in scheme.actuated for j in limb] for limb in nao.LIMBS]
    matrix: Array = loop_matrix(nao.limbs_at(at), passive)
    return float(np.linalg.det(matrix))


def test_product_of_the_factors_is_the_determinant() -> None:
    """Float determinants of the assembled passive columns, up to one constant each."""
    for scheme in nao.the_schemes().schemes:
        ratios = []
        for at in postures():
            product = 1.0
            for text, count in zip(scheme.locus, scheme.multiplicities, strict=True):
                product *= value(text, at) ** count
            ratios.append(determinant(scheme, at) / product)
        if scheme.admissible:
            spread = np.ptp(ratios) / np.max(np.abs(ratios))
            assert spread < 1e-7, scheme.actuated
            assert np.min(np.abs(ratios)) > 1e-6
        else:
            assert np.max(np.abs(ratios)) < 1e-12, scheme.actuated


STRATA = {nao.NAMES[name]: name for name in ("s4", "s9", "T2", "T7", "sD", "cD")}


def test_idle_factors_leave_the_wrench_system_full() -> None:
    checked = 0
    for scheme in nao.the_schemes().schemes:
        ranks = nao.expected_ranks()["ranks"][",".join(scheme.actuated)]
        assert scheme.generic_rank == ranks["generic"][1]
        for text in scheme.locus:
            if text in STRATA:
                passive, wrenches = ranks[STRATA[text]]
                assert passive < 6
                assert (text in scheme.idle) is (wrenches == 6), scheme.actuated
                checked += 1
    assert checked == 54 + 54 + 33 + 33 + 20 + 16


SPECIAL = {
    "d3=0": ("d3",),
    "r1=0": ("r1",),
    "r3=0": ("r3",),
    "d3=r1=0": ("d3", "r1"),
    "r1=r3=0": ("r1", "r3"),
}


@pytest.mark.parametrize("lengths", SPECIAL)
def test_special_lengths(lengths: str) -> None:
    known = nao.expected()["schemes"]["special_lengths"][lengths]
    zeros = {name: Number(Fraction(0)) for name in SPECIAL[lengths]}
    found = schemes(Assembly(with_values(nao.mechanism(), zeros)), size=4)
    assert found.total == 210
    assert found.admissible == known["admissible"]
    assert found.balanced is not None
    assert found.balanced.admissible == known["two_per_arm"]
    if "lost" in known:
        admissible = {s.actuated for s in found.schemes if s.admissible}
        lost = [
            as_numbers(s)
            for s in nao.the_schemes().schemes
            if s.admissible and s.actuated not in admissible
        ]
        assert sorted(lost) == sorted(known["lost"])


def test_arms_that_only_turn_about_their_shoulders() -> None:
    """d3 = r3 = 0: every determinant vanishes, for idle motions that do not count.

    The published 0 counts determinants.  The platform is stopped by three locked
    joints of one arm that leave two passive axes whose plane misses the shoulder line.
    """
    known = nao.expected()["schemes"]["special_lengths"]["d3=r3=0"]
    zeros = {name: Number(Fraction(0)) for name in ("d3", "r3")}
    found = schemes(Assembly(with_values(nao.mechanism(), zeros)), size=4)
    stopped = 0
    for scheme in found.schemes:
        limbs = [
            limb[:, [j not in scheme.actuated for j in joints]]
            for limb, joints in zip(
                nao.limbs_at(postures()[0] | {"d3": 0.0, "r3": 0.0}),
                nao.LIMBS,
                strict=True,
            )
        ]
        nonzero = abs(np.linalg.det(loop_matrix(limbs))) > 1e-12
        assert nonzero <= known["admissible"]
        assert scheme.admissible is (freedoms(limbs).platform == 0)
        stopped += scheme.admissible
    assert (found.admissible, stopped) == (68, 68)


def test_candidates_and_size() -> None:
    """Redundant sets: five actuators among six, against the published rule."""
    candidates = ("1", "2", "3", "6", "7", "8")
    found = schemes(nao.assembly(), size=5, candidates=candidates)
    assert found.total == 6
    assert all(set(s.actuated) <= set(candidates) for s in found.schemes)
    for scheme in found.schemes:
        assert scheme.admissible is bool({"1", "6"} & set(scheme.actuated))


def test_rotations_of_contacts_about_one_line_are_no_slides() -> None:
    """Two hard fingers: the object spins about the line through both points."""
    answer = sk.schemes(sk.load("fingers_hard"))
    (scheme,) = answer.schemes
    assert scheme.reason is not None
    assert "rotations c1:0 and c2:0 have one line" in scheme.reason
    assert "turn about it together" in scheme.reason


def test_numbers_describe_one_posture_and_symbols_many() -> None:
    assert sk.schemes(sk.load("hand_three_hard")).one_posture
    assert sk.singularities(sk.load("hand_three_hard")).one_posture
    assert not sk.singularities(sk.load("nao_t14")).one_posture
    assert "one posture, in numbers" in str(sk.schemes(sk.load("hand_three_hard")))


def test_what_is_not_worked_out_is_undecided_and_last() -> None:
    """With no work allowed: ranks are decided, loci are not, and it is said."""
    whole = sk.schemes(sk.load("nao_t14"))
    none = sk.schemes(sk.load("nao_t14"), work=0)
    assert (none.total, none.admissible) == (whole.total, whole.admissible)
    assert [s.actuated for s in none.schemes] == [s.actuated for s in whole.schemes]
    assert all(s.undecided for s in none.schemes if s.admissible)
    assert not none.complete
    assert "more with --work" in none.reason
    some = sk.schemes(sk.load("nao_t14"), work=40)
    found = {s.actuated: s.locus for s in whole.schemes}
    decided = [s for s in some.schemes if s.admissible and not s.undecided]
    assert 0 < len(decided) < whole.admissible
    assert all(s.locus == found[s.actuated] for s in decided)


def test_what_is_admissible_is_known_before_any_locus() -> None:
    early: list[Schemes] = []
    whole = sk.schemes(
        sk.load("nao_t14"), finished=lambda name, part: early.append(part)
    )
    (known,) = early
    assert (known.total, known.admissible) == (whole.total, whole.admissible)
    assert known.balanced == whole.balanced
    assert [(s.actuated, s.generic_rank) for s in known.schemes] == [
        (s.actuated, s.generic_rank) for s in whole.schemes
    ]
    assert not known.complete
    assert all(s.undecided == s.admissible for s in known.schemes)


def test_a_factor_with_two_sheets_is_idle_where_the_platform_is_still_on_both() -> None:
    """Three limbs of axes through one point; sin φ = 0 is φ = 0 and φ = π.

    At φ = π limb A turns the platform about lines of z = 0, B and C about lines of the
    plane of z and (1, 2, 0), C with one joint locked about (1, 2, 1) alone.  At φ = 0
    both axes of C are one line, which does not lie in z = 0.
    """
    chains = {
        "A": ([1, 1, 0], "u + x", "x"),
        "B": ([0, 0, 1], [1, 2, -1], "w"),
        "C": ([1, 2, -1], "w"),
    }
    joints, links = [], ["base", "top"]
    for limb, axes in chains.items():
        ways = ["base", *(f"{limb}{k}" for k in range(1, len(axes))), "top"]
        links += ways[1:-1]
        joints += [
            {
                "name": f"R{limb}{k + 1}",
                "type": "revolute",
                "parent": ways[k],
                "child": ways[k + 1],
                "point": ["0", "0", "0"],
                "axis": axis if isinstance(axis, str) else [str(c) for c in axis],
            }
            for k, axis in enumerate(axes)
        ]
    found = sk.schemes(
        load_text(
            json.dumps(
                {
                    "screwkit": 1,
                    "name": "three_limbs",
                    "geometry": "posture",
                    "base": "base",
                    "platform": "top",
                    "links": links,
                    "variables": {"phi": {"value": "1.1", "angle": True}},
                    "vectors": {
                        "u": ["1", "1", "0"],
                        "x": {"link": "top", "at": ["1", "0", "0"]},
                        "w": {"link": "top", "at": ["1", "2", "-1"]},
                    },
                    "pose": {"rotation": {"axis": "z", "angle": "phi"}},
                    "joints": joints,
                }
            )
        )
    )
    still = {s.actuated: "sin(phi)" in s.idle for s in found.schemes if s.admissible}
    assert still == {("RB2",): False, ("RB3",): False, ("RC1",): True, ("RC2",): True}
