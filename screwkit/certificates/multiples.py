"""Whether a value is 0 at a node: by the solved steps, or as a multiple of a condition.

Checked by values at random postures, after the divisors of the steps before.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from screwkit.algebra.exact_point import PointRing
from screwkit.certificates.equations_told import Multiple
from screwkit.certificates.postures import Way
from screwkit.certificates.texts import RefusedError, read


def follows(value: Any, multiple: Multiple | None, way: Way, point: PointRing) -> bool:
    """Whether a value is 0 by the steps of a way, or a multiple of a condition.

    Args:
        value: At the posture.
        multiple: Of which condition; None if it is 0 by the steps alone.
        way: To the node.
        point: The posture.

    Raises:
        RefusedError: If there is no such condition or step.
    """
    if multiple is None:
        return bool(value == 0)
    condition = point.value(read(condition_of(way, multiple.condition)))
    right = point.value(read(multiple.times)) * condition
    return bool(value * divided(multiple.over, way, point) == right)


def divided(over: Mapping[str, int], way: Way, point: PointRing) -> Any:
    """The product of powers of the divisors of a way's steps at a posture.

    Args:
        over: Powers by number of the step.
        way: Its steps.
        point: The posture.

    Raises:
        RefusedError: If there is no such step.
    """
    product = point.one
    for number, power in over.items():
        try:
            step = dict(enumerate(way.steps))[int(number)]
        except (ValueError, KeyError):
            raise RefusedError(f"there is no step {number}") from None
        product = product * point.value(read(step.over)) ** power
    return product


def condition_of(way: Way, number: int) -> str:
    """A condition of a way by its number.

    Raises:
        RefusedError: If there is none.
    """
    if not 0 <= number < len(way.conditions):
        raise RefusedError(f"there is no condition {number}")
    return way.conditions[number]
