"""Exact points on conditions that were not solved: a root modulo a prime.

All generators but those of one symbol or angle are fixed at random; what is left is a
polynomial in one unknown, whose roots mod p FLINT finds.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Collection, Mapping, Sequence
from itertools import combinations
from typing import Any, TypeAlias

from flint import nmod_poly

from screwkit.algebra.common_root import common_root, interpolated
from screwkit.algebra.linear_systems import has_solutions, linear_systems, solved_at
from screwkit.algebra.points import Point, random_angle, residue
from screwkit.algebra.restrictions import coefficients
from screwkit.algebra.substitution import Substitution
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

_LONG = 2_000
"""Terms of a condition that is interpolated, not taken apart by powers."""


_ON_PARTS = 8
"""Points where parts may be several; of two alike one is missed in one case of 128."""


def points_asked(ring: TrigonometricRing, pending: Sequence[Polynomial]) -> int:
    """How many random points show what pending conditions describe.

    A condition that is linear in a symbol of its own is a graph over the others.  Of
    two that are not, one may be a product over the other: each point lies at one of its
    roots at random.
    """
    degrees = [condition.degrees() for condition in pending]
    own = [
        any(
            d[i] == 1 == sum(bool(o[i]) for o in degrees) for i in ring.symbol_indices()
        )
        for d in degrees
    ]
    return 2 if own.count(False) < 2 else _ON_PARTS


def moved_onto(
    ring: TrigonometricRing,
    pending: Sequence[Polynomial],
    point: Point,
    source: random.Random,
    prime: int,
    *,
    pairs: bool = False,
    nonzero: Collection[int] = (),
) -> Point | None:
    """Move the point onto all pending conditions, each along a generator of its own.

    Args:
        ring: Of the conditions.
        pending: The conditions.
        point: Where to start.
        source: Of randomness.
        prime: Modulus of the point.
        pairs: Move along two generators where two conditions share all of theirs.
        nonzero: Indices of generators that are not 0.
    """
    remaining = list(pending)
    while remaining:
        others = [set(unknowns(ring, p)) for p in remaining]
        for position in range(len(remaining)):
            later = set().union(*others[:position], *others[position + 1 :])
            free = sorted(u for u in others[position] if u not in later)
            if free:
                break
        else:
            systems = [
                own
                for own in linear_systems(ring, remaining)
                if has_solutions(remaining, own, nonzero)
            ]
            if systems:
                system = systems[0]
                taken = {*system.conditions}
                rest = [p for k, p in enumerate(remaining) if k not in taken]
                before = moved_onto(
                    ring, rest, point, source, prime, pairs=pairs, nonzero=nonzero
                )
                return before and solved_at(remaining, system, before, prime)
            if not pairs:
                return None
            return _with_a_pair(ring, remaining, point, source, prime, nonzero)
        condition = remaining.pop(position)
        # Solve the others first: they do not contain the variable kept for this one.
        solved = moved_onto(
            ring, remaining, point, source, prime, pairs=pairs, nonzero=nonzero
        )
        if solved is None:
            return None
        return _onto(ring, condition, free, solved, prime, source=source)
    return point


def _with_a_pair(
    ring: TrigonometricRing,
    remaining: Sequence[Polynomial],
    point: Point,
    source: random.Random,
    prime: int,
    nonzero: Collection[int],
) -> Point | None:
    """The point on conditions of which two share two unknowns that the others lack."""
    others = [set(unknowns(ring, p)) for p in remaining]
    for one, two in combinations(range(len(remaining)), 2):
        rest = [i for i in range(len(remaining)) if i not in (one, two)]
        used = set().union(*(others[i] for i in rest))
        shared = sorted((others[one] & others[two]) - used)
        if len(shared) < 2:
            continue
        kept = [remaining[i] for i in rest]
        solved = moved_onto(
            ring, kept, point, source, prime, pairs=True, nonzero=nonzero
        )
        if solved is None:
            return None
        pair = remaining[one], remaining[two]
        places = source.choice([*combinations(shared, 2)])
        found = _onto_both(ring, pair, places, solved, prime, source=source)
        if found is not None:
            return found
    return None


def _onto_both(
    ring: TrigonometricRing,
    pair: tuple[Polynomial, Polynomial],
    places: tuple[Unknown, Unknown],
    point: Point,
    prime: int,
    *,
    source: random.Random,
) -> Point | None:
    """The point moved along two unknowns to where two conditions vanish."""
    first, second = places
    sizes = [[degree_in(ring, p, u) for u in places] for p in pair]
    along = [_along(ring, p, second) for p in pair]

    def restricted(value: int) -> tuple[list[int], list[int]] | None:
        moved = _set(ring, point, first, value, prime)
        if moved is None:
            return None
        below = 1 if first[0] == "x" else (1 + value * value) % prime
        # A tangent's divisor is taken out: the resultant becomes a polynomial in it.
        one, two = (
            [int(c) * pow(below, own[0] // 2, prime) for c in restriction.coeffs()]
            for at, own in zip(along, sizes, strict=True)
            for restriction in [at(moved, prime)]
        )
        return one, two

    degree = sizes[0][0] * sizes[1][1] + sizes[1][0] * sizes[0][1]
    found = common_root(restricted, degree, source, prime)
    if found is None:
        return None
    moved = _set(ring, point, first, found[0], prime)
    return None if moved is None else _set(ring, moved, second, found[1], prime)


def degree_in(ring: TrigonometricRing, polynomial: Polynomial, unknown: Unknown) -> int:
    """In a symbol, or in the tangent of half an angle."""
    kind, number = unknown
    if kind == "x":
        return int(polynomial.degrees()[number])
    places = ring.sine_index(number), ring.cosine_index(number)
    return 2 * max(sum(int(e[i]) for i in places) for e in polynomial.monoms())


_Along: TypeAlias = Callable[[Point, int], Any]
"""A polynomial in one unknown, where the others have the values of a point."""


def _along(ring: TrigonometricRing, polynomial: Polynomial, unknown: Unknown) -> _Along:
    """The polynomial in one unknown at any point; taken apart once."""
    kind, number = unknown
    if kind == "x":
        return _along_symbol(polynomial, number)
    places = ring.sine_index(number), ring.cosine_index(number)
    return _along_tangent(polynomial, *places)


def _set(
    ring: TrigonometricRing, point: Point, unknown: Unknown, value: int, prime: int
) -> Point | None:
    """The point with another value of a symbol, or of the tangent of half an angle."""
    kind, number = unknown
    moved = list(point)
    if kind == "x":
        moved[number] = value
        return moved
    pair = _turn_of(value, prime)
    if pair is None:
        return None
    moved[ring.cosine_index(number)], moved[ring.sine_index(number)] = pair
    return moved


def _turn_of(tangent: int, prime: int) -> tuple[int, int] | None:
    """(cos, sin) of the angle with this tangent of its half."""
    below = (1 + tangent * tangent) % prime
    if not below:
        return None
    inverse = pow(below, -1, prime)
    return (1 - tangent * tangent) * inverse % prime, 2 * tangent * inverse % prime


Unknown = tuple[str, int]  # ("angle", number of the basis angle) or ("x", index)


def unknowns(ring: TrigonometricRing, polynomial: Polynomial) -> list[Unknown]:
    """The symbols and basis angles that occur."""
    degrees = polynomial.degrees()
    used = [("x", i) for i in ring.symbol_indices() if degrees[i]]
    used += [
        ("angle", k)
        for k in range(len(ring.basis))
        if degrees[ring.sine_index(k)] or degrees[ring.cosine_index(k)]
    ]
    return used


def _onto(
    ring: TrigonometricRing,
    condition: Polynomial,
    free: Sequence[tuple[str, int]],
    point: Point,
    prime: int,
    *,
    source: random.Random,
) -> Point | None:
    for kind, number in source.sample(list(free), len(free)):
        moved = list(point)
        if kind == "x":
            root = root_in(condition, number, point, source, prime)
            if root:
                moved[number] = root
                return moved
        else:
            pair = _angle_root(ring, condition, number, point, prime, source=source)
            if pair is not None:
                moved[ring.cosine_index(number)], moved[ring.sine_index(number)] = pair
                return moved
    return None


def _angle_root(
    ring: TrigonometricRing,
    condition: Polynomial,
    angle: int,
    point: Point,
    prime: int,
    *,
    source: random.Random,
) -> tuple[int, int] | None:
    """(cos, sin) of an angle that makes the condition vanish, by its half-tangent."""
    sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
    total = _along_tangent(condition, sine, cosine)(point, prime)
    if total == 0:
        return random_angle(source, prime)
    if total.degree() < 1:
        return None
    roots = [int(root) for root, _ in total.roots()]
    source.shuffle(roots)
    turns = (_turn_of(t, prime) for t in roots)
    return next((turn for turn in turns if turn is not None), None)


def _along_tangent(condition: Polynomial, sine: int, cosine: int) -> _Along:
    """A condition as a polynomial in the tangent of half an angle, without divisor."""
    if _is_linear(condition, sine, cosine):

        def linear(point: Point, prime: int) -> Any:
            at_zero, at_sine, at_cosine = (
                _value(condition, {sine: s, cosine: c}, point, prime)
                for s, c in ((0, 0), (1, 0), (0, 1))
            )
            # P·2t + Q·(1 − t²) + R·(1 + t²), with P + R, Q + R and R given.
            along = 2 * (at_sine - at_zero)
            return nmod_poly([at_cosine, along, 2 * at_zero - at_cosine], prime)

        return linear
    parts = coefficients(condition, (sine, cosine))
    degree = max(s + c for s, c in parts)

    def at(point: Point, prime: int) -> Any:
        total = nmod_poly([0], prime)
        for (s, c), part in parts.items():
            term = nmod_poly([residue(part, point, prime)], prime)
            term *= nmod_poly([0, 2], prime) ** s * nmod_poly([1, 0, -1], prime) ** c
            total += term * nmod_poly([1, 0, 1], prime) ** (degree - s - c)
        return total

    return at


def _is_linear(condition: Polynomial, sine: int, cosine: int) -> bool:
    degrees = condition.degrees()
    if max(degrees[sine], degrees[cosine]) > 1:
        return False
    both = degrees[sine] and degrees[cosine]
    return not (both and condition.derivative(sine).degrees()[cosine])


def _value(
    polynomial: Polynomial, changed: Mapping[int, int], point: Point, prime: int
) -> int:
    """At a point with other values of some generators."""
    values = list(point)
    for index, value in changed.items():
        values[index] = value
    return residue(polynomial, values, prime)


def _along_symbol(polynomial: Polynomial, index: int) -> _Along:
    """A condition as a polynomial in one generator."""
    if polynomial.degrees()[index] == 1:

        def linear(point: Point, prime: int) -> Any:
            first, second = (
                _value(polynomial, {index: x}, point, prime) for x in (0, 1)
            )
            return nmod_poly([first, second - first], prime)

        return linear
    if len(polynomial) > _LONG:
        places = range(int(polynomial.degrees()[index]) + 1)

        def told(point: Point, prime: int) -> Any:
            values = [_value(polynomial, {index: x}, point, prime) for x in places]
            return nmod_poly(interpolated(places, values, prime), prime)

        return told
    parts = {
        power: part for (power,), part in coefficients(polynomial, (index,)).items()
    }

    def at(point: Point, prime: int) -> Any:
        values = {power: residue(part, point, prime) for power, part in parts.items()}
        dense = [values.get(power, 0) for power in range(max(values) + 1)]
        return nmod_poly(dense, prime)

    return at


def angles_in_numbers(
    ring: TrigonometricRing,
    steps: Sequence[Substitution],
    point: Point,
    source: random.Random,
    prime: int,
) -> dict[str, int] | None:
    """Roots for angles solved in numbers, put into a point; None without one."""
    found: dict[str, int] = {}
    solved: set[int] = set()
    for step in reversed(steps):
        if step.relation is not None and step.relation[0] not in solved:
            index, _, polynomial = step.relation
            root = root_in(polynomial, index, point, source, prime)
            if root is None:
                return None
            point[index] = found[ring.names[index]] = root
        solved.update(index for index, _ in step.images)
    return found


def root_in(
    polynomial: Polynomial,
    index: int,
    point: Point,
    source: random.Random,
    prime: int,
) -> int | None:
    """A root mod p of a polynomial in one generator, the others fixed."""
    roots = _along_symbol(polynomial, index)(point, prime).roots()
    if not roots:
        return None
    return int(source.choice(roots)[0])


def coefficients_in(
    ring: TrigonometricRing, polynomial: Polynomial, unknown: Unknown
) -> list[Polynomial]:
    """Coefficients of a polynomial in the generators of one unknown."""
    kind, number = unknown
    places = [number]
    if kind == "angle":
        places = [ring.sine_index(number), ring.cosine_index(number)]
    return [*coefficients(polynomial, places).values()]
