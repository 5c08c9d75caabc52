"""Admissible schemes in the order of how well they drive the platform.

Ranks are exact, at the dimensions of the file and in general over the posture; the
numbers are taken over a set of closed postures.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from screwkit.algebra.expression import Expression
from screwkit.analyses.ranked_motion import ranked_motion
from screwkit.errors import UndecidedError
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.values import declared_values, given_before, with_values
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.posture_samples import (
    SEED,
    Interval,
    interval_of,
    posture_sample,
    posture_symbols,
)
from screwkit.metrics.scheme_conditioning import (
    conditioning,
    driving,
    median_and_worst,
)
from screwkit.results.schemes import RankedScheme, Ranking

_PLACES = 9  # of an index between 0 and 1


def ranking(
    mechanism: Mechanism,
    schemes: Sequence[tuple[str, ...]],
    postures: int,
    within: Sequence[str] = (),
    length: float | None = None,
) -> Ranking:
    """Order schemes of one size by their conditioning.

    Args:
        mechanism: Limbs or any joint graph.
        schemes: Admissible for generic values.
        postures: How many are drawn.
        within: Ranges of symbols, ``NAME=FROM:TO`` each.
        length: That counts as one radian, in the units of the file.

    Raises:
        UndecidedError: If a dimension has no value, no posture exists, or loops tie
            joint variables together.
        UnknownNameError: If a range is one of no symbol.
        ExpressionError: If it is none.
    """
    tied = why_tied(mechanism)
    if tied:
        raise UndecidedError(
            f"{tied}, so that no set of closed postures is drawn over which schemes "
            f"could be ranked"
        )
    names = [p.name for p in mechanism.parameters]
    if mechanism.geometry != "posture":
        names += mechanism.joint_variables
    intervals = dict(
        interval_of(text, names, given_before(mechanism)) for text in within
    )
    fixed = _fixed(mechanism, intervals)
    sample = posture_sample(mechanism, postures, intervals, length)
    moving = ranked_motion(
        with_values(mechanism, fixed) if fixed else mechanism, schemes
    )
    place = {label: number for number, label in enumerate(moving.labels)}
    motions = driving(
        sample.twists.of(moving.labels, sample.length),
        moving.incidence,
        moving.mobility,
        moving.freedom,
    )
    holding = [
        (actuated, mobility)
        for actuated, (mobility, freedom) in zip(schemes, moving.left, strict=True)
        if not freedom
    ]
    idle = moving.mobility - moving.freedom
    values = conditioning(
        motions,
        [[place[joint] for joint in actuated] for actuated, _ in holding],
        [idle - mobility for _, mobility in holding],
    )
    known = {
        actuated: numbers
        for (actuated, _), numbers in zip(
            holding, median_and_worst(values), strict=True
        )
    }
    ranked = [
        RankedScheme(actuated, *known.get(actuated, (0.0, 0.0))) for actuated in schemes
    ]
    return Ranking(
        tuple(sorted(ranked, key=_order)),
        postures=len(sample.twists.directions),
        undefined=sample.undefined,
        seed=SEED,
        length=sample.length,
        length_given=length is not None,
        units=mechanism.units,
        ranges=sample.ranges,
    )


def _order(one: RankedScheme) -> tuple[float, float]:
    """Best first; values that differ by rounding alone count as equal."""
    return -round(one.median, _PLACES), -round(one.worst, _PLACES)


def _fixed(
    mechanism: Mechanism, intervals: Mapping[str, Interval]
) -> dict[str, Expression]:
    """The values of the symbols that are the same at all postures."""
    drawn = {*posture_symbols(mechanism), *intervals}
    return {n: v for n, v in declared_values(mechanism).items() if n not in drawn}
