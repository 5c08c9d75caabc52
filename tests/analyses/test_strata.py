"""Where singularities meet: ranks by singular values at real postures, and by hand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations

import numpy as np
import pytest
from kinematics.float_loops import FloatLoops, counted
from loci.numeric import Array, value
from one_answer import with_strata
from one_process import grouped
from scipy.optimize import least_squares
from typer.testing import CliRunner

import screwkit as sk
from screwkit.case import load_text
from screwkit.commands import app
from screwkit.kinematics.whole_graph import WholeGraph
from screwkit.loci.graph_states import GraphStates
from screwkit.reports.article import article
from screwkit.reports.records import from_json, to_json
from screwkit.reports.verdict import is_plain_yes
from screwkit.results.singularities import Component, Singularities
from screwkit.results.strata import Member, Strata, Stratum

CASES = (
    "nao_t14",
    "3prs",
    "3upu_tsai",
    "2upr_rpu",
    "five_bar",
    "four_bar_planar",
    "isoglide4_t3r1",
    "spherical_four_bar",
    "sarrus",
)
GAP = 1e5
ROW = "5 (2 and 4) 4, 4 3, not 4 3 (0T3R) 0, not 1 generally"
NOTHING = 1e-12


@dataclass(frozen=True)
class Posed(FloatLoops):
    """The loop equations at a posture of one's own."""

    posed: Mapping[str, float] = field(default_factory=dict)

    @cached_property
    def values(self) -> dict[str, float]:
        return {**super().values, **self.posed}


def component_of(answer: Singularities, member: Member) -> Component:
    if member.part == "limb":
        (limb,) = (x for x in answer.limb if x.limb == member.limb)
        return limb.components[member.component]
    part = answer.constraint if member.part == "constraint" else answer.actuation
    assert part is not None
    return part.components[member.component]


def rank(matrix: Array) -> int:
    """By singular values; columns are of unit size, so that rounding is nothing."""
    if matrix.size and np.max(np.abs(matrix)) < NOTHING:
        return 0
    found = counted(matrix)
    assert found.gap > GAP, f"no clear gap: {found}"
    return found.rank


@pytest.mark.parametrize("name", grouped("strata of", *CASES))
def test_singular_values_at_a_real_posture_agree(name: str) -> None:
    """All numbers of a stratum, from twists that are written down in floats."""
    answer, strata = with_strata(name)
    case = sk.load(name)
    mechanism = case.mechanism
    locked = () if answer.actuation is None else answer.actuation.actuated
    ends = mechanism.platform, mechanism.base
    looked_at = 0
    for one in strata.strata:
        if one.real == "undecided":
            continue
        looked_at += 1
        loops = Posed(mechanism, posed=dict(one.posture))
        state = one.state
        for limb, expected in zip(answer.limb, state.limb_ranks, strict=True):
            twists = np.array([loops.twists[joint] for joint in limb.joints])
            assert rank(twists.T) == expected
        assert rank(loops.body_twists(*ends)) == state.platform_freedom
        if locked:
            left = loops.body_twists(*ends, locked)
            assert rank(left) == state.locked_freedom
        matrix = loops.loop_matrix()
        assert matrix.shape[1] - rank(matrix) == state.mobility
        for member in one.members:
            for text in component_of(answer, member).equations:
                assert value(text, loops.values) == pytest.approx(0, abs=1e-9)
    assert looked_at >= len(strata.strata) / 2


def test_the_constraint_singularity_of_the_two_arms() -> None:
    """[LongCaroKhalil2012] §5.2.1: both wrist centres on the shoulder axes.

    "Four wrenches forming a 3-system … the object has 3-DOF"; each arm alone suggests
    four independent wrenches.
    """
    answer, strata = with_strata("nao_t14")
    (one,) = (
        s for s in strata.strata if Member("constraint", "", 0) in s.itself and s.around
    )
    assert component_of(answer, one.itself[0]).equations == (
        "r3*cos(q2) + d3*sin(q2)",
        "r3*cos(q7) - d3*sin(q7)",
    )
    assert one.state.limb_ranks == (4, 4)
    assert one.state.wrench_dimension == 3
    assert one.state.platform_freedom == 3
    assert one.expected is not None
    assert one.expected.wrench_dimension == 4
    assert one.differs
    assert {m.limb for m in one.around} == {"right", "left"}


def test_arms_that_lose_a_freedom_each_add_up() -> None:
    """With axes 3 and 5 one line, and 8 and 10, the four wrenches are independent."""
    answer, strata = with_strata("nao_t14")
    wanted = {Member("limb", "right", 0), Member("limb", "left", 0)}
    assert component_of(answer, Member("limb", "right", 0)).equations == ("sin(q4)",)
    assert component_of(answer, Member("limb", "left", 0)).equations == ("sin(q9)",)
    (one,) = (s for s in strata.strata if set(s.members) == wanted)
    assert (one.state.wrench_dimension, one.state.platform_freedom) == (4, 2)
    assert not one.differs


def test_two_sets_on_which_the_same_conditions_hold() -> None:
    """Limb E, D, C is stretched and B, C, D are in line: two ways to be both.

    All four points in line, where B turns against C and D with A and E locked; or C at
    D, where C and D turn against each other and nothing holds B off their line of two.
    """
    _, strata = with_strata("five_bar")
    wanted = {Member("limb", "limb_2", 0), Member("actuation", "", 0)}
    line, point = (s for s in strata.strata if set(s.members) == wanted)
    assert line.codimension == point.codimension == 2
    assert set(point.equations) == {"xc - xd", "yc - yd"}
    assert line.state.locked_freedom == 1
    assert point.state.locked_freedom == 0
    at = dict(line.posture)
    arms = [(at[f"x{p}"] - at["d"], at[f"y{p}"]) for p in "bcd"]
    for (x, y), (u, v) in combinations(arms, 2):
        assert x * v - y * u == pytest.approx(0, abs=1e-9)
    assert (at["xc"], at["yc"]) != pytest.approx((at["xd"], at["yd"]), abs=1e-3)


def test_parallel_legs_of_the_flat_platform_of_tsai() -> None:
    """Legs in the plane of the base: the state is the same at all such postures."""
    _, strata = with_strata("3upu_tsai")
    (flat,) = (s for s in strata.strata if s.equations == ("z",))
    assert flat.holds == "everywhere"
    mechanism = sk.load("3upu_tsai").mechanism
    source = np.random.default_rng(4)
    for _ in range(8):
        x, y = source.uniform(-4, 4, 2)
        loops = Posed(mechanism, posed={"x": x, "y": y, "z": 0.0})
        assert rank(loops.body_twists("platform", "base")) == 4
        left = loops.body_twists("platform", "base", ("P12", "P22", "P32"))
        assert rank(left) == 2


@pytest.mark.parametrize(
    "name", grouped("strata of", "five_bar", "isoglide4_t3r1", "four_bar_planar")
)
def test_what_is_everywhere_does_not_change_and_generally_does(name: str) -> None:
    """Another state on a stratum inside shows that a state is not everywhere."""
    _, strata = with_strata(name, 3)
    for one in strata.strata:
        for inner in strata.strata:
            inside = set(one.members) < set(inner.members)
            if inside and one.holds == "everywhere":
                assert inner.state == one.state


@pytest.mark.parametrize(
    "name", grouped("strata of", "3prs", "five_bar", "2upr_rpu", "isoglide4_t3r1")
)
def test_every_pair_that_meets_is_listed(name: str) -> None:
    """Common zeros of two components are looked for in numbers, by least squares."""
    _, strata = with_strata(name)
    alone = [s for s in strata.strata if s.codimension <= 2 and not s.around]
    mechanism = sk.load(name).mechanism
    start = Posed(mechanism).values
    for one, other in combinations(alone, 2):
        if one.codimension + other.codimension > strata.deepest:
            continue
        both = {*one.members, *other.members}
        texts = [*one.equations, *other.equations]
        found = common_zero(
            texts, start, [p.name for p in mechanism.parameters if p.free]
        )
        if found is None:
            continue
        assert any(
            both <= set(s.members)
            and all(abs(value(e, found)) < 1e-6 for e in s.equations)
            for s in strata.strata
        ), (one.equations, other.equations)


def common_zero(
    texts: list[str], start: Mapping[str, float], free: list[str]
) -> dict[str, float] | None:
    source = np.random.default_rng(11)

    def residuals(x: Array) -> list[float]:
        at = {**start, **dict(zip(free, map(float, x), strict=True))}
        return [value(text, at) for text in texts]

    for _ in range(12):
        found = least_squares(
            residuals, source.uniform(-2, 2, len(free)), xtol=1e-15, ftol=1e-15
        )
        if max(map(abs, found.fun)) < 1e-10:
            return {**start, **dict(zip(free, map(float, found.x), strict=True))}
    return None


def described(strata: Strata) -> set[tuple[frozenset[Member], int]]:
    return {(frozenset(s.members), s.codimension) for s in strata.strata}


@pytest.mark.xdist_group("strata of isoglide4_t3r1")
def test_three_at_once_add_to_two_at_once() -> None:
    _, two = with_strata("isoglide4_t3r1", 2)
    _, three = with_strata("isoglide4_t3r1", 3)
    assert described(two) < described(three)
    assert (two.together, three.together) == (2, 3)


def test_one_at_once_is_the_components_themselves() -> None:
    answer, strata = with_strata("five_bar", 1)
    assert all(s.itself for s in strata.strata)
    components = sum(len(x.components) for x in answer.limb)
    components += len(answer.constraint.components)
    assert answer.actuation is not None
    components += len(answer.actuation.components)
    assert sum(len(s.itself) for s in strata.strata) == components


def test_the_answer_goes_to_json_and_back() -> None:
    answer, strata = with_strata("3prs")
    again = from_json(to_json(answer))
    assert isinstance(again, Singularities)
    assert again.strata == strata


def test_the_text_says_what_is_new_and_how_far_it_looked() -> None:
    answer, _ = with_strata("nao_t14")
    text = str(answer)
    assert "TOGETHER   where several of these conditions hold at once" in text
    assert "up to 2 conditions, codimension up to 4" in text
    row = next(line for line in text.splitlines() if line.strip().startswith("5 (2"))
    assert " ".join(row.split()) == ROW


def test_a_mechanism_without_conditions_has_none_together() -> None:
    answer, strata = with_strata("lone_body")
    assert strata.strata == ()
    assert "no two of them meet" in str(answer)


def test_the_article_has_a_table_of_them() -> None:
    analysis = sk.analyze(sk.load("five_bar"), strata=2)
    written = str(article(analysis))
    assert "Where singularities meet" in written
    assert "table:strata" in written


ARM = """\
screwkit: 1
name: arm
title: Four hinges, of which 1 and 3 can be one line, and then 2 and 4 parallel
geometry: mdh
base: ground
platform: hand
links: [ground, one, two, three, hand]
parameters: {b: {value: 0.3, positive: true}, c: {value: 0.3, positive: true}}
joints:
- {name: A1, type: revolute, parent: ground, child: one, mdh: {alpha: pi/2, d: b}}
- {name: A2, type: revolute, parent: one, child: two, mdh: {alpha: pi/2}}
- {name: A3, type: revolute, parent: two, child: three, mdh: {alpha: pi/2, r: c}}
- {name: A4, type: revolute, parent: three, child: hand, mdh: {alpha: pi/2}}
"""


@pytest.mark.parametrize("as_graph", [False, True])
def test_a_translation_that_some_postures_have_is_not_everywhere(
    as_graph: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With q2 = 0 three rotations are left; with q3 = 0 two of them are parallel."""
    if as_graph:
        monkeypatch.setattr(
            "screwkit.questions._states",
            lambda case, _: GraphStates(WholeGraph(case.mechanism), None),
        )
    strata = sk.singularities(load_text(ARM), strata=1).strata
    assert strata is not None
    (flat,) = strata.strata
    assert flat.equations == ("sin(qA2)",)
    assert flat.state.motion_type == "0T3R"
    assert flat.holds == "generally"


def test_what_is_left_open_is_told_and_makes_the_answer_undecided() -> None:
    answer, strata = with_strata("3prs")
    assert not strata.complete
    assert "too long to be intersected" in strata.reason
    assert strata.reason in " ".join(str(answer).split())
    whole, met = with_strata("five_bar")
    assert met.complete
    assert is_plain_yes(whole)
    opened = replace(met, complete=False, reason="something is open")
    assert not is_plain_yes(replace(whole, strata=opened))


SWUNG = """
screwkit: 1
name: swung
space: planar
geometry: posture
base: base
platform: platform
links: [base, platform, slider, rod, crank, link]
parameters:
  l: {value: 2, positive: true}
variables:
  x: 0.3
  y: 0.7
  s: 0.5
  phi: {value: 0.2, angle: true}
  theta: {value: 2.1, angle: true}
pose: {translation: [x, y], rotation: {axis: z, angle: phi}}
vectors:
  u: [cos(theta), sin(theta)]
  d: [3, 4]
points:
  A: [4, 0]
  B: {link: platform, at: [1, 0]}
  C: A + l*u
  D: s*d
  P: {link: platform, at: [0, 0]}
joints:
  - {name: P1, type: prismatic, parent: base, child: slider, axis: d}
  - {name: R1, type: revolute, parent: slider, child: rod, point: D}
  - {name: R2, type: revolute, parent: rod, child: platform, point: P}
  - {name: A, type: revolute, parent: base, child: crank, point: A}
  - {name: C, type: revolute, parent: crank, child: link, point: C}
  - {name: B, type: revolute, parent: link, child: platform, point: B}
actuated: [P1, R1, A]
"""


def test_equations_of_a_stratum_hold_on_all_its_conditions_alone() -> None:
    """By hand: C and B in one point are on two conditions, in one height on neither.

    The arm A C B is singular where its points are on one line, the platform moves where
    P, C and B are.  Turned upright (phi = 0) the latter says that C and B are equally
    high, whatever x is, and the arm is bent.
    """
    answer = sk.singularities(load_text(SWUNG), strata=2)
    assert answer.strata is not None
    arm = {"A", "C", "B"}
    name = next(one.limb for one in answer.limb if arm == set(one.joints))
    on_both = [
        one
        for one in answer.strata.strata
        if {m.part for m in one.members} == {"limb", "actuation"}
        and {m.limb for m in one.members} == {name, ""}
    ]
    assert len(on_both) == 2

    def met(posture: Mapping[str, float]) -> int:
        at = {"l": 2.0, "s": 0.1, **posture}
        return sum(
            max(abs(value(text, at)) for text in one.equations) < NOTHING
            for one in on_both
        )

    theta = 0.7
    height, reach = 2 * np.sin(theta), 4 + 2 * np.cos(theta)
    bent = {"phi": 0.0, "theta": theta, "x": 1.3, "y": height}
    assert met(bent) == 0
    for phi in (0.4, 2.0):
        in_one_point = {"x": reach - np.cos(phi), "y": height - np.sin(phi)}
        assert met({"phi": phi, "theta": theta, **in_one_point}) == 1


def test_a_slice_has_no_strata() -> None:
    ran = CliRunner().invoke(
        app,
        ["singularities", "3rpr_planar", "--strata", "2", "--slice", "x=0:1"],
    )
    assert ran.exit_code == 2
    assert "--strata is of the whole loci" in ran.output


def flagged(strata: Strata) -> list[Stratum]:
    return [s for s in strata.strata if s.differs]


def test_a_flag_is_raised_where_and_only_where_numbers_differ() -> None:
    _, strata = with_strata("3prs")
    assert flagged(strata)
    for one in strata.strata:
        if one.expected is None:
            assert not one.differs
            continue
        state, expected = one.state, one.expected
        same = (
            state.limb_ranks == expected.limb_ranks
            and state.platform_freedom == expected.platform_freedom
            and state.locked_freedom == expected.locked_freedom
        )
        assert one.differs is not same
