"""Screws of limbs with loops inside, against null spaces of their loops in floats."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from itertools import chain

import numpy as np
import pytest
from kinematics.float_loops import FloatLoops, counted
from loci.numeric import Array, values

import screwkit as sk
from screwkit.analyses.counts import limb_systems
from screwkit.mechanism.model import freedom_label
from screwkit.questions import screws
from screwkit.results.screws import IdentifiedScrew, LimbScrews, PlatformScrews, Screws

CLEAR = 1e4
NESTED = ("delta_ss", "h4", "orthoglide", "stephenson_six_bar", "watt_six_bar")
"""Limbs are chains of joints and of chains side by side: a basis in symbols."""
AT_NUMBERS = ("generic_k33", "palletizer_scara", "peaucellier", "scissor_chain3")
"""Limbs that are no such nesting have their screws at the values of the file."""
EVERY = (*NESTED, *AT_NUMBERS)


@cache
def answer(name: str) -> Screws:
    return screws(sk.load(name))


@cache
def whole(name: str) -> FloatLoops:
    """At drawn values where the answer is generic, else at those of the file."""
    return FloatLoops(sk.load(name).mechanism, generic=answer(name).generic)


@dataclass(frozen=True)
class Part(FloatLoops):
    """Some of the joints at the same values."""

    given: Mapping[str, float] = field(default_factory=dict)

    @cached_property
    def values(self) -> dict[str, float]:
        return dict(self.given)


@cache
def limb_alone(name: str, limb: str) -> FloatLoops:
    found = sk.load(name).network
    (own,) = [each for each in found.limbs if each.name == limb]
    ends = found.mechanism.base, found.mechanism.platform
    part = found.part(own.joints, ends).mechanism
    return Part(part, given=whole(name).values)


def coordinates(system: tuple[IdentifiedScrew, ...], name: str) -> Array:
    """One screw a row, of unit size, lengths in units of the mechanism's own."""
    floats = whole(name)
    rows = [
        floats.in_its_size(values(screw.coordinates, floats.values)) for screw in system
    ]
    return np.array([row / np.linalg.norm(row) for row in rows]).reshape(-1, 6)


def powers(wrenches: Array, twists: Array) -> Array:
    """f·v + m·ω of unit screws."""
    return np.hstack([wrenches[:, 3:], wrenches[:, :3]]) @ twists.T


def clear_rank(matrix: Array) -> int:
    found = counted(matrix)
    assert found.gap >= CLEAR
    return found.rank


def body_twists(floats: FloatLoops, name: str, locked: tuple[str, ...] = ()) -> Array:
    """Unit twists of the platform, one a row."""
    mechanism = whole(name).mechanism
    rows = floats.body_twists(mechanism.platform, mechanism.base, locked).T
    rows = np.hstack([rows[:, :3], rows[:, 3:] * floats.size / whole(name).size])
    return np.asarray(np.linalg.svd(rows)[2][: clear_rank(rows)])


def spans_agree(mine: Array, theirs: Array, dimension: int) -> None:
    assert len(mine) == len(theirs) == dimension
    if dimension:
        assert clear_rank(mine) == clear_rank(np.vstack([mine, theirs])) == dimension


@pytest.mark.parametrize("name", [*EVERY, "delta_4r"])
def test_dimensions_are_those_of_the_network(name: str) -> None:
    found, at = answer(name), sk.load(name).network.motion
    systems = {system.limb.name: system for system in limb_systems(at)}
    assert {limb.name for limb in found.limbs} == set(systems)
    for limb in found.limbs:
        expected = len(systems[limb.name].twists)
        assert limb.twist_dimension == len(limb.twists) == expected
        assert limb.wrench_dimension == len(limb.wrenches) == 6 - expected
    platform = found.platform
    assert platform.twist_dimension == len(platform.twists) == len(at.platform_twists)
    assert platform.wrench_dimension == len(platform.wrenches)
    assert platform.twist_dimension + platform.wrench_dimension == 6


@pytest.mark.parametrize("name", EVERY)
def test_no_wrench_does_work(name: str) -> None:
    found = answer(name)
    systems: list[LimbScrews | PlatformScrews] = [*found.limbs, found.platform]
    for system in systems:
        twists = coordinates(system.twists, name)
        wrenches = coordinates(system.wrenches, name)
        assert abs(powers(wrenches, twists)).max(initial=0.0) < 1e-9


@pytest.mark.parametrize("name", EVERY)
def test_limbs_move_as_in_floats(name: str) -> None:
    for limb in answer(name).limbs:
        floats = limb_alone(name, limb.name)
        theirs = body_twists(floats, name)
        mine = coordinates(limb.twists, name)
        spans_agree(mine, theirs, limb.twist_dimension)


@pytest.mark.parametrize("name", EVERY)
def test_the_platform_moves_as_in_floats(name: str) -> None:
    found, floats = answer(name).platform, whole(name)
    mine = coordinates(found.twists, name)
    spans_agree(mine, body_twists(floats, name), found.twist_dimension)


@pytest.mark.parametrize("name", EVERY)
def test_a_locked_freedom_is_resisted_and_no_other(name: str) -> None:
    """The wrench does work on the limb, and none while its own freedom is locked."""
    found, mechanism = answer(name), sk.load(name).mechanism
    told = []
    for entry in found.actuation_wrenches:
        label = freedom_label(mechanism.joint(entry.joint), entry.freedom)
        told.append((entry.limb, label))
        (limb,) = [each for each in found.limbs if each.name == entry.limb]
        floats = limb_alone(name, entry.limb)
        held = body_twists(floats, name, (label,))
        if entry.screw is None:
            assert len(held) == limb.twist_dimension
            continue
        assert len(held) == limb.twist_dimension - 1
        wrench = coordinates((entry.screw,), name)
        assert abs(powers(wrench, held)).max(initial=0.0) < 1e-9
        assert abs(powers(wrench, coordinates(limb.twists, name))).max() > 1e-6
    assert len(set(told)) == len(told)


@pytest.mark.parametrize("name", EVERY)
def test_every_actuated_freedom_has_its_wrench(name: str) -> None:
    """Idle freedoms too are listed; those that are driven are none of them."""
    mechanism = sk.load(name).mechanism
    listed = {
        freedom_label(mechanism.joint(entry.joint), entry.freedom): entry.screw
        for entry in answer(name).actuation_wrenches
    }
    for label in mechanism.actuated:
        assert listed[label] is not None


@pytest.mark.parametrize("name", EVERY)
def test_whether_screws_are_generic_is_said(name: str) -> None:
    found = answer(name)
    systems = [s for limb in found.limbs for s in (limb.twists, limb.wrenches)]
    texts = {
        text
        for screw in chain(*systems, found.platform.twists, found.platform.wrenches)
        for text in screw.coordinates
    }
    letters = any(char.isalpha() for text in texts for char in text.replace("sqrt", ""))
    assert found.generic == letters == (name in NESTED)


@pytest.mark.parametrize("name", [each for each in NESTED if each != "delta_ss"])
def test_a_basis_stays_one_at_the_values_of_the_file(name: str) -> None:
    floats = FloatLoops(sk.load(name).mechanism)
    for limb in answer(name).limbs:
        for system in (limb.twists, limb.wrenches):
            rows = [
                floats.in_its_size(values(screw.coordinates, floats.values))
                for screw in system
            ]
            sizes = [np.linalg.norm(row) for row in rows]
            assert min(sizes, default=1.0) > 0
            unit = [row / size for row, size in zip(rows, sizes, strict=True)]
            assert clear_rank(np.array(unit).reshape(-1, 6)) == len(system)
