"""What no branch of a finite motion exceeds, where proofs leave the rest open."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest
from finite.linkages import ball, network
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation

from screwkit.algebra.batch import Array
from screwkit.analyses.full_cycle import bounded
from screwkit.analyses.mobility import mobility
from screwkit.finite.finite_proofs import UpperBound, proved_mobility, upper_bound
from screwkit.finite.idle_freedoms import idle_motions
from screwkit.finite.implied_rods import implied_rods
from screwkit.finite.real_forms import turns_around
from screwkit.kinematics.network import Network
from screwkit.results.mobility import FullCycle

PLACES = [
    *((1, 0), (0, 1), (-1, 0), (0, -1), ("3/5", "4/5")),
    *(("-3/5", "4/5"), ("5/13", "-12/13")),
]


def legs_on_a_circle(feet: int) -> Network:
    joints = [
        joint
        for k, (x, y) in enumerate(PLACES[:feet])
        for joint in (
            ball(f"S{k}", "base", f"rod{k}", (x, y, 0)),
            ball(f"T{k}", f"rod{k}", "plate", (x, y, 3)),
        )
    ]
    return network(*joints, platform="plate")


def test_equal_legs_on_a_circle_are_bounded_by_the_fourth_order() -> None:
    """Vertical rods of one length, their feet on a circle: Wren's platform.

    A shift (x, y) with a turn t tilts the rod at p by d = (x, y) + t·ẑ × p, and its top
    sinks by |d|²/2 to second order, an affine function of p on a circle: all is well.
    The plate tilts by t·(x, y), which at fourth order puts t²(x² − y²) and t²xy out of
    balance, so that not every rate goes on.
    """
    plate = legs_on_a_circle(5)
    assert plate.motion.mobility == 5 + 3
    found = upper_bound(plate, plate.motion)
    assert found is not None
    assert found.mobility == 5 + 2
    assert "through order 4" in found.reason


@pytest.mark.parametrize(("feet", "implied"), [(5, 0), (6, 1)])
def test_five_and_more_legs_translate_or_turn_and_rise(feet: int, implied: int) -> None:
    """By the harmonics on the circle: constant, cos, sin and their doubles.

    A rod from p to R p + d has kept its length where |d|² + 2 − 2 p·Rp − 2 d·(1 − R)p
    is that of the start.  Without the doubles the plate turns about z alone, and with
    that cos and sin leave no shift d across z unless R = 1: a sphere of translations,
    and one turn with d = (0, 0, h), h² = 9 − 4 sin²(t/2).  Five points determine the
    five harmonics, so that a sixth rod asks for nothing new.
    """
    plate = legs_on_a_circle(feet)
    for turn in (0.3, 0.8):
        rise = np.array([0, 0, np.sqrt(9 - 4 * np.sin(turn / 2) ** 2)])
        start = np.array(
            [(Fraction(str(x)), Fraction(str(y)), 0) for x, y in PLACES[:feet]], float
        )
        heads = Rotation.from_rotvec([0, 0, turn]).apply(start) + rise
        assert np.allclose(np.linalg.norm(heads - start, axis=1), 3)
    proof = proved_mobility(plate, plate.motion)
    assert proof is not None
    assert proof.mobility == (feet + 1, feet + 2)
    assert ("rods whose lengths follow from those of others" in proof.reason) == (
        implied > 0
    )
    assert proof.motion is not None
    assert (proof.motion.along, proof.motion.words) == ((2, 0), "pure translation")
    assert not proof.whole


def test_rods_are_implied_by_the_equation_of_their_lengths() -> None:
    """Of parallel rods on one conic five count: 1, x, y and three squares, less one."""
    robot = legs_on_a_circle(7)
    idle = idle_motions(robot.motion)
    assert [rod.body for rod in implied_rods(robot.motion, idle)] == ["rod5", "rod6"]
    spread = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (2, 1, 0), (1, 3, 0), (-2, 1, 0)]
    joints = [
        joint
        for k, (x, y, z) in enumerate(spread)
        for joint in (
            ball(f"S{k}", "base", f"rod{k}", (x, y, z)),
            ball(f"T{k}", f"rod{k}", "plate", (x, y, 3)),
        )
    ]
    off_conics = network(*joints, platform="plate")
    assert not implied_rods(off_conics.motion, idle_motions(off_conics.motion))


@pytest.mark.parametrize(
    ("one", "other", "turns"),
    [
        (((1, 0), (0, -1)), ((0, 1), (1, 0)), True),  # z² of a complex number
        (((3, 1), (1, -1)), ((0, 1), (1, 1)), True),
        (((1, 0), (0, 1)), ((0, 1), (1, 0)), False),  # one is definite
        (((1, 0), (0, 0)), ((0, 1), (1, 0)), False),  # both vanish on a line
        (((1, 0), (0, 0)), ((0, 0), (0, 1)), False),  # never negative
    ],
)
def test_forms_that_turn_twice_around(
    one: tuple[tuple[int, ...], ...], other: tuple[tuple[int, ...], ...], turns: bool
) -> None:
    """Against the winding number on the circle; they have no third variable."""
    forms = []
    for form in (one, other):
        wide = np.zeros((3, 3))
        wide[:2, :2] = form
        forms.append(wide)
    angles = np.linspace(0, 2 * np.pi, 2001)
    circle = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    values = [np.einsum("ki,ij,kj->k", circle, form, circle) for form in forms]
    if turns:
        winding = np.unwrap(np.arctan2(values[1], values[0]))
        assert abs(round((winding[-1] - winding[0]) / (2 * np.pi))) == 2
    assert turns_around(forms) is turns


def test_four_equal_legs_on_a_circle_leave_two_dimensions_to_every_branch() -> None:
    """One equation is left for (x, y, t): t² times x² − y², to fourth order.

    The plate translates in two dimensions (t = 0).  Turned by t it may shift along a
    diagonal too: there four legs have the rank 4, which leaves 6 − 4 dimensions.
    """
    turn, shift, length = 0.4, 0.3, 3.0
    feet = np.array([(1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)], dtype=float)

    def heads(pose: Array) -> Array:
        turned = Rotation.from_rotvec([pose[0], pose[1], turn]).apply(feet)
        return np.asarray(turned + np.array([shift, pose[2], length + pose[3]]))

    def missed(pose: Array) -> Array:
        return np.asarray(((heads(pose) - feet) ** 2).sum(axis=1) - length**2)

    found = least_squares(missed, [0, 0, shift, -0.1], xtol=1e-15, ftol=1e-15)
    assert np.abs(found.fun).max() < 1e-12
    top = heads(found.x)
    legs = np.hstack([top - feet, np.cross(top, top - feet)])
    assert np.linalg.svd(legs, compute_uv=False)[-1] > 1e-3

    plate = legs_on_a_circle(4)
    assert plate.motion.mobility == 4 + 3
    proof = proved_mobility(plate, plate.motion)
    assert proof is not None
    assert proof.mobility == (4 + 2,)
    assert "vanishes twice on a smooth family of dimension 2" in proof.reason
    assert not proof.whole
    answer = mobility(plate)
    assert "2T0R" in answer.platform.finite_motion_types
    assert "on other branches is open" in answer.full_cycle.reason


def test_a_bound_is_told_where_samples_leave_all_open() -> None:
    undecided = FullCycle("undecided", (), "too flat")
    told = bounded(undecided, UpperBound(7, "by the fourth order"))
    assert (
        told.reason == "too flat; proved is that it is 7 at most: by the fourth order"
    )
    seen = FullCycle("sampled", (8,), "")
    assert bounded(seen, UpperBound(7, "so it is")).status == "undecided"
    assert bounded(seen, UpperBound(8, "so it is")) == seen
