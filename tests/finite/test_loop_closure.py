"""Loops closed near a guess, moved to given values, followed, honestly left open."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from finite.sample_linkages import ball, model, pins, ring, slide, turn

from screwkit.errors import UnfitValueError, UnknownNameError
from screwkit.finite.driven_motion import followed, moved_to
from screwkit.finite.exponentials import misses, moved, rebased, stance_of
from screwkit.finite.loop_closure import assembled
from screwkit.finite.posture_model import PostureModel
from screwkit.finite.spanning_forest import forest_of

FOUR_BAR = [(0.0, 0.0), (1.0, 2.0), (4.0, 2.5), (5.0, 0.0)]
BENNETT = (
    ((8, -4, -12), (3, 0, 1)),
    ((0, -12, -12), (1, 2, -1)),
    ((-8, 4, -12), (-3, 0, 1)),
    ((0, 12, -12), (-1, -2, -1)),
)


def gap(linkage: PostureModel, coordinates: np.ndarray) -> float:
    """By what the loops miss when the joints stand at given coordinates."""
    forest = forest_of(linkage)
    there = moved(forest, stance_of(linkage, forest), coordinates[None])
    return float(np.abs(misses(there)).max())


def rssr() -> PostureModel:
    return model(
        "base",
        "crank",
        turn("A", "base", "crank", (0, 0, 1), (0, 0, 0)),
        ball("B", "crank", "rod", (1, 0, 0)),
        ball("C", "rod", "rocker", (3, 2, 1)),
        turn("D", "rocker", "base", (1, 0, 0), (0, 0, 2)),
    )


def slider_crank(crank: float, rod: float) -> PostureModel:
    """In line with its dead centre ahead: the crank at a right angle."""
    reach = float(np.sqrt(rod**2 - crank**2))
    return model(
        "base",
        "slider",
        turn("A", "base", "crank", (0, 0, 1), (0, 0, 0)),
        turn("B", "crank", "rod", (0, 0, 1), (0, crank, 0)),
        turn("C", "rod", "slider", (0, 0, 1), (reach, 0, 0)),
        slide("P", "base", "slider", (1, 0, 0)),
    )


@pytest.mark.parametrize("linkage", [pins(2, FOUR_BAR), ring(2, BENNETT), rssr()])
def test_a_disturbed_posture_closes_again(linkage: PostureModel) -> None:
    guess = 0.1 * np.random.default_rng(1).standard_normal(len(linkage.labels))
    found = assembled(linkage, guess)
    assert found.closed
    assert not found.reason
    assert gap(linkage, found.coordinates[0]) < 1e-11
    assert gap(found.model, np.zeros_like(guess)) < 1e-11


def test_fixed_freedoms_keep_the_values_of_the_guess() -> None:
    linkage = pins(2, FOUR_BAR)
    found = assembled(linkage, np.array([0.4, 0.0, 0.0, 0.0]), fixed=["J0"])
    assert found.closed
    assert found.coordinates[0, 0] == pytest.approx(0.4, abs=1e-15)
    assert gap(linkage, found.coordinates[0]) < 1e-11


def test_the_slider_is_where_trigonometry_puts_it() -> None:
    linkage = slider_crank(1.0, 2.5)
    for angle in (1.2, -1.4, 4.0):
        found = moved_to(linkage, {"A": angle})
        assert found.closed
        turned = np.pi / 2 + angle
        wanted = np.cos(turned) + np.sqrt(6.25 - np.sin(turned) ** 2) - np.sqrt(5.25)
        assert found.coordinates[-1, 3] == pytest.approx(wanted, abs=1e-11)


def test_lengths_are_those_of_the_file() -> None:
    small, large = slider_crank(1.0, 2.5), slider_crank(1000.0, 2500.0)
    one, other = (moved_to(linkage, {"A": 0.7}) for linkage in (small, large))
    assert other.coordinates[-1, 3] == pytest.approx(1000 * one.coordinates[-1, 3])
    back = moved_to(large, {"P": float(other.coordinates[-1, 3])})
    assert back.coordinates[-1, 0] == pytest.approx(0.7)


def test_ball_joints_have_coordinates_too() -> None:
    linkage = rssr()
    found = moved_to(linkage, {"A": 1.1})
    assert found.closed
    assert gap(linkage, found.coordinates[-1]) < 1e-11
    there = rebased(linkage, found.coordinates[-1])
    assert gap(there, np.zeros(8)) < 1e-11


def test_one_freedom_of_a_ball_joint_can_be_driven() -> None:
    linkage = rssr()
    found = moved_to(linkage, {"A": 0.2, "B:0": 0.3})
    assert found.closed
    reached = found.coordinates[-1]
    assert reached[[0, 1]] == pytest.approx([0.2, 0.3])
    assert gap(linkage, reached) < 1e-11


@pytest.mark.parametrize("size", [1.0, 1000.0])
@pytest.mark.parametrize("beyond", [1e-6, 1e-3, 0.5])
def test_a_motion_ends_at_its_dead_centre_and_says_where(
    size: float, beyond: float
) -> None:
    """The slider reaches crank + rod, and is not taken further."""
    linkage = slider_crank(size, 2.5 * size)
    most = (3.5 - np.sqrt(5.25)) * size
    found = moved_to(linkage, {"P": most + beyond * size})
    assert not found.closed
    assert f"the mechanism turns back at P = {most:.6g}: a dead point" in found.reason
    assert not found.reason.startswith("after 100%")
    assert found.coordinates[-1, 3] == pytest.approx(most, abs=1e-12 * size)
    assert found.coordinates[-1, 0] == pytest.approx(-np.pi / 2, abs=1e-6)
    for coordinates in found.coordinates:
        assert gap(linkage, coordinates) < 1e-11 * size


@pytest.mark.parametrize("short", [1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 0.0])
def test_a_slider_comes_as_near_to_its_dead_centre_as_is_asked(short: float) -> None:
    linkage = slider_crank(1.0, 2.5)
    most = 3.5 - np.sqrt(5.25)
    found = moved_to(linkage, {"P": most - short})
    assert found.closed
    # The sine law near the dead centre: P falls by (1 + 1/2.5) A²/2.
    expected = np.sqrt(2 * short / 1.4)
    turned = found.coordinates[-1, 0] + np.pi / 2
    assert turned == pytest.approx(expected, rel=0.01, abs=3e-6)


def test_at_a_dead_point_no_motion_of_the_slider_begins() -> None:
    there = moved_to(slider_crank(1.0, 2.5), {"A": -np.pi / 2}).model
    for way in (0.1, -0.1):
        found = moved_to(there, {"P": way})
        assert (found.closed, found.reached) == (False, 0.0)
        assert "the loops hold the mechanism at P = 0: no motion" in found.reason
    assert moved_to(there, {"A": 0.3}).closed


def four_bar(lengths: tuple[float, float, float, float], angle: float) -> np.ndarray:
    """The pins where the crank stands at an angle and the coupler lies on its left."""
    crank, coupler, rocker, ground = lengths
    pin = crank * np.array([np.cos(angle), np.sin(angle)])
    across = np.array([ground, 0.0]) - pin
    reach = np.hypot(*across)
    along = (coupler**2 - rocker**2 + reach**2) / (2 * reach)
    height = np.sqrt(coupler**2 - along**2)
    side = np.array([-across[1], across[0]])
    joint = pin + (along * across + height * side) / reach
    return np.array([(0, 0), pin, joint, (ground, 0)])


@pytest.mark.parametrize("close", [1e-2, 1e-3, 1e-4, 1e-6, 1e-8, -1e-4, -1e-6])
@pytest.mark.parametrize("turn_by", [-3.0, 6.0, 2.0])
def test_a_motion_keeps_to_its_assembly_where_the_other_is_near(
    close: float, turn_by: float
) -> None:
    """Nearly a kite: where the crank lies on the ground the rocker is almost free."""
    lengths = (1.0, 2.0, 2.0, 1.0 + close)
    start, end = four_bar(lengths, 1.0), four_bar(lengths, 1.0 + turn_by)
    found = moved_to(pins(2, [tuple(p) for p in start]), {"J0": turn_by})
    assert found.closed, found.reason
    (bx, by), (ax, ay) = end[2] - end[3], start[2] - start[3]
    rocker = np.arctan2(by, bx) - np.arctan2(ay, ax)
    assert np.exp(-1j * found.coordinates[-1, 3]) == pytest.approx(
        np.exp(1j * rocker), abs=1e-6
    )


@pytest.mark.parametrize("close", [1e-4, 1e-6])
def test_a_followed_motion_keeps_to_its_assembly_too(close: float) -> None:
    lengths = (1.0, 2.0, 2.0, 1.0 + close)
    start = four_bar(lengths, 1.0)
    found = followed(pins(2, [tuple(p) for p in start]), {"J0": -1.0}, steps=70)
    assert found.closed, found.reason
    for coordinates in found.coordinates[::10]:
        end = four_bar(lengths, 1.0 + coordinates[0])
        (bx, by), (ax, ay) = end[2] - end[3], start[2] - start[3]
        rocker = np.arctan2(by, bx) - np.arctan2(ay, ax)
        assert np.exp(-1j * coordinates[3]) == pytest.approx(
            np.exp(1j * rocker), abs=1e-6
        )


def test_a_true_kite_goes_straight_on_where_its_branches_meet() -> None:
    """Behind the meeting the rocker still turns as before, not back."""
    start = four_bar((1.0, 2.0, 2.0, 1.0), 1.0)
    linkage = pins(2, [tuple(p) for p in start])
    found = moved_to(linkage, {"J0": -2.5})
    assert found.closed
    rocker = found.coordinates[:, 3]
    assert np.abs(np.diff(rocker)).max() < 0.2
    assert (np.diff(rocker) * np.sign(rocker[1]) > 0).all()


def test_targets_too_far_to_be_followed_are_refused() -> None:
    with pytest.raises(UnfitValueError, match=r"J0 would move by 1e\+09, too far"):
        moved_to(pins(2, FOUR_BAR), {"J0": 1e9})
    with pytest.raises(UnfitValueError, match=r"P would move by 1e\+06, too far"):
        moved_to(slider_crank(1.0, 2.5), {"P": 1e6})
    chain = model("base", "tip", turn("a", "base", "tip", (0, 0, 1), (1, 0, 0)))
    assert moved_to(chain, {"a": 1e9}).closed


def test_what_cannot_close_is_not_returned_as_closed() -> None:
    """A slider held beyond its reach."""
    linkage = slider_crank(1.0, 2.5)
    found = assembled(linkage, np.array([0.0, 0.0, 0.0, 3.0]), fixed=["P"])
    assert not found.closed
    assert len(found.coordinates) == 0
    assert found.distance > 0.1
    assert found.open_joint in found.reason
    assert found.model is linkage


def test_a_followed_motion_passes_dead_centres() -> None:
    """The crank turns once while the slider goes back and forth."""
    linkage = slider_crank(1.0, 2.5)
    found = followed(linkage, {"A": 1.0}, steps=75)
    assert found.closed
    angles = found.coordinates[:, 0]
    assert (np.diff(angles) > 0).all()
    assert angles[-1] > 2 * np.pi - 0.5
    turned = np.pi / 2 + angles
    wanted = np.cos(turned) + np.sqrt(6.25 - np.sin(turned) ** 2) - np.sqrt(5.25)
    assert found.coordinates[:, 3] == pytest.approx(wanted, abs=1e-10)


def test_a_followed_motion_stays_on_its_branch() -> None:
    """Through the flat posture a parallelogram stays a parallelogram."""
    linkage = pins(2, [(0, 0), (1, 2), (4, 2), (3, 0)])
    found = followed(linkage, {"J0": 1.0}, steps=70)
    assert found.closed
    angles = found.coordinates[:, :1] * [1, -1, 1, -1]
    assert found.coordinates == pytest.approx(angles, abs=1e-8)


def test_what_the_loops_forbid_is_told() -> None:
    rigid = pins(1, [(0, 0), (1, 2), (3, 0)])
    with pytest.raises(ValueError, match="allow none"):
        followed(rigid, {"J0": 1.0})
    found = moved_to(rigid, {"J0": 0.5})
    assert not found.closed
    assert not found.reached
    with pytest.raises(UnknownNameError, match=r"no freedom 'J9' \(did you mean 'J"):
        moved_to(rigid, {"J9": 1.0})
    with pytest.raises(UnknownNameError, match=r"'knee'; there are J0, J1, J2$"):
        moved_to(rigid, {"knee": 1.0})


def test_a_chain_without_loops_is_where_it_is_sent() -> None:
    linkage = model("base", "tip", turn("a", "base", "tip", (0, 0, 1), (1, 0, 0)))
    found = moved_to(replace(linkage, length=1.0), {"a": 2.5})
    assert found.closed
    assert found.coordinates[-1] == pytest.approx([2.5])
