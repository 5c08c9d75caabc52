"""Remaining freedoms: each closes every loop, the idle ones leave the platform."""

from __future__ import annotations

from pathlib import Path

import pytest
from reasons.made import (
    ALL,
    Made,
    four_bar,
    rssr,
    scrambled,
    six_rods,
    two_parallelogram_limbs,
    with_pendulum,
)

from screwkit.algebra.modular import rank
from screwkit.kinematics.network import Motion, Network
from screwkit.mechanism.files import read_mechanism
from screwkit.reasons.named_freedoms import NamedFreedom, named_freedoms
from screwkit.reasons.readable_screws import kind_of

CASES = sorted((Path(__file__).parents[2] / "cases").glob("*.yaml"))
MADE = [pytest.param(make(), id=name) for name, make in ALL.items()]


def check(motion: Motion) -> None:
    network, prime = motion.network, motion.posture.prime
    freedoms = named_freedoms(motion)
    assert len(freedoms) == motion.mobility
    rows = [[one.rates.get(x, 0) for x in network.labels] for one in freedoms]
    assert rank(rows, prime) == len(freedoms)
    platform = network.mechanism.platform
    for one in freedoms:
        for loop in network.loops:
            total = [0] * 6
            for joint, sign in loop:
                for label in network.labels_of[joint]:
                    rate = sign * one.rates.get(label, 0)
                    twist = motion.posture.twists[label]
                    total = [a + rate * x for a, x in zip(total, twist, strict=True)]
            assert not any(x % prime for x in total)
        twists = motion.body_twists(one.rates)
        if network.connected(network.mechanism.base, platform):
            assert one.idle is not any(twists[platform])
        assert set(one.bodies) == {body for body, twist in twists.items() if any(twist)}
        if not one.idle:
            assert one.twist == tuple(twists[platform])
        elif one.twist:
            assert {tuple(twists[body]) for body in one.bodies} == {one.twist}
    driven = [list(one.twist) for one in freedoms if not one.idle]
    if not network.connected(network.mechanism.base, platform):
        assert not driven
        return
    assert len(driven) == len(motion.platform_twists)
    assert rank([*driven, *motion.platform_twists], prime) == len(driven)


@pytest.mark.parametrize("made", MADE)
def test_made(made: Made) -> None:
    check(Network(made.mechanism).motion)
    check(Network(scrambled(made, 4).mechanism).motion)


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_cases(path: Path) -> None:
    network = Network(read_mechanism(path))
    check(network.motion)
    if network.at_values is not None:
        check(network.at_values.motion)


def idle(made: Made) -> list[tuple[list[str], list[str], str]]:
    """Joints, bodies and kind of the idle freedoms."""
    motion = Network(made.mechanism).motion
    joint_of = motion.network.joint_of
    return sorted(
        (
            sorted({joint_of[label] for label in one.rates}),
            sorted(one.bodies),
            kind_of(one.twist, motion.posture.prime) if one.twist else "",
        )
        for one in named_freedoms(motion)
        if one.idle
    )


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("made", MADE)
def test_idle_freedoms_belong_to_the_mechanism(made: Made, seed: int) -> None:
    assert idle(scrambled(made, seed)) == idle(made)


def test_every_rod_spins_by_itself() -> None:
    assert idle(six_rods()) == [
        ([f"A{i}", f"B{i}"], [f"rod{i}"], "line") for i in range(1, 7)
    ]
    assert idle(rssr()) == [(["s1", "s2"], ["rod"], "line")]


def test_parts_that_move_by_themselves() -> None:
    """A pendulum swings, a ball at its end turns in three ways; the loop keeps out."""
    assert idle(with_pendulum(four_bar())) == [
        (["eye"], ["bob"], "line"),
        (["eye"], ["bob"], "line"),
        (["eye"], ["bob"], "line"),
        (["hook"], ["bob", "pendulum"], "line"),
    ]


def test_a_slider_and_a_parallelogram_idle_together() -> None:
    """Both run across the limb; neither the hinges nor the foot take part."""
    parts = [(joints, bodies) for joints, bodies, _ in idle(two_parallelogram_limbs())]
    assert parts == [
        (
            [f"P{n}", f"p{n}", f"q{n}", f"r{n}", f"s{n}"],
            [f"bar{n}", f"cart{n}", f"left{n}", f"right{n}"],
        )
        for n in "12"
    ]


def along(freedom: NamedFreedom) -> tuple[int, ...]:
    return freedom.twist[3:]


def test_translations_along_the_base_axes() -> None:
    """Three CRR limbs leave pure translations, one for each base axis."""
    motion = Network(ALL["three sliders"]().mechanism).motion
    freedoms = named_freedoms(motion)
    assert [kind_of(one.twist, motion.posture.prime) for one in freedoms] == [
        "free"
    ] * 3
    assert [along(one) for one in freedoms] == [(1, 0, 0), (0, 1, 0), (0, 0, 1)]
