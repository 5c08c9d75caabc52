"""What distances are asked about: from where, along what, and within which limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from screwkit.algebra.batch import Array
from screwkit.algebra.expression import Expression
from screwkit.algebra.names import did_you_mean
from screwkit.errors import ExpressionError, UnknownNameError
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.limited import Limits, limits_on
from screwkit.metrics.motion_chart import MotionChart
from screwkit.metrics.posture_samples import Interval


@dataclass(frozen=True)
class Asked:
    """The mechanism where distances begin.

    Attributes:
        mechanism: Its symbols at their values there.
        at: Values of joint variables that nothing ties.
        moved: Values of joint variables that loops tie: it is still to be moved there.
        length: That counts as one radian; None for the characteristic length.
        within: Limits of symbols that move the mechanism, or of how far freedoms move
            from the posture; in radians and file lengths.
    """

    mechanism: Mechanism
    at: Mapping[str, Expression]
    moved: Mapping[str, Expression]
    length: float | None
    within: Mapping[str, Interval] = field(default_factory=dict)


@dataclass(frozen=True)
class Moving:
    """Which symbols move the mechanism.

    Attributes:
        chart: None where none does.
        whole: Whether all that is looked at moves by them.
        remarks: What the answer has to say of them.
    """

    chart: MotionChart | None
    whole: bool
    remarks: tuple[str, ...] = ()


def keeping_to_limits(asked: Asked, moving: Moving) -> Moving:
    """Look along symbols where limits are of symbols, in joints where of freedoms.

    Raises:
        UnknownNameError: If a limit is of neither.
        ExpressionError: If some are of the one and some of the other.
    """
    if not asked.within:
        return moving
    symbols = () if moving.chart is None else moving.chart.names
    space = asked.mechanism.space
    freedoms = [x for j in asked.mechanism.joints for x in freedom_labels(j, space)]
    for name in asked.within:
        if name not in symbols and name not in freedoms:
            known = [*symbols, *freedoms]
            raise UnknownNameError(
                f"no symbol that moves the mechanism, and no freedom, is called "
                f"{name!r}{did_you_mean(name, known)}"
            )
    if not asked.within.keys() - set(symbols):
        if moving.whole:
            return moving
        said = "limits are of symbols: what lies beside these is not looked for"
        return Moving(moving.chart, whole=True, remarks=(*moving.remarks, said))
    others = [name for name in asked.within if name not in freedoms]
    if others:
        raise ExpressionError(
            f"limits are of symbols or of freedoms, and {others[0]!r} is no freedom; "
            f"give limits of one kind"
        )
    return Moving(None, whole=False, remarks=moving.remarks)


def limits_around(
    within: Mapping[str, Interval], names: Sequence[str], start: Array, units: Array
) -> Limits:
    """Limits of coordinates around a posture.

    Args:
        within: Of some of them, in radians and file lengths.
        names: Of all.
        start: The posture.
        units: What a coordinate is multiplied with to be such a value.

    Raises:
        ExpressionError: If the posture itself lies outside.
    """
    limits = limits_on(within, names, units)
    i = limits.first_outside(start)
    if i is not None:
        first, last = within[names[i]]
        raise ExpressionError(
            f"distances begin at {names[i]} = {start[i] * units[i]:.6g}, which is not "
            f"within {first:.6g}:{last:.6g}"
        )
    return limits
