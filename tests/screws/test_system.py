"""Twist and wrench systems as values: dimensions, arithmetic, and what they refuse."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest
import sympy

import screwkit as sk
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.case import Case, bundled_cases
from screwkit.errors import FrameMismatchError, UnknownNameError
from screwkit.screw.displacement import Displacement
from screwkit.screw.system import TwistSystem, WrenchSystem, reciprocal_product


@pytest.fixture(scope="module")
def nao() -> Case:
    return sk.load("nao_t14")


def random_values(case: Case, count: int, seed: int = 0) -> dict[str, np.ndarray]:
    source = np.random.default_rng(seed)
    names = [p.name for p in case.mechanism.parameters]
    names += list(case.mechanism.joint_variables)
    return {name: source.uniform(0.3, 1.4, count) for name in names}


def within_reach(case: Case, count: int) -> dict[str, np.ndarray]:
    """Random values at which every root of the twists is real."""
    values = random_values(case, 40 * count)
    real = np.ones(40 * count, bool)
    with np.errstate(invalid="ignore"):
        for limb in case.limbs:
            real &= np.isfinite(limb.twists.lambdify()(**values)).all((1, 2))
    assert real.sum() >= count
    return {name: column[real][:count] for name, column in values.items()}


def test_a_limb_shows_its_joints(nao: Case) -> None:
    right, left = nao.limbs
    assert (right.name, left.name) == ("right", "left")
    assert right.joints == ("1", "2", "3", "4", "5")
    assert repr(right) == "<limb 'right': 1 2 3 4 5>"
    assert nao.limbs is nao.limbs


def test_a_system_is_told_in_one_line(nao: Case) -> None:
    assert repr(nao.limbs[0].twists) == "<TwistSystem of 5 columns in 'torso'>"
    assert repr(nao.limbs[0].wrenches) == "<WrenchSystem of 1 column in 'torso'>"


@pytest.mark.parametrize("name", bundled_cases())
def test_the_wrenches_of_a_limb_are_reciprocal_to_its_twists(name: str) -> None:
    """In a plane the wrenches of a limb are those that can act in it."""
    case = sk.load(name)
    planar = case.mechanism.space == "planar"
    for limb in case.limbs:
        assert limb.twists.dimension + limb.wrenches.dimension == (3 if planar else 6)
        in_space = limb.wrenches + out_of_plane(limb) if planar else limb.wrenches
        assert limb.twists.reciprocal() == in_space
        assert in_space.reciprocal() == limb.twists


def out_of_plane(limb: Any) -> WrenchSystem:
    """Couples about x and y and the force along z: reciprocal to any plane twist."""
    one, zero = (limb.wrenches.ring.context.constant(n) for n in (1, 0))
    columns = tuple(
        tuple(one if place == unit else zero for place in range(6))
        for unit in (2, 3, 4)
    )
    return WrenchSystem(limb.wrenches.ring, columns, limb.wrenches.frame)


def test_the_platform_has_what_both_limbs_allow(nao: Case) -> None:
    right, left = nao.limbs
    both = right.twists & left.twists
    assert both.dimension == 4
    assert both == (right.wrenches + left.wrenches).reciprocal()
    assert (right.twists + left.twists).dimension == 6
    assert (right.wrenches & left.wrenches).dimension == 0


def test_single_screws(nao: Case) -> None:
    arm = nao.limbs[0]
    first, wrench = arm.twists[0], arm.wrenches[0]
    assert first.coordinates == ("0", "1", "0", "-b1", "0", "0")
    assert reciprocal_product(first, wrench) == "0"
    other = nao.limbs[1].wrenches[0]
    power = reciprocal_product(arm.twists[2], other)
    assert power != "0"
    parse(power, limits=RESULT_LIMITS)
    assert wrench in arm.wrenches
    assert other not in arm.wrenches
    assert first not in arm.wrenches
    assert len(list(arm.twists)) == len(arm.twists) == 5


def test_twists_and_wrenches_are_not_added(nao: Case) -> None:
    arm = nao.limbs[0]
    with pytest.raises(TypeError):
        arm.twists + arm.wrenches  # type: ignore[operator]
    with pytest.raises(TypeError):
        arm.twists & arm.wrenches  # type: ignore[operator]
    assert arm.twists != arm.wrenches


def test_frames_are_not_mixed(nao: Case) -> None:
    twists = nao.limbs[0].twists
    identity = Displacement.identity(twists.ring)
    elsewhere = twists.expressed_in("r1", identity)
    with pytest.raises(FrameMismatchError, match=r"'torso'.*'r1'"):
        twists + elsewhere
    with pytest.raises(FrameMismatchError):
        twists & elsewhere
    with pytest.raises(FrameMismatchError):
        reciprocal_product(elsewhere[0], nao.limbs[0].wrenches[0])
    assert twists != elsewhere


def test_mechanisms_are_not_mixed(nao: Case) -> None:
    other = sk.load("nao_t14").limbs[0].twists
    with pytest.raises(ValueError, match="different mechanisms"):
        nao.limbs[0].twists + other


def test_nothing_and_everything() -> None:
    limb = sk.load("dual_puma").limbs[0]
    nothing = limb.wrenches
    assert len(nothing) == 0
    assert nothing.dimension == 0
    assert nothing.to_sympy().shape == (6, 0)
    assert nothing.reciprocal().dimension == 6
    assert nothing.lambdify()(qA1=np.zeros(4)).shape == (4, 6, 0)


def test_an_empty_system_has_everything_for_reciprocal(nao: Case) -> None:
    ring = nao.limbs[0].twists.ring
    nothing = TwistSystem(ring, (), "torso")
    everything = nothing.reciprocal()
    assert isinstance(everything, WrenchSystem)
    assert everything.dimension == 6
    assert everything.assumed_nonzero == frozenset()
    assert everything.reciprocal() == nothing


@pytest.mark.parametrize("name", bundled_cases())
def test_numpy_functions_agree_with_null_spaces(name: str) -> None:
    """Second opinion: singular vectors of the numeric twists, within reach."""
    case = sk.load(name)
    values = within_reach(case, 5)
    for limb in case.limbs:
        twists = limb.twists.lambdify()(**values)
        wrenches = limb.wrenches.lambdify()(**values)
        assert twists.shape == (5, 6, len(limb.twists))
        assert wrenches.shape == (5, 6, limb.wrenches.dimension)
        for t, w in zip(twists, wrenches, strict=True):
            rank = limb.twists.dimension
            _, sizes, rows = np.linalg.svd((t / np.linalg.norm(t, axis=0)).T)
            if rank:  # else the limb lets nothing move
                kept = sizes / sizes[0]
                assert kept[rank - 1] > 1e-5  # a margin on both sides
                assert np.all(kept[rank:] < 1e-12)
            null = rows[rank:, [3, 4, 5, 0, 1, 2]].T
            outside = w - null @ (null.T @ w)
            assert np.abs(outside).max(initial=0) < 1e-10 * np.abs(w).max(initial=1)
            assert np.linalg.matrix_rank(w) == limb.wrenches.dimension if w.size else 1


def test_numpy_functions_take_values_beforehand(nao: Case) -> None:
    values = random_values(nao, 3)
    fixed = dict.fromkeys(("b1", "r1", "d3", "r3", "r5"), 0.1)
    whole = nao.limbs[0].twists.lambdify()
    part = nao.limbs[0].twists.lambdify(fixed)
    angles = {name: v for name, v in values.items() if name not in fixed}
    every: dict[str, Any] = {**values, **fixed}
    assert np.array_equal(part(**angles), whole(**every))
    with pytest.raises(UnknownNameError):
        whole(**angles)
    assert np.array_equal(pickle.loads(pickle.dumps(part))(**angles), part(**angles))


def test_sympy_matrices_agree_with_numpy(nao: Case) -> None:
    values = {name: float(v[0]) for name, v in random_values(nao, 1).items()}
    for system in (nao.limbs[0].twists, nao.limbs[0].wrenches):
        matrix = system.to_sympy()
        assert matrix.shape == (6, len(system))
        assert all(symbol.is_real for symbol in matrix.free_symbols)
        lengths = [s for s in matrix.free_symbols if s.name in ("b1", "r1", "d3", "r3")]
        assert lengths
        assert all(symbol.is_positive for symbol in lengths)
        numbers = matrix.subs({s: values[s.name] for s in matrix.free_symbols})
        ours = system.lambdify()(**values)
        assert np.array(numbers, dtype=float) == pytest.approx(ours)
        assert system[0].to_sympy() == matrix[:, 0]
        assert system.latex().startswith(r"\left[\begin{matrix}")


def test_sympy_values_are_accepted_where_expressions_are() -> None:
    case = sk.load("nao_t14", set_values={"d3": sympy.Rational(1, 50)})
    texts = [t for twist in case.limbs[0].twists for t in twist.coordinates]
    assert not any("d3" in text for text in texts)
    assert any("/50" in text for text in texts)
    root = sk.load("nao_t14", set_values={"d3": sympy.sqrt(2) / 100})
    assert any("sqrt(2)" in t for x in root.limbs[0].twists for t in x.coordinates)
    with pytest.raises(sk.errors.ExpressionError):
        sk.load("nao_t14", set_values={"d3": sympy.exp(1)})


def test_assumptions_hold_where_they_should(nao: Case) -> None:
    """A basis around a minor says which minor; known positive ones are left out."""
    reciprocal = nao.limbs[0].twists.reciprocal()
    assert "sin(q4)" in reciprocal.assumed_nonzero
    assert "r3*cos(q2) + d3*sin(q2)" in reciprocal.assumed_nonzero
    assert nao.limbs[0].twists.assumed_nonzero == frozenset()
