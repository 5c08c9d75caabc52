"""Points on random slices, angles fixed in numbers, slopes: against plain numbers."""

from __future__ import annotations

from math import asin, isclose, pi

from loci.numeric import value
from one_ring import in_one_ring

from screwkit.algebra.fixed_angles import fixed_angles, put_in
from screwkit.algebra.points import residue
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.sliced_points import sliced_points
from screwkit.algebra.slopes import slope

FOUR_BAR = (
    "4*cos(a) + 3*cos(b) - 4*cos(c) - 4",
    "4*sin(a) + 3*sin(b) - 4*sin(c)",
)


def test_points_on_slices_fulfil_all_equations() -> None:
    """A four-bar that moves, and with coupler and rocker on one line."""
    ring, equations = in_one_ring(*FOUR_BAR, "sin(b)*cos(c) - cos(b)*sin(c)")
    for wanted in (equations[:2], equations):
        points = sliced_points(ring, wanted, (), 3)
        assert len(points) == 3
        for point, prime in points:
            assert not any(residue(equation, point, prime) for equation in wanted)
            for angle in range(3):
                s = point[ring.sine_index(angle)]
                c = point[ring.cosine_index(angle)]
                assert (s * s + c * c) % prime == 1


def test_no_point_is_made_up() -> None:
    ring, equations = in_one_ring("cos(a) + 2", "cos(a) + 1")
    assert sliced_points(ring, equations, (), 2) == ()


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
