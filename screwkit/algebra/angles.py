"""Sums of angles for print: seven terms in q2, q3, q4 that are sin(q2 + q3 + q4).

A unimodular change of angles, one φ = q_i ± q_j at a time, is kept while it drops
terms.  Which pair to try is read off: cos q_i cos q_j and sin q_i sin q_j
with the same companions and opposite coefficients hide a cosine of a sum.  Finally
each angle may express squares of its cosine by squares of its sine where that is
shorter.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass

from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

LONGEST = 40  # terms; longer polynomials keep the angles of their ring
TRIED = 3  # pairs tried in each round

Form = tuple[tuple[str, int], ...]


@dataclass(frozen=True, eq=False)
class Merged:
    """A polynomial whose angle generators stand for other angles.

    Attributes:
        polynomial: In the generators of the ring.
        forms: What each basis angle of the ring now stands for.
        exchanged: Angles whose sine generator stands for the cosine and vice versa.
    """

    polynomial: Polynomial
    forms: tuple[Form, ...]
    exchanged: frozenset[int]


def merged(ring: TrigonometricRing, polynomial: Polynomial) -> Merged:
    """The polynomial in angles that need few terms."""
    forms = [dict(form) for form in ring.basis]
    value = polynomial
    used = _angles(ring, value)
    if len(value) <= LONGEST and len(used) > 1:
        best = _best_step(ring, value, used)
        while best is not None:
            value, i, j, sign = best
            forms[i] = _sum(forms[i], forms[j], sign)
            best = _best_step(ring, value, used)
    flipped = [i for i in used if _points_backwards(forms[i])]
    for i in flipped:
        forms[i] = {name: -count for name, count in forms[i].items()}
    if flipped:
        value = _with_sines(ring, value, {i: -ring.sines[i] for i in flipped})
    exchanged = frozenset[int]()
    if len(value) <= LONGEST:
        value, exchanged = _shorter_squares(ring, value)
    return Merged(value, tuple(_ordered(form) for form in forms), exchanged)


def _angles(ring: TrigonometricRing, polynomial: Polynomial) -> list[int]:
    degrees = polynomial.degrees()
    return [
        i
        for i in range(len(ring.basis))
        if degrees[ring.sine_index(i)] or degrees[ring.cosine_index(i)]
    ]


def _best_step(
    ring: TrigonometricRing, polynomial: Polynomial, used: list[int]
) -> tuple[Polynomial, int, int, int] | None:
    """(polynomial, i, j, sign) with q_i replaced by q_i + sign·q_j and fewer terms."""
    best = None
    shortest = len(polynomial)
    for (i, j, sign), _ in _promising(ring, polynomial, used).most_common(TRIED):
        for replaced, other in ((i, j), (j, i)):
            candidate = _replaced(ring, polynomial, replaced, other, sign)
            if len(candidate) < shortest:
                shortest = len(candidate)
                best = candidate, replaced, other, sign
    return best


def _promising(
    ring: TrigonometricRing, polynomial: Polynomial, used: list[int]
) -> Counter[tuple[int, int, int]]:
    """How often the terms of a sum or difference of two angles occur in pairs."""
    found: Counter[tuple[int, int, int]] = Counter()
    terms = {tuple(map(int, e)): c for e, c in polynomial.to_dict().items()}
    places = {i: (ring.sine_index(i), ring.cosine_index(i)) for i in used}
    both = [i for i in used if all(polynomial.degrees()[k] for k in places[i])]
    for exponents, coefficient in terms.items():
        present = [i for i in both if exponents[places[i][1]]]
        for i, j in _pairs(present, both):
            (si, ci), (sj, cj) = places[i], places[j]
            if exponents[ci] and exponents[cj] and i < j:  # cos cos with sin sin
                partner = _moved(exponents, (ci, cj), (si, sj))
                kind = -1
            elif exponents[ci] and exponents[sj]:  # cos sin with sin cos
                partner = _moved(exponents, (ci, sj), (si, cj))
                kind = 1
                if i > j:
                    continue
            else:
                continue
            other = terms.get(partner)
            if other is not None and other in (coefficient, -coefficient):
                sign = 1 if (other == coefficient) == (kind == 1) else -1
                found[i, j, sign] += 1
    return found


def _pairs(first: list[int], second: list[int]) -> Iterator[tuple[int, int]]:
    return ((i, j) for i in first for j in second if i != j)


def _moved(
    exponents: tuple[int, ...], away: tuple[int, int], to: tuple[int, int]
) -> tuple[int, ...]:
    changed = list(exponents)
    for place in away:
        changed[place] -= 1
    for place in to:
        changed[place] += 1
    return tuple(changed)


def _replaced(
    ring: TrigonometricRing, polynomial: Polynomial, i: int, j: int, sign: int
) -> Polynomial:
    """With generator i standing for q_i + sign·q_j."""
    s, c = ring.sines[i], ring.cosines[i]
    other_sine, other_cosine = sign * ring.sines[j], ring.cosines[j]
    images = list(ring.context.gens())
    images[ring.sine_index(i)] = s * other_cosine - c * other_sine
    images[ring.cosine_index(i)] = c * other_cosine + s * other_sine
    return ring.normal(polynomial.compose(*images))


def _with_sines(
    ring: TrigonometricRing, polynomial: Polynomial, sines: dict[int, Polynomial]
) -> Polynomial:
    images = list(ring.context.gens())
    for i, sine in sines.items():
        images[ring.sine_index(i)] = sine
    return polynomial.compose(*images)


def _shorter_squares(
    ring: TrigonometricRing, polynomial: Polynomial
) -> tuple[Polynomial, frozenset[int]]:
    """With sine and cosine exchanged where squared sines are shorter than cosines."""
    exchanged = set()
    degrees = polynomial.degrees()
    for i in range(len(ring.basis)):
        s, c = ring.sine_index(i), ring.cosine_index(i)
        if degrees[c] > 1:
            images = list(ring.context.gens())
            images[s], images[c] = images[c], images[s]
            candidate = ring.normal(polynomial.compose(*images))
            if len(candidate) < len(polynomial):
                polynomial = candidate
                exchanged.add(i)
    return polynomial, frozenset(exchanged)


def _sum(left: dict[str, int], right: dict[str, int], sign: int) -> dict[str, int]:
    total = dict(left)
    for name, count in right.items():
        total[name] = total.get(name, 0) + sign * count
    return {name: count for name, count in total.items() if count}


def natural(name: str) -> tuple[tuple[int, int | str], ...]:
    """A key that sorts ``q2`` before ``q10``."""
    return tuple(
        (0, int(part)) if part.isdigit() else (1, part)
        for part in re.split(r"(\d+)", name)
        if part
    )


def _points_backwards(form: dict[str, int]) -> bool:
    """Whether −φ reads better than φ: fewer minus signs, or the last angle positive."""
    negative = sum(count < 0 for count in form.values())
    if 2 * negative != len(form):
        return 2 * negative > len(form)
    return form[max(form, key=natural)] < 0


def _ordered(form: dict[str, int]) -> Form:
    """Positive angles first."""
    return tuple(sorted(form.items(), key=lambda part: (part[1] < 0, natural(part[0]))))


def turning(ring: TrigonometricRing, short: Merged, but: int = -1) -> set[str]:
    """Declared angles of which sines or cosines occur, but for one merged angle."""
    degrees = short.polynomial.degrees()
    return {
        name
        for i, form in enumerate(short.forms)
        for name, _ in form
        if i != but and (degrees[ring.sine_index(i)] or degrees[ring.cosine_index(i)])
    }
