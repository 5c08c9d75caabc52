"""Wrenches that are reciprocal at every posture tell where the platform is held.

With its first links locked a limb of the 4-RUU robot carries a force along its second
link CB and a couple; where the plan of CB is parallel to h it carries a third wrench,
and its passive joints idle.  The forces meet in plan where the platform moves.
"""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from loci import nao
from loci.numeric import Array, limb_columns, value
from loci.test_wrench_blocks import LENGTHS, A, B, K, line, posture, turned

from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search
from screwkit.case import load
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.limb_parts import Parts
from screwkit.loci.actuation import actuation_locus, passive_joints
from screwkit.loci.actuation_locus import ActuationLocus
from screwkit.loci.lasting_wrenches import all_are_held
from screwkit.loci.pieces import Piece


def freedoms(at: dict[str, float]) -> tuple[int, int]:
    """Of the passive joints, and of the platform, by singular values."""
    place = np.array([at["x"], at["y"], at["z"]])
    limbs = []
    for k in range(4):
        out = k * np.pi / 2
        end = place + B * turned(out + at["phi"])
        middle = A * turned(out) + LENGTHS[k] * turned(at[f"theta{k + 1}"])
        h = turned(at[f"eta{k + 1}"])
        axes = [(K, middle), (h, middle), (h, end), (K, end)]
        limbs.append(np.array([line(*axis) for axis in axes]).T)
    return freedoms_of(limbs)


def freedoms_of(limbs: list[Array]) -> tuple[int, int]:
    """Of some limbs' passive joints, and of the platform that they hold."""
    systems, idle = [], 0
    for limb in limbs:
        left, sizes, _ = np.linalg.svd(limb)
        kept = int(np.sum(sizes > 1e-9))
        idle += limb.shape[1] - kept
        systems.append(left[:, kept:].T)
    sizes = np.linalg.svd(np.vstack(systems), compute_uv=False)
    platform = int(np.sum(sizes < 1e-9))
    return platform + idle, platform


def meeting(source: np.random.Generator, along: tuple[int, ...]) -> dict[str, float]:
    """A posture at which all links CB meet in plan, some of them parallel to h."""
    while True:
        place, phi = source.uniform(-1, 1, 3), float(source.uniform(-1, 1))
        centre = source.uniform(-1, 1, 2)
        thetas: list[float] = []
        etas = source.uniform(-3, 3, 4)
        for k in range(4):
            start = A * turned(k * np.pi / 2)[:2]
            end = (place + B * turned(k * np.pi / 2 + phi))[:2]
            across = (end - centre) / np.linalg.norm(end - centre)
            along_line = float(across @ (start - centre))
            height = LENGTHS[k] ** 2 - float(np.sum((start - centre) ** 2))
            square = along_line**2 + height
            if square < 0:
                break
            out = centre + (along_line + np.sqrt(square)) * across - start
            thetas.append(float(np.arctan2(out[1], out[0])))
            if k in along:
                etas[k] = float(np.arctan2(across[1], across[0]))
        if len(thetas) == 4:
            return posture(place, phi, np.array(thetas), etas)


@cache
def robot() -> tuple[Assembly, ActuationLocus]:
    case = load(str(nao.ROOT / "cases" / "4ruu.yaml"))
    return case.assembly, actuation_locus(case.assembly, case.mechanism.actuated)


def holds(piece: Piece, at: dict[str, float]) -> bool:
    ring = robot()[0].common_twists.ring
    return all(abs(value(text(ring, e), at)) < 1e-7 for e in piece.equations)


def told() -> tuple[list[Piece], list[Piece]]:
    """The pieces on which the platform moves, and those on which limbs idle."""
    both = list(zip(robot()[1].pieces, robot()[1].states, strict=True))
    moving = [p for p, state in both if state.platform_freedom]
    return moving, [p for p, state in both if not state.platform_freedom]


def passive() -> tuple[Assembly, list[Parts]]:
    assembly = robot()[0]
    free = passive_joints(assembly, assembly.mechanism.actuated)
    return assembly, [
        assembly.told([joint for joint in limb.joints if joint in free])
        for limb in assembly.limbs
    ]


def test_the_list_is_complete_with_idle_links() -> None:
    assert robot()[1].complete
    moving, idle = told()
    assert sorted(p.codimension for p in moving) == [1, 1, 3]
    assert [p.codimension for p in idle] == [1, 1, 1, 1]


@pytest.mark.parametrize("along", [(), (0,), (1, 2), (0, 1, 3), (0, 1, 2, 3)])
def test_links_that_meet_in_plan_let_go_wherever_limbs_idle(
    along: tuple[int, ...],
) -> None:
    source = np.random.default_rng(len(along))
    moving, idle = told()
    for _ in range(3):
        at = meeting(source, along)
        assert freedoms(at) == (1 + len(along), 1)
        assert sum(holds(piece, at) for piece in moving) == 1
        assert sum(holds(piece, at) for piece in idle) == len(along)
        beside = at | {"x": at["x"] + 0.1}
        for k in along:  # the link stays parallel to h
            end = beside["x"] + B * np.cos(k * np.pi / 2 + beside["phi"])
            far = beside["y"] + B * np.sin(k * np.pi / 2 + beside["phi"])
            middle = A * turned(k * np.pi / 2) + LENGTHS[k] * turned(
                at[f"theta{k + 1}"]
            )
            beside[f"eta{k + 1}"] = float(np.arctan2(far - middle[1], end - middle[0]))
        assert freedoms(beside) == (len(along), 0)
        assert not any(holds(piece, beside) for piece in moving)
        assert sum(holds(piece, beside) for piece in idle) == len(along)


def test_nothing_is_shown_where_a_piece_is_not_known() -> None:
    assembly, limbs = passive()
    framed = assembly.common_twists
    root, search = assembly.root(framed.ring), Search(assembly.library(framed.ring))
    moving, idle = told()
    assert all_are_held(root, limbs, moving, idle, search, all_known=False)
    for number in range(3):
        fewer = moving[:number] + moving[number + 1 :]
        assert not all_are_held(root, limbs, fewer, idle, search, all_known=True)
        # A limb without a passive joint holds the platform whatever is known.
        assert all_are_held(root, [*limbs, []], fewer, idle, search, all_known=False)


def test_lines_that_meet_are_not_shown_to_hold() -> None:
    """The 3-RPR robot: its determinant taken for a piece on which limbs idle."""
    case = load(str(nao.ROOT / "cases" / "3rpr_planar.yaml"))
    assembly = case.assembly
    free = passive_joints(assembly, case.mechanism.actuated)
    limbs = [
        assembly.told([joint for joint in limb.joints if joint in free])
        for limb in assembly.limbs
    ]
    framed = assembly.common_twists
    root, search = assembly.root(framed.ring), Search(assembly.library(framed.ring))
    (piece,) = actuation_locus(assembly, case.mechanism.actuated).pieces
    assert all_are_held(root, limbs, [piece], [], search, all_known=True)
    assert not all_are_held(root, limbs, [], [piece], search, all_known=True)


def test_arms_whose_wrenches_are_more_than_they_need_be() -> None:
    """Three arms on a disc, each with a pencil of forces at its wrist.

    Where axes 3 and 5 of an arm are one line it idles, and the disc is held there as at
    other postures; it moves where the determinant of the forces vanishes.
    """
    case = load(str(nao.ROOT / "cases" / "three_arms.yaml"))
    found = actuation_locus(case.assembly, case.mechanism.actuated)
    assert found.complete
    freedom = [state.platform_freedom for state in found.states]
    assert sorted(freedom) == [0, 0, 0, 1]
    ring = case.assembly.common_twists.ring
    source = np.random.default_rng(4)
    for arm in "ABC":
        at = {f"q{k}{n}": float(source.uniform(-3, 3)) for k in "ABC" for n in range(6)}
        at |= {"l": 0.5, "m": 0.3, f"q{arm}4": 0.0}
        limbs = [
            limb_columns(case.mechanism, [f"{k}{n}" for n in range(1, 6)], at)[:, 1:]
            for k in "ABC"
        ]
        assert freedoms_of(limbs) == (1, 0)
        on = [
            state.platform_freedom
            for piece, state in zip(found.pieces, found.states, strict=True)
            if all(abs(value(text(ring, e), at)) < 1e-9 for e in piece.equations)
        ]
        assert on == [0]
