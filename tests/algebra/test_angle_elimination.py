"""Elimination of angles: what is left holds at every solution, and leads back."""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction

import numpy as np
import pytest
from loci.numeric import Array, value
from one_ring import in_one_ring

from screwkit.algebra.angle_elimination import eliminated
from screwkit.algebra.angle_norms import without_angle
from screwkit.algebra.branches import random_branch_prime
from screwkit.algebra.effort import Effort
from screwkit.algebra.no_real_angle import never_met
from screwkit.algebra.points import residue
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.polynomial_text import equation_text


def test_two_rods_between_two_points_give_the_law_of_cosines() -> None:
    ring, equations = in_one_ring(
        "a*cos(p) + b*cos(q) - g", "a*sin(p) + b*sin(q)", "a^2 + 2*a*g*cos(p)"
    )
    closing, law = equations[:2], equations[2]
    names = [form[0][0] for form in ring.basis]
    kept = [("angle", names.index("p"))]
    kept += [("x", index) for index in ring.symbol_indices()]
    found = eliminated(ring, closing, kept)
    assert found is not None
    (left,) = found.left
    assert left != law
    source = random.Random(1)
    for _ in range(3):
        prime = random_branch_prime(source)
        point = found.point(source, prime)
        assert point is not None
        assert not any(residue(e, point, prime) for e in closing)
        assert not residue(left, point, prime)
    # a² + g² − 2 a g cos p − b²: the angle q is between the rod and the line.
    b, g, a = (ring.symbol(name) for name in ("b", "g", "a"))
    cosine = ring.cosines[names.index("p")]
    expected = ring.normal(a**2 + g**2 - 2 * a * g * cosine - b**2)
    assert divmod(left, expected)[1] == 0


@pytest.mark.parametrize(
    ("text", "empty"),
    [
        ("5*sin(p) + 13", True),
        ("13*sin(p) + 5", False),
        ("cos(p) + 1", False),
        ("cos(p)^2 + 2", True),
        ("x^2 + 1", True),
        ("x^2 - 2", False),
        ("x^3 - 2", False),
        ("25*cos(p)^2 + 60*sin(p) + 299", True),
    ],
)
def test_real_zeros_of_one_unknown_are_decided(text: str, empty: bool) -> None:
    ring, equations = in_one_ring(text)
    assert never_met(ring, equations) is empty


def test_two_equations_without_a_common_zero() -> None:
    ring, equations = in_one_ring("cos(p) - 1/2", "sin(p) - 1/2")
    assert not never_met(ring, equations[:1])
    assert never_met(ring, equations)


def test_a_number_that_is_not_zero_has_none() -> None:
    ring, _ = in_one_ring("x")
    assert never_met(ring, [ring.rational(Fraction(3))])


@pytest.mark.parametrize(
    ("text", "empty"),
    [
        ("sqrt(14)*sin(p) - 2*cos(p) + 9", True),  # 14 + 4 < 81
        ("sqrt(14)*sin(p) - 2*cos(p) + 4", False),  # 14 + 4 > 16
        ("x^2 + sqrt(2)*x + 1", True),  # 2 < 4
        ("sqrt(2)*x^2 - sqrt(3)", False),
        ("cos(p) - 2*sqrt(2) + 1", True),  # 2√2 − 1 > 1; the conjugate's −2√2 − 1 too
        ("cos(p) + sqrt(2) - 1/2", False),  # 1/2 − √2 > −1
        ("cos(p) - sqrt(2) - 1/4", True),
        ("cos(p) + 2*sqrt(2) - 2", False),
        ("cos(p) - sqrt(2) + 2", False),  # √2 − 2 > −1; the conjugate's is below
        ("cos(p) + sqrt(2) + 1/2", True),  # the conjugate's √2 − 1/2 is a cosine
        ("x^2 + sqrt(3) - 1", True),  # 1 < √3; the conjugate's 1 + √3 has a root
        ("sqrt(2)*cos(p) + sqrt(2)", False),  # π alone
        ("x^2 + x + sqrt(2) - 1", True),  # 4 (√2 − 1) > 1
    ],
)
def test_square_roots_are_multiplied_away(text: str, empty: bool) -> None:
    """Real zeros of A s + B c + C need A² + B² ≥ C²; those of conjugates are none."""
    ring, equations = in_one_ring(text)
    assert never_met(ring, equations) is empty


def test_an_angle_is_taken_out_of_a_square_by_one_linear_equation() -> None:
    """Its solutions at numbers make what is left vanish; other numbers do not."""
    texts = (
        "(2 + cos(p))*sin(q) + sin(p)*cos(q) - 1",
        "cos(q)^2 + 3*sin(q)*cos(q)*cos(p) - 2*sin(q) + sin(p)",
    )
    ring, (linear, square) = in_one_ring(*texts)
    names = [form[0][0] for form in ring.basis]
    p, q = names.index("p"), names.index("q")
    rest = without_angle(ring, [linear, square], q, 0, Effort(10_000))
    assert rest is not None
    (left,) = rest
    assert ("angle", q) not in unknowns(ring, left)
    found = eliminated(ring, [linear, square], [("angle", p)])
    assert found is not None
    assert [str(one) for one in found.left] == [str(left)]
    source = random.Random(3)
    points = []
    for _ in range(40):
        prime = random_branch_prime(source)
        point = found.point(source, prime)
        if point is not None:
            points.append((point, prime))
            assert not residue(linear, *points[-1])
            assert not residue(square, *points[-1])
    assert points
    text = equation_text(ring, left)
    roots = []
    for start in range(60):
        solution = newton(texts, (0.1 * start - 3, 0.23 * start - 7))
        if solution is not None:
            roots.append(solution)
            at = {"p": solution[0], "q": 0.0}
            assert abs(value(text, at)) < 1e-6 * abs(value(text, {**at, "p": 0.9}))
    assert len(roots) > 5


def newton(texts: Sequence[str], at: tuple[float, float]) -> Array | None:
    """A common zero of two texts in p and q, by steps with differences."""
    x = np.array(at)

    def there(x: Array) -> Array:
        return np.array([value(text, {"p": x[0], "q": x[1]}) for text in texts])

    for _ in range(40):
        here = there(x)
        slopes = [(there(x + 1e-7 * row) - here) / 1e-7 for row in np.eye(2)]
        x = x - np.linalg.lstsq(np.array(slopes).T, here, rcond=None)[0]
    return x if np.max(np.abs(there(x))) < 1e-11 else None
