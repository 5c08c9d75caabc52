"""Closed solutions of one irreducible condition for one variable, with all branches.

A condition that is linear in the sine and cosine of a (merged) angle is solved by an
inverse function, one that is linear or quadratic in a symbol by a quotient or a root.
Branches are exact identities: putting one back into the condition gives zero wherever
it is defined and real.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from screwkit.algebra.angles import Merged, merged, natural, turning
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.closed_roots import closed_roots
from screwkit.algebra.closed_values import may_be_cosine
from screwkit.algebra.common_factors import may_vanish_together
from screwkit.algebra.constant_multiples import inverse, is_number
from screwkit.algebra.factors import Factor
from screwkit.algebra.half_angle import Form, HalfAngles
from screwkit.algebra.known_angles import turns_of_direction
from screwkit.algebra.polynomial_text import merged_text
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.solved_text import (
    AngleValue,
    Quotient,
    angle_values_text,
    root_of_square,
    short_slices,
)
from screwkit.algebra.trigonometric import (
    Polynomial,
    TrigonometricRing,
    as_fraction,
)

LONGEST_TEXT = 300  # characters of one branch

HALF = Fraction(1, 2)
Slices = dict[tuple[int, ...], Polynomial]


@dataclass(frozen=True)
class Solved:
    """A condition solved for one variable.

    Attributes:
        variable: Of the file.
        values: One text for every branch, in (−π, π] where that can be decided.
        modulo: ``pi`` when the branches are all those of one value mod π, else
            ``2*pi``; empty for lengths.
    """

    variable: str
    values: tuple[str, ...]
    modulo: str = ""


def solutions(
    ring: TrigonometricRing, factor: Factor, assumptions: Assumptions
) -> tuple[Solved, ...]:
    """Every variable for which the condition has short closed solutions.

    Args:
        ring: Of the factor.
        factor: The condition is that it vanishes.
        assumptions: Signs of symbols; they place branches in (−π, π].

    Returns:
        Simplest first, and of q6 − q1 = 0 the one for q6; empty where nothing short
        was found.  A quotient is meant where its denominator does not vanish.
    """
    short = merged(ring, factor.equations[0])
    if factor.form is not None:
        found = list(_of_half_angles(ring, factor.form, factor.equations))
    else:
        found = [
            *_angles(ring, short, assumptions),
            *_symbols(ring, short, assumptions),
        ]
    kept = [s for s in found if all(len(v) <= LONGEST_TEXT for v in s.values)]
    backwards = {n for form in short.forms for n, count in form if count < 0}
    kept.sort(key=lambda solved: natural(solved.variable))
    angles = [solved for solved in reversed(kept) if solved.modulo]
    ordered = angles + [solved for solved in kept if not solved.modulo]
    return tuple(sorted(ordered, key=lambda solved: _complexity(solved, backwards)))


def _complexity(solved: Solved, backwards: set[str]) -> tuple[bool, bool, int]:
    longest = max(len(value) for value in solved.values)
    trigonometric = any("cos(" in v or "sin(" in v for v in solved.values)
    return trigonometric, solved.variable in backwards, longest


# -- angles --------------------------------------------------------------------------


def _angles(
    ring: TrigonometricRing, short: Merged, assumptions: Assumptions
) -> Iterator[Solved]:
    degrees = short.polynomial.degrees()
    for i in range(len(ring.basis)):
        places = ring.sine_index(i), ring.cosine_index(i)
        if not any(degrees[place] for place in places):
            continue
        if i in short.exchanged:
            places = places[1], places[0]
        variables = _own_variables(ring, short, i)
        if not variables:
            continue
        slices = short_slices(ring, short.polynomial, places, LONGEST_TEXT)
        if slices is None:
            continue
        if may_vanish_together(ring, slices.values(), assumptions):
            continue
        for variable in variables:
            form, turned = short.forms[i], slices
            if dict(form)[variable] < 0:
                form = tuple((name, -count) for name, count in form)
                turned = {k: -v if k[0] % 2 else v for k, v in slices.items()}
            solved = _linear(ring, short, turned, assumptions) or _quadratic(
                ring, short, turned
            )
            if solved is not None:
                branches, modulo = solved
                values = angle_values_text(branches, form, variable)
                yield Solved(variable, values, modulo)


def _own_variables(ring: TrigonometricRing, short: Merged, angle: int) -> list[str]:
    """At most two declared angles to solve for, that occur nowhere else."""
    degrees = short.polynomial.degrees()
    others = turning(ring, short, angle)
    places = zip(ring.symbol_indices(), ring.symbols, strict=True)
    others |= {name for place, name in places if degrees[place]}
    own = [
        name
        for name, count in short.forms[angle]
        if abs(count) == 1 and name not in others and name not in ring.constant_angles
    ]
    return own[:2]


Branches = tuple[list[AngleValue], str]


def _linear(
    ring: TrigonometricRing, short: Merged, slices: Slices, assumptions: Assumptions
) -> Branches | None:
    """Branches of a·sin φ + b·cos φ + e = 0."""
    if not set(slices) <= {(1, 0), (0, 1), (0, 0)}:
        return None
    a, b, e = (_at(ring, slices, *key) for key in ((1, 0), (0, 1), (0, 0)))
    if e == 0:
        return _without_constant(ring, short, a, b, assumptions)
    if b == 0 or a == 0:
        ratio = Quotient.of(ring, short, -e, b if a == 0 else a)
        same = AngleValue.of_angle(ratio, short, is_cosine=a == 0)
        if same is not None:
            return same, "2*pi"
        core = AngleValue.inverse("acos" if a == 0 else "asin", ratio)
        if a == 0:
            return [core, -core], "2*pi"
        sign = ratio.sign(assumptions)
        return [core, (-core).plus(-1 if sign == -1 else 1)], "2*pi"
    branches = _general(ring, short, a, b, e)
    return (branches, "2*pi") if branches else None


def _without_constant(
    ring: TrigonometricRing,
    short: Merged,
    a: Polynomial,
    b: Polynomial,
    assumptions: Assumptions,
) -> Branches:
    if b == 0:
        return [AngleValue(), AngleValue().plus(1)], "pi"
    if a == 0:
        return [AngleValue().plus(HALF), AngleValue().plus(-HALF)], "pi"
    length = root_of_square(ring.normal(a * a + b * b))
    ratio = Quotient.of(ring, short, -b, a)
    if length is not None and not length.is_constant():
        halves = [Quotient.of(ring, short, a + s * length, b) for s in (1, -1)]
        ratio = min(halves, key=lambda q: (q.sign(assumptions) != 1, len(q.text)))
        core = AngleValue.inverse("atan", ratio, 2)
        return [core, core.plus(-1 if ratio.sign(assumptions) == 1 else 1)], "pi"
    if assumptions.is_nonzero(ring, a):
        core = AngleValue.inverse("atan", ratio)
        return [core, core.plus(-1 if ratio.sign(assumptions) == 1 else 1)], "pi"
    texts = [
        f"atan2({_text(ring, short, -s * b)}, {_text(ring, short, s * a)})"
        for s in (1, -1)
    ]
    return [AngleValue(text) for text in texts], "pi"


def _general(
    ring: TrigonometricRing, short: Merged, a: Polynomial, b: Polynomial, e: Polynomial
) -> list[AngleValue]:
    """(sin φ, cos φ) ∝ (−ae ∓ b√d, −be ± a√d) with d = a² + b² − e².

    Nothing where d is too long to be written.
    """
    inside = ring.normal(a * a + b * b - e * e)
    known = _known(ring, (a, b, e), inside)
    if known:
        return known
    if 4 * (len(inside) - 1) > LONGEST_TEXT:
        return []
    ae, be = ring.normal(-a * e), ring.normal(-b * e)
    if inside == 0:
        sine, cosine = _text(ring, short, ae), _text(ring, short, be)
        return [AngleValue(f"atan2({sine}, {cosine})")]
    root = f"sqrt({_text(ring, short, inside)})"
    branches = []
    for sign in (1, -1):
        sine = _plus_root(ring, short, ae, -sign * b, root)
        cosine = _plus_root(ring, short, be, sign * a, root)
        branches.append(AngleValue(f"atan2({sine}, {cosine})"))
    return branches


def _known(
    ring: TrigonometricRing, coefficients: Sequence[Polynomial], inside: Polynomial
) -> list[AngleValue]:
    """The branches of `_general` where numbers give them as multiples of π, or none."""
    a, b, e = coefficients
    root = root_of_square(inside) if inside != 0 else inside
    if root is None or not all(is_number(ring, v) for v in (a, b, e, root)):
        return []
    over = inverse(ring, ring.normal(a * a + b * b))
    found = []
    for sign in (1, -1) if root != 0 else (1,):
        cosine = ring.normal((sign * a * root - b * e) * over)
        sine = ring.normal((-sign * b * root - a * e) * over)
        turns = turns_of_direction(ring, cosine, sine)
        if turns is None:
            return []
        found.append(AngleValue(half_turns=turns))
    return found


def _plus_root(
    ring: TrigonometricRing,
    short: Merged,
    first: Polynomial,
    coefficient: Polynomial,
    root: str,
) -> str:
    """``first + coefficient*root``."""
    written = _text(ring, short, coefficient)
    if len(coefficient) > 1:
        term = f"({written})*{root}"
    else:
        term = {"1": root, "-1": f"-{root}"}.get(written, f"{written}*{root}")
    start = _text(ring, short, first)
    if term.startswith("-"):
        return f"{start} - {term[1:]}"
    return f"{start} + {term}"


def _quadratic(
    ring: TrigonometricRing, short: Merged, slices: Slices
) -> Branches | None:
    """Branches of conditions in tan φ, cos φ or sin φ alone that are quadratic."""
    if set(slices) <= {(2, 0), (1, 1), (0, 2), (0, 0)} and (1, 1) in slices:
        rest = _at(ring, slices, 0, 0)
        first = _at(ring, slices, 2, 0) + rest
        last = _at(ring, slices, 0, 2) + rest
        roots = _roots(ring, short, first, slices[1, 1], last) if first != 0 else []
        cores = [AngleValue(f"atan({text})") for text in roots]
        return ([v for c in cores for v in (c, c.plus(1))], "pi") if cores else None
    if max(sum(key) for key in slices) > 2:
        return None
    for name, place in (("acos", 1), ("asin", 0)):
        if not any(key[1 - place] for key in slices):
            c, b, a = (
                _at(ring, slices, *((0, k) if place else (k, 0))) for k in range(3)
            )
            roots = _roots(ring, short, a, b, c)
            cores = [AngleValue(f"{name}({x})") for x in roots if may_be_cosine(x)]
            if not cores:
                return None
            seconds = [-core if place else (-core).plus(1) for core in cores]
            pairs = zip(cores, seconds, strict=True)
            return [v for pair in pairs for v in pair], "2*pi"
    return None


def _at(ring: TrigonometricRing, slices: Slices, *key: int) -> Polynomial:
    return slices.get(key, ring.zero)


# -- symbols -------------------------------------------------------------------------


def _symbols(
    ring: TrigonometricRing, short: Merged, assumptions: Assumptions
) -> Iterator[Solved]:
    """Free lengths; of what is declared positive or nonzero only if nothing is free."""
    degrees = short.polynomial.degrees()
    declared = assumptions.positive | assumptions.nonzero
    turned = turning(ring, short)
    present = [
        (place, name)
        for place, name in zip(ring.symbol_indices(), ring.symbols, strict=True)
        if degrees[place] and name not in turned
    ]
    free = [pair for pair in present if pair[1] not in declared]
    for place, name in free or ([] if turned else present):
        slices = None
        if degrees[place] <= 2:
            slices = short_slices(ring, short.polynomial, (place,), LONGEST_TEXT)
        if slices is None or may_vanish_together(ring, slices.values(), assumptions):
            continue
        if max(slices) == (1,):
            ratio = Quotient.of(ring, short, -_at(ring, slices, 0), slices[1,])
            yield Solved(name, (ratio.text,))
        elif max(slices) == (2,):
            c, b = (_at(ring, slices, k) for k in (0, 1))
            yield Solved(name, tuple(_roots(ring, short, slices[2,], b, c)))


def _roots(
    ring: TrigonometricRing, short: Merged, a: Polynomial, b: Polynomial, c: Polynomial
) -> list[str]:
    """Both roots of ax² + bx + c; of numbers those that are real."""
    if a.is_constant() and b.is_constant() and c.is_constant():
        return list(closed_roots([as_fraction(k) for k in (c, b, a)]))
    if _text(ring, short, a).startswith("-"):
        a, b, c = -a, -b, -c
    if b == 0:
        square = Quotient.of(ring, short, -c, a).text
        return [f"sqrt({square})", f"-sqrt({square})"]
    even = all(int(k.p) % 2 == 0 and k.q == 1 for k in b.coeffs())
    half, below = (b / 2, a) if even else (b, 2 * a)
    inside = ring.normal(half * half - a * c * (1 if even else 4))
    if inside == 0:
        return [Quotient.of(ring, short, -half, below).text]
    root = f"sqrt({_text(ring, short, inside)})"
    start, written = _text(ring, short, -half), _text(ring, short, below)
    if below == 1:
        return [f"{start} {sign} {root}" for sign in "+-"]
    if len(below) > 1 or "*" in written:
        written = f"({written})"
    return [f"({start} {sign} {root})/{written}" for sign in "+-"]


# -- half angles ---------------------------------------------------------------------


def _of_half_angles(
    ring: TrigonometricRing, form: Form, equations: tuple[Polynomial, ...]
) -> Iterator[Solved]:
    """Of a·sin(q/2) + b·cos(q/2) = 0, and of a merged angle that is 0 or π."""
    for equation in equations:
        short = merged(ring, equation)
        turned = _half_turn(ring, short)
        if turned is not None:
            angle, value = turned
            for variable in _own_variables(ring, short, angle):
                core = AngleValue().plus(value)
                values = angle_values_text([core], short.forms[angle], variable)
                yield Solved(variable, values, "2*pi")
            return
    if len(form.odd) != 1 or form.degrees[form.odd[0]] != 1:
        return
    (angle,) = form.odd
    sine, cosine = HalfAngles(ring, Layout.of(ring)).linear_parts(form, angle)
    plain = Merged(ring.zero, ring.basis, frozenset())
    name = ring.basis[angle][0][0]
    degrees = form.degrees.keys() - {angle}
    shared = {n for i in degrees for n, _ in ring.basis[i]}
    if name in shared or abs(ring.basis[angle][0][1]) != 1:
        return
    ratio = Quotient.of(ring, plain, -cosine, sine)
    values = angle_values_text(
        [AngleValue.inverse("atan", ratio, 2)], ring.basis[angle], name
    )
    yield Solved(name, values, "2*pi")


def _half_turn(ring: TrigonometricRing, short: Merged) -> tuple[int, Fraction] | None:
    """(angle, 0 or 1) when the condition is cos φ = 1 or cos φ = −1."""
    if short.exchanged or len(short.polynomial) != 2:
        return None
    for i, cosine in enumerate(ring.cosines):
        for value in (0, 1):
            target = cosine - (-1) ** value
            if short.polynomial in (target, -target):
                return i, Fraction(value)
    return None


def _text(ring: TrigonometricRing, short: Merged, polynomial: Polynomial) -> str:
    return merged_text(ring, replace(short, polynomial=polynomial))
