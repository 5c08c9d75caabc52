"""Simple forms that a sum of bracket monomials may have: meets of planes and lines.

A form and the sum are compared at exact points: where they are proportional with one
factor at several random postures, they are the same up to that factor
[Schwartz1980].

References: [BenHorinShoham2006]; [BenHorinShoham2009]; [DowningSamuelHunt2002].
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TypeAlias

from screwkit.algebra.ring import S
from screwkit.loci.brackets import (
    TERMS,
    Bracket,
    Line,
    Monomial,
    bracket,
    common_brackets,
    plane,
)

Group: TypeAlias = tuple[int, ...]

TRIED = 6_000
"""Forms that are compared with one sum."""


@dataclass(frozen=True)
class Form:
    """Points that lie in one plane, or planes and a line that meet in one point.

    Attributes:
        groups: One group of four points; or triples, and at most one pair; or three
            pairs, lines whose directions are parallel to one plane.
        ideal: Whether the three pairs are lines at infinity, of couples: then their
            moments are parallel to one plane.
    """

    groups: tuple[Group, ...]
    ideal: bool = False

    def value(self, points: Sequence[Sequence[S]]) -> S:
        """Zero exactly where it holds, or where a line or plane is none."""
        rows = [[points[i] for i in group] for group in self.groups]
        if len(rows) == 1:
            return bracket(rows[0])
        if all(len(two) == 2 for two in rows):
            along = _moment if self.ideal else _direction
            return _triple([along(a, b) for a, b in rows])
        planes = [plane(three) for three in rows if len(three) == 3]
        if len(planes) == 4:
            return bracket(planes)
        (line,) = (two for two in rows if len(two) == 2)
        (a, b), (one, other) = line, planes
        return _on(one, a) * _on(other, b) - _on(one, b) * _on(other, a)


def _on(of: Sequence[S], point: Sequence[S]) -> S:
    return of[0] * point[0] + of[1] * point[1] + of[2] * point[2] + of[3] * point[3]


def _direction(a: Sequence[S], b: Sequence[S]) -> list[S]:
    return [a[3] * b[i] - b[3] * a[i] for i in range(3)]


def _moment(a: Sequence[S], b: Sequence[S]) -> list[S]:
    pairs = ((1, 2), (2, 0), (0, 1))
    return [a[i] * b[j] - a[j] * b[i] for i, j in pairs]


def _triple(rows: Sequence[Sequence[S]]) -> S:
    a, b, c = rows
    normal = _moment(b, c)
    return a[0] * normal[0] + a[1] * normal[1] + a[2] * normal[2]


@dataclass(frozen=True)
class Sample:
    """Points at an exact posture.

    Attributes:
        points: Homogeneous coordinates, residues.
        prime: The modulus.
    """

    points: Sequence[Sequence[int]]
    prime: int

    def of(self, form: Form) -> int:
        """The value of a form."""
        return form.value(self.points) % self.prime

    def sum_of(self, monomials: Mapping[Monomial, int]) -> int:
        """The value of a sum of monomials."""
        return (
            sum(count * self.product_of(m) for m, count in monomials.items())
            % self.prime
        )

    def product_of(self, brackets: Sequence[Bracket]) -> int:
        """The value of a product of brackets."""
        total = 1
        for one in brackets:
            total = total * self.of(Form((one,))) % self.prime
        return total


def product_of(
    monomials: Mapping[Monomial, int],
    lines: Sequence[Line],
    ideal: Sequence[bool],
    samples: Sequence[Sample],
) -> tuple[Form, ...] | None:
    """The sum as a product of forms; None where none of the known ones is it.

    Args:
        monomials: Their sum is not zero at the samples.
        lines: Whose superbracket it is.
        ideal: Of each point, whether it is a direction.
        samples: Random postures; all but the first confirm what the first suggests.
    """
    shared = common_brackets(monomials)
    rest = {_without(m, shared): count for m, count in monomials.items()}
    outside = tuple(Form((b,)) for b in shared)
    if len(rest) == 1:
        return outside
    couples = tuple(line for line in lines if all(ideal[i] for i in line))
    if len(couples) == 3:
        # A couple has no force: the determinant of six lines is one of two blocks.
        forces = tuple(line for line in lines if line not in couples)
        blocks = Form(forces), Form(couples, ideal=True)
        whole = [s.sum_of(monomials) for s in samples]
        return blocks if _proportional(blocks, whole, samples) else None
    if len(monomials) == len(TERMS):
        return None
    values = [s.sum_of(rest) for s in samples]
    content = Counter(i for b in next(iter(rest)) for i in b)
    for number, forms in enumerate(_candidates(content)):
        if number >= TRIED:
            return None
        if _proportional(forms, values, samples):
            return (*outside, *forms)
    return None


def _without(monomial: Monomial, shared: Sequence[Bracket]) -> Monomial:
    left = Counter(monomial) - Counter(shared)
    return tuple(sorted(left.elements()))


def _proportional(
    forms: Sequence[Form], values: Sequence[int], samples: Sequence[Sample]
) -> bool:
    """Whether a product of forms is one multiple of these values."""
    first = _product(forms, samples[0])
    if not first or not values[0]:
        return False
    return all(
        (_product(forms, sample) * values[0] - first * value) % sample.prime == 0
        for sample, value in zip(samples[1:], values[1:], strict=True)
    )


def _product(forms: Sequence[Form], sample: Sample) -> int:
    total = 1
    for form in forms:
        total = total * sample.of(form) % sample.prime
    return total


def _candidates(content: Counter[int]) -> Iterator[tuple[Form, ...]]:
    """Products of forms in which each point stands as often as in the sum."""
    size = content.total()
    if size == 8:
        for groups in _groups(content, (3, 3, 2)):
            yield (Form(groups),)
    if size == 12:
        for groups in _groups(content, (3, 3, 3, 3)):
            yield (Form(groups),)
        for groups in _groups(content, (4, 3, 3, 2)):
            yield Form(groups[:1]), Form(groups[1:])


def _groups(content: Counter[int], sizes: Sequence[int]) -> Iterator[tuple[Group, ...]]:
    """Sets of different points of these sizes that use up the content."""
    if not sizes:
        yield ()
        return
    several = len(sizes) > 1 and sizes[0] == sizes[1]
    for group in combinations(sorted(content), sizes[0]):
        left = content - Counter(group)
        if max(left.values(), default=0) > len(sizes) - 1:
            continue
        for rest in _groups(left, sizes[1:]):
            if not several or group <= rest[0]:
                yield (group, *rest)
