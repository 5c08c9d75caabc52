"""Branches of the exact engine as the steps of a certificate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from screwkit.algebra.branches import Branch
from screwkit.algebra.elimination import steps_of
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.substitution import (
    Substitution,
    angle_parts,
    power_of,
    reduced,
    substituted,
)
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
)
from screwkit.certificates.equations_told import Step
from screwkit.certificates.records import Reach
from screwkit.certificates.roots import NotProvedError, roots_of


def reach_of(branch: Branch) -> Reach:
    """How points of a branch are found."""
    steps = tuple(written_step(branch, n) for n in range(len(branch.steps)))
    ring = branch.ring
    roots = roots_of(ring, [p.value for p in branch.pending], branch.nonzero)
    return Reach(steps, roots)


def written_step(branch: Branch, number: int) -> Step:
    """A solved step of a branch in the terms of a certificate."""
    step = branch.steps[number]
    ring = branch.ring
    if step.relation is not None and step.condition is not None:
        angle, numbers = numbers_of(ring, step.condition)
        return Step("numbers", angle=angle, numbers=numbers)
    if len(step.images) == 1:
        ((index, image),) = step.images
        symbol = ring.symbols[index - ring.symbol_indices().start]
        return Step(
            "symbol",
            symbol=symbol,
            value=text(ring, image),
            over=text(ring, step.divisor),
            never=_never(branch, step, image),
        )
    if any(index in ring.symbol_indices() for index, _ in step.images):
        raise NotProvedError("an angle is 0 that occurs as a number too")
    return _turned("pair" if step.companions else "angle", ring, step)


def _turned(kind: str, ring: TrigonometricRing, step: Substitution) -> Step:
    """The step of an angle whose sine and cosine are given."""
    images = dict(step.images)
    angle = next(k for k in range(len(ring.basis)) if ring.sine_index(k) in images)
    return Step(
        kind,
        angle=angle,
        sine=text(ring, images[ring.sine_index(angle)]),
        cosine=text(ring, images[ring.cosine_index(angle)]),
        over=text(ring, step.divisor),
    )


def _never(branch: Branch, step: Substitution, image: Polynomial) -> tuple[Step, ...]:
    """Steps that solve divisor = 0, with what the numerator is on each."""
    ring = branch.ring
    if branch.assumptions.is_nonzero(ring, step.divisor):
        return ()
    found = []
    inside = steps_of(ring, branch.assumptions, step.divisor) or ()
    if any(inner.relation is not None for inner in inside) and not is_in_numbers(
        ring, step.divisor
    ):
        raise NotProvedError("an angle is fixed by irrational numbers")
    for inner in inside:
        there = text(ring, substituted(ring, [image], inner)[0])
        if inner.relation is not None:
            angle, numbers = numbers_of(ring, step.divisor)
            found.append(Step("numbers", angle=angle, numbers=numbers, value=there))
        else:
            found.append(replace(_turned("angle", ring, inner), value=there))
    return tuple(found)


def numbers_of(
    ring: TrigonometricRing, condition: Polynomial
) -> tuple[int, tuple[str, ...]]:
    """(angle, (a, b, c)) of a·sin φ + b·cos φ + c in rational numbers.

    Raises:
        ValueError: If the condition is not of that form.
    """
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, condition, angle)
        if parts is not None and all(part.is_constant() for part in parts):
            return angle, tuple(str(as_fraction(part)) for part in parts)
    raise ValueError("the condition is no equation in numbers for one angle")


def is_in_numbers(ring: TrigonometricRing, condition: Polynomial) -> bool:
    """Whether a condition is one of a single angle in rational numbers."""
    try:
        numbers_of(ring, condition)
    except ValueError:
        return False
    return True


def followed(
    branch: Branch, entries: Sequence[Polynomial]
) -> tuple[list[Polynomial], dict[str, int]]:
    """A vector on a branch, and the powers of the steps' divisors it was multiplied by.

    The powers go by the number of the step, as text.
    """
    values, powers = list(entries), {}
    for number, step in enumerate(branch.steps):
        power = power_of(values, step)
        if power:
            powers[str(number)] = power
        values = substituted(branch.ring, values, step)
    return reduced(values, branch.steps), powers


def added(*powers: Mapping[str, int]) -> dict[str, int]:
    """Powers of a product."""
    total: dict[str, int] = {}
    for own in powers:
        for number, power in own.items():
            total[number] = total.get(number, 0) + power
    return {number: power for number, power in total.items() if power}


def subtracted(left: Mapping[str, int], right: Mapping[str, int]) -> dict[str, int]:
    """Powers of a quotient."""
    return added(left, {number: -power for number, power in right.items()})
