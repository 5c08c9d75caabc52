"""Signs follow from the assumptions, and only where they do."""

import pytest
from one_ring import in_one_ring

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

ASSUMED = Assumptions(frozenset({"r1", "r3", "d3"}), frozenset({"k"}))


def polynomial(text: str) -> tuple[TrigonometricRing, Polynomial]:
    ring, (value,) = in_one_ring(text)
    return ring, value


@pytest.mark.parametrize(
    ("text", "nonzero", "sign"),
    [
        ("0", False, 0),
        ("-3", True, -1),
        ("r3", True, 1),
        ("k", True, None),
        ("x", False, None),
        ("-r3*d3", True, -1),
        ("k^2 + x^2", True, 1),
        ("r1*d3 + r3^2", True, 1),
        ("r1 - d3", False, None),
        ("k*(r1 + x^2)", True, None),
        ("x^2 + y^2", False, None),
        ("x^2 - x + 2", True, None),
        ("k*(x^2 - x + 2)", True, None),
        ("x^2 - 3*x + 1", False, None),
        ("x^2 - x*y + 2", False, None),
        ("1 - sqrt(3)", True, -1),
        ("(1 - sqrt(3))*r1 - x^2", True, -1),
        ("sqrt(2)*r1 - cos(pi/7)*r1", True, 1),
        ("sqrt(r1^2 + d3^2)", True, 1),
        ("sqrt(x^2 + 1)*r1 + 1", True, 1),
        ("sqrt(x)*r1", False, None),
        ("9688*cos(2/5) + 5063*sin(2/5)", True, None),
        ("sqrt(3)*sin(2/5) - 1", True, None),  # transcendental
        ("cos(1/5) + 3*sin(1/10)", True, None),
        ("sin(4/5) - 2*sin(1/10)*cos(1/10)", True, None),
        ("sin(1/5) - q1", False, None),
        ("sin(1/5) - sin(q1)", False, None),
        ("sin(q1)^2 + r1", False, None),
    ],
)
def test_signs(text: str, nonzero: bool, sign: int | None) -> None:
    ring, value = polynomial(text)
    assert ASSUMED.is_nonzero(ring, value) is nonzero
    assert ASSUMED.sign_of(ring, value) == sign
