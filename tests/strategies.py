"""Random small mechanisms: two or three limbs of three to six joints."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from hypothesis import strategies as st

from screwkit.algebra.expression import ZERO, Expression, Number, Pi, Product, Symbol
from screwkit.mechanism.model import Joint, JointType, MdhRow, Mechanism, Parameter

ALPHAS: list[Expression] = [
    ZERO,
    *(Product((Number(Fraction(x)), Pi())) for x in ("1/2", "-1/2", "1")),
]
ALPHAS.append(Product((Number(Fraction(1, 3)), Pi())))
LENGTHS = ("a", "b", "c")


@dataclass(frozen=True)
class Row:
    """A joint before it is in a mechanism; d and r are symbols or zero."""

    turning: bool
    alpha: int
    d: str
    r: str

    def joint(self, name: str, parent: str, child: str) -> Joint:
        """A joint with this row of the table."""
        table = MdhRow(alpha=ALPHAS[self.alpha], d=_length(self.d), r=_length(self.r))
        kind = JointType.REVOLUTE if self.turning else JointType.PRISMATIC
        return Joint(name, kind, parent, child, (f"q{name}",), (ZERO,), (), table)


def _length(name: str) -> Expression:
    return Symbol(name) if name else ZERO


rows = st.builds(
    Row,
    turning=st.sampled_from([True, True, True, False]),
    alpha=st.integers(0, len(ALPHAS) - 1),
    d=st.sampled_from(["", *LENGTHS]),
    r=st.sampled_from(["", *LENGTHS]),
)


@dataclass(frozen=True)
class Arms:
    """Limbs by their rows; the base frame is shared, shifted from limb to limb."""

    limbs: tuple[tuple[Row, ...], ...]

    @property
    def joints(self) -> tuple[tuple[str, ...], ...]:
        return tuple(
            tuple(f"{'ABC'[i]}{k}" for k in range(1, len(limb) + 1))
            for i, limb in enumerate(self.limbs)
        )

    def mechanism(self, links: str = "link", order: tuple[int, ...] = ()) -> Mechanism:
        """The mechanism, its limbs declared in ``order``, its links named at will."""
        joints: list[Joint] = []
        bodies = ["ground", "load"]
        for i in order or range(len(self.limbs)):
            at = "ground"
            for name, row in zip(self.joints[i], self.limbs[i], strict=True):
                body = f"{links}_{name}"
                bodies.append(body)
                joints.append(row.joint(name, at, body))
                at = body
            joints.append(Joint(f"hold_{i}", JointType.FIXED, at, "load"))
        return Mechanism(
            name="arms",
            title="Arms",
            base="ground",
            platform="load",
            links=tuple(bodies),
            joints=tuple(joints),
            geometry="mdh",
            parameters=tuple(Parameter(name, positive=True) for name in LENGTHS),
        )

    def posture(self, seed: int, scale: float = 1.0) -> dict[str, float]:
        """Random angles and lengths; all that is a length times ``scale``."""
        source = np.random.default_rng(seed)
        found = {name: scale * float(source.uniform(0.5, 2)) for name in LENGTHS}
        for names, limb in zip(self.joints, self.limbs, strict=True):
            for name, row in zip(names, limb, strict=True):
                value = float(source.uniform(-3, 3))
                found[f"q{name}"] = value if row.turning else scale * value
        return found


def arms(limbs: int = 3, joints: int = 6) -> st.SearchStrategy[Arms]:
    """Two to ``limbs`` limbs of three to ``joints`` joints."""
    limb = st.lists(rows, min_size=3, max_size=joints).map(tuple)
    return st.lists(limb, min_size=2, max_size=limbs).map(tuple).map(Arms)
