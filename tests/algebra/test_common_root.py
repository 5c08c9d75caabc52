"""Common roots modulo a prime, derivatives by dual numbers, systems of conditions."""

from __future__ import annotations

import random

from flint import nmod

from screwkit.algebra.common_root import common_root, interpolated
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.dual_point import Dual, DualRing
from screwkit.algebra.exact_point import PointRing, random_turn
from screwkit.algebra.parse import parse

P = 2**61 - 1


def test_interpolation_gives_back_the_polynomial() -> None:
    coefficients = [3, 0, P - 5, 7]
    places = [2, 5, 11, 12]
    values = [sum(c * x**k for k, c in enumerate(coefficients)) % P for x in places]
    assert interpolated(places, values, P) == coefficients


def test_a_circle_and_a_hyperbola_meet() -> None:
    """x² + y² = 25 and x·y = 12: the points (±3, ±4), (±4, ±3) and no others."""
    found = set()
    for seed in range(20):
        root = common_root(
            lambda x: ([x * x - 25, 0, 1], [-12, x]), 4, random.Random(seed), P
        )
        assert root is not None
        found.add(root)
    assert found == {(3, 4), (4, 3), (P - 3, P - 4), (P - 4, P - 3)}


def test_conditions_without_a_common_root_have_none() -> None:
    assert common_root(lambda x: ([x, 1], [x + 1, 1]), 1, random.Random(1), P) is None


def test_derivatives_are_those_of_calculus() -> None:
    """d/dq of x·sin(q + r)² / (1 + x²) is x·2 sin cos / (1 + x²), r = q + p."""
    source = random.Random(3)
    turns = [random_turn(source, P), random_turn(source, P)]
    x = nmod(source.randrange(P), P)
    field = ConstantField.needed_by([], 1)
    declared = {"q": {0: 1}, "r": {0: 1, 1: 1}}
    point = PointRing(P, field, declared, turns, {"x": x})
    text = parse("x*sin(q + r)^2/(1 + x^2)")
    sine, cosine = (point.value(parse(f"{name}(q + r)")) for name in ("sin", "cos"))
    below = 1 + x * x
    found = DualRing(point, declared, ["x", 0]).of(text)
    by_symbol, by_first = found.changes[0], found.changes[1]
    assert by_first == x * 2 * sine * cosine * 2 / below  # q + r turns twice
    assert by_symbol == sine * sine * (1 - x * x) / (below * below)
    assert found.value == point.value(text)


def test_what_is_replaced_changes_as_it_is_told() -> None:
    """d/dx of x·cos q is −sin q·x·x' + cos q, q turning with x and still otherwise."""
    source = random.Random(4)
    (cosine, sine) = random_turn(source, P)
    x = nmod(source.randrange(P), P)
    field = ConstantField.needed_by([], 1)
    point = PointRing(P, field, {"q": {0: 1}}, [(cosine, sine)], {"x": x})
    ring = DualRing(point, {"q": {0: 1}}, ["x"])
    text = parse("x*cos(q)")
    assert ring.of(text).changes[0] == cosine
    ring.turn(0, (Dual(cosine, {0: -sine}), Dual(sine, {0: cosine})))
    assert ring.of(text).changes[0] == cosine - x * sine
    ring.replace("x", ring.of(parse("x^2")))
    assert ring.of(text).changes[0] == 2 * x * cosine - x * x * sine


def test_roots_change_by_half_the_change_over_the_root() -> None:
    field = ConstantField.needed_by([], 1)
    point = PointRing(P, field, {}, [], {"x": nmod(9, P)})
    root = DualRing(point, {}, ["x"]).of(parse("sqrt(x)"))
    assert root.value * root.value == 9
    assert root.changes[0] * 2 * root.value == 1


def test_moved_points_are_like_new_ones() -> None:
    """What is kept of a point where one angle or symbol is moved is what stays."""
    declared = {"p": {0: 1, 1: -2}, "q": {1: 1}, "r": {2: 3}}
    source = random.Random(5)
    turns = [random_turn(source, P) for _ in range(3)]
    field = ConstantField.needed_by([], 1)
    texts = ("x*sin(p) + cos(q - r)", "x^2*sin(r) - sin(p + q)", "sqrt(x^4)*cos(r)")
    point = PointRing(P, field, declared, turns, {"x": nmod(9, P)})
    before = [point.value(parse(text)) for text in texts]
    for angle in range(3):
        turn = random_turn(source, P)
        changed = [*turns[:angle], turn, *turns[angle + 1 :]]
        moved = point.changed(angle, turn, {"x": nmod(4, P)})
        new = PointRing(P, field, declared, changed, {"x": nmod(4, P)})
        for text in texts:
            assert moved.value(parse(text)) == new.value(parse(text))
    moved = point.changed(numbers={"x": nmod(4, P)})
    new = PointRing(P, field, declared, turns, {"x": nmod(4, P)})
    for text, value in zip(texts, before, strict=True):
        assert moved.value(parse(text)) == new.value(parse(text))
        assert point.value(parse(text)) == value
