"""Every recomputed number of the two Bicchi papers, from files alone."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from grasping.cooperating import REFERENCE, mechanism_file, published
from numpy.typing import NDArray

import screwkit as sk
from screwkit.grasping.exact_grasp import exact_grasps
from screwkit.grasping.partition import BLOCKS, Blocks, blocks_of
from screwkit.metrics.float_grasp import float_matrices, float_weights, of_matrices
from screwkit.metrics.indices import FloatGrasp, Indices, indices

Array = NDArray[np.float64]
CASES = published()
ORDER = {3: [1, 2, 0], 6: [3, 4, 5, 0, 1, 2]}  # (ω; v) as the reference has it
DIGITS = 1e-10
WITH_PROJECTOR = [n for n in CASES if "kernel_projector_u_q" in CASES[n]["expected"]]


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("cooperating")


@cache
def analysed(name: str, folder: Path) -> tuple[Any, Blocks, FloatGrasp, Indices]:
    path = folder / "cooperating.yaml"
    path.write_text(mechanism_file(CASES[name]["geometry"]), encoding="utf-8")
    mechanism = sk.load(path).mechanism
    exact, _ = exact_grasps(mechanism)
    matrices = float_matrices(mechanism)
    grasp = of_matrices(matrices, exact.ranks)
    weights = float_weights(mechanism, matrices, {})
    return exact, blocks_of(exact), grasp, indices(grasp, weights)


def close(found: Array, expected: object) -> bool:
    wanted = np.asarray(expected, float)
    if np.size(found) == np.size(wanted) == 0:
        return True
    scale = max(1.0, float(np.abs(wanted).max()))
    return found.shape == wanted.shape and bool(
        np.abs(found - wanted).max() <= DIGITS * scale
    )


@pytest.mark.parametrize("name", CASES)
def test_dimensions_of_motions_and_forces(name: str, folder: Path) -> None:
    exact, blocks, _, found = analysed(name, folder)
    wanted = CASES[name]["expected"]
    ranks = exact.ranks
    assert dict(zip(BLOCKS, blocks.dimensions, strict=True)) == {
        block: wanted["gamma_dims"][block] for block in BLOCKS
    }
    found_numbers = {
        "rows_H": ranks.rows,
        "rank_G": ranks.o,
        "rank_J": ranks.ap,
        "dim_ker_G": ranks.rows - ranks.o,
        "dim_ker_GT": ranks.twists - ranks.o,
        "dim_ker_J": ranks.actuated + ranks.passive - ranks.ap,
        "dim_ker_JT": ranks.rows - ranks.ap,
        "force_dim_s": ranks.structural,
        "force_dim_h": ranks.internal,
        "force_dim_a": ranks.coordinated,
        "force_n_static_indet": ranks.static_indeterminacy,
        "force_dim_ker_JpT": ranks.admissible,
        "kin_n_inf": found.kinematic.infinite,
        "kin_n_zero": found.kinematic.zero,
    }
    assert found_numbers == {key: wanted[key] for key in found_numbers}


@pytest.mark.parametrize("name", CASES)
def test_mobility_connectivity_redundancy_indeterminacy(
    name: str, folder: Path
) -> None:
    exact, _, _, _ = analysed(name, folder)
    wanted = CASES[name]["expected"]
    ranks = exact.ranks
    freedoms = ranks.actuated + ranks.passive
    mobility = freedoms + ranks.twists - ranks.apo
    redundancy, indeterminacy = freedoms - ranks.ap, ranks.twists - ranks.o
    assert (mobility, redundancy, indeterminacy) == (
        wanted["Nm"],
        wanted["Nr"],
        wanted["Ni"],
    )
    assert wanted["n_coordinated"] == mobility - redundancy - indeterminacy
    assert wanted["Nc"] == mobility - redundancy


@pytest.mark.parametrize(
    "name",
    [name for name in CASES if "kernel_projector_u_q" in CASES[name]["expected"]],
)
def test_the_motions_are_those_of_the_reference(name: str, folder: Path) -> None:
    """All blocks together span the null space of [Gᵀ −J], whose projector is known."""
    exact, blocks, grasp, _ = analysed(name, folder)
    wanted = np.asarray(CASES[name]["expected"]["kernel_projector_u_q"])
    order = ORDER[grasp.gt.shape[1]]
    columns = [exact.matrices.actuated, exact.matrices.passive]
    labels = [label for part in columns for label in part]
    by_number = sorted(range(len(labels)), key=lambda k: int(labels[k]))
    stacked = np.hstack(
        [-grasp.gt[:, order], np.hstack([grasp.ja, grasp.jp])[:, by_number]]
    )
    _, values, right = np.linalg.svd(stacked)
    rank = exact.ranks.apo
    assert rank == len(values) or values[rank] < 1e-9 * values[0] < values[rank - 1]
    null = right[rank:].T
    assert close(null @ null.T, wanted)
    assert sum(blocks.dimensions) == null.shape[1]


@pytest.mark.parametrize("name", CASES)
def test_indices(name: str, folder: Path) -> None:
    _, _, _, found = analysed(name, folder)
    wanted = CASES[name]["expected"]
    size = len(wanted["kin_shape_E"])
    order = np.ix_(ORDER[size], ORDER[size])
    shape = found.kinematic.shape
    kinematic = shape[order] if shape.size else np.zeros((size, size))
    rows = found.structural
    projector = np.linalg.pinv(rows) @ rows if len(rows) else np.zeros((size, size))
    assert close(found.kinematic.finite, wanted["kin_finite"])
    assert close(found.force.finite, wanted["force_ow"])
    assert close(found.internal.finite, wanted["internal"])
    assert close(kinematic, wanted["kin_shape_E"])
    assert close(found.force.shape, wanted["force_shape_E_ow"])
    assert close(projector, wanted["structural_wrench_projector"])


BASIS_OF_THE_PAPER = {"active_as_published", "passive_as_published"}
"""Numbers that depend on a basis which the paper's own text excludes (E14)."""


def test_no_number_of_the_reference_is_left_out() -> None:
    asserted = set(re.findall(r'"(\w+)"', Path(__file__).read_text(encoding="utf-8")))
    asserted |= {"Nm", "Nr", "Ni", "Nc"}
    for case in CASES.values():
        assert set(case["expected"]) <= asserted | BASIS_OF_THE_PAPER


REFERENCES = json.loads((REFERENCE / "cooperating.json").read_text(encoding="utf-8"))
PRINTED_BASES = REFERENCES["cases"]["bicchi_melchiorri"]["case2_published_bases_L1"]
STEWART = REFERENCES["cases"]["bicchi_prattichizzo_stewart"]


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("bicchi_melchiorri:case2_complete_L1", "C_complete"),
        ("bicchi_melchiorri:case2_hard_L1", "C_hard_realigned_to_8_columns"),
    ],
)
def test_the_printed_bases_span_the_motions(name: str, key: str, folder: Path) -> None:
    """C of the two SCARA arms: in the null space, and as many as its dimension (E2)."""
    _, blocks, grasp, _ = analysed(name, folder)
    basis = np.array(PRINTED_BASES[key], float)
    order = ORDER[6]
    stacked = np.hstack([grasp.gt[:, order], -grasp.ja, -grasp.jp])
    assert np.abs(stacked @ basis).max() < 1e-12
    assert np.linalg.matrix_rank(basis) == basis.shape[1] == sum(blocks.dimensions)


WITH_COST = [n for n in CASES if "one_over_C" in CASES[n]["expected"]]


@pytest.mark.parametrize("name", WITH_COST)
def test_the_cost_of_the_stewart_platforms(name: str, folder: Path) -> None:
    """C = (λ_max − 1)² + (λ_min − 1)², [BicchiPrattichizzo] §V-B."""
    _, _, _, found = analysed(name, folder)
    finite = found.kinematic.finite
    wanted = CASES[name]["expected"]["one_over_C"]
    if wanted is not None:
        cost = (finite[0] - 1) ** 2 + (finite[-1] - 1) ** 2
        assert np.isclose(1 / cost, wanted, rtol=1e-10)


def test_six_idle_spins_with_hard_upper_joints(folder: Path) -> None:
    """The same platform on spherical upper joints: its legs spin, nothing else new."""
    wanted = STEWART["a1_b120_hard_upper_joints"]
    like = CASES["bicchi_prattichizzo_stewart:a1_b120_Wu_identity"]["geometry"]
    contacts = [{**contact, "type": "hard"} for contact in like["contacts"]]
    path = folder / "hard.yaml"
    text = mechanism_file({**like, "contacts": contacts})
    path.write_text(text, encoding="utf-8")
    answer = sk.manipulability(sk.load(path))
    gamma, statics = answer.partition.gamma, answer.statics
    assert {block: getattr(gamma, block) for block in BLOCKS} == {
        block: wanted["gamma_dims"][block] for block in BLOCKS
    }
    assert np.allclose(answer.kinematic.finite, wanted["kin_finite"], rtol=1e-10)
    assert sum(len(c.components) for c in answer.contacts) == wanted["rows_H"]
    assert wanted["dim_ker_G"] == wanted["rows_H"] - 6
    assert (statics.internal, statics.structural, statics.admissible) == (
        wanted["force_dim_h"],
        wanted["force_dim_s"],
        wanted["force_dim_ker_JpT"],
    )


FIVE_BAR = json.loads((REFERENCE / "fivebar_exact.json").read_text(encoding="utf-8"))
FILES = {"1,5": "five_bar_15", "2,4": "five_bar_24", "1,2,3,4,5": "five_bar_all"}


@pytest.mark.parametrize("driven", FILES)
def test_the_polynomials_of_the_five_bar_exactly(driven: str) -> None:
    """Monic characteristic polynomials, and their roots to twenty digits."""
    wanted = FIVE_BAR["actuated"][driven]
    found = sk.manipulability(sk.load(FILES[driven]))
    for index, key in ((found.kinematic, "kin"), (found.force, "ow")):
        printed = re.sub(r"(\d+)\*x/(\d+)", r"\1/\2*x", wanted[key]["polynomial"])
        assert index.polynomial == printed
        roots = sorted((Fraction(root) for root in wanted[key]["roots"]), reverse=True)
        assert np.allclose(index.finite, [float(r) for r in roots], rtol=1e-13, atol=0)
    internal = wanted.get("internal", {"polynomial": None})["polynomial"]
    if internal is not None:
        assert found.internal_force.polynomial == re.sub(
            r"(\d+)\*x(\^2)?/(\d+)", r"\1/\3*x\2", internal
        )
    # (20) has the values of (24): what is printed as active there belongs to it.
    assert found.active_force.finite == found.force.finite


@pytest.mark.parametrize("driven", ["1,5", "2,4"])
def test_the_structural_wrench_of_the_five_bar_exactly(driven: str) -> None:
    """(0, 2/√5, −1/√5) in (fx, fy; m) at (−1/2, 0), up to its length."""
    statics = sk.manipulability(sk.load(FILES[driven])).statics
    (wrench,) = statics.structural_wrenches
    found = [Fraction(entry) for entry in wrench]
    assert FIVE_BAR["structural_wrench_direction"]["exact"][0] == "0"
    assert found[0] == 0
    assert found[1] == -2 * found[2]
    assert found[1] != 0
