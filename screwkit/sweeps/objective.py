"""What a sweep evaluates: an index by its name, as a function that travels.

``kinematic.min``, ``force.condition``, ``kinematic.misfit``, … condense the stationary
values of an index; ``locus`` and ``sigma_min`` tell how far the actuators are from
losing the platform.  The function holds exact data only, so that it can be sent to
another process, which works out there what it needs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from screwkit.algebra.batch import Array
from screwkit.algebra.expression import Expression, Number
from screwkit.algebra.names import did_you_mean
from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.finite.moved_posture import arrival_at
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.float_grasp import float_weights, of_matrices
from screwkit.metrics.float_ranks import float_ranks
from screwkit.metrics.index_function import IndexFunction, Kind, index_function
from screwkit.metrics.indices import indices
from screwkit.metrics.locus_function import LocusFunction, LocusKind, locus_function
from screwkit.metrics.posture_grasp import grasp_on_arrival
from screwkit.sweeps.measures import MEASURES

KINDS = ("kinematic", "force")
LOCI = ("locus", "sigma_min")


@dataclass(frozen=True)
class Objective:
    """One number for every posture.

    Attributes:
        index: Its name.
        function: The stationary values, or the number itself.
        measure: How the values are condensed; empty where the function gives one.
    """

    index: str
    function: IndexFunction | LocusFunction | MovedIndex
    measure: str

    def __call__(self, values: Mapping[str, Array]) -> Array:
        """The number at each posture; values broadcast over one batch."""
        found = self.function(values)
        return MEASURES[self.measure](found) if self.measure else found


@dataclass(frozen=True)
class MovedIndex:
    """The values of an index at joint variables that loops tie together.

    Each posture is closed by a motion from that of the file; one that is not reached
    has no value.

    Attributes:
        mechanism: With numbers for all symbols.
        kind: ``kinematic`` or ``force``.
        count: Finite values at a generic posture.
    """

    mechanism: Mechanism
    kind: str
    count: int

    def __call__(self, values: Mapping[str, Array | float]) -> Array:
        """The values, shape batch + (count,); nan where the loops do not close."""
        arrays = {name: np.asarray(v, dtype=float) for name, v in values.items()}
        batch = np.broadcast_shapes(*(v.shape for v in arrays.values()))
        flat = {n: np.broadcast_to(v, batch).reshape(-1) for n, v in arrays.items()}
        size = int(np.prod(batch))
        points = ({n: float(v[i]) for n, v in flat.items()} for i in range(size))
        rows = [self._one(point) for point in points]
        return np.array(rows).reshape(*batch, self.count)

    def _one(self, values: Mapping[str, float]) -> Array:
        wanted: dict[str, Expression] = {
            name: Number(Fraction(value)) for name, value in values.items()
        }
        there = arrival_at(self.mechanism, wanted)
        if not there.found.closed:
            return np.full(self.count, np.nan)
        matrices = grasp_on_arrival(self.mechanism, there)
        grasp = of_matrices(matrices, None)
        ranks, _, _ = float_ranks(grasp)
        weights = float_weights(self.mechanism, matrices, {})
        found = indices(of_matrices(matrices, ranks), weights)
        finite = (found.kinematic if self.kind == "kinematic" else found.force).finite
        padded = [*finite, *[0.0] * self.count][: self.count]
        return np.array(padded)


def objective_of(
    mechanism: Mechanism, index: str, varied: tuple[str, ...]
) -> Objective:
    """The function behind the name of an index.

    Args:
        mechanism: Its scheme decides what is actuated.
        index: ``kinematic.min`` …, ``locus`` or ``sigma_min``.
        varied: Symbols that are varied; the others take the values of the file.

    Raises:
        UnknownNameError: If there is no such index.
        UndecidedError: If a symbol has no value, or the index no finite ones.
    """
    kind, _, measure = index.partition(".")
    names = [f"{k}.{m}" for k in KINDS for m in MEASURES] + list(LOCI)
    if index not in names:
        raise UnknownNameError(f"no index {index!r}{did_you_mean(index, names)}")
    values = declared_values(mechanism)
    fixed = {n: v for n, v in values.items() if n not in varied}
    own = with_values(mechanism, fixed)
    missing = [p.name for p in own.parameters if p.name not in varied]
    if missing:
        raise UndecidedError(f"no value for {', '.join(missing)}: --set {missing[0]}=…")
    if kind in LOCI:
        locus: LocusKind = "locus" if kind == "locus" else "sigma_min"
        return Objective(index, locus_function(own, locus), "")
    chosen: Kind = "force" if kind == "force" else "kinematic"
    tied = why_tied(own) or own.geometry == "posture"
    if tied and set(varied) & set(own.joint_variables):
        count = index_function(own, chosen).count
        return Objective(index, MovedIndex(own, chosen, count), measure)
    function = index_function(own, chosen)
    if not function.count:
        raise UndecidedError(f"the {kind} index has no finite value in general")
    return Objective(index, function, measure)
