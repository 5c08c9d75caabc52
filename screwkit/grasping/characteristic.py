"""Characteristic polynomials of the indices at an exact point.

An index is stationary where det(λ M − N) vanishes, N and M being the numerator and the
denominator on a basis of the coordinated motions (or forces), each at its least over
what does not count.  Modulo a prime this is plain linear algebra, and the coefficients
are the exact ones.

Unit axes need no square roots: a rate or a force counts in units of its own axis, so
that only squares of lengths enter where the weight is diagonal.

References: [BicchiPrattichizzo] eqs. (12), (13), (22)-(24).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.modular import independent, residue_matrix
from screwkit.algebra.residue_matrices import Rows, gram, identity
from screwkit.grasping.exact_grasp import ExactGrasp
from screwkit.grasping.partition import Blocks
from screwkit.grasping.statics import (
    ContactForces,
    torques_of,
    wrenches_of,
)
from screwkit.mechanism.model import Mechanism


@dataclass(frozen=True)
class Characteristics:
    """Monic polynomials, constant term first, as residues; None where not at hand."""

    kinematic: tuple[int, ...] | None
    force: tuple[int, ...] | None
    internal: tuple[int, ...] | None


def characteristics(
    mechanism: Mechanism, grasp: ExactGrasp, blocks: Blocks, forces: ContactForces
) -> Characteristics:
    """The polynomials of the kinematic, the force and the internal index.

    None where a weight with entries off its diagonal meets axes of other than unit
    length, whose roots are not in the field.
    """
    metrics = _Metrics.of(mechanism, grasp)
    kinematic = force = internal = None
    if metrics.twist is not None and metrics.rates is not None:
        kinematic = _kinematic(grasp, blocks, metrics)
    if metrics.torques is not None:
        if metrics.wrench is not None:
            force = _force(grasp, forces, metrics)
        if metrics.forces is not None:
            internal = _internal(grasp, forces, metrics)
    return Characteristics(kinematic, force, internal)


@dataclass(frozen=True)
class _Metrics:
    """Weights in the grasp's own scale, as matrices; None where a root is missing."""

    twist: Rows | None
    wrench: Rows | None
    rates: Rows | None
    torques: Rows | None
    forces: Rows | None

    @classmethod
    def of(cls, mechanism: Mechanism, grasp: ExactGrasp) -> _Metrics:
        prime, size = grasp.prime, grasp.twists
        written = {
            key: [[int(evaluate(x, grasp.ring)) for x in row] for row in rows]
            for key, rows in mechanism.weights.items()
        }
        strokes = [int(x) for x in grasp.matrices.strokes[: grasp.actuated]]
        squares = [int(x) for x in grasp.matrices.squares]
        inverse = [pow(x, -1, prime) for x in strokes]
        return cls(
            written.get("twist", identity(size)),
            written.get("wrench", identity(size)),
            _scaled(written.get("rates", identity(len(strokes))), strokes, prime),
            _scaled(written.get("torques", identity(len(strokes))), inverse, prime),
            _force_metric(grasp, written["contact_forces"])
            if "contact_forces" in written
            else _scaled(identity(len(squares)), squares, prime),
        )


def _force_metric(grasp: ExactGrasp, weight: Rows) -> Rows:
    """The weight of (f; m) of each contact for the components on the object.

    A component acts along its direction as written, which need not be of unit length.
    """
    matrices = grasp.matrices
    half = 3 if grasp.twists > 3 else 2  # forces; in the plane one moment follows
    names = [hold.joint for hold in matrices.holds.contacts]
    rows = []
    for row in matrices.rows[: matrices.held]:
        direction = [int(x) for x in row.wrench.direction]
        couple = row.wrench.kind == "couple"
        acting = direction[2:] if couple and half == 2 else direction[:half]
        start = grasp.twists * names.index(row.hold.joint) + half * couple
        line = [0] * len(weight)
        line[start : start + len(acting)] = acting
        rows.append(line)
    return gram(rows, weight, grasp.prime)


def _scaled(weight: Rows, squares: Sequence[int], prime: int) -> Rows | None:
    """The weight for coordinates that count in units of √square."""
    diagonal = not any(
        any(row[:i]) or any(row[i + 1 :]) for i, row in enumerate(weight)
    )
    if diagonal:
        pairs = enumerate(zip(weight, squares, strict=True))
        return [
            [row[i] * square % prime if i == j else 0 for j in range(len(row))]
            for i, (row, square) in pairs
        ]
    return weight if all(square == 1 for square in squares) else None


def _kinematic(grasp: ExactGrasp, blocks: Blocks, metrics: _Metrics) -> tuple[int, ...]:
    a, o = blocks.actuated, blocks.actuated + blocks.passive

    def part(names: Sequence[str], where: slice) -> Rows:
        return [list(v[where]) for name in names for v in blocks.basis[name]]

    rates, twists = slice(0, a), slice(o, None)
    coordinated = ("apo_c", "ao_c")
    assert metrics.twist is not None
    assert metrics.rates is not None
    prime = grasp.prime
    above = _least(
        part(coordinated, twists), part(("po_i", "o_i"), twists), metrics.twist, prime
    )
    below = _least(
        part(coordinated, rates), part(("a_r", "ap_c"), rates), metrics.rates, prime
    )
    return _monic(above, below, prime)


def _force(
    grasp: ExactGrasp, statics: ContactForces, metrics: _Metrics
) -> tuple[int, ...]:
    prime = grasp.prime
    assert metrics.wrench is not None
    assert metrics.torques is not None
    above = _least(
        wrenches_of(grasp, statics.others),
        wrenches_of(grasp, statics.quiet),
        metrics.wrench,
        prime,
    )
    below = _least(
        torques_of(grasp, statics.others),
        torques_of(grasp, statics.inner),
        metrics.torques,
        prime,
    )
    return _monic(above, below, prime)


def _internal(
    grasp: ExactGrasp, statics: ContactForces, metrics: _Metrics
) -> tuple[int, ...]:
    prime = grasp.prime
    assert metrics.forces is not None
    assert metrics.torques is not None
    held = grasp.matrices.held
    forces = [row[:held] for row in metrics.forces[:held]]
    silent = [row[:held] for row in statics.silent]
    above = _least(
        [row[:held] for row in statics.inner],
        [silent[i] for i in independent(silent, prime)],
        forces,
        prime,
    )
    below = _least(torques_of(grasp, statics.inner), [], metrics.torques, prime)
    # Torques that only load loops inside limbs have the value zero, which is counted.
    return _monic(above, below, prime)[grasp.ranks.inner_torques :]


def _least(vectors: Rows, free: Rows, metric: Rows, prime: int) -> Any:
    """Gram matrix of vectors, each at its least over the span of ``free``."""
    size = len(vectors)
    both = [*vectors, *free]
    products = gram(both, metric, prime)
    upper = residue_matrix([row[:size] for row in products[:size]], size, prime)
    if not free or not size:
        return upper
    count = len(free)
    across = residue_matrix([row[size:] for row in products[:size]], count, prime)
    within = residue_matrix([row[size:] for row in products[size:]], count, prime)
    return upper - across * within.solve(across.transpose())


def _monic(above: Any, below: Any, prime: int) -> tuple[int, ...]:
    """Coefficients of det(λ − M⁻¹N), constant term first."""
    if not above.nrows():
        return (1,)
    polynomial = below.solve(above).charpoly()
    return tuple(int(c) for c in polynomial.coeffs())
