"""Names of redundancies and freedoms: exact coordinates, plain sentences, bounds."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path

import pytest
from reasons.made import (
    Made,
    door,
    four_bar,
    joint,
    rssr,
    sarrus,
    scissor,
    scrambled,
    six_rods,
    three_bars,
    three_sliders,
    two_parallelogram_limbs,
    vector,
    with_pendulum,
    written,
)

from screwkit.algebra.expression import Symbol
from screwkit.analyses.naming import MOST_REDUNDANCIES, Named, named
from screwkit.kinematics.network import Network
from screwkit.mechanism.files import read_mechanism
from screwkit.mechanism.model import JointType, Mechanism, Parameter
from screwkit.reasons.self_stress import redundant_count

CASES = sorted((Path(__file__).parents[2] / "cases").glob("*.yaml"))


def answer(mechanism: Mechanism) -> Named:
    network = Network(mechanism)
    return named(network, network.motion)


def of(made: Made) -> Named:
    return answer(made.mechanism)


def test_a_planar_loop_in_words() -> None:
    """Two couples across the hinges and a force along them go around the loop."""
    found = of(four_bar())
    assert [one.description for one in found.redundancies] == [
        "a couple about [1, 0, 0] carried around the loop A B C D",
        "a couple about [0, 1, 0] carried around the loop A B C D",
        "a force along [0, 0, 1] through [0, 0, 0] carried around the loop A B C D",
    ]
    first = found.redundancies[0].removed_by[0]
    assert first.description == "a rotation about [1, 0, 0] at joint A"
    assert (first.joint, first.kind, first.axis) == ("A", "rotation", ("1", "0", "0"))
    last = found.redundancies[2].removed_by[0]
    assert last.description == "a translation along [0, 0, 1] at joint A"
    assert last.point == ()
    (freedom,) = found.remaining_freedoms
    # AB and DC meet at the coupler's instantaneous centre: (12, 24), by hand.
    assert freedom.kind == "rotation"
    assert freedom.axis == ("0", "0", "1")
    assert freedom.point == ("12", "24", "0")
    assert freedom.pitch == "0"
    assert freedom.joints == ("A", "B", "C", "D")


def test_wrenches_balance_as_they_are_written() -> None:
    """Two limbs push the platform with opposite texts; all joints are accounted for."""
    for one in of(three_sliders()).redundancies:
        left, right = one.carried
        assert left.kind == right.kind == "couple"
        for a, b in zip(left.coordinates, right.coordinates, strict=True):
            assert int(a) == -int(b)


def test_limbs_by_name() -> None:
    made = three_sliders().mechanism
    names = {f"leg {k}": (f"C{k}", f"R{k}", f"Q{k}") for k in (1, 2, 3)}
    found = answer(replace(made, limb_names=names))
    assert [one.description for one in found.redundancies] == [
        "limbs leg 1 and leg 2 both carry a couple about [0, 0, 1]",
        "limbs leg 1 and leg 3 both carry a couple about [0, 1, 0]",
        "limbs leg 2 and leg 3 both carry a couple about [1, 0, 0]",
    ]
    assert {c.limb for one in found.redundancies for c in one.carried} == set(names)


def test_loops_inside_limbs() -> None:
    found = of(two_parallelogram_limbs())
    inside = [one for one in found.redundancies if len(one.carried) == 1]
    assert len(inside) == 6
    assert all("inside limb " in one.description for one in inside)
    (between,) = [one for one in found.redundancies if one not in inside]
    assert between.description == (
        "limb 1 and limb 2 both carry a couple about [0, 0, 1]"
    )


def test_more_limbs_than_two() -> None:
    found = answer(replace(three_bars().mechanism, space="planar"))
    (one,) = found.redundancies
    assert one.description == (
        "the forces of limb 1, limb 2 and limb 3 along [1, 2, 0] depend on each other"
    )
    # Bars at 0, 3 and 7: the middle one takes 7 against 4 and 3, by moments.
    written = [carrier.coordinates for carrier in one.carried]
    assert written == [("4", "8", "0"), ("-7", "-14", "-42"), ("3", "6", "42")]


def test_hinges_in_parallel() -> None:
    """A door on two hinges: five constraints too many, each at both hinges."""
    found = of(door())
    assert len(found.redundancies) == 5
    assert all("loop high low" in one.description for one in found.redundancies)


def test_idle_freedoms_in_words() -> None:
    spin, swing = of(rssr()).remaining_freedoms
    assert spin.idle
    assert not swing.idle
    assert spin.bodies == ("rod",)
    assert spin.description == (
        "leg spin: s1 and s2 turn together, rod spins about its own axis"
    )
    assert spin.axis == ("4", "5", "2")
    assert swing.description.startswith("the platform rotates about the line through")
    words = [
        one.description for one in of(with_pendulum(four_bar())).remaining_freedoms
    ]
    assert (
        "hook moves: pendulum and bob rotate about the line through [9, 9, 9] "
        "along [0, 1, 0]" in words
    )


def test_a_lid_on_two_hinges_is_no_leg() -> None:
    """It turns about the line of its hinges, and belongs to its box alone."""
    made = four_bar()
    lid = [
        joint(name, JointType.REVOLUTE, made.base, "lid", (1, 0, 0), (x, 9, 0))
        for name, x in (("left", 5), ("right", 8))
    ]
    found = of(replace(made, joints=(*made.joints, *lid)))
    words = [one.description for one in found.remaining_freedoms]
    assert (
        "left and right turn together: lid rotates about the line through left and "
        "right" in words
    )


def test_two_bodies_spin_about_one_line() -> None:
    """A leg of two bodies with a slider between its balls."""
    made = six_rods()
    first, second, *rest = made.joints
    legs = (
        replace(first, child="tube"),
        joint("slide", JointType.PRISMATIC, "tube", "rod1", (-3, 2, 6)),
        second,
        *rest,
    )
    words = [
        one.description for one in of(replace(made, joints=legs)).remaining_freedoms
    ]
    assert (
        "leg spin: A1 and B1 turn together, tube and rod1 spin about the line "
        "through A1 and B1" in words
    )


def test_a_translation_in_words() -> None:
    (freedom,) = of(sarrus()).remaining_freedoms
    assert (
        freedom.description
        == "the platform translates along [0, 0, 1]; all joints move"
    )
    assert (freedom.kind, freedom.pitch, freedom.point) == ("translation", "", ())


def test_a_turned_mechanism_has_turned_coordinates() -> None:
    """Every coordinate is still exact: all are rational, none is missing."""
    found = of(scrambled(four_bar(), 7))
    assert len(found.redundancies) == 3
    for one in found.redundancies:
        for carrier in one.carried:
            assert len(carrier.coordinates) == 6
        assert all(added.axis for added in one.removed_by)


def test_symbols_leave_what_does_not_depend_on_them() -> None:
    """With a symbol for a length the couples stay, the instantaneous centre goes."""
    made = four_bar().mechanism
    point = Symbol("l"), *written(vector(2, 0, 0))[:2]
    joints = tuple(
        replace(own, point=point) if own.name == "B" else own for own in made.joints
    )
    found = answer(replace(made, joints=joints, parameters=(Parameter("l"),)))
    assert [one.carried[0].kind for one in found.redundancies] == [
        "couple",
        "couple",
        "force",
    ]
    assert found.redundancies[0].carried[0].coordinates == (
        "0",
        "0",
        "0",
        "1",
        "0",
        "0",
    )
    (freedom,) = found.remaining_freedoms
    assert freedom.axis == ("0", "0", "1")
    assert freedom.point == ()
    assert freedom.kind == "rotation"


def test_a_spin_needs_no_numbers() -> None:
    """The line through both balls is one whatever the symbols are."""
    made = rssr().mechanism
    point = Symbol("a"), Symbol("b"), Symbol("c")
    joints = tuple(
        replace(own, point=point) if own.name == "s1" else own for own in made.joints
    )
    parameters = tuple(map(Parameter, "abc"))
    freedoms = answer(replace(made, joints=joints, parameters=parameters))
    spin, _ = freedoms.remaining_freedoms
    assert spin.axis == ()
    assert spin.kind == "rotation"
    assert spin.description == (
        "leg spin: s1 and s2 turn together, rod spins about its own axis"
    )


def test_large_mechanisms_are_counted_but_not_named() -> None:
    cells = MOST_REDUNDANCIES // 3
    within, beyond = of(scissor(cells)), of(scissor(cells + 1))
    assert (len(within.redundancies), within.unnamed) == (3 * cells, "")
    assert beyond.redundancies == ()
    assert beyond.unnamed == (
        "63 redundant constraints are more than the 60 that are named one by one"
    )
    assert len(beyond.remaining_freedoms) == 1
    network = Network(scissor(200).mechanism)
    at = network.motion
    begun = time.perf_counter()
    huge = named(network, at)
    assert time.perf_counter() - begun < 1
    assert "601 joint freedoms" in huge.unnamed


@pytest.mark.parametrize("path", CASES, ids=lambda path: path.stem)
def test_cases(path: Path) -> None:
    """As many names as the numbers say, all with words; exact texts at numbers."""
    network = Network(read_mechanism(path))
    special = network.at_values or network
    for one in (network, special):
        found = named(one, one.motion)
        assert found.unnamed == ""
        assert len(found.redundancies) == redundant_count(one.motion)
        assert len(found.remaining_freedoms) == one.motion.mobility
        for redundancy in found.redundancies:
            assert redundancy.description
            assert redundancy.carried
            assert redundancy.removed_by
        assert all(freedom.description for freedom in found.remaining_freedoms)
    if special.mechanism.geometry == "posture" and special is not network:
        found = named(special, special.motion)
        for redundancy in found.redundancies:
            assert all(carrier.coordinates for carrier in redundancy.carried)
