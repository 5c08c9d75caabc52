"""Exact generic linear algebra on screws: choosing a basis, null spaces, reciprocals.

Ranks are taken at a random exact point, where they are the generic ones; the vectors
themselves come from signed minors, so that nothing is divided but common factors.  What
a result assumes not to vanish is the minor it was built around.

References: [CoxLittleOShea] for the point test, [LongCaroKhalil2012] (26), (31).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import reduce
from math import gcd, lcm
from typing import TypeAlias
from weakref import WeakKeyDictionary

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.minors import Bits, determinant, minors_of
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, content
from screwkit.conventions import DIRECTION, MOMENT, SCREW_DIMENSION
from screwkit.screw import vector
from screwkit.screw.displacement import Displacement

Column: TypeAlias = tuple[Polynomial, ...]


@dataclass(frozen=True)
class Basis:
    """Columns that span a space wherever the pivot does not vanish.

    Attributes:
        pivot: None where the columns span it everywhere.
    """

    columns: tuple[Column, ...]
    pivot: Polynomial | None


_SAMPLES: WeakKeyDictionary[TrigonometricRing, tuple[Point, int]] = WeakKeyDictionary()


def sample(ring: TrigonometricRing) -> tuple[Point, int]:
    """A random exact point of the ring and its prime, always the same one."""
    if ring not in _SAMPLES:
        point, prime = Branch(ring, Assumptions()).points[0]
        _SAMPLES[ring] = point, prime
    return _SAMPLES[ring]


def residues(ring: TrigonometricRing, column: Sequence[Polynomial]) -> list[int]:
    """A column at the sample point."""
    point, prime = sample(ring)
    return [residue(value, point, prime) for value in column]


def generic_rank(ring: TrigonometricRing, columns: Sequence[Column]) -> int:
    """Rank of the columns at a random exact point."""
    return len(independent(ring, columns))


def independent(ring: TrigonometricRing, columns: Sequence[Column]) -> tuple[int, ...]:
    """Numbers of the first columns that are generically independent."""
    _, prime = sample(ring)
    rows = [residues(ring, column) for column in columns]
    chosen: list[int] = []
    for number in range(len(rows)):
        trial = [rows[i] for i in (*chosen, number)]
        if len(trial) <= SCREW_DIMENSION and rank(trial, prime) == len(trial):
            chosen.append(number)
    return tuple(chosen)


def basis_of(ring: TrigonometricRing, columns: Sequence[Column]) -> Basis:
    """A generically independent part of the columns, and what must not vanish for it.

    A part that spans the same space at one point spans it wherever its own rank does
    not drop: a rank never exceeds the generic one.
    """
    chosen = independent(ring, columns)
    picked = tuple(columns[i] for i in chosen)
    if len(picked) == len(columns):
        return Basis(picked, None)
    return Basis(picked, _pivot(ring, picked) if picked else None)


def _pivot(ring: TrigonometricRing, columns: Sequence[Column]) -> Polynomial:
    """A maximal minor that is not zero, of rows with short entries."""
    _, prime = sample(ring)
    numbers = [residues(ring, column) for column in columns]
    order = sorted(
        range(SCREW_DIMENSION), key=lambda i: sum(len(c[i]) for c in columns)
    )
    rows: list[int] = []
    for row in order:
        trial = [*rows, row]
        part = [[column[i] for i in trial] for column in numbers]
        if rank(part, prime) == len(trial):
            rows = trial
        if len(rows) == len(columns):
            break
    rows.sort()
    return determinant(ring, [[column[i] for i in rows] for column in columns])


def annihilator(
    ring: TrigonometricRing, columns: Sequence[Column], largest: int | None = None
) -> Basis:
    """Linear forms that vanish on generically independent columns.

    Args:
        ring: Of the polynomials.
        columns: At most six, independent at the sample point.
        largest: See `minors_of`.

    Returns:
        Six minus as many columns; the pivot is a maximal minor of ``columns``.

    Raises:
        TooLargeError: If the minors need more products of terms than ``largest``.
    """
    minors = minors_of(ring, columns, largest)
    chosen = min(minors, key=lambda rows: (len(minors[rows]), rows))
    forms = tuple(
        _null_form(ring, minors, chosen | 1 << row)
        for row in range(SCREW_DIMENSION)
        if not chosen >> row & 1
    )
    return Basis(forms, minors[chosen] if columns else None)


def _null_form(
    ring: TrigonometricRing, minors: dict[Bits, Polynomial], support: Bits
) -> Column:
    """Cramer's rule on the rows ``support``: one more of them than columns."""
    form: list[Polynomial] = [ring.zero] * SCREW_DIMENSION
    sign = 1
    for row in range(SCREW_DIMENSION):
        if support >> row & 1:
            value: Polynomial = minors.get(support ^ 1 << row, ring.zero)
            form[row] = value if sign > 0 else -value
            sign = -sign
    return shortened(ring, form)


def reciprocal_basis(
    ring: TrigonometricRing, columns: Sequence[Column], largest: int | None = None
) -> Basis:
    """The screws reciprocal to these columns, again (direction, moment).

    Args:
        ring: Of the polynomials.
        columns: Any number of screws; dependent ones are left out.
        largest: See `minors_of`.

    Raises:
        TooLargeError: If the minors need more products of terms than ``largest``.
    """
    chosen = [columns[i] for i in independent(ring, columns)]
    forms = annihilator(ring, chosen, largest)
    swapped = tuple((*form[MOMENT], *form[DIRECTION]) for form in forms.columns)
    return Basis(swapped, forms.pivot)


def reciprocal_product(
    ring: TrigonometricRing, left: Sequence[Polynomial], right: Sequence[Polynomial]
) -> Polynomial:
    """f·v + m·ω in normal form."""
    return ring.normal(
        vector.dot(left[DIRECTION], right[MOMENT])
        + vector.dot(left[MOMENT], right[DIRECTION])
    )


def has_pitch(ring: TrigonometricRing, column: Sequence[Polynomial]) -> bool:
    """Whether a screw is neither a line nor free: direction · moment is not zero.

    A value that is not zero at the sample proves it; only zeros are multiplied out.
    """
    point, prime = sample(ring)
    numbers = [residue(value, point, prime) for value in column]
    if vector.dot(numbers[DIRECTION], numbers[MOMENT]) % prime:
        return True
    return bool(ring.normal(vector.dot(column[DIRECTION], column[MOMENT])) != 0)


def moved(
    ring: TrigonometricRing,
    target_from_source: Displacement[Polynomial],
    screw: Sequence[Polynomial],
) -> Column:
    """A screw in the axes and about the origin of another frame."""
    rotation = target_from_source.rotation
    direction = vector.normal(ring, vector.rotate(rotation, screw[DIRECTION]))
    turned = vector.rotate(rotation, screw[MOMENT])
    carried = vector.cross(target_from_source.translation, direction)
    return (*direction, *vector.normal(ring, vector.add(turned, carried)))


def _common_factor(values: Sequence[Polynomial]) -> Polynomial:
    """The greatest common divisor; of the shortest first, and no more once it is 1."""
    common = values[0]
    for value in values[1:]:
        if common.is_constant():
            break
        common = common.gcd(value)
    return common


def shortened(ring: TrigonometricRing, column: Sequence[Polynomial]) -> Column:
    """The column without common factors, with coprime integers, first entry positive.

    The first entry that is not zero gets a positive first coefficient.
    """
    values = [value for value in column if value != 0]
    if not values:
        return tuple(column)
    common = _common_factor(sorted(values, key=len))
    divided = [ring.normal(value / common) for value in column]
    contents = [content(value) for value in divided if value != 0]
    above = reduce(gcd, (int(c.p) for c in contents))
    below = reduce(lcm, (int(c.q) for c in contents))
    sign = 1
    for value in divided:
        if value != 0:
            sign = -1 if value.coeffs()[0] < 0 else 1
            break
    scale = ring.rational(Fraction(sign * below, above))
    return tuple(value * scale for value in divided)
