"""Angles and lengths taken out of closing equations, one after the other.

Two equations that are linear in the sine and cosine of an angle give both of them as
quotients over one divisor; that they lie on the circle is an equation without the
angle.  One such equation gives two values, and any other equation its product over
both.  Two that are linear in a length give its quotient twice.  What is left holds
wherever the equations do, and an exact point of it leads back to one of theirs.

References: [CoxLittleOShea] §3.1 (elimination).
"""

from __future__ import annotations

import random
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import TypeAlias

from screwkit.algebra.angle_norms import without_angle
from screwkit.algebra.effort import Effort
from screwkit.algebra.fixed_angles import fixed_angles, put_in
from screwkit.algebra.points import (
    Point,
    random_point,
    residue,
    root_modulo,
    with_inverses,
)
from screwkit.algebra.points_on import Unknown, moved_onto, unknowns
from screwkit.algebra.substitution import angle_parts, linear_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

LONGEST = 20_000
"""Products of terms in one elimination; beyond, it is given up."""

EFFORT = 2_000_000
"""Products of terms in all orders in which unknowns are taken out."""

TRIED = 60
"""Orders in which unknowns are taken out, at most."""

_ATTEMPTS = 60


@dataclass(frozen=True)
class Solved:
    """An unknown as a quotient of polynomials without it.

    Attributes:
        unknown: Which.
        pair: The two equations that give it.
        numerators: (index of a generator, numerator).
        divisor: Of both.
    """

    unknown: Unknown
    pair: tuple[Polynomial, Polynomial]
    numerators: tuple[tuple[int, Polynomial], ...]
    divisor: Polynomial


@dataclass(frozen=True)
class Determined:
    """An unknown that one equation gives: others lack it, or lose it by products."""

    unknown: Unknown
    equation: Polynomial


@dataclass(frozen=True)
class Elimination:
    """What equations imply for the unknowns that were kept.

    Attributes:
        ring: Of all polynomials.
        equations: As they were given.
        left: In the kept unknowns alone; each holds wherever the equations do.
        steps: How the others follow, the last eliminated last.
    """

    ring: TrigonometricRing
    equations: tuple[Polynomial, ...]
    left: tuple[Polynomial, ...]
    steps: tuple[Solved | Determined, ...]

    def point(self, source: random.Random, prime: int) -> Point | None:
        """An exact point of the equations; None where none was found modulo a prime."""
        for _ in range(_ATTEMPTS):
            start = random_point(self.ring, source, prime)
            if start is None:
                return None
            point = self._left(start, source, prime)
            for step in reversed(self.steps):
                if point is not None:
                    point = self._back(step, point, source, prime)
            if point is not None and not any(
                residue(e, point, prime) for e in self.equations
            ):
                return point
        return None

    def _left(self, start: Point, source: random.Random, prime: int) -> Point | None:
        """The point moved onto what is left; a symbol alone is 0."""
        gens = list(self.ring.context.gens())
        alone = [gens.index(p) for p in self.left if p in gens]
        others = [p for p in self.left if p not in gens]
        for index in alone:
            start[index] = 0
        return moved_onto(self.ring, others, start, source, prime)

    def _back(
        self, step: Solved | Determined, point: Point, source: random.Random, prime: int
    ) -> Point | None:
        if isinstance(step, Determined):
            return _root(self.ring, step, point, source, prime)
        divisor = residue(step.divisor, point, prime)
        if not divisor:
            return None
        inverse = pow(divisor, -1, prime)
        values = [(i, residue(n, point, prime)) for i, n in step.numerators]
        moved = list(point)
        for index, numerator in values:
            moved[index] = numerator * inverse % prime
        return with_inverses(self.ring, moved, prime)


def eliminated(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    kept: Collection[Unknown],
    effort: int = EFFORT,
    *,
    plain: bool = False,
) -> Elimination | None:
    """All unknowns but those kept taken out of equations, where that is short.

    Args:
        ring: Of the equations.
        equations: In normal form.
        kept: Unknowns to express the result in.
        effort: Products of terms that it may take, in each of two ways.
        plain: Put no angle that is fixed in numbers into other equations, so that all
            steps are combinations of equations.

    Returns:
        None where an unknown is not linear in two equations, or the result too long.
    """
    pool = [p for p in equations if p != 0]
    way = _Way(ring, frozenset(kept), plain)
    found = _searched(way, pool, Effort(effort), [TRIED])
    if found is None:  # products over two values are longer
        way = replace(way, norms=True)
        found = _searched(way, pool, Effort(effort), [TRIED])
    if found is None:
        return None
    left, steps = found
    return Elimination(ring, tuple(equations), tuple(left), tuple(steps))


_Step: TypeAlias = Solved | Determined


@dataclass(frozen=True)
class _Way:
    """How unknowns are taken out.

    Attributes:
        norms: By one equation that has two solutions, too.
    """

    ring: TrigonometricRing
    kept: frozenset[Unknown]
    plain: bool
    norms: bool = False


def _searched(
    way: _Way, pool: list[Polynomial], effort: Effort, tries: list[int]
) -> tuple[list[Polynomial], list[_Step]] | None:
    """What is left without the unknowns that are not kept, and how they follow."""
    ring = way.ring
    if not way.plain:
        pool = put_in(ring, pool, fixed_angles(ring, pool))
    open_ones = {u for p in pool for u in unknowns(ring, p) if u not in way.kept}
    if not open_ones:
        return pool, []
    for step, rest in _steps(way, pool, sorted(open_ones), effort):
        if tries[0] <= 0:
            return None
        tries[0] -= 1
        found = _searched(way, rest, effort, tries)
        if found is not None:
            return found[0], [step, *found[1]]
    return None


def _steps(
    way: _Way, pool: Sequence[Polynomial], open_ones: Sequence[Unknown], effort: Effort
) -> Iterator[tuple[_Step, list[Polynomial]]]:
    """One unknown less: the step, and the equations without it; short ones first.

    With norms one linear equation is enough, where two were not.
    """
    ring = way.ring
    pairs: list[tuple[bool, int, Unknown, tuple[int, int]]] = []
    alone: list[tuple[int, Unknown, int]] = []
    for unknown in open_ones:
        places = [i for i, p in enumerate(pool) if unknown in unknowns(ring, p)]
        if len(places) == 1:
            if parts_in(ring, pool[places[0]], unknown) is not None:
                rest = [p for i, p in enumerate(pool) if i != places[0]]
                yield Determined(unknown, pool[places[0]]), rest
                return
            continue
        parts = {i: parts_in(ring, pool[i], unknown) for i in places}
        linear = [i for i in places if parts[i] is not None]
        if way.norms and unknown[0] == "angle":
            alone += [(len(pool[i]), unknown, i) for i in linear]
        if len(linear) < len(places):
            continue
        for i, k in combinations(linear, 2):
            size = len(pool[i]) * len(pool[k])
            pairs.append(
                (not _is_even(ring, pool[i], pool[k], unknown), size, unknown, (i, k))
            )
    for _, size, unknown, pair in sorted(pairs):
        if size <= LONGEST and effort.spend(size):
            taken = _without(ring, pool, unknown, pair, effort)
            if taken is not None:
                yield taken
    for _, unknown, place in sorted(alone):
        left = without_angle(ring, pool, unknown[1], place, effort)
        if left is not None:
            yield Determined(unknown, pool[place]), left


def _is_even(
    ring: TrigonometricRing, one: Polynomial, two: Polynomial, unknown: Unknown
) -> bool:
    """Whether the divisor of a pair is a number."""
    parts = parts_in(ring, one, unknown), parts_in(ring, two, unknown)
    if unknown[0] == "x" or parts[0] is None or parts[1] is None:
        return any(part is not None and part[0].is_constant() for part in parts)
    (p, q, _), (s, t, _) = parts[0], parts[1]
    return bool(ring.normal(p * t - q * s).is_constant())


def _without(
    ring: TrigonometricRing,
    pool: Sequence[Polynomial],
    unknown: Unknown,
    pair: tuple[int, int],
    effort: Effort,
) -> tuple[_Step, list[Polynomial]] | None:
    """The pool without an unknown that two of its equations give."""
    solved = _solved(ring, [pool[i] for i in pair], unknown)
    if solved is None:
        return None
    step, rest = solved
    for i, equation in enumerate(pool):
        if i in pair:
            continue
        if unknown not in unknowns(ring, equation):
            rest.append(equation)
            continue
        value = None
        if effort.spend(len(equation) * len(step.divisor)):
            value = _put_in(ring, equation, unknown, step)
        if value is None:
            return None
        rest.append(value)
    return step, [primitive(p) for p in rest if p != 0]


def parts_in(
    ring: TrigonometricRing, polynomial: Polynomial, unknown: Unknown
) -> tuple[Polynomial, ...] | None:
    """(P, Q, R) of P·sin + Q·cos + R, or (A, B) of A·x + B; None where not linear."""
    kind, number = unknown
    if kind == "angle":
        return angle_parts(ring, polynomial, number)
    if polynomial.degrees()[number] != 1:
        return None
    return linear_parts(ring, polynomial, number)


def _solved(
    ring: TrigonometricRing, pair: Sequence[Polynomial], unknown: Unknown
) -> tuple[Solved, list[Polynomial]] | None:
    """The unknown of two linear equations, and what is left of them."""
    one, two = (parts_in(ring, p, unknown) for p in pair)
    if one is None or two is None:
        return None
    kind, number = unknown
    if kind == "x":
        (a, b), (c, d) = one, two
        shorter, rest = ((a, b), a * d - b * c)
        if len(c) < len(a):
            shorter = c, d
        numerator, divisor = -shorter[1], shorter[0]
        solved = Solved(unknown, (pair[0], pair[1]), ((number, numerator),), divisor)
        return solved, [ring.normal(rest)]
    (p, q, r), (s, t, u) = one, two
    divisor = ring.normal(p * t - q * s)
    if divisor == 0:
        return None
    sine = ring.normal(q * u - r * t)
    cosine = ring.normal(r * s - p * u)
    if max(len(sine), len(cosine), len(divisor)) ** 2 > LONGEST:
        return None
    circle = ring.normal(sine * sine + cosine * cosine - divisor * divisor)
    places = (ring.sine_index(number), sine), (ring.cosine_index(number), cosine)
    return Solved(unknown, (pair[0], pair[1]), places, divisor), [circle]


def _put_in(
    ring: TrigonometricRing, equation: Polynomial, unknown: Unknown, step: Solved
) -> Polynomial | None:
    parts = parts_in(ring, equation, unknown)
    if parts is None or len(equation) * len(step.divisor) > LONGEST:
        return None
    values = [numerator for _, numerator in step.numerators]
    total = parts[-1] * step.divisor
    for part, value in zip(parts[:-1], values, strict=True):
        total += part * value
    return ring.normal(total)


def _root(
    ring: TrigonometricRing,
    step: Determined,
    point: Point,
    source: random.Random,
    prime: int,
) -> Point | None:
    """The point with a value of the unknown at which its equation vanishes."""
    kind, number = step.unknown
    parts = parts_in(ring, step.equation, step.unknown)
    if parts is None:
        return None
    values = [residue(part, point, prime) for part in parts]
    moved = list(point)
    if kind == "x":
        if not values[0]:
            return None
        moved[number] = -values[1] * pow(values[0], -1, prime) % prime
        return with_inverses(ring, moved, prime)
    p, q, r = values
    # With t = tan of half the angle: (r − q) t² + 2 p t + (q + r) = 0.
    if r == q:
        if not p:
            return None
        t = -(q + r) * pow(2 * p, -1, prime) % prime
    else:
        root = root_modulo((p * p + q * q - r * r) % prime, prime)
        if root is None:
            return None
        root *= source.choice((1, -1))
        t = (root - p) * pow(r - q, -1, prime) % prime
    below = (1 + t * t) % prime
    if not below:
        return None
    inverse = pow(below, -1, prime)
    moved[ring.sine_index(number)] = 2 * t * inverse % prime
    moved[ring.cosine_index(number)] = (1 - t * t) * inverse % prime
    return with_inverses(ring, moved, prime)
