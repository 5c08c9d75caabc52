"""Whether polynomials that vanish on a piece vanish nowhere else."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import islice
from typing import Final

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.cases import MOST_TERMS, possible_factors
from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.division import Divisor
from screwkit.algebra.factors import Factor, FactorLibrary
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.nowhere_zero import without_nowhere_zero
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.loci.pieces import Piece, lies_in

LARGEST = 1_500
"""Terms of a polynomial that is factored for this."""

_SQUARED = 40  # terms of polynomials whose squares are added up
_FACTORED = 8  # polynomials that are looked at one by one
_BUDGET = 40  # case distinctions
_PROVISO = 2  # terms
_BRACKETS: Final = re.compile(r"\([^()]*\)")
_ROOT: Final = re.compile(r"sqrt\((\d+)\)")
_SIGNS: Final = re.compile(r" [+-] ")


def zeros_beside(
    piece: Piece, scalars: Sequence[Polynomial], root: Branch, library: FactorLibrary
) -> list[Polynomial] | None:
    """Conditions on which all of these vanish too, although they are not the piece.

    Args:
        piece: Where they all vanish.
        scalars: In normal form.
        root: The space in which the piece lies.
        library: Factors met before, of the same ring.

    Returns:
        An empty list where the piece is all; None where that is not known, or what is
        beside it takes more than one equation.
    """
    once = {str(v): v for v in map(primitive, filter(bool, scalars))}
    values = sorted(once.values(), key=len)
    if not values or len(values[0]) > MOST_TERMS:
        return None
    if len(piece.equations) == 1 and len(values) == 1 and len(values[0]) > LARGEST:
        return _beside_divided(values[0], piece.equations[0], root, library)
    if len(values[0]) > LARGEST:
        return None
    if piece.codimension == 1 and len(piece.equations) > 1:
        if len(values) > 1:
            return None
        return _beside_half_angles(values[0], piece, root, library)
    if len(piece.equations) == 1:
        key = condition_key(root.ring, piece.equations[0])
        for value in islice(values, _FACTORED):
            beside = _beside(value, key, root, library)
            if beside == [] or (beside is not None and len(values) == 1):
                return beside
        if len(values) == 1:
            return None
        # Real numbers are all zero exactly where the sum of their squares is.
        if sum(map(len, values)) <= _SQUARED:
            ring = root.ring
            square = ring.normal(sum((v * v for v in values), ring.zero))
            if square != 0 and _beside(square, key, root, library) == []:
                return []
    if any(len(value) > LARGEST for value in values):
        return None
    zeros = common_zeros(root, values, Search(library, budget=_BUDGET))
    if not zeros.complete or not zeros.branches:
        return None
    inside = all(b.points and lies_in(b, piece) for b in zeros.branches)
    return [] if inside else None


def _beside(
    value: Polynomial, key: str, root: Branch, library: FactorLibrary
) -> list[Polynomial] | None:
    """The other factors; None where the piece's own is none of them."""
    if len(value) > LARGEST:
        return None
    factors = possible_factors(root, value, library)
    others = without_condition(root.ring, factors, key)
    if len(others) == len(factors):
        return None
    return [e for e in others if not is_special(root, e)]


def _beside_half_angles(
    value: Polynomial, piece: Piece, root: Branch, library: FactorLibrary
) -> list[Polynomial] | None:
    """The other factors, where half angles alone show that of the piece."""
    ring = root.ring
    own = _keys(ring, piece.equations)
    factors = possible_factors(root, value, library)
    others = [f.equations for f in factors if _keys(ring, f.equations) != own]
    if len(others) == len(factors):
        return None
    beside = [one_of(ring, equations) for equations in others]
    return [e for e in beside if not is_special(root, e)]


def _keys(ring: TrigonometricRing, equations: Sequence[Polynomial]) -> set[str]:
    turned = _turned(ring, equations)
    written = equations if turned is None else [turned]
    return {condition_key(ring, equation) for equation in written}


def without_condition(
    ring: TrigonometricRing, factors: Sequence[Factor], key: str
) -> list[Polynomial]:
    """One equation for each of the factors but the one with this `condition_key`."""
    equations = [one_of(ring, f.equations) for f in factors]
    return [e for e in equations if condition_key(ring, e) != key]


def one_of(ring: TrigonometricRing, equations: Sequence[Polynomial]) -> Polynomial:
    """One equation with the real zeros of all; of long ones the first."""
    turned = _turned(ring, equations)
    if turned is not None:
        return turned
    if len(equations) == 1 or sum(map(len, equations)) > _SQUARED:
        return equations[0]
    return primitive(ring.normal(sum((e * e for e in equations), ring.zero)))


def _turned(
    ring: TrigonometricRing, equations: Sequence[Polynomial]
) -> Polynomial | None:
    """Of sin φ and cos φ ± 1 the second, which has the zeros of both."""
    turns = {str(c + sign) for c in ring.cosines for sign in (1, -1)}
    return next((e for e in equations if str(primitive(e)) in turns), None)


def _beside_divided(
    value: Polynomial, own: Polynomial, root: Branch, library: FactorLibrary
) -> list[Polynomial] | None:
    """The same of a long polynomial: the factors of what is left of it without its own.

    None where it is no multiple of the piece's own equation.
    """
    layout = Layout.of(root.ring)
    divisor = Divisor(own, root.ring, HalfAngles(root.ring, layout), layout)
    rest = divisor.divide(value)
    if rest is None:
        return None
    rest = root.ring.normal(rest)
    (rest,) = without_nowhere_zero(root.ring, [rest], nowhere_zero(root))
    if rest.is_constant():
        return []
    if len(rest) > LARGEST:
        return None
    key = str(primitive(own))
    others = [f for f in possible_factors(root, rest, library) if f.key != key]
    found = [one_of(root.ring, f.equations) for f in others]
    return [e for e in found if not is_special(root, e)]


def nowhere_zero(root: Branch) -> list[Polynomial]:
    """What has no zero in the whole space: divisors of its coordinates among them."""
    return [*root.ring.divisors_of.values(), *root.divisors]


def is_special(root: Branch, equation: Polynomial) -> bool:
    """Whether an equation ties the dimensions alone: a special mechanism."""
    return any(branch.is_special for branch in restricted(root, equation))


def proviso(ring: TrigonometricRing, beside: Sequence[Polynomial]) -> str | None:
    """``given z ≠ 0``; None where that is long, as it is written."""
    texts = [equation_text(ring, equation) for equation in beside]
    if not texts or any(_terms(one) > _PROVISO for one in texts):
        return None
    *others, last = (_ROOT.sub(r"√\1", one) + " ≠ 0" for one in texts)
    return "given " + " and ".join(filter(None, [", ".join(others), last]))


def _terms(written: str) -> int:
    """Terms of a sum, those in brackets not counted: 2 of ``cos(a + b) - 1``."""
    while written != (shorter := _BRACKETS.sub("", written)):
        written = shorter
    return 1 + len(_SIGNS.findall(written))
