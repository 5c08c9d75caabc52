"""Points on random slices, angles fixed in numbers, slopes: against plain numbers."""

from __future__ import annotations

import random
from fractions import Fraction
from math import asin, isclose, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st
from loci.numeric import value
from one_ring import in_one_ring

from screwkit.algebra.effort import Effort
from screwkit.algebra.fixed_angles import fixed_angles, put_in
from screwkit.algebra.macaulay import multiples, zeros
from screwkit.algebra.monomials import Terms
from screwkit.algebra.points import residue
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.slopes import slope
from screwkit.algebra.zeros_modulo import exact_zeros, have_no_zero

FOUR_BAR = (
    "4*cos(a) + 3*cos(b) - 4*cos(c) - 4",
    "4*sin(a) + 3*sin(b) - 4*sin(c)",
)


def test_points_on_slices_fulfil_all_equations() -> None:
    """A four-bar that moves, and with coupler and rocker on one line."""
    ring, equations = in_one_ring(*FOUR_BAR, "sin(b)*cos(c) - cos(b)*sin(c)")
    for wanted in (equations[:2], equations):
        points = exact_zeros(ring, wanted, (), 3)
        assert len(points) == 3
        for point, prime in points:
            assert not any(residue(equation, point, prime) for equation in wanted)
            for angle in range(3):
                s = point[ring.sine_index(angle)]
                c = point[ring.cosine_index(angle)]
                assert (s * s + c * c) % prime == 1


def test_no_point_is_made_up() -> None:
    ring, equations = in_one_ring("cos(a) + 2", "cos(a) + 1")
    assert exact_zeros(ring, equations, (), 2) == ()


def test_of_an_angle_fixed_in_numbers_one_generator_of_degree_one_is_left() -> None:
    """5 sin a − 3 cos a = 3: a is asin(15/17), or −π."""
    fixing = "5*sin(a) - 3*cos(a) - 3"
    other = "cos(a)^3*cos(b) + sin(a)*cos(a)*sin(b) + sin(a)^2 + 2"
    ring, equations = in_one_ring(fixing, other)
    (own,) = fixed_angles(ring, equations)
    kept, left = put_in(ring, equations, [own])
    assert kept == equations[0]
    assert left.degrees()[ring.sine_index(own.angle)] == 0
    assert left.degrees()[ring.cosine_index(own.angle)] == 1
    text = equation_text(ring, left)
    ratios = []
    for a in (asin(15 / 17), -pi):
        for b in (0.7, 2.9):
            at = {"a": a, "b": b}
            assert isclose(value(fixing, at), 0, abs_tol=1e-12)
            ratios.append(value(text, at) / value(other, at))
    assert all(isclose(ratio, ratios[0]) for ratio in ratios)


def test_what_fixes_no_angle_in_numbers_is_left_alone() -> None:
    ring, equations = in_one_ring("x*sin(a) - cos(a)", "sin(a)*cos(b) - 1")
    assert not fixed_angles(ring, equations)
    assert put_in(ring, equations, ()) == equations


def test_slopes_are_differences() -> None:
    text = "x^2*sin(a)*cos(b) + x*cos(a)^3 - sin(b)"
    ring, (polynomial,) = in_one_ring(text)
    at, small = {"x": 1.3, "a": 0.4, "b": 1.1}, 1e-6
    names = {form[0][0]: ("angle", k) for k, form in enumerate(ring.basis)}
    names |= {
        name: ("x", index)
        for name, index in zip(ring.symbols, ring.symbol_indices(), strict=True)
    }
    for name, unknown in names.items():
        up, down = (value(text, at | {name: at[name] + d}) for d in (small, -small))
        # Texts of equations are written up to their sign.
        own = value(equation_text(ring, slope(ring, polynomial, unknown)), at)
        assert isclose(abs(own), abs(up - down) / (2 * small), rel_tol=1e-6)


INCONSISTENT = [
    # Half and a third are not one together; nor are an angle and its complement.
    ("2*cos(a) - 1", "cos(a) + cos(b) - 1", "3*cos(b) - 1"),
    ("sin(a)*cos(b) - cos(a)*sin(b)", "2*cos(a)*cos(b) + 2*sin(a)*sin(b) - 1"),
    ("cos(a) + x", "x^2 - 2", "x*sin(a) - 1", "x*cos(a) - 3"),
]
CONSISTENT = [
    # Complex zeros are zeros, and one equation three times is one.
    ("cos(a) + cos(b) - 3", "sin(a) + sin(b)"),
    ("cos(a) + cos(b) - 1",) * 3,
    ("sin(a)*cos(b) - cos(a)*sin(b)", "cos(a)*cos(b) + sin(a)*sin(b) + 1"),
    (*FOUR_BAR, "sin(b)*cos(c) - cos(b)*sin(c)"),
]


@pytest.mark.parametrize("texts", INCONSISTENT)
def test_equations_that_contradict_each_other_have_no_zero(
    texts: tuple[str, ...],
) -> None:
    ring, equations = in_one_ring(*texts)
    assert have_no_zero(ring, equations, ())
    assert exact_zeros(ring, equations, (), 1) == ()


@pytest.mark.parametrize("texts", CONSISTENT)
def test_equations_with_a_zero_are_never_said_to_have_none(
    texts: tuple[str, ...],
) -> None:
    ring, equations = in_one_ring(*texts)
    assert not have_no_zero(ring, equations, ())


@given(
    st.lists(st.tuples(*[st.integers(-3, 3)] * 5), min_size=2, max_size=6),
    st.integers(1, 5),
    st.integers(1, 5),
)
def test_equations_through_a_point_have_a_zero(
    rows: list[tuple[int, ...]], t: int, u: int
) -> None:
    """However many: each is moved by a constant so that it holds at one posture."""
    at = [
        (Fraction(2 * t, 1 + t * t), Fraction(1 - t * t, 1 + t * t)),
        (Fraction(2 * u, 1 + u * u), Fraction(1 - u * u, 1 + u * u)),
    ]
    (s, c), (s2, c2) = at
    texts = []
    for row in rows:
        constant = sum(
            k * own for k, own in zip(row, (s, c, s2 * c, s2, c2 * s), strict=True)
        )
        terms = ("sin(a)", "cos(a)", "sin(b)*cos(a)", "sin(b)", "cos(b)*sin(a)")
        left = " + ".join(f"({k})*{x}" for k, x in zip(row, terms, strict=True))
        texts.append(f"{left} - ({constant.numerator})/{constant.denominator}")
    ring, equations = in_one_ring(*texts, "sin(a) + cos(a) + sin(b) + cos(b)")
    assert not have_no_zero(ring, equations[:-1], ())


def test_two_circles_meet_in_two_points() -> None:
    """x² + y² = 25 and (x − 6)² + y² = 25 at (3, ±4), modulo any prime."""
    prime = 2**61 - 1
    circles: list[Terms] = [
        {(2, 0): 1, (0, 2): 1, (0, 0): prime - 25},
        {(2, 0): 1, (1, 0): prime - 12, (0, 2): 1, (0, 0): 11},
    ]
    found = multiples(circles, 2, prime, Effort(10**9))
    assert found is not None
    assert len(found.below()) == 2
    points = sorted(zeros(found, random.Random(1)))
    assert points == [[3, 4], [3, prime - 4]]
