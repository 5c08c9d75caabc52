"""Answers about short polynomials, kept with their ring.

A search meets the same conditions on branch after branch: whether one can vanish, how
it is solved, and what vanishes with it is asked several times on each, and depends on
nothing but the ring and what is assumed of its symbols.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from functools import wraps
from typing import TypeVar
from weakref import WeakKeyDictionary

from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LONGEST = 200
"""Terms up to which an answer is kept; longer polynomials seldom come again."""

Given = TypeVar("Given", bound=Hashable)
Answer = TypeVar("Answer")


def remembered(
    question: Callable[[TrigonometricRing, Given, Polynomial], Answer],
) -> Callable[[TrigonometricRing, Given, Polynomial], Answer]:
    """The same function, which answers only once.

    Args:
        question: Of a ring, what is assumed, and a polynomial; whoever gets its answer
            must leave it as it is.
    """
    known: WeakKeyDictionary[TrigonometricRing, dict[tuple[Given, str], Answer]]
    known = WeakKeyDictionary()

    @wraps(question)
    def asked(ring: TrigonometricRing, given: Given, polynomial: Polynomial) -> Answer:
        if len(polynomial) > LONGEST:
            return question(ring, given, polynomial)
        answers = known.get(ring)
        if answers is None:
            answers = known[ring] = {}
        key = given, str(polynomial)
        if key not in answers:
            answers[key] = question(ring, given, polynomial)
        return answers[key]

    return asked
