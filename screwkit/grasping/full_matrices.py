"""G, D and H in full, as the papers write them: before contacts select components.

Velocities of contact frames are stacked [v_1 … v_n, ω_1 … ω_n]; Gᵀ gives them from the
object's motion (v; ω), D from the joint rates, and H selects what the contacts couple:
H (D q̇ − Gᵀ u) = 0.

References: [BicchiMelchiorri] eqs. (1)-(7), [BicchiPrattichizzo] Appendix A.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic

from screwkit.algebra.ring import Ring, S
from screwkit.grasping.matrices import GraspMatrices
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.placement import joint_twists
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Mechanism
from screwkit.screw import vector
from screwkit.screw.vector import Vector


@dataclass(frozen=True)
class FullMatrices(Generic[S]):
    """The matrices and their labels.

    Attributes:
        components: Rows of D and columns of G: ``v x of contact``, …
        forces: Rows of G: the wrench (f; m) on the object.
        rows: Rows of H, those of the grasp model without closures.
        g: Shape (d, d·n): w = G f.
        d: Shape (d·n, freedoms).
        h: Shape (rows, d·n).
    """

    components: tuple[str, ...]
    forces: tuple[str, ...]
    rows: tuple[str, ...]
    freedoms: tuple[str, ...]
    g: tuple[tuple[S, ...], ...]
    d: tuple[tuple[S, ...], ...]
    h: tuple[tuple[S, ...], ...]


def full_matrices(
    mechanism: Mechanism, ring: Ring[S], matrices: GraspMatrices[S]
) -> FullMatrices[S]:
    """G, D and H of the contacts of a grasp.

    Args:
        mechanism: As for `grasp_matrices`.
        ring: Where the entries live.
        matrices: The grasp, in the same ring.
    """
    planar = mechanism.space == "planar"
    linear = (0, 1) if planar else (0, 1, 2)
    angular = (2,) if planar else (0, 1, 2)
    holds = matrices.holds.contacts
    points = [
        next(r.wrench.point for r in matrices.rows if r.hold == hold) for hold in holds
    ]
    names = [hold.joint for hold in holds]
    places = [("v", name, i) for name in names for i in linear]
    places += [("ω", name, i) for name in names for i in angular]
    twists = joint_twists(mechanism, ring, mechanism.base)
    columns: list[list[S]] = []
    for label in matrices.freedoms:
        column: list[S] = []
        own: list[tuple[Vector[S], Vector[S]]] = []
        for hold, point in zip(holds, points, strict=True):
            sign = _sign(mechanism, hold.steps, label)
            own.append(_velocity(ring, twists[label], point, sign))
        column += [own[k][0][i] for k in range(len(holds)) for i in linear]
        column += [own[k][1][i] for k in range(len(holds)) for i in angular]
        columns.append(column)
    d = tuple(zip(*columns, strict=True)) if columns else ((),) * len(places)
    return FullMatrices(
        components=tuple(f"{kind} {'xyz'[i]} of {name}" for kind, name, i in places),
        forces=tuple(
            [f"f {'xyz'[i]}" for i in linear] + [f"m {'xyz'[i]}" for i in angular]
        ),
        rows=tuple(row.label for row in matrices.rows if row.hold.on_object),
        freedoms=matrices.freedoms,
        g=_grasp_matrix(ring, points, matrices.reference_point, linear, angular),
        d=d,
        h=tuple(
            tuple(
                row.wrench.direction[i]
                if name == row.hold.joint
                and (kind == "ω") == (row.wrench.kind == "couple")
                else ring.zero
                for kind, name, i in places
            )
            for row in matrices.rows
            if row.hold.on_object
        ),
    )


def _sign(mechanism: Mechanism, steps: Sequence[tuple[str, int]], label: str) -> int:
    for name, sign in steps:
        if label in freedom_labels(mechanism.joint(name), mechanism.space):
            return sign
    return 0


def _velocity(
    ring: Ring[S], twist: JointTwist[S], point: Vector[S], sign: int
) -> tuple[Vector[S], Vector[S]]:
    """Linear and angular velocity of a contact frame for a unit rate."""
    if not sign:
        return (ring.zero,) * 3, (ring.zero,) * 3
    direction = twist.direction
    there = vector.add(twist.moment, vector.cross(direction, point))
    if sign < 0:
        there = vector.subtract((ring.zero,) * 3, there)
        direction = vector.subtract((ring.zero,) * 3, direction)
    return vector.normal(ring, there), vector.normal(ring, direction)


def _grasp_matrix(
    ring: Ring[S],
    points: Sequence[Vector[S]],
    centre: Vector[S],
    linear: Sequence[int],
    angular: Sequence[int],
) -> tuple[tuple[S, ...], ...]:
    """[I … I 0 … 0; S(r_1) … S(r_n) I … I] with r_i from the reference point."""
    units = [
        tuple(ring.one if i == k else ring.zero for i in range(3)) for k in range(3)
    ]
    columns: list[tuple[S, ...]] = []
    for point in points:
        lever = vector.normal(ring, vector.subtract(point, centre))
        for k in linear:
            moment = vector.normal(ring, vector.cross(lever, units[k]))
            columns.append(
                (*(units[k][i] for i in linear), *(moment[i] for i in angular))
            )
    columns += [
        (*(ring.zero for _ in linear), *(units[k][i] for i in angular))
        for _ in points
        for k in angular
    ]
    return tuple(zip(*columns, strict=True))
