"""Exact polynomials of the indices and exact bases of the statics, as texts.

Coefficients are read from residues modulo two primes; one that is no short number of
the geometry's constants leaves the polynomial out, and the values stay numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from screwkit.algebra.algebraic_numbers import AlgebraicNumber
from screwkit.algebra.closed_roots import closed_roots
from screwkit.algebra.reconstruction import Reconstruction
from screwkit.analyses.partition import GraspPair
from screwkit.grasping.characteristic import characteristics
from screwkit.grasping.statics import contact_forces, static_bases
from screwkit.mechanism.model import Mechanism
from screwkit.results.manipulability import IndexValues

LONGEST = 160
"""Characters of a polynomial up to which it is written."""


@dataclass(frozen=True)
class ExactIndices:
    """Polynomials in x and their short roots; empty where they are not short.

    Attributes:
        kinematic, force, internal: (polynomial, roots).
        structural_wrenches: A basis, (f; m) each.
        internal_torques: A basis, in the order of the actuated freedoms; left out
            where an axis of the file is not of unit length.
    """

    kinematic: tuple[str, tuple[str, ...]]
    force: tuple[str, tuple[str, ...]]
    internal: tuple[str, tuple[str, ...]]
    structural_wrenches: tuple[tuple[str, ...], ...]
    internal_torques: tuple[tuple[str, ...], ...]


def exact_indices(mechanism: Mechanism, at: GraspPair) -> ExactIndices:
    """What is exact at the numbers of a mechanism."""
    numbers = at.numbers
    forces = [contact_forces(grasp) for grasp in at.grasps]
    one, other = (
        characteristics(mechanism, *parts)
        for parts in zip(at.grasps, at.blocks, forces, strict=True)
    )
    bases = [static_bases(*parts) for parts in zip(at.grasps, forces, strict=True)]
    strokes = at.grasps[0].matrices.strokes[: at.grasps[0].actuated]
    unit = all(int(stroke) == 1 for stroke in strokes)
    return ExactIndices(
        _written(numbers, one.kinematic, other.kinematic),
        _written(numbers, one.force, other.force),
        _written(numbers, one.internal, other.internal),
        _vectors(numbers, bases[0].structural, bases[1].structural),
        _vectors(numbers, bases[0].internal, bases[1].internal) if unit else (),
    )


def with_polynomial(
    index: IndexValues, exact: tuple[str, tuple[str, ...]]
) -> IndexValues:
    """An index with its polynomial and its short roots."""
    return replace(index, polynomial=exact[0], exact=exact[1])


def _written(
    numbers: Reconstruction,
    one: Sequence[int] | None,
    other: Sequence[int] | None,
) -> tuple[str, tuple[str, ...]]:
    if one is None or other is None or len(one) < 2 or len(one) != len(other):
        return "", ()
    found = numbers.numbers(one, other)
    if found is None:
        return "", ()
    text = _polynomial(found)
    if len(text) > LONGEST:
        return "", ()
    rational = [_rational(number) for number in found]
    known = [value for value in rational if value is not None]
    return text, closed_roots(known) if len(known) == len(rational) else ()


def _rational(number: AlgebraicNumber) -> Fraction | None:
    if not number.terms:
        return Fraction(0)
    return number.terms[0][1] if number.is_rational else None


def _polynomial(coefficients: Sequence[AlgebraicNumber]) -> str:
    """In x, highest power first, as text of the grammar."""
    parts = []
    for power in range(len(coefficients) - 1, -1, -1):
        number = coefficients[power]
        if not number.terms:
            continue
        several = len(number.terms) > 1
        sign = number.sign
        size = number if sign > 0 else number.scaled(Fraction(-1))
        text = f"({size.text})" if several else size.text
        variable = "" if not power else "x" if power == 1 else f"x^{power}"
        if variable:
            text = variable if text == "1" else f"{text}*{variable}"
        parts.append(("-" if sign < 0 else "+", text))
    (leading, first), *rest = parts
    start = first if leading == "+" else f"-{first}"
    return start + "".join(f" {joint} {text}" for joint, text in rest)


def _vectors(
    numbers: Reconstruction,
    one: Sequence[Sequence[int]],
    other: Sequence[Sequence[int]],
) -> tuple[tuple[str, ...], ...]:
    """Texts of all vectors, each up to a factor; empty unless all are known."""
    found = []
    for pair in zip(one, other, strict=True):
        vector = numbers.direction(*pair)
        if vector is None:
            return ()
        found.append(tuple(number.text for number in vector))
    return tuple(found)
