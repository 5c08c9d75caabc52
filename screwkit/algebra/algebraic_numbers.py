"""Exact numbers of a constant field: rational combinations of irrationalities."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from flint import arb, ctx, fmpq

from screwkit.algebra.expression import ONE, Expression, Number, Pi
from screwkit.algebra.expression_building import add, call, multiply
from screwkit.algebra.text import expression_text


@dataclass(frozen=True, order=True)
class Irrationality:
    """√radicand · 2cos(π·turn), the second factor only where ``turn`` is not 0."""

    radicand: int = 1
    turn: Fraction = Fraction(0)

    @property
    def expression(self) -> Expression:
        """In the grammar, without the factor 2 of the cosine."""
        if self.radicand == 1 and not self.turn:
            return ONE
        root, cosine = Number(Fraction(self.radicand)), Number(self.turn)
        return multiply(
            *([call("sqrt", root)] if self.radicand > 1 else []),
            *([call("cos", multiply(cosine, Pi()))] if self.turn else []),
        )

    @property
    def ball(self) -> arb:
        """The real number at the working precision."""
        cosine = 2 * arb.cos_pi_fmpq(_fmpq(self.turn)) if self.turn else arb(1)
        return arb(self.radicand).sqrt() * cosine


@dataclass(frozen=True)
class AlgebraicNumber:
    """A rational combination of irrationalities that are independent over Q.

    Attributes:
        terms: Irrationality and coefficient, no coefficient zero.
    """

    terms: tuple[tuple[Irrationality, Fraction], ...]

    @property
    def expression(self) -> Expression:
        """The number in the grammar."""
        match self.terms:
            case ((Irrationality(1, 0), value),):
                return Number(value)
        return add(
            *(
                multiply(Number(coefficient * (2 if unit.turn else 1)), unit.expression)
                for unit, coefficient in self.terms
            )
        )

    @cached_property
    def text(self) -> str:
        """The number as text of the grammar: ``1/2 + sqrt(3)/2``."""
        return expression_text(self.expression)

    @property
    def is_rational(self) -> bool:
        """Whether no irrationality occurs."""
        return all(unit.radicand == 1 and not unit.turn for unit, _ in self.terms)

    @property
    def sign(self) -> int:
        """−1, 0 or 1: proved by interval arithmetic, fine enough in the end."""
        if not self.terms:
            return 0
        if self.is_rational:
            return 1 if self.terms[0][1] > 0 else -1
        bits = 64
        while True:
            ball = self._ball(bits)
            if ball > 0 or ball < 0:
                return 1 if ball > 0 else -1
            bits *= 2

    def __float__(self) -> float:
        """The nearest float, nearly."""
        return float(self._ball(192))

    def scaled(self, factor: Fraction) -> AlgebraicNumber:
        """A rational multiple, not by 0."""
        return AlgebraicNumber(tuple((u, c * factor) for u, c in self.terms))

    def _ball(self, bits: int) -> arb:
        with ctx.workprec(bits):
            total = arb(0)
            for unit, coefficient in self.terms:
                total += arb(_fmpq(coefficient)) * unit.ball
            return total


def _fmpq(value: Fraction) -> fmpq:
    return fmpq(value.numerator, value.denominator)
