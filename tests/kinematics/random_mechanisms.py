"""Random joints and mechanisms in small integers, and what their joints prevent.

Small integers make parallel, meeting and orthogonal axes frequent.  The second opinion
on freedoms is the table of constraints of joints and contacts: the velocities of all
bodies that no constraint wrench feels, over the rationals, with no loop and no twist.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from flint import fmpq, fmpq_mat
from hypothesis import strategies as st

from screwkit.algebra.expression import Expression, Number
from screwkit.mechanism.joints import CATALOGUE, freedoms, variable_count
from screwkit.mechanism.model import (
    Joint,
    JointType,
    Mechanism,
    Space,
    VectorExpression,
)

Vec = tuple[Fraction, Fraction, Fraction]
Six = tuple[Fraction, ...]
J = JointType

UNITS: tuple[Vec, ...] = (
    (Fraction(1), Fraction(0), Fraction(0)),
    (Fraction(0), Fraction(1), Fraction(0)),
    (Fraction(0), Fraction(0), Fraction(1)),
)
NOTHING: Vec = (Fraction(0),) * 3
SPATIAL = tuple(J)
PLANAR = tuple(j for j in J if CATALOGUE[j].planar_freedoms is not None)
ONE_AXIS = (J.REVOLUTE, J.PRISMATIC, J.HELICAL, J.CYLINDRICAL)
WITH_NORMAL = (J.PLANAR, J.PLANE, J.POINT, J.SOFT_FINGER, J.LINE, J.LINE_FRICTION)


def written(vector: Iterable[int | Fraction]) -> VectorExpression:
    x, y, z = (Number(Fraction(value)) for value in vector)
    return x, y, z


def read(vector: VectorExpression | None) -> Vec:
    if vector is None:
        return NOTHING
    x, y, z = (read_number(part) for part in vector)
    return x, y, z


def read_number(expression: Expression) -> Fraction:
    assert isinstance(expression, Number)
    return expression.value


def cross(a: Vec, b: Vec) -> Vec:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


def dot(a: Sequence[Fraction], b: Sequence[Fraction]) -> Fraction:
    return sum((x * y for x, y in zip(a, b, strict=True)), Fraction(0))


def across(axis: Vec) -> list[Vec]:
    """Vectors that span the plane at right angles."""
    return [cross(unit, axis) for unit in UNITS]


def rank(rows: Iterable[Sequence[Fraction | int]]) -> int:
    """Over the rationals."""
    kept = [list(row) for row in rows]
    if not kept or not kept[0]:
        return 0
    return int(fmpq_mat([[_fmpq(x) for x in row] for row in kept]).rank())


def kernel(rows: Sequence[Sequence[Fraction]], width: int) -> list[list[Fraction]]:
    """Basis of the vectors that every row annihilates, over the rationals."""
    if not rows:
        return [[Fraction(int(i == k)) for i in range(width)] for k in range(width)]
    reduced, count = fmpq_mat([[_fmpq(x) for x in row] for row in rows]).rref()
    entries = [
        [Fraction(int(reduced[i, j].p), int(reduced[i, j].q)) for j in range(width)]
        for i in range(int(count))
    ]
    pivots = [next(j for j, x in enumerate(row) if x) for row in entries]
    basis = []
    for free in (j for j in range(width) if j not in pivots):
        vector = [Fraction(0)] * width
        vector[free] = Fraction(1)
        for pivot, row in zip(pivots, entries, strict=True):
            vector[pivot] = -row[free]
        basis.append(vector)
    return basis


def _fmpq(value: Fraction | int) -> fmpq:
    exact = Fraction(value)
    return fmpq(exact.numerator, exact.denominator)


def random_joint(
    source: random.Random,
    kind: JointType,
    ends: tuple[str, str] = ("base", "body"),
    name: str = "j",
    space: Space = "spatial",
) -> Joint:
    """A joint with axes, points, normals and lines of small integers."""

    def vector() -> Vec:
        while True:
            x, y, z = (Fraction(source.randint(-2, 2)) for _ in range(3))
            found = (x, y, Fraction(0) if space == "planar" else z)
            if any(found):
                return found

    def away(from_: Vec) -> Vec:
        while True:
            found = cross(from_, vector())
            if any(found):
                return found

    count = variable_count(kind, space)
    joint = Joint(name, kind, *ends, tuple(f"q{name}_{k}" for k in range(count)))
    turns = space == "planar" and kind is J.REVOLUTE
    if turns or kind in ONE_AXIS:
        axis = UNITS[2] if turns else vector()
        joint = replace(joint, axes=(written(axis),))
    if kind is J.HELICAL:
        pitch = Number(Fraction(source.choice([-2, -1, 1, 2, 3]), 2))
        joint = replace(joint, pitch=pitch)
    if kind is J.UNIVERSAL:
        first = vector()
        second = away(first) if source.random() < 0.7 else vector()
        joint = replace(joint, axes=(written(first), written(second)))
    if kind in WITH_NORMAL and not (space == "planar" and kind is J.PLANAR):
        joint = replace(joint, normal=written(vector()))
    if space == "spatial" and kind in (J.LINE, J.LINE_FRICTION):
        line = vector()
        joint = replace(joint, line=written(line), normal=written(away(line)))
    if kind not in (J.FIXED, J.COMPLETE, J.PRISMATIC):
        point = vector() if source.random() < 0.8 else NOTHING
        joint = replace(joint, point=written(point))
    return joint


def constraint_wrenches(joint: Joint, space: Space = "spatial") -> list[Six]:
    """Wrenches (f; m) about the origin that span what a joint or contact can transmit.

    The selector rows FS and MS of [BicchiPrattichizzo], Tables I and II, at the point;
    in the plane (fx, fy, mz) with zeros elsewhere.
    """
    point, normal, line = read(joint.point), read(joint.normal), read(joint.line)
    axes = [read(axis) for axis in joint.axes]
    pitch = Fraction(0) if joint.pitch is None else read_number(joint.pitch)
    if space == "planar":
        forces, couples = _planar_rows(joint.type, axes, normal)
    else:
        forces, couples = _spatial_rows(joint.type, axes, normal, line)
    found: list[Six] = [(*f, *cross(point, f)) for f in forces]
    found += [(*NOTHING, *m) for m in couples]
    if joint.type is J.HELICAL:
        # zᵀv − h zᵀω = 0 at a point of the axis
        moment = cross(point, axes[0])
        found.append(
            (*axes[0], *(m - pitch * z for m, z in zip(moment, axes[0], strict=True)))
        )
    return found


def _spatial_rows(
    kind: JointType, axes: Sequence[Vec], normal: Vec, line: Vec
) -> tuple[Sequence[Vec], Sequence[Vec]]:
    match kind:
        case J.REVOLUTE:
            return UNITS, across(axes[0])
        case J.PRISMATIC:
            return across(axes[0]), UNITS
        case J.CYLINDRICAL | J.HELICAL:
            return across(axes[0]), across(axes[0])
        case J.UNIVERSAL:
            between = cross(axes[0], axes[1])
            return UNITS, [between] if any(between) else across(axes[0])
        case J.SPHERICAL | J.HARD_FINGER:
            return UNITS, ()
        case J.PLANAR | J.PLANE:
            return [normal], across(normal)
        case J.POINT:
            return [normal], ()
        case J.SOFT_FINGER:
            return UNITS, [normal]
        case J.LINE:
            return [normal], [cross(normal, line)]
        case J.LINE_FRICTION:
            return UNITS, [cross(normal, line), normal]
        case _:
            return UNITS, UNITS


def _planar_rows(
    kind: JointType, axes: Sequence[Vec], normal: Vec
) -> tuple[Sequence[Vec], Sequence[Vec]]:
    x, y, z = UNITS
    match kind:
        case J.REVOLUTE | J.HARD_FINGER:
            return [x, y], ()
        case J.PRISMATIC:
            return [cross(z, axes[0])], [z]
        case J.PLANAR:
            return (), ()
        case J.POINT:
            return [normal], ()
        case J.LINE | J.PLANE:
            return [normal], [z]
        case _:
            return [x, y], [z]


def reciprocal_row(wrench: Six, rows: range) -> list[Fraction]:
    """The form f·v + m·ω on the coordinates of a twist that count."""
    form = (*wrench[3:], *wrench[:3])
    return [form[k] for k in rows]


@dataclass(frozen=True)
class Freedoms:
    """What the constraints leave, over the rationals.

    Attributes:
        mobility: Dimension of the joint rates.
        twists: Of every link relative to the base (or the root of its component), one
            for each independent motion of the bodies.
    """

    mobility: int
    twists: Mapping[str, list[list[Fraction]]]

    def between(self, one: str, other: str) -> list[list[Fraction]]:
        """Twists of one link relative to another, which spans their system."""
        return [
            [a - b for a, b in zip(first, second, strict=True)]
            for first, second in zip(self.twists[one], self.twists[other], strict=True)
        ]


def left_by_constraints(mechanism: Mechanism, roots: Sequence[str]) -> Freedoms:
    """The velocities of bodies that every constraint wrench allows.

    Args:
        mechanism: Numbers only.
        roots: One body of each component, held still; the base's first.
    """
    rows = range(2, 5) if mechanism.space == "planar" else range(6)
    size = len(rows)
    start = {link: size * i for i, link in enumerate(mechanism.links)}
    width = size * len(start)
    equations: list[list[Fraction]] = []
    for root in roots:
        held = range(start[root], start[root] + size)
        equations += [[Fraction(int(i == k)) for i in range(width)] for k in held]
    spare = 0
    for joint in mechanism.joints:
        forms = [
            reciprocal_row(wrench, rows)
            for wrench in constraint_wrenches(joint, mechanism.space)
        ]
        spare += freedoms(joint, mechanism.space) - (size - rank(forms))
        for form in forms:
            equation = [Fraction(0)] * width
            for k, entry in enumerate(form):
                equation[start[joint.child] + k] += entry
                equation[start[joint.parent] + k] -= entry
            equations.append(equation)
    motions = kernel(equations, width)
    return Freedoms(
        len(motions) + spare,
        {
            link: [motion[at : at + size] for motion in motions]
            for link, at in start.items()
        },
    )


def mechanism_of(
    joints: Sequence[Joint],
    links: Sequence[str],
    space: Space = "spatial",
    base: str = "",
    platform: str = "",
) -> Mechanism:
    return Mechanism(
        name="random",
        title="Random",
        base=base or links[0],
        platform=platform or links[-1],
        links=tuple(links),
        joints=tuple(joints),
        geometry="posture",
        space=space,
    )


FREE = (J.REVOLUTE, J.REVOLUTE, J.PRISMATIC, J.HELICAL, J.UNIVERSAL, J.SPHERICAL)


def random_mechanism(
    seed: int, bodies: int, extra: int, space: Space = "spatial", mixed: bool = True
) -> Mechanism:
    """A mechanism on a random multigraph that need not be connected.

    Args:
        seed: Of everything.
        bodies: Number of links.
        extra: Joints beyond a spanning tree.
        space: ``spatial`` or ``planar``.
        mixed: All joints and contacts of the catalogue; else those with few freedoms.
    """
    source = random.Random(seed)
    links = [f"b{i}" for i in range(bodies)]
    ends = [(links[source.randrange(i)], links[i]) for i in range(1, bodies)]
    if bodies > 1:
        ends += [tuple(source.sample(links, 2)) for _ in range(extra)]  # type: ignore[misc]
    if source.random() < 0.2 and ends:
        ends.pop(source.randrange(len(ends)))
    kinds = PLANAR if space == "planar" else SPATIAL
    if not mixed:
        kinds = tuple(k for k in kinds if k in FREE)
    joints = []
    for number, pair in enumerate(ends):
        one, other = pair if source.random() < 0.5 else pair[::-1]
        kind = source.choice(kinds)
        joints.append(random_joint(source, kind, (one, other), f"j{number}", space))
    return mechanism_of(joints, links, space)


def mechanisms(
    bodies: int = 6, extra: int = 4, space: Space | None = None
) -> st.SearchStrategy[Mechanism]:
    """Random mechanisms of all joints and contacts, spatial and planar."""
    return st.builds(
        random_mechanism,
        st.integers(0, 2**30),
        st.integers(1, bodies),
        st.integers(0, extra),
        st.sampled_from(["spatial", "spatial", "planar"]) if space is None
        else st.just(space),
        st.booleans(),
    )  # fmt: skip


@dataclass(frozen=True)
class Similarity:
    """x ↦ scale·rotation·x + shift, all rational."""

    rotation: tuple[Vec, Vec, Vec]
    shift: Vec
    scale: Fraction = Fraction(1)

    @classmethod
    def drawn(cls, source: random.Random, space: Space = "spatial") -> Similarity:
        """A rotation from a quaternion of small integers; about z in the plane."""
        flat = space == "planar"
        w, x, y, z = (Fraction(source.randint(-3, 3)) for _ in range(4))
        if flat:
            x = y = Fraction(0)
        w = w or Fraction(1)
        k = 2 / (w * w + x * x + y * y + z * z)
        rotation: tuple[Vec, Vec, Vec] = (
            (1 - k * (y * y + z * z), k * (x * y - w * z), k * (x * z + w * y)),
            (k * (x * y + w * z), 1 - k * (x * x + z * z), k * (y * z - w * x)),
            (k * (x * z - w * y), k * (y * z + w * x), 1 - k * (x * x + y * y)),
        )
        a, b, c = (Fraction(source.randint(-5, 5), 2) for _ in range(3))
        scale = Fraction(source.randint(1, 9), source.randint(1, 9))
        return cls(rotation, (a, b, Fraction(0) if flat else c), scale)

    def turned(self, vector: Vec) -> Vec:
        first, second, third = (dot(row, vector) for row in self.rotation)
        return first, second, third

    def moved(self, point: Vec) -> Vec:
        x, y, z = (
            self.scale * turned + shift
            for turned, shift in zip(self.turned(point), self.shift, strict=True)
        )
        return x, y, z

    def of_joint(self, joint: Joint) -> Joint:
        """The joint where the similarity takes it."""

        def direction(vector: VectorExpression) -> VectorExpression:
            return written(self.turned(read(vector)))

        point, normal, line, pitch = joint.point, joint.normal, joint.line, joint.pitch
        return replace(
            joint,
            axes=tuple(direction(axis) for axis in joint.axes),
            point=None if point is None else written(self.moved(read(point))),
            normal=None if normal is None else direction(normal),
            line=None if line is None else direction(line),
            pitch=None if pitch is None else Number(self.scale * read_number(pitch)),
        )

    def of_twist(self, twist: Sequence[Fraction]) -> list[Fraction]:
        """(ω; v) seen from the new place; lengths scaled."""
        turning, sliding = _split(twist)
        turned = self.turned(turning)
        carried = cross(self.shift, turned)
        moved = [
            self.scale * a + b
            for a, b in zip(self.turned(sliding), carried, strict=True)
        ]
        return [*turned, *moved]


def _split(twist: Sequence[Fraction]) -> tuple[Vec, Vec]:
    a, b, c, d, e, f = twist
    return (a, b, c), (d, e, f)


def rescaled(joint: Joint, source: random.Random) -> Joint:
    """The same joint, its axes, normals and lines written with other lengths."""

    def longer(vector: VectorExpression) -> VectorExpression:
        factor = Fraction(source.choice([-3, -1, 2, 5]), source.randint(1, 4))
        return written(tuple(factor * x for x in read(vector)))

    return replace(
        joint,
        axes=tuple(longer(axis) for axis in joint.axes),
        normal=None if joint.normal is None else longer(joint.normal),
        line=None if joint.line is None else longer(joint.line),
    )


def turned_round(joint: Joint) -> Joint:
    """The joint with parent and child exchanged."""
    return replace(joint, parent=joint.child, child=joint.parent)


def chain(kinds: Sequence[JointType], seed: int, reverse: bool = True) -> Mechanism:
    """A serial chain, some joints passed backwards where ``reverse``."""
    source = random.Random(seed)
    links = [f"b{i}" for i in range(len(kinds) + 1)]
    joints = []
    for number, (ends, kind) in enumerate(zip(pairwise(links), kinds, strict=True)):
        pair = ends[::-1] if reverse and source.random() < 0.5 else ends
        joints.append(random_joint(source, kind, pair, f"j{number}"))
    return mechanism_of(joints, links)
