"""Labelled matrices G, D, H, J: the published ones, and the definitions written out."""

from __future__ import annotations

import json

import numpy as np
import pytest
from grasping.cooperating import REFERENCE
from numpy.typing import NDArray

import screwkit as sk
from screwkit.analyses.grasp_view import LabelledMatrix

Array = NDArray[np.float64]
PRINTED = json.loads((REFERENCE / "cooperating.json").read_text(encoding="utf-8"))[
    "cases"
]["bicchi_melchiorri"]
GRASPS = ["fingers_hard", "fingers_soft_hard", "scara_pair_hard", "hand_three_mixed"]


def numbers(matrix: LabelledMatrix, **values: float) -> Array:
    found = np.asarray(matrix.lambdify()(**values), np.float64)
    return found.reshape(matrix.shape)


@pytest.mark.parametrize(
    ("case", "key"),
    [
        ("fingers_soft", "case1_matrices_L1"),
        ("scara_pair_complete", "case2_matrices_L1"),
    ],
)
def test_the_printed_matrices(case: str, key: str) -> None:
    """G and Dᵀ of [BicchiMelchiorri] §4 with L = 1, and H of two soft fingers."""
    grasp = sk.load(case).grasp
    printed = PRINTED[key]
    assert (numbers(grasp.G_full, L=1.0) == np.array(printed["G"])).all()
    assert (np.array(printed["DT"]) == numbers(grasp.D, L=1.0).T).all()
    if "H_soft_soft" in printed:
        found = numbers(grasp.H, L=1.0)
        wanted = np.array(printed["H_soft_soft"])
        assert found.shape == wanted.shape
        # Rows of one contact before those of the next: the paper lists forces first.
        assert sorted(map(tuple, found.tolist())) == sorted(map(tuple, wanted.tolist()))


@pytest.mark.parametrize("case", GRASPS)
def test_contact_velocities_agree(case: str) -> None:
    """H D q̇ = H G_fullᵀ u is J q̇ = Gᵀ u: the short matrices are products."""
    grasp = sk.load(case).grasp
    source = np.random.default_rng(3)
    mechanism = sk.load(case).mechanism
    values = {p.name: float(source.uniform(0.5, 2)) for p in mechanism.parameters} | {
        name: float(source.uniform(-3, 3)) for name in mechanism.joint_variables
    }
    h, d, g = (numbers(m, **values) for m in (grasp.H, grasp.D, grasp.G_full))
    j, short = numbers(grasp.J, **values), numbers(grasp.G, **values)
    order = [grasp.D.columns.index(label) for label in grasp.J.columns]
    assert np.allclose(h @ d[:, order], j)
    assert np.allclose(h @ g.T, short.T)


def test_a_grasp_matrix_from_its_definition() -> None:
    """G = [I … I; S(c_i − p) … | 0 … 0; I … I], with forces before couples."""
    grasp = sk.load("scara_pair_hard").grasp
    size = 1.7
    points = [np.array([1, 1, 1]) * size, np.array([3, 1, 1]) * size]
    wanted = np.zeros((6, 12))
    for number, (x, y, z) in enumerate(points):
        columns = slice(3 * number, 3 * number + 3)
        wanted[:3, columns] = np.eye(3)
        wanted[3:, columns] = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
        wanted[3:, 6 + 3 * number : 9 + 3 * number] = np.eye(3)
    found = numbers(grasp.G_full, L=size)
    assert np.allclose(found, wanted)


def test_products_check_their_labels() -> None:
    grasp = sk.load("scara_pair_hard").grasp
    product = grasp.H @ grasp.D
    assert product.texts == grasp.J.texts
    with pytest.raises(ValueError, match="D has columns"):
        grasp.D @ grasp.D
