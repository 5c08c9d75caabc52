"""Equations modulo a prime, all that is given at random values, unknowns as variables.

Angles that an equation fixes, by itself or against another one, are put in: each at its
two values, where the root exists modulo the prime.  What is linear is solved.  So a
system becomes a few smaller ones, whose zeros together are its own.

References: [CoxLittleOShea] §3.1.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, TypeAlias

from flint import Ordering, nmod_mpoly_ctx

from screwkit.algebra.monomials import Terms
from screwkit.algebra.points import Point, random_point, root_modulo, with_inverses
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

SHEETS: Final = 32
"""Systems into which one is taken apart, at most."""

_Residues: TypeAlias = Any  # flint.nmod_mpoly, which has no type stubs


@dataclass(frozen=True)
class ResidueSystem:
    """Equations in variables modulo a prime.

    Attributes:
        prime: The modulus.
        base: Values of all generators of the ring; those of the variables mean nothing.
        places: Of the variables among the generators.
        pairs: Variables that are the sine and the cosine of an angle, and not solved.
        equations: Polynomials in the variables that are left, none of them 0.
        solved: What became of the others, the last one first to be put in: a variable,
            and the polynomial that it is.
        away: Polynomials whose zeros are left out; none of them 0.
    """

    prime: int
    base: Point
    places: tuple[int, ...]
    pairs: tuple[tuple[int, int], ...]
    equations: tuple[_Residues, ...]
    solved: tuple[tuple[int, _Residues], ...] = ()
    away: tuple[_Residues, ...] = ()

    @property
    def left(self) -> list[int]:
        """The variables that are not solved."""
        gone = {variable for variable, _ in self.solved}
        return [k for k in range(len(self.places)) if k not in gone]

    def terms(self) -> list[Terms]:
        """The equations in the variables that are left alone."""
        return self._in_left(self.equations)

    def away_terms(self) -> list[Terms]:
        """What is left out, in the variables that are left alone; constants apart."""
        return self._in_left([own for own in self.away if _degree(own)])

    def _in_left(self, polynomials: Sequence[_Residues]) -> list[Terms]:
        kept = self.left
        return [
            {tuple(int(e[k]) for k in kept): int(c) for e, c in own.to_dict().items()}
            for own in polynomials
        ]

    def point(self, ring: TrigonometricRing, values: Sequence[int]) -> Point:
        """All generators, where those that are left have these values."""
        own = [0] * len(self.places)
        for variable, value in zip(self.left, values, strict=True):
            own[variable] = value
        for variable, image in reversed(self.solved):
            own[variable] = int(image(*own))
        found = list(self.base)
        for place, value in zip(self.places, own, strict=True):
            found[place] = value
        return with_inverses(ring, found, self.prime)


def residue_systems(
    ring: TrigonometricRing,
    equations: Sequence[Polynomial],
    given: Collection[Unknown],
    prime: int,
    source: random.Random,
    away: Sequence[Sequence[Polynomial]] = (),
) -> list[ResidueSystem] | None:
    """The systems modulo a prime that have together the zeros of equations.

    Args:
        ring: Of the equations.
        equations: In normal form.
        given: Unknowns that have random values.
        prime: The modulus.
        source: Of the values.
        away: Sets whose common zeros are left out.  For each stands a random sum of
            multiples: that vanishes on a set alone where all of them do.

    Returns:
        Those without a contradiction that is seen; None where a root or an inverse of
        unknowns occurs, or the prime has no roots of numbers that the ring has.
    """
    base = random_point(ring, source, prime)
    if base is None:
        return None
    every = [*equations, *(e for own in away for e in own)]
    free = [*dict.fromkeys(u for e in every for u in unknowns(ring, e))]
    free = [unknown for unknown in free if unknown not in given]
    if _extends(ring, every):
        return None
    places: list[int] = []
    pairs: list[tuple[int, int]] = []
    for kind, number in free:
        if kind != "angle":
            places.append(number)
            continue
        pairs.append((len(places), len(places) + 1))
        places += [ring.sine_index(number), ring.cosine_index(number)]
    names = [f"y{k}" for k in range(len(places))] or ["y"]
    context = nmod_mpoly_ctx.get(names, prime, Ordering.degrevlex)
    own = [_read(context, e, places, base, prime) for e in equations]
    gens = context.gens()
    own += [gens[s] ** 2 + gens[c] ** 2 - 1 for s, c in pairs]
    left_out = []
    for one in away:
        read = [_read(context, e, places, base, prime) for e in one]
        left_out.append(sum(e * source.randrange(1, prime) for e in read))
    if any(polynomial == 0 for polynomial in left_out):
        return []
    system = ResidueSystem(
        prime,
        base,
        tuple(places),
        tuple(pairs),
        _without_zeros(own),
        away=tuple(left_out),
    )
    return [*_taken_apart(system)]


def _extends(ring: TrigonometricRing, equations: Sequence[Polynomial]) -> bool:
    """Whether roots or inverses of symbolic quantities occur."""
    degrees = [equation.degrees() for equation in equations]
    return any(own[k] for own in degrees for k in range(len(ring.extensions)))


def _read(
    context: Any,
    equation: Polynomial,
    places: Sequence[int],
    base: Point,
    prime: int,
) -> _Residues:
    variable = {place: number for number, place in enumerate(places)}
    terms: dict[tuple[int, ...], int] = {}
    for exponents, coefficient in equation.to_dict().items():
        value = int(coefficient.p) * pow(int(coefficient.q), -1, prime) % prime
        key = [0] * len(places)
        for place, power in enumerate(exponents):
            if not power:
                continue
            if place in variable:
                key[variable[place]] = int(power)
            else:
                value = value * pow(base[place], int(power), prime) % prime
        whole = tuple(key) or (0,)
        terms[whole] = (terms.get(whole, 0) + value) % prime
    return context.from_dict({key: value for key, value in terms.items() if value})


def _taken_apart(system: ResidueSystem) -> Iterator[ResidueSystem]:
    """Angles put in that are fixed, then what is linear."""
    for own in parted_by(_with_a_fixed_angle, system, SHEETS):
        solved = _linear_solved(own)
        if not is_contradictory(solved):
            yield solved


def _with_a_fixed_angle(system: ResidueSystem) -> list[ResidueSystem] | None:
    values = _fixed(system)
    if values is None:
        return None
    pair, images = values
    return [_with(system, [*zip(pair, image, strict=True)]) for image in images]


def parted_by(
    parts: Callable[[ResidueSystem], list[ResidueSystem] | None],
    system: ResidueSystem,
    most: int,
) -> list[ResidueSystem]:
    """What a system is taken apart into, again and again; contradictory ones are gone.

    Args:
        parts: Systems that have together the zeros of one; None where it stays.
        system: The first one.
        most: From so many systems on all others stay as they are.
    """
    done: list[ResidueSystem] = []
    waiting = [system]
    while waiting:
        own = waiting.pop()
        if is_contradictory(own):
            continue
        found = parts(own) if len(waiting) + len(done) < most else None
        if found is None:
            done.append(own)
        else:
            waiting += found
    return done


def is_contradictory(system: ResidueSystem) -> bool:
    """Whether a number that is not 0 should vanish, or what should not is 0."""
    wrong = any(_degree(equation) == 0 for equation in system.equations)
    return wrong or any(own == 0 for own in system.away)


def _fixed(
    system: ResidueSystem,
) -> tuple[tuple[int, int], list[tuple[_Residues, _Residues]]] | None:
    """An angle that an equation gives, and its sine and cosine in each solution."""
    for equation in system.equations:
        terms = {
            tuple(int(x) for x in key): int(value)
            for key, value in equation.to_dict().items()
        }
        met = {k for key in terms for k, power in enumerate(key) if power}
        for sine, cosine in system.pairs:
            if not met & {sine, cosine}:
                continue
            others = tuple(sorted(met - {sine, cosine}))
            found = None
            if not others:
                found = _alone(equation, terms, sine, cosine, system.prime)
            elif others in system.pairs:
                found = _against(equation, terms, (sine, cosine), others, system.prime)
            if found is not None:
                return (sine, cosine), found
    return None


def _alone(
    equation: _Residues, terms: Terms, sine: int, cosine: int, prime: int
) -> list[tuple[_Residues, _Residues]] | None:
    """The solutions of p sin + q cos + r = 0."""
    if max(map(sum, terms)) > 1:
        return None
    by = {next((k for k, x in enumerate(key) if x), -1): v for key, v in terms.items()}
    p, q, r = by.get(sine, 0), by.get(cosine, 0), by.get(-1, 0)
    below = (p * p + q * q) % prime
    root = root_modulo((below - r * r) % prime, prime)
    if not below or root is None:
        return None
    inverse = pow(below, -1, prime)
    one = equation.context().constant(1)
    return [
        (
            one * ((-p * r + q * w) * inverse % prime),
            one * ((-q * r - p * w) * inverse % prime),
        )
        for w in dict.fromkeys((root, -root % prime))
    ]


def _against(
    equation: _Residues,
    terms: Terms,
    pair: tuple[int, int],
    others: Sequence[int],
    prime: int,
) -> list[tuple[_Residues, _Residues]] | None:
    """The solutions of sin(φ ± φ' + constant) = 0, by sine and cosine of φ'."""
    table = {k: dict.fromkeys(others, 0) for k in pair}
    for key, value in terms.items():
        own = [k for k, power in enumerate(key) if power]
        first = [k for k in own if k in table]
        second = [k for k in own if k in others]
        if sum(key) != 2 or len(first) != 1 or len(second) != 1:
            return None
        table[first[0]][second[0]] = value
    (a, b), (c, d) = (list(row.values()) for row in table.values())
    square = (a * a + c * c) % prime
    root = root_modulo(square, prime)
    is_turn = not (b * b + d * d - square) % prime and not (a * b + c * d) % prime
    if not square or root is None or not is_turn:
        return None
    gens = equation.context().gens()
    x, y = (gens[k] for k in others)
    scale = root * pow(square, -1, prime) % prime
    sine, cosine = -(x * c + y * d), x * a + y * b
    return [(sine * w, cosine * w) for w in (scale, -scale % prime)]


def _linear_solved(system: ResidueSystem) -> ResidueSystem:
    """Variables that linear equations give put into the others."""
    while True:
        linear = next((e for e in system.equations if _degree(e) == 1), None)
        if linear is None:
            return system
        terms = {tuple(int(x) for x in k): int(v) for k, v in linear.to_dict().items()}
        key = next(key for key in terms if sum(key))
        variable = key.index(1)
        scale = pow(terms[key], -1, system.prime)
        image = linear.context().gens()[variable] - linear * scale
        system = _with(system, [(variable, image)])


def _with(
    system: ResidueSystem, images: Sequence[tuple[int, _Residues]]
) -> ResidueSystem:
    """With some variables put in."""
    gens = list(system.equations[0].context().gens())
    for variable, image in images:
        gens[variable] = image
    gone = {variable for variable, _ in images}
    return replace(
        system,
        pairs=tuple(pair for pair in system.pairs if not gone & {*pair}),
        equations=_without_zeros([e.compose(*gens) for e in system.equations]),
        away=tuple(own.compose(*gens) for own in system.away),
        solved=(*system.solved, *images),
    )


def _without_zeros(equations: Sequence[_Residues]) -> tuple[_Residues, ...]:
    return tuple(equation for equation in equations if equation != 0)


def _degree(equation: _Residues) -> int:
    return int(equation.total_degree())
