"""A piece of the configuration space, given by conditions that have been solved.

A branch starts as the whole space.  Restricting it by an irreducible condition solves
that condition where it can be solved polynomially (`elimination`) and substitutes, so
that everything later becomes shorter; what cannot be solved stays as a pending
condition, of which only exact points are used.
"""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice

from screwkit.algebra.angles_as_numbers import are_no_angles
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.elimination import half_angle_steps, steps_of
from screwkit.algebra.modular import rank
from screwkit.algebra.no_common_root import have_no_common_root
from screwkit.algebra.points import (
    Point,
    branch_primes,
    differential,
    random_point,
    residue,
    with_extensions,
)
from screwkit.algebra.points_on import angles_in_numbers, moved_onto, points_asked
from screwkit.algebra.substitution import Substitution, reduced, substituted
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


@dataclass(frozen=True)
class Pending:
    """A condition that could not be solved.

    Attributes:
        condition: As it was imposed.
        value: What the steps after it have made of it; irreducible on the branch.
        companions: Further equations of a condition in half angles, as imposed.
        beside: What the steps have made of these; they vanish on the branch too.
    """

    condition: Polynomial
    value: Polynomial
    companions: tuple[Polynomial, ...] = ()
    beside: tuple[Polynomial, ...] = ()


@dataclass(frozen=True)
class Branch:
    """A piece of the configuration space of a ring.

    Attributes:
        conditions: The irreducible polynomials that vanish on it, in order.
        steps: How they were solved.
        pending: Conditions that could not be solved.
        extra: Further equations: they tell it from other zeros of its conditions.
        nonvanishing: Polynomials of the whole ring that are zero nowhere.
        directions: Vectors of the whole ring that are zero nowhere.
        thorough: Look for points on conditions that share their unknowns, by
            resultants; that may take long.
        dimensions: Indices of symbols that are dimensions, no coordinates of a posture.
        directed: Keep conditions that fix angles (`fixed_directions`).
        narrowed: Whether a condition was replaced by what its real zeros fulfil.
        shown: Texts of conditions that were shown to leave one part.
    """

    ring: TrigonometricRing
    assumptions: Assumptions
    conditions: tuple[Polynomial, ...] = ()
    steps: tuple[Substitution, ...] = ()
    pending: tuple[Pending, ...] = ()
    dimensions: tuple[int, ...] = ()
    extra: tuple[Polynomial, ...] = ()
    nonvanishing: tuple[Polynomial, ...] = ()
    directions: tuple[tuple[Polynomial, ...], ...] = ()
    thorough: bool = False
    directed: bool = False
    narrowed: bool = False
    shown: frozenset[str] = frozenset()

    @property
    def codimension(self) -> int:
        """Each condition was irreducible and not zero on the branch before it.

        Conditions that could not be solved and are implied by later ones do not count:
        with sin θ = 0 and z = 0, imposed later, x·sin θ + z·cos θ = 0 says nothing.
        """
        return len(self.steps) + len(self.pending)

    @cached_property
    def texts(self) -> frozenset[str]:
        """Of the conditions."""
        return frozenset(map(str, self.conditions))

    @cached_property
    def zero_at_points(self) -> dict[str, bool]:
        """Whether polynomials of the whole ring are, by text; those asked so far."""
        return {}

    @cached_property
    def zero_by_steps(self) -> dict[str, bool]:
        """The same of those that vanish on all of the branch, as its steps show."""
        return {}

    @property
    def sheets(self) -> tuple[Polynomial, ...]:
        """What tells this branch from the other sheets of the same conditions."""
        return tuple(step.sheet for step in self.steps if step.sheet is not None)

    def equations(self, kept: Collection[str]) -> tuple[Polynomial, ...]:
        """The conditions, those of the sheets ``kept`` sharpened to that sheet.

        Args:
            kept: Texts of the sheet polynomials that matter.
        """
        sharper: dict[str, tuple[Polynomial, ...]] = {}
        for step in self.steps:
            if step.sheet is not None and str(step.sheet) in kept:
                sharper[str(step.condition)] = (step.sheet,)
            elif step.companions:
                sharper[str(step.condition)] = (step.condition, *step.companions)
        for pending in self.pending:
            own = (pending.condition, *pending.companions)
            sharper[str(pending.condition)] = own
        found = [
            equation
            for condition in self.conditions
            for equation in sharper.get(str(condition), (condition,))
        ]
        return tuple({str(e): e for e in (*found, *self.extra)}.values())

    @cached_property
    def divisors(self) -> tuple[Polynomial, ...]:
        """What the steps divided by, and what is zero nowhere anyway."""
        found = list(self.nonvanishing)
        for step in self.steps:
            found = substituted(self.ring, found, step) if found else []
            if not step.divisor.is_constant():
                found.append(step.divisor)
        return tuple(found)

    @cached_property
    def is_special(self) -> bool:
        """Whether the conditions tie the dimensions of the mechanism to each other.

        They do where, at an exact point, their differentials have a lower rank by the
        posture alone than by the dimensions too.
        """
        occurring = [condition.degrees() for condition in self.conditions]
        if not any(degrees[i] for degrees in occurring for i in self.dimensions):
            return False
        return bool(self.points) and self.ties_dimensions_at(*self.points[0])

    def ties_dimensions_at(self, point: Point, prime: int) -> bool:
        """Whether the conditions tie dimensions to each other at an exact point."""
        rows = [differential(self.ring, c, point, prime) for c in self.conditions]
        angles = len(self.ring.basis)
        symbols = enumerate(self.ring.symbol_indices(), angles)
        free = [*range(angles), *(k for k, i in symbols if i not in self.dimensions)]
        by_posture = rank([[row[k] for k in free] for row in rows], prime)
        if by_posture == len(self.conditions):
            return False
        return by_posture < rank(rows, prime)

    def column(self, entries: Sequence[Polynomial]) -> list[Polynomial]:
        """A vector on this branch, up to a common factor that is nowhere zero."""
        values = list(entries)
        for step in self.steps:
            values = substituted(self.ring, values, step)
        return self.without_roots(reduced(values, self.steps))

    def without_roots(self, values: Sequence[Polynomial]) -> list[Polynomial]:
        """A vector on this branch with 0 for symbolic roots that are 0 on all of it."""
        if not self._zero_roots:
            return list(values)
        return [value.subs(self._zero_roots) for value in values]

    @cached_property
    def _zero_roots(self) -> dict[str, int]:
        """The generators of symbolic roots whose radicands the steps make zero."""
        found = {}
        for name, radicand in self.ring.radicands.items():
            values = self.ring.without_divisors([radicand])
            for step in self.steps:
                values = substituted(self.ring, values, step)
            if values[0] == 0:
                found[name] = 0
        return found

    def value(self, polynomial: Polynomial) -> Polynomial:
        """A polynomial on this branch, up to a factor that is nowhere zero."""
        return self.column([polynomial])[0]

    def point(self, source: random.Random) -> tuple[Point, int] | None:
        """A random exact point of the branch and its prime; None if none was found."""
        for _ in range(60):
            prime = random_branch_prime(source)
            point = self._attempt(source, prime)
            if point is not None:
                return point, prime
        return None

    @cached_property
    def points(self) -> tuple[tuple[Point, int], ...]:
        """Random exact points and their primes; none where too few were found.

        Two, or more where pending conditions may have several parts (`points_asked`).
        """
        source = random.Random(len(self.conditions) + 7)
        count = points_asked(self.ring, [p.value for p in self.pending])
        found = tuple(islice(iter(lambda: self.point(source), None), count))
        return found if len(found) == count else ()

    def vanishes(self, values: Sequence[Polynomial]) -> bool:
        """Whether a vector in the generators left is zero on all of the branch.

        Where conditions are pending the polynomials do not show it: exact points do.
        """
        if all(value == 0 for value in values):
            return True
        return bool(self.pending and self.points) and not any(
            residue(value, *at) for at in self.points for value in values
        )

    def _attempt(self, source: random.Random, prime: int) -> Point | None:
        point = random_point(self.ring, source, prime)
        if point is None:
            return None
        names = angles_in_numbers(self.ring, self.steps, point, source, prime)
        if names is None:
            return None
        put_in = (p.value.subs(names) for p in self.pending)  # no number is moved
        values = [value for value in put_in if value != 0]
        nonzero = self.nonzero
        solved = moved_onto(
            self.ring,
            values,
            point,
            source,
            prime,
            pairs=self.thorough,
            nonzero=nonzero,
        )
        fewest = 2 if self.ring.radicands else 3
        if solved is None and self.thorough and len(values) >= fewest:
            # What follows from other conditions leaves no unknown to meet it by.
            fewer = source.sample(values, len(values) - source.choice((1, 1, 2)))
            solved = moved_onto(
                self.ring, fewer, point, source, prime, pairs=True, nonzero=nonzero
            )
        if solved is None:
            return None
        whole = with_extensions(self.ring, solved, prime)
        if whole is None:
            return None
        point = whole
        for step in reversed(self.steps):
            divisor = residue(step.divisor, point, prime)
            if not divisor:
                return None
            inverse = pow(divisor, -1, prime)
            images = [(i, residue(p, point, prime)) for i, p in step.images]
            for index, image in images:
                point[index] = image * inverse % prime
        found = with_extensions(self.ring, point, prime)
        # A step may have moved what stands under a root.
        checked = [p.value for p in self.pending]
        checked += self.conditions if self.ring.radicands else ()
        checked += [value for p in self.pending for value in p.beside]
        if found is None or any(residue(value, found, prime) for value in checked):
            return None
        # Where a length that is not 0 vanishes there is no posture.
        return found if all(found[index] for index in nonzero) else None

    @cached_property
    def is_empty(self) -> bool:
        """Whether a symbol is 0 that is not 0, or an angle not the number it is."""
        left = [pending.value for pending in self.pending]
        beside = (value for pending in self.pending for value in pending.beside)
        return (
            self.vanishing_symbol is not None
            or have_no_common_root((*left, *beside), self.steps)
            or any(divmod(v, p)[1] == 0 for v in self._replaced.values() for p in left)
            or are_no_angles(self.ring, self.assumptions, self.steps, left, self.column)
        )

    @cached_property
    def vanishing_symbol(self) -> str | None:
        """A symbol that its steps make 0 although it is not 0."""
        first = self.ring.symbol_indices().start
        zero = (i - first for i, v in self._replaced.items() if not v)
        return next((self.ring.symbols[i] for i in zero), None)

    @cached_property
    def _replaced(self) -> dict[int, Polynomial]:
        """What the steps make of symbols that are not 0."""
        moved = {index for step in self.steps for index, _ in step.images}
        gens = self.ring.context.gens()
        return {i: self.value(gens[i]) for i in self.nonzero if i in moved}

    @cached_property
    def nonzero(self) -> tuple[int, ...]:
        """Indices of the symbols that are not 0."""
        names = self.assumptions.positive | self.assumptions.nonzero
        places = zip(self.ring.symbols, self.ring.symbol_indices(), strict=True)
        return tuple(index for name, index in places if name in names)


def random_branch_prime(source: random.Random) -> int:
    """One of the primes in which points of branches are drawn."""
    return source.choice(branch_primes())


def restricted(
    branch: Branch, condition: Polynomial, companions: tuple[Polynomial, ...] = ()
) -> list[Branch]:
    """The parts of ``branch`` on which ``condition`` vanishes.

    Args:
        branch: Where ``condition`` is irreducible and not zero.
        condition: In the generators that are left on the branch.
        companions: Further equations of a half-angle condition, which together with
            ``condition`` say what no single equation says.

    Returns:
        The sheets of the solution; a single branch with a pending condition where it
        could not be solved; nothing where it has no real zero.
    """
    ring = branch.ring
    conditions = (*branch.conditions, condition)
    if companions:
        steps = half_angle_steps(ring, branch.assumptions, condition, companions)
    else:
        steps = steps_of(ring, branch.assumptions, condition)
    if steps is None:
        fresh = Pending(condition, condition, companions, companions)
        together = (*branch.pending, fresh)
        unsolved = replace(branch, conditions=conditions, pending=together)
        return [] if unsolved.is_empty else [unsolved]
    found = []
    for step in steps:
        pending = still_pending(branch, step)
        if pending is None or _contradicts(branch, step):
            continue
        whole = replace(step, condition=condition, companions=companions)
        part = replace(
            branch,
            conditions=conditions,
            steps=(*branch.steps, whole),
            pending=pending,
        )
        if not part.is_empty:
            found.append(part)
    return found


def _contradicts(branch: Branch, step: Substitution) -> bool:
    """Whether an angle that was solved in numbers would be another one."""
    relations = [old.relation[2] for old in branch.steps if old.relation is not None]
    left = substituted(branch.ring, relations, step) if relations else []
    return any(value.is_constant() and value != 0 for value in left)


def still_pending(branch: Branch, step: Substitution) -> tuple[Pending, ...] | None:
    """The pending conditions after a step; None where one cannot hold any more."""
    left = []
    for pending in branch.pending:
        values = [pending.value, *pending.beside]
        after = [substituted(branch.ring, [v], step)[0] for v in values]
        value, *beside = reduced(after, branch.steps)
        if any(
            v != 0 and branch.assumptions.is_nonzero(branch.ring, v)
            for v in (value, *beside)
        ):
            return None
        if value == 0:
            beside = [v for v in beside if v != 0]
            if not beside:
                continue
            value = beside.pop(0)
        left.append(replace(pending, value=value, beside=tuple(beside)))
    return tuple(left)


def is_solvable(branch: Branch, condition: Polynomial) -> bool:
    """Whether `restricted` solves the condition instead of keeping it pending."""
    return steps_of(branch.ring, branch.assumptions, condition) is not None


def without(branch: Branch, pending: Pending) -> Branch:
    """The branch before a pending condition was imposed."""
    left = [p for p in branch.pending if p is not pending]
    conditions = list(branch.conditions)
    if pending.condition in conditions:  # imposed twice it is one by the other
        conditions.remove(pending.condition)
    return replace(branch, conditions=tuple(conditions), pending=tuple(left))
