"""Singularities of the NAO's arms: the published facts, each at points."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

import numpy as np
import pytest
from loci import nao
from loci.numeric import Posture, closed_at, freedoms, loop_matrix, rank, value, values
from loci.searching import posture_on

import screwkit as sk
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.search import Search
from screwkit.analyses.singularities import limb_singularities
from screwkit.loci.loop_drop import loop_state
from screwkit.results.singularities import ConstraintSingularities

RIGHT, LEFT = 0, 1


@pytest.mark.parametrize(("number", "side"), [(RIGHT, "right"), (LEFT, "left")])
def test_limb_components(number: int, side: str) -> None:
    limb = nao.the_singularities().limb[number]
    known = nao.expected()["limb"]
    assert limb.limb == side
    assert limb.generic_rank == 5
    assert limb.complete
    assert [c.equations for c in limb.components] == [(e,) for e in known[side]]
    assert [(c.codimension, c.rank) for c in limb.components] == [(1, 4), (1, 4)]
    for component in limb.components:
        for solution in component.solutions:
            assert list(solution.values) == known["solutions"][solution.variable]


@pytest.mark.parametrize("number", [RIGHT, LEFT])
def test_every_solution_solves_its_condition(number: int) -> None:
    source = np.random.default_rng(2)
    for component in nao.the_singularities().limb[number].components:
        for solution in component.solutions:
            for text in solution.values:
                at = dict(zip(nao.VARIABLES, source.uniform(-3, 3, 10), strict=True))
                at = {**nao.LENGTHS, **{k: float(x) for k, x in at.items()}}
                at[solution.variable] = value(text, at)
                assert -math.pi < at[solution.variable] <= math.pi + 1e-12
                assert abs(value(component.equations[0], at)) < 1e-12
                assert rank(nao.limbs_at(at)[number]) == 4


@pytest.mark.parametrize(
    ("number", "extra", "elbow"), [(RIGHT, "q3", "q4"), (LEFT, "q8", "q9")]
)
def test_rank_three_where_both_meet_and_nowhere_else(
    number: int, extra: str, elbow: str
) -> None:
    limb = nao.the_singularities().limb[number]
    (meeting,) = limb.intersections
    assert (meeting.components, meeting.rank) == ((0, 1), 3)
    assert meeting.extra == (f"cos({extra})",)
    shoulder = limb.components[1].equations[0]
    both = posture_on([shoulder], nao.VARIABLES, nao.LENGTHS) | {elbow: 0.0}
    assert rank(nao.limbs_at(both)[number]) == 4
    assert rank(nao.limbs_at(both | {extra: math.pi / 2})[number]) == 3
    assert rank(nao.limbs_at(both | {extra: math.pi / 2, elbow: 0.8})[number]) == 4
    straight = both | {extra: math.pi / 2, "q2": 0.3, "q7": 0.4}
    assert rank(nao.limbs_at(straight)[number]) == 4


def test_the_four_families_are_components_with_the_freedoms_of_the_reference() -> None:
    components = nao.the_singularities().constraint.components
    families = nao.expected()["constraint"]["families"]
    for family in families:
        equations = [nao.NAMES.get(e, e) for e in family["equations"]]
        points = [
            posture_on(equations, nao.VARIABLES, nao.LENGTHS, seed) for seed in range(4)
        ]
        matches = [
            c
            for c in components
            if all(np.max(np.abs(values(c.equations, at))) < 1e-9 for at in points)
        ]
        assert len(matches) == 1, f"{equations} should be one component"
        (match,) = matches
        assert match.codimension == family["codimension"]
        assert match.rank == family["rank_loop"]
        assert match.wrench_dimension == family["dim_W"]
        assert match.platform_freedom == family["platform_twist_dimension"]
        for at in points:
            assert freedoms(nao.limbs_at(at), 1e-6).loop == 5


def test_every_constraint_component_says_what_holds_on_it() -> None:
    """Ranks by singular values at postures found by least squares."""
    checked = 0
    for component in nao.the_singularities().constraint.components:
        for seed in range(2):
            at = posture_on(component.equations, nao.VARIABLES, nao.LENGTHS, seed)
            found = freedoms(nao.limbs_at(at), 1e-6)
            assert found.loop <= component.rank, component.equations
            if found.loop == component.rank and seed == 0:
                checked += 1
                assert found.mobility == component.mobility
                assert found.platform == component.platform_freedom
                assert 6 - found.platform == component.wrench_dimension
    assert checked >= 4


@pytest.mark.parametrize("which", ["one_singular_limb", "further"])
def test_known_postures_of_codimension_four_lie_on_components(which: str) -> None:
    known = nao.expected()["constraint"][which]
    lengths = {"b1": 2.0, "r5": 1.0} | {
        name: float(x) for name, x in known["point"]["lengths"].items()
    }
    if which == "further":
        q2 = math.atan2(-lengths["r3"], lengths["d3"])
        angles = dict(zip(nao.VARIABLES, [0.4, q2, 0.6, 0.8, 0.2], strict=False))
        angles |= {"q6": 0.4, "q7": -1.7293546074325965, "q8": 0.7, "q9": 0.0}
        angles |= {"q10": 0.3}
    else:
        angles = {f"q{i}": x for i, x in known["point"]["own"].items()}
    at = lengths | angles
    limbs = nao.limbs_at(at)
    assert rank(limbs[0], 1e-6) == known["ranks"]["right"]
    assert rank(limbs[1], 1e-6) == known["ranks"]["left"]
    assert rank(loop_matrix(limbs), 1e-6) == known["ranks"]["loop"]
    constraint = nao.the_singularities().constraint
    on = closed_at([c.equations for c in constraint.components], at)
    assert not constraint.complete or np.min(on) < 1e-6


STRATA: dict[str, Sequence[str]] = {
    "generic": (),
    "sin(q4)=0": ("s4",),
    "sin(q4)=sin(q9)=0": ("s4", "s9"),
    "T2=0": ("T2",),
    "T2=0, sin(q9)=0, cos(q8)!=0": ("T2", "s9"),
    "T2=T7=0": ("T2", "T7"),
    "T2=T7=sin(q4)=0, cos(q3)!=0": ("T2", "T7", "s4"),
    "T2=T7=sin(q4)=sin(q9)=0": ("T2", "T7", "s4", "s9"),
    "T2=T7=sin(q4)=cos(q3)=0": ("T2", "T7", "s4", "cos(q3)"),
    "T2=T7=sin(q4)=cos(q3)=sin(q9)=cos(q8)=0": (
        "T2", "T7", "s4", "cos(q3)", "s9", "cos(q8)",
    ),
    "q6=q1": ("sD",),
    "T2=T7=0, q6=q1": ("T2", "T7", "sD"),
}  # fmt: skip


@pytest.mark.parametrize("stratum", STRATA)
def test_exact_ranks_on_strata(stratum: str) -> None:
    """The engine's branches against the reference, and against singular values."""
    known = nao.expected()["strata"][stratum]
    equations = [nao.NAMES.get(e, e) for e in STRATA[stratum]]
    assembly = nao.assembly()
    framed = assembly.common_twists
    ring = framed.ring
    branches = [assembly.root(ring)]
    for text in equations:
        condition = ring.normal(evaluate(parse(text), ring))
        branches = [
            new
            for old in branches
            for new in common_zeros(
                old, [old.value(condition)], Search(assembly.library(ring))
            ).branches
        ]
    assert branches
    columns = [[framed.column(j) for j in limb.joints] for limb in assembly.limbs]
    for branch in branches:
        state = loop_state(branch, columns)
        assert state is not None
        assert state.limbs == (known["rank_right"], known["rank_left"])
        assert state.loop == known["rank_loop"]
        assert state.mobility == known["mobility"]
        assert 6 - state.platform_freedom == known["dim_W"]
        assert state.platform_freedom == known["platform_twist_dimension"]
    at = posture_on(equations or ["0*q1"], nao.VARIABLES, nao.LENGTHS, 1)
    found = freedoms(nao.limbs_at(at), 1e-6)
    assert found.limbs == (known["rank_right"], known["rank_left"])
    assert found.loop == known["rank_loop"]


def test_printed_angles_without_the_offset_are_regular() -> None:
    """Table 2 of the paper put into Table 1 as printed: nothing is singular."""
    known = nao.expected()["strata"][
        "theta_2=atan(-r3/d3), theta_7=atan(r3/d3): the printed formula put into the "
        "angles of Table 1"
    ]
    slope = math.atan2(nao.LENGTHS["r3"], nao.LENGTHS["d3"])
    at = on_random(q2=-slope - math.pi / 2, q7=slope - math.pi / 2)
    found = freedoms(nao.limbs_at(at))
    assert (*found.limbs, found.loop) == (5, 5, 6)
    assert known["rank_loop"] == 6
    for limb in nao.the_singularities().limb:
        assert np.min(closed_at([c.equations for c in limb.components], at)) > 1e-3


def on_random(**angles: float) -> dict[str, float]:
    source = np.random.default_rng(8)
    drawn = source.uniform(-2.5, 2.5, 10)
    return {
        **nao.LENGTHS,
        **{name: float(x) for name, x in zip(nao.VARIABLES, drawn, strict=True)},
        **angles,
    }


# -- actuation: example 2 of the paper, joints 1, 2, 3 and 7 ------------------------

LOCKED = (("1", "2", "3"), ("7",))


def plane_condition(at: Posture) -> float:
    """(s4 × s5)·(B − A): the left wrist centre in the plane of axes 4 and 5."""
    right, left = nao.limbs_at(at)

    def meeting(limb: np.ndarray, i: int, j: int) -> np.ndarray:
        """The common point of two axes: p × s = m for both."""
        rows, targets = [], []
        for k in (i, j):
            s, m = limb[:3, k], limb[3:, k]
            rows.append(
                np.array([[0, s[2], -s[1]], [-s[2], 0, s[0]], [s[1], -s[0], 0]])
            )
            targets.append(m)
        solution = np.linalg.lstsq(np.vstack(rows), np.concatenate(targets), rcond=None)
        return np.asarray(solution[0])

    a, b = meeting(right, 2, 3), meeting(left, 2, 3)
    return float(np.cross(right[:3, 3], right[:3, 4]) @ (b - a))


def test_the_five_factors_of_example_two() -> None:
    actuation = nao.the_singularities().actuation
    assert actuation is not None
    assert actuation.actuated == ("1", "2", "3", "7")
    assert actuation.admissible
    hypersurfaces = [c for c in actuation.components if c.codimension == 1]
    (own,) = [c for c in hypersurfaces if len(c.equations[0]) > 40]
    others = sorted(c.equations[0] for c in hypersurfaces if c is not own)
    assert others == sorted([nao.NAMES["sD"], nao.NAMES["T2"]])
    idle = sorted(c.equations[0] for c in actuation.idle)
    assert idle == sorted([nao.NAMES["s9"], nao.NAMES["T7"]])
    ratios = []
    for seed in range(6):
        source = np.random.default_rng(seed)
        at = {
            **nao.LENGTHS,
            **{n: float(source.uniform(-3, 3)) for n in nao.VARIABLES},
        }
        ratios.append(value(own.equations[0], at) / plane_condition(at))
    assert np.ptp(ratios) < 1e-9 * max(map(abs, ratios))


def test_what_moves_on_each_factor_of_example_two() -> None:
    actuation = nao.the_singularities().actuation
    assert actuation is not None
    for components, moves in ((actuation.components, True), (actuation.idle, False)):
        for component in components:
            if component.codimension > 1:
                continue
            at = posture_on(component.equations, nao.VARIABLES, nao.LENGTHS, 4)
            found = freedoms(passive_at(at), 1e-6)
            assert found.mobility == component.mobility
            assert (found.platform > 0) is moves, component.equations


def passive_at(at: Posture) -> list[np.ndarray]:
    return [
        limb[:, [joint not in locked for joint in joints]]
        for limb, joints, locked in zip(
            nao.limbs_at(at), nao.LIMBS, LOCKED, strict=True
        )
    ]


def test_parts_are_given_as_soon_as_they_are_there() -> None:
    """What is known when time runs out: limbs one by one, actuation, constraints.

    The constraints are told while they are searched, and called incomplete till then.
    """
    parts: list[tuple[str, object]] = []
    answer = sk.singularities(
        sk.load("sarrus"), finished=lambda name, part: parts.append((name, part))
    )
    names = [f"limb {limb.limb}" for limb in answer.limb]
    told = [name for name, _ in parts]
    count = len(names)
    assert told[: count + 1] == [*names, "actuation"]
    assert set(told[count + 1 :]) == {"constraint"}
    assert [part for _, part in parts[: count + 1]] == [*answer.limb, answer.actuation]
    assert parts[-1] == ("constraint", answer.constraint)
    assert len(parts) > count + 2
    for _, early in parts[count + 1 : -1]:
        assert isinstance(early, ConstraintSingularities)
        assert early.components
        assert not early.complete
        assert "the search for more had not ended" in early.reason
        known = {c.equations for c in answer.constraint.components}
        assert {c.equations for c in early.components} <= known


def test_an_equation_whose_factors_are_not_certified_is_assumed_not_to_split() -> None:
    """That of the 3-RPS is too long to be proved irreducible over the root of 3."""
    answer = sk.singularities(sk.load("3rps"))
    assert answer.actuation is not None
    (component,) = answer.actuation.components
    terms = len(re.split(" [+-] ", component.equations[0]))
    assert f"that the equation of {terms} terms does not split" in answer.assumptions
    for name in ("3rpr_planar", "five_bar"):
        assumed = sk.singularities(sk.load(name)).assumptions
        assert not any("does not split" in text for text in assumed)


def test_one_component_alone_is_not_searched_for_meetings(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Deeper ranks on it are no intersection; those of seven-joint arms take long."""

    def never(*_: object) -> None:
        raise AssertionError("nothing meets the only component")

    monkeypatch.setattr("screwkit.analyses.singularities.limb_drop", never)
    assembly = sk.load("3rrr_planar").assembly
    found = limb_singularities(assembly, assembly.limbs[0])
    assert found.complete
    assert len(found.components) == 1
    assert found.intersections == ()


def test_postures_are_not_solved_for_dimensions() -> None:
    case = sk.load("3rrr_planar")
    dimensions = {p.name for p in case.mechanism.parameters if not p.free}
    solved = [
        solution.variable
        for component in sk.singularities(case).constraint.components
        for solution in component.solved
        if solution is not None
    ]
    assert len(solved) > 9
    assert not dimensions & set(solved)


def test_nothing_is_divided_by_what_vanishes_there() -> None:
    """With θ1 = 0 or π, x·sin θ1 − y·cos θ1 = 0 says y = 0, and nothing of x."""
    found = sk.singularities(sk.load("3rrr_planar")).constraint.components
    (upright,) = (c for c in found if "sin(theta1)" in c.equations)
    solution = upright.solved[upright.equations.index("y")]
    assert solution is not None
    assert (solution.variable, solution.values) == ("y", ("0",))
    assert "x" not in {s.variable for s in upright.solved if s is not None}
