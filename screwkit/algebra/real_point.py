"""A real common zero of equations, proved to exist by Newton's method in balls.

Newton's method in floating point finds a candidate.  As many generators as there are
equations are kept unknown and the others are frozen at the numbers they have; if the
interval Newton step maps a box around the candidate into its inside, the box holds
exactly one real zero, and the derivatives are independent there.

References: [MooreKearfottCloud2009] §8.1 (interval Newton).
"""

from __future__ import annotations

import math
import random
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import arb, arb_mat, ctx, fmpz_poly

from screwkit.algebra.angles_as_numbers import single_angles
from screwkit.algebra.branches import Branch
from screwkit.algebra.float_elimination import pivots, shortest_step
from screwkit.algebra.substitution import Substitution
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, as_fraction

STARTS = 12
"""Random starts."""

STEPS = 60
"""Newton steps from each."""

_BITS = 128
_RADIUS = 2.0**-40
_CLOSE = 1e-11
_APART = 1e-6

_Monomials = list[tuple[Any, list[tuple[int, int]]]]


@dataclass(frozen=True)
class RealPoint:
    """A real point in numbers.

    Attributes:
        turns: Values of the basis angles, in the order of the basis.
        numbers: Values of the symbols.
    """

    turns: tuple[float, ...]
    numbers: Mapping[str, float]


def real_point(
    branch: Branch,
    given: Mapping[str, Fraction],
    seed: int,
    apart: Sequence[Sequence[Polynomial]] = (),
    equations: Sequence[Polynomial] = (),
) -> RealPoint | None:
    """A real point of a branch near which its conditions are independent.

    Args:
        branch: Its conditions are equations of the whole ring.
        given: Values of symbols that are held, exactly.
        seed: Of the random starts.
        apart: Equations of sets that the point must not lie on.
        equations: That vanish on all of the branch, and not on other sets of common
            zeros of its conditions.

    Returns:
        None where none was found; that proves nothing.
    """
    ring = branch.ring
    turns = single_angles(ring)
    if ring.constant_angles or turns is None:
        return None
    given = {**given, **_numbers(branch, turns.values())}
    system = _System(branch, given, equations, turns)
    source = random.Random(seed)
    for _ in range(STARTS):
        start = _start(ring, given, source, turns)
        found = None if start is None else system.solved_from(start)
        if found is not None:
            values = system.proved(found)
            if values is not None and not system.lies_on(values, apart):
                return _named(ring, values)
    return None


class _System:
    """The conditions of a branch with the relations of its ring."""

    def __init__(
        self,
        branch: Branch,
        given: Mapping[str, Fraction],
        vanishing: Sequence[Polynomial],
        turns: Mapping[int, int],
    ) -> None:
        ring = branch.ring
        self._ring = ring
        gens = ring.context.gens()
        self._turns = turns  # of angles that are symbols too: both are held
        solved = _solved_angles(branch)
        said = {str(step.condition) for step in solved.values()}
        equations = [c for c in branch.conditions if str(c) not in said]
        for k in range(len(ring.basis)):
            if k in turns:
                continue
            if k in solved:
                step = solved[k]
                equations += [
                    step.divisor * gens[i] - image for i, image in step.images
                ]
                continue
            sine, cosine = gens[ring.sine_index(k)], gens[ring.cosine_index(k)]
            equations.append(sine**2 + cosine**2 - 1)
        self._roots: list[int] = []
        self._constants: dict[int, float] = {}
        for index, inside in ring.algebraic_relations:
            if isinstance(inside, tuple):
                terms = (a * gens[index] ** k for k, a in enumerate(inside))
                equations.append(sum(terms, ring.zero))
                self._constants[index] = _largest_root(inside)
            else:
                equations.append(gens[index] ** 2 - inside)
                self._roots.append(index)
        for name, divisor in ring.divisors_of.items():
            equations.append(ring.generator(name) * divisor - 1)
        places = dict(zip(ring.symbols, ring.symbol_indices(), strict=True))
        held = {places[name] for name in given if name in places} | {*turns.values()}
        held |= {i for k in turns for i in (ring.sine_index(k), ring.cosine_index(k))}
        self._unknown = [i for i in range(len(ring.names)) if i not in held]
        if turns:  # What is left of an equation that speaks of them alone is a number.
            equations = [
                e for e in equations if any(e.degrees()[i] for i in self._unknown)
            ]
        self._equations = [_monomials(e) for e in equations]
        self._derivatives = [
            {i: _monomials(e.derivative(i)) for i in self._unknown if e.degrees()[i]}
            for e in equations
        ]
        kept = {str(sheet) for sheet in branch.sheets}
        checks = [*branch.equations(kept), *vanishing]
        self._checks = [_monomials(e) for e in checks]
        # A condition was made free of divisors: where they vanish it says nothing.
        self._divisors = [
            _monomials(step.divisor)
            for step in branch.steps
            if not step.divisor.is_constant()
        ]

    def solved_from(self, start: Sequence[float]) -> list[float] | None:
        """Newton's steps of least length until the residual is at rounding."""
        values = list(start)
        for _ in range(STEPS):
            residuals = [_value(e, values) for e in self._equations]
            largest = max(map(abs, residuals), default=0.0)
            if not math.isfinite(largest) or largest > 1e9:
                return None
            if largest < _CLOSE:
                return values
            step = shortest_step(self._jacobian(values), residuals)
            if step is None:
                return None
            length = max(map(abs, step), default=0.0)
            scale = min(1.0, 1.0 / length) if length else 1.0
            for index, change in zip(self._unknown, step, strict=True):
                values[index] -= scale * change
        return None

    def _jacobian(self, values: Sequence[float]) -> list[list[float]]:
        return [
            [_value(row[i], values) if i in row else 0.0 for i in self._unknown]
            for row in self._derivatives
        ]

    def proved(self, candidate: Sequence[float]) -> list[Any] | None:
        """Balls around a real zero; None where the step does not contract."""
        chosen = pivots(self._jacobian(candidate))
        if chosen is None:
            return None
        free = [self._unknown[c] for c in chosen]
        before = ctx.prec
        ctx.prec = _BITS
        try:
            return self._contracted(candidate, free)
        except ZeroDivisionError:
            return None
        finally:
            ctx.prec = before

    def lies_on(
        self, values: Sequence[Any], sets: Sequence[Sequence[Polynomial]]
    ) -> bool:
        """Whether it may lie on one of these sets."""
        return any(
            all(abs(float(_value(_monomials(e), values))) < _APART for e in equations)
            for equations in sets
        )

    def _contracted(
        self, candidate: Sequence[float], free: Sequence[int]
    ) -> list[Any] | None:
        middle = [arb(value) for value in candidate]
        for k, place in self._turns.items():
            middle[self._ring.sine_index(k)] = middle[place].sin()
            middle[self._ring.cosine_index(k)] = middle[place].cos()
        for _ in range(4):
            for i, change in zip(free, self._step(middle, middle, free), strict=True):
                middle[i] = (middle[i] - change).mid()
        box = list(middle)
        for i in free:
            box[i] = arb(middle[i], _RADIUS)
        found = list(middle)
        for i, change in zip(free, self._step(middle, box, free), strict=True):
            found[i] = middle[i] - change
            if not box[i].contains_interior(found[i]):
                return None
        if any(not found[i] > 0 for i in self._roots):
            return None
        if any(abs(float(found[i]) - x) > _CLOSE for i, x in self._constants.items()):
            return None
        if any(abs(float(_value(d, found))) < _APART for d in self._divisors):
            return None
        if any(_value(d, found).contains(0) for d in self._divisors):
            return None
        if all(_value(check, found).contains(0) for check in self._checks):
            return found
        return None

    def _step(
        self, at: Sequence[Any], over: Sequence[Any], free: Sequence[int]
    ) -> list[Any]:
        """Of Newton: residuals at a point, derivatives over a box."""
        zero = arb(0)
        rows = [
            [_value(row[i], over) if i in row else zero for i in free]
            for row in self._derivatives
        ]
        residuals = [[_value(e, at)] for e in self._equations]
        return [*arb_mat(rows).solve(arb_mat(residuals)).entries()]


def _solved_angles(branch: Branch) -> dict[int, Substitution]:
    """The steps that give an angle outright, sine and cosine.

    What they solve may be a double condition, as cos φ = 1 is, on which no Newton step
    contracts.
    """
    ring = branch.ring
    found: dict[int, Substitution] = {}
    for step in branch.steps:
        if step.relation is not None or step.condition is None:
            continue
        indices = {index for index, _ in step.images}
        for k in range(len(ring.basis)):
            if indices == {ring.sine_index(k), ring.cosine_index(k)}:
                found[k] = step
    return found


def _numbers(branch: Branch, places: Iterable[int]) -> dict[str, Fraction]:
    """The symbols at these places that the steps of a branch make rational numbers."""
    ring = branch.ring
    found = {}
    for place in places:
        value, one = branch.column([ring.context.gens()[place], ring.one])
        if value.is_constant() and one.is_constant():
            name = ring.symbols[place - ring.symbol_indices().start]
            found[name] = as_fraction(value) / as_fraction(one)
    return found


def _monomials(polynomial: Polynomial) -> _Monomials:
    return [
        (coefficient, [(i, int(e)) for i, e in enumerate(exponents) if e])
        for exponents, coefficient in polynomial.to_dict().items()
    ]


def _value(monomials: _Monomials, values: Sequence[Any]) -> Any:
    """In floats or in balls, whatever the values are."""
    balls = bool(values) and isinstance(values[0], arb)
    total = arb(0) if balls else 0.0
    for coefficient, powers in monomials:
        term = arb(coefficient) if balls else int(coefficient.p) / int(coefficient.q)
        for index, power in powers:
            for _ in range(power):  # a power of a ball around 0 would be lost
                term *= values[index]
        total += term
    return total


def _start(
    ring: TrigonometricRing,
    given: Mapping[str, Fraction],
    source: random.Random,
    turns: Mapping[int, int],
) -> list[float] | None:
    """Random values of all generators that satisfy the ring's own relations."""
    values = [0.0] * len(ring.names)
    for k in range(len(ring.basis)):
        turn = source.uniform(-math.pi, math.pi)
        values[ring.sine_index(k)] = math.sin(turn)
        values[ring.cosine_index(k)] = math.cos(turn)
    for name, index in zip(ring.symbols, ring.symbol_indices(), strict=True):
        exact = given.get(name)
        values[index] = source.uniform(-1.5, 1.5) if exact is None else float(exact)
    for k, place in turns.items():
        values[ring.sine_index(k)] = math.sin(values[place])
        values[ring.cosine_index(k)] = math.cos(values[place])
    for index, inside in ring.algebraic_relations:
        if isinstance(inside, tuple):
            values[index] = _largest_root(inside)
            continue
        square = _value(_monomials(inside), values)
        if square <= 0:
            return None
        values[index] = math.sqrt(square)
    for name, divisor in ring.divisors_of.items():
        below = _value(_monomials(divisor), values)
        if not below:
            return None
        values[ring.names.index(name)] = 1 / below
    return values


def _largest_root(coefficients: Sequence[int]) -> float:
    """√p and 2cos(π/n) are the largest of their conjugates."""
    roots = fmpz_poly(list(coefficients)).complex_roots()
    return max(float(root.real) for root, _ in roots if root.imag.contains(0))


def _named(ring: TrigonometricRing, values: Sequence[Any]) -> RealPoint:
    turns = tuple(
        math.atan2(
            float(values[ring.sine_index(k)]), float(values[ring.cosine_index(k)])
        )
        for k in range(len(ring.basis))
    )
    numbers = {
        name: float(values[index])
        for name, index in zip(ring.symbols, ring.symbol_indices(), strict=True)
    }
    return RealPoint(turns, numbers)
