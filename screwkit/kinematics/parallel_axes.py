"""Angles of parallel axes summed: the basis angles that keep twists short.

Consecutive parallel axes turn what follows by the sum of their angles, so the sums
along such a run are taken as basis angles: of a planar linkage the turns of its bodies.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Collection
from dataclasses import dataclass, field

from screwkit.algebra.angle_basis import AngleForm
from screwkit.algebra.constant_multiples import sign
from screwkit.algebra.evaluation import cosine_sine
from screwkit.algebra.ring import Ring, S
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    plain_basis,
)
from screwkit.kinematics.freedoms import freedom_twists
from screwkit.kinematics.placement import table_joints
from screwkit.mechanism.graph import closing_tree
from screwkit.mechanism.model import Joint, JointType, MdhRow, Mechanism
from screwkit.screw import vector
from screwkit.screw.vector import Vector

_CARRYING = (JointType.PRISMATIC, JointType.FIXED)
"""Joints whose bodies keep the directions of `reference` files."""


@dataclass(frozen=True)
class _Run:
    """Parallel axes up to a link.

    Attributes:
        axis: The direction of the last in the link's frame; None where there is none.
        total: How each variable turns the link about it.
    """

    axis: Vector[Polynomial] | None = None
    total: dict[str, int] = field(default_factory=dict)


def parallel_basis(
    mechanism: Mechanism,
    joints: Collection[str],
    origin: str,
    ring: TrigonometricRing,
) -> tuple[AngleForm, ...]:
    """Basis angles: for each run of parallel axes, the sums along the run.

    Args:
        mechanism: An ``mdh`` or ``reference`` file.
        joints: Names of those that count.
        origin: The link from which runs are followed outwards.
        ring: For the directions of axes; with all angles.
    """
    neighbours: dict[str, list[Joint]] = {}
    for joint in _placing(mechanism):
        if joint.name in joints:
            neighbours.setdefault(joint.parent, []).append(joint)
            neighbours.setdefault(joint.child, []).append(joint)
    forms: dict[str, AngleForm] = {}
    queue = deque([(origin, "", _Run())])
    reached = {origin}
    while queue:
        link, via, run = queue.popleft()
        for joint in neighbours.get(link, ()):
            outwards = joint.parent == link
            other = joint.child if outwards else joint.parent
            if joint.name == via or other in reached:
                continue
            reached.add(other)
            follows = _followed(mechanism, joint, run, ring, outwards=outwards)
            if _turns(joint):
                forms[joint.variables[0]] = _positive(follows.total)
            queue.append((other, joint.name, follows))
    rest = [a for a in _angles_of(ring) if a not in forms]
    return (*forms.values(), *plain_basis(rest))


def _placing(mechanism: Mechanism) -> list[Joint]:
    """The joints along which links are placed."""
    if mechanism.geometry == "mdh":
        return [*table_joints(mechanism)]
    tree = set(closing_tree(mechanism))
    return [joint for joint in mechanism.joints if joint.name in tree]


def _turns(joint: Joint) -> bool:
    return joint.type is JointType.REVOLUTE and not any(joint.held)


def _followed(
    mechanism: Mechanism,
    joint: Joint,
    run: _Run,
    ring: TrigonometricRing,
    *,
    outwards: bool,
) -> _Run:
    """The run beyond a joint."""
    if mechanism.geometry == "mdh":
        here, there = _axis_in_links(joint, ring)
    elif joint.type in _CARRYING:
        return run
    elif joint.type is JointType.REVOLUTE:
        here = there = freedom_twists(joint, ring, mechanism.space)[0].direction
    else:
        return _Run()
    if not outwards:
        here, there = there, here
    along = 0 if run.axis is None else _parallel(ring, run.axis, here)
    total = {name: along * count for name, count in run.total.items() if along}
    if _turns(joint):
        total[joint.variables[0]] = 1 if outwards else -1
    elif joint.type is not JointType.REVOLUTE and run.axis is not None and not along:
        return _Run()
    return _Run(there, total)


def _angles_of(ring: TrigonometricRing) -> tuple[str, ...]:
    constant = ring.constant_angles
    return tuple(form[0][0] for form in ring.basis if form[0][0] not in constant)


def _positive(form: dict[str, int]) -> AngleForm:
    """The form with the last added angle, its own, counted positively."""
    own = next(reversed(form))
    sign = form[own]
    ordered = [own, *(name for name in form if name != own)]
    return tuple((name, sign * form[name]) for name in ordered)


def _axis_in_links(joint: Joint, ring: Ring[S]) -> tuple[Vector[S], Vector[S]]:
    """The z axis of a table's joint in the frames of its parent and of its child."""
    row = joint.mdh or MdhRow()
    cg, sg = cosine_sine(row.gamma, ring)
    ca, sa = cosine_sine(row.alpha, ring)
    in_parent = (ring.normal(sg * sa), ring.normal(-(cg * sa)), ca)
    return in_parent, (ring.zero, ring.zero, ring.one)


def _parallel(
    ring: TrigonometricRing, a: Vector[Polynomial], b: Vector[Polynomial]
) -> int:
    """1 or −1 for vectors of one or opposite directions for every posture, else 0."""
    if not all(ring.is_zero(ring.normal(x)) for x in vector.cross(a, b)):
        return 0
    same = ring.normal(vector.dot(a, b))
    if same.is_constant():
        return sign(ring, same)
    square = ring.normal(vector.dot(a, a))
    return next((k for k in (1, -1) if ring.is_zero(same - k * square)), 0)
