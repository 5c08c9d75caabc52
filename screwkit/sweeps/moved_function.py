"""Functions of postures that loops tie together: one motion for each of them.

A posture is closed by a motion from that of the file, and known in floating point
alone; symbols that are varied beside the joint variables change where it starts.  A
table that is not closed at 0 starts where a closed posture of it was found.

References: [MurrayLiSastry1994] §3.5.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.expression import Expression, Number
from screwkit.algebra.expression_building import substitute
from screwkit.finite.moved_posture import arrival_at
from screwkit.finite.table_search import closed_posture
from screwkit.grasping.exact_grasp import Ranks
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.values import with_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.float_grasp import float_weights, of_matrices
from screwkit.metrics.float_ranks import float_ranks
from screwkit.metrics.index_function import IndexFunction
from screwkit.metrics.locus_function import LocusFunction
from screwkit.metrics.posture_grasp import grasp_on_arrival
from screwkit.sweeps.measures import MEASURES


@dataclass(frozen=True)
class Departure:
    """Where the motions of a mechanism start.

    Attributes:
        mechanism: All its symbols with values.
        start: Joint variables of a closed posture; None where 0 is one.
    """

    mechanism: Mechanism
    start: Mapping[str, float] | None

    @classmethod
    def of(cls, mechanism: Mechanism) -> Departure | None:
        """The posture of the file; None where a table has none that is closed."""
        if mechanism.geometry != "mdh" or not why_tied(mechanism):
            return cls(mechanism, None)
        found = closed_posture(mechanism)
        return cls(mechanism, found.values) if found.closed else None


@dataclass(frozen=True)
class MovedFunction:
    """One number at postures that are reached by motions of the mechanism.

    Attributes:
        mechanism: With numbers for the symbols that are not varied.
        function: What is evaluated where a motion ends.
        measure: How the values of an index are condensed; empty for a locus.
        held: Values at which joint variables are kept, in symbols that are varied.
    """

    mechanism: Mechanism
    function: IndexFunction | LocusFunction
    measure: str
    held: Mapping[str, Expression] = field(default_factory=dict)

    def __call__(self, values: Mapping[str, Array | float]) -> Array:
        """The numbers, shape batch; nan where the loops do not close."""
        arrays = {name: np.asarray(v, dtype=float) for name, v in values.items()}
        batch = np.broadcast_shapes(*(v.shape for v in arrays.values()))
        flat = {n: np.broadcast_to(v, batch).reshape(-1) for n, v in arrays.items()}
        size = int(np.prod(batch))
        joints = self.mechanism.joint_variables
        departures: dict[tuple[float, ...], Departure | None] = {}
        found = np.full(size, np.nan)
        for number in range(size):
            point: dict[str, Expression] = {
                name: Number(Fraction(float(v[number]))) for name, v in flat.items()
            }
            symbols = {n: x for n, x in point.items() if n not in joints}
            key = tuple(float(flat[name][number]) for name in symbols)
            if key not in departures:
                departures[key] = Departure.of(with_values(self.mechanism, symbols))
            departure = departures[key]
            if departure is not None:
                kept = {n: substitute(x, symbols) for n, x in self.held.items()}
                moved = {n: x for n, x in point.items() if n in joints}
                found[number] = self._one(departure, kept | moved)
        return found.reshape(batch)

    def _one(self, departure: Departure, wanted: Mapping[str, Expression]) -> float:
        mechanism = departure.mechanism
        there = arrival_at(mechanism, wanted, departure.start)
        if not there.found.closed:
            return np.nan
        matrices = grasp_on_arrival(mechanism, there)
        grasp = of_matrices(matrices, None)
        if isinstance(self.function, LocusFunction):
            return float(self.function.of_grasp(grasp))
        weights = float_weights(mechanism, matrices, {})
        found = self.function.padded(grasp, weights)
        return float(MEASURES[self.measure](found))


def ranks_at(departure: Departure) -> Ranks:
    """Ranks of the grasp where motions start, by singular values."""
    there = arrival_at(departure.mechanism, {}, departure.start)
    grasp = of_matrices(grasp_on_arrival(departure.mechanism, there), None)
    ranks, _, _ = float_ranks(grasp)
    return ranks
