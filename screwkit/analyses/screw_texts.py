"""Exact coordinates of screws, read from their residues modulo two primes.

Whatever is a short number of the geometry's constants is written as one; a coordinate
that depends on symbols drawn at random has no such number, and the text is empty.

References: [WangGuyDavenport1982] (rational reconstruction).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import gcd, lcm
from typing import Protocol, TypeAlias

from screwkit.algebra.algebraic_numbers import AlgebraicNumber
from screwkit.algebra.constants import ConstantField
from screwkit.algebra.reconstruction import Reconstruction
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.reasons.readable_screws import kind_of, passes
from screwkit.screw.vector import cross, dot

Texts: TypeAlias = tuple[str, ...]
Residues: TypeAlias = Sequence[int]
Pair: TypeAlias = tuple[Residues, Residues]
"""The same vector modulo both primes."""
SCALED = 24
"""Coordinates up to which the shortest of several scales is looked for."""


@dataclass(frozen=True)
class ScrewTexts:
    """Where a screw is, as texts; empty where it has no such part or none is known.

    Attributes:
        kind: ``free``, ``line`` or ``screw``.
        direction: Of the axis, or of the free vector.
        point: A point of the axis.
        pitch: ``0`` for lines, empty for free vectors.
        through: Joints that the axis meets, at most two, where texts are missing.
    """

    kind: str
    direction: Texts = ()
    point: Texts = ()
    pitch: str = ""
    through: tuple[str, ...] = ()


class ExactPoint(Protocol):
    """A point known modulo a prime."""

    @property
    def prime(self) -> int:
        """The modulus."""
        ...

    @property
    def constants(self) -> Mapping[str, int]:
        """Residues of the generators of the geometry's constants."""
        ...

    @property
    def field(self) -> ConstantField:
        """The field of the constants."""
        ...


class TextReader:
    """Reads residues of one mechanism at one point, modulo two primes."""

    def __init__(self, numbers: Reconstruction) -> None:
        self.primes = numbers.primes
        self._numbers = numbers

    @classmethod
    def between(cls, first: ExactPoint, second: ExactPoint) -> TextReader:
        """Of one point, modulo the prime of each."""
        primes, constants = (
            (first.prime, second.prime),
            (first.constants, second.constants),
        )
        return cls(Reconstruction(first.field, primes, constants))

    def vector(self, pair: Pair) -> Texts:
        """The coordinates as they are."""
        return _texts(self._numbers.numbers(*pair))

    def scaled(self, pair: Pair) -> Texts:
        """The coordinates up to a common factor that makes them short."""
        if len(pair[0]) <= SCALED:
            return _texts(self._numbers.direction(*pair))
        numbers = self._numbers.numbers(*pair)
        return _texts(None if numbers is None else _integral(numbers))

    def screw(self, pair: Pair, near: Sequence[Pair] = ()) -> ScrewTexts:
        """Kind, direction, a point and the pitch of a screw.

        Args:
            pair: (direction; moment) modulo both primes, up to a factor.
            near: Points that are written if they lie on the axis.
        """
        one, other = pair
        p, q = self.primes
        kind = kind_of(one, p)
        part = MOMENT if kind == "free" else DIRECTION
        direction = self.scaled((one[part], other[part]))
        if kind == "free":
            return ScrewTexts(kind, direction)
        pitch = "0"
        if kind == "screw":
            found = self.vector(([_pitch(one, p)], [_pitch(other, q)]))
            pitch = found[0] if found else ""
        return ScrewTexts(kind, direction, self._point(pair, near), pitch)

    def _point(self, pair: Pair, near: Sequence[Pair]) -> Texts:
        p, q = self.primes
        for point in near:
            if passes(pair[0], point[0], p) and passes(pair[1], point[1], q):
                known = self.vector(point)
                if known:
                    return known
        places = zip(_places(pair[0], p), _places(pair[1], q), strict=True)
        texts = [text for a, b in places if a and b and (text := self.vector((a, b)))]
        return min(texts, key=lambda text: sum(map(len, text)), default=())


def _texts(numbers: Sequence[AlgebraicNumber] | None) -> Texts:
    return () if numbers is None else tuple(number.text for number in numbers)


def _integral(numbers: Sequence[AlgebraicNumber]) -> tuple[AlgebraicNumber, ...]:
    """A multiple whose coefficients are integers without common factor."""
    coefficients = [c for number in numbers for _, c in number.terms]
    below = lcm(*(c.denominator for c in coefficients))
    factor = Fraction(below, gcd(*(int(c * below) for c in coefficients)) or 1)
    return tuple(number.scaled(factor) for number in numbers)


def _pitch(screw: Residues, prime: int) -> int:
    square = dot(screw[DIRECTION], screw[DIRECTION])
    return dot(screw[DIRECTION], screw[MOMENT]) * pow(square, -1, prime) % prime


def _without_pitch(screw: Residues, prime: int) -> list[int]:
    """The moment of the axis alone."""
    h = _pitch(screw, prime)
    pairs = zip(screw[DIRECTION], screw[MOMENT], strict=True)
    return [(m - h * d) % prime for d, m in pairs]


def _places(screw: Residues, prime: int) -> list[list[int]]:
    """The foot of the axis and where it meets the coordinate planes, if it does."""
    direction, moment = screw[DIRECTION], _without_pitch(screw, prime)
    inverse = pow(dot(direction, direction), -1, prime)
    places = [[x * inverse % prime for x in cross(direction, moment)]]
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        place: list[int] = []
        if direction[i]:
            # m = p × d with p_i = 0: the other two coordinates are m_j / d_i.
            inverse = pow(direction[i], -1, prime)
            place = [0, 0, 0]
            place[j] = -moment[k] * inverse % prime
            place[k] = moment[j] * inverse % prime
        places.append(place)
    return places
