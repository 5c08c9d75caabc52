"""Generators replaced by polynomials, over a divisor that is nowhere zero.

Solving a condition makes everything after it shorter; doing so without fractions keeps
a screw a screw, because a common factor of its coordinates does not matter.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
)


@dataclass(frozen=True)
class Substitution:
    """Generators replaced by polynomials, over a divisor that is nowhere zero there.

    Attributes:
        images: (index of a generator, its numerator).
        divisor: Common denominator of the images.
        relation: A further relation in one generator, (index, degree, polynomial).
        field: Relations of the irrational constants in that one, in the same form.
        sheet: A polynomial that vanishes on this sheet of the solution and not on the
            other; None where there is one sheet only.
        condition: What was solved.
        companions: Further equations of a condition that takes several.
        partial: Whether zeros of the condition are left out where the divisor vanishes.
    """

    images: tuple[tuple[int, Polynomial], ...]
    divisor: Polynomial
    relation: tuple[int, int, Polynomial] | None = None
    sheet: Polynomial | None = None
    condition: Polynomial | None = None
    companions: tuple[Polynomial, ...] = ()
    partial: bool = False
    field: tuple[tuple[int, int, Polynomial], ...] = ()


def substituted(
    ring: TrigonometricRing, values: Sequence[Polynomial], step: Substitution
) -> list[Polynomial]:
    """A vector after a step, up to a power of the step's divisor."""
    if step.divisor.is_constant():
        replaced = _composed(ring, values, step)
    else:
        power = power_of(values, step)
        replaced = [_fraction_free(ring, value, step, power) for value in values]
    normal = [ring.normal(value) for value in replaced]
    return reduced(normal, [step])


def reduced(
    values: Sequence[Polynomial], steps: Sequence[Substitution]
) -> list[Polynomial]:
    """Polynomials modulo the relations of some steps.

    A step may bring powers of a generator back in which an earlier step has a relation.
    Normal forms write the square of a sine by the cosine: of an angle whose cosine is a
    number that one is put in again.
    """
    found = list(values)
    for step in steps:
        if step.relation is None:
            continue
        for index, image in step.images:
            found = [_replaced(v, index, image) for v in found]
        for index, degree, relation in (step.relation, *step.field):
            found = [
                divmod(v, relation)[1] if v != 0 and v.degrees()[index] >= degree else v
                for v in found
            ]
    return found


def _replaced(value: Polynomial, index: int, image: Polynomial) -> Polynomial:
    """A generator replaced where it occurs."""
    if value == 0 or not value.degrees()[index]:
        return value
    gens = list(value.context().gens())
    gens[index] = image
    return value.compose(*gens)


def power_of(values: Sequence[Polynomial], step: Substitution) -> int:
    """The power of the step's divisor by which `substituted` multiplies a vector."""
    if step.divisor.is_constant():
        return 0
    indices = [index for index, _ in step.images]
    return max((_degree_in(v, indices) for v in values), default=0)


def _composed(
    ring: TrigonometricRing, values: Sequence[Polynomial], step: Substitution
) -> list[Polynomial]:
    """Values after a step whose divisor is a number; most lack what is replaced."""
    found = list(values)
    images: list[Polynomial] = []
    for position, value in enumerate(values):
        if value.is_constant():
            continue
        degrees = value.degrees()
        if any(degrees[index] for index, _ in step.images):
            if not images:
                images = list(ring.context.gens())
                scale = ring.rational(1 / as_fraction(step.divisor))
                for index, image in step.images:
                    images[index] = image * scale
            found[position] = value.compose(*images)
    return found


def _degree_in(value: Polynomial, indices: Sequence[int]) -> int:
    """Largest total degree in some generators."""
    if value.is_constant():
        return 0
    degrees = value.degrees()
    if len(indices) == 1:
        return int(degrees[indices[0]])
    if not any(degrees[i] for i in indices):
        return 0
    return max(int(sum(e[i] for i in indices)) for e in value.monoms())


def _fraction_free(
    ring: TrigonometricRing, value: Polynomial, step: Substitution, power: int
) -> Polynomial:
    """divisor^power · value with each generator replaced by image/divisor."""
    if value == 0:
        return value
    indices = [index for index, _ in step.images]
    if value.is_constant():
        return value * step.divisor**power
    degrees = value.degrees()
    occurring = [k for k, i in enumerate(indices) if degrees[i]]
    if not occurring:
        return value * step.divisor**power
    if all(degrees[indices[k]] == 1 for k in occurring):
        linear = _linear(value, step, occurring)
        if linear is not None:
            above, rest = linear
            return (above + rest * step.divisor) * step.divisor ** (power - 1)
    parts: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in value.to_dict().items():
        rest = tuple(0 if i in indices else e for i, e in enumerate(exponents))
        key = tuple(int(exponents[i]) for i in indices)
        parts.setdefault(key, {})[rest] = coefficient
    total = ring.zero
    for key, terms in parts.items():
        term = ring.context.from_dict(terms) * step.divisor ** (power - sum(key))
        for (_, image), exponent in zip(step.images, key, strict=True):
            term = term * image**exponent
        total += term
    return total


def _linear(
    value: Polynomial, step: Substitution, occurring: Sequence[int]
) -> tuple[Polynomial, Polynomial] | None:
    """What replaced generators bring in, and the rest; None where two are multiplied.

    By derivatives: no monomial is looked at one by one.
    """
    above, rest = None, value
    gens = value.context().gens()
    indices = [index for index, _ in step.images]
    for k in occurring:
        index, image = step.images[k]
        factor = value.derivative(index)
        if any(factor.degrees()[i] for i in indices):
            return None
        rest -= factor * gens[index]
        term = factor * image
        above = term if above is None else above + term
    return above, rest


def angle_parts(
    ring: TrigonometricRing, polynomial: Polynomial, angle: int
) -> tuple[Polynomial, Polynomial, Polynomial] | None:
    """(P, Q, R) with polynomial = P·sin φ + Q·cos φ + R, all free of φ.

    None where φ does not occur or occurs to a higher degree.
    """
    sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
    degrees = polynomial.degrees()
    if not 0 < max(degrees[sine], degrees[cosine]) <= 1:
        return None
    if degrees[sine] and degrees[cosine]:
        by_sine, rest = linear_parts(ring, polynomial, sine)
        if by_sine.degrees()[cosine]:
            return None
        by_cosine, rest = linear_parts(ring, rest, cosine)
        return by_sine, by_cosine, rest
    index = sine if degrees[sine] else cosine
    factor, rest = linear_parts(ring, polynomial, index)
    if index == sine:
        return factor, ring.zero, rest
    return ring.zero, factor, rest


def linear_parts(
    ring: TrigonometricRing, polynomial: Polynomial, index: int
) -> tuple[Polynomial, Polynomial]:
    """(A, B) with polynomial = A·x + B, for a generator of degree one."""
    factor = polynomial.derivative(index)
    rest = polynomial - factor * ring.context.gens()[index]
    return factor, rest
