"""What holds on a branch, and how a factor is solved there, for a proof.

Everything is answered in a form that a certificate can state.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import combinations

from screwkit.algebra.branches import Branch, Pending, restricted
from screwkit.algebra.elimination import half_angle_steps, steps_of
from screwkit.algebra.factors import Factor, FactorLibrary, factor
from screwkit.algebra.no_real_angle import never_met
from screwkit.algebra.points import Point, residue
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.quotients import quotient_of
from screwkit.algebra.real_zeros import vanishing_together
from screwkit.algebra.substitution import Substitution, reduced, substituted
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.certificates.equations_told import Multiple, Unsolved
from screwkit.certificates.limb_systems import LimbSystem
from screwkit.certificates.loop_equations import LoopEquations
from screwkit.certificates.minor_choice import Matrix
from screwkit.certificates.real_squares import SumOfSquares, sum_of_squares
from screwkit.certificates.roots import NotProvedError, roots_of
from screwkit.certificates.signs import Signs
from screwkit.certificates.steps import (
    followed,
    is_in_numbers,
    numbers_of,
    subtracted,
)
from screwkit.certificates.texts import read


@dataclass(frozen=True)
class Problem:
    """What is to be proved.

    Attributes:
        root: The whole configuration space.
        components: The equations of each component.
        moving: Whether a posture counts where the platform moves, not where the rank
            of the matrix falls.
        axes: By freedom: the square of its axis, where that is not constant.
        directions: By freedom: the coordinates of its axis.
        least: Where a posture counts that allows a limb less than this many freedoms;
            −1 elsewhere.
        demands: Conditions that hold at every posture, where loops tie joint variables.
        closed: Exact postures at which they do.
        limbs: Where limbs that are chains may say something of the whole.
    """

    root: Branch
    matrix: Matrix | LoopEquations
    components: tuple[tuple[Polynomial, ...], ...]
    moving: bool
    library: FactorLibrary
    signs: Signs
    axes: dict[str, Polynomial]
    directions: dict[str, tuple[Polynomial, ...]]
    least: int = -1
    demands: tuple[Polynomial, ...] = ()
    closed: tuple[tuple[Point, int], ...] = ()
    limbs: tuple[LimbSystem, ...] = ()

    @property
    def smaller(self) -> bool:
        """Whether the locus is not simply where the rank of the matrix falls."""
        return self.moving or self.least >= 0


@dataclass(frozen=True, eq=False)
class Place:
    """A node under way: its branch, and all conditions on the way to it."""

    branch: Branch
    conditions: tuple[Polynomial, ...] = ()

    @cached_property
    def followed(self) -> tuple[tuple[Polynomial, dict[str, int]], ...]:
        """Each condition on the branch, with powers of divisors: see `followed`."""
        found = (followed(self.branch, [condition]) for condition in self.conditions)
        return tuple((value, powers) for (value,), powers in found)

    def number(self, pending: Pending) -> int:
        """Of an unsolved condition of the branch among those of the way."""
        return [str(c) for c in self.conditions].index(str(pending.condition))


def with_conditions(root: Branch, equations: Sequence[Polynomial]) -> Branch:
    """The branch on which further equations are to hold, none of them solved."""
    return replace(
        root,
        conditions=(*root.conditions, *equations),
        pending=(*root.pending, *(Pending(own, own) for own in equations)),
    )


@dataclass(frozen=True)
class Option:
    """One solution of a case, or the case as a condition.

    Attributes:
        impossible: A condition that cannot hold there.
        squares: Of a condition that is kept: what it is, if that is a sum of squares.
    """

    place: Place
    step: Substitution | None
    impossible: Pending | None = None
    squares: SumOfSquares | None = None


@dataclass
class Conditions:
    """Questions about the branches of one problem."""

    problem: Problem

    def all_vanish(self, equations: Sequence[Polynomial], branch: Branch) -> bool:
        """At random exact points."""
        return all(residue(e, *at) == 0 for at in branch.points for e in equations)

    def roots(self, branch: Branch) -> tuple[Unsolved, ...]:
        """How the unsolved conditions of a branch are met, up to two that follow then.

        Raises:
            NotProvedError: If no way was found.
        """
        for size in range(3):
            for left_out in combinations(branch.pending, size):
                kept = tuple(p for p in branch.pending if p not in left_out)
                try:
                    found = roots_of(
                        branch.ring, [p.value for p in kept], branch.nonzero
                    )
                except NotProvedError:
                    continue
                fewer = replace(branch, pending=kept)
                if not left_out or self.meet(fewer, [p.value for p in left_out]):
                    return found
        raise NotProvedError("no order was found in which conditions can be met")

    def meet(self, branch: Branch, values: Sequence[Polynomial]) -> bool:
        """Whether there are exact points of a branch at which values vanish."""
        source = random.Random(len(values))
        points = [branch.point(source) for _ in range(4)]
        return any(
            at is not None and not any(residue(v, *at) for v in values) for at in points
        )

    def surely(self, place: Place, equations: Sequence[Polynomial]) -> bool:
        """Whether equations hold by the steps alone, or are conditions of the way."""
        known = {str(c) for c in place.conditions}
        return all(str(e) in known or place.branch.value(e) == 0 for e in equations)

    def multiples(
        self, place: Place, equations: Sequence[Polynomial]
    ) -> tuple[Multiple, ...] | None:
        """Which equations are multiples of conditions; None where one is neither."""
        found = []
        branch = place.branch
        for number, equation in enumerate(equations):
            (value,), over = followed(branch, [equation])
            if value == 0:
                continue
            for index, (below, under) in enumerate(place.followed):
                times = None if below == 0 else self.quotient(value, below)
                if times is not None:
                    written = text(branch.ring, times)
                    powers = subtracted(over, under)
                    found.append(Multiple(number, index, written, powers))
                    break
            else:
                return None
        return tuple(found)

    def quotient(self, value: Polynomial, below: Polynomial) -> Polynomial | None:
        """An exact quotient, if one is found."""
        return quotient_of(self.problem.root.ring, value, below, self.problem.library)

    def in_divisor(self, branch: Branch, own: Factor) -> Multiple | None:
        """The divisor of a step that a factor divides, which vanishes nowhere."""
        steps = enumerate(branch.steps)
        divisors = ((k, s.divisor) for k, s in steps if not s.divisor.is_constant())
        return self._divides(branch, own, divisors)

    def undefined(self, branch: Branch, own: Factor) -> Multiple | None:
        """The divisor of the geometry that a factor divides: no posture is there."""
        divisors = self.problem.root.ring.geometry_divisors.items()
        return self._divides(branch, own, divisors)

    def _divides(
        self, branch: Branch, own: Factor, divisors: Iterable[tuple[int, Polynomial]]
    ) -> Multiple | None:
        """The first of some divisors, by number, that a factor divides on a branch."""
        for number, divisor in divisors if len(own.equations) < 2 else ():
            (value,), over = followed(branch, [divisor])
            times = None if value == 0 else self.quotient(value, own.equations[0])
            if times is not None:
                return Multiple(number, -1, text(branch.ring, times), over)
        return None

    def factors(self, branch: Branch, value: Polynomial) -> list[tuple[Factor, int]]:
        """The factors of a polynomial on a branch, with their powers."""
        return [*factor(branch.ring, value, self.problem.library).factors]

    def product(
        self, branch: Branch, parts: Sequence[tuple[Polynomial, int]], longest: int
    ) -> list[tuple[Factor, int]] | None:
        """The factors of a product; None where a part is too long.

        Powers of factors that cancel are left out.
        """
        found: dict[str, tuple[Factor, int]] = {}
        for part, power in parts:
            if len(part) > longest:
                return None
            for own, times in self.factors(branch, part):
                _, before = found.get(own.key, (own, 0))
                found[own.key] = own, before + times * power
        if any(power < 0 for _, power in found.values()):
            return None
        return [(own, power) for own, power in found.values() if power]

    def positive(self, branch: Branch, own: Factor) -> bool:
        """Whether a factor vanishes nowhere, by its terms or in numbers."""
        ring, first = branch.ring, own.equations[0]
        return (
            branch.assumptions.is_nonzero(ring, first)
            or never_met(ring, [first])
            or vanishing_together(ring, branch.assumptions, first) == [ring.one]
        ) and self.problem.signs.never_zero(read(text(ring, first)))

    def elsewhere(self, branch: Branch, own: Factor) -> bool:
        """Whether an angle that was solved in numbers is no zero of a factor in it."""
        try:
            angle, _ = numbers_of(branch.ring, own.equations[0])
        except ValueError:
            return False
        return not restricted(branch, own.equations[0]) and any(
            old.relation is not None
            and old.condition is not None
            and numbers_of(branch.ring, old.condition)[0] == angle
            for old in branch.steps
        )

    def vanishes_nowhere(self, branch: Branch, own: Factor) -> bool:
        """By the signs of its terms, as a divisor, or in numbers."""
        return (
            self.positive(branch, own)
            or self.in_divisor(branch, own) is not None
            or self.undefined(branch, own) is not None
            or self.elsewhere(branch, own)
        )

    def steps(self, branch: Branch, own: Factor) -> list[Substitution] | None:
        """How a factor is solved, one step a sheet; None where it is not."""
        condition, companions = own.equations[0], own.equations[1:]
        if companions:
            return half_angle_steps(
                branch.ring, branch.assumptions, condition, companions
            )
        steps = steps_of(branch.ring, branch.assumptions, condition)
        if steps is None or (steps and all(s.relation is None for s in steps)):
            return steps
        # An angle in numbers: the checker knows rational ones alone.
        return steps if is_in_numbers(branch.ring, condition) else None

    def options_of(self, place: Place, own: Factor) -> list[Option]:
        """The sheets of a factor on a node, or the factor as a condition."""
        branch = place.branch
        condition, companions = own.equations[0], own.equations[1:]
        conditions = (*branch.conditions, condition)
        steps = self.steps(branch, own)
        if steps is None:
            return [self._kept(place, own.equations)]
        found = []
        for step in steps:
            whole = replace(step, condition=condition, companions=companions)
            left, impossible = list[Pending](), None
            for old in branch.pending:
                after = substituted(branch.ring, [old.value], step)
                value = reduced(after, branch.steps)[0]
                if value == 0:
                    continue
                if branch.assumptions.is_nonzero(branch.ring, value):
                    impossible = old
                if not any(primitive(value) == primitive(p.value) for p in left):
                    left.append(Pending(old.condition, value))
            child = replace(
                branch,
                conditions=conditions,
                steps=(*branch.steps, whole),
                pending=tuple(left),
            )
            found.append(Option(Place(child, place.conditions), whole, impossible))
        return found

    def _kept(self, place: Place, equations: Sequence[Polynomial]) -> Option:
        """The equations of a factor as conditions, those that are none yet."""
        branch, squares = place.branch, None
        if len(equations) == 1:
            squares = sum_of_squares(branch.ring, branch.assumptions, equations[0])
        bases = [base for _, base in squares.squares] if squares is not None else []
        every = (*equations, *bases)
        known = {str(primitive(p.value)) for p in branch.pending}
        new = [e for e in every if str(primitive(e)) not in known]
        kept = replace(
            branch,
            conditions=(*branch.conditions, *new),
            pending=(*branch.pending, *(Pending(own, own) for own in new)),
        )
        return Option(Place(kept, (*place.conditions, *every)), None, squares=squares)

    def says_nothing(
        self, place: Place, pending: Pending, factors: Sequence[tuple[Factor, int]]
    ) -> bool:
        """Whether some factor vanishes where the other unsolved conditions do."""
        others = {str(primitive(p.value)) for p in place.branch.pending if p != pending}
        own = str(primitive(pending.value))
        written = [{str(primitive(e)) for e in f.equations} for f, _ in factors]
        return any(texts != {own} and texts - {own} <= others for texts in written)

    def wider(self, branch: Branch, most: int) -> tuple[Point, int] | None:
        """A posture that need not fulfil the unsolved conditions of a branch.

        Args:
            branch: Where it is looked for.
            most: From so many unsolved conditions on, demands aside, for none.
        """
        more = len(branch.pending) - len(self.problem.demands)
        if not branch.pending or more >= most:
            return None
        closed = None if branch.steps else next(iter(self.problem.closed), None)
        return closed or next(iter(replace(branch, pending=()).points), None)

    def where(self, place: Place, equations: Sequence[Polynomial]) -> Option:
        """The part of a node on which all of some equations hold, as conditions."""
        branch = place.branch
        pending, impossible = list(branch.pending), None
        held = {str(primitive(own.value)) for own in pending}
        new = []
        for equation in equations:
            (value,), _ = followed(branch, [equation])
            if value == 0 or str(primitive(value)) in held:
                continue
            own = Pending(equation, value)
            if branch.assumptions.is_nonzero(branch.ring, value):
                impossible = own
            pending.append(own)
            new.append(equation)
        conditions = (*branch.conditions, *new)
        child = replace(branch, conditions=conditions, pending=tuple(pending))
        below = Place(child, (*place.conditions, *equations))
        return Option(below, None, impossible)

    def is_of_dimensions(self, branch: Branch, own: Factor) -> bool:
        """Whether a factor ties the dimensions of the mechanism alone."""
        dimensions = set(branch.dimensions)
        degrees = own.equations[0].degrees()
        # Behind the symbols stand the algebraic numbers.
        numbers = branch.ring.symbol_indices().stop
        used = {i for i, degree in enumerate(degrees) if degree and i < numbers}
        return bool(used) and used <= dimensions
