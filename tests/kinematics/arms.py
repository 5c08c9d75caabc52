"""Arms and systems of arms, built by hand, for the tests of the kinematics."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.expression import ZERO, Expression, Number, Pi, Product, Symbol
from screwkit.kinematics.loops import Step
from screwkit.mechanism.model import Joint, JointType, MdhRow, Mechanism, Parameter

Array = NDArray[np.float64]
R, P = JointType.REVOLUTE, JointType.PRISMATIC


@dataclass(frozen=True)
class System:
    """A mechanism with its limbs, and a posture at which it is regular."""

    mechanism: Mechanism
    limbs: tuple[tuple[Step, ...], ...]
    posture: dict[str, float]

    @property
    def joints(self) -> tuple[str, ...]:
        return tuple(name for limb in self.limbs for name, _ in limb)


def number(value: str | float) -> Number:
    return Number(Fraction(str(value)))


def half_turns(value: str) -> Expression:
    return ZERO if value == "0" else Product((number(value), Pi()))


Row = tuple[JointType, str, str, str, str]
"""Type, alpha in half turns, d, theta or r, and b."""


def row(entry: Row) -> MdhRow:
    kind, alpha, d, rest, b = entry
    return MdhRow(
        b=number(b),
        alpha=half_turns(alpha),
        d=number(d),
        theta=number(rest) if kind is P else ZERO,
        r=ZERO if kind is P else number(rest),
    )


def system(arms: Sequence[Sequence[Row]], backwards: int = -1, seed: int = 0) -> System:
    """Arms from one base to one grasped object.

    The arm numbered ``backwards`` is declared from the object's side: its joints have
    their parents nearer to the platform, and its table places the base.
    """
    joints: list[Joint] = []
    limbs: list[tuple[Step, ...]] = []
    links = ["base", "object"]
    for a, rows in enumerate(arms):
        names = [f"{'abc'[a]}{i}" for i in range(1, len(rows) + 1)]
        bodies = [f"link_{name}" for name in names]
        links += bodies
        ends = [*reversed(bodies), "base"] if a == backwards else ["base", *bodies]
        for name, entry, parent, child in zip(
            names, rows, ends, ends[1:], strict=False
        ):
            variables, offsets = (f"q_{name}",), (number("0.1"),)
            joints.append(
                Joint(name, entry[0], parent, child, variables, offsets, (), row(entry))
            )
        joints.append(Joint(f"hold_{a}", JointType.FIXED, bodies[-1], "object"))
        steps = [(name, -1 if a == backwards else 1) for name in names]
        limbs.append(tuple(reversed(steps)) if a == backwards else tuple(steps))
    mechanism = Mechanism(
        "arms", "Arms", "base", "object", tuple(links), tuple(joints), "mdh"
    )
    source = np.random.default_rng(seed)
    posture = {
        joint.variables[0]: float(source.uniform(0.3, 1.2))
        for joint in joints
        if joint.variables
    }
    return System(mechanism, tuple(limbs), posture)


SIX: tuple[Row, ...] = (
    (R, "0", "0", "0.4", "0.1"),
    (R, "-1/2", "0.15", "0", "0"),
    (R, "0", "0.5", "0.02", "0"),
    (R, "-1/2", "0.06", "0.5", "0"),
    (R, "1/2", "0", "0", "0"),
    (R, "-1/2", "0", "0.1", "0"),
)
SIX_B: tuple[Row, ...] = (
    (R, "1/3", "0.6", "0.3", "0"),
    (R, "1/2", "0.1", "0.1", "0"),
    (R, "1/6", "0.4", "0", "0"),
    (R, "1/2", "0", "0.45", "0"),
    (R, "-1/2", "0.05", "0", "0"),
    (R, "1/2", "0", "0.12", "0"),
)
SEVEN: tuple[Row, ...] = (*SIX_B, (R, "1/4", "0.07", "0.05", "0.03"))
SLIDING: tuple[Row, ...] = (
    (P, "1/2", "0.2", "0.3", "0"),
    (R, "1/4", "0.3", "0.1", "0"),
    (P, "-1/2", "0.1", "0.2", "0"),
    (R, "1/2", "0.2", "0.1", "0"),
    (R, "1/3", "0.1", "0", "0"),
)
ENDING_IN_A_SLIDE: tuple[Row, ...] = (*SIX[:5], (P, "1/3", "0.1", "0.4", "0"))


def planar(count: int, shift: str) -> tuple[Row, ...]:
    """Parallel axes: the loop has three redundant equations."""
    return tuple((R, "0", shift if i == 0 else "0.4", "0", "0") for i in range(count))


def nao() -> Mechanism:
    """Two five-joint arms of a humanoid holding one object."""
    quarter, back = half_turns("1/2"), half_turns("-1/2")

    def minus(name: str) -> Expression:
        return Product((Number(Fraction(-1)), Symbol(name)))

    def arm(r1: Expression, d3: Expression) -> list[MdhRow]:
        return [
            MdhRow(b=Symbol("b1"), alpha=back, r=r1),
            MdhRow(alpha=quarter),
            MdhRow(d=d3, alpha=quarter, r=Symbol("r3")),
            MdhRow(alpha=back),
            MdhRow(alpha=quarter, r=Symbol("r5")),
        ]

    joints = []
    for side, first, rows in (
        ("r", 1, arm(minus("r1"), minus("d3"))),
        ("l", 6, arm(Symbol("r1"), Symbol("d3"))),
    ):
        bodies = ["torso", *(f"{side}{i}" for i in range(1, 6))]
        for i, table in enumerate(rows):
            name = str(first + i)
            offset = quarter if name in {"2", "7"} else ZERO
            joints.append(
                Joint(
                    name,
                    R,
                    bodies[i],
                    bodies[i + 1],
                    (f"q{name}",),
                    (offset,),
                    (),
                    table,
                )
            )
    joints += [
        Joint("grasp_right", JointType.FIXED, "r5", "object"),
        Joint("grasp_left", JointType.FIXED, "l5", "object"),
    ]
    lengths = {"b1": "0.1", "r1": "0.098", "d3": "0.015", "r3": "0.105", "r5": "0.1137"}
    return Mechanism(
        name="nao_t14",
        title="Two five-joint arms of a humanoid holding one object",
        base="torso",
        platform="object",
        links=("torso", *(f"{s}{i}" for s in "rl" for i in range(1, 6)), "object"),
        joints=tuple(joints),
        geometry="mdh",
        parameters=tuple(Parameter(n, number(v), True) for n, v in lengths.items()),
    )


NAO_LIMBS = (("1", "2", "3", "4", "5"), ("6", "7", "8", "9", "10"))


def nao_reference() -> dict[str, Any]:
    """Posture, grasp, rates and accelerations published with the paper's data."""
    path = Path(__file__).parents[1] / "reference" / "nao_grasp.json"
    loaded: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    return loaded


def nao_posture() -> dict[str, float]:
    return {f"q{name}": value for name, value in nao_reference()["pose_own"].items()}


def derivatives(values: Array, step: float) -> tuple[Array, Array]:
    """First and second derivative from seven equidistant values, order six."""
    first = np.array([-1, 9, -45, 0, 45, -9, 1]) / 60 / step
    second = np.array([1 / 90, -3 / 20, 3 / 2, -49 / 18, 3 / 2, -3 / 20, 1 / 90])
    return first @ values, second / step**2 @ values
