"""A piece of the configuration space, given by conditions that have been solved.

A branch starts as the whole space.  Restricting it by an irreducible condition solves
that condition where it can be solved polynomially (``sin q4 = 0`` in two sheets, a
condition linear in a length, an angle fixed by numbers) and substitutes, so that
everything later becomes shorter; what cannot be solved stays as a pending condition,
of which only exact points are used.
"""

from __future__ import annotations

import random
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import Any
from weakref import WeakKeyDictionary

from flint import fmpz, nmod_mat, nmod_poly

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.points import (
    Point,
    differential,
    random_angle,
    random_point,
    residue,
)
from screwkit.algebra.survey import rational_root
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
)


@dataclass(frozen=True)
class Substitution:
    """Generators replaced by polynomials, over a divisor that is nowhere zero there.

    Attributes:
        images: (index of a generator, its numerator).
        divisor: Common denominator of the images.
        relation: A further relation in one generator, (index, degree, polynomial).
        sheet: A polynomial that vanishes on this sheet of the solution and not on the
            other; None where there is one sheet only.
        condition: What was solved.
        companions: Further equations of a condition that takes several.
    """

    images: tuple[tuple[int, Polynomial], ...]
    divisor: Polynomial
    relation: tuple[int, int, Polynomial] | None = None
    sheet: Polynomial | None = None
    condition: Polynomial | None = None
    companions: tuple[Polynomial, ...] = ()


@dataclass(frozen=True)
class Branch:
    """A piece of the configuration space of a ring.

    Attributes:
        conditions: The irreducible polynomials that vanish on it, in order.
        steps: How they were solved.
        pending: Conditions that could not be solved.
        dimensions: Indices of the symbols that are dimensions of the mechanism, not
            coordinates of its posture.
    """

    ring: TrigonometricRing
    assumptions: Assumptions
    conditions: tuple[Polynomial, ...] = ()
    steps: tuple[Substitution, ...] = ()
    pending: tuple[Polynomial, ...] = ()
    dimensions: tuple[int, ...] = ()

    @property
    def codimension(self) -> int:
        """Each condition was irreducible and not zero on the branch before it."""
        return len(self.conditions)

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
        return tuple(
            equation
            for condition in self.conditions
            for equation in sharper.get(str(condition), (condition,))
        )

    @property
    def divisors(self) -> list[Polynomial]:
        """What the steps divided by: nowhere zero on the branch."""
        found: list[Polynomial] = []
        for step in self.steps:
            found = _substituted(self.ring, found, step) if found else []
            if not step.divisor.is_constant():
                found.append(step.divisor)
        return found

    @cached_property
    def is_special(self) -> bool:
        """Whether the conditions tie the dimensions of the mechanism to each other.

        They do not exactly where they are independent in the posture alone: at an
        exact point the differentials by the posture have full rank.
        """
        if not self.conditions or not self.points:
            return False
        point, prime = self.points[0]
        rows = [
            differential(self.ring, condition, point, prime, set(self.dimensions))
            for condition in self.conditions
        ]
        entries = [value for row in rows for value in row]
        rank = nmod_mat(len(rows), len(rows[0]), entries, prime).rank()
        return int(rank) < len(self.conditions)

    def column(self, entries: Sequence[Polynomial]) -> list[Polynomial]:
        """A vector on this branch, up to a common factor that is nowhere zero."""
        values = list(entries)
        for step in self.steps:
            values = _substituted(self.ring, values, step)
        return values

    def value(self, polynomial: Polynomial) -> Polynomial:
        """A polynomial on this branch, up to a factor that is nowhere zero."""
        return self.column([polynomial])[0]

    def point(self, source: random.Random) -> tuple[Point, int] | None:
        """A random exact point of the branch and its prime; None if none was found."""
        for _ in range(60):
            prime = _prime(source)
            point = self._attempt(source, prime)
            if point is not None:
                return point, prime
        return None

    @cached_property
    def points(self) -> tuple[tuple[Point, int], ...]:
        """Two random exact points and their primes; none where none was found."""
        source = random.Random(len(self.conditions) + 7)
        found = [self.point(source) for _ in range(2)]
        return tuple(p for p in found if p is not None) if all(found) else ()

    def _attempt(self, source: random.Random, prime: int) -> Point | None:
        point = random_point(self.ring, source, prime)
        if point is None:
            return None
        fixed: set[int] = set()
        solved = _solve_pending(self.ring, self.pending, point, source, prime)
        if solved is None:
            return None
        point = solved
        for step in reversed(self.steps):
            if step.relation is not None:
                index, _, polynomial = step.relation
                root = _root_in(polynomial, index, point, source, prime)
                if root is None:
                    return None
                point[index] = root
            divisor = residue(step.divisor, point, prime)
            if not divisor:
                return None
            inverse = pow(divisor, -1, prime)
            images = [(i, residue(p, point, prime)) for i, p in step.images]
            for index, image in images:
                point[index] = image * inverse % prime
                fixed.add(index)
        if any(residue(p, point, prime) for p in self.pending):
            return None
        return point


def _prime(source: random.Random) -> int:
    return source.choice(_primes())


@lru_cache(maxsize=1)
def _primes() -> tuple[int, ...]:
    """Primes of 61 bits to choose from; fixed, so that answers can be repeated.

    All are 1 modulo 720720: small roots and the cosines of common angles exist.
    """
    step = 720720
    found: list[int] = []
    candidate = (2**61 // step) * step + 1
    while len(found) < 64:
        if fmpz(candidate).is_prime():
            found.append(candidate)
        candidate -= step
    return tuple(found)


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
    steps = _steps(branch, condition)
    if companions:
        steps = _half_angle_steps(branch, condition, companions)
    if steps is None:
        return [
            replace(branch, conditions=conditions, pending=(*branch.pending, condition))
        ]
    found = []
    for step in steps:
        pending = _still_pending(branch, step)
        if pending is None:
            continue
        whole = replace(step, condition=condition, companions=companions)
        found.append(
            replace(
                branch,
                conditions=conditions,
                steps=(*branch.steps, whole),
                pending=pending,
            )
        )
    return found


def _still_pending(
    branch: Branch, step: Substitution
) -> tuple[Polynomial, ...] | None:
    """The pending conditions after a step; None where one cannot hold any more."""
    values = [_substituted(branch.ring, [p], step)[0] for p in branch.pending]
    left = tuple(value for value in values if value != 0)
    if any(branch.assumptions.is_nonzero(branch.ring, value) for value in left):
        return None
    return left


@dataclass(frozen=True)
class Split:
    """A condition A·x + B = 0 solved for x where A ≠ 0, and what that leaves out.

    Attributes:
        solved: The part on which A is nowhere zero.
        left: A and B, which both vanish on the rest.
    """

    solved: Branch
    left: tuple[Polynomial, Polynomial]


def split(branch: Branch, condition: Polynomial) -> Split | None:
    """Solve a condition for the symbol with the shortest coefficient, if there is one.

    Unlike `restricted` this leaves a rest, which the caller has to search as well.
    """
    ring = branch.ring
    degrees = condition.degrees()
    best: tuple[int, int] | None = None
    for index in ring.symbol_indices():
        if degrees[index] == 1:
            size = len(linear_parts(ring, condition, index)[0])
            if best is None or size < best[0]:
                best = size, index
    if best is None:
        return None
    factor, rest = linear_parts(ring, condition, best[1])
    step = Substitution(((best[1], -rest),), factor, condition=condition)
    pending = _still_pending(branch, step)
    if pending is None:
        return None
    solved = replace(
        branch,
        conditions=(*branch.conditions, condition),
        steps=(*branch.steps, step),
        pending=pending,
    )
    return Split(solved, (factor, rest))


def is_solvable(branch: Branch, condition: Polynomial) -> bool:
    """Whether `restricted` solves the condition instead of keeping it pending."""
    return _steps(branch, condition) is not None


def _steps(branch: Branch, condition: Polynomial) -> list[Substitution] | None:
    """How to solve a condition; the answer depends on nothing but the condition."""
    ring = branch.ring
    known = _SOLVED.setdefault(ring, {})
    key = str(condition), branch.assumptions
    if key not in known:
        known[key] = _attempts(branch, condition)
    return known[key]


_SOLVED: WeakKeyDictionary[
    TrigonometricRing,
    dict[tuple[str, Assumptions], list[Substitution] | None],
] = WeakKeyDictionary()


def _attempts(branch: Branch, condition: Polynomial) -> list[Substitution] | None:
    ring = branch.ring
    for attempt in (
        _angle_steps(ring, condition),
        _constant_angle_steps(ring, condition),
        _symbol_steps(branch, condition),
    ):
        if attempt is not None:
            return attempt
    return None


def _angle_steps(
    ring: TrigonometricRing, condition: Polynomial
) -> list[Substitution] | None:
    """P·sin φ + Q·cos φ = 0 with P² + Q² a square number: two sheets."""
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, condition, angle)
        if parts is None:
            continue
        p, q, rest = parts
        if rest != 0:
            continue
        square = ring.normal(p * p + q * q)
        if not square.is_constant():
            continue
        root = rational_root(as_fraction(square))
        if root is None:
            continue
        scale = ring.rational(1 / root)
        return [
            Substitution(
                (
                    (ring.sine_index(angle), ring.normal(-q * scale * sign)),
                    (ring.cosine_index(angle), ring.normal(p * scale * sign)),
                ),
                ring.one,
                sheet=_sheet(ring, angle, p * scale * sign, -q * scale * sign),
            )
            for sign in (1, -1)
        ]
    return None


def _half_angle_steps(
    branch: Branch, condition: Polynomial, companions: Sequence[Polynomial]
) -> list[Substitution] | None:
    """Two linear equations in the sine and cosine of one angle: one sheet."""
    ring = branch.ring
    for angle in range(len(ring.basis)):
        rows = [angle_parts(ring, e, angle) for e in (condition, *companions)]
        found = [row for row in rows if row is not None]
        if len(found) != 2 or len(found) != len(rows):
            continue
        (p, q, r), (u, v, w) = found
        divisor = ring.normal(p * v - q * u)
        if divisor == 0 or not branch.assumptions.is_nonzero(ring, divisor):
            continue
        sine = ring.normal(q * w - r * v)
        cosine = ring.normal(r * u - p * w)
        if ring.normal(sine * sine + cosine * cosine - divisor * divisor) != 0:
            continue
        images = ((ring.sine_index(angle), sine), (ring.cosine_index(angle), cosine))
        return [Substitution(images, divisor)]
    return None


def _sheet(
    ring: TrigonometricRing, angle: int, cosine: Polynomial, sine: Polynomial
) -> Polynomial:
    """cos(φ − φ₀) − 1, which is 0 on the sheet φ = φ₀ and −2 on the other."""
    along = ring.cosines[angle] * cosine + ring.sines[angle] * sine
    return ring.normal(along - 1)


def _constant_angle_steps(
    ring: TrigonometricRing, condition: Polynomial
) -> list[Substitution] | None:
    """a·sin φ + b·cos φ + c = 0 in numbers: φ is an algebraic constant."""
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, condition, angle)
        if parts is None or not all(part.is_constant() for part in parts):
            continue
        a, b, c = (as_fraction(part) for part in parts)
        if c * c > a * a + b * b:
            return []
        sine, cosine = ring.sines[angle], ring.cosines[angle]
        # Eliminate the one with a coefficient; the other satisfies a quadratic.
        if a:
            kept, gone = cosine, ring.sine_index(angle)
            index, u, v = ring.cosine_index(angle), -b / a, -c / a
        else:
            kept, gone = sine, ring.cosine_index(angle)
            index, u, v = ring.sine_index(angle), Fraction(0), -c / b
        image = kept * ring.rational(u) + ring.rational(v)
        relation = kept * kept + image * image - 1
        lead = as_fraction(ring.one) + u * u
        relation = relation * ring.rational(1 / lead)
        return [Substitution(((gone, image),), ring.one, (index, 2, relation))]
    return None


def _symbol_steps(branch: Branch, condition: Polynomial) -> list[Substitution] | None:
    """A·x + B = 0 where A and B have no common zero: x = −B/A."""
    ring = branch.ring
    degrees = condition.degrees()
    for index in ring.symbol_indices():
        if degrees[index] != 1:
            continue
        factor, rest = linear_parts(ring, condition, index)
        if branch.assumptions.is_nonzero(ring, factor):
            return [Substitution(((index, -rest),), factor)]
        if _never_both(branch, factor, rest):
            return [Substitution(((index, -rest),), factor)]
    return None


def _never_both(branch: Branch, factor: Polynomial, rest: Polynomial) -> bool:
    """Whether ``factor`` = 0 implies ``rest`` ≠ 0, by solving ``factor`` = 0."""
    ring = branch.ring
    steps = _angle_steps(ring, factor) or _constant_angle_steps(ring, factor)
    if steps is None:
        return False
    return all(
        branch.assumptions.is_nonzero(ring, _substituted(ring, [rest], step)[0])
        for step in steps
    )


def angle_parts(
    ring: TrigonometricRing, polynomial: Polynomial, angle: int
) -> tuple[Polynomial, Polynomial, Polynomial] | None:
    """(P, Q, R) with polynomial = P·sin φ + Q·cos φ + R, all free of φ.

    None where φ does not occur or occurs to a higher degree.
    """
    sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
    degrees = polynomial.degrees()
    if not 0 < max(degrees[sine], degrees[cosine]) <= 1:
        return None
    if degrees[sine] and degrees[cosine]:
        split: list[dict[tuple[int, ...], Any]] = [{}, {}, {}]
        for exponents, coefficient in polynomial.to_dict().items():
            s, c = int(exponents[sine]), int(exponents[cosine])
            if s and c:
                return None
            rest = tuple(
                0 if i in (sine, cosine) else e for i, e in enumerate(exponents)
            )
            split[0 if s else 1 if c else 2][rest] = coefficient
        p, q, r = (ring.context.from_dict(part) for part in split)
        return p, q, r
    index = sine if degrees[sine] else cosine
    factor, rest = linear_parts(ring, polynomial, index)
    if index == sine:
        return factor, ring.zero, rest
    return ring.zero, factor, rest


def linear_parts(
    ring: TrigonometricRing, polynomial: Polynomial, index: int
) -> tuple[Polynomial, Polynomial]:
    """(A, B) with polynomial = A·x + B, for a generator of degree one."""
    factor = polynomial.derivative(index)
    rest = polynomial - factor * ring.context.gens()[index]
    return factor, rest


def _substituted(
    ring: TrigonometricRing, values: Sequence[Polynomial], step: Substitution
) -> list[Polynomial]:
    gens = list(ring.context.gens())
    for index, image in step.images:
        gens[index] = image
    if step.divisor.is_constant():
        scale = ring.rational(1 / as_fraction(step.divisor))
        for index, image in step.images:
            gens[index] = image * scale
        replaced = [_composed(value, gens) for value in values]
    else:
        indices = [index for index, _ in step.images]
        power = max((_degree_in(v, indices) for v in values), default=0)
        replaced = [_fraction_free(ring, value, step, power) for value in values]
    normal = [ring.normal(value) for value in replaced]
    if step.relation is not None:
        index, degree, relation = step.relation
        normal = [
            divmod(v, relation)[1] if v != 0 and v.degrees()[index] >= degree else v
            for v in normal
        ]
    return normal


def _composed(value: Polynomial, images: Sequence[Polynomial]) -> Polynomial:
    return value if value.is_constant() else value.compose(*images)


def _degree_in(value: Polynomial, indices: Sequence[int]) -> int:
    """Largest total degree in some generators."""
    if value.is_constant():
        return 0
    degrees = value.degrees()
    if len(indices) == 1:
        return int(degrees[indices[0]])
    if not any(degrees[i] for i in indices):
        return 0
    return max(int(sum(e[i] for i in indices)) for e in value.monoms())


def _fraction_free(
    ring: TrigonometricRing, value: Polynomial, step: Substitution, power: int
) -> Polynomial:
    """divisor^power · value with each generator replaced by image/divisor."""
    if value == 0:
        return value
    indices = [index for index, _ in step.images]
    if value.is_constant() or not any(value.degrees()[i] for i in indices):
        return value * step.divisor**power
    parts: dict[tuple[int, ...], dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in value.to_dict().items():
        rest = tuple(0 if i in indices else e for i, e in enumerate(exponents))
        key = tuple(int(exponents[i]) for i in indices)
        parts.setdefault(key, {})[rest] = coefficient
    total = ring.zero
    for key, terms in parts.items():
        term = ring.context.from_dict(terms) * step.divisor ** (power - sum(key))
        for (_, image), exponent in zip(step.images, key, strict=True):
            term = term * image**exponent
        total += term
    return total


def _root_in(
    polynomial: Polynomial,
    index: int,
    point: Point,
    source: random.Random,
    prime: int,
) -> int | None:
    """A root mod p of a polynomial in one generator, the others fixed."""
    coefficients: dict[int, int] = {}
    values = list(point)
    values[index] = 1
    parts: dict[int, dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in polynomial.to_dict().items():
        parts.setdefault(int(exponents[index]), {})[tuple(exponents)] = coefficient
    context = polynomial.context()
    for power, terms in parts.items():
        coefficients[power] = residue(context.from_dict(terms), values, prime)
    dense = [coefficients.get(k, 0) for k in range(max(coefficients) + 1)]
    roots = nmod_poly(dense, prime).roots()
    if not roots:
        return None
    return int(source.choice(roots)[0])


def _solve_pending(
    ring: TrigonometricRing,
    pending: Sequence[Polynomial],
    point: Point,
    source: random.Random,
    prime: int,
) -> Point | None:
    """Move the point onto all pending conditions, each along a generator of its own."""
    remaining = list(pending)
    while remaining:
        others = [set(_used(ring, p)) for p in remaining]
        for position, condition in enumerate(remaining):
            later = set().union(*others[:position], *others[position + 1 :])
            free = [u for u in others[position] if u not in later]
            if free:
                break
        else:
            return None
        remaining.pop(position)
        # Solve the others first: they do not contain the variable kept for this one.
        solved = _solve_pending(ring, remaining, point, source, prime)
        if solved is None:
            return None
        return _onto(ring, condition, free, solved, source, prime)
    return point


def _used(ring: TrigonometricRing, polynomial: Polynomial) -> list[tuple[str, int]]:
    degrees = polynomial.degrees()
    used = [("x", i) for i in ring.symbol_indices() if degrees[i]]
    used += [
        ("angle", k)
        for k in range(len(ring.basis))
        if degrees[ring.sine_index(k)] or degrees[ring.cosine_index(k)]
    ]
    return used


def _onto(
    ring: TrigonometricRing,
    condition: Polynomial,
    free: Sequence[tuple[str, int]],
    point: Point,
    source: random.Random,
    prime: int,
) -> Point | None:
    for kind, number in source.sample(list(free), len(free)):
        moved = list(point)
        if kind == "x":
            root = _root_in(condition, number, point, source, prime)
            if root:
                moved[number] = root
                return moved
        else:
            pair = _angle_root(ring, condition, number, point, source, prime)
            if pair is not None:
                moved[ring.cosine_index(number)], moved[ring.sine_index(number)] = pair
                return moved
    return None


def _angle_root(
    ring: TrigonometricRing,
    condition: Polynomial,
    angle: int,
    point: Point,
    source: random.Random,
    prime: int,
) -> tuple[int, int] | None:
    """(cos, sin) of an angle that makes the condition vanish, by its half-tangent."""
    sine, cosine = ring.sine_index(angle), ring.cosine_index(angle)
    parts: dict[tuple[int, int], dict[tuple[int, ...], Any]] = {}
    for exponents, coefficient in condition.to_dict().items():
        key = (int(exponents[sine]), int(exponents[cosine]))
        rest = tuple(0 if i in (sine, cosine) else e for i, e in enumerate(exponents))
        parts.setdefault(key, {})[rest] = coefficient
    degree = max(s + c for s, c in parts)
    context = condition.context()
    total = nmod_poly([0], prime)
    for (s, c), terms in parts.items():
        value = residue(context.from_dict(terms), point, prime)
        term = nmod_poly([value], prime)
        term *= nmod_poly([0, 2], prime) ** s * nmod_poly([1, 0, -1], prime) ** c
        total += term * nmod_poly([1, 0, 1], prime) ** (degree - s - c)
    if total == 0:
        return random_angle(source, prime)
    if total.degree() < 1:
        return None
    roots = [int(root) for root, _ in total.roots()]
    source.shuffle(roots)
    for t in roots:
        below = (1 + t * t) % prime
        if below:
            inverse = pow(below, -1, prime)
            return (1 - t * t) * inverse % prime, 2 * t * inverse % prime
    return None
