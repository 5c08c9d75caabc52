"""What strata are made of: components of an answer, and what these suggest together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.parse import parse
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.results.singularities import Component, Singularities
from screwkit.results.strata import ExpectedState, Member, PlatformState


def members_of(answer: Singularities) -> Iterator[tuple[Member, Component]]:
    """All components of an answer: limbs, then constraint, then actuation."""
    for limb in answer.limb:
        for n, component in enumerate(limb.components):
            yield Member("limb", limb.limb, n), component
    for n, component in enumerate(answer.constraint.components):
        yield Member("constraint", "", n), component
    if answer.actuation is not None:
        for n, component in enumerate(answer.actuation.components):
            yield Member("actuation", "", n), component


def left_side(ring: TrigonometricRing, text: str) -> Polynomial:
    """The left side of an equation of a component, without divisors.

    Raises:
        ExpressionError: If it cannot be written in the ring.
    """
    value = ring.normal(evaluate(parse(text), ring))
    return ring.without_divisors([value])[0]


def expected_state(
    size: int, generic: PlatformState, alone: Sequence[PlatformState]
) -> ExpectedState:
    """What conditions suggest together, from the states on each of them.

    Args:
        size: Coordinates of a twist.
        generic: The state in general.
        alone: Those on the conditions, one by one.
    """
    ranks = tuple(
        min(own) if min(own) < general else max(own)
        for general, *own in zip(
            generic.limb_ranks, *(s.limb_ranks for s in alone), strict=True
        )
    )
    dependent = max(
        sum(size - rank for rank in s.limb_ranks) - s.wrench_dimension for s in alone
    )
    wrenches = sum(size - rank for rank in ranks) - dependent
    wrenches = max(0, min(size, wrenches))
    locked = [s.locked_freedom for s in alone if s.locked_freedom is not None]
    return ExpectedState(ranks, wrenches, size - wrenches, max(locked, default=None))


def differs(state: PlatformState, expected: ExpectedState) -> bool:
    """Whether more or less happens than is expected."""
    return (
        state.limb_ranks != expected.limb_ranks
        or state.platform_freedom != expected.platform_freedom
        or state.locked_freedom != expected.locked_freedom
    )
