"""Laws of reciprocity, sums and intersections."""

from __future__ import annotations

from hypothesis import given, settings
from hypothesis import strategies as st
from laws.systems import RING, Place, columns, twist_systems

from screwkit.screw.nullspace import Column
from screwkit.screw.system import Twist, TwistSystem, Wrench, reciprocal_product


@settings(max_examples=60)
@given(twist_systems)
def test_reciprocity_is_an_involution(system: TwistSystem) -> None:
    assert system.reciprocal().reciprocal() == system


@settings(max_examples=60)
@given(twist_systems)
def test_a_system_and_its_reciprocal_fill_six_dimensions(system: TwistSystem) -> None:
    wrenches = system.reciprocal()
    assert system.dimension + wrenches.dimension == 6
    assert len(wrenches) == wrenches.dimension
    for twist in system:
        assert all(reciprocal_product(twist, wrench) == "0" for wrench in wrenches)


@settings(max_examples=40)
@given(twist_systems, twist_systems)
def test_dimensions_of_sum_and_intersection(a: TwistSystem, b: TwistSystem) -> None:
    together, shared = a + b, a & b
    assert together.dimension + shared.dimension == a.dimension + b.dimension
    assert together == b + a
    assert shared == b & a
    assert a + shared == a
    assert a & together == a


@settings(max_examples=40)
@given(twist_systems, twist_systems)
def test_reciprocity_turns_sums_into_intersections(
    a: TwistSystem, b: TwistSystem
) -> None:
    assert (a + b).reciprocal() == a.reciprocal() & b.reciprocal()


@settings(max_examples=60)
@given(twist_systems)
def test_every_printed_coordinate_reads_back(system: TwistSystem) -> None:
    place = Place(3)
    for wrench in system.reciprocal():
        for value, written in zip(wrench.column, wrench.coordinates, strict=True):
            assert place.read(written) == place.value(value)


@settings(max_examples=60)
@given(twist_systems, columns, st.booleans(), st.booleans())
def test_where_nothing_assumed_vanishes_the_rank_is_the_generic_one(
    system: TwistSystem, column: Column, straight: bool, short: bool
) -> None:
    """At random points and at special ones: angles of 0, a length of 0."""
    total = system + TwistSystem(RING, (column,), "base")
    wrenches = total.reciprocal()
    place = Place(5, straight=straight, short=short)
    if all(place.read(text) for text in wrenches.assumed_nonzero):
        assert place.rank(wrenches.columns) == wrenches.dimension
        assert place.rank(total.columns) == total.dimension


def test_a_wrench_is_no_twist() -> None:
    one = (RING.one,) * 6
    assert Wrench(RING, one, "base") not in TwistSystem(RING, (one,), "base")
    assert Twist(RING, one, "base") in TwistSystem(RING, (one,), "base")
