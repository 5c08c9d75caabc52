"""Looks for the proof that a list of components is the whole singular locus.

It starts from the list alone, however that was found.  On each node a minor is taken
that is not zero there and has few factors; where a factor vanishes, the posture lies on
a component, or the search goes on there with another minor.

References: [CoxLittleOShea] §9.1; docs/decisions/0019-certificates.md.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import islice

from screwkit.algebra.branches import Branch, Pending, without
from screwkit.algebra.factors import Factor
from screwkit.algebra.points import Point
from screwkit.algebra.trigonometric import primitive
from screwkit.certificates.conditions import (
    Place,
    Problem,
    with_conditions,
)
from screwkit.certificates.equations_told import Unsolved
from screwkit.certificates.limb_offers import limb_offers
from screwkit.certificates.met_conditions import orders
from screwkit.certificates.offer_choice import LONGEST, Choice
from screwkit.certificates.offers import minor_offers
from screwkit.certificates.records import Node
from screwkit.certificates.roots import NotProvedError
from screwkit.certificates.sheet_nodes import SheetNodes
from screwkit.certificates.sheet_trials import SheetTrials, on_the_way
from screwkit.certificates.steps import (
    followed,
)
from screwkit.certificates.sums import (
    Sum,
    determinant_sum,
    equation_times_dimensions,
    implied_equation,
    paired_equation,
    solvable_sum,
    sum_by_cramer,
    sum_without_angles,
    sum_without_symbol,
)
from screwkit.certificates.symbolic_roots import rootless_condition

NODES = 600
"""Nodes of one proof by minors of the whole matrix."""

NODES_OF_LIMBS = 1_200
"""Nodes of one proof that asks limbs; these are short."""

NODES_OF_LATE = 4_000
"""Nodes of one proof with late sums, which is looked for where others failed."""

LONGEST_OF_LATE = 2_000
"""Terms of a minor that is factored in such a proof: its many nodes are to be quick."""

SHEETS = 6
"""Orders in which conditions are met, at a node."""

MIXED = 3
"""Unsolved conditions from which on no further one is added to tell postures apart."""

DEEPEST = 16
"""Unsolved conditions on the way to a node."""


@dataclass
class ProofSearch(SheetNodes):
    """One proof under way.

    Attributes:
        rank: Of the matrix in general.
        late: Whether sums that leave more than one case unsolved come after minors.
        patient: Whether squares of axes are looked for among what conditions imply, and
            sums by Cramer's rule where nothing else helps: these take long.
        trials: Asks whether sheets lie on components; None: it is not tried.
        source: Of the choice of minors.
    """

    rank: int
    late: bool = False
    patient: bool = False
    trials: SheetTrials | None = None
    source: random.Random = field(default_factory=lambda: random.Random(5))

    # -- one node --------------------------------------------------------------------

    def node(self, place: Place) -> Node:
        """The proof of one node and everything below it."""
        number = self.count
        self.count += 1
        most = NODES_OF_LIMBS if self.asks_limbs else NODES
        most = NODES_OF_LATE if self.late else most
        if self.count > most or len(place.conditions) > DEEPEST:
            raise NotProvedError("the proof would be too long")
        ended = self.ended(place, number)
        if ended is not None:
            return ended
        found = (
            self.of_a_sum(place, number, paired_equation(self, place))
            or self.split_condition(place, number)
            or self.of_a_sum(place, number, solvable_sum(self, place))
            or self.of_a_sum(place, number, determinant_sum(self, place))
            or self.of_a_sum(place, number, rootless_condition(self, place))
            or (
                self.of_a_sum(place, number, sum_without_symbol(self, place))
                if self.late
                else None
            )
            or self.special(place, number)
            or self.of_a_sum(place, number, self.implied(place))
            or self.on_components(place, number)
            or self.without_points(place, number)
            or self.by_limbs(place, number)
            or self.by_minor(place, number)
        )
        self.finish(number, place)
        return found

    # -- products --------------------------------------------------------------------

    def split_condition(
        self, place: Place, number: int, chosen: Sequence[Pending] | None = None
    ) -> Node | None:
        """The node of a condition that can be factored, or solved, by now.

        Args:
            place: The node.
            number: Of the node.
            chosen: Conditions that may be taken; by default all of them.
        """
        branch = place.branch
        for pending in branch.pending if chosen is None else chosen:
            factors = self.factors(branch, pending.value)
            same = len(factors) == 1 and str(factors[0][0].equations[0]) in (
                str(pending.value),
                str(primitive(pending.value)),
            )
            if same and self.steps(branch, factors[0][0]) is None:
                continue
            if self.says_nothing(place, pending, factors):
                continue
            index = place.number(pending)
            _, over = followed(branch, [place.conditions[index]])
            before = replace(place, branch=without(branch, pending))
            options = self.options(before, factors)
            cases = self.cases(before, factors, options)
            return Node(number, condition=index, over=over, cases=cases)
        return None

    def of_a_sum(self, place: Place, number: int, found: Sum | None) -> Node | None:
        """The node of a sum of multiples of conditions, where there is one."""
        if found is None or self.is_held(place, found.factors):
            return None
        options = self.options(place, found.factors)
        cases = self.cases(place, found.factors, options)
        return Node(number, combination=found.terms, cases=cases)

    def implied(self, place: Place) -> Sum | None:
        """What follows for components; of a late search only where no case is kept."""
        if self.late:
            found = equation_times_dimensions(self, place)
            if found is not None:
                return found
        found = implied_equation(self, place, axes=self.patient)
        if found is None or not self.late:
            return found
        return found if len(self.left_open(place, found)) < 2 else None

    def left_open(self, place: Place, found: Sum) -> list[Factor]:
        """The factors of a sum that are neither solved nor end at once."""
        branch = place.branch
        return [
            own
            for own, _ in found.factors
            if not self.vanishes_nowhere(branch, own)
            and not self.is_of_dimensions(branch, own)
            and self.steps(branch, own) is None
        ]

    def special(self, place: Place, number: int) -> Node | None:
        """The node of dimensions that are tied to each other."""
        branch = place.branch
        if not branch.points or not branch.is_special:
            return None
        roots = self.roots(branch)
        return Node(number, special=True, roots=roots)

    def on_components(self, place: Place, number: int) -> Node | None:
        """The node of conditions all of whose sheets lie on components."""
        branch, trials = place.branch, self.trials
        if trials is None or not branch.points or not branch.pending:
            return None
        if not any(self.all_vanish(e, branch) for e in self.problem.components):
            return None
        for order in islice(orders(place), SHEETS):
            bare = self.bare_sheet(place, number, order)
            if trials.lie_on_components(*on_the_way(place), bare):
                return self.sheet_of(place, number, order)
        return None

    def without_points(self, place: Place, number: int) -> Node | None:
        """The node of a sum in few unknowns, where no exact posture was found."""
        if place.branch.points or not place.branch.pending:
            return None
        return self.of_a_sum(place, number, sum_without_angles(self, place))

    def by_minor(self, place: Place, number: int) -> Node:
        """The node of the minor that leaves the fewest cases.

        Where there is none, of a sum without some symbols, or in few unknowns.
        """
        try:
            choice, roots = self.chosen_minor(place)
        except NotProvedError:
            found = None
            if self.patient or self.has_loops_inside:
                found = self.of_a_sum(place, number, sum_by_cramer(self, place))
            found = found or self.of_a_sum(
                place, number, sum_without_angles(self, place)
            )
            if found is None:
                raise
            return found
        return self.said(place, number, choice, roots)

    @property
    def has_loops_inside(self) -> bool:
        """Whether limbs with loops inside are asked: minors of the whole are long."""
        return self.asks_limbs and not all(own.is_chain for own in self.problem.limbs)

    def chosen_minor(self, place: Place) -> tuple[Choice, tuple[Unsolved, ...]]:
        """The minor that leaves the fewest cases, and how conditions are met.

        Raises:
            NotProvedError: If there is none that says something new.
        """
        branch, matrix = place.branch, self.problem.matrix
        at = max(branch.points, key=lambda p: matrix.rank_at(*p), default=None)
        if at is None or self.falls(at):
            # A minor that vanishes on some of the postures here may tell them apart.
            at = self.wider(branch, MIXED)
            if at is None or self.falls(at):
                raise NotProvedError(
                    "the search ended at postures that it could place on no component"
                )
        rank = matrix.rank_at(*at)
        if rank > self.rank and not self.problem.smaller:
            raise NotProvedError("postures of lower rank were not told from others")
        roots: tuple[Unsolved, ...] = ()
        if self.problem.smaller and rank < self.rank:
            roots = self.roots(branch)
        offers = minor_offers(matrix, branch, at, self.source)
        return self.chosen(place, offers), roots

    def by_limbs(self, place: Place, number: int) -> Node | None:
        """The node of what limbs say alone; None where they do not say enough."""
        if not self.asks_limbs:
            return None
        branch, problem = place.branch, self.problem
        wanted = -1 if problem.moving else self.rank
        library, source = problem.library, self.source
        shown = partial(self.multiples, place)
        for at in self.off_the_locus(branch):
            offers = limb_offers(
                problem.limbs, branch, at, library, wanted, source, shown
            )
            try:
                choice = self.chosen(place, offers)
            except NotProvedError:
                continue
            return self.said(place, number, choice)
        return None

    def off_the_locus(self, branch: Branch) -> Iterator[tuple[Point, int]]:
        """Postures that do not belong to the locus.

        Where none on the branch is known, some at which all but one of its conditions
        hold, the later ones first: what is seen there may tell the postures apart.
        """
        matrix = self.problem.matrix
        for left_out in (None, *reversed(branch.pending)):
            kept = branch if left_out is None else without(branch, left_out)
            at = max(kept.points, key=lambda p: matrix.rank_at(*p), default=None)
            if at is not None and not self.falls(at):
                yield at
                if left_out is None:
                    return

    def said(
        self,
        place: Place,
        number: int,
        choice: Choice,
        roots: tuple[Unsolved, ...] = (),
    ) -> Node:
        """The node of an offer, with everything below it."""
        node = choice.offer.node
        limbs = tuple(
            replace(own, fallen=tuple(self.on_sheet(option) for option in options))
            for own, options in zip(node.limbs, choice.fallen, strict=True)
        )
        cases = self.cases(place, choice.factors, choice.options)
        return replace(node, number=number, roots=roots, limbs=limbs, cases=cases)

    def falls(self, at: tuple[Point, int]) -> bool:
        """Whether a posture belongs to the locus."""
        matrix, least = self.problem.matrix, self.problem.least
        if self.problem.moving:
            return matrix.freedom_at(*at) > 0
        if least >= 0:
            return matrix.freedom_at(*at) < least
        return matrix.rank_at(*at) < self.rank


def proof_of(
    problem: Problem,
    *,
    asks_limbs: bool,
    late: bool = False,
    patient: bool = False,
    trials: SheetTrials | None = None,
) -> Node:
    """A proof that nothing is missing from a list of components.

    Args:
        problem: With the list.
        asks_limbs: Whether limbs are asked before minors of the whole matrix, which may
            be products all the same.
        late: Whether sums that leave more than one case unsolved come after minors.
        patient: Whether it looks for more sums, where nothing else is left.
        trials: Asks whether sheets lie on components.

    Raises:
        NotProvedError: If none was found.
    """
    points = problem.closed or problem.root.points
    if not points:
        raise NotProvedError("the mechanism has no exact posture")
    rank = max(problem.matrix.rank_at(*at) for at in points)
    start = with_conditions(problem.root, problem.demands)
    longest = LONGEST_OF_LATE if late else LONGEST
    search = ProofSearch(
        problem,
        rank,
        late,
        patient,
        trials=trials,
        longest=longest,
        asks_limbs=asks_limbs,
    )
    return search.node(Place(start, problem.demands))
