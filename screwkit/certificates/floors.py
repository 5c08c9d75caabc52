"""Ranks below which a limb falls on few loci: what it keeps where it is singular.

A limb that has lost one freedom has lost two on a smaller set, or nowhere.  Where that
is known once for all, nodes about several limbs need no minors of the limb's twists,
whose factors speak of coordinates and not of the limb.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import chain, combinations, islice

from screwkit.algebra.polynomial_text import text
from screwkit.certificates.conditions import Place, Problem
from screwkit.certificates.derivation import ProofSearch
from screwkit.certificates.minor_choice import Matrix
from screwkit.certificates.offer_choice import Choice
from screwkit.certificates.offers import minor_offers
from screwkit.certificates.records import (
    Certificate,
    Floor,
    Node,
    Part,
    Unsolved,
)
from screwkit.certificates.roots import NotProvedError

LEVELS = 2
"""Ranks below the one in general that are asked for."""

MOST_NODES = 60
"""Of the proof of one floor."""

MOST_CHOICES = 60
"""Of twists, in a minor."""

MOST_LOCI = 6
"""On which the rank may be lower still."""


@dataclass
class FloorSearch(ProofSearch):
    """A proof under way that lists by itself where the rank is lower."""

    def node(self, place: Place) -> Node:
        """The proof of one node and everything below it."""
        if self.count >= MOST_NODES:
            raise NotProvedError("the proof would be too long")
        return super().node(place)

    def by_minor(self, place: Place, number: int) -> Node:
        """The node of a minor; where the rank is lower, of one more locus."""
        branch = place.branch
        if not branch.points or not all(map(self.falls, branch.points)):
            return super().by_minor(place, number)
        known = self.problem.components
        loci = (*known, branch.equations(()))[:MOST_LOCI]
        for k, equations in enumerate(loci):
            multiples = self.multiples(place, equations)
            if multiples is not None:
                components = known if k < len(known) else loci
                self.problem = replace(self.problem, components=components)
                return Node(number, component=k, multiples=multiples)
        raise NotProvedError("the rank is lower on too many sets")

    def chosen_minor(self, place: Place) -> tuple[Choice, tuple[Unsolved, ...]]:
        """The minor of the floor's size that leaves the fewest cases.

        Raises:
            NotProvedError: If there is none that says something new.
        """
        branch, matrix = place.branch, self.problem.matrix
        at = max(branch.points, key=lambda p: matrix.rank_at(*p), default=None)
        if at is None or not isinstance(matrix, Matrix):
            raise NotProvedError("no exact posture was found")
        offers = chain.from_iterable(
            minor_offers(own, branch, at, self.source)
            for own in _fewer(matrix, self.rank)
            if own.rank_at(*at) == self.rank
        )
        return self.chosen(place, offers), ()


def _fewer(matrix: Matrix, count: int) -> Iterator[Matrix]:
    """The twists of a limb, so many at a time."""
    (columns,), (labels,) = matrix.limbs, matrix.labels
    for chosen in islice(combinations(range(len(columns)), count), MOST_CHOICES):
        own = tuple(columns[k] for k in chosen), tuple(labels[k] for k in chosen)
        yield replace(matrix, limbs=own[:1], labels=own[1:])


def floors_of(problem: Problem, rank: int) -> tuple[Floor, ...]:
    """What is proved of a limb's rank where it is lower than in general.

    Args:
        problem: Of the limb's own twists; its components are not looked at.
        rank: In general.

    Returns:
        By falling rank; none where no short proof was found.
    """
    found = []
    for size in range(rank - 1, max(0, rank - 1 - LEVELS), -1):
        search = FloorSearch(replace(problem, components=()), size)
        try:
            proof = search.node(Place(problem.root))
        except NotProvedError:
            continue
        ring = problem.root.ring
        loci = tuple(
            tuple(text(ring, equation) for equation in equations)
            for equations in search.problem.components
        )
        found.append(Floor(size, loci, proof))
    return tuple(found)


class LimbPart:
    """A part about a limb; its floors are looked for when they are asked for.

    Args:
        part: Without floors.
        problem: Of the limb's own twists.
    """

    def __init__(self, part: Part, problem: Problem) -> None:
        self._part, self._problem = part, problem
        self._floors: tuple[Floor, ...] | None = None

    @property
    def told(self) -> Part:
        """The part, with its floors if anything asked for them."""
        return replace(self._part, floors=self._floors or ())

    @property
    def floors(self) -> tuple[Floor, ...]:
        """What is proved of the limb where it is singular."""
        if self._floors is None:
            self._floors = floors_of(self._problem, self._part.rank)
        return self._floors

    def below(self, rank: int) -> tuple[tuple[str, ...], ...] | None:
        """Where the limb has a lower rank; None where that is not proved."""
        part = self._part
        if rank < part.rank:
            found = (floor.loci for floor in self.floors if floor.rank == rank)
            return next(found, None)
        if rank > part.rank or part.proof is None:
            return None
        return tuple(locus.equations for locus in part.components)


def without_idle_floors(certificate: Certificate) -> Certificate:
    """A certificate with those floors alone on which its proofs rest."""
    used = set[tuple[str, int]]()
    for part in certificate.parts:
        if part.proof is not None and part.question != "limb":
            used |= set(_rested_on(part.proof))
    parts = tuple(
        replace(
            part,
            floors=tuple(f for f in part.floors if (part.limb, f.rank) in used),
        )
        for part in certificate.parts
    )
    return replace(certificate, parts=parts)


def _rested_on(proof: Node) -> list[tuple[str, int]]:
    """(limb, rank) of what a proof takes from the parts of limbs."""
    found, waiting = [], [proof]
    while waiting:
        node = waiting.pop()
        found += [(own.limb, own.rank) for own in node.limbs if not own.columns]
        waiting += node.below
    return found
