"""Ellipsoids of arms that hold one object, as a mechanism file has them.

Jacobians are written out from the file's own points and axes; the rules of
[ChiacchioEtAl1990] combine them: (24), (26), (28), (30), (35)-(37).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

import screwkit as sk
from screwkit.metrics.arms import (
    Arm,
    absolute_jacobian,
    in_parallel,
    in_series,
    relative_jacobian,
    shares,
)
from screwkit.results.manipulability import Cooperative, Manipulability
from screwkit.results.undecided import Undecided

Array = NDArray[np.float64]


def unit(source: np.random.Generator) -> Array:
    """A direction with a length of exactly 1 in decimals: 2, 3, 6 over 7 and kin."""
    sides = np.array([2.0, 3.0, 6.0]) * source.choice([-1, 1], 3)
    return np.asarray(source.permutation(sides))


def drawn(seed: int, size: int, counts: list[int]) -> tuple[str, list[Arm]]:
    """A file of arms with rigid grasps, and the arms as their definitions have them."""
    source = np.random.default_rng(seed)
    planar = size == 3
    linear = 2 if planar else 3
    links, lines, arms = ["ground", "load"], [], []
    centre = source.integers(-20, 20, linear) / 10
    for arm, count in enumerate(counts):
        at, columns = "ground", []
        grip = source.integers(-20, 20, linear) / 10
        for number in range(count):
            name = f"{'abcd'[arm]}{number}"
            point = source.integers(-20, 20, linear) / 10
            axis = np.array([0, 0, 1.0]) if planar else unit(source)
            entry = f"name: {name}, parent: {at}, child: l{name}"
            entry += f", type: revolute, point: {point.tolist()}"
            if not planar:
                entry += f", axis: {axis.tolist()}"
            lines.append(f"  - {{{entry}}}")
            z = axis / np.linalg.norm(axis)
            lever = np.zeros(3)
            lever[:linear] = grip - point
            velocity = np.cross(z, lever)
            columns.append([*velocity[:linear], *(z[2:] if planar else z)])
            links.append(f"l{name}")
            at = f"l{name}"
        lines.append(
            f"  - {{name: g{arm}, type: fixed, parent: {at}, child: load, "
            f"point: {grip.tolist()}}}"
        )
        arms.append(Arm(np.array(columns).T, centre - grip))
    names = [line.split("name: ")[1].split(",")[0] for line in lines]
    driven = [name for name in names if not name.startswith("g")]
    text = "\n".join(
        [
            "screwkit: 1",
            "name: arms",
            f"space: {'planar' if planar else 'spatial'}",
            "geometry: posture",
            "base: ground",
            "platform: load",
            f"links: [{', '.join(links)}]",
            f"reference_point: {centre.tolist()}",
            f"actuated: [{', '.join(driven)}]",
            "joints:",
            *lines,
            "",
        ]
    )
    return text, arms


def measured(folder: Path, text: str) -> Manipulability:
    path = folder / "arms.yaml"
    path.write_text(text, encoding="utf-8")
    return sk.manipulability(sk.load(path))


def semi_axes(square: Array) -> Array:
    return np.asarray(np.sqrt(np.linalg.eigvalsh(square))[::-1])


SYSTEMS = [
    (0, 3, [3, 3]),
    (1, 3, [4, 3]),
    (2, 3, [3, 4, 3]),
    (3, 6, [6, 6]),
    (4, 6, [7, 6]),
    (5, 6, [6, 7, 6]),
    (6, 3, [3, 3, 4, 3]),
]


@pytest.mark.parametrize(("seed", "size", "counts"), SYSTEMS)
def test_arms_of_a_file_follow_the_rules(
    tmp_path: Path, seed: int, size: int, counts: list[int]
) -> None:
    text, arms = drawn(seed, size, counts)
    found = measured(tmp_path, text).cooperative
    assert isinstance(found, Cooperative)
    assert found.rule == ""
    absolute, relative = absolute_jacobian(arms), relative_jacobian(arms)
    velocity = semi_axes(absolute @ absolute.T)
    inner = semi_axes(relative @ relative.T)
    assert np.allclose(velocity, semi_axes(in_parallel(arms)))
    assert np.allclose(inner, semi_axes(in_series(arms)))
    for ellipsoid, wanted in (
        (found.absolute_velocity, velocity),
        (found.external_force, 1 / velocity[::-1]),
        (found.relative_velocity, inner),
        (found.internal_force, 1 / inner[::-1]),
    ):
        assert np.allclose(ellipsoid.semi_axes, wanted, rtol=1e-6)
    for own, arm in zip(found.arms, arms, strict=True):
        alone = semi_axes(arm.at_object @ arm.at_object.T)
        assert np.allclose(own.absolute_velocity.semi_axes, alone, rtol=1e-6)
        assert np.allclose(own.external_force.semi_axes, 1 / alone[::-1], rtol=1e-6)
    _, parts = shares(arms)
    wanted_shares = np.array([arm.shares for arm in found.arms])
    assert np.allclose(wanted_shares.sum(axis=0), 1)
    assert np.allclose(wanted_shares, parts, rtol=1e-6, atol=1e-9)


@pytest.mark.parametrize(("seed", "size", "counts"), SYSTEMS)
def test_the_axes_lie_as_the_rules_say(
    tmp_path: Path, seed: int, size: int, counts: list[int]
) -> None:
    """Σ lᵢ² dᵢ dᵢᵀ is J_a J_aᵀ, and its inverse for forces: no axis is mixed up."""
    text, arms = drawn(seed, size, counts)
    found = measured(tmp_path, text).cooperative
    assert isinstance(found, Cooperative)
    square = in_parallel(arms)
    linear = size - 1 if size == 3 else 3
    turned = [*range(size - linear, size), *range(size - linear)]  # (ω; v) to (v; ω)
    velocity, force = found.absolute_velocity, found.external_force
    for axes, wanted, order in (
        (velocity, square, turned),
        (force, np.linalg.inv(square), list(range(size))),
    ):
        d = np.array(axes.directions)[:, order]
        shape = d.T @ np.diag(np.square(axes.semi_axes)) @ d
        assert np.allclose(shape, wanted, rtol=1e-6, atol=1e-6 * np.abs(wanted).max())


def test_sharing_force_and_limiting_velocity(tmp_path: Path) -> None:
    """J_a J_aᵀ ≤ J~_i J~_iᵀ: no arm alone is slower than the pair, nor stronger."""
    text, _ = drawn(7, 3, [3, 4])
    found = measured(tmp_path, text).cooperative
    assert isinstance(found, Cooperative)
    for arm in found.arms:
        pairs = zip(
            found.absolute_velocity.semi_axes,
            arm.absolute_velocity.semi_axes,
            strict=True,
        )
        assert all(together <= alone * (1 + 1e-9) for together, alone in pairs)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("type: fixed, parent: la2", "type: hard_finger, parent: la2", "slips"),
        ("actuated: [a0, ", "actuated: [", "joint a0 is passive"),
        ("", "", ""),
    ],
)
def test_why_the_rules_do_not_hold(
    tmp_path: Path, old: str, new: str, said: str
) -> None:
    text, _ = drawn(0, 3, [3, 3])
    found = measured(tmp_path, text.replace(old, new) if old else text).cooperative
    assert isinstance(found, Cooperative)
    assert said in found.rule
    assert bool(said) == bool(found.rule)
    assert all(bool(arm.shares) != bool(said) for arm in found.arms)


def test_an_arm_without_full_row_rank_breaks_the_rules(tmp_path: Path) -> None:
    """A two-joint arm in the plane holds three coordinates with two."""
    text, _ = drawn(0, 3, [2, 4])
    found = measured(tmp_path, text).cooperative
    assert isinstance(found, Cooperative)
    assert "has not full row rank" in found.rule


def parts_of(arms: list[Arm], weight: Array) -> tuple[Array, list[Array]]:
    """What a twist of the object costs, uᵀ A u: of all arms, and of each alone."""

    def cost(columns: Array, weight: Array) -> Array:
        return np.asarray(np.linalg.inv(columns @ np.linalg.inv(weight) @ columns.T))

    size, counts = 3, [arm.jacobian.shape[1] for arm in arms]
    ends = np.cumsum([0, *counts])
    stacked = np.zeros((size * len(arms), int(ends[-1])))
    singles = []
    for number, arm in enumerate(arms):
        own = slice(int(ends[number]), int(ends[number + 1]))
        stacked[size * number : size * (number + 1), own] = arm.at_object
        singles.append(cost(arm.at_object, weight[own, own]))
    repeated = np.tile(np.eye(size), (len(arms), 1))
    return repeated.T @ cost(stacked, weight) @ repeated, singles


@pytest.mark.parametrize("key", ["rates", "torques"])
@pytest.mark.parametrize("place", [(0, 1), (0, 3)])
def test_a_weight_across_arms_breaks_the_rules(
    tmp_path: Path, key: str, place: tuple[int, int]
) -> None:
    """Inside one arm it does not: (30) holds with the arm's own part of the weight."""
    text, arms = drawn(0, 3, [3, 3])
    weight = np.eye(6) * 2
    weight[place] = weight[place[::-1]] = 1
    whole, singles = parts_of(arms, weight)
    alike = bool(np.allclose(whole, sum(singles), rtol=1e-9))
    assert alike == (place == (0, 1))
    rows = f"weights: {{{key}: {weight.astype(int).tolist()}}}\n"
    found = measured(tmp_path, text + rows).cooperative
    assert isinstance(found, Cooperative)
    assert (found.rule == "") == alike
    assert all(bool(arm.shares) == alike for arm in found.arms)
    if not alike:
        assert f"weight of {key} couples joints a0 and b0" in found.rule


def test_one_arm_is_no_cooperation(tmp_path: Path) -> None:
    text, _ = drawn(0, 3, [3])
    found = measured(tmp_path, text).cooperative
    assert isinstance(found, Undecided)
    assert "fewer than two limbs" in found.reason
