"""Half-angle forms go there and back; proofs of irreducibility are never wrong."""

import pytest
from one_ring import in_one_ring

from screwkit.algebra.division import Divisor
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.half_angle import Form, HalfAngles
from screwkit.algebra.irreducible import is_irreducible, shape
from screwkit.algebra.parse import parse
from screwkit.algebra.restrictions import Layout, Probe
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LONG = "(a*sin(q1)*cos(q2) + b*sin(q3)*cos(q1) + c*sin(q2 + q3) + a*b)^3"


def polynomial(text: str) -> tuple[TrigonometricRing, Polynomial]:
    ring, (value,) = in_one_ring(text)
    return ring, value


def halves(ring: TrigonometricRing) -> HalfAngles:
    return HalfAngles(ring, Layout.of(ring))


@pytest.mark.parametrize(
    "text",
    [
        "sin(q1)",
        "1 + cos(q1)",
        "a*sin(q1)*cos(q2) + b*cos(q1)^2 + c",
        "sin(q1)^3*cos(q2)^2 - a*sin(q2)*cos(q1) + 7/3",
    ],
)
def test_there_and_back(text: str) -> None:
    ring, value = polynomial(text)
    there = halves(ring)
    degrees = there.degrees(value)
    assert there.exact(there.form(value, degrees)) == value


def test_one_angle_may_be_halved_alone() -> None:
    ring, value = polynomial("a*sin(q1)*cos(q2) + b*cos(q1)^2 + c")
    there = halves(ring)
    assert there.exact(there.form(value, [1])) == value


def test_sine_is_a_pair() -> None:
    ring, value = polynomial("sin(q1)")
    there = halves(ring)
    parts = there.factor(there.form(value, [0]))
    assert sorted(form.odd for form, _ in parts) == [(0,), (0,)]
    assert [there.whole(form) for form, _ in there.paired(parts)] == [value]


def test_equations_of_an_odd_form_have_its_zeros() -> None:
    ring, value = polynomial("a*(1 - cos(q1)) - d*sin(q1)")
    there = halves(ring)
    parts = there.paired(there.factor(there.form(value, [0])))
    assert len(parts) == 2
    for form, _ in parts:
        assert isinstance(form, Form)
        assert len(there.equations(form)) == 2


@pytest.mark.parametrize(
    "text",
    [
        "r3*cos(q2) + d3*sin(q2)",
        "2*r1*cos(q2) + d3",
        "a*sin(q1 + q2) + b*cos(q1)",
        "a^2*cos(q1)^2 + b^2*sin(q2)",
        "2*cos(q1) + 1",
        "x^2 + y*sin(q1)",
        "sqrt(3)*cos(q1) + sin(q1)",
    ],
)
def test_irreducible_ones_are_proved(text: str) -> None:
    ring, value = polynomial(text)
    assert is_irreducible(Layout.of(ring), value)


@pytest.mark.parametrize(
    "text",
    [
        "(r3*sin(q2) - d3*cos(q2))^2",
        "1 - cos(q4)",
        "sin(q4)*cos(q4)",
        "(a*sin(q1) + b)*(c*cos(q1) + b*sin(q2))",
        "x*sin(q1)",
        "3*cos(q1)^2 - sin(q1)^2 + sqrt(2)*0",
    ],
)
def test_reducible_ones_are_never_proved(text: str) -> None:
    ring, value = polynomial(text)
    assert not any(shape(Layout.of(ring), value, seed).irreducible for seed in range(5))


@pytest.mark.parametrize(
    ("left", "right"),
    [
        ("sin(q1)", "1 - cos(q1)"),
        ("a*sin(q1 + q2) + b*cos(q1)", "b*sin(q1)*cos(q3) - a"),
        ("1 + cos(q1)", "1 + cos(q1)"),
    ],
)
def test_products_divide(left: str, right: str) -> None:
    ring, product = polynomial(f"({left})*({right})")
    divisor = evaluate(parse(left), ring)
    quotient = evaluate(parse(right), ring)
    assert halves(ring).quotient(product, divisor) == quotient
    assert Divisor(divisor, ring, halves(ring), Layout.of(ring)).divide(product) == (
        quotient
    )


def test_what_does_not_divide_has_no_quotient() -> None:
    ring, value = polynomial("a*sin(q1) + b*cos(q2)")
    divisor = evaluate(parse("a*sin(q1) - b*cos(q2)"), ring)
    assert halves(ring).quotient(value, divisor) is None
    assert Divisor(divisor, ring, halves(ring), Layout.of(ring)).divide(value) is None


@pytest.mark.parametrize("text", ["a*sin(q1)*cos(q2) + b*cos(q1)^2 + c", LONG])
def test_restrictions_divide_where_polynomials_do(text: str) -> None:
    """Short polynomials are restricted term by term, long ones by halves."""
    ring, product = polynomial(f"({text})*(a*cos(q1) + b*sin(q2) + c)")
    layout = Layout.of(ring)
    probe = Probe(layout, 1)
    known = probe.restrictions(product)
    parts = probe.restrictions(evaluate(parse(text), ring))
    assert known is not None
    assert parts is not None
    assert all(known[v] % parts[v] == 0 for v in parts)
