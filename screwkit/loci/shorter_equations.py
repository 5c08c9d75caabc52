"""Equations of a piece, each less a multiple of another where that shortens it.

Conditions are solved one after the other, each where the coefficient of a symbol is
not zero, and written down as they stood.  u² − v² = 1 and h·(u² + v² − 1) + 4·v = 0
hold where v = 0 too; h times the first taken from the second leaves 2·v·(h·v + 2), and
of its factors that one is kept which vanishes on the piece.

References: [CoxLittleOShea] §2.3 (division), §4.4 (quotients of ideals).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final

from screwkit.algebra.branches import Branch
from screwkit.algebra.cases import possible_factors
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.points import residue
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.loci.pieces import Piece

TERMS: Final = 40
"""Of equations that are subtracted from each other."""


def with_shorter_equations(piece: Piece, root: Branch, library: FactorLibrary) -> Piece:
    """The piece with equations that hold on fewer sets besides, where some are found.

    The new ones hold on the piece, and where they all hold the old ones do.

    Args:
        piece: With exact points on each sheet; else it stays as it is.
        root: The whole configuration space.
        library: Factors met before.
    """
    if not all(branch.points for branch in piece.branches):
        return piece
    shorter = _one_shorter(piece, root, library)
    while shorter is not None:
        piece = replace(piece, equations=shorter)
        shorter = _one_shorter(piece, root, library)
    return piece


def _one_shorter(
    piece: Piece, root: Branch, library: FactorLibrary
) -> tuple[Polynomial, ...] | None:
    """The equations, the longest that can be shortened being shortened."""
    equations = piece.equations
    order = sorted(range(len(equations)), key=lambda k: -len(equations[k]))
    for place in order:
        others = [e for k, e in enumerate(equations) if k != place]
        best = equations[place]
        for remainder in remainders(root, best, others):
            factor = _on_piece(remainder, piece, root, library)
            if factor is not None and len(factor) < len(best):
                best = factor
        if best is not equations[place]:
            kept = list(equations)
            kept[place] = best
            return tuple(kept)
    return None


def remainders(
    root: Branch, equation: Polynomial, others: Sequence[Polynomial]
) -> Iterator[Polynomial]:
    """An equation less each single-term multiple of another that takes a term away.

    None is longer than the equation was.
    """
    yield from map(primitive, differences(root, equation, others))


def differences(
    root: Branch, equation: Polynomial, others: Sequence[Polynomial]
) -> Iterator[Polynomial]:
    """`remainders` as they are, not freed from numbers."""
    if len(equation) > TERMS:
        return
    for other in others:
        if len(other) > TERMS:
            continue
        seen: set[str] = set()
        for quotient in _quotients(equation, other):
            key = str(quotient)
            if key in seen:
                continue
            seen.add(key)
            left = root.ring.normal(equation - quotient * other)
            if left != 0 and len(left) <= len(equation):
                yield left


def _quotients(one: Polynomial, two: Polynomial) -> Iterator[Polynomial]:
    """Terms of one polynomial divided by terms of another, where that is possible."""
    context = one.context()
    for above, number in one.to_dict().items():
        for below, divisor in two.to_dict().items():
            powers = [int(a) - int(b) for a, b in zip(above, below, strict=True)]
            if min(powers) >= 0:
                yield context.from_dict({tuple(powers): number / divisor})


def _on_piece(
    equation: Polynomial, piece: Piece, root: Branch, library: FactorLibrary
) -> Polynomial | None:
    """The shortest factor that vanishes on the piece; the others say nothing of it."""
    return min(vanishing_on(piece, equation, root, library), key=len, default=None)


def vanishing_on(
    piece: Piece, equation: Polynomial, root: Branch, library: FactorLibrary
) -> list[Polynomial]:
    """Factors of one equation that vanish at all exact points of a piece.

    Args:
        piece: With exact points.
        equation: Not zero.
        root: The whole configuration space.
        library: Factors met before.
    """
    places = [at for branch in piece.branches for at in branch.points]
    return [
        case.equations[0]
        for case in possible_factors(root, equation, library)
        if len(case.equations) == 1
        and not any(residue(case.equations[0], *at) for at in places)
    ]
