"""A second opinion in floats: placement, twists and loci without the engine.

Nothing here uses the engine's rings or its kinematics: joint frames are products of
4×4 matrices, conditions are evaluated by Python's own arithmetic, ranks come from
singular values with a stated gap.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from screwkit.algebra.expression import Expression
from screwkit.algebra.text import expression_text
from screwkit.mechanism.model import JointType, Mechanism

Array = NDArray[np.float64]
Posture = Mapping[str, float]

_FUNCTIONS = {
    name: getattr(np, {"asin": "arcsin", "acos": "arccos"}.get(name, name))
    for name in ("sin", "cos", "tan", "sqrt", "asin", "acos")
} | {"atan": np.arctan, "atan2": np.arctan2, "pi": math.pi}


@cache
def _code(text: str) -> object:
    return compile(text.replace("^", "**"), "<condition>", "eval")


_SCOPE = {"__builtins__": {}, **_FUNCTIONS}


def value(text: str, posture: Posture) -> float:
    """A text of the expression grammar, evaluated by Python."""
    return float(eval(_code(text), _SCOPE, posture))  # type: ignore[arg-type]


@cache
def _cell(expression: Expression) -> object:
    """A number, or the code of an expression with symbols."""
    text = expression_text(expression)
    try:
        return value(text, {})
    except NameError:
        return _code(text)


def _cell_value(expression: Expression, posture: Posture) -> float:
    cell = _cell(expression)
    if isinstance(cell, float):
        return cell
    return float(eval(cell, _SCOPE, posture))  # type: ignore[arg-type]


def values(texts: Iterable[str], posture: Posture) -> Array:
    return np.array([value(text, posture) for text in texts])


def _screw(axis: int, angle: float, length: float) -> Array:
    """Turn about a coordinate axis and shift along it."""
    c, s = math.cos(angle), math.sin(angle)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    matrix = np.eye(4)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    matrix[axis, 3] = length
    return matrix


def limb_columns(
    mechanism: Mechanism, joints: Sequence[str], posture: Posture
) -> Array:
    """6×n: the twists (ω; v) of a chain of joints that leads away from the base."""
    at = np.eye(4)
    columns = []
    for name in joints:
        joint = mechanism.joint(name)
        assert joint.mdh is not None
        cell = {
            key: _cell_value(getattr(joint.mdh, key), posture)
            for key in ("gamma", "b", "alpha", "d", "theta", "r")
        }
        moved = 0.0
        if joint.variables:
            moved = _cell_value(joint.offsets[0], posture)
            moved += posture[joint.variables[0]]
        turning = joint.type is JointType.REVOLUTE
        theta = cell["theta"] + (moved if turning else 0)
        r = cell["r"] + (0 if turning else moved)
        if cell["gamma"] or cell["b"]:
            at = at @ _screw(2, cell["gamma"], cell["b"])
        at = at @ _screw(0, cell["alpha"], cell["d"]) @ _screw(2, theta, r)
        axis, point = at[:3, 2], at[:3, 3]
        if turning:
            (x, y, z), (p, q, s) = axis, point
            columns.append([x, y, z, q * z - s * y, s * x - p * z, p * y - q * x])
        elif joint.type is JointType.PRISMATIC:
            columns.append([0, 0, 0, *axis])
    return np.array(columns, dtype=float).reshape(-1, 6).T


def loop_matrix(
    limbs: Sequence[Array], passive: Sequence[Sequence[bool]] | None = None
) -> Array:
    """J_c: each limb after the first closes a loop with the first."""
    first, others = limbs[0], limbs[1:]
    widths = [limb.shape[1] for limb in limbs]
    matrix = np.zeros((6 * len(others), sum(widths)))
    for number, limb in enumerate(others):
        rows = slice(6 * number, 6 * number + 6)
        start = sum(widths[: number + 1])
        matrix[rows, : widths[0]] = first
        matrix[rows, start : start + limb.shape[1]] = -limb
    if passive is not None:
        matrix = matrix[:, np.concatenate([np.array(p, bool) for p in passive])]
    return matrix


@dataclass(frozen=True)
class Rank:
    """A rank read from singular values.

    Attributes:
        gap: Smallest kept over the largest dropped singular value.
    """

    rank: int
    gap: float


def rank(matrix: Array, tolerance: float = 1e-7) -> int:
    """Rank by singular values.

    Raises:
        AssertionError: If no factor of 100 separates kept values from dropped ones.
    """
    found = measured_rank(matrix, tolerance)
    assert found.gap > 100, f"no clear gap among the singular values of {matrix}"
    return found.rank


def measured_rank(matrix: Array, tolerance: float = 1e-7) -> Rank:
    if not matrix.size:
        return Rank(0, math.inf)
    sizes = np.linalg.svd(matrix, compute_uv=False)
    kept = int(np.sum(sizes > tolerance * max(float(sizes[0]), 1e-300)))
    if kept == len(sizes) or not kept:
        floor = tolerance * float(sizes[0])
        return Rank(kept, float(sizes[kept - 1]) / floor if kept else math.inf)
    return Rank(kept, float(sizes[kept - 1] / max(sizes[kept], 1e-300)))


@dataclass(frozen=True)
class Freedoms:
    """Ranks of limbs and loops at a posture, and what follows."""

    limbs: tuple[int, ...]
    loop: int
    joints: int

    @property
    def mobility(self) -> int:
        return self.joints - self.loop

    @property
    def platform(self) -> int:
        return self.mobility - (self.joints - sum(self.limbs))


def freedoms(limbs: Sequence[Array], tolerance: float = 1e-7) -> Freedoms:
    return Freedoms(
        tuple(rank(limb, tolerance) for limb in limbs),
        rank(loop_matrix(limbs), tolerance),
        sum(limb.shape[1] for limb in limbs),
    )


def closed_at(components: Sequence[Sequence[str]], posture: Posture) -> Array:
    """For each component, the largest of its equations, in absolute value."""
    return np.array(
        [float(np.max(np.abs(values(c, posture)))) for c in components] or [math.inf]
    )
