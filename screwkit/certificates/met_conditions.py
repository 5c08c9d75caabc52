"""In which order the conditions of a sheet are met, for the search of trees.

Each has an unknown that those before it lack, or several are linear in as many symbols
together.  What the certificate says of them is checked in `towers`.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations, islice

from screwkit.algebra.branches import Branch, Pending
from screwkit.algebra.division import exact_quotient
from screwkit.algebra.linear_systems import linear_systems
from screwkit.algebra.modular import rank
from screwkit.algebra.points import differential
from screwkit.algebra.points_on import Unknown, unknowns
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.certificates.conditions import Place
from screwkit.certificates.equations_told import Unsolved

HIGHEST = 4
"""Degree in a symbol, or in sine and cosine of an angle."""

MOST = 24
"""Orders that are looked at."""

ORDERS = 4
"""Of the same conditions."""


@dataclass(frozen=True)
class Met:
    """A condition with its unknown, or several with a symbol each.

    Attributes:
        pending: The conditions.
        unknown: Of each.
        degree: In it.
        coefficients: Where all of them vanish the conditions say nothing of the
            unknowns: of one condition its coefficients, of several the determinant.
    """

    pending: tuple[Pending, ...]
    unknown: tuple[Unknown, ...]
    degree: int
    coefficients: tuple[Polynomial, ...]

    def written(self, ring: TrigonometricRing) -> Unsolved:
        """In the terms of a certificate."""
        first, *more = (
            _unsolved(ring, own, unknown, self.degree)
            for own, unknown in zip(self.pending, self.unknown, strict=True)
        )
        return Unsolved(
            first.equation, first.angle, first.symbol, first.degree, tuple(more)
        )


def _unsolved(
    ring: TrigonometricRing, own: Pending, unknown: Unknown, degree: int
) -> Unsolved:
    kind, index = unknown
    written = text(ring, own.condition)
    if kind == "x":
        name = ring.symbols[index - ring.symbol_indices().start]
        return Unsolved(written, symbol=name, degree=degree)
    return Unsolved(written, angle=index, degree=degree)


def orders(place: Place) -> Iterator[tuple[Met, ...]]:
    """Orders in which conditions of a node can be met.

    As many as there are independent ones come first: the others may vanish where these
    do.
    """
    branch = place.branch
    told = [
        own
        for own in branch.pending
        if not _is_multiple(own, branch.pending)
        # the checker knows nothing of what steps multiplied it with
        and not place.followed[place.number(own)][1]
    ]
    alone = standing_alone(branch, told)
    told = [own for own in told if all(own not in met.pending for met in alone)]
    likely = _independent(branch, told)
    sizes = sorted(range(len(told) + 1), key=lambda size: (abs(size - likely), size))
    found = 0
    for size in sizes:
        for kept in combinations(told, size):
            for order in islice(_orders(branch, kept), ORDERS):
                yield (*alone, *order)
                found += 1
                if found >= MOST:
                    return


def standing_alone(branch: Branch, told: Sequence[Pending]) -> tuple[Met, ...]:
    """Conditions without an unknown of the others, with a coefficient that is a number.

    As sin q = 0 where no other condition holds q.
    """
    ring = branch.ring
    inside = [{*unknowns(ring, own.value)} for own in told]
    found = []
    for number, own in enumerate(told):
        if inside[number] & set().union(*inside[:number], *inside[number + 1 :]):
            continue
        for unknown in sorted(inside[number]):
            parts = coefficients(ring, own.value, unknown)
            if parts is not None and any(part.is_constant() for part in parts[1]):
                found.append(Met((own,), (unknown,), *parts))
                break
    return tuple(found)


def _independent(branch: Branch, told: Sequence[Pending]) -> int:
    """How many conditions are independent at a point; all where none is known."""
    for point, prime in branch.points[:1]:
        rows = [differential(branch.ring, own.value, point, prime) for own in told]
        return rank(rows, prime)
    return len(told)


def _is_multiple(own: Pending, others: Sequence[Pending]) -> bool:
    """Whether a condition is a multiple of a shorter one."""
    return any(
        len(other.value) < len(own.value)
        and exact_quotient(own.value, other.value) is not None
        for other in others
    )


def _orders(branch: Branch, left: Sequence[Pending]) -> Iterator[tuple[Met, ...]]:
    if not left:
        yield ()
        return
    ring, dimensions = branch.ring, {("x", index) for index in branch.dimensions}
    inside = [{*unknowns(ring, own.value)} for own in left]
    found = list[Met]()
    for number, own in enumerate(left):
        others = set().union(*inside[:number], *inside[number + 1 :])
        for unknown in sorted(inside[number] - others):
            parts = coefficients(ring, own.value, unknown)
            if parts is not None:
                degree, nonzero = parts
                found.append(Met((own,), (unknown,), degree, nonzero))
    if not found:
        found = [*_systems(ring, left)]
    # what is left where coefficients of a dimension vanish is hard to take apart
    found.sort(
        key=lambda met: (
            bool(dimensions & {*met.unknown}),
            met.degree,
            sum(map(len, met.coefficients)),
        )
    )
    for met in found:
        rest = [own for own in left if own not in met.pending]
        for order in _orders(branch, rest):
            yield (*order, met)


def _systems(ring: TrigonometricRing, left: Sequence[Pending]) -> Iterator[Met]:
    for system in linear_systems(ring, [own.value for own in left]):
        own = tuple(left[k] for k in system.conditions)
        symbols = tuple(("x", index) for index in system.symbols)
        yield Met(own, symbols, 1, (system.determinant,))


def coefficients(
    ring: TrigonometricRing, value: Polynomial, unknown: Unknown
) -> tuple[int, tuple[Polynomial, ...]] | None:
    """The degree in an unknown and the coefficients that are not 0.

    In a symbol those of its powers, in an angle φ those of cos^j φ and sin φ·cos^j φ.
    None where the degree is too high.
    """
    kind, index = unknown
    if kind == "x":
        by_power = _by_exponents(ring, value, (index,))
        degree = max(power for (power,) in by_power)
    else:
        by_power, degree = _in_angle(ring, value, index)
    if not 1 <= degree <= HIGHEST:
        return None
    return degree, tuple(own for own in by_power.values() if own != 0)


def _in_angle(
    ring: TrigonometricRing, value: Polynomial, angle: int
) -> tuple[dict[tuple[int, ...], Polynomial], int]:
    """By powers of sine, up to the first, and cosine; and the degree in both."""
    places = ring.sine_index(angle), ring.cosine_index(angle)
    found: dict[tuple[int, ...], Polynomial] = {}
    for (sine, cosine), own in _by_exponents(ring, value, places).items():
        # sin²φ = 1 − cos²φ, as often as it goes
        terms = {cosine: own}
        for _ in range(sine // 2):
            wider = dict[int, Polynomial]()
            for power, factor in terms.items():
                wider[power] = wider.get(power, ring.zero) + factor
                wider[power + 2] = wider.get(power + 2, ring.zero) - factor
            terms = wider
        for power, factor in terms.items():
            key = (sine % 2, power)
            found[key] = found.get(key, ring.zero) + factor
    kept = {key: own for key, own in found.items() if own != 0}
    return kept, max((a + b for a, b in kept), default=0)


def _by_exponents(
    ring: TrigonometricRing, value: Polynomial, places: Sequence[int]
) -> Mapping[tuple[int, ...], Polynomial]:
    """The coefficients of powers of some generators."""
    terms: dict[tuple[int, ...], dict[tuple[int, ...], object]] = {}
    for exponents, coefficient in value.to_dict().items():
        key = tuple(int(exponents[place]) for place in places)
        left = tuple(0 if k in places else int(e) for k, e in enumerate(exponents))
        terms.setdefault(key, {})[left] = coefficient
    return {key: ring.context.from_dict(own) for key, own in terms.items()}
