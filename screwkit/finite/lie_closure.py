"""Subalgebras of twists modulo a prime: what joints in series can generate.

The displacements of a chain lie in the subgroup whose algebra is the closure of the
chain's screws under the bracket, however far the joints move.  Where joints are tied
together, the twists at random joint values span less, and their closure is the smallest
algebra that counts.

References: [Herve1999], [MurrayLiSastry1994] App. A.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

ResidueScrew: TypeAlias = tuple[int, ...]
"""(ω; v) modulo the prime at hand."""

Word: TypeAlias = tuple[tuple[int, ResidueScrew], ...]
"""A product of exponentials, factor by factor: the number of a parameter and the screw
that it multiplies, the sign of the passage included."""

_Rotation: TypeAlias = tuple[tuple[int, ...], ...]
Displacement: TypeAlias = tuple[_Rotation, tuple[int, ...]]
"""A rotation matrix and the translation after it, modulo the prime."""

UNMOVED: Displacement = (((1, 0, 0), (0, 1, 0), (0, 0, 1)), (0, 0, 0))


class Span:
    """A growing space of residue vectors in echelon form."""

    def __init__(self, prime: int, rows: Iterable[Sequence[int]] = ()) -> None:
        self.prime = prime
        self._rows: dict[int, list[int]] = {}
        for row in rows:
            self.add(row)

    def __len__(self) -> int:
        return len(self._rows)

    def add(self, vector: Sequence[int]) -> bool:
        """Take a vector in; whether it was new."""
        prime = self.prime
        left = [x % prime for x in vector]
        for pivot, row in self._rows.items():
            factor = left[pivot]
            if factor:
                pairs = zip(left, row, strict=True)
                left = [(x - factor * y) % prime for x, y in pairs]
        if not any(left):
            return False
        pivot = next(i for i, x in enumerate(left) if x)
        inverse = pow(left[pivot], -1, prime)
        self._rows[pivot] = [x * inverse % prime for x in left]
        return True


def bracket(left: ResidueScrew, right: ResidueScrew, prime: int) -> ResidueScrew:
    """[left, right] of two twists (ω; v): (ω₁×ω₂; ω₁×v₂ + v₁×ω₂)."""
    a, b, c, d = left[:3], left[3:], right[:3], right[3:]
    turn = _cross(a, c)
    shift = [x + y for x, y in zip(_cross(a, d), _cross(b, c), strict=True)]
    return tuple(x % prime for x in (*turn, *shift))


def lie_closure(screws: Iterable[ResidueScrew], prime: int) -> list[ResidueScrew]:
    """Basis of the smallest algebra of twists that holds these screws."""
    span, basis = Span(prime), list[ResidueScrew]()
    waiting = list(screws)
    while waiting and len(basis) < 6:
        screw = waiting.pop()
        if span.add(screw):
            basis.append(screw)
            if len(basis) < 6:
                waiting.extend(bracket(screw, other, prime) for other in basis[:-1])
    return basis


def is_subalgebra(basis: Sequence[ResidueScrew], prime: int) -> bool:
    """Whether the bracket does not lead out of the span of independent screws."""
    return len(lie_closure(basis, prime)) == len(basis)


def loop_algebra(word: Word, prime: int) -> list[ResidueScrew]:
    """Algebra of a subgroup in which a loop's displacement stays at all joint values.

    With each parameter in one factor it is the closure of the screws.  Where factors
    share a parameter, the displacement W(q) satisfies ∂W/∂q W⁻¹ ∈ V with the span V of
    these twists over all q, so that W stays in the group of the closure of V; V is
    taken at random q until it no longer grows [Schwartz1980].  A loop may be entered
    anywhere, which conjugates W; the start with the smallest algebra is the best.
    """
    whole = lie_closure((screw for _, screw in word), prime)
    uses = Counter(parameter for parameter, _ in word)
    if len(uses) == len(word):
        return whole
    least = len(Span(prime, _tied_columns(word, prime)))
    best, samples = whole, _Samples(word, prime)
    for start, (parameter, _) in enumerate(word):
        if len(best) == least:
            break
        if uses[parameter] > 1 or uses[word[start - 1][0]] > 1:
            twists = samples.twists_anywhere(start, len(best))
            if len(twists) < len(best):
                best = min(best, lie_closure(twists, prime), key=len)
    return best


def _tied_columns(word: Word, prime: int) -> list[list[int]]:
    """The twist that each parameter alone gives at the posture."""
    columns: dict[int, list[int]] = {}
    for parameter, screw in word:
        column = columns.setdefault(parameter, [0] * 6)
        columns[parameter] = [
            (x + y) % prime for x, y in zip(column, screw, strict=True)
        ]
    return list(columns.values())


class _Samples:
    """Twists ∂W/∂q W⁻¹ of a loop at random parameter values, from any entrance.

    Entered behind its first k factors P the loop is P⁻¹WP.  There the factors behind
    follow P⁻¹, and those of P follow P⁻¹W: all entrances share one walk around.
    """

    def __init__(self, word: Word, prime: int) -> None:
        self._word, self._prime = word, prime
        self._source = random.Random(len(word))
        self._walks: list[_Walk] = []

    def twists_anywhere(self, start: int, most: int) -> list[ResidueScrew]:
        """Twists that span those at all values, the loop entered before a factor.

        No more are looked for than a given number.
        """
        span, found, grows = Span(self._prime), list[ResidueScrew](), True
        number = 0
        while grows and len(span) < most:
            grows = False
            for column in self._columns(number, start):
                if len(span) < most and span.add(column):
                    found.append(column)
                    grows = True
            number += 1
        return found

    def _columns(self, number: int, start: int) -> list[ResidueScrew]:
        if number == len(self._walks):
            self._walks.append(_walk(self._word, self._prime, self._source))
        walk, prime = self._walks[number], self._prime
        parameters = [parameter for parameter, _ in self._word]
        own = [*walk.again[:start], *walk.moved[start:]]
        columns = _tied_columns(tuple(zip(parameters, own, strict=True)), prime)
        home = _inverse(walk.before[start], prime)
        return [carried(home, column, prime) for column in columns]


@dataclass(frozen=True)
class _Walk:
    """A loop at random parameter values.

    Attributes:
        before: The displacement before each factor.
        moved: The screw of each factor after it.
        again: The same one turn of the loop later.
    """

    before: list[Displacement]
    moved: list[ResidueScrew]
    again: list[ResidueScrew]


def _walk(word: Word, prime: int, source: random.Random) -> _Walk:
    parameters = {parameter for parameter, _ in word}
    values = {
        p: (source.randrange(1, prime), source.randrange(prime))
        for p in sorted(parameters)
    }
    before, moved = list[Displacement](), list[ResidueScrew]()
    here = UNMOVED
    for parameter, screw in word:
        before.append(here)
        moved.append(carried(here, screw, prime))
        step = random_step(screw, *values[parameter], prime)
        here = composed(here, step, prime)
    return _Walk(before, moved, [carried(here, screw, prime) for screw in moved])


def random_step(
    screw: ResidueScrew, value: int, advance: int, prime: int
) -> Displacement:
    """A displacement of the screw's one-parameter group, by Cayley's parameter.

    The rotation is I + 2 (t[ω] + t²[ω]²) / (1 + t²ω·ω), so that opposite values undo
    each other.  The angle, which a helix advances by, is no algebraic function of t,
    and an independent residue.
    """
    w, v = screw[:3], screw[3:]
    square = sum(x * x for x in w) % prime
    if not square:
        return UNMOVED[0], tuple(value * x % prime for x in v)
    scale = 2 * value * pow(1 + value * value * square, -1, prime) % prime
    cross = ((0, -w[2], w[1]), (w[2], 0, -w[0]), (-w[1], w[0], 0))
    rotation = tuple(
        tuple(
            (
                int(i == j)
                + scale
                * (cross[i][j] + value * (w[i] * w[j] - (square if i == j else 0)))
            )
            % prime
            for j in range(3)
        )
        for i in range(3)
    )
    inverse = pow(square, -1, prime)
    point = [x * inverse % prime for x in _cross(w, v)]
    pitch = sum(x * y for x, y in zip(w, v, strict=True)) * inverse % prime
    advance = pitch * advance % prime
    image = _rotated(rotation, point, prime)
    return rotation, tuple(
        (x - y + advance * z) % prime for x, y, z in zip(point, image, w, strict=True)
    )


def composed(one: Displacement, other: Displacement, prime: int) -> Displacement:
    """The displacement that moves as the second does, and then as the first."""
    (first, here), (second, there) = one, other
    (a, b, c), (d, e, f), (g, h, i) = second
    product = tuple(
        (
            (x * a + y * d + z * g) % prime,
            (x * b + y * e + z * h) % prime,
            (x * c + y * f + z * i) % prime,
        )
        for x, y, z in first
    )
    u, v, w = _rotated(first, there, prime)
    return product, (
        (u + here[0]) % prime,
        (v + here[1]) % prime,
        (w + here[2]) % prime,
    )


def _inverse(displacement: Displacement, prime: int) -> Displacement:
    rotation, shift = displacement
    back = tuple(zip(*rotation, strict=True))
    return back, tuple(-x % prime for x in _rotated(back, shift, prime))


def carried(
    displacement: Displacement, screw: Sequence[int], prime: int
) -> ResidueScrew:
    """The screw after the displacement: (Rω; Rv + t×Rω)."""
    rotation, shift = displacement
    turn = _rotated(rotation, screw[:3], prime)
    u, v, w = _rotated(rotation, screw[3:], prime)
    x, y, z = _cross(shift, turn)
    return (*turn, (u + x) % prime, (v + y) % prime, (w + z) % prime)


def _rotated(rotation: _Rotation, vector: Sequence[int], prime: int) -> tuple[int, ...]:
    (a, b, c), (d, e, f), (g, h, i) = rotation
    x, y, z = vector
    return (
        (a * x + b * y + c * z) % prime,
        (d * x + e * y + f * z) % prime,
        (g * x + h * y + i * z) % prime,
    )


def _cross(a: Sequence[int], b: Sequence[int]) -> tuple[int, int, int]:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
