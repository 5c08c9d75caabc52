"""Rational frames in which one and the same linkage is written down again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

Vector = tuple[Fraction, ...]
Given = Sequence[int | Fraction]


@dataclass(frozen=True)
class Frame:
    """A rotation by a quaternion of any length, then a scale and a shift."""

    quaternion: tuple[int, int, int, int] = (1, 0, 0, 0)
    shift: Given = (0, 0, 0)
    scale: Fraction = Fraction(1)

    def direction(self, vector: Given) -> Vector:
        """Of an axis."""
        a, b, c, d = self.quaternion
        size = Fraction(a * a + b * b + c * c + d * d)
        rows = (
            (a * a + b * b - c * c - d * d, 2 * (b * c - a * d), 2 * (b * d + a * c)),
            (2 * (b * c + a * d), a * a - b * b + c * c - d * d, 2 * (c * d - a * b)),
            (2 * (b * d - a * c), 2 * (c * d + a * b), a * a - b * b - c * c + d * d),
        )
        return tuple(
            sum((x * y for x, y in zip(row, vector, strict=True)), Fraction(0)) / size
            for row in rows
        )

    def point(self, vector: Given) -> Vector:
        """Of a centre."""
        turned = self.direction(vector)
        return tuple(
            self.scale * x + y for x, y in zip(turned, self.shift, strict=True)
        )


FRAMES = (
    Frame(),
    Frame((3, 1, 2, 5), (Fraction(1, 2), -3, 7)),
    Frame((7, -2, 3, 1), (10, Fraction(1, 3), -4), Fraction(5, 2)),
)
