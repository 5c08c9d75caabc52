"""Lists of schemes: how many there may be, how many there are, what refuses them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import comb
from typing import TypeAlias

from screwkit.errors import TooLargeError
from screwkit.mechanism.model import Mechanism
from screwkit.results.schemes import Balanced, Ranking, Refusal, Scheme, Schemes
from screwkit.results.undecided import Undecided

Ranked: TypeAlias = Callable[[Sequence[tuple[str, ...]]], Ranking | Undecided]
"""Orders admissible schemes, or says why it cannot."""

NOTHING_DECLARED = (
    "the file declares no actuated joint to which others could be added: give some "
    "with --actuated"
)

LARGEST = 20_000  # schemes; beyond, candidates have to be named


def number_of_schemes(size: int, candidates: int) -> int:
    """How many schemes of a size there are.

    Raises:
        TooLargeError: If they are more than can sensibly be listed.
    """
    total = comb(candidates, size)
    if total > LARGEST:
        raise TooLargeError(
            f"{total} schemes of {size} among {candidates} joints are more than "
            f"{LARGEST}; name fewer with --candidates"
        )
    return total


def told_schemes(
    mechanism: Mechanism, size: int, limbs: int, listed: Sequence[Scheme]
) -> Schemes:
    """The schemes and their numbers, before anything is said of loci."""
    even = [scheme for scheme in listed if scheme.balanced]
    divides = bool(limbs) and size % limbs == 0
    return Schemes(
        case=mechanism.name,
        title=mechanism.title,
        size=size,
        total=len(listed),
        admissible=sum(scheme.admissible for scheme in listed),
        balanced=Balanced(len(even), sum(s.admissible for s in even))
        if divides
        else None,
        schemes=tuple(listed),
        refusals=_refusals(listed),
    )


def _refusals(listed: Sequence[Scheme]) -> tuple[Refusal, ...]:
    groups: dict[str, list[Scheme]] = {}
    for scheme in listed:
        if scheme.reason is not None:
            groups.setdefault(scheme.reason, []).append(scheme)
    refusals = [
        Refusal(reason, len(group), group[0].actuated)
        for reason, group in groups.items()
    ]
    return tuple(sorted(refusals, key=lambda refusal: -refusal.schemes))
