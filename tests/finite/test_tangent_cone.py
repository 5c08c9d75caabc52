"""Motions that leave a posture in few directions, which chance does not meet."""

from __future__ import annotations

import numpy as np
import pytest
from finite.sample_linkages import Z, model, turn

from screwkit.finite.exponentials import stance_of
from screwkit.finite.finite_motion import finite_motion
from screwkit.finite.local_dimension import EXACT_CUT, Kernel
from screwkit.finite.loop_split import split_at
from screwkit.finite.posture_model import PostureModel, scaled
from screwkit.finite.spanning_forest import forest_of
from screwkit.finite.tangent_cone import quadratic_forms, second_order_directions


def rotating_squares(count: int) -> PostureModel:
    """Squares of a closed tiling, hinged at corners: they turn to and fro together.

    Squares of one colour turn by θ, those of the other by −θ; in the tiling itself
    many more rates keep the loops closed to first order.
    """
    joints = []
    for i in range(count):
        for j in range(count):
            side = -1 if (i + j) % 2 == 0 else 1
            if i + 1 < count:
                ends = f"s{i}{j}", f"s{i + 1}{j}"
                point = (2 * i + 1, 2 * j + side, 0)
                joints.append(turn("x".join(ends), *ends, Z, point))
            if j + 1 < count:
                ends = f"s{i}{j}", f"s{i}{j + 1}"
                point = (2 * i - side, 2 * j + 1, 0)
                joints.append(turn("y".join(ends), *ends, Z, point))
    return model("s00", f"s{count - 1}{count - 1}", *joints)


def kernel_of(linkage: PostureModel) -> tuple[Kernel, PostureModel]:
    forest = forest_of(linkage)
    split, _ = split_at(
        forest, stance_of(linkage, forest), cut=float(np.sqrt(np.prod(EXACT_CUT)))
    )
    return Kernel(split, split.right[0, :, split.rank :]), linkage


@pytest.mark.parametrize("count", [3, 4, 5])
def test_rotating_squares_leave_their_tiling(count: int) -> None:
    found = finite_motion(rotating_squares(count))
    assert (found.status, found.mobility) == ("sampled", (1,))
    (branch,) = found.branches
    # The last square has the colour of the first, so it does not turn against it.
    assert branch.motion_type == "1T0R"


def test_the_cone_of_the_squares_is_their_motion() -> None:
    """All hinges turn by the same angle, each by the sign of its two squares."""
    kernel, linkage = kernel_of(scaled(rotating_squares(4)))
    forest = forest_of(linkage)
    found = second_order_directions(
        forest, stance_of(linkage, forest), kernel, 24, np.random.default_rng(0)
    )
    (direction,) = found
    assert np.allclose(np.abs(direction), 24**-0.5, atol=1e-6)


def test_forms_vanish_along_a_motion() -> None:
    """By the derivative of the closure along the known direction, twice."""
    kernel, linkage = kernel_of(scaled(rotating_squares(3)))
    forest = forest_of(linkage)
    origin = stance_of(linkage, forest)
    forms = quadratic_forms(forest, origin, kernel)
    (direction,) = second_order_directions(
        forest, origin, kernel, 24, np.random.default_rng(1)
    )
    inside = kernel.basis.T @ direction
    values = np.einsum("kij,i,j->k", forms, inside, inside)
    assert np.abs(values).max() < 1e-6 < np.abs(forms).max()


def shaky_rest_on_a_hinge() -> PostureModel:
    """A body on a hinge, with a flat loop of four hinges upon it that never moves.

    To first order its bars may turn, each point of a line across it; the second order
    stretches them.
    """
    ends = (("b", "c"), ("c", "d"), ("d", "e"), ("e", "b"))
    places = [(0, 0, 0), (1, 0, 0), (3, 0, 0), (6, 0, 0)]
    flat = [
        turn(f"J{i}", *pair, Z, place)
        for i, (pair, place) in enumerate(zip(ends, places, strict=True))
    ]
    root = turn("root", "ground", "b", (1, 0, 0), (9, 9, 9))
    return model("ground", "d", root, *flat)


def test_the_type_along_a_branch_is_not_that_of_its_rates() -> None:
    """Only the hinge moves on: rates of the flat loop are no motion."""
    found = finite_motion(shaky_rest_on_a_hinge())
    assert found.mobility == (1,)
    (branch,) = found.branches
    assert (branch.motion_type, branch.finite_type) == ("1T2R", "0T1R")
    assert branch.instantaneous_mobility == 3


def test_along_a_regular_branch_both_are_one() -> None:
    found = finite_motion(rotating_squares(3))
    (branch,) = found.branches
    assert branch.finite_type == branch.motion_type
