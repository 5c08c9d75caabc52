"""Equations of a piece, each reduced by the others: what is left to be said.

sin θ = 0 and (a − b − x)·sin θ + y·cos θ = 0 say sin θ = 0 and y = 0.  The zeros of
some equations are taken apart; what another one becomes on every part, up to factors
that vanish nowhere, takes its place where that is simpler, and it goes where nothing is
left of it.  Both sets of equations have the same zeros.

References: [CoxLittleOShea] §2.6 (remainders), §4.6 (decomposition).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Final

from screwkit.algebra.branches import Branch
from screwkit.algebra.cases import possible_factors
from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.elimination import half_angle_solutions
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.loci.pieces import Piece
from screwkit.loci.shorter_equations import remainders, vanishing_on

TERMS: Final = 60
"""Of an equation that is looked at."""

_TOGETHER = 40  # terms of the equations whose zeros are taken apart

_BUDGET = 12  # case distinctions for the zeros of the other equations
_PARTS = 8  # of these zeros
_LARGER = 10  # times the coefficients may grow
_TRIED = 12  # multiples of other equations that are subtracted


def reduced(piece: Piece, root: Branch, library: FactorLibrary) -> Piece:
    """The piece with simpler equations that have the same zeros.

    Args:
        piece: Its equations vanish there and nowhere else.
        root: The whole configuration space.
        library: Factors met before.
    """
    if len(piece.equations) < 2 or max(map(len, piece.equations)) > TERMS:
        return piece
    simpler = _once(piece, root, library)
    while simpler is not None:
        piece = replace(piece, equations=simpler)
        simpler = _once(piece, root, library)
    return piece


def _once(
    piece: Piece, root: Branch, library: FactorLibrary
) -> tuple[Polynomial, ...] | None:
    """The equations, the longest that can be made simpler being so."""
    equations = piece.equations
    order = sorted(range(len(equations)), key=lambda k: _size(equations[k]))
    for place in reversed(order):
        others = [equations[k] for k in order if k != place]
        left = _left_of(equations[place], others, piece, root, library)
        if left is not None:
            return (*equations[:place], *left, *equations[place + 1 :])
    for one, two in combinations(range(len(equations)), 2):
        angle = _one_angle(root, equations[one], equations[two])
        if angle is not None:
            between = equations[one + 1 : two], equations[two + 1 :]
            return (*equations[:one], angle, *between[0], *between[1])
    return None


def _left_of(
    equation: Polynomial,
    others: Sequence[Polynomial],
    piece: Piece,
    root: Branch,
    library: FactorLibrary,
) -> tuple[Polynomial, ...] | None:
    """What an equation says beside others, if that is simpler; empty for nothing."""
    if _is_multiple(equation, others, root, library):
        return ()
    for known in _choices(others):
        if sum(map(len, known)) > _TOGETHER:
            continue
        zeros = common_zeros(root, known, Search(library, budget=_BUDGET))
        parts = zeros.branches
        if not zeros.complete or not 0 < len(parts) <= _PARTS:
            continue
        values = [part.value(equation) for part in parts]
        if all(value == 0 for value in values):
            return ()
        if any(part.pending for part in parts) or any(value == 0 for value in values):
            continue
        # On each part the others say something else too.
        said = [
            _sayings(value, [part.value(e) for e in others], piece, root, library)
            for value, part in zip(values, parts, strict=True)
        ]
        for text, simple in said[0].items():
            if all(text in one for one in said) and _is_simpler(simple, equation, root):
                return (simple,)
    plain = _sayings(equation, others, piece, root, library)
    found = (one for one in plain.values() if _is_simpler(one, equation, root))
    simplest = min(found, key=_size, default=None)
    return None if simplest is None else (simplest,)


def _is_multiple(
    equation: Polynomial,
    others: Sequence[Polynomial],
    root: Branch,
    library: FactorLibrary,
) -> bool:
    """Whether one of the others is a factor, so that nothing is said beside it."""
    known = {condition_key(root.ring, other) for other in others}
    return any(
        condition_key(root.ring, case.equations[0]) in known
        for case in possible_factors(root, equation, library)
        if len(case.equations) == 1
    )


def _sayings(
    value: Polynomial,
    others: Sequence[Polynomial],
    piece: Piece,
    root: Branch,
    library: FactorLibrary,
) -> dict[str, Polynomial]:
    """An equation, and it less multiples of others, by their texts; shortest first."""
    left = [value, *remainders(root, value, [e for e in others if e != 0])]
    said = [_said(one, piece, root, library) for one in left[:_TRIED]]
    return {str(one): one for one in sorted(said, key=_size)}


def _choices(others: Sequence[Polynomial]) -> Iterator[Sequence[Polynomial]]:
    """Each of them, then all."""
    for one in others:
        yield [one]
    if len(others) > 1:
        yield others


def _said(
    value: Polynomial, piece: Piece, root: Branch, library: FactorLibrary
) -> Polynomial:
    """The factor that is zero on the piece, or the whole; the others say nothing."""
    cases = possible_factors(root, value, library)
    single = [case.equations[0] for case in cases if len(case.equations) == 1]
    if len(single) == len(cases) == 1:
        return single[0]
    told = all(branch.points and len(branch.pending) < 2 for branch in piece.branches)
    zero = vanishing_on(piece, value, root, library) if told else []
    return min(zero, key=_size) if zero else primitive(value)


def _one_angle(root: Branch, one: Polynomial, two: Polynomial) -> Polynomial | None:
    """D·cos(φ − φ₀) = D for two equations that say φ = φ₀ together."""
    for step in half_angle_solutions(root.ring, one, (two,)):
        if not root.assumptions.is_nonzero(root.ring, step.divisor):
            continue
        gens = root.ring.context.gens()
        along = sum((gens[i] * image for i, image in step.images), -step.divisor)
        whole = primitive(root.ring.normal(along))
        if _length(root, whole) < _length(root, one) + _length(root, two):
            return whole
    return None


def _is_simpler(one: Polynomial, two: Polynomial, root: Branch) -> bool:
    """Whether an equation is shorter, with no new unknown and no long numbers."""
    fresh = set(unknowns(root.ring, one)) - set(unknowns(root.ring, two))
    if fresh or _largest(one) > _LARGER * _largest(two):
        return False
    return _length(root, one) < _length(root, two)


def _largest(equation: Polynomial) -> int:
    """Of its coefficients, made coprime integers."""
    return max(abs(int(c.p)) for c in primitive(equation).coeffs())


def _length(root: Branch, equation: Polynomial) -> int:
    """Of the equation as it is read."""
    return len(equation_text(root.ring, equation))


def _size(equation: Polynomial) -> tuple[int, int]:
    return len(equation), int(equation.total_degree())
