"""Polynomials on conditions that fix an angle up to half a turn.

P·sin φ + Q·cos φ = 0 says that φ points along (P, −Q), or against it, unless both
vanish: the axes of a limb in one plane, a link in line with the limb.  With
w = P·cos φ − Q·sin φ it follows that w² = P² + Q², cos φ = P/w and sin φ = −Q/w.  Where
conditions each fix an angle that occurs in no other, every polynomial is a sum of
products of their w, with coefficients in the other unknowns.  What all coefficients
share is a factor of the polynomial there, although it divides nothing that is written
in φ.

References: [CoxLittleOShea] §5.4 (the coordinate ring of a variety).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.algebra.branches import Branch, Pending
from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.division import Divisor
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.restrictions import Layout, coefficients
from screwkit.algebra.substitution import angle_parts
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive

_LONGEST = 4_000  # terms of a polynomial that is looked at
SEVERAL = 3
"""Angles that are fixed, each by a condition of its own: more than are solved well."""

_COEFFICIENTS = 4_000  # terms of all its coefficients together

_Key = tuple[int, ...]
_Parts = dict[_Key, Polynomial]


@dataclass(frozen=True)
class Direction:
    """An angle that a pending condition fixes up to half a turn.

    Attributes:
        angle: Its number; in no other pending condition.
        across: P.
        along: Q.
        pending: The condition P·sin φ + Q·cos φ = 0.
    """

    angle: int
    across: Polynomial
    along: Polynomial
    pending: Pending

    def length(self, ring: TrigonometricRing) -> Polynomial:
        """W = P·cos φ − Q·sin φ."""
        cosine, sine = ring.cosines[self.angle], ring.sines[self.angle]
        return ring.normal(self.across * cosine - self.along * sine)

    def square(self, ring: TrigonometricRing) -> Polynomial:
        """Of w: P² + Q²."""
        return ring.normal(self.across * self.across + self.along * self.along)


def fixed_directions(branch: Branch) -> list[Direction]:
    """The angles that pending conditions of a branch fix, each by its own."""
    ring = branch.ring
    found: list[Direction] = []
    for pending in branch.pending:
        if pending.companions or pending.beside:
            continue
        others = [p.value for p in branch.pending if p is not pending]
        for angle in range(len(ring.basis)):
            if any(occurs(ring, other, angle) for other in others):
                continue
            parts = angle_parts(ring, pending.value, angle)
            if parts is not None and parts[2] == 0:
                found.append(Direction(angle, parts[0], parts[1], pending))
                break
    return found


def has_directions_alone(branch: Branch) -> bool:
    """Whether conditions are pending, each of which fixes an angle of its own."""
    return 2 <= len(branch.pending) == len(fixed_directions(branch))


def is_mixed(branch: Branch) -> bool:
    """Whether conditions that fix angles are pending beside others."""
    return branch.directed and 0 < len(fixed_directions(branch)) < len(branch.pending)


def keeps_directions(
    branch: Branch, condition: Polynomial, left: Sequence[Polynomial]
) -> bool:
    """Whether a condition is better kept pending, beside others that fix angles.

    It contains such an angle, or is one of several that fix one each.
    """
    if not branch.directed:
        return False
    ring = branch.ring
    fixed = fixed_directions(branch)
    if len(fixed) < len(branch.pending):
        return False
    if any(occurs(ring, condition, d.angle) for d in fixed):
        return True
    if fixes_angle(ring, condition) is None:
        return False
    others = {fixes_angle(ring, p) for p in left} - {None}
    return len(fixed) + len(others) >= SEVERAL


def fixes_angle(ring: TrigonometricRing, condition: Polynomial) -> int | None:
    """The number of an angle that a condition fixes up to half a turn, if it does."""
    if condition == 0:
        return None
    for angle in range(len(ring.basis)):
        parts = angle_parts(ring, condition, angle)
        if parts is not None and parts[2] == 0:
            return angle
    return None


def occurs(ring: TrigonometricRing, polynomial: Polynomial, angle: int) -> bool:
    """Whether a polynomial contains the sine or the cosine of an angle."""
    degrees = polynomial.degrees()
    return bool(degrees[ring.sine_index(angle)] or degrees[ring.cosine_index(angle)])


@dataclass(frozen=True)
class Parted:
    """A polynomial as a product, where directions are fixed and none is (0, 0).

    Attributes:
        content: A factor in the other unknowns alone.
        rest: The other one, which has no such factor.
    """

    content: Polynomial
    rest: Polynomial


def parted(
    ring: TrigonometricRing,
    polynomial: Polynomial,
    directions: Sequence[Direction],
    library: FactorLibrary,
) -> Parted | None:
    """A polynomial where some angles are fixed.

    Args:
        ring: Of the polynomial.
        polynomial: In normal form, not zero.
        directions: Of angles that occur in it, none in the condition of another.
        library: Factors met before.

    Returns:
        Two polynomials; where no direction is (0, 0), the polynomial vanishes where one
        of them does.  None where it is too long, or where nothing is shared that does
        not divide it as it stands.
    """
    found = _shared(ring, polynomial, directions, library)
    if found is None:
        return None
    content, shorter = found
    if _divisor(ring, content).divide(polynomial) is not None:
        return None
    written = _written(ring, shorter, directions)
    return Parted(primitive(content), primitive(written))


def over_roots(
    ring: TrigonometricRing, polynomial: Polynomial, directions: Sequence[Direction]
) -> _Parts | None:
    """A polynomial as a sum of coefficients over products of the w.

    Args:
        ring: Of the polynomial.
        polynomial: In normal form, not zero.
        directions: Of angles, none in the condition of another.

    Returns:
        The coefficients in the other unknowns, by which of the w stand below them; up
        to a product of powers of the w².  None where it is too long.
    """
    if len(polynomial) > _LONGEST:
        return None
    parts: _Parts = {(): polynomial}
    for direction in directions:
        parts = _split(ring, parts, direction)
        if not parts or sum(map(len, parts.values())) > _COEFFICIENTS:
            return None
    return parts


def vanish_on_directions(
    branch: Branch, polynomials: Sequence[Polynomial], directions: Sequence[Direction]
) -> bool:
    """Whether polynomials are seen to vanish where no direction is (0, 0).

    All their coefficients over the w are multiples of one more condition.

    Args:
        branch: Where these directions are pending, and other conditions.
        polynomials: In the generators left on the branch.
        directions: Each with an angle of its own.
    """
    ring = branch.ring
    held = [direction.pending for direction in directions]
    others = [p.value for p in branch.pending if p not in held and not p.companions]
    divisors = [_divisor(ring, other) for other in others]
    for polynomial in polynomials:
        parts = over_roots(ring, polynomial, directions) if polynomial != 0 else {}
        if parts is None or not all(
            any(divisor.divide(part) is not None for divisor in divisors)
            for part in parts.values()
        ):
            return False
    return True


def _shared(
    ring: TrigonometricRing,
    polynomial: Polynomial,
    directions: Sequence[Direction],
    library: FactorLibrary,
) -> tuple[Polynomial, _Parts] | None:
    """What all coefficients share, and these without it; None where too long."""
    parts = over_roots(ring, polynomial, directions)
    if parts is None:
        return None
    column = list(parts.values())
    rest = without_common_factors(ring, column, library)
    place = min(range(len(column)), key=lambda k: len(column[k]))
    content = _divisor(ring, rest[place]).divide(column[place])
    if content is None:
        return None
    return ring.normal(content), dict(zip(parts, rest, strict=True))


def _split(ring: TrigonometricRing, parts: _Parts, direction: Direction) -> _Parts:
    """Coefficients E + O/w of each part, without the powers of w² that all share.

    With N = w², a monomial of degree d in sin φ and cos φ is one in P and Q over w^d.
    """
    places = ring.sine_index(direction.angle), ring.cosine_index(direction.angle)
    gathered = {k: coefficients(v, places) for k, v in parts.items()}
    most = max(sum(powers) // 2 for own in gathered.values() for powers in own)
    square = direction.square(ring)
    found: _Parts = {}
    for key, own in gathered.items():
        for (sine, cosine), part in own.items():
            half, odd = divmod(sine + cosine, 2)
            value = ring.normal(part * (-direction.along) ** sine)
            value = ring.normal(value * direction.across**cosine)
            value = ring.normal(value * square ** (most - half))
            place = (*key, odd)
            found[place] = found.get(place, ring.zero) + value
    found = {key: v for key, value in found.items() if (v := ring.normal(value)) != 0}
    return _without(ring, found, square)


def _without(ring: TrigonometricRing, parts: _Parts, square: Polynomial) -> _Parts:
    """The parts, divided by a polynomial as often as it divides all of them."""
    if square.is_constant():
        return parts
    divisor = _divisor(ring, square)
    while parts:
        quotients = {}
        for key, value in sorted(parts.items(), key=lambda item: len(item[1])):
            quotient = divisor.divide(value)
            if quotient is None:
                return parts
            quotients[key] = ring.normal(quotient)
        parts = {key: quotients[key] for key in parts}
    return parts


def _divisor(ring: TrigonometricRing, polynomial: Polynomial) -> Divisor:
    layout = Layout.of(ring)
    return Divisor(polynomial, ring, HalfAngles(ring, layout), layout)


def _written(
    ring: TrigonometricRing, parts: _Parts, directions: Sequence[Direction]
) -> Polynomial:
    """The sum of the parts E + O/w, as a polynomial in the angles.

    O = A·P + B·Q is written A·cos φ − B·sin φ where all O of a direction are such sums;
    else E·w + O, which vanishes where P and Q do.
    """
    for direction in directions:
        plain: _Parts = {}
        odd: _Parts = {}
        for (own, *key), value in parts.items():
            (odd if own else plain)[tuple(key)] = value
        if plain and odd:
            turned = {
                key: _turned(ring, value, direction) for key, value in odd.items()
            }
            whole: _Parts = {k: v for k, v in turned.items() if v is not None}
            if len(whole) == len(odd):
                odd = whole
            else:
                length = direction.length(ring)
                plain = {k: ring.normal(v * length) for k, v in plain.items()}
        parts = dict(plain)
        for rest, value in odd.items():
            parts[rest] = ring.normal(parts.get(rest, ring.zero) + value)
    return parts[()]


def _turned(
    ring: TrigonometricRing, value: Polynomial, direction: Direction
) -> Polynomial | None:
    """A·cos φ − B·sin φ for A·P + B·Q; None where a remainder is left."""
    total = ring.zero
    cosine, sine = ring.cosines[direction.angle], ring.sines[direction.angle]
    for one, by in ((direction.across, cosine), (direction.along, -sine)):
        if one != 0:
            quotient, value = divmod(value, one)
            total += quotient * by
    return ring.normal(total) if value == 0 else None
