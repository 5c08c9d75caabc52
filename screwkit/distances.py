"""Distances to singularities: a case's exact loci, its limbs, and its posture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.expression import Expression
from screwkit.algebra.parse import parse
from screwkit.analyses import distance_answer
from screwkit.analyses.distance_limits import Asked, keeping_to_limits
from screwkit.analyses.singularities import singularities
from screwkit.case import Case
from screwkit.errors import UndecidedError
from screwkit.kinematics.assembly import Assembly
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.posture_samples import limits_of
from screwkit.progress import Progress
from screwkit.results.distance import Distance
from screwkit.results.singularities import Singularities


def distance_of(
    case: Case,
    length: Expression | None,
    within: Sequence[str],
    progress: Progress,
    finished: Callable[[str, Any], None],
) -> Distance:
    """The distances of a case at its posture.

    Args:
        case: The mechanism and what was asked of it.
        length: That counts as one radian; None for the characteristic length.
        within: Limits, ``NAME=FROM:TO`` each.
        progress: Told about each stage.
        finished: Given the answer so far after each singularity.

    Raises:
        UndecidedError: See `screwkit.analyses.distance_answer.distance`.
        UnknownNameError: If a limit is of nothing that moves.
        ExpressionError: If one is no range, or leaves out the posture.
    """
    declared = case.unplaced
    names = [p.name for p in declared.parameters]
    given = {
        name: parse(str(value), names)
        for name, value in case.given.at.items()
        if name not in case.wanted
    }
    mechanism, joints = distance_answer.standing_at(declared, given)
    measure = None if length is None else closed_value(length)
    limits = dict(map(limits_of, within))
    asked = Asked(mechanism, joints, case.wanted, measure, limits)
    moving = distance_answer.moving_symbols(asked)
    moving = keeping_to_limits(asked, moving)
    limbs, why = _limbs(declared), ""
    loci: Singularities | None = None
    if moving.chart is not None:
        try:
            loci = singularities(Assembly(declared), progress=progress)
        except UndecidedError as error:
            why = f"the loci are not known: {error}"
    answer = distance_answer.distance(asked, moving, loci, limbs, progress, finished)
    return replace(answer, remarks=(*answer.remarks, *filter(None, [why])))


def _limbs(mechanism: Mechanism) -> dict[str, tuple[str, ...]]:
    """The freedoms of limbs without loops inside."""
    try:
        limbs = Assembly(mechanism).limbs
    except UndecidedError:
        return {}
    return {limb.name: limb.joints for limb in limbs if limb.elements is None}
