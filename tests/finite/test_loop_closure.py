"""Loops closed near a guess, moved to given values, followed, honestly left open."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from finite.sample_linkages import ball, model, pins, ring, slide, turn

from screwkit.errors import UnknownNameError
from screwkit.finite.exponentials import misses, moved, rebased, stance_of
from screwkit.finite.loop_closure import assembled, followed, moved_to
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


def test_a_motion_stops_at_its_dead_centre() -> None:
    """The slider reaches crank + rod, and is not taken further."""
    linkage = slider_crank(1.0, 2.5)
    most = 3.5 - np.sqrt(5.25)
    found = moved_to(linkage, {"P": 2.0})
    assert not found.closed
    assert found.reason.startswith("after ")
    assert found.coordinates[-1, 3] == pytest.approx(most, abs=0.01)
    assert found.coordinates[-1, 3] <= most + 1e-9
    for coordinates in found.coordinates:
        assert gap(linkage, coordinates) < 1e-11


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
    with pytest.raises(UnknownNameError, match="no freedom 'J9'"):
        moved_to(rigid, {"J9": 1.0})


def test_a_chain_without_loops_is_where_it_is_sent() -> None:
    linkage = model("base", "tip", turn("a", "base", "tip", (0, 0, 1), (1, 0, 0)))
    found = moved_to(replace(linkage, length=1.0), {"a": 2.5})
    assert found.closed
    assert found.coordinates[-1] == pytest.approx([2.5])
