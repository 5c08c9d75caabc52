"""The claims of a case beside what the engine finds.

A claim names a place in the JSON results (``mobility.counts.gogu``); a word after ``#``
tells several claims about one place apart and marks what can only be compared in part
or by a reader.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cache
from typing import Any

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.modular import (
    ModularRing,
    ResampleError,
    Residue,
    prime_for,
)
from screwkit.algebra.parse import parse
from screwkit.algebra.text import expression_text
from screwkit.errors import ExpressionError
from screwkit.mechanism.model import Claim
from screwkit.results.analysis import ClaimCheck


def checked_claims(
    claims: Sequence[Claim], documents: Mapping[str, Any]
) -> tuple[ClaimCheck, ...]:
    """Each claim with the computed value and whether the two agree.

    Args:
        claims: Of the file.
        documents: JSON results by question, ``{"mobility": {...}, …}``.
    """
    return tuple(_checked(claim, documents) for claim in claims)


def _checked(claim: Claim, documents: Mapping[str, Any]) -> ClaimCheck:
    place, _, word = claim.question.partition("#")
    computed = value_at(documents, place)
    agrees = agreement(claim.value, computed, claim.tolerance, partly=bool(word))
    shown = None if isinstance(computed, dict | list) else computed
    return ClaimCheck(
        claim.question,
        claim.value,
        shown,
        agrees,
        claim.status,
        claim.source,
        claim.holds,
        claim.note,
    )


def value_at(documents: Mapping[str, Any], place: str) -> Any:
    """What stands at a dotted path; None where nothing does."""
    value: Any = documents
    for step in place.split("."):
        if isinstance(value, dict) and step in value:
            value = value[step]
        elif isinstance(value, list) and step.isdigit() and int(step) < len(value):
            value = value[int(step)]
        else:
            return None
    return value


def agreement(
    claimed: Any, computed: Any, tolerance: float | None, *, partly: bool
) -> bool | None:
    """Whether a claimed and a computed value are equal.

    None where they cannot be compared: nothing was computed, or one is prose.
    """
    if computed is None:
        return None
    if isinstance(computed, bool) or isinstance(claimed, bool):
        return bool(claimed == computed) if type(claimed) is type(computed) else None
    if _is_number(claimed) and _is_number(computed):
        return _close(claimed, computed, tolerance or 0.0)
    if _are_numbers(claimed) and _are_numbers(computed):
        return len(claimed) == len(computed) and all(
            _close(one, other, tolerance or 0.0)
            for one, other in zip(claimed, computed, strict=True)
        )
    if isinstance(claimed, list | tuple) and isinstance(computed, list):
        return _lists(list(claimed), computed)
    if isinstance(claimed, str) and isinstance(computed, str):
        same = _canonical(claimed) == _canonical(computed)
        return same if same or not partly else None
    return None


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _are_numbers(value: Any) -> bool:
    return (
        isinstance(value, list | tuple) and bool(value) and all(map(_is_number, value))
    )


def _close(claimed: float, computed: float, tolerance: float) -> bool:
    """Equal up to a part of the claimed number; up to the part itself where it is 0."""
    return abs(claimed - computed) <= tolerance * (abs(claimed) or 1.0)


def _lists(claimed: list[Any], computed: list[Any]) -> bool | None:
    """Lists of components: every claimed one must be there; other lists: equal."""
    if all(isinstance(item, dict) for item in computed) and computed:
        found = [
            {_up_to_factor(e) for e in item.get("equations", ())} for item in computed
        ]
        values = [
            [_canonical(v) for v in solution["values"]]
            for item in computed
            for solution in item.get("solutions", ())
        ]
        if all(isinstance(item, str) for item in claimed):
            return [_canonical(item) for item in claimed] in values
        return all({_up_to_factor(e) for e in item} in found for item in claimed)
    return bool(
        [_canonical(str(v)) for v in claimed] == [_canonical(str(v)) for v in computed]
    )


def _canonical(text: str) -> str:
    try:
        return expression_text(parse(text))
    except ExpressionError:
        return text


def _up_to_factor(text: str) -> str:
    """The left side of an equation as a key: the same for all its multiples.

    Its ratios at points that hang on nothing but the names of the symbols, modulo a
    prime: equal for equal polynomials however they are written, and for others with a
    probability below degree/2⁶⁰ [Schwartz1980].
    """
    try:
        expression = parse(text, limits=RESULT_LIMITS)
        values = [int(evaluate(expression, _NamedPoint(n))) for n in range(3)]
    except (ExpressionError, ResampleError, ZeroDivisionError, KeyError):
        return text
    first = next((value for value in values if value), 0)
    if not first:
        return "0"
    inverse = pow(first, -1, _prime())
    return " ".join(str(value * inverse % _prime()) for value in values)


@cache
def _prime() -> int:
    """A modulus with the roots that equations contain as a rule."""
    return prime_for(12, [Fraction(n) for n in (2, 3, 5, 7, 11, 13)], 1)


class _NamedPoint(ModularRing):
    """A point at which every symbol has the residue that its name gives."""

    def __init__(self, number: int) -> None:
        super().__init__(number, _prime())
        self._number = number

    def symbol(self, name: str) -> Residue:
        return self._of(name).symbol("x")

    def cosine_sine(self, angle: str) -> tuple[Residue, Residue]:
        return self._of(angle).cosine_sine("x")

    def _of(self, name: str) -> ModularRing:
        seed = int.from_bytes(f"{self._number} {name}".encode(), "big")
        return ModularRing(seed, _prime())
