"""Functions of joint variables that loops tie together: one motion for each posture.

A posture is closed by a motion from that of the file, and known in floating point
alone; symbols that are varied beside the joint variables change where it starts.

References: [MurrayLiSastry1994] §3.5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.expression import Expression, Number
from screwkit.finite.moved_posture import arrival_at
from screwkit.kinematics.values import with_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.float_grasp import float_weights, of_matrices
from screwkit.metrics.index_function import IndexFunction
from screwkit.metrics.locus_function import LocusFunction
from screwkit.metrics.posture_grasp import grasp_on_arrival
from screwkit.sweeps.measures import MEASURES


@dataclass(frozen=True)
class MovedFunction:
    """One number at postures that are reached by motions of the mechanism.

    Attributes:
        mechanism: With numbers for the symbols that are not varied.
        function: What is evaluated where a motion ends.
        measure: How the values of an index are condensed; empty for a locus.
    """

    mechanism: Mechanism
    function: IndexFunction | LocusFunction
    measure: str

    def __call__(self, values: Mapping[str, Array | float]) -> Array:
        """The numbers, shape batch; nan where the loops do not close."""
        arrays = {name: np.asarray(v, dtype=float) for name, v in values.items()}
        batch = np.broadcast_shapes(*(v.shape for v in arrays.values()))
        flat = {n: np.broadcast_to(v, batch).reshape(-1) for n, v in arrays.items()}
        size = int(np.prod(batch))
        points = ({n: float(v[i]) for n, v in flat.items()} for i in range(size))
        return np.array([self._one(point) for point in points]).reshape(batch)

    def _one(self, values: Mapping[str, float]) -> float:
        known: dict[str, Expression] = {
            name: Number(Fraction(value)) for name, value in values.items()
        }
        joints = self.mechanism.joint_variables
        wanted = {name: known.pop(name) for name in joints if name in known}
        mechanism = with_values(self.mechanism, known)
        there = arrival_at(mechanism, wanted)
        if not there.found.closed:
            return np.nan
        matrices = grasp_on_arrival(mechanism, there)
        grasp = of_matrices(matrices, None)
        if isinstance(self.function, LocusFunction):
            return float(self.function.of_grasp(grasp))
        weights = float_weights(mechanism, matrices, {})
        found = self.function.padded(grasp, weights)
        return float(MEASURES[self.measure](found))
