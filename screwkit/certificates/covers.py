"""Trees that lead from the equations of a component to all of its sheets.

Where the equations hold at singular postures alone they are met sheet by sheet: a
condition that is a product or can be solved is taken apart; what is left is met one
condition after the other, and where one of them says nothing of its unknown the search
goes on; or a sum of multiples of them says more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import chain, combinations, islice
from typing import TypeAlias

from screwkit.algebra.branches import Branch, without
from screwkit.algebra.eliminated_sums import sums_without
from screwkit.algebra.elimination import half_angle_steps
from screwkit.algebra.factors import Factor
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.substitution import linear_parts
from screwkit.algebra.sums_of_conditions import (
    Combination,
    equal_leads,
    without_symbols,
)
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.conditions import Place, Problem, with_conditions
from screwkit.certificates.derivation import ProofSearch
from screwkit.certificates.met_conditions import orders, standing_alone
from screwkit.certificates.records import Node
from screwkit.certificates.roots import NotProvedError
from screwkit.certificates.sheet_trials import SheetTrials, on_the_way
from screwkit.certificates.sums import (
    Sum,
    determinant_sum,
    solvable_sum,
    terms_of,
)

NODES = 1_500
"""Nodes of one tree, and of all that were tried for it."""

CONDITIONS = 12
"""Unsolved conditions at a node."""

SHORT = 48
"""Nodes of one in which all is solved that can be, which shows more."""

WORK = 12_000
"""Terms of unsolved conditions at all of them together."""

TRIED = 3
"""Ways to go on at a node that leave something open."""

LONGEST = 400
"""Terms of a sum of conditions that is kept."""


_Way: TypeAlias = Callable[[], Node | None]


@dataclass
class CoverSearch(ProofSearch):
    """One tree under way.

    Attributes:
        equations: How many conditions it starts with.
        solves: Whether conditions that stand alone are solved first.
        under_way: Nodes on the way, by the number of their steps and their conditions.
        work: Terms of unsolved conditions at all nodes so far.
    """

    equations: int = 0
    solves: bool = True
    under_way: set[tuple[str, ...]] = field(default_factory=set, init=False)
    work: int = field(default=0, init=False)

    @property
    def is_long(self) -> bool:
        """Whether the search is given up."""
        most = SHORT if self.solves else NODES
        return self.count > most or self.work > WORK

    def node(self, place: Place) -> Node:
        """A condition that is a product or can be solved; a sheet; or a sum."""
        branch, number = place.branch, self.count
        self.count += 1
        self.work += sum(len(pending.value) for pending in branch.pending)
        if self.is_long or len(branch.pending) > CONDITIONS:
            raise NotProvedError("the equations have too many sheets")
        if len(branch.steps) + bool(branch.pending) > self.equations:
            return Node(number, small=True)
        ended = self.ended(place, number)
        if ended is not None:
            return ended
        values = sorted(str(own.value) for own in branch.pending)
        key = (str(len(branch.steps)), *values)
        if key in self.under_way:
            raise NotProvedError("the search for sheets goes in a circle")
        self.under_way.add(key)
        try:
            found = self.gone_on(place, number)
        finally:
            self.under_way.remove(key)
        self.finish(number, place)
        return found

    def gone_on(self, place: Place, number: int) -> Node:
        """The node of what is neither small nor ended.

        Conditions that stand alone have sheets, on each of which the same would follow:
        they may be solved where too few dimensions are left, and met elsewhere.
        """
        branch = place.branch
        standing = () if self.solves else standing_alone(branch, branch.pending)
        alone = [own for met in standing for own in met.pending]
        left = tuple(own for own in branch.pending if own not in alone)
        if len(branch.steps) + len(alone) + bool(left) > self.equations:
            found = self.split_condition(place, number)
        else:
            narrow = replace(place, branch=replace(branch, pending=left))
            found = (
                self.of_a_pair(place, number)
                or self.split_condition(place, number, left)
                or self.of_a_remainder(place, number)
                or self.special_of_all(place, number)
                or self.first(self.ways(place, narrow, number))
            )
        if found is None:
            raise NotProvedError("the conditions of a sheet cannot be met one by one")
        return found

    def first(self, ways: Iterator[_Way]) -> Node | None:
        """What the first of several ways that ends leads to."""
        for way in ways:
            before = len(self.finished)
            try:
                found = way()
            except NotProvedError:
                if self.is_long:
                    raise
                found = None
            if found is not None:
                return found
            del self.finished[before:]  # nodes that are in no tree
        return None

    def ways(self, place: Place, narrow: Place, number: int) -> Iterator[_Way]:
        """Ways to go on, those that leave little first.

        Args:
            place: The node.
            narrow: Without conditions that stand alone.
            number: Of the node.
        """
        plain = Node(number, sheet=True)
        if len(place.branch.pending) < 2 and self.seen(place, plain) is not None:
            yield lambda: plain
            return
        sheets = [
            (sum(self.cost(place, met) for met in order), order)
            for order in orders(place)
        ]
        sheets.sort(key=lambda own: own[0] > 0)
        held = (
            own
            for own in sheets
            if self.seen(place, self.bare_sheet(place, number, own[1])) is not None
        )
        first = next(held, None)
        if first is not None and not first[0]:
            yield partial(self.sheet_of, place, number, first[1])
            return
        if self.seen(place, plain) is not None:
            yield lambda: plain
            return
        for maker in (solvable_sum, determinant_sum):
            yield partial(self.of_a_sum, place, number, maker(self, narrow))
        if first is not None:
            for _, order in islice(chain([first], held), TRIED):
                yield partial(self.sheet_of, place, number, order)
        for found in islice(self.sums(narrow), TRIED):
            yield partial(self.of_a_sum, place, number, found)

    # -- sheets ----------------------------------------------------------------------

    def special_of_all(self, place: Place, number: int) -> Node | None:
        """The node of tied dimensions, where its conditions can be met."""
        try:
            found = self.special(place, number)
        except NotProvedError:
            return None
        return None if found is None or self.seen(place, found) is None else found

    def seen(self, place: Place, node: Node) -> int | None:
        """How many parts of the component the checker sees on a sheet.

        None where it does not take the sheet, or that dimensions are tied.
        """
        trials = self.trials
        return None if trials is None else trials.seen(*on_the_way(place), node)

    # -- sums ------------------------------------------------------------------------

    def of_a_pair(self, place: Place, number: int) -> Node | None:
        """Two conditions that give an angle together: a form in half angles twice.

        The sum of their squares vanishes where both do.
        """
        branch, ring = place.branch, place.branch.ring
        for one, two in combinations(branch.pending, 2):
            first, second = one.value, two.value
            steps = half_angle_steps(ring, branch.assumptions, first, [second])
            if not steps:
                continue
            own = Factor(f"pair {first} {second}", (first, second))
            times = tuple(
                p.value if p in (one, two) else ring.zero for p in branch.pending
            )
            total = ring.normal(first * first + second * second)
            numbers = [place.number(pending) for pending in branch.pending]
            terms = terms_of(place, numbers, Combination(total, times))
            options = [self.options_of(place, own)]
            cases = self.cases(place, [(own, 2)], options)
            return Node(number, combination=terms, cases=cases)
        return None

    def of_a_remainder(self, place: Place, number: int) -> Node | None:
        """A symbol taken out of a condition by one that is linear in it.

        Where its coefficient vanishes nowhere, or for special dimensions alone, what is
        left of the condition says the same.
        """
        branch, ring = place.branch, place.branch.ring
        values = [pending.value for pending in branch.pending]
        numbers = [place.number(pending) for pending in branch.pending]
        usable = self.is_divisor(branch)
        settled = self.settled(values, branch)
        for found in without_symbols(ring, values, usable):
            if any(found.times[k] != 0 for k in settled - {found.about}):
                continue  # nor is it undone what was done before
            kept = branch.value(found.value)
            before = replace(place, branch=without(branch, branch.pending[found.about]))
            factors = [] if kept == 0 else self.factors(branch, kept)
            if kept == 0 or self.is_held(before, factors):  # the condition is implied
                return self.gone_on(before, number)
            options = self.options(before, factors)
            cases = self.cases(before, factors, options)
            terms = terms_of(place, numbers, found)
            return Node(number, combination=terms, cases=cases)
        return None

    def settled(self, values: Sequence[Polynomial], branch: Branch) -> set[int]:
        """Conditions that give a symbol of the posture which no other one holds."""
        ring, usable = branch.ring, self.is_divisor(branch)
        found = set()
        for number, value in enumerate(values):
            others = [own for k, own in enumerate(values) if k != number]
            for index in ring.symbol_indices():
                if value.degrees()[index] != 1 or any(
                    own.degrees()[index] for own in others
                ):
                    continue
                if usable(index, linear_parts(ring, value, index)[0]):
                    found.add(number)
        return found

    def is_divisor(self, branch: Branch) -> Callable[[int, Polynomial], bool]:
        """Tells symbols of the posture and coefficients that vanish nowhere there."""

        def usable(index: int, lead: Polynomial) -> bool:
            if index in branch.dimensions:
                return False
            own = Factor(str(lead), (lead,))
            return self.is_of_dimensions(branch, own) or (
                branch.assumptions.is_nonzero(branch.ring, lead)
            )

        return usable

    def sums(self, place: Place) -> Iterator[Sum]:
        """Sums of conditions that say something new, those that leave little first."""
        branch, ring = place.branch, place.branch.ring
        values = [pending.value for pending in branch.pending]
        if len(values) < 2:
            return
        numbers = [place.number(pending) for pending in branch.pending]
        found = list[tuple[int, int, Sum]]()
        for own in self._combinations(place, values):
            value = branch.value(own.value)
            if value == 0 or len(value) > LONGEST:
                continue
            factors = self.factors(branch, value)
            if not factors or self.is_held(place, factors):
                continue
            left = [
                f
                for f, _ in factors
                if not self.vanishes_nowhere(branch, f)
                and not self.is_of_dimensions(branch, f)
            ]
            cost = sum(
                (1 if self.steps(branch, f) is not None else 4)
                * len({*unknowns(ring, f.equations[0])})
                + len(f.equations[0])
                for f in left
            )
            terms = terms_of(place, numbers, own)
            found.append((cost, len(found), Sum(terms, tuple(factors))))
        yield from (own for _, _, own in sorted(found, key=lambda own: own[:2]))

    def _combinations(
        self, place: Place, values: Sequence[Polynomial]
    ) -> Iterator[Combination]:
        branch, ring = place.branch, place.branch.ring
        dimensions = [("x", index) for index in branch.dimensions]
        angles = {u for v in values for u in unknowns(ring, v) if u[0] == "angle"}
        eliminated = (
            sums_without(ring, values, [*dimensions, *kept])
            for kept in ([], *([angle] for angle in sorted(angles)))
        )
        return chain(
            equal_leads(ring, values),
            without_symbols(ring, values),
            *eliminated,
        )


def cover_of(
    problem: Problem,
    equations: tuple[Polynomial, ...],
    trials: SheetTrials,
) -> Node | None:
    """The tree of some equations; None where none was found.

    Args:
        problem: Of the mechanism; its components are known to be singular everywhere.
        equations: Of the component.
        trials: Asks whether a sheet will be taken.
    """
    start = with_conditions(problem.root, (*problem.demands, *equations))
    for solves in (True, False):
        search = CoverSearch(problem, 0, trials=trials, solves=solves)
        search.equations = len(equations) + len(problem.demands)
        try:
            return search.node(Place(start, (*problem.demands, *equations)))
        except (NotProvedError, ValueError):
            continue
    return None
