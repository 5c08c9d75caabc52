"""Looks for the proof that a list of components is the whole singular locus.

It starts from the list alone, however that was found.  On each node a minor is taken
that is not zero there and has few factors; where a factor vanishes, the posture lies on
a component, or the search goes on there with another minor.

References: [CoxLittleOShea] §9.1; docs/decisions/0019-certificates.md.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from screwkit.algebra.branches import without
from screwkit.algebra.factors import Factor
from screwkit.algebra.points import Point
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.certificates.conditions import (
    Conditions,
    Option,
    Place,
    Problem,
    with_conditions,
)
from screwkit.certificates.minor_choice import Minor
from screwkit.certificates.records import Case, Node, Sheet, Unsolved
from screwkit.certificates.roots import NotProvedError
from screwkit.certificates.steps import (
    followed,
    numbers_of,
    written_step,
)
from screwkit.certificates.sums import (
    Sum,
    determinant_sum,
    implied_equation,
    paired_equation,
    solvable_sum,
    sum_without_angles,
)
from screwkit.certificates.texts import read
from screwkit.certificates.whole_equations import with_whole_equations

NODES = 600
"""Nodes of one proof."""

LONGEST = 60_000
"""Terms of a minor that is factored."""

MIXED = 3
"""Unsolved conditions from which on no further one is added to tell postures apart."""

DEEPEST = 16
"""Unsolved conditions on the way to a node."""

MANY = 3_000
"""Terms of a minor beside which no other one is expanded."""

LOOKED_AT = 4
"""Minors whose cases are all looked at before one is chosen."""


_Candidate: TypeAlias = tuple[int, int, Minor, list[tuple[Factor, int]]]
_Chosen: TypeAlias = tuple[
    Minor,
    list[tuple[Factor, int]],
    list[list[Option]],
    int,
    tuple[Unsolved, ...],
]


@dataclass
class ProofSearch(Conditions):
    """One proof under way.

    Attributes:
        rank: Of the matrix in general.
        count: Nodes so far.
        finished: Their numbers, with what tells their postures.
        source: Of the choice of minors.
    """

    rank: int
    count: int = 0
    finished: list[tuple[int, tuple[Polynomial, ...]]] = field(default_factory=list)
    source: random.Random = field(default_factory=lambda: random.Random(5))

    # -- one node --------------------------------------------------------------------

    def node(self, place: Place) -> Node:
        """The proof of one node and everything below it."""
        number = self.count
        self.count += 1
        if self.count > NODES or len(place.conditions) > DEEPEST:
            raise NotProvedError("the proof would be too long")
        ended = self.ended(place, number)
        if ended is not None:
            return ended
        found = (
            self.of_a_sum(place, number, paired_equation(self, place))
            or self.split_condition(place, number)
            or self.of_a_sum(place, number, solvable_sum(self, place))
            or self.of_a_sum(place, number, determinant_sum(self, place))
            or self.special(place, number)
            or self.of_a_sum(place, number, implied_equation(self, place))
            or self.without_points(place, number)
            or self.by_minor(place, number)
        )
        self.finished.append((number, self.equations(place)))
        return found

    def equations(self, place: Place) -> tuple[Polynomial, ...]:
        """What tells the postures of a node."""
        branch = place.branch
        sheets = {str(sheet) for sheet in branch.sheets}
        return (*branch.equations(sheets), *place.conditions)

    def ended(self, place: Place, number: int) -> Node | None:
        """Why nothing is to be done on a node; None where something is."""
        branch = place.branch
        for label, square in self.problem.axes.items():
            multiples = self.multiples(place, [square])
            if multiples is None:
                multiples = self.multiples(place, self.problem.directions[label])
            if multiples is not None:
                return Node(number, axis=label, multiples=multiples)
        for k, equations in enumerate(self.problem.components):
            if not branch.points or self.all_vanish(equations, branch):
                multiples = self.multiples(place, equations)
                if multiples is not None:
                    return Node(number, component=k, multiples=multiples)
        for earlier, equations in self.finished:
            if (
                branch.points
                and self.all_vanish(equations, branch)
                and self.surely(place, equations)
            ):
                return Node(number, earlier=earlier)
        return None

    # -- products --------------------------------------------------------------------

    def split_condition(self, place: Place, number: int) -> Node | None:
        """The node of a condition that can be factored, or solved, by now."""
        branch = place.branch
        for pending in branch.pending:
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
        if found is None:
            return None
        options = self.options(place, found.factors)
        cases = self.cases(place, found.factors, options)
        return Node(number, combination=found.terms, cases=cases)

    def special(self, place: Place, number: int) -> Node | None:
        """The node of dimensions that are tied to each other."""
        branch = place.branch
        if not branch.points or not branch.is_special:
            return None
        roots = self.roots(branch)
        return Node(number, special=True, roots=roots)

    def without_points(self, place: Place, number: int) -> Node | None:
        """The node of a sum in few unknowns, where no exact posture was found."""
        if place.branch.points or not place.branch.pending:
            return None
        return self.of_a_sum(place, number, sum_without_angles(self, place))

    def by_minor(self, place: Place, number: int) -> Node:
        """The node of the minor that leaves the fewest cases.

        Where there is none, of a sum in few unknowns.
        """
        try:
            chosen = self.chosen_minor(place)
        except NotProvedError:
            found = self.of_a_sum(place, number, sum_without_angles(self, place))
            if found is None:
                raise
            return found
        minor, factors, options, rank, roots = chosen
        matrix = self.problem.matrix
        labels = [x for own in matrix.labels for x in own]
        return Node(
            number,
            rank=rank,
            roots=roots,
            rows=tuple(matrix.row(row) for row in minor.rows),
            columns=tuple(labels[k] for k in minor.columns),
            over=minor.over,
            cases=self.cases(place, factors, options),
        )

    def chosen_minor(self, place: Place) -> _Chosen:
        """The minor that leaves the fewest cases, with their options.

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
        vanishing = {str(primitive(p.value)) for p in branch.pending}
        candidates: list[_Candidate] = []
        for minor in matrix.minors(branch, *at, self.source):
            factors = self.product(branch, minor.parts, LONGEST)
            if factors is not None:
                factors = with_whole_equations(self, place, factors)
                if any(own.key in vanishing for own, _ in factors):
                    continue  # it says nothing here
                open_ones = [f for f, _ in factors if not self.positive(branch, f)]
                weight = sum(3 + len(f.equations[0]) for f in open_ones)
                candidates.append((weight, len(candidates), minor, factors))
                if not open_ones or minor.terms > MANY:
                    break
        if not candidates:
            raise NotProvedError("every minor is too long, or says nothing new")
        candidates.sort(key=lambda candidate: candidate[:2])
        known: dict[str, list[Option]] = {}
        reason = ""
        best = None
        for _, order, minor, factors in candidates[:LOOKED_AT]:
            try:
                options = self.options(place, factors, known)
            except NotProvedError as error:
                reason = str(error)
                continue
            left = sum(
                1 + 4 * len(option.place.branch.pending)
                for own in options
                for option in own
                if self.is_open(option)
            )
            if best is None or (left, order) < best[0]:
                best = (left, order), minor, factors, options
            if not left:
                break
        if best is None:
            raise NotProvedError(reason)
        _, minor, factors, options = best
        return minor, factors, options, rank, roots

    def falls(self, at: tuple[Point, int]) -> bool:
        """Whether a posture belongs to the locus."""
        matrix, least = self.problem.matrix, self.problem.least
        if self.problem.moving:
            return matrix.freedom_at(*at) > 0
        if least >= 0:
            return matrix.freedom_at(*at) < least
        return matrix.rank_at(*at) < self.rank

    # -- cases -----------------------------------------------------------------------

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

    def is_open(self, option: Option) -> bool:
        """Whether work is left there."""
        branch = option.place.branch
        if option.impossible is not None or (branch.points and branch.is_special):
            return False
        return self.ended(option.place, -1) is None

    def cases(
        self,
        place: Place,
        factors: Sequence[tuple[Factor, int]],
        options: Sequence[Sequence[Option]],
    ) -> tuple[Case, ...]:
        """Every factor with what follows on it, simple ones first."""
        order = sorted(
            range(len(factors)),
            key=lambda i: (
                any(option.step is None for option in options[i]),
                len(factors[i][0].equations[0]),
            ),
        )
        paired = any(len(own.equations) > 1 for own, _ in factors)
        return tuple(
            self.case(place, *factors[i], options[i], paired=paired) for i in order
        )

    def case(
        self,
        place: Place,
        own: Factor,
        power: int,
        options: Sequence[Option],
        *,
        paired: bool,
    ) -> Case:
        """One factor with what follows on it."""
        branch = place.branch
        ring = branch.ring
        texts = tuple(text(ring, equation) for equation in own.equations)
        case = Case(texts, power)
        if not options:
            if self.positive(branch, own):
                return replace(case, end="positive")
            divisor = self.in_divisor(branch, own)
            if divisor is not None:
                return replace(case, end="divisor", divisor=divisor)
            angle, numbers = numbers_of(ring, own.equations[0])
            end = "elsewhere" if self.elsewhere(branch, own) else "unreal"
            return replace(case, end=end, angle=angle, numbers=numbers)
        if self.is_of_dimensions(branch, own):
            return replace(case, end="special")
        if options[0].step is None:
            return replace(case, kept=self.node(options[0].place))
        sheets = list[Sheet]()
        for option in options:
            last = len(option.place.branch.steps) - 1
            step = written_step(option.place.branch, last)
            sheets.append(Sheet(step, self.on_sheet(option)))
        return replace(case, sheets=tuple(sheets))

    def on_sheet(self, option: Option) -> Node:
        """The node of one solution."""
        if option.impossible is None:
            return self.node(option.place)
        number = self.count
        self.count += 1
        index = option.place.number(option.impossible)
        branch = option.place.branch
        (value,), over = followed(branch, [option.place.conditions[index]])
        written = text(branch.ring, value)
        if not self.problem.signs.never_zero(read(written)):
            raise NotProvedError("a condition that vanishes nowhere was not proved so")
        return Node(number, impossible=index, impossible_value=written, over=over)


def proof_of(problem: Problem) -> Node:
    """A proof that nothing is missing from a list of components.

    Raises:
        NotProvedError: If none was found.
    """
    points = problem.closed or problem.root.points
    if not points:
        raise NotProvedError("the mechanism has no exact posture")
    rank = max(problem.matrix.rank_at(*at) for at in points)
    start = with_conditions(problem.root, problem.demands)
    return ProofSearch(problem, rank).node(Place(start, problem.demands))
