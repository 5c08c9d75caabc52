"""What stands in a certificate as text: expressions and numbers, nothing evaluated."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from fractions import Fraction
from functools import lru_cache

from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import symbols_of
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.parse import parse
from screwkit.algebra.rational_values import rational_value
from screwkit.algebra.written_terms import factors_of, terms_of
from screwkit.certificates.equations_told import Step, Unsolved
from screwkit.certificates.one_symbol import coefficients_of
from screwkit.certificates.records import Part

_MOST = 8
"""Different square roots for which a prime is looked for; each halves the primes."""


class RefusedError(Exception):
    """A certificate does not hold; the text says what."""


class NoPostureError(RefusedError):
    """No posture was found where one is claimed; modulo another prime one may be."""


@lru_cache(maxsize=20_000)
def read(text: str) -> Expression:
    """A text of a certificate as an expression; nothing is evaluated."""
    return parse(text, limits=RESULT_LIMITS)


@lru_cache(maxsize=20_000)
def names_in(text: str) -> frozenset[str]:
    """The names that occur in a text of a certificate."""
    return symbols_of(read(text))


def fraction(text: str) -> Fraction:
    """A rational number.

    Raises:
        RefusedError: If the text is none.
    """
    value = rational_value(read(text))
    if value is None:
        raise RefusedError(f"{text!r} is no rational number")
    return value


def radicands_of(part: Part) -> list[Fraction]:
    """The numbers whose roots solve quadratic equations in numbers.

    They are a² + b² − c² of a·sin φ + b·cos φ + c = 0, and discriminants.

    Raises:
        RefusedError: If a, b or c is no rational number.
    """
    found: dict[Fraction, None] = {}
    for step in _steps(part):
        if isinstance(step, Unsolved):
            terms = [factors_of(term) for term in terms_of(read(step.equation))]
            quadratic = coefficients_of(terms) or []
            if len(quadratic) == 3:
                c, b, a = quadratic
                found[b * b - 4 * a * c] = None
        elif step.kind == "numbers" and len(step.numbers) == 3:
            a, b, c = map(fraction, step.numbers)
            found[a * a + b * b - c * c] = None
    return [radicand for radicand in found if radicand > 0][:_MOST]


def _steps(part: Part) -> Iterator[Step | Unsolved]:
    waiting: list[object] = [part]
    while waiting:
        here = waiting.pop()
        if isinstance(here, (Step, Unsolved)):
            yield here
        if isinstance(here, (tuple, list)):
            waiting.extend(here)
        elif is_dataclass(here):
            waiting.extend(getattr(here, field.name) for field in fields(here))
