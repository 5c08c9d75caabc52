"""Compiled polynomials: agreement with the kinematics over arrays, and their form."""

from __future__ import annotations

import pickle
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from kinematics.arms import NAO_LIMBS, SEVEN, SIX_B, SLIDING, nao, system

from screwkit.algebra.batch import BatchRing
from screwkit.algebra.compiled import Compiled, compile_polynomials
from screwkit.algebra.evaluation import cosine_sine, evaluate
from screwkit.algebra.expression import (
    Call,
    Expression,
    Number,
    Pi,
    Power,
    Product,
    Quotient,
    Sum,
    Symbol,
)
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.errors import UnknownNameError
from screwkit.kinematics.loops import loop_matrix, ring_at, stacked
from screwkit.mechanism.model import Mechanism

BASIS = [(("q1", 1),), (("q6", 1), ("q1", -1))] + [
    ((f"q{i}", 1),) for i in (2, 3, 4, 5, 7, 8, 9, 10)
]


def nao_matrix(plain: bool = True) -> tuple[Mechanism, TrigonometricRing, Compiled]:
    mechanism, survey = nao(), SurveyRing()
    loop_matrix(mechanism, survey, NAO_LIMBS, frames=["r3"])
    ring = TrigonometricRing(survey, None if plain else BASIS)
    matrix = loop_matrix(mechanism, ring, NAO_LIMBS, frames=["r3"])
    return mechanism, ring, compile_polynomials(ring, matrix.entries)


@pytest.mark.parametrize("plain", [True, False])
@pytest.mark.parametrize("batch", [(), (7,), (3, 5), (5000,)])
def test_loop_matrix_of_the_nao(batch: tuple[int, ...], plain: bool) -> None:
    mechanism, _, compiled = nao_matrix(plain)
    source = np.random.default_rng(0)
    posture = {f"q{i}": source.uniform(-3, 3, batch) for i in range(1, 11)}
    ring = ring_at(mechanism, posture)
    found = compiled(ring.values)
    expected = stacked(loop_matrix(mechanism, ring, NAO_LIMBS, frames=["r3"]).entries)
    assert found.shape == (*batch, 6, 10)
    np.testing.assert_allclose(found, expected, atol=5e-15)


def test_constants_of_the_geometry() -> None:
    """Arms with cos(π/3), cos(π/4) and slides: algebraic constants as generators."""
    arms = system([SEVEN, SLIDING, SIX_B], seed=1)
    survey = SurveyRing()
    loop_matrix(arms.mechanism, survey, arms.limbs)
    ring = TrigonometricRing(survey)
    matrix = loop_matrix(arms.mechanism, ring, arms.limbs)
    compiled = compile_polynomials(ring, matrix.entries)
    source = np.random.default_rng(1)
    values = {n: source.uniform(-3, 3, 50) for n in arms.posture}
    batch = ring_at(arms.mechanism, values)
    expected = stacked(loop_matrix(arms.mechanism, batch, arms.limbs).entries)
    np.testing.assert_allclose(compiled(batch.values), expected, atol=1e-12)


def _number(value: int | Fraction) -> Number:
    return Number(Fraction(value))


EXPRESSIONS: dict[str, Expression] = {
    "root": Call("sqrt", (Sum((_number(1), Power(Symbol("a"), 2))),)),
    "inverse": Quotient(Symbol("a"), Sum((_number(2), Symbol("b")))),
    "both": Quotient(_number(1), Call("sqrt", (Sum((_number(3), Symbol("b"))),))),
    "sqrt_of_six": Product((Call("sqrt", (_number(6),)), Symbol("a"))),
    "fifth": Call("cos", (Product((_number(Fraction(1, 5)), Pi())),)),
    "radians": Call("sin", (Sum((_number(Fraction(3, 7)), Symbol("q"))),)),
    "tangent": Call("tan", (Symbol("q"),)),
    "atan": Call("sin", (Call("atan2", (Symbol("a"), Symbol("b"))),)),
}


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_roots_inverses_and_constants(name: str) -> None:
    expression, survey = EXPRESSIONS[name], SurveyRing()
    evaluate(expression, survey)
    ring = TrigonometricRing(survey)
    compiled = compile_polynomials(ring, [evaluate(expression, ring)])
    source = np.random.default_rng(2)
    values = {n: source.uniform(0.1, 1.4, 30) for n in ("a", "b", "q")}
    expected = np.broadcast_to(evaluate(expression, BatchRing(values)), (30,))
    found = compiled(values)
    assert found.shape == (30, 1)
    np.testing.assert_allclose(found[:, 0], expected, rtol=1e-14)


def _little() -> tuple[TrigonometricRing, tuple[Any, Any]]:
    survey = SurveyRing()
    cosine_sine(Symbol("q"), survey)
    evaluate(Symbol("a"), survey)
    ring = TrigonometricRing(survey)
    return ring, (ring.cosine_sine("q")[0], ring.symbol("a"))


def test_constants_fill_the_batch() -> None:
    ring, _ = _little()
    compiled = compile_polynomials(ring, [[ring.zero, ring.one]])
    found = compiled({"q": np.zeros(4), "a": 1.0})
    np.testing.assert_array_equal(found, np.tile([[0.0, 1.0]], (4, 1, 1)))
    np.testing.assert_array_equal(compiled({}), [[0.0, 1.0]])
    assert compiled({"q": np.zeros(0)}).shape == (0, 1, 2)


def test_shapes() -> None:
    ring, (cosine, a) = _little()
    values = {"q": np.zeros((2, 3)), "a": np.asarray(5.0)}
    assert compile_polynomials(ring, cosine * a)(values).shape == (2, 3)
    assert compile_polynomials(ring, [a])(values).shape == (2, 3, 1)
    assert compile_polynomials(ring, ())(values).shape == (2, 3, 0)
    with pytest.raises(ValueError, match="length"):
        compile_polynomials(ring, [[a], [a, a]])


def test_long_sums_and_repeats() -> None:
    ring, (cosine, a) = _little()
    long = (a + cosine + 1) ** 12
    compiled = compile_polynomials(ring, [long, a, long, -long])
    found = compiled({"q": 0.4, "a": 0.3})
    expected = (1.3 + np.cos(0.4)) ** 12
    np.testing.assert_allclose(found, [expected, 0.3, expected, -expected], rtol=1e-13)
    assert "out[2] = out[0]" in compiled.source


def test_products_are_formed_once() -> None:
    ring, (cosine, a) = _little()
    compiled = compile_polynomials(ring, [a**2 * cosine, a**2, a**2 * cosine + a])
    assert compiled.source.count("*") == 2


def test_a_missing_value_is_named() -> None:
    ring, (_, a) = _little()
    with pytest.raises(UnknownNameError, match="'a'"):
        compile_polynomials(ring, [a])({"q": 1.0})


def test_sent_to_another_process() -> None:
    mechanism, _, compiled = nao_matrix()
    values = ring_at(mechanism, {f"q{i}": 0.1 * i for i in range(1, 11)}).values
    before = compiled(values)
    shipped = pickle.loads(pickle.dumps(compiled))
    assert shipped == compiled
    assert hash(shipped) == hash(compiled)
    assert shipped.fingerprint == compiled.fingerprint == nao_matrix()[2].fingerprint
    np.testing.assert_array_equal(shipped(values), before)


def test_no_name_of_a_file_enters_the_code() -> None:
    survey = SurveyRing()
    evaluate(Symbol("__import__('os')"), survey)
    cosine_sine(Symbol("q; x"), survey)
    ring = TrigonometricRing(survey)
    polynomial = ring.symbol("__import__('os')") * ring.cosine_sine("q; x")[1]
    compiled = compile_polynomials(ring, polynomial)
    assert "import" not in compiled.source
    assert ";" not in compiled.source
    assert compiled({"__import__('os')": 2.0, "q; x": 0.5}) == 2 * np.sin(0.5)
