"""Conditions that are linear in some symbols together: solved at a point all at once.

Where as many conditions as symbols contain those symbols, jointly linear, and no other
condition does, the symbols are a rational function of everything else wherever the
determinant of their coefficients is not zero.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Final

from flint import nmod_mat

from screwkit.algebra.minors import minors_of
from screwkit.algebra.points import Point, residue
from screwkit.algebra.remembered import RememberedColumns
from screwkit.algebra.substitution import linear_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LARGEST = 4
"""Conditions that are solved together, at most."""

SHORT = 40
"""Terms of conditions that are solved for symbols, not at points alone."""

_KNOWN: Final = RememberedColumns[TrigonometricRing, "tuple[LinearSystem, ...]"]()


@dataclass(frozen=True)
class LinearSystem:
    """Some of several conditions, and the symbols that they determine.

    Attributes:
        conditions: Positions among all conditions.
        symbols: Indices of generators; as many.
        determinant: Of their coefficients; not zero.
    """

    conditions: tuple[int, ...]
    symbols: tuple[int, ...]
    determinant: Polynomial


def linear_systems(
    ring: TrigonometricRing, conditions: Sequence[Polynomial]
) -> tuple[LinearSystem, ...]:
    """The smallest systems of at least two conditions, shortest determinants first.

    They are looked for at every attempt to draw a point, and found once.
    """
    return _KNOWN.answer(ring, conditions, None, lambda: _found(ring, conditions))


def _found(
    ring: TrigonometricRing, conditions: Sequence[Polynomial]
) -> tuple[LinearSystem, ...]:
    degrees = [p.degrees() for p in conditions]
    where = {
        i: {k for k, d in enumerate(degrees) if d[i]}
        for i in ring.symbol_indices()
        if max(d[i] for d in degrees) == 1
    }
    found: list[LinearSystem] = []
    for size in range(2, min(len(conditions), LARGEST) + 1):
        for own in combinations(range(len(conditions)), size):
            inside = [i for i, places in where.items() if places <= {*own}]
            for chosen in combinations(inside, size):
                if set().union(*(where[i] for i in chosen)) == {*own} and all(
                    sum(int(exponents[i]) for i in chosen) <= 1
                    for k in own
                    for exponents in conditions[k].monoms()
                ):
                    whole = _determinant(ring, [conditions[k] for k in own], chosen)
                    if whole != 0:
                        found.append(LinearSystem(own, chosen, whole))
        if found:
            break
    return tuple(sorted(found, key=lambda own: (len(own.determinant), own.symbols)))


def largest_system(
    ring: TrigonometricRing, conditions: Sequence[Polynomial], symbols: Sequence[int]
) -> LinearSystem | None:
    """As many short conditions as possible that determine as many of some symbols.

    At least two.  Other conditions may contain the symbols too; of several systems the
    one with the shortest determinant is taken.
    """
    places = [k for k, p in enumerate(conditions) if len(p) <= SHORT]
    for size in range(min(len(places), len(symbols), LARGEST), 1, -1):
        found = [
            LinearSystem(own, chosen, whole)
            for own in combinations(places, size)
            for chosen in combinations(symbols, size)
            if all(_is_linear(conditions[k], chosen) for k in own)
            for whole in [_determinant(ring, [conditions[k] for k in own], chosen)]
            if whole != 0
        ]
        if found:
            return min(found, key=lambda own: (len(own.determinant), own.symbols))
    return None


def solutions_of(
    ring: TrigonometricRing, conditions: Sequence[Polynomial], system: LinearSystem
) -> list[Polynomial]:
    """The symbols of a system by Cramer's rule, each times its determinant."""
    own = [conditions[k] for k in system.conditions]
    zero = {ring.names[symbol]: 0 for symbol in system.symbols}
    right = [-p.subs(zero) for p in own]
    columns = [[linear_parts(ring, p, s)[0] for p in own] for s in system.symbols]
    whole = (1 << len(own)) - 1
    return [
        minors_of(ring, [*columns[:k], right, *columns[k + 1 :]]).get(whole, ring.zero)
        for k in range(len(columns))
    ]


def _is_linear(condition: Polynomial, symbols: Sequence[int]) -> bool:
    """In some symbols together."""
    degrees = condition.degrees()
    if max(degrees[i] for i in symbols) != 1:
        return False
    return all(sum(int(e[i]) for i in symbols) <= 1 for e in condition.monoms())


def has_solutions(
    conditions: Sequence[Polynomial], system: LinearSystem, nonzero: Collection[int]
) -> bool:
    """Whether a system has solutions where its determinant does not vanish.

    A homogeneous one has 0 alone, which symbols that are not 0 exclude.

    Args:
        conditions: Of which the system speaks.
        system: Some of them.
        nonzero: Indices of generators that are not 0.
    """
    return not {*system.symbols} & {*nonzero} or any(
        not any(exponents[i] for i in system.symbols)
        for k in system.conditions
        for exponents in conditions[k].monoms()
    )


def solved_at(
    conditions: Sequence[Polynomial], system: LinearSystem, point: Point, prime: int
) -> Point | None:
    """The point with values of the symbols that meet the conditions of a system.

    None where its determinant vanishes.
    """
    moved = list(point)
    for symbol in system.symbols:
        moved[symbol] = 0
    entries, right = [], []
    for k in system.conditions:
        constant = residue(conditions[k], moved, prime)
        right.append(-constant)
        for symbol in system.symbols:
            moved[symbol] = 1
            entries.append(residue(conditions[k], moved, prime) - constant)
            moved[symbol] = 0
    size = len(system.symbols)
    matrix = nmod_mat(size, size, entries, prime)
    if matrix.det() == 0:
        return None
    found = matrix.solve(nmod_mat(size, 1, right, prime))
    for number, symbol in enumerate(system.symbols):
        moved[symbol] = int(found[number, 0])
    return moved


def _determinant(
    ring: TrigonometricRing, conditions: Sequence[Polynomial], symbols: Sequence[int]
) -> Polynomial:
    columns = [
        [linear_parts(ring, condition, symbol)[0] for condition in conditions]
        for symbol in symbols
    ]
    whole = (1 << len(columns)) - 1
    return minors_of(ring, columns).get(whole, ring.zero)
