"""A second opinion in floats: J_c of a bundled case from its expressions alone.

Twists are written down joint by joint, loops are the null space of the incidence matrix
(no loop is searched), ranks are counted by singular values with a stated gap.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from loci.numeric import Array, limb_columns, value

from screwkit.algebra.expression import Expression
from screwkit.algebra.text import expression_text
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Joint, JointType, Mechanism, VectorExpression

J = JointType
NOISE = 1e-13
"""Singular values below this, relative to the largest, count as this much."""


@dataclass(frozen=True)
class Counted:
    """A rank, and by what factor the singular values fall there."""

    rank: int
    gap: float


def counted(matrix: Array) -> Counted:
    if not matrix.size or not np.any(matrix):
        return Counted(0, np.inf)
    sizes = np.linalg.svd(matrix, compute_uv=False)
    sizes = np.maximum(sizes / sizes[0], NOISE)
    kept = int(np.sum(sizes > 1e-8))
    after = sizes[kept] if kept < len(sizes) else NOISE
    return Counted(kept, float(sizes[kept - 1] / after))


def null_vectors(matrix: Array) -> Array:
    """Orthonormal columns."""
    if not matrix.shape[0]:
        return np.eye(matrix.shape[1])
    _, _, right = np.linalg.svd(matrix)
    return np.asarray(right[counted(matrix).rank :].T)


@dataclass(frozen=True)
class FloatLoops:
    """The loop equations of a mechanism at numbers.

    Attributes:
        mechanism: With values for its parameters; missing ones are drawn.
        seed: Of what is drawn.
        generic: Draw a number for every symbol, whatever the file says.
    """

    mechanism: Mechanism
    seed: int = 0
    generic: bool = False

    @cached_property
    def values(self) -> dict[str, float]:
        source = np.random.default_rng(self.seed)
        names = [*self.mechanism.joint_variables]
        names += [p.name for p in self.mechanism.parameters]
        found = {name: float(source.uniform(0.4, 1.9)) for name in names}
        for parameter in self.mechanism.parameters:
            if parameter.value is not None and not self.generic:
                text = expression_text(parameter.value)
                found[parameter.name] = value(text, found)
        return found

    def number(self, expression: Expression) -> float:
        return value(expression_text(expression), self.values)

    def vector(self, written: VectorExpression | None) -> Array:
        if written is None:
            return np.zeros(3)
        return np.array([self.number(part) for part in written])

    @cached_property
    def as_written(self) -> dict[str, Array]:
        """(ω; v) of every freedom by its label, in the lengths of the file."""
        found: dict[str, Array] = {}
        for joint in self.mechanism.joints:
            labels = freedom_labels(joint, self.mechanism.space)
            found |= dict(zip(labels, self._twists(joint), strict=True))
        return found

    @cached_property
    def size(self) -> float:
        """The largest moment: a length that makes singular values compare."""
        moments = [abs(t[3:]) for t in self.as_written.values() if np.any(t[:3])]
        return float(np.max(moments, initial=0.0)) or 1.0

    def in_its_size(self, twist: Array) -> Array:
        """(ω; v) with lengths in units of the mechanism's size."""
        return np.array([*twist[:3], *(twist[3:] / self.size)])

    @cached_property
    def twists(self) -> dict[str, Array]:
        """(ω; v) of every freedom by its label, lengths in units of the size."""
        return {label: self.in_its_size(t) for label, t in self.as_written.items()}

    def _twists(self, joint: Joint) -> list[Array]:
        if self.mechanism.geometry == "mdh" and joint.mdh is not None:
            columns = limb_columns(self.mechanism, self._chain(joint), self.values)
            moves = joint.type not in (J.FIXED, J.COMPLETE)
            return [columns[:, -1]] if moves else []
        point, normal = self.vector(joint.point), self.vector(joint.normal)
        axes = [self.vector(axis) for axis in joint.axes]
        pitch = 0.0 if joint.pitch is None else self.number(joint.pitch)
        line = self.vector(joint.line)

        def turn(axis: Array, advance: float = 0.0) -> Array:
            return np.array([*axis, *(np.cross(point, axis) + advance * axis)])

        def slide(axis: Array) -> Array:
            return np.array([0, 0, 0, *axis])

        tangents = list(null_vectors(normal[None]).T) if np.any(normal) else []
        x, y, z = np.eye(3)
        if self.mechanism.space == "planar":
            along = np.cross(z, normal)
            return {
                J.REVOLUTE: [turn(z)],
                J.HARD_FINGER: [turn(z)],
                J.PRISMATIC: [slide(axis) for axis in axes],
                J.PLANAR: [turn(z), slide(x), slide(y)],
                J.POINT: [turn(z), slide(along)],
                J.LINE: [slide(along)],
                J.PLANE: [slide(along)],
            }.get(joint.type, [])
        match joint.type:
            case J.REVOLUTE | J.HELICAL:
                return [turn(axes[0], pitch)]
            case J.PRISMATIC:
                return [slide(axes[0])]
            case J.CYLINDRICAL:
                return [turn(axes[0]), slide(axes[0])]
            case J.UNIVERSAL:
                return [turn(axis) for axis in axes]
            case J.SPHERICAL | J.HARD_FINGER:
                return [turn(axis) for axis in (x, y, z)]
            case J.PLANAR | J.PLANE:
                return [turn(normal), *map(slide, tangents)]
            case J.POINT:
                return [*map(turn, (x, y, z)), *map(slide, tangents)]
            case J.SOFT_FINGER:
                return [turn(tangent) for tangent in tangents]
            case J.LINE:
                across = np.cross(normal, line)
                return [turn(line), turn(normal), slide(line), slide(across)]
            case J.LINE_FRICTION:
                return [turn(line)]
            case _:
                return []

    def _chain(self, joint: Joint) -> list[str]:
        """The rows of the table from the base to a joint."""
        placing = {j.child: j for j in self.mechanism.joints if j.mdh is not None}
        chain = [joint.name]
        while (parent := self.mechanism.joint(chain[0]).parent) != self.mechanism.base:
            chain.insert(0, placing[parent].name)
        return chain

    @cached_property
    def incidence(self) -> Array:
        """−1 at the parent, +1 at the child: links by joints."""
        links = list(self.mechanism.links)
        matrix = np.zeros((len(links), len(self.mechanism.joints)))
        for column, joint in enumerate(self.mechanism.joints):
            matrix[links.index(joint.parent), column] -= 1
            matrix[links.index(joint.child), column] += 1
        return matrix

    def combined(self, weights: Array, locked: Collection[str] = ()) -> Array:
        """Sums of the joints' twists, joint j with weights[j, k], of unit columns."""
        blocks: list[Array] = []
        for row, joint in zip(weights, self.mechanism.joints, strict=True):
            for label in freedom_labels(joint, self.mechanism.space):
                if label not in locked:
                    twist = self.twists[label] / np.linalg.norm(self.twists[label])
                    blocks.append(np.outer(row, twist).ravel())
        height = 6 * weights.shape[1]
        return np.array(blocks).reshape(len(blocks), height).T

    def loop_matrix(self, locked: Collection[str] = ()) -> Array:
        """J_c: six rows for each vector of the null space of the incidence matrix."""
        if not self.mechanism.joints:
            return np.zeros((0, 0))
        return self.combined(null_vectors(self.incidence), locked)

    def body_twists(self, one: str, other: str, locked: Collection[str] = ()) -> Array:
        """Columns span the twists of one body relative to another, of unit size."""
        links: Sequence[str] = self.mechanism.links
        ends = np.zeros(len(links))
        ends[links.index(one)] += 1
        ends[links.index(other)] -= 1
        # Any combination of joints that leads from one to the other: loops are closed.
        ways: Array = np.linalg.pinv(self.incidence) @ ends
        assert np.allclose(self.incidence @ ways, ends), "not connected"
        rates = null_vectors(self.loop_matrix(locked))
        return self.combined(ways[:, None], locked) @ rates
