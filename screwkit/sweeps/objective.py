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
from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import substitute
from screwkit.algebra.names import meant_or_all
from screwkit.errors import UndecidedError, UnknownNameError
from screwkit.finite.table_search import closed_posture
from screwkit.grasping.exact_grasp import Ranks
from screwkit.kinematics.exact_postures import closes_at_zero
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.elimination_plan import plan_with
from screwkit.metrics.index_function import IndexFunction, Kind, index_function
from screwkit.metrics.locus_function import LocusFunction, LocusKind, locus_function
from screwkit.sweeps.measures import MEASURES
from screwkit.sweeps.moved_function import Departure, MovedFunction, ranks_at

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
    mechanism: Mechanism,
    index: str,
    varied: tuple[str, ...],
    wanted: Mapping[str, Expression] | None = None,
) -> Objective:
    """The function behind the name of an index.

    Args:
        mechanism: Its scheme decides what is actuated.
        index: ``kinematic.min`` …, ``locus`` or ``sigma_min``.
        varied: Symbols that are varied; the others take the values of the file.
        wanted: Values at which joint variables that loops tie together are kept.

    Raises:
        UnknownNameError: If there is no such index.
        UndecidedError: If a symbol has no value, the index no finite ones, or a table
            no closed posture.
    """
    kind, _, measure = index.partition(".")
    names = [f"{k}.{m}" for k in KINDS for m in MEASURES] + list(LOCI)
    if index not in names:
        raise UnknownNameError(f"no index {index!r}{meant_or_all(index, names)}")
    values = declared_values(mechanism)
    fixed = {n: v for n, v in values.items() if n not in varied}
    own = with_values(mechanism, fixed)
    missing = [p.name for p in own.parameters if p.name not in varied]
    if missing:
        raise UndecidedError(f"no value for {', '.join(missing)}: --set {missing[0]}=…")
    held = {n: substitute(x, fixed) for n, x in (wanted or {}).items()}
    tied = why_tied(own) or own.geometry == "posture"
    moved = bool(tied and (held or set(varied) & set(own.joint_variables)))
    ranks = None
    if not closes_at_zero(own):
        moved, ranks = True, ranks_at(_departure(mechanism))
    function = _function_of(own, kind, ranks)
    if isinstance(function, IndexFunction) and not function.count:
        where = "at the posture of the file" if why_tied(own) else "in general"
        raise UndecidedError(f"the {kind} index has no finite value {where}")
    if moved:
        return Objective(index, MovedFunction(own, function, measure, held), "")
    return Objective(index, function, measure)


def _departure(mechanism: Mechanism) -> Departure:
    """Of a table, at the values of the file.

    Raises:
        UndecidedError: If it has no closed posture there, or a symbol no value.
    """
    numbers = with_values(mechanism, declared_values(mechanism))
    if numbers.parameters:
        names = ", ".join(p.name for p in numbers.parameters)
        raise UndecidedError(
            f"the table is not closed at 0, and a closed posture of the file is needed "
            f"to start from: {names} must have a value there"
        )
    found = closed_posture(numbers)
    if not found.closed:
        raise UndecidedError(found.refusal)
    return Departure(numbers, found.values)


def _function_of(
    mechanism: Mechanism, kind: str, ranks: Ranks | None
) -> IndexFunction | LocusFunction:
    """With exact ranks at a general posture where none are given."""
    if kind in LOCI:
        locus: LocusKind = "locus" if kind == "locus" else "sigma_min"
        if ranks is not None:
            return LocusFunction(mechanism, locus, ranks.po)
        return locus_function(mechanism, locus)
    chosen: Kind = "force" if kind == "force" else "kinematic"
    if ranks is not None:
        return IndexFunction(mechanism, chosen, plan_with(ranks))
    return index_function(mechanism, chosen)
