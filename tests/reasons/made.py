"""Mechanisms made of exact numbers, which tests can turn, shift, scale and reorder."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import TypeAlias

from screwkit.algebra.expression import Number
from screwkit.mechanism.model import Joint, JointType, Mechanism, VectorExpression

Vector: TypeAlias = tuple[Fraction, ...]
R, P, S, C = (
    JointType.REVOLUTE,
    JointType.PRISMATIC,
    JointType.SPHERICAL,
    JointType.CYLINDRICAL,
)


@dataclass(frozen=True)
class MadeJoint:
    name: str
    type: JointType
    parent: str
    child: str
    axes: tuple[Vector, ...] = ()
    point: Vector | None = None

    @property
    def joint(self) -> Joint:
        point = None if self.point is None else written(self.point)
        return Joint(
            self.name,
            self.type,
            self.parent,
            self.child,
            axes=tuple(map(written, self.axes)),
            point=point,
        )


@dataclass(frozen=True)
class Made:
    base: str
    platform: str
    joints: tuple[MadeJoint, ...]

    @property
    def mechanism(self) -> Mechanism:
        met = dict.fromkeys(x for j in self.joints for x in (j.parent, j.child))
        links = tuple(dict.fromkeys((self.base, self.platform, *met)))
        joints = tuple(joint.joint for joint in self.joints)
        return Mechanism(
            "made", "Made", self.base, self.platform, links, joints, "posture"
        )


def written(vector: Vector) -> VectorExpression:
    x, y, z = map(Number, vector)
    return x, y, z


def vector(*coordinates: float | str | Fraction) -> Vector:
    return tuple(Fraction(c) for c in coordinates)


def joint(
    name: str,
    kind: JointType,
    parent: str,
    child: str,
    axis: Sequence[float] | None = None,
    point: Sequence[float] | None = None,
) -> MadeJoint:
    return MadeJoint(
        name,
        kind,
        parent,
        child,
        () if axis is None else (vector(*axis),),
        None if point is None else vector(*point),
    )


def scrambled(made: Made, seed: int) -> Made:
    """The same mechanism elsewhere, in other units, in another order, turned round."""
    source = random.Random(seed)
    w, x, y, z = (Fraction(source.randint(1, 7)) for _ in range(4))
    square = w * w + x * x + y * y + z * z
    rows = (
        (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
    )
    shift = [Fraction(source.randint(-9, 9)) for _ in range(3)]
    scale = Fraction(source.randint(1, 9), source.randint(1, 9))

    def turned(v: Vector) -> Vector:
        return tuple(
            sum((a * b for a, b in zip(row, v, strict=True)), Fraction(0)) / square
            for row in rows
        )

    def moved(own: MadeJoint) -> MadeJoint:
        axes = []
        for axis in own.axes:
            factor = Fraction(source.choice((-3, -1, 2)), source.randint(1, 5))
            axes.append(tuple(factor * c for c in turned(axis)))
        point = own.point
        if point is not None:
            at = turned(point)
            point = tuple(scale * c + s for c, s in zip(at, shift, strict=True))
        result = replace(own, axes=tuple(axes), point=point)
        if source.random() < 0.5:
            result = replace(
                result,
                parent=own.child,
                child=own.parent,
                axes=tuple(reversed(result.axes)),
            )
        return result

    joints = [moved(own) for own in made.joints]
    source.shuffle(joints)
    return replace(made, joints=tuple(joints))


def four_bar() -> Made:
    """Four parallel hinges."""
    axis = (0, 0, 1)
    return Made(
        "ground",
        "coupler",
        (
            joint("A", R, "ground", "crank", axis, (0, 0, 0)),
            joint("B", R, "crank", "coupler", axis, (1, 2, 0)),
            joint("C", R, "coupler", "rocker", axis, (5, 3, 0)),
            joint("D", R, "rocker", "ground", axis, (4, 0, 0)),
        ),
    )


def door() -> Made:
    """Two hinges on one axis."""
    return Made(
        "frame",
        "leaf",
        (
            joint("low", R, "frame", "leaf", (0, 0, 1), (0, 0, 0)),
            joint("high", R, "frame", "leaf", (0, 0, 1), (0, 0, 2)),
        ),
    )


def spherical_four_bar() -> Made:
    """Four hinges through one point."""
    axes = ((1, 0, 0), (1, 2, 1), (0, 3, 1), (-1, 1, 4))
    ends = ("ground", "one", "two", "three", "ground")
    return Made(
        "ground",
        "two",
        tuple(
            joint(name, R, parent, child, axis, (0, 0, 0))
            for name, parent, child, axis in zip(
                "abcd", ends, ends[1:], axes, strict=False
            )
        ),
    )


def sarrus() -> Made:
    """Three hinges along x and three along y: one couple about z is redundant."""
    x, y = (1, 0, 0), (0, 1, 0)
    return Made(
        "floor",
        "lid",
        (
            joint("a", R, "floor", "one", x, (0, -2, 0)),
            joint("b", R, "one", "two", x, (0, -3, 2)),
            joint("c", R, "two", "lid", x, (0, -2, 4)),
            joint("d", R, "floor", "three", y, (-2, 0, 0)),
            joint("e", R, "three", "four", y, (-4, 0, 2)),
            joint("f", R, "four", "lid", y, (-2, 0, 4)),
        ),
    )


def scissor(cells: int) -> Made:
    """A chain of planar four-bars, each sharing a pivot with the next."""
    axis = (0, 0, 1)
    joints = [
        joint(f"piv{i}", R, f"b{i}", f"a{i}", axis, (2 * i, 0, 0))
        for i in range(cells + 1)
    ]
    for i in range(cells):
        joints += [
            joint(f"up{i}", R, f"b{i}", f"a{i + 1}", axis, (2 * i + 1, 1, 0)),
            joint(f"dn{i}", R, f"a{i}", f"b{i + 1}", axis, (2 * i + 1, -1, 0)),
        ]
    return Made("b0", f"a{cells}", tuple(joints))


def three_sliders() -> Made:
    """Three CRR limbs along x, y and z: each keeps two couples from the platform."""
    joints = []
    axes = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
    offsets = ((0, 3, 1), (1, 0, 3), (3, 1, 0))
    elbows = ((0, 4, 3), (3, 0, 4), (4, 3, 0))
    wrists = ((0, 1, 4), (4, 0, 1), (1, 4, 0))
    for i, axis in enumerate(axes, start=1):
        places = offsets[i - 1], elbows[i - 1], wrists[i - 1]
        slider, rod = f"slider{i}", f"rod{i}"
        joints += [
            joint(f"C{i}", C, "base", slider, axis, places[0]),
            joint(f"R{i}", R, slider, rod, axis, places[1]),
            joint(f"Q{i}", R, rod, "platform", axis, places[2]),
        ]
    return Made("base", "platform", tuple(joints))


def two_parallelogram_limbs() -> Made:
    """Two limbs of a slider, a hinge, a parallelogram and a hinge.

    The slider runs across the limb, as the parallelogram does: together they idle.
    """
    joints = []
    for n, (x, y) in (("1", (1, 0)), ("2", (0, 1))):
        across, side = (y, x, 0), (4 * x, 4 * y, 1)
        near, far = (x, y, 0), (2 * x, 2 * y, -4)
        left, right = (
            [
                tuple(c + sign * d for c, d in zip(at, across, strict=True))
                for at in ends
            ]
            for sign, ends in ((1, (near, far)), (-1, (near, far)))
        )
        joints += [
            joint(f"P{n}", P, "base", f"cart{n}", across),
            joint(f"H{n}", R, f"cart{n}", f"bar{n}", across, near),
            joint(f"p{n}", R, f"bar{n}", f"left{n}", side, left[0]),
            joint(f"q{n}", R, f"left{n}", f"foot{n}", side, left[1]),
            joint(f"r{n}", R, f"bar{n}", f"right{n}", side, right[0]),
            joint(f"s{n}", R, f"right{n}", f"foot{n}", side, right[1]),
            joint(f"K{n}", R, f"foot{n}", "platform", across, far),
        ]
    return Made("base", "platform", tuple(joints))


def three_bars() -> Made:
    """A body on three parallel bars of one length, in the plane."""
    axis = (0, 0, 1)
    joints = []
    for i, x in enumerate((0, 3, 7), start=1):
        joints += [
            joint(f"A{i}", R, "ground", f"bar{i}", axis, (x, 0, 0)),
            joint(f"B{i}", R, f"bar{i}", "body", axis, (x + 1, 2, 0)),
        ]
    return Made("ground", "body", tuple(joints))


def six_rods() -> Made:
    """A body on six rods with a ball at each end: six rods spin."""
    low = ((5, 1, 0), (3, 4, 0), (-3, 4, 0), (-5, 1, 0), (-1, -5, 0), (2, -5, 1))
    high = ((2, 3, 6), (1, 2, 7), (-2, 3, 5), (-3, 1, 6), (-2, -3, 7), (3, -2, 6))
    joints = []
    for i, (a, b) in enumerate(zip(low, high, strict=True), start=1):
        joints += [
            joint(f"A{i}", S, "base", f"rod{i}", None, a),
            joint(f"B{i}", S, f"rod{i}", "body", None, b),
        ]
    return Made("base", "body", tuple(joints))


def rssr() -> Made:
    """A four-bar in space, whose coupler spins."""
    return Made(
        "ground",
        "follower",
        (
            joint("r1", R, "ground", "crank", (0, 0, 1), (0, 0, 0)),
            joint("s1", S, "crank", "rod", None, (2, 0, 0)),
            joint("s2", S, "rod", "follower", None, (6, 5, 2)),
            joint("r2", R, "follower", "ground", (1, 2, 0), (6, 0, 0)),
        ),
    )


def with_pendulum(made: Made) -> Made:
    """A loose body hangs on the base, and one on that."""
    return replace(
        made,
        joints=(
            *made.joints,
            joint("hook", R, made.base, "pendulum", (0, 1, 0), (9, 9, 9)),
            joint("eye", S, "pendulum", "bob", None, (9, 9, 5)),
        ),
    )


ALL: dict[str, Callable[[], Made]] = {
    "four bar": four_bar,
    "door": door,
    "spherical four bar": spherical_four_bar,
    "sarrus": sarrus,
    "scissor": lambda: scissor(4),
    "three sliders": three_sliders,
    "parallelogram limbs": two_parallelogram_limbs,
    "three bars": three_bars,
    "six rods": six_rods,
    "rssr": rssr,
    "pendulum": lambda: with_pendulum(rssr()),
}
