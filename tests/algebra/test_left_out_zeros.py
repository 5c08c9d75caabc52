"""Zeros beside known ones: none, or told by short equations and by single values."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq
from one_ring import in_one_ring

from screwkit.algebra.effort import Effort
from screwkit.algebra.finite_values import unknowns_by_numbers
from screwkit.algebra.implied_modulo import implied_equations
from screwkit.algebra.sturm import real_zeros
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.algebra.zeros_modulo import have_no_zero

# A line x = 0 and the point (1, 0).
LINE = ("x*(x - 1)", "x*y")
# The twisted cubic, and (5, 2, 7) beside it.
CUBIC = (
    "(y - x^2)*(x - 5)",
    "(y - x^2)*(y - 2)",
    "(z - x^3)*(z - 7)",
    "(y - x^2)*(z - 7)",
)


@pytest.mark.parametrize(
    ("texts", "away", "nothing"),
    [
        (LINE, [("x",)], False),
        (LINE, [("x - 1", "y")], False),
        (LINE, [("x",), ("x - 1", "y")], True),
        (LINE, [("x - 1",), ("x + y",)], False),
        (LINE, [("x - y",)], False),
        (CUBIC, [("y - x^2", "z - x^3")], False),
        (CUBIC, [("y - x^2", "z - x^3"), ("x - 5", "y - 2")], False),
        (CUBIC, [("y - x^2",), ("x - 5", "y - 2")], True),
        # Equations of degrees that were not asked before zeros were finitely many.
        (("x^2 - 2", "y^2 - 3"), [("x^12 - 64",)], True),
        (("x^2 - 2", "y^2 - 3", "x^12*y^14 - 64*3^7"), [("x - 1",)], False),
        (("x^2 - 2", "y^2 - 3", "x^12*y^14 - 64*3^7 - 1"), [], True),
        # Solved for z: x·z = y, and where x = 0.
        (("x*z - y", "x + y*z - 1", "y"), [("x",)], False),
        (("x*z - y", "x + y*z - 1", "y"), [("x - 1", "y"), ("x", "y")], True),
        (("sin(a)*cos(b)", "sin(a) - x"), [("sin(a)", "x"), ("cos(b)",)], True),
        (("sin(a)*cos(b)", "sin(a) - x"), [("sin(a)",)], False),
    ],
)
def test_zeros_are_left_out_where_all_of_a_set_hold(
    texts: tuple[str, ...], away: list[tuple[str, ...]], nothing: bool
) -> None:
    ring, equations, sets = _read(texts, away)
    assert have_no_zero(ring, equations, (), sets) is nothing


def test_equations_of_what_is_left_have_numbers_again() -> None:
    """Beside x = 0, which is left out, (3x − 2y, y + 5z − 1) is left."""
    texts = ("x*(3*x - 2*y)", "x*(y + 5*z - 1)", "x*z*(3*x - 2*y + y + 5*z - 1)")
    ring, equations, sets = _read(texts, [("x",)])
    told = implied_equations(ring, equations, (), sets, 10**9)
    linear = [e for e in told if e.total_degree() == 1]
    assert len(linear) == 2
    for x, y, z in ((4, 6, -1), (0, 0, Fraction(1, 5))):
        values = zip(ring.symbol_indices(), (x, y, z), strict=True)
        at = {ring.names[k]: fmpq(*Fraction(v).as_integer_ratio()) for k, v in values}
        assert all(e.subs(at) == 0 for e in linear)


def test_values_of_one_unknown_are_roots_of_a_polynomial_in_numbers() -> None:
    """x² = −7/3 or x = 4 (left out), y = x/11 + 1/2: no real zero."""
    texts = ("(3*x^2 + 7)*(x - 4)", "22*y - 2*x - 11")
    ring, equations, sets = _read(texts, [("x - 4",)])
    found = unknowns_by_numbers(ring, equations, (), sets, Effort(10**9))
    (own,) = found.values()
    # Written in y, the linear equation is solved for x: (11 y − 11/2)² = −7/3.
    assert own == [Fraction(391, 1452), -1, 1]
    assert not real_zeros(own)
    assert unknowns_by_numbers(ring, equations[:1], (), sets, Effort(10**9))


def _read(
    texts: tuple[str, ...], away: list[tuple[str, ...]]
) -> tuple[TrigonometricRing, list[Polynomial], list[list[Polynomial]]]:
    ring, every = in_one_ring(*texts, *(e for own in away for e in own))
    rest = iter(every[len(texts) :])
    return ring, every[: len(texts)], [[next(rest) for _ in own] for own in away]
