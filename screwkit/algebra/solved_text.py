"""The pieces of a closed solution: reduced quotients and sums with multiples of π."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import prod

from screwkit.algebra.angles import Form, Merged
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.constant_multiples import inverse as inverse_number
from screwkit.algebra.constant_multiples import is_number
from screwkit.algebra.known_angles import turns_of_cosine, turns_of_tangent
from screwkit.algebra.polynomial_text import angle_text, merged_text
from screwkit.algebra.restrictions import coefficients
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
    content,
    primitive,
)

_SIXTH, _QUARTER, _THIRD, _HALF = (Fraction(1, n) for n in (6, 4, 3, 2))
_ZERO, _ONE = Fraction(0), Fraction(1)
_KNOWN: dict[str, dict[Fraction, Fraction]] = {
    "asin": {_ZERO: _ZERO, _HALF: _SIXTH, _ONE: _HALF},
    "acos": {_ZERO: _HALF, _HALF: _THIRD, _ONE: _ZERO},
    "atan": {_ZERO: _ZERO, _ONE: _QUARTER},
}


@dataclass(frozen=True, eq=False)
class Quotient:
    """A reduced quotient of polynomials in merged angles.

    Attributes:
        text: In the grammar; the sign stands in the numerator.
    """

    ring: TrigonometricRing
    numerator: Polynomial
    denominator: Polynomial
    text: str

    @classmethod
    def of(
        cls,
        ring: TrigonometricRing,
        angles: Merged,
        numerator: Polynomial,
        denominator: Polynomial,
    ) -> Quotient:
        """Reduce and write; the angles of the polynomials are those of ``angles``."""
        if numerator == 0:
            return cls(ring, numerator, ring.one, "0")
        common = numerator.gcd(denominator)
        above, below = numerator / common, denominator / common
        scale = content(above) / content(below)
        above, below = scale.p * primitive(above), scale.q * primitive(below)
        written = merged_text(ring, replace(angles, polynomial=below))
        if written.startswith("-"):
            above, below = -above, -below
            written = merged_text(ring, replace(angles, polynomial=below))
        top = merged_text(ring, replace(angles, polynomial=above))
        if below == 1:
            return cls(ring, above, below, top)
        if len(above) > 1:
            top = f"({top})"
        if len(below) > 1 or "*" in written:
            written = f"({written})"
        return cls(ring, above, below, f"{top}/{written}")

    @property
    def is_number(self) -> bool:
        """Whether it is rational."""
        return bool(self.numerator.is_constant() and self.denominator.is_constant())

    @property
    def number(self) -> Polynomial:
        """Its value in the field of the ring's numbers, where it is one."""
        below = inverse_number(self.ring, self.denominator)
        return self.ring.normal(self.numerator * below)

    def sign(self, assumptions: Assumptions) -> int | None:
        """1, 0 or −1 where that is certain."""
        above = assumptions.sign_of(self.ring, self.numerator)
        below = assumptions.sign_of(self.ring, self.denominator)
        return None if above is None or below is None else above * below


@dataclass(frozen=True)
class AngleValue:
    """A branch: ± an inverse function or another angle, plus a multiple of π.

    Attributes:
        core: Text of the inverse function; may be empty.
        other: The other angle; may be empty.
        positive: The sign of both.
        half_turns: The multiple of π.
    """

    core: str = ""
    other: Form = ()
    positive: bool = True
    half_turns: Fraction = Fraction(0)

    @classmethod
    def inverse(cls, function: str, argument: Quotient, times: int = 1) -> AngleValue:
        """An inverse function, or the multiple of π that it is."""
        if argument.is_number:
            ratio = as_fraction(argument.numerator) / as_fraction(argument.denominator)
            known = _KNOWN[function].get(abs(ratio))
            if known is not None:
                turns = known
                if ratio < 0:
                    turns = 1 - known if function == "acos" else -known
                return cls(half_turns=times * turns)
        elif is_number(argument.ring, argument.numerator * argument.denominator):
            value = argument.number
            if function == "atan":
                told = turns_of_tangent(argument.ring, value)
            else:
                told = turns_of_cosine(argument.ring, value)
            if told is not None:
                turns = _HALF - told if function == "asin" else told
                return cls(half_turns=times * turns)
        multiple = "" if times == 1 else f"{times}*"
        return cls(f"{multiple}{function}({argument.text})")

    @classmethod
    def of_angle(
        cls, ratio: Quotient, angles: Merged, *, is_cosine: bool
    ) -> list[AngleValue] | None:
        """Both φ whose cosine (or sine) is ± the cosine or sine of another angle."""
        ring = ratio.ring
        for i, pair in enumerate(zip(ring.sines, ring.cosines, strict=True)):
            sine, cosine = reversed(pair) if i in angles.exchanged else pair
            core = cls(other=angles.forms[i])
            for sign in (1, -1):
                above = sign * ratio.numerator
                if ratio.denominator != 1 or above not in (sine, cosine):
                    continue
                # φ = α, or π/2 − α where a cosine is a sine.
                first = core if (above == cosine) == is_cosine else (-core).plus(_HALF)
                if is_cosine:
                    first = first if sign == 1 else first.plus(1)
                    both = first, -first
                else:
                    first = first if sign == 1 else -first
                    both = first, (-first).plus(1)
                return [
                    replace(one, half_turns=1 - (1 - one.half_turns) % 2)
                    for one in both
                ]
        return None

    def __neg__(self) -> AngleValue:
        return replace(self, positive=not self.positive, half_turns=-self.half_turns)

    def plus(self, half_turns: Fraction | int) -> AngleValue:
        """Turned on; a plain multiple of π is brought into (−π, π]."""
        total = self.half_turns + half_turns
        if not self.core and not self.other:
            total = 1 - (1 - total) % 2
        return replace(self, half_turns=total)


def angle_values_text(
    branches: Sequence[AngleValue], form: Form, variable: str
) -> tuple[str, ...]:
    """The branches of ``variable`` where the merged angle has the given values."""
    sign = dict(form)[variable]
    texts = []
    for branch in branches:
        value = branch if sign == 1 else -branch
        if not value.core:
            value = value.plus(0)
        counts = {n: -sign * count for n, count in form if n != variable}
        for name, count in value.other:
            moved = count if value.positive else -count
            counts[name] = counts.get(name, 0) + moved
        rest = [(name, count) for name, count in counts.items() if count]
        rest.sort(key=lambda part: part[1] < 0)
        terms = [angle_text((part,)) for part in rest]
        if value.core:
            terms.append(value.core if value.positive else f"-{value.core}")
        if value.half_turns or not terms:
            terms.append(_turns_text(value.half_turns))
        texts.append(_joined(terms))
    return tuple(dict.fromkeys(texts))


def _turns_text(half_turns: Fraction) -> str:
    """``-pi/2``."""
    if not half_turns:
        return "0"
    size = abs(half_turns.numerator)
    text = "pi" if size == 1 else f"{size}*pi"
    below = "" if half_turns.denominator == 1 else f"/{half_turns.denominator}"
    return f"{'-' if half_turns < 0 else ''}{text}{below}"


def _joined(terms: list[str]) -> str:
    """A sum, with a positive term in front where there is one."""
    if terms[0].startswith("-"):
        first = next((t for t in terms if not t.startswith("-")), None)
        if first is not None:
            terms.remove(first)
            terms.insert(0, first)
    text = terms[0]
    for term in terms[1:]:
        text += f" - {term[1:]}" if term.startswith("-") else f" + {term}"
    return text


def short_slices(
    ring: TrigonometricRing,
    polynomial: Polynomial,
    places: tuple[int, ...],
    longest: int,
) -> dict[tuple[int, ...], Polynomial] | None:
    """The coefficients by powers; None where no solution has so few characters.

    All coefficients but one are written out, and a term takes four characters at least.
    """
    # Of long ones nothing more is built than what is free of the generators.
    free = len(polynomial.subs({ring.names[place]: 0 for place in places}))
    count = prod(polynomial.degrees()[place] + 1 for place in places)
    if 4 * (min(free, len(polynomial) - free) - count) > longest:
        return None
    slices = coefficients(polynomial, places)
    sizes = sorted(map(len, slices.values()))
    return None if 4 * (sum(sizes[:-1]) - len(sizes)) > longest else slices


def root_of_square(polynomial: Polynomial) -> Polynomial | None:
    """The square root of a perfect square."""
    try:
        return polynomial.sqrt()
    except Exception:  # FLINT's own DomainError for a non-square
        return None
