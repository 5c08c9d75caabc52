"""Answers about short polynomials, kept with their ring.

A search meets the same conditions on branch after branch: whether one can vanish, how
it is solved, and what vanishes with it is asked several times on each, and depends on
nothing but the ring and what is assumed of its symbols.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from functools import wraps
from typing import Generic, TypeVar
from weakref import WeakKeyDictionary

from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LONGEST = 200
"""Terms up to which an answer is kept; longer polynomials seldom come again."""

LONGEST_COLUMN = 20_000
"""Terms of all entries of a vector up to which an answer about it is kept."""

Given = TypeVar("Given", bound=Hashable)
Answer = TypeVar("Answer")
Owner = TypeVar("Owner")


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


class RememberedColumns(Generic[Owner, Answer]):
    """Answers about vectors of polynomials, kept as long as their owner lives.

    The same vector is met on branches that differ elsewhere.
    """

    def __init__(self) -> None:
        self._known: WeakKeyDictionary[Owner, dict[Hashable, Answer]]
        self._known = WeakKeyDictionary()

    def answer(
        self,
        owner: Owner,
        column: Sequence[Polynomial],
        given: Hashable,
        found: Callable[[], Answer],
    ) -> Answer:
        """What was found for the same vector, or is found now.

        Args:
            owner: The ring, or whatever else the answer belongs to.
            column: The vector.
            given: Whatever else the answer depends on.
            found: The answer; whoever gets it must leave it as it is.
        """
        if sum(map(len, column)) > LONGEST_COLUMN:
            return found()
        answers = self._known.setdefault(owner, {})
        key = given, tuple(map(str, column))
        if key not in answers:
            answers[key] = found()
        return answers[key]
