"""A grasp as floats: matrices of unit directions at a posture, and its weights.

Rows are divided by the length of their direction and actuated columns by that of their
axis, so that forces, rates and torques are those of unit axes.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.algebra.evaluation import cosine_sine, evaluate
from screwkit.algebra.expression import Expression
from screwkit.algebra.floats import FloatRing
from screwkit.errors import ExpressionError
from screwkit.grasping.exact_grasp import Ranks
from screwkit.grasping.matrices import GraspMatrices, grasp_matrices
from screwkit.kinematics.loops import ring_at, stacked
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.indices import FloatGrasp, Weights


def float_matrices(mechanism: Mechanism) -> GraspMatrices[float]:
    """J and Gᵀ in floats, at the numbers of a mechanism without symbols.

    Raises:
        UndecidedError: If a contact has no place.
    """
    known = ring_at(mechanism, {}).values
    ring = FloatRing({name: float(value) for name, value in known.items()})
    return grasp_matrices(mechanism, ring)


def float_values(values: Mapping[str, Expression]) -> dict[str, float]:
    """Closed expressions as floats; those that are angles in radians."""
    found, ring = {}, BatchRing({})
    for name, expression in values.items():
        try:
            found[name] = float(evaluate(expression, ring))
        except ExpressionError:  # an inverse function: an angle
            cosine, sine = cosine_sine(expression, ring)
            found[name] = float(np.arctan2(sine, cosine))
    return found


def of_matrices(matrices: GraspMatrices[Any], ranks: Ranks | None) -> FloatGrasp:
    """The grasp of matrices over floats, in unit directions; batches keep theirs."""
    rows, moving = len(matrices.rows), len(matrices.freedoms)
    split = len(matrices.actuated)
    j = _filled(matrices.j, rows, moving)
    gt = _filled(matrices.gt, rows, matrices.twist_size)
    lengths = np.sqrt(_filled([matrices.squares], 1, rows))[..., 0, :, None]
    strokes = np.sqrt(_filled([matrices.strokes], 1, moving))
    j = j / lengths / strokes
    return FloatGrasp(
        j[..., :split], j[..., split:], gt / lengths, ranks, matrices.held
    )


def _filled(entries: Sequence[Sequence[Array]], rows: int, columns: int) -> Array:
    if not rows or not columns:
        return np.zeros((rows, columns))
    return stacked(entries)


def float_weights(
    mechanism: Mechanism,
    matrices: GraspMatrices[Any] | None,
    values: Mapping[str, Array | float],
) -> Weights:
    """The weights that a file declares, as matrices.

    Args:
        mechanism: With them.
        matrices: The grasp, for the weight of contact forces; None leaves that out.
        values: Of symbols in weights; they overrule those of the file.  Where they are
            arrays, a weight that depends on them has shape batch + (n, n).

    The weight of contact forces is declared for all six components (f; m) of every
    contact (three in the plane), and taken here for those that are transmitted on the
    object.
    """
    ring = ring_at(mechanism, values)

    def matrix(key: str) -> Array | None:
        if key not in mechanism.weights:
            return None
        return stacked(
            [
                [np.asarray(evaluate(x, ring), dtype=float) for x in row]
                for row in mechanism.weights[key]
            ]
        )

    forces = None if matrices is None else matrix("contact_forces")
    if forces is not None and matrices is not None:
        selector = force_selector(matrices)[: matrices.held]
        forces = selector @ forces @ selector.T
    return Weights(
        matrix("twist"), matrix("rates"), matrix("wrench"), matrix("torques"), forces
    )


def force_selector(matrices: GraspMatrices[Array]) -> Array:
    """Unit rows over the stacked (f; m) of all contacts, each about its own point.

    Rows of closures have none of these components.
    """
    planar = matrices.twist_size == 3
    size = 3 if planar else 6
    names = [hold.joint for hold in matrices.holds.contacts]
    found = np.zeros((len(matrices.rows), size * len(names)))
    for number, row in enumerate(matrices.rows):
        if not row.hold.on_object:
            continue
        direction = np.array([float(x) for x in row.wrench.direction])
        direction /= np.linalg.norm(direction)
        if row.wrench.kind == "couple":
            place = [5, 4, 3] if planar else [3, 4, 5]
            place, direction = ([2], direction[2:]) if planar else (place, direction)
        else:
            place, direction = (
                ([0, 1], direction[:2]) if planar else ([0, 1, 2], direction)
            )
        start = size * names.index(row.hold.joint)
        found[number, [start + i for i in place]] = direction
    return found
