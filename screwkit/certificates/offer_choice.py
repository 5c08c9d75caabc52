"""Which of several products a node takes: the one that leaves the fewest cases."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from math import prod
from typing import TypeAlias

from screwkit.algebra.factors import Factor
from screwkit.algebra.trigonometric import primitive
from screwkit.certificates.conditions import Option, Place
from screwkit.certificates.endings import Endings
from screwkit.certificates.offers import Offer
from screwkit.certificates.roots import NotProvedError
from screwkit.certificates.steps import followed
from screwkit.certificates.whole_equations import with_whole_equations

LONGEST = 60_000
"""Terms of a minor that is factored."""

MANY = 3_000
"""Terms of a minor beside which no other one is expanded."""

LOOKED_AT = 4
"""Minors whose cases are all looked at before one is chosen."""


_Candidate: TypeAlias = tuple[int, int, Offer, list[tuple[Factor, int]]]


@dataclass(frozen=True)
class Choice:
    """An offer with its cases.

    Attributes:
        factors: Of its product, with their powers.
        options: By factor.
        fallen: By limb and component.
    """

    offer: Offer
    factors: list[tuple[Factor, int]]
    options: list[list[Option]]
    fallen: list[list[Option]]


def _degree(option: Option) -> int:
    """Bézout's number of the unsolved conditions."""
    return prod(own.value.total_degree() for own in option.place.branch.pending)


@dataclass
class OfferChoice(Endings):
    """Chooses between products by what is left to be done on their cases.

    Attributes:
        longest: Terms of a minor that is factored.
        asks_limbs: Whether limbs are asked before minors of the whole matrix.  Their
            products are short and often the same; they differ in degrees more than in
            length.
    """

    longest: int = field(default=LONGEST, kw_only=True)
    asks_limbs: bool = field(default=False, kw_only=True)

    def chosen(self, place: Place, offers: Iterable[Offer]) -> Choice:
        """The offer that leaves the fewest cases.

        Raises:
            NotProvedError: If there is none.
        """
        branch = place.branch
        candidates: list[_Candidate] = []
        met = set[tuple[frozenset[str], int]]()
        for offer in offers:
            factors = self.product(branch, offer.parts, self.longest)
            if factors is not None:
                factors = with_whole_equations(self, place, factors)
                if self.is_held(place, factors) or self.are_held(place, offer):
                    continue  # it says nothing here
                alike = (
                    frozenset(f.key for f, _ in factors),
                    sum(map(len, offer.fallen)),
                )
                if self.asks_limbs and alike in met:
                    continue  # as good as one before
                met.add(alike)
                open_ones = [f for f, _ in factors if not self.positive(branch, f)]
                weight = sum(3 + len(f.equations[0]) for f in open_ones)
                candidates.append((weight, len(candidates), offer, factors))
                if not open_ones or offer.terms > MANY:
                    break
        if not candidates:
            raise NotProvedError("every minor is too long, or says nothing new")
        candidates.sort(key=lambda candidate: candidate[:2])
        known: dict[str, list[Option]] = {}
        reason = ""
        best: tuple[tuple[int, int, int], Choice] | None = None
        for _, order, offer, factors in candidates[:LOOKED_AT]:
            try:
                options = self.options(place, factors, known)
            except NotProvedError as error:
                reason = str(error)
                continue
            fallen = [[self.where(place, e) for e in own] for own in offer.fallen]
            every = (option for own in (*options, *fallen) for option in own)
            left = [option for option in every if self.is_open(option)]
            cost = *self._cost(left), order
            if best is None or cost < best[0]:
                best = cost, Choice(offer, factors, options, fallen)
            if not left:
                break
        if best is None:
            raise NotProvedError(reason)
        return best[1]

    def _cost(self, left: Sequence[Option]) -> tuple[int, int]:
        """Of what is to be done; of limbs the hardest case first."""
        if self.asks_limbs:
            degrees = [_degree(option) for option in left]
            return max(degrees, default=0), sum(degrees)
        return 0, sum(1 + 4 * len(option.place.branch.pending) for option in left)

    def options(
        self,
        place: Place,
        factors: Sequence[tuple[Factor, int]],
        known: dict[str, list[Option]] | None = None,
    ) -> list[list[Option]]:
        """By factor, its solutions; none where it vanishes nowhere."""
        found = []
        for own, _ in factors:
            if known is not None and own.key in known:
                found.append(known[own.key])
                continue
            options = (
                []
                if self.vanishes_nowhere(place.branch, own)
                else self.options_of(place, own)
            )
            if known is not None:
                known[own.key] = options
            found.append(options)
        return found

    def are_held(self, place: Place, offer: Offer) -> bool:
        """Whether a limb has a lower rank on all of a node than an offer says."""
        held = {str(primitive(p.value)) for p in place.branch.pending}
        return any(
            all(
                value == 0 or str(primitive(value)) in held
                for value in followed(place.branch, equations)[0]
            )
            for own in offer.fallen
            for equations in own
        )
