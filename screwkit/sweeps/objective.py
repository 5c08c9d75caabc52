"""What a sweep evaluates: an index by its name, as a function that travels.

``kinematic.min``, ``force.condition``, ``kinematic.misfit``, … condense the stationary
values of an index; ``locus`` and ``sigma_min`` tell how far the actuators are from
losing the platform.  The function holds exact data only, so that it can be sent to
another process, which works out there what it needs.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from screwkit.algebra.batch import Array
from screwkit.algebra.names import did_you_mean
from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.index_function import IndexFunction, Kind, index_function
from screwkit.metrics.locus_function import LocusFunction, LocusKind, locus_function
from screwkit.sweeps.measures import MEASURES
from screwkit.sweeps.moved_function import MovedFunction

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
    function: IndexFunction | LocusFunction | MovedFunction
    measure: str

    def __call__(self, values: Mapping[str, Array]) -> Array:
        """The number at each posture; values broadcast over one batch."""
        found = self.function(values)
        return MEASURES[self.measure](found) if self.measure else found


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
    tied = why_tied(own) or own.geometry == "posture"
    moved = bool(tied and set(varied) & set(own.joint_variables))
    function = _function_of(own, kind)
    if isinstance(function, IndexFunction) and not function.count:
        where = "at the posture of the file" if why_tied(own) else "in general"
        raise UndecidedError(f"the {kind} index has no finite value {where}")
    if moved:
        return Objective(index, MovedFunction(own, function, measure), "")
    return Objective(index, function, measure)


def _function_of(mechanism: Mechanism, kind: str) -> IndexFunction | LocusFunction:
    if kind in LOCI:
        locus: LocusKind = "locus" if kind == "locus" else "sigma_min"
        return locus_function(mechanism, locus)
    chosen: Kind = "force" if kind == "force" else "kinematic"
    return index_function(mechanism, chosen)
