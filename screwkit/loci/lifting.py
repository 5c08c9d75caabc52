"""Sheets brought back together: one equation for what differs only by signs.

On cos(q6 − q1) = 0 the sine is ±1, and a later condition comes out once with each sign.
Putting the sine back where the sign stood gives one equation that is right on both
sheets; it is done only where every sheet is there, so that nothing is added.  Of
cos q1 + sin q1 = 0 the cosine is ±√2/2, and √2·cos q1 takes the place of the sign.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import combinations
from typing import Any

from screwkit.algebra.branches import Branch
from screwkit.algebra.constant_multiples import inverse, is_number, sign
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.loci.pieces import Piece, alike

_FACTORS = 3  # signs that may multiply one term
_Signs = dict[int, int]  # generator whose value is ±v on the sheet, and the sign


def with_sheets_together(
    pieces: Sequence[Piece], kind: Callable[[Branch], object]
) -> list[Piece]:
    """The same locus with fewer pieces, where signs are all that tells them apart.

    Args:
        pieces: Some of which may have sheets of two kinds; these are told apart.
        kind: Of a sheet; what is told of a piece goes by it.
    """
    shapes: dict[str, list[Piece]] = {}
    for piece in alike(pieces, kind):
        shapes.setdefault(_shape(piece), []).append(piece)
    found: list[Piece] = []
    for group in (group for beside in shapes.values() for group in _by(kind, beside)):
        merged = _together(group) if len(group) > 1 else None
        found.extend([merged] if merged is not None else group)
    return sorted(found, key=lambda piece: piece.codimension)


def _by(kind: Callable[[Branch], object], pieces: Sequence[Piece]) -> list[list[Piece]]:
    """Pieces of one kind together."""
    groups: list[tuple[object, list[Piece]]] = []
    for piece in pieces:
        own = kind(piece.branches[0]) if len(pieces) > 1 else None
        group = next((g for k, g in groups if k == own), None)
        if group is None:
            groups.append((own, [piece]))
        else:
            group.append(piece)
    return [group for _, group in groups]


def _shape(piece: Piece) -> str:
    """Conditions up to the signs of their terms."""
    branch = piece.branches[0]
    return str(sorted(str(sorted(c.monoms())) for c in branch.conditions))


def _together(group: Sequence[Piece]) -> Piece | None:
    ring = group[0].branches[0].ring
    branches = [branch for piece in group for branch in piece.branches]
    own = [_equations(ring, piece, b) for piece in group for b in piece.branches]
    if any(step.companions for branch in branches for step in branch.steps):
        return None
    signs = [_signs(ring, branch) for branch in branches]
    generators = set(signs[0])
    if not generators or any(set(s) != generators for s in signs):
        return None
    sizes = [_sizes(*own) for own in zip(branches, signs, strict=True)]
    if any(size != sizes[0] for size in sizes):
        return None
    present = {tuple(sorted(s.items())) for s in signs}
    if len(present) != 2 ** len(generators) or len(present) != len(branches):
        return None
    aligned = _aligned(own)
    if aligned is None:
        return None
    equations = []
    for versions in aligned:
        equation = _lifted(ring, versions, signs, sizes[0])
        if equation is None:
            return None
        equations.append(equation)
    return Piece(tuple(equations), tuple(branches))


def _signs(ring: TrigonometricRing, branch: Branch) -> _Signs:
    """Of a cosine, or a sine, that is a number because of each solved condition."""
    found: _Signs = {}
    for step in branch.steps:
        if step.sheet is None:
            continue
        numbers = [
            (index, image)
            for index, image in step.images
            if image != 0 and is_number(ring, image)
        ]
        if numbers:
            index, image = numbers[-1]
            found[index] = sign(ring, image)
    return found


def _sizes(branch: Branch, signs: _Signs) -> dict[int, Polynomial]:
    """The number of which a generator is plus or minus one on each sheet."""
    return {
        index: image * signs[index]
        for step in branch.steps
        for index, image in step.images
        if index in signs
    }


def _equations(
    ring: TrigonometricRing, piece: Piece, branch: Branch
) -> tuple[Polynomial, ...]:
    """Of a sheet, with the conditions of those angles that signs tell apart."""
    numbers = _signs(ring, branch)
    apart = {
        str(step.sheet)
        for step in branch.steps
        if step.sheet is not None and not any(i in numbers for i, _ in step.images)
    }
    return branch.equations(apart & piece.texts)


def _aligned(
    equations: Sequence[Sequence[Polynomial]],
) -> list[list[Polynomial]] | None:
    """The equations of all sheets, position by position of the first one."""
    columns: list[list[Polynomial]] = []
    left = [list(own) for own in equations]
    for condition in equations[0]:
        support = sorted(condition.monoms())
        versions = []
        for conditions in left:
            match = next((c for c in conditions if sorted(c.monoms()) == support), None)
            if match is None:
                return None
            conditions.remove(match)
            versions.append(match)
        columns.append(versions)
    return columns


def _lifted(
    ring: TrigonometricRing,
    versions: Sequence[Polynomial],
    signs: Sequence[_Signs],
    sizes: Mapping[int, Polynomial],
) -> Polynomial | None:
    """One polynomial that is each version, up to a constant, on its own sheet."""
    tables = [primitive(version).to_dict() for version in versions]
    if all(table == tables[0] for table in tables):
        return primitive(versions[0])
    monomials = list(tables[0])
    first = monomials[0]
    gens = ring.context.gens()
    total = ring.zero
    for monomial in monomials:
        ratios = [table[monomial] / table[first] for table in tables]
        chosen = _product_of_signs(ratios, signs)
        if chosen is None:
            return None
        term = ring.context.from_dict({monomial: ratios[0]})
        value = 1
        for index in chosen:
            term = term * gens[index] * inverse(ring, sizes[index])
            value *= signs[0][index]
        total = total + term * value
    return primitive(ring.normal(total))


def _product_of_signs(
    ratios: Sequence[Any], signs: Sequence[_Signs]
) -> tuple[int, ...] | None:
    """Generators whose product of values is each ratio, up to one constant."""
    generators = sorted(signs[0])
    for count in range(_FACTORS + 1):
        for chosen in combinations(generators, count):
            values = []
            for sheet in signs:
                value = 1
                for index in chosen:
                    value *= sheet[index]
                values.append(value)
            scaled = [r * v for r, v in zip(ratios, values, strict=True)]
            if all(entry == scaled[0] for entry in scaled):
                return chosen
    return None
