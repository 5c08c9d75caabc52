"""Principal screws as exact numbers, from a system known modulo two primes.

A principal pitch that lies in the field of the geometry's constants is a root of the
same polynomial modulo both primes: it is the pair of residues that one short number
explains.  Where a pitch does not lie there, the screws are computed in floating point
from the reconstructed system.

References: [Ball1900], [Hunt1978], ch. 12.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import hypot, inf
from typing import TypeAlias

from screwkit.algebra.algebraic_numbers import AlgebraicNumber
from screwkit.algebra.modular import annihilator
from screwkit.algebra.reconstruction import Reconstruction
from screwkit.conventions import DIRECTION
from screwkit.screw.vector import cross, dot
from screwkit.systems.principal_screws import (
    ExactScrew,
    Point,
    PrincipalScrew,
    principal_screws,
)
from screwkit.systems.screw_structure import (
    Residues,
    ScrewStructure,
    combination,
    echelon,
    foot,
    normal_part,
    pitch,
    product,
    solve,
)

Pair: TypeAlias = tuple[ScrewStructure, ScrewStructure]


def known_principal_screws(
    pair: Pair, known: Reconstruction
) -> tuple[PrincipalScrew, ...]:
    """Principal screws of a system given modulo the two primes of ``known``.

    Exact where all of them are in the field of the constants; otherwise in floating
    point; none where the system itself has no short numbers.
    """
    found = _exact(pair, known)
    if found is not None:
        return found
    rows = [
        known.numbers(a, b) for a, b in zip(pair[0].basis, pair[1].basis, strict=True)
    ]
    complete = [row for row in rows if row is not None]
    if len(complete) < len(rows):
        return ()
    return principal_screws([[float(x) for x in row] for row in complete])


def _exact(pair: Pair, known: Reconstruction) -> tuple[PrincipalScrew, ...] | None:
    parts = _of_definite_pitch(pair, known)
    if parts is None:
        return None
    free = [_perpendicular(s.free, s.prime) for s in pair]
    moments = [_orthogonal(s.moments, s.prime) for s in pair]
    screws = [
        *(_turning(pair, known, two) for two in parts),
        *(_turning(pair, known, two) for two in zip(*free, strict=True)),
        *(_moment(known, two) for two in zip(*moments, strict=True)),
    ]
    found = tuple(screw for screw in screws if screw is not None)
    return found if len(found) == len(screws) else None


def _of_definite_pitch(
    pair: Pair, known: Reconstruction
) -> list[tuple[Residues, Residues]] | None:
    """Screws modulo each prime, pitch by pitch; None if a pitch is not in the field."""
    polynomials = [_characteristic(s) for s in pair]
    parts: list[tuple[Residues, Residues]] = []
    for a, b, _ in known.roots(*polynomials):
        first, second = (_with_pitch(s, h) for s, h in zip(pair, (a, b), strict=True))
        if len(first) != len(second):
            return None
        parts += zip(first, second, strict=True)
    return parts if len(parts) == len(pair[0].pitched) else None


def _characteristic(system: ScrewStructure) -> list[int]:
    """Coefficients of the polynomial of the principal pitches, constant term first."""
    p, screws = system.prime, system.pitched
    directions = [screw[DIRECTION] for screw in screws]
    gram = [[2 * dot(a, b) for b in directions] for a in directions]
    columns = [solve(gram, [product(a, b) for b in screws], p) for a in screws]
    coefficients, power = [1], columns
    # Newton's identities, from the traces of the powers
    traces: list[int] = []
    for k in range(1, len(screws) + 1):
        traces.append(sum(power[i][i] for i in range(len(screws))))
        total = sum(c * t for c, t in zip(coefficients[::-1], traces, strict=True))
        coefficients.append(-total * pow(k, -1, p) % p)
        power = [list(combination(row, columns, p)) for row in power]
    return coefficients[::-1]


def _with_pitch(system: ScrewStructure, value: int) -> list[Residues]:
    """Perpendicular screws that span those of this principal pitch."""
    p, screws = system.prime, system.pitched
    forms = [
        [
            (product(a, b) - 2 * value * dot(a[DIRECTION], b[DIRECTION])) % p
            for b in screws
        ]
        for a in screws
    ]
    weights = annihilator(forms, len(screws), p)
    return _perpendicular([combination(w, screws, p) for w in weights], p)


def _perpendicular(screws: Sequence[Residues], prime: int) -> list[Residues]:
    """The same space of screws by orthogonal directions."""
    rows = echelon(screws, prime)
    directions = [row[DIRECTION] for row in rows]
    columns = list(zip(*directions, strict=True))
    return [
        combination(solve(columns, direction, prime), rows, prime)
        for direction in _orthogonal(directions, prime)
    ]


def _orthogonal(vectors: Sequence[Residues], prime: int) -> list[Residues]:
    """Orthogonal basis of a space of vectors that the space determines."""
    rows = echelon(vectors, prime)
    if len(rows) < 2:
        return list(rows)
    first, *rest = rows
    if len(rows) == 2:
        normal = cross(first, rest[0])
        return [first, tuple(x % prime for x in cross(normal, first))]
    return [first, *_orthogonal(normal_part(rows, [first], prime), prime)]


def _turning(
    pair: Pair, known: Reconstruction, screws: Sequence[Residues]
) -> PrincipalScrew | None:
    (p, q), (a, b) = (s.prime for s in pair), screws
    direction = known.direction(a[DIRECTION], b[DIRECTION])
    point = known.numbers(foot(a, p), foot(b, q))
    advance = known.number(pitch(a, p), pitch(b, q))
    if direction is None or point is None or advance is None:
        return None
    exact = ExactScrew(_texts(direction), _texts(point), advance.text)
    x, y, z = map(float, point)
    return PrincipalScrew(_unit(direction), (x, y, z), float(advance), exact)


def _moment(
    known: Reconstruction, moments: Sequence[Residues]
) -> PrincipalScrew | None:
    direction = known.direction(*moments)
    if direction is None:
        return None
    return PrincipalScrew(_unit(direction), None, inf, ExactScrew(_texts(direction)))


def _texts(numbers: Sequence[AlgebraicNumber]) -> tuple[str, ...]:
    return tuple(number.text for number in numbers)


def _unit(direction: Sequence[AlgebraicNumber]) -> Point:
    x, y, z = map(float, direction)
    size = hypot(x, y, z)
    return x / size, y / size, z / size
