"""Second and higher orders: known orders of contact, known cones."""

from __future__ import annotations

from fractions import Fraction

import pytest
from finite.linkages import (
    doubled_contacts,
    flat_ring,
    frame,
    hinge,
    network,
    ring,
    slider,
)

from screwkit.finite.chain_graph import ChainGraph, chain_graph
from screwkit.finite.higher_order import (
    cone_dimension,
    continuation,
    second_order_forms,
)
from screwkit.kinematics.network import Network

PRIME = 2**61 - 1


def block(of: Network) -> ChainGraph:
    (found,) = chain_graph(of.motion).blocks()
    return found


def watt(length: int, half: int) -> Network:
    """Watt's linkage with the middle of its coupler in a straight guide."""
    return network(
        hinge("A", "ground", "left", (-length, half, 0)),
        hinge("B", "left", "coupler", (0, half, 0)),
        hinge("C", "coupler", "right", (0, -half, 0)),
        hinge("D", "right", "ground", (length, -half, 0)),
        hinge("E", "coupler", "block", (0, 0, 0)),
        slider("F", "block", "ground", (0, 1, 0)),
        platform="coupler",
    )


@pytest.mark.parametrize(("length", "half"), [(3, 1), (2, 5), (7, 3)])
def test_watts_point_leaves_its_line_in_the_fifth_order(length: int, half: int) -> None:
    # x = L²θ⁵/(8c) + …: the well-known approximate straight line.
    found = continuation(block(watt(length, half)))
    assert found.fails_at == 5


def test_three_parallel_bars_of_different_length_fail_in_the_second_order() -> None:
    # Circles of different curvature share a tangent.
    body = frame([((0, 0), (0, 1)), ((1, 0), (1, 1)), ((2, 0), (2, 3))])
    assert continuation(block(body)).fails_at == 2


def test_a_guide_at_the_centre_of_curvature_fails_in_the_third_order() -> None:
    # With cranks of directions (1, 2) and (-1, 3) a coupler point P moves about the
    # pole; a bar from P's centre of curvature follows it to second order only.
    first, second = ((0, 0), (1, 2)), ((5, 0), (4, 3))
    centre = _centre_of_curvature(first, second, (2, 4))
    body = frame([first, second, (centre, (2, 4))])
    assert body.motion.mobility == 1
    assert continuation(block(body)).fails_at == 3


def _centre_of_curvature(
    first: tuple[tuple[int, int], tuple[int, int]],
    second: tuple[tuple[int, int], tuple[int, int]],
    point: tuple[int, int],
) -> tuple[str, str]:
    """Of the path of a coupler point of two cranks, by differentiating it twice."""

    def turned(v: tuple[Fraction, Fraction]) -> tuple[Fraction, Fraction]:
        return -v[1], v[0]

    (a, b), (d, c) = first, second
    u, w = (
        (Fraction(b[0] - a[0]), Fraction(b[1] - a[1])),
        (Fraction(c[0] - d[0]), Fraction(c[1] - d[1])),
    )
    det = u[0] * w[1] - u[1] * w[0]
    gap = Fraction(d[0] - a[0]), Fraction(d[1] - a[1])
    s = (gap[0] * w[1] - gap[1] * w[0]) / det
    pole = a[0] + s * u[0], a[1] + s * u[1]
    # Coupler rate 1, acceleration α: v = k×(X − pole); crank rates from its ends.
    rates = []
    for head, arm in ((b, u), (c, w)):
        speed = turned((head[0] - pole[0], head[1] - pole[1]))
        side = turned(arm)
        rate = (speed[0] * side[0] + speed[1] * side[1]) / (arm[0] ** 2 + arm[1] ** 2)
        rates.append(rate)
    # −ω₁² u + ε₁ ku + (−(c − b) + α k(c − b)) = −ω₂² w + ε₂ kw, with unknown ε₁, ε₂
    # for α = 0, which is one parametrisation of the motion.
    bc = Fraction(c[0] - b[0]), Fraction(c[1] - b[1])
    right = tuple(
        -(rates[1] ** 2) * w[i] + rates[0] ** 2 * u[i] + bc[i] for i in range(2)
    )
    ku, kw = turned(u), turned(w)
    below = -ku[0] * kw[1] + ku[1] * kw[0]
    first_rate = (-right[0] * kw[1] + right[1] * kw[0]) / below
    to = Fraction(point[0] - b[0]), Fraction(point[1] - b[1])
    acceleration = tuple(
        -(rates[0] ** 2) * u[i] + first_rate * ku[i] - to[i] for i in range(2)
    )
    velocity = turned((point[0] - pole[0], point[1] - pole[1]))
    normal = turned(velocity)
    part = acceleration[0] * normal[0] + acceleration[1] * normal[1]
    scale = (velocity[0] ** 2 + velocity[1] ** 2) / part
    centre = point[0] + scale * normal[0], point[1] + scale * normal[1]
    return str(centre[0]), str(centre[1])


def test_bennetts_loop_closes_to_every_order_and_a_spoilt_one_does_not() -> None:
    axes = [(2, -1, -3), (0, 1, 1), (-2, 1, -3), (0, 1, -1)]
    points = [(3, 0, 1), (1, 2, -1), (-3, 0, 1), (-1, -2, -1)]
    found = continuation(block(ring(list(zip(points, axes, strict=True)))))
    assert found.fails_at is None
    assert found.identical
    axes[2] = (-2, 1, -4)
    assert ring(list(zip(points, axes, strict=True))).motion.mobility == 0


def test_hinges_that_meet_a_line_are_shaky() -> None:
    # Every axis meets the z axis, which is therefore no twist of any link but a
    # constraint of all: rank 5, but nothing keeps the axes on the line.
    axes = [(1, 0, 2), (0, 1, 3), (1, 1, 1), (2, -1, 1), (1, 3, -2), (-1, 2, 4)]
    found = continuation(block(ring([((0, 0, k * k), a) for k, a in enumerate(axes)])))
    assert found.fails_at == 2


def test_forms_vanish_on_the_branches_of_a_folded_parallelogram() -> None:
    # Parallelogram and antiparallelogram leave the flat posture with these rates.
    flat = block(flat_ring((0, 0), (1, 0), (4, 0), (3, 0)))
    (form,) = second_order_forms(flat)
    discriminant = form[0][1] ** 2 - form[0][0] * form[1][1]
    assert pow(discriminant, (flat.prime - 1) // 2, flat.prime) == 1, "rational roots"


@pytest.mark.parametrize(
    ("forms", "variables", "dimension"),
    [
        ([], 2, 2),
        ([((1, 0), (0, 1))], 2, 1),
        ([((1, 0), (0, 0)), ((0, 0), (0, 1))], 2, 0),
        ([((0, 1), (1, 0))], 2, 1),
        ([((1, 0), (0, 0)), ((0, 1), (1, 0))], 2, 1),
        ([((1, 0, 0), (0, 1, 0), (0, 0, 1))], 3, 2),
        ([((0, 1, 0), (1, 0, 0), (0, 0, 0)), ((0, 0, 1), (0, 0, 0), (1, 0, 0))], 3, 2),
    ],
)
def test_cones(
    forms: list[tuple[tuple[int, ...], ...]], variables: int, dimension: int
) -> None:
    assert cone_dimension(tuple(forms), variables, PRIME) == dimension
    repeated = tuple(form for form in forms for _ in range(3))
    assert cone_dimension(repeated, variables, PRIME) == dimension


@pytest.mark.parametrize("stages", [2, 3, 5, 6])
def test_a_single_rate_that_opens_late_is_followed_so_far(stages: int) -> None:
    found = continuation(block(doubled_contacts(stages)))
    assert found.fails_at == 2**stages
