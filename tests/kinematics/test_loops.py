"""The loop constraint matrix: block form, signs, frames and agreement of rings."""

from __future__ import annotations

import dataclasses
from fractions import Fraction

import numpy as np
import pytest
from kinematics.arms import (
    NAO_LIMBS,
    SEVEN,
    SIX,
    SIX_B,
    SLIDING,
    nao,
    nao_posture,
    system,
)

from screwkit.algebra.expression import Call, Number, Symbol
from screwkit.algebra.modular import ModularRing, prime_for, rank
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.kinematics.grasp import grasp_displacement
from screwkit.kinematics.loops import (
    end_link,
    limb_paths,
    loop_matrix,
    matrix_of_loops,
    ring_at,
    stacked,
)
from screwkit.kinematics.placement import joint_twists
from screwkit.mechanism.graph import limbs
from screwkit.mechanism.model import JointType, Parameter


def test_labels_and_blocks_of_two_arms() -> None:
    mechanism = nao()
    ring = ring_at(mechanism, nao_posture())
    matrix = loop_matrix(mechanism, ring, NAO_LIMBS)
    twists = joint_twists(mechanism, ring, "torso")
    assert matrix.rows == tuple((0, i) for i in range(6))
    assert matrix.columns == tuple((str(i), 0) for i in range(1, 11))
    values = stacked(matrix.entries)
    for k, name in enumerate(matrix.joints):
        sign = 1 if name in NAO_LIMBS[0] else -1
        expected = np.array([float(x) for x in twists[name].coordinates])
        np.testing.assert_array_equal(values[:, k], sign * expected)


def test_block_form_of_three_limbs() -> None:
    arms = system([SIX, SEVEN, SLIDING])
    matrix = loop_matrix(
        arms.mechanism, ring_at(arms.mechanism, arms.posture), arms.limbs
    )
    values = stacked(matrix.entries)
    assert values.shape == (12, 18)
    assert not values[:6, 13:].any()
    assert not values[6:, 6:13].any()
    np.testing.assert_array_equal(values[:6, :6], values[6:, :6])


@pytest.mark.parametrize("reference", [0, 1, 2])
def test_reference_limb_does_not_change_the_solutions(reference: int) -> None:
    arms = system([SIX, SEVEN, SLIDING])
    ring = ring_at(arms.mechanism, arms.posture)
    first = stacked(loop_matrix(arms.mechanism, ring, arms.limbs).entries)
    other = stacked(
        loop_matrix(arms.mechanism, ring, arms.limbs, reference=reference).entries
    )
    assert np.linalg.matrix_rank(np.vstack([first, other])) == 12


def test_frame_does_not_change_the_solutions() -> None:
    mechanism = nao()
    ring = ring_at(mechanism, nao_posture())
    base = stacked(loop_matrix(mechanism, ring, NAO_LIMBS).entries)
    moved = stacked(loop_matrix(mechanism, ring, NAO_LIMBS, frames=["l3"]).entries)
    assert np.linalg.matrix_rank(np.vstack([base, moved])) == 6


@pytest.mark.parametrize("backwards", [-1, 0, 1])
def test_columns_are_derivatives_of_the_grasp(backwards: int) -> None:
    """Signs, also where a joint points from the platform to the base."""
    arms = system([SIX, SIX_B], backwards=backwards, seed=7)
    mechanism = arms.mechanism
    origin = end_link(mechanism, arms.limbs[0])
    matrix = stacked(
        loop_matrix(
            mechanism, ring_at(mechanism, arms.posture), arms.limbs, frames=[origin]
        ).entries
    )
    turn, shift = grasp_displacement(mechanism, arms.posture, arms.limbs)
    step = 1e-6
    for k, name in enumerate(arms.joints):
        ends = []
        for sign in (1, -1):
            moved = dict(arms.posture)
            moved[f"q_{name}"] += sign * step
            ends.append(grasp_displacement(mechanism, moved, arms.limbs))
        (turn_up, shift_up), (turn_down, shift_down) = ends
        spin = (turn_up - turn_down) / (2 * step) @ turn.T
        angular = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
        linear = (shift_up - shift_down) / (2 * step) - np.cross(angular, shift)
        np.testing.assert_allclose(
            -matrix[:, k], np.concatenate([angular, linear]), atol=1e-9
        )


def test_generic_rank_by_residues() -> None:
    mechanism = nao()
    ring = ModularRing(1, prime_for(2, [], 5))
    matrix = loop_matrix(mechanism, ring, NAO_LIMBS)
    assert rank(matrix.entries, ring.prime) == 6


def test_polynomials_specialise_to_residues() -> None:
    mechanism = nao()
    survey = SurveyRing()
    loop_matrix(mechanism, survey, NAO_LIMBS, frames=["r3"])
    exact = TrigonometricRing(survey)
    polynomials = loop_matrix(mechanism, exact, NAO_LIMBS, frames=["r3"]).entries
    ring = ModularRing(2, prime_for(2, [], 6))
    residues = loop_matrix(mechanism, ring, NAO_LIMBS, frames=["r3"]).entries
    point = {}
    for i, ((angle, _),) in enumerate(exact.basis):
        point[f"c{i}"], point[f"s{i}"] = ring.cosine_sine(angle)
    for i, name in enumerate(exact.symbols):
        point[f"x{i}"] = ring.symbol(name)
    for poly_row, row in zip(polynomials, residues, strict=True):
        for polynomial, residue in zip(poly_row, row, strict=True):
            value = ring.zero
            for exponents, c in polynomial.to_dict().items():
                term = ring.rational(Fraction(int(c.p), int(c.q)))
                for name, exponent in zip(exact.names, exponents, strict=True):
                    if exponent:
                        term = term * point[name] ** int(exponent)
                value = value + term
            assert value == residue


def test_any_closed_walk_and_its_reverse() -> None:
    mechanism = nao()
    ring = ring_at(mechanism, nao_posture())
    whole = loop_matrix(mechanism, ring, NAO_LIMBS)
    back = tuple((name, -sign) for name, sign in reversed(whole.loops[0]))
    reverse = matrix_of_loops(mechanism, ring, [back], whole.joints)
    np.testing.assert_array_equal(stacked(whole.entries), -stacked(reverse.entries))


def test_a_parameter_may_be_an_angle_of_an_inverse_function() -> None:
    tilt = Parameter("tilt", Call("atan", (Number(Fraction(3, 4)),)))
    half = Parameter("half", Call("sin", (Symbol("tilt"),)))
    mechanism = dataclasses.replace(nao(), parameters=(tilt, half))
    values = ring_at(mechanism, {}).values
    assert values["tilt"] == pytest.approx(np.arctan(0.75))
    assert values["half"] == pytest.approx(0.6)


def test_limbs_of_the_graph_serve_as_they_are() -> None:
    paths = [limb.path or () for limb in limbs(nao())]
    assert ("grasp_right", 1) in paths[0]
    assert limb_paths(nao(), paths) == limb_paths(nao(), NAO_LIMBS)


def test_wrong_limbs() -> None:
    mechanism = nao()
    with pytest.raises(UnknownNameError, match="did you mean '10'"):
        limb_paths(mechanism, [("1",), ("100",)])
    with pytest.raises(ValueError, match="moving joint"):
        limb_paths(mechanism, [("1",), ("grasp_left",)])
    screw = dataclasses.replace(mechanism.joint("1"), type=JointType.CYLINDRICAL)
    other = dataclasses.replace(mechanism, joints=(screw, *mechanism.joints[1:]))
    with pytest.raises(UndecidedError, match="'1' is cylindrical"):
        limb_paths(other, NAO_LIMBS)
    with pytest.raises(ValueError, match="two limbs"):
        limb_paths(mechanism, [("1", "2")])
    with pytest.raises(ValueError, match="once"):
        limb_paths(mechanism, [("1", "2"), ("2",)])
    with pytest.raises(ValueError, match="sign"):
        limb_paths(mechanism, [(("1", 0),), ("2",)])
