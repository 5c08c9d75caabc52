"""Ranks below which a limb falls on few loci: what it keeps where it is singular.

A limb that has lost one freedom has lost two on a smaller set, or nowhere.  Where that
is known once for all, nodes about several limbs need no minors of the limb's twists,
whose factors speak of coordinates and not of the limb.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import chain, combinations, islice

from screwkit.algebra.points import Point
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.conditions import Place, Problem
from screwkit.certificates.derivation import ProofSearch
from screwkit.certificates.equations_told import Unsolved
from screwkit.certificates.loop_equations import LoopEquations
from screwkit.certificates.minor_choice import Matrix
from screwkit.certificates.offer_choice import Choice
from screwkit.certificates.offers import minor_offers
from screwkit.certificates.records import Certificate, Floor, Node, Part
from screwkit.certificates.roots import NotProvedError

LEVELS = 2
"""Ranks below the one in general that are asked for."""

MOST_NODES = 60
"""Of the proof of one floor."""

MOST_CHOICES = 60
"""Of twists, in a minor."""

ROUNDS = 4
"""Of one floor, until its loci are those that are needed."""

CHOICES_OF_FREEDOMS = 8
"""Of a limb with loops inside, each of which gives several minors."""

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
        if at is None:
            raise NotProvedError("no exact posture was found")
        fewer: Iterator[Matrix | LoopEquations]
        if isinstance(matrix, Matrix):
            fewer = _fewer_twists(matrix, self.rank)
        else:
            fewer = _fewer_freedoms(matrix, self.rank, at, self.source)
        offers = chain.from_iterable(
            minor_offers(own, branch, at, self.source)
            for own in fewer
            if own.rank_at(*at) == self.rank
        )
        return self.chosen(place, offers), ()


def _fewer_twists(matrix: Matrix, count: int) -> Iterator[Matrix]:
    """The twists of a limb, so many at a time."""
    (columns,), (labels,) = matrix.limbs, matrix.labels
    for chosen in islice(combinations(range(len(columns)), count), MOST_CHOICES):
        own = tuple(columns[k] for k in chosen), tuple(labels[k] for k in chosen)
        yield replace(matrix, limbs=own[:1], labels=own[1:])


def _fewer_freedoms(
    matrix: LoopEquations, rank: int, at: tuple[Point, int], source: random.Random
) -> Iterator[LoopEquations]:
    """Loop equations without freedoms that would make the rank at a point larger."""
    if matrix.rank_at(*at) == rank:
        yield matrix
        return
    seen = set[tuple[str, ...]]()
    for _ in range(CHOICES_OF_FREEDOMS):
        left, order = matrix, [*matrix.freedoms]
        source.shuffle(order)
        for label in order:
            if left.rank_at(*at) == rank:
                break
            fewer = left.without(label)
            if fewer.rank_at(*at) >= rank:
                left = fewer
        if left.freedoms not in seen:
            seen.add(left.freedoms)
            yield left


def floors_of(problem: Problem, rank: int, *, itself: bool) -> tuple[Floor, ...]:
    """What is proved of a limb's rank where it is lower than in general.

    Args:
        problem: Of the limb's own twists, or its loop equations; its components are
            not looked at.
        rank: In general.
        itself: Whether it is asked for, too: of loop equations the limb's components
            are those where the platform may do less.

    Returns:
        By falling rank; none where no short proof was found.
    """
    found = []
    for size in range(rank - (not itself), max(0, rank - 1 - LEVELS), -1):
        with suppress(NotProvedError):
            found.append(_floor(problem, size))
    return tuple(found)


def _floor(problem: Problem, rank: int) -> Floor:
    """What is proved of one rank.

    A locus may be met before a larger one that holds it.  So the same is asked again
    where they are known, the larger ones first, and with those alone that are needed.

    Raises:
        NotProvedError: If no short proof was found.
    """
    needed: tuple[tuple[Polynomial, ...], ...] = ()
    for _ in range(ROUNDS):
        search = FloorSearch(replace(problem, components=needed, least=-1), rank)
        proof = search.node(Place(problem.root))
        loci = search.problem.components
        met = [loci[k] for k in sorted({n.component for n in proof.every} - {-1})]
        needed = tuple(sorted(met, key=len))
        if needed == loci:
            break
    ring = problem.root.ring
    told = (tuple(text(ring, e) for e in own) for own in loci)
    return Floor(rank, tuple(told), proof)


class LimbPart:
    """A part about a limb; its floors are looked for when they are asked for.

    Args:
        part: Without floors.
        problem: Of the limb's own twists, or its loop equations.
    """

    def __init__(self, part: Part, problem: Problem) -> None:
        self._part, self._problem = part, problem
        self._floors: tuple[Floor, ...] | None = None

    @property
    def told(self) -> Part:
        """The part, with its floors if anything asked for them."""
        return replace(self._part, floors=self._floors or ())

    @property
    def name(self) -> str:
        """Of the limb."""
        return self._part.limb

    @property
    def floors(self) -> tuple[Floor, ...]:
        """What is proved of the limb where it is singular."""
        if self._floors is None:
            part = self._part
            self._floors = floors_of(self._problem, part.rank, itself=bool(part.form))
        return self._floors

    def below(self, rank: int) -> tuple[tuple[str, ...], ...] | None:
        """Where the limb has a lower rank; None where that is not proved."""
        part = self._part
        if rank < part.rank or part.form:
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
    return [
        (own.limb, own.rank)
        for node in proof.every
        for own in node.limbs
        if not own.columns
    ]
