"""Mobility: published counts of the NAO's arms, motion types and partitions.

Motion types come from numbers alone, partitions from what constraint wrenches leave.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from kinematics.random_mechanisms import (
    left_by_constraints,
    mechanism_of,
    random_mechanism,
)
from kinematics.random_mechanisms import (
    rank as rational_rank,
)
from loci import nao
from loci.numeric import Array, Posture, rank, values
from loci.test_tied_loci import FOUR_BAR
from scipy.linalg import null_space

from screwkit.analyses.mobility import mobility
from screwkit.case import load, load_text
from screwkit.kinematics.network import Network
from screwkit.mechanism.joints import CATALOGUE
from screwkit.mechanism.model import Joint, JointType, Mechanism
from screwkit.results.mobility import Mobility


def test_the_counts_are_those_of_the_literature() -> None:
    known = nao.expected()["mobility"]
    found = nao.the_mobility()
    counts = found.counts
    assert counts.grubler == known["grubler"]
    assert counts.moroskine == known["moroskine"]
    assert counts.gogu == known["gogu"]["value"]
    assert counts.screw == known["screw"]
    assert counts.grubler_planar is None
    assert found.loop_rank == known["loop_rank"]
    assert found.redundant_constraints == 0
    assert found.instantaneous_mobility == 10 - known["loop_rank"]
    assert found.platform.twist_dimension == known["platform_twist_dimension"]
    assert found.platform.motion_type == "1T3R"
    assert (found.platform.wrench_dimension, found.platform.couples) == (2, 0)
    assert (found.topology.links, found.topology.joints) == (12, 12)
    assert (found.topology.freedoms, found.topology.independent_loops) == (10, 1)


def test_the_choice_of_bases_in_gogus_formula_is_counted() -> None:
    known = nao.expected()["mobility"]["gogu"]
    working = next(w for w in nao.the_mobility().workings if w.name == "Gogu")
    for number in ("pairs_of_coordinate_bases", "pairs_giving_4", "pairs_giving_5"):
        assert str(known[number]) in working.remark.split()


def test_declared_scheme_leaves_nothing_movable() -> None:
    actuation = nao.the_mobility().actuation
    assert actuation is not None
    assert actuation.actuated == ("1", "2", "3", "7")
    assert (actuation.remaining_mobility, actuation.remaining_platform_freedom) == (
        0,
        0,
    )


def posture(**angles: float) -> dict[str, float]:
    """A regular posture of both arms with some angles replaced."""
    given = [0.3, -0.4, 0.7, 1.1, 0.2, 1.3, 0.5, -0.6, 0.9, -1.2]
    default = dict(zip(nao.VARIABLES, given, strict=True))
    return {**nao.LENGTHS, **default, **angles}


PHI = math.atan2(nao.LENGTHS["d3"], nao.LENGTHS["r3"])
MOTIONS = {
    "generic": posture(),
    "q6=q1": posture(q6=0.3),
    "q6=q1+pi": posture(q6=0.3 + math.pi),
    "q6=q1, q7=q2-2*phi": posture(q6=0.3, q7=-0.4 - 2 * PHI),
    "q6=q1, q7=q2-2*phi+pi": posture(q6=0.3, q7=-0.4 - 2 * PHI + math.pi),
    "q6=q1+pi, q7=-q2": posture(q6=0.3 + math.pi, q7=0.4),
    "q6=q1+pi, q7=pi-q2": posture(q6=0.3 + math.pi, q7=math.pi + 0.4),
    "mirror pose": posture(q6=0.3, q7=0.4, q8=-0.7, q9=-1.1),
    "mirror pose, q2=phi": posture(q6=0.3, q2=PHI, q7=-PHI, q8=-0.7, q9=-1.1),
}


def motion_type(at: Posture) -> str:
    """NTmR of the common twists of both arms, from null spaces."""
    right, left = nao.limbs_at(at)
    wrenches = np.hstack([null_space(right.T), null_space(left.T)])
    twists: Array = null_space(wrenches.T)
    turning = rank(twists[:3])
    return f"{twists.shape[1] - turning}T{turning}R"


@pytest.mark.parametrize("name", MOTIONS)
def test_motion_type_of_the_case_that_holds(name: str) -> None:
    """The most special case whose conditions vanish tells the type found by numbers."""
    at = MOTIONS[name]
    holding = [
        case
        for case in nao.the_mobility().platform.cases
        if np.all(np.abs(values(case.conditions, at)) < 1e-9)
    ]
    told = max(holding, key=lambda case: len(case.conditions)).motion_type
    assert told == motion_type(at) == nao.expected()["motion"]["exact_checks"][name]


def test_no_other_posture_is_special() -> None:
    """Regular postures drawn at random, and on q6 = q1: 1T3R, and told so."""
    source = np.random.default_rng(3)
    for number in range(20):
        angles = dict(zip(nao.VARIABLES, source.uniform(-3, 3, 10), strict=True))
        if number % 2:
            angles["q6"] = angles["q1"]
        at = {**nao.LENGTHS, **{name: float(x) for name, x in angles.items()}}
        assert motion_type(at) == "1T3R"
        for case in nao.the_mobility().platform.cases:
            if case.motion_type != "1T3R":
                assert np.max(np.abs(values(case.conditions, at))) > 1e-6


def test_finite_motion_is_proved() -> None:
    full_cycle = nao.the_mobility().full_cycle
    assert full_cycle.mobility == (4,)
    assert full_cycle.status == "proved"


def connected(seed: int) -> Mechanism:
    """A random mechanism whose platform is connected with its base."""
    while True:
        mechanism = random_mechanism(seed, 4, 2)
        network = Network(mechanism)
        if network.connected(mechanism.base, mechanism.platform):
            return mechanism
        seed += 1000


def twists_left(mechanism: Mechanism) -> tuple[int, int]:
    """Mobility, and the platform's freedoms, with no loop and no twist."""
    roots = [group[0] for group in Network(mechanism).components]
    found = left_by_constraints(mechanism, roots)
    relative = found.between(mechanism.platform, mechanism.base)
    return found.mobility, rational_rank(relative)


@pytest.mark.parametrize("seed", range(10))
def test_partition_by_its_definition(seed: int) -> None:
    """[BicchiMelchiorri] §8: whole, platform, platform held, all but contacts held."""
    mechanism = connected(seed)
    partition = mobility(Network(mechanism)).partition
    assert (partition.mobility, partition.connectivity) == twists_left(mechanism)
    grip = Joint("grip", JointType.FIXED, mechanism.base, mechanism.platform)
    held = replace(mechanism, joints=(*mechanism.joints, grip))
    assert partition.redundancy == twists_left(held)[0]
    stiff = tuple(
        j if CATALOGUE[j.type].contact else replace(j, type=JointType.FIXED)
        for j in mechanism.joints
    )
    slipping = replace(mechanism, joints=stiff)
    assert partition.indeterminacy == twists_left(slipping)[1]


def test_loose_bodies_are_named() -> None:
    found = mobility(Network(mechanism_of([], ["ground", "one", "two"])))
    assert found.loose_bodies == ("one", "two")
    assert found.topology.components == 3
    assert found.platform.twist_dimension == 6
    assert nao.the_mobility().loose_bodies == ()


def test_loops_that_restrain_no_joint_have_no_others_to_follow_from() -> None:
    text = (
        "screwkit: 1\nname: welds\ntitle: Three bodies in one piece\n"
        "geometry: posture\nbase: a\nplatform: b\nlinks: [a, b, c]\njoints:\n"
        "  - {name: ab, type: fixed, parent: a, child: b}\n"
        "  - {name: bc, type: fixed, parent: b, child: c}\n"
        "  - {name: ca, type: fixed, parent: c, child: a}\n"
    )
    answer = mobility(load_text(text).network)
    assert answer.redundant_constraints == 6
    told = answer.workings[0].remark
    assert told == "none of the 6 closure equations restrains a joint"


def test_samples_say_that_contacts_were_not_rolled() -> None:
    # Two sliders along one line press on a plate: whether it goes on moving after the
    # first instant depends on how the fingertips are curved.
    text = (
        "screwkit: 1\nname: pinch\ntitle: A plate between two slides\n"
        "geometry: posture\nbase: g\nplatform: plate\nlinks: [g, a, b, plate]\n"
        "joints:\n"
        "  - {name: left, type: prismatic, parent: g, child: a, axis: [1, 0, 0]}\n"
        "  - {name: tip, type: {TIP}, parent: a, child: plate, point: [1, 0, 0], "
        "{NORMAL}: [1, 0, 0]}\n"
        "  - {name: right, type: prismatic, parent: g, child: plate, axis: [1, 0, 0]}\n"
        "  - {name: rail, type: prismatic, parent: g, child: b, axis: [0, 1, 0]}\n"
        "  - {name: edge, type: {TIP}, parent: b, child: plate, point: [3, 0, 1], "
        "{NORMAL}: [0, 0, 1]}\n"
    )
    tips = text.replace("{TIP}", "point").replace("{NORMAL}", "normal")
    touched = mobility(load_text(tips).network).full_cycle
    joints = text.replace("{TIP}", "planar").replace("{NORMAL}", "normal")
    joints = joints.replace("point: [1, 0, 0], ", "").replace("point: [3, 0, 1], ", "")
    jointed = mobility(load_text(joints).network).full_cycle
    assert "rolling" in touched.reason
    assert "rolling" not in jointed.reason


def test_connectivity_of_the_arms() -> None:
    """Along a limb each body has at most one freedom more than the one before."""
    connectivity = nao.the_mobility().connectivity
    assert connectivity is not None
    place = {body: i for i, body in enumerate(connectivity.bodies)}
    mechanism = nao.mechanism()
    for joint in mechanism.joints:
        row = connectivity.table[place[joint.parent]]
        assert row[place[joint.child]] <= len(joint.variables)
    base, end = place[mechanism.base], place[mechanism.platform]
    assert connectivity.table[base][end] == nao.the_mobility().platform.twist_dimension


def test_special_values_are_pointed_out() -> None:
    """Where the legs are parallel, ranks and freedoms are not those of the rest."""
    usual = mobility(Network(load("3upu_tsai").mechanism))
    special = mobility(Network(load("3upu_tsai", variant="parallel_legs").mechanism))
    assert usual.at_values is not None
    assert special.at_values is not None
    assert usual.at_values.differences == ()
    assert special.loop_rank == usual.loop_rank > special.at_values.loop_rank
    assert any("loop rank" in each for each in special.at_values.differences)


def test_what_ranks_tell_is_there_before_finite_motion() -> None:
    """A deadline leaves the counts: of a 3-RPR by hand, nothing of finite motion."""
    parts: dict[str, Mobility] = {}
    whole = mobility(load("3rpr_planar").network, finished=parts.__setitem__)
    (early,) = parts.values()
    assert early.counts == whole.counts
    # 9 joints less 2 loops of three equations each; the platform moves in the plane.
    assert (early.loop_rank, early.instantaneous_mobility) == (6, 3)
    assert early.platform.motion_type == "2T1R"
    assert early.full_cycle.status == "undecided"
    assert early.full_cycle.reason == "finite motion was not looked at yet"
    assert "not looked at yet" in early.unnamed
    assert whole.full_cycle.status != "undecided"
    assert not whole.unnamed


def test_ranks_of_a_posture_are_no_part_where_loops_tie_joints() -> None:
    """On the motion through it they may be others."""
    parts: dict[str, Mobility] = {}
    mobility(load_text(FOUR_BAR).network, finished=parts.__setitem__)
    assert not parts
