"""Proofs of finite mobility: what moves, what is shaky, what must stay open."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest
from finite.linkages import (
    ball,
    flat_ring,
    frame,
    hinge,
    network,
    ring,
    screw_joint,
    slider,
    universal,
)

from screwkit.finite.chain_graph import chain_graph
from screwkit.finite.finite_proofs import proved_mobility, upper_bound
from screwkit.finite.higher_order import second_order_forms
from screwkit.finite.idle_freedoms import idle_freedoms
from screwkit.kinematics.network import Network, motion

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
Point = tuple[int, int, int]
BENNETT = [
    ((3, 0, 1), (2, -1, -3)),
    ((1, 2, -1), (0, 1, 1)),
    ((-3, 0, 1), (-2, 1, -3)),
    ((-1, -2, -1), (0, 1, -1)),
]


def proved(of: Network) -> tuple[int, ...] | None:
    proof = proved_mobility(of, of.motion)
    return None if proof is None else proof.mobility


def sarrus(legs: int) -> Network:
    places = [((1, 0), (0, 1)), ((0, 1), (1, 0)), ((-1, 0), (0, 1)), ((0, -1), (1, 0))]
    joints = []
    for k, ((x, y), (u, v)) in enumerate(places[:legs]):
        joints += [
            hinge(f"A{k}", "base", f"lower{k}", (2 * x, 2 * y, 0), (u, v, 0)),
            hinge(f"B{k}", f"lower{k}", f"upper{k}", (3 * x, 3 * y, 1), (u, v, 0)),
            hinge(f"C{k}", f"upper{k}", "top", (2 * x, 2 * y, 2), (u, v, 0)),
        ]
    return network(*joints, platform="top")


def line_symmetric_ring() -> Network:
    half = [((2, 0, 1), (1, 2, 2)), ((1, 3, -1), (0, 1, 3)), ((-2, 2, 2), (2, -1, 1))]
    turned = [((-a, -b, c), (-u, -v, w)) for (a, b, c), (u, v, w) in half]
    return ring([*half, *turned])


def origami(columns: int, rows: int) -> Network:
    """A folded sheet of parallelograms after Miura; its vertices are spherical."""

    def corner(i: int, j: int) -> tuple[int, int, int]:
        return 3 * i + j % 2, 2 * j, 2 * (i % 2)

    joints = []
    for i in range(columns):
        for j in range(rows):
            for di, dj in ((1, 0), (0, 1)):
                if i + di < columns and j + dj < rows:
                    here, there = corner(i + di, j + dj), corner(i + 1, j + 1)
                    axis = [b - a for a, b in zip(here, there, strict=True)]
                    one, other = f"p{i}{j}", f"p{i + di}{j + dj}"
                    joints.append(hinge(f"{one}{other}", one, other, here, axis))
    return network(*joints)


def parallelogram_limbs() -> Network:
    """Three limbs, each a slider, a parallelogram and a hinge: a Delta with sliders."""
    joints = []
    for k, (u, v) in enumerate([(1, 0), (-3, 4), (-3, -4)]):
        across = (-v, u, 0)
        out, low = (5 * u, 5 * v, 0), (2 * u, 2 * v, -20)
        joints.append(hinge(f"R{k}", f"slide{k}", f"elbow{k}", out, across))
        joints.append(hinge(f"Q{k}", f"wrist{k}", "table", low, across))
        joints.append(slider(f"P{k}", "base", f"slide{k}", Z))
        normal = (u * -20, v * -20, -3 * (u * u + v * v))
        for side in (1, -1):
            top = tuple(a + side * b for a, b in zip(out, across, strict=True))
            end = tuple(a + side * b for a, b in zip(low, across, strict=True))
            bar = f"bar{k}{side + 1}"
            joints.append(hinge(f"A{k}{side + 1}", f"elbow{k}", bar, top, normal))
            joints.append(hinge(f"B{k}{side + 1}", bar, f"wrist{k}", end, normal))
    return network(*sorted(joints), platform="table")


def four_ruu() -> Network:
    """Limbs with two parallel horizontal axes that must turn oppositely."""
    places = [((5, 0), (4, 2), (2, 0)), ((0, 5), (-1, 4), (0, 2))]
    places += [((-5, 0), (-4, -3), (-2, 0)), ((0, -5), (-2, -4), (0, -2))]
    tilts = [(1, 2, 0), (1, 3, 0), (2, 1, 0), (1, -3, 0)]
    joints = []
    for k, ((foot, elbow, hand), h) in enumerate(zip(places, tilts, strict=True)):
        joints += [
            hinge(f"R{k}", "base", f"a{k}", (*foot, 0)),
            universal(f"U{k}", f"a{k}", f"b{k}", (*elbow, 0), (Z, h)),
            universal(f"V{k}", f"b{k}", "table", (*hand, -4), (h, Z)),
        ]
    return network(*joints, platform="table")


def helices(pitches: tuple[int, ...]) -> Network:
    points = [(0, 0, 0), (1, 3, 0), (4, 5, 0), (7, 1, 0), (3, -2, 0)]
    count = len(pitches)
    return network(
        *(
            screw_joint(f"j{k}", f"b{k}", f"b{(k + 1) % count}", points[k], Z, pitch)
            for k, pitch in enumerate(pitches)
        )
    )


def bennett_and_bars() -> Network:
    """Bennett's loop with two more bodies and ball joints between opposite links."""
    joints = [
        hinge(f"s{k}", f"s{k}", f"s{(k + 1) % 4}", *p) for k, p in enumerate(BENNETT)
    ]
    return network(
        *joints,
        ball("S", "s0", "rod", (7, 1, 2)),
        ball("T", "rod", "arm", (3, 5, -4)),
        hinge("U", "arm", "s2", (-1, 4, 2), (1, 5, 2)),
        platform="arm",
    )


MOVING: list[tuple[str, Callable[[], Network], int]] = [
    ("four bars", lambda: flat_ring((0, 0), (1, 3), (5, 4), (6, 0)), 1),
    ("five bars", lambda: flat_ring((0, 0), (1, 3), (5, 4), (6, 1), (3, -2)), 2),
    ("spherical", lambda: ring([((0, 0, 0), a) for a in (X, Y, (1, 2, 3), Z)]), 1),
    ("Sarrus", lambda: sarrus(2), 1),
    ("Sarrus with four legs", lambda: sarrus(4), 1),
    ("Bennett", lambda: ring(BENNETT), 1),
    ("Bricard", line_symmetric_ring, 1),
    ("Bennett with bars", bennett_and_bars, 2),
    ("Miura vertex", lambda: origami(2, 2), 1),
    ("Miura strip", lambda: origami(3, 2), 1),
    ("parallel bars", lambda: frame([((k, 0), (k + 1, 2)) for k in range(4)]), 1),
    ("equal helices", lambda: helices((2, 2, 2, 2)), 1),
    ("helices", lambda: helices((2, 3, 5, 7, 1)), 1),
    ("Delta with parallelograms", parallelogram_limbs, 3),
    ("4-RUU", four_ruu, 4),
    (
        "two loops that share a body",
        lambda: network(
            *(
                hinge(f"f{k}", f"f{k}", f"f{(k + 1) % 4}", (*p, 0))
                for k, p in enumerate([(0, 0), (1, 3), (5, 4), (6, 0)])
            ),
            *(
                hinge(
                    f"s{k}", f"s{k}" if k else "f0", f"s{k + 1}" if k < 3 else "f0", *p
                )
                for k, p in enumerate(BENNETT)
            ),
            hinge("free", "f2", "flag", (9, 9, 9), X),
        ),
        3,
    ),
]


RIGID: list[tuple[str, Callable[[], Network]]] = [
    ("stretched bars", lambda: flat_ring((0, 0), (1, 0), (3, 0), (6, 0))),
    ("five stretched bars", lambda: flat_ring(*((k * k, 0) for k in range(5)))),
    (
        "bars through one point",
        lambda: frame([((2, 0), (1, 0)), ((0, 3), (0, 1)), ((-2, -4), (-1, -2))]),
    ),
    (
        "parallel bars of different length",
        lambda: frame([((k, 0), (k, 1 + k)) for k in range(3)]),
    ),
    (
        "hinges that meet a line",
        lambda: ring(
            [
                ((0, 0, k * k), axis)
                for k, axis in enumerate(
                    [
                        (1, 0, 2),
                        (0, 1, 3),
                        (1, 1, 1),
                        (2, -1, 1),
                        (1, 3, -2),
                        (-1, 2, 4),
                    ]
                )
            ]
        ),
    ),
    ("Bennett's, spoilt", lambda: ring([*BENNETT[:3], ((-1, -2, -1), (0, 1, -2))])),
]


@pytest.mark.parametrize(
    ("build", "mobility"), [pytest.param(b, m, id=name) for name, b, m in MOVING]
)
def test_what_moves(build: Callable[[], Network], mobility: int) -> None:
    linkage = build()
    assert linkage.motion.mobility == mobility
    assert proved(linkage) == (mobility,)


@pytest.mark.parametrize("build", [pytest.param(b, id=name) for name, b in RIGID])
def test_what_is_rigid_or_shaky(build: Callable[[], Network]) -> None:
    assert proved(build()) == (0,)


@pytest.mark.parametrize(
    "corners",
    [
        [(0, 0), (1, 0), (5, 0), (3, 0)],  # 1 + 4 = 2 + 3: Grashof's change point
        [(0, 0), (1, 0), (4, 0), (3, 0)],  # parallelogram and antiparallelogram
    ],
)
def test_branches_cross_where_four_bars_lie_in_a_line(
    corners: list[tuple[int, int]],
) -> None:
    flat = flat_ring(*corners)
    assert flat.motion.mobility == 2
    assert proved(flat) == (1,)
    bound = upper_bound(flat, flat.motion)
    assert bound is not None
    assert bound.mobility == 1


@pytest.mark.parametrize("corners", [(0, 1, 5, 3), (0, 1, 4, 3)])
def test_branches_cross_whatever_plane_the_four_bars_lie_in(
    corners: tuple[int, ...],
) -> None:
    """In a skew plane several self-stresses ask for one and the same condition."""
    along, normal = (2, 3, 6), (3, -6, 2)
    places = [(tuple(x * u + 5 for u in along), normal) for x in corners]
    flat = ring(places)
    assert flat.motion.mobility == 2
    assert proved(flat) == (1,)
    (form,) = second_order_forms(chain_graph(flat.motion))
    assert len(form) == 2


@pytest.mark.parametrize("lengths", [(1, 1, 1), (1, 1, 2), (1, 2, 3), (2, 2, 2)])
def test_parallel_bars_move_only_if_equal(lengths: tuple[int, ...]) -> None:
    body = frame([((3 * k, 0), (3 * k, length)) for k, length in enumerate(lengths)])
    assert proved(body) == (int(len(set(lengths)) == 1),)


def test_locked_joints_are_rigid() -> None:
    bars = flat_ring((0, 0), (1, 3), (5, 4), (6, 1), (3, -2))
    held = motion(bars, bars.motion.posture, ["j0"])
    proof = proved_mobility(bars, held)
    assert proof is not None
    assert proof.mobility == (1,)


def test_idle_rods_count() -> None:
    rods = network(
        hinge("A", "ground", "crank", (0, 0, 0), (0, 0, 1)),
        ball("B", "crank", "rod", (1, 2, 1)),
        ball("C", "rod", "rocker", (4, 1, 5)),
        hinge("D", "rocker", "ground", (6, 1, 0), (1, 1, 3)),
        platform="rocker",
    )
    assert proved(rods) == (2,)


def test_a_slipping_pin_is_set_apart_from_a_shaky_rest() -> None:
    # Two hinges in line turn against each other; the rest is caught in second order.
    shaky = network(
        hinge("a", "b0", "b1", (-4, 2, 0), Z),
        hinge("b", "b1", "b2", (0, -3, 3), X),
        slider("c", "b2", "b3", X),
        hinge("d", "b3", "b4", (2, 0, -3), Y),
        hinge("e", "b4", "b5", (2, 7, -3), Y),
        hinge("f", "b5", "b6", (0, -3, -3), X),
        hinge("g", "b6", "b0", (-2, -1, 0), Z),
        platform="b3",
    )
    assert shaky.motion.mobility == 2
    proof = proved_mobility(shaky, shaky.motion)
    assert proof is not None
    assert proof.mobility == (1,)
    assert "idle" in proof.reason


def test_what_the_two_joints_of_the_platform_share_is_not_called_idle() -> None:
    # A door on two hinges in line turns, and the door is what is asked for.
    door = network(
        hinge("a", "ground", "door", (0, 0, 0)), hinge("b", "ground", "door", (0, 0, 5))
    )
    proof = proved_mobility(door, door.motion)
    assert proof is not None
    assert proof.mobility == (1,)
    assert "idle" not in proof.reason
    assert "the freedom that the two joints of door share (1)" in proof.reason


def test_a_planar_motion_inside_a_loop_with_one_rate_too_many() -> None:
    # With the two x axes at rest R P R R is a planar loop of one freedom.
    loop = network(
        hinge("a", "b0", "b1", (0, 0, -3), Y),
        hinge("b", "b1", "b2", (0, 1, 3), X),
        slider("c", "b2", "b3", X),
        hinge("d", "b3", "b4", (0, 0, 2), Y),
        hinge("e", "b4", "b5", (0, -1, 3), X),
        hinge("f", "b5", "b0", (-1, 0, -3), Y),
        platform="b3",
    )
    assert loop.motion.mobility == 2
    assert proved(loop) == (1,)


@pytest.mark.parametrize("platform", [((2, 0, 5), (0, 2, 5), (-2, -2, 5))])
def test_balls_at_both_ends_leave_a_spin(platform: tuple[Point, ...]) -> None:
    feet = [(4, 0, 0), (0, 4, 0), (-4, -4, 0)]
    joints = []
    for k, (foot, head) in enumerate(zip(feet, platform, strict=True)):
        joints += [
            ball(f"S{k}", "base", f"rod{k}", foot),
            ball(f"T{k}", f"rod{k}", "table", head),
        ]
    tripod = network(*joints, platform="table")
    assert len(idle_freedoms(tripod.motion)) == 3
    assert proved(tripod) == (6,)


@pytest.mark.parametrize(("quarters", "rates"), [(0, 6), (1, 7), (3, 7)])
def test_an_octahedron_is_shaky_at_a_right_angle(quarters: int, rates: int) -> None:
    # Fichter's singular posture: six rods of fixed length let the platform twitch.
    corners = [("1", "-sqrt(3)"), ("1", "sqrt(3)"), ("-2", "0")]
    for _ in range(quarters):
        corners = [(f"-({y})", x) for x, y in corners]
    feet = [(4, 0, 0), (-2, "2*sqrt(3)", 0), (-2, "-2*sqrt(3)", 0)]
    joints = []
    for k, (b, p) in enumerate([(0, 0), (0, 1), (1, 1), (1, 2), (2, 2), (2, 0)]):
        joints += [
            ball(f"S{k}", "base", f"rod{k}", feet[b]),
            ball(f"T{k}", f"rod{k}", "table", (*corners[p], 3)),
        ]
    truss = network(*joints, platform="table")
    assert truss.motion.mobility == rates
    assert proved(truss) == (6,), "nothing but the spin of the rods"


def test_a_hinge_and_a_helix_translate_together() -> None:
    # Parallel, turned oppositely, they shift; with the x screws that is all it takes.
    loop = network(
        screw_joint("a", "b0", "b1", (0, -4, -1), X, 1),
        hinge("b", "b1", "b2", (0, -2, 0), X),
        hinge("c", "b2", "b3", (-1, -3, 0), Z),
        screw_joint("d", "b3", "b4", (-1, -1, 0), Z, 1),
        screw_joint("e", "b4", "b5", (0, -3, 3), X, 1),
        slider("f", "b5", "b0", Y),
        platform="b3",
    )
    assert loop.motion.rank == 5
    assert proved(loop) == (1,)


def test_symbols_are_proved_for_general_values() -> None:
    parameters = "parameters: {a: {}, b: {}, c: {}, d: {}}\n"
    joints = [
        hinge("A", "ground", "one", (0, 0, 0)),
        hinge("B", "one", "two", ("a", "b", 0)),
        hinge("C", "two", "three", ("c", "d", 0)),
        hinge("D", "three", "ground", (1, 0, 0)),
    ]
    assert proved(network(*joints, extra=parameters)) == (1,)


def test_nothing_is_claimed_of_contacts_beyond_first_order() -> None:
    body = frame([((2, 0), (1, 0)), ((0, 3), (0, 1)), ((-2, -4), (-1, -2))])
    assert proved(body) == (0,)
    body.__dict__["contact_labels"] = frozenset({"f0"})
    assert proved(body) is None


def test_the_reason_tells_the_argument() -> None:
    found = {
        name: proved_mobility(linkage, linkage.motion)
        for name, build, _ in MOVING
        for linkage in [build()]
    }
    reasons = {name: proof.reason for name, proof in found.items() if proof}
    assert "group of dimension 3" in reasons["four bars"]
    assert "guided" in reasons["Sarrus"]
    assert "order 24" in reasons["Bennett"]
    assert "opposite angles" in reasons["4-RUU"]
    assert "joints on no loop (1)" in reasons["two loops that share a body"]
    assert all(not reason.endswith(".") for reason in reasons.values())


def test_order_of_the_joints_does_not_matter() -> None:
    straight = sarrus(2)
    mechanism = straight.mechanism
    shuffled = Network(replace(mechanism, joints=mechanism.joints[::-1]))
    assert proved(shuffled) == proved(straight)
