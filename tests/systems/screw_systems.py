"""Systems of screws by their definitions, and displacements to try them with."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
from hypothesis import strategies as st

from screwkit.algebra.constants import ConstantField
from screwkit.algebra.modular import ModularRing, prime_for
from screwkit.algebra.reconstruction import Reconstruction

Row: TypeAlias = tuple[Fraction, ...]
Rows: TypeAlias = list[Row]
Array: TypeAlias = npt.NDArray[np.float64]

PRIMES = tuple(prime_for(12, [Fraction(2), Fraction(3)], seed) for seed in (1, 2))
KNOWN = Reconstruction.between(
    *(ModularRing(0, prime, ConstantField.needed_by([], 12)) for prime in PRIMES)
)

X, Y, Z = (1, 0, 0), (0, 1, 0), (0, 0, 1)
ORIGIN = 0, 0, 0


def screw(
    direction: Sequence[int],
    point: Sequence[int] = ORIGIN,
    pitch: Fraction | int = 0,
) -> Row:
    """A screw by its axis and pitch, from the definition of a moment."""
    moment = np.cross(np.array(point, object), np.array(direction, object))
    moment = moment + pitch * np.array(direction, object)
    return tuple(Fraction(x) for x in (*direction, *moment))


def free(direction: Sequence[int]) -> Row:
    """A pure moment."""
    return tuple(Fraction(x) for x in (0, 0, 0, *direction))


def modulo(rows: Sequence[Row], prime: int) -> list[list[int]]:
    """The rows as residues."""
    return [[x.numerator * pow(x.denominator, -1, prime) for x in r] for r in rows]


def both(rows: Sequence[Row]) -> list[tuple[list[list[int]], int]]:
    """The rows modulo both primes."""
    return [(modulo(rows, prime), prime) for prime in PRIMES]


def floats(rows: Sequence[Row]) -> Array:
    """The rows in floating point."""
    return np.array(rows, dtype=float).reshape(-1, 6)


@st.composite
def displacements(draw: st.DrawFn) -> npt.NDArray[np.object_]:
    """A random rational displacement, as the matrix that moves screws."""
    a, b, c, d = draw(
        st.tuples(*[st.integers(-4, 4)] * 4).filter(lambda q: any(x for x in q))
    )
    shift = draw(st.tuples(*[st.integers(-5, 5)] * 3))
    size = a * a + b * b + c * c + d * d
    turn = np.array(
        [
            [a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)],
            [2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)],
            [2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d],
        ],
        dtype=object,
    ) * Fraction(1, size)
    x, y, z = shift
    across = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]], dtype=object)
    zero = np.zeros((3, 3), dtype=object)
    return np.block([[turn, zero], [across @ turn, turn]])


def moved(matrix: npt.NDArray[np.object_], rows: Sequence[Row]) -> Rows:
    """The screws after a displacement."""
    return [tuple(Fraction(x) for x in matrix @ np.array(row, object)) for row in rows]


@st.composite
def mixed(draw: st.DrawFn, rows: Sequence[Row]) -> Rows:
    """Another spanning set of the same system: a product of elementary steps."""
    found = [list(row) for row in rows]
    if len(found) > 1:
        places = st.integers(0, len(found) - 1)
        for _ in range(draw(st.integers(2, 6))):
            i, j, factor = draw(places), draw(places), draw(st.integers(-3, 3))
            if i != j:
                found[i] = [
                    x + factor * y for x, y in zip(found[i], found[j], strict=True)
                ]
    for row in found:
        factor = draw(st.sampled_from([-3, -1, 1, 2, 5]))
        row[:] = [factor * x for x in row]
    if draw(st.booleans()) and found:
        found.append([x + 2 * y for x, y in zip(found[0], found[-1], strict=True)])
    return [tuple(row) for row in found]


SUBGROUPS: Mapping[str, Rows] = {
    "no motion": [],
    "rotation": [screw(Z, (1, 2, 0))],
    "helical motion": [screw(Z, (1, 2, 0), Fraction(1, 3))],
    "translation": [free(X)],
    "cylindrical motion": [screw(Z, (1, 2, 0)), free(Z)],
    "planar translation": [free(X), free(Y)],
    "spatial translation": [free(X), free(Y), free(Z)],
    "planar motion": [screw(Z, (4, 5, 6)), screw(Z, (1, 5, 0)), free(X)],
    "planar translation with a helical motion": [
        screw(Z, (0, 1, 0), 2),
        screw(Z, (0, 0, 1), 2),
        screw(Z, (3, 0, 1), 2),
    ],
    "spherical motion": [screw(axis, (1, 2, 3)) for axis in (X, Y, (1, 1, 1))],
    "Schönflies motion": [screw(Z, (1, 2, 0), 5), free(X), free(Y), free(Z)],
    "spatial motion": [*map(screw, (X, Y, Z)), free(X), free(Y), free(Z)],
}
"""The connected displacement groups, spanned by what they are defined by."""

OTHERS: Mapping[str, Rows] = {
    "rotations about parallel lines of a plane": [screw(Z), screw(Z, (3, 1, 0))],
    "helical motions about parallel lines of a plane": [
        screw(Z, ORIGIN, 2),
        screw(Z, X, 2),
    ],
    "rotation and oblique translation": [screw(Z, X), free((1, 0, 2))],
    "planar translation and rotations about parallel lines of a plane": [
        screw(Z, X),
        free(Y),
        free((1, 1, 1)),
    ],
    "flat pencil of rotations": [screw(X, (1, 2, 3)), screw((1, 1, 0), (1, 2, 3))],
    "flat pencil of helical motions": [screw(X, X, 3), screw((1, 2, 0), X, 3)],
    "cylindroid": [screw(X), screw((1, 1, 0), (0, 0, 2))],
    "planar field of rotations": [
        screw(X, (0, 0, 3)),
        screw(X, (0, 1, 3)),
        screw((1, 2, 0), (7, 8, 3)),
    ],
    "planar field of helical motions": [
        screw(X, (0, 0, 3), 4),
        screw(X, (0, 1, 3), 4),
        screw((1, 2, 0), (7, 8, 3), 4),
    ],
    "cylindroid and the translation along its axis": [
        screw(X),
        screw((1, 1, 0), (0, 0, 2)),
        free(Z),
    ],
    "flat pencil of rotations and a translation": [
        screw(X, (1, 2, 3)),
        screw(Y, (1, 2, 3)),
        free((1, 0, 2)),
    ],
    "cylindroid and a translation": [screw(X), screw(Y, Z, 3), free((1, 0, 2))],
    "helical motions about all lines through a point": [
        screw(axis, (1, 2, 3), 2) for axis in (X, Y, (1, 1, 1))
    ],
    "flat pencil of rotations and a helical motion across it": [
        screw(X, Y),
        screw((1, 0, 1), Y),
        screw(Y, Y, 2),
    ],
    "three-system of revolution": [
        screw(X, ORIGIN, 1),
        screw(Y, ORIGIN, 1),
        screw(Z, ORIGIN, 4),
    ],
    "general three-system": [screw(X), screw(Y, Z), screw(Z, (1, 1, 0), 2)],
    "rotations about the lines across an axis": [
        screw(X),
        screw(Y),
        screw(X, (0, 0, 1)),
        screw(Y, (0, 0, 1)),
    ],
    "rotations about lines of a plane's directions that meet an axis": [
        screw(X),
        screw(Y),
        screw(X, (1, 0, 1)),
        screw(Y, (1, 0, 1)),
    ],
    "planar field of rotations and a translation": [
        screw(X),
        screw(Y),
        free(Z),
        free(X),
    ],
    "rotations and helical motions of a plane's directions": [
        screw(X, ORIGIN, 1),
        screw(Y),
        free(Z),
        free(Y),
    ],
    "spherical motion and a translation": [*map(screw, (X, Y, Z)), free((1, 2, 3))],
    "four-system of equal pitches": [
        screw(X, ORIGIN, 1),
        screw(Y, ORIGIN, 1),
        screw(Z),
        free(Z),
    ],
    "general four-system": [screw(X, ORIGIN, 1), screw(Y, Z, 2), screw(Z), free(Z)],
    "special linear complex of rotations": [
        *map(screw, (X, Y, Z)),
        free(X),
        free(Y),
    ],
    "linear complex": [screw(X), screw(Y), screw(Z, ORIGIN, 2), free(X), free(Y)],
    "all translations and a plane of rotation directions": [
        screw(X),
        screw(Y),
        *map(free, (X, Y, Z)),
    ],
}
"""A system of every other kind, by its name."""

ALL: Mapping[str, Rows] = {**SUBGROUPS, **OTHERS}
