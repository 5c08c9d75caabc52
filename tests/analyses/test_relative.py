"""Twists of any body relative to any other, against the loop equations in floats."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from kinematics.float_loops import FloatLoops, counted
from kinematics.random_mechanisms import mechanism_of
from loci.numeric import Array, values

from screwkit.analyses.relative import relative_motion
from screwkit.case import load
from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.kinematics.network import Network
from screwkit.mechanism.graph import components
from screwkit.results.screws import IdentifiedScrew, RelativeMotion

CLEAR = 1e4
NESTED = (
    "2upr_rpu",
    "3crr",
    "3prs",
    "3rpr_planar",
    "3upu_tsai",
    "4H_equal_pitch",
    "5H_parallel",
    "agile_eye",
    "bennett",
    "double_parallelogram",
    "dymo",
    "five_bar",
    "four_bar_planar",
    "generic_7r",
    "h4",
    "isoglide4_t3r1",
    "lone_body",
    "myard5",
    "oldham",
    "orthoglide",
    "palletizer_scara",
    "peaucellier",
    "rhp_screw_jack",
    "rssr",
    "salisbury_hand",
    "sarrus",
    "scara_serial",
    "scissor_chain3",
    "slider_crank",
    "spherical_four_bar",
    "stephenson_six_bar",
    "tripteron",
    "walker4",
    "watt_six_bar",
    "wedge_3p",
)
"""Bundled cases of all kinds whose closed forms are short."""


@cache
def network(name: str) -> Network:
    return Network(load(name).mechanism)


def rows(screws: tuple[IdentifiedScrew, ...], floats: FloatLoops) -> Array:
    """Coordinates at the values of the file, one screw a row, of unit size."""
    found = []
    for screw in screws:
        row = floats.in_its_size(values(screw.coordinates, floats.values))
        found.append(row / np.linalg.norm(row))
    return np.array(found).reshape(-1, 6)


def clear_rank(matrix: Array) -> int:
    found = counted(matrix)
    assert found.gap >= CLEAR
    return found.rank


@pytest.mark.parametrize("name", NESTED)
def test_every_body_moves_as_in_floats(name: str) -> None:
    """Relative to the base: the same space, as many basis screws as its dimension.

    Where the answer says that its basis is generic, symbols are drawn; elsewhere it
    holds at the values of the file.
    """
    mechanism = network(name).mechanism
    for body in mechanism.links:
        if body not in components(mechanism)[0]:
            continue
        found = relative_motion(network(name), body)
        floats = FloatLoops(mechanism, generic=found.generic)
        assert (found.body, found.relative_to) == (body, mechanism.base)
        assert len(found.twists) == found.twist_dimension
        assert found.wrench_dimension == 6 - found.twist_dimension
        if found.twist_dimension:
            mine = rows(found.twists, floats)
            theirs = floats.body_twists(body, mechanism.base).T
            assert clear_rank(mine) == clear_rank(theirs) == found.twist_dimension
            assert clear_rank(np.vstack([mine, theirs])) == found.twist_dimension


def powers(found: RelativeMotion, floats: FloatLoops) -> Array:
    """f·v + m·ω of every wrench with every twist, relative to what is summed."""
    twists, wrenches = (
        np.array([values(s.coordinates, floats.values) for s in each]).reshape(-1, 6)
        for each in (found.twists, found.wrenches)
    )
    crossed = np.hstack([wrenches[:, 3:], wrenches[:, :3]])
    return np.asarray(crossed @ twists.T / (1 + abs(crossed) @ abs(twists.T)))


@pytest.mark.parametrize("name", ["stephenson_six_bar", "peaucellier", "tripteron"])
def test_between_inner_bodies(name: str) -> None:
    """Neither of them base or platform; wrenches do no work, exchange is no change."""
    mechanism = network(name).mechanism
    floats = FloatLoops(mechanism)
    inner = [
        x for x in mechanism.links if x not in (mechanism.base, mechanism.platform)
    ]
    one, other = inner[0], inner[-1]
    there = relative_motion(network(name), one, other)
    back = relative_motion(network(name), other, one)
    theirs = floats.body_twists(one, other).T
    for found in (there, back):
        mine = rows(found.twists, floats)
        assert found.twist_dimension == clear_rank(theirs)
        assert clear_rank(np.vstack([mine, theirs])) == found.twist_dimension
        assert abs(powers(found, floats)).max(initial=0.0) < 1e-9
        assert len(found.wrenches) == found.wrench_dimension


def test_orders_of_coordinates() -> None:
    angular = relative_motion(network("scara_serial"), "tool")
    linear = relative_motion(network("scara_serial"), "tool", order="linear")
    assert (angular.order, linear.order) == ("direction-moment", "moment-direction")
    for one, other in zip(angular.twists, linear.twists, strict=True):
        assert other.coordinates == (*one.coordinates[3:], *one.coordinates[:3])


def test_a_body_relative_to_itself_is_at_rest() -> None:
    found = relative_motion(network("five_bar"), network("five_bar").mechanism.base)
    assert (found.twist_dimension, found.twists, found.wrench_dimension) == (0, (), 6)


def test_bodies_that_do_not_exist_or_are_not_connected() -> None:
    with pytest.raises(UnknownNameError, match="no link 'tol'"):
        relative_motion(network("scara_serial"), "tol")
    with pytest.raises(UnknownNameError, match="no link 'nobody'"):
        relative_motion(network("scara_serial"), "tool", "nobody")
    loose = Network(mechanism_of([], ["ground", "stone"]))
    with pytest.raises(UndecidedError, match="no joints connect"):
        relative_motion(loose, "stone")
