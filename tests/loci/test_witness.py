"""Why schemes are never admissible: sentences against mobility and by construction."""

from __future__ import annotations

import re
from functools import cache

import numpy as np
import pytest

import screwkit as sk
from screwkit.metrics.posture_samples import posture_sample
from screwkit.results.mobility import Mobility
from screwkit.results.schemes import Scheme

HOLDS_NOTHING = re.compile(r"actuator (\S+) holds nothing")
SAME_FREEDOM = re.compile(
    r"actuators (\S+) and (\S+) hold the same freedom: .* keeps (\S+)$"
)
TOO_FEW = re.compile(r"actuators (.+) together hold (\d) freedoms only")
PARALLEL = re.compile(
    r"^the platform can (translate|turn about a line) parallel to (?:axis|slide) (\S+):"
)


@cache
def refused(name: str, size: int | None = None) -> tuple[Scheme, ...]:
    answer = sk.schemes(sk.load(name), size=size, work=0)
    return tuple(s for s in answer.schemes if not s.admissible)


@cache
def held(name: str, locked: tuple[str, ...]) -> int:
    """Freedoms that locked joints take from the platform, by mobility."""
    answer = sk.mobility(sk.load(name, actuated=list(locked)))
    assert isinstance(answer, Mobility)
    assert answer.actuation is not None
    platform = answer.platform.twist_dimension
    return platform - answer.actuation.remaining_platform_freedom


def wasted_in(reason: str) -> tuple[tuple[str, ...], int] | None:
    """The actuators that a reason names, and how many freedoms they hold."""
    if found := HOLDS_NOTHING.match(reason):
        return (found[1],), 0
    if found := SAME_FREEDOM.match(reason):
        return (found[1], found[2]), 1
    if found := TOO_FEW.match(reason):
        return tuple(re.split(r", | and ", found[1])), int(found[2])
    return None


@pytest.mark.parametrize("name", ["tricept", "isoglide4_t3r1", "3upu_tsai"])
def test_wasted_actuators_take_what_mobility_says(name: str) -> None:
    checked: set[tuple[str, ...]] = set()
    for scheme in refused(name):
        found = wasted_in(scheme.reason or "")
        if found is None:
            continue
        group, taken = found
        assert set(group) <= set(scheme.actuated)
        if group not in checked and len(checked) < 5:
            checked.add(group)
            assert held(name, group) == taken < len(group)
            for joint in group:
                assert held(name, (joint,)) == min(taken, 1)
    assert checked


def test_a_joint_that_holds_nothing_is_named_in_each_of_its_schemes() -> None:
    idle = {j for j in sk.load("tricept").assembly.joints if not held("tricept", (j,))}
    assert idle
    for scheme in refused("tricept"):
        found = HOLDS_NOTHING.match(scheme.reason or "")
        assert (found is not None) is bool(idle & set(scheme.actuated))
        assert found is None or found[1] in idle


def test_a_passive_slide_of_the_tripteron_lets_it_go() -> None:
    """Limb k alone fixes coordinate k, and does so by its slide alone.

    With the other two coordinates held its turning joints add nothing, and the
    platform slides along k.
    """
    reasons = {s.actuated: s.reason or "" for s in refused("tripteron")}
    assert len(reasons) == 30
    for actuated, reason in reasons.items():
        found = PARALLEL.match(reason)
        assert found is not None, reason
        assert found[1] == "translate"
        assert found[2] in {"P11", "P21", "P31"} - set(actuated)


def test_the_one_rotation_is_held_twice() -> None:
    """R15, R25 and R35 turn the platform of isoglide4, which has 3T1R, by one angle."""
    reason = next(
        s.reason for s in refused("isoglide4_t3r1") if {"R15", "R25"} <= set(s.actuated)
    )
    assert reason == (
        "actuators R15 and R25 hold the same freedom: with one or both locked the "
        "platform keeps 3T0R"
    )


@pytest.mark.parametrize("name", ["hand_three_soft", "dymo", "isoglide4_t3r1"])
def test_named_directions_are_those_of_the_motion_left(name: str) -> None:
    """Floats at a random posture: the null space of the passive columns."""
    case = sk.load(name)
    assembly = case.assembly
    twists = posture_sample(case.mechanism, 1, {}).twists
    columns = twists.of(assembly.joints, 1.0)[0]
    place = {joint: k for k, joint in enumerate(assembly.joints)}
    named = [
        (s, found) for s in refused(name) if (found := PARALLEL.match(s.reason or ""))
    ]
    assert named
    for scheme, found in named[:: max(1, len(named) // 12)]:
        limbs = [
            [j for j in limb.joints if j not in scheme.actuated]
            for limb in assembly.limbs
        ]
        order = [j for limb in limbs for j in limb]
        loops = np.zeros((6 * (len(limbs) - 1), len(order)))
        for number, limb in enumerate(limbs):
            for joint in limb:
                column = columns[place[joint]]
                for loop in range(len(limbs) - 1):
                    if number in (0, loop + 1):
                        rows = slice(6 * loop, 6 * loop + 6)
                        sign = 1 if number == 0 else -1
                        loops[rows, order.index(joint)] = sign * column
        _, sizes, right = np.linalg.svd(loops)
        rank = int((sizes > 1e-9 * sizes[0]).sum())
        first = len(limbs[0])
        spanned = columns[[place[j] for j in limbs[0]]].T @ right[rank:, :first].T
        left, sizes, _ = np.linalg.svd(spanned)
        assert sizes[0] > 1e-9
        assert not (sizes[1:] > 1e-9).any()
        half = slice(3, 6) if found[1] == "translate" else slice(0, 3)
        along = columns[place[found[2]]]
        along = along[:3] if along[:3].any() else along[3:]
        assert np.linalg.norm(np.cross(left[half, 0], along)) < 1e-8
        if found[1] == "translate":
            assert np.linalg.norm(left[:3, 0]) < 1e-8


def test_fewer_actuators_than_freedoms_are_told_so() -> None:
    reasons = {s.reason for s in refused("five_bar", 1)}
    assert reasons == {"1 actuator cannot hold the platform's 2 freedoms"}
