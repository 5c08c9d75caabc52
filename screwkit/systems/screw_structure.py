"""What a system of screws consists of, by linear algebra over a prime field.

A system is split, without regard to the basis that spans it, into its pure moments
(translations; couples), the directions to which they are all normal, whose screws have
a definite pitch, and the other directions, whose screws can be taken with pitch zero.
All that a class of systems can depend on is in these three parts.

References: [Hunt1978], ch. 12.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations
from typing import TypeAlias

from screwkit.algebra.modular import annihilator
from screwkit.conventions import DIRECTION, MOMENT, SCREW_DIMENSION
from screwkit.kinematics.subspaces import Row, reciprocal
from screwkit.screw.vector import add, cross, dot, scaled

Residues: TypeAlias = tuple[int, ...]


@dataclass(frozen=True)
class ScrewStructure:
    """A system of screws modulo a prime.

    Attributes:
        basis: Its reduced echelon form, which the system determines: first the screws
            with a direction, then the pure moments (0; u).
    """

    basis: tuple[Residues, ...]
    prime: int

    @classmethod
    def spanned_by(cls, screws: Sequence[Row], prime: int) -> ScrewStructure:
        """The system of all combinations of these screws."""
        return cls(echelon(screws, prime), prime)

    @property
    def dimension(self) -> int:
        """Of the system."""
        return len(self.basis)

    @property
    def turning(self) -> tuple[Residues, ...]:
        """The screws of the basis that have a direction."""
        return tuple(screw for screw in self.basis if any(screw[DIRECTION]))

    @property
    def directions(self) -> tuple[Residues, ...]:
        """Basis of the directions that occur."""
        return tuple(screw[DIRECTION] for screw in self.turning)

    @property
    def moments(self) -> tuple[Residues, ...]:
        """Basis of the pure moments."""
        return tuple(screw[MOMENT] for screw in self.basis[len(self.turning) :])

    @cached_property
    def reciprocal(self) -> ScrewStructure:
        """The reciprocal system."""
        screws = reciprocal(self.basis, self.prime)
        return ScrewStructure.spanned_by(screws, self.prime)

    @cached_property
    def pitched(self) -> tuple[Residues, ...]:
        """Screws along an echelon basis of the directions normal to all pure moments.

        Their pitches, and those of their combinations, are the same for every choice
        modulo the pure moments.  This one has reciprocal product 0 with `free`.
        """
        return self._settled(self._pitched_directions)

    @cached_property
    def free(self) -> tuple[Residues, ...]:
        """Screws along the directions orthogonal to those of `pitched`, reciprocal.

        Pure moments along their directions exist, so that their pitch can be any
        number; here it is 0, also for combinations.
        """
        return self._settled(self._free_directions)

    @cached_property
    def closed(self) -> bool:
        """Whether it holds the Lie bracket of any two of its screws, read as twists."""
        return self.hull.dimension == self.dimension

    @cached_property
    def hull(self) -> ScrewStructure:
        """The smallest system around this one that is closed under the Lie bracket."""
        brackets = [bracket(a, b) for a, b in combinations(self.basis, 2)]
        grown = ScrewStructure.spanned_by([*self.basis, *brackets], self.prime)
        return self if grown.dimension == self.dimension else grown.hull

    # -- the split of the directions ---------------------------------------------

    @cached_property
    def _pitched_directions(self) -> tuple[Residues, ...]:
        return normal_part(self.directions, self.moments, self.prime)

    @cached_property
    def _free_directions(self) -> tuple[Residues, ...]:
        return normal_part(self.directions, self._pitched_directions, self.prime)

    def _settled(self, directions: Sequence[Residues]) -> tuple[Residues, ...]:
        """Screws along these, moved by pure moments to pitch 0 where that can be."""
        p = self.prime
        across = normal_part(self.moments, self._free_directions, p)
        along = normal_part(self.moments, across, p)
        free = [self._above(direction) for direction in self._free_directions]
        settled = []
        for direction in directions:
            screw = self._above(direction)
            share = pow(2, -1, p) if direction in self._free_directions else 1
            wanted = [-share * product(screw, other) for other in free]
            forms = [[dot(u, w) for u in along] for w in self._free_directions]
            weights = solve(forms, wanted, p)
            shift = combination(weights, along, p)
            moment = add(screw[MOMENT], shift)
            settled.append((*direction, *(x % p for x in moment)))
        return tuple(settled)

    def _above(self, direction: Residues) -> Residues:
        """The screw with this direction whose moment is normal to the pure moments."""
        p = self.prime
        transposed = [list(column) for column in zip(*self.directions, strict=True)]
        screw = combination(solve(transposed, direction, p), self.turning, p)
        moment = screw[MOMENT]
        gram = [[dot(a, b) for b in self.moments] for a in self.moments]
        weights = solve(gram, [-dot(u, moment) for u in self.moments], p)
        moment = add(moment, combination(weights, self.moments, p))
        return (*screw[DIRECTION], *(x % p for x in moment))


# -- screws ----------------------------------------------------------------------


def bracket(a: Residues, b: Residues) -> Residues:
    """The Lie bracket of two twists, not reduced."""
    turned = cross(a[DIRECTION], b[DIRECTION])
    moved = add(cross(a[DIRECTION], b[MOMENT]), cross(a[MOMENT], b[DIRECTION]))
    return *turned, *moved


def product(a: Residues, b: Residues) -> int:
    """The reciprocal product, not reduced; 2·pitch·|direction|² where a is b."""
    return dot(a[DIRECTION], b[MOMENT]) + dot(a[MOMENT], b[DIRECTION])


def pitch(screw: Residues, prime: int) -> int:
    """Advance along the axis for each radian, the direction not zero."""
    direction = screw[DIRECTION]
    below = pow(dot(direction, direction), -1, prime)
    return dot(direction, screw[MOMENT]) * below % prime


def foot(screw: Residues, prime: int) -> Residues:
    """The point of a screw's axis that is nearest to the origin."""
    direction = screw[DIRECTION]
    below = pow(dot(direction, direction), -1, prime)
    raised = scaled(below, cross(direction, screw[MOMENT]))
    return tuple(x % prime for x in raised)


def centre(screws: Sequence[Residues], prime: int) -> Residues:
    """The point about which moments depend symmetrically on directions.

    Args:
        screws: Two or three with independent directions.  For two, the axes of all
            combinations cross the line through the centre normal to the directions.
        prime: The modulus.
    """
    forms, wanted = [], []
    for a, b in combinations(screws, 2):
        forms.append(scaled(2, cross(a[DIRECTION], b[DIRECTION])))
        crossed = dot(b[DIRECTION], a[MOMENT]) - dot(a[DIRECTION], b[MOMENT])
        wanted.append(crossed)
    if len(screws) == 2:
        normal = cross(screws[0][DIRECTION], screws[1][DIRECTION])
        for screw in screws:
            forms.append(cross(normal, screw[DIRECTION]))
            wanted.append(-dot(normal, screw[MOMENT]))
    return tuple(solve(forms, wanted, prime))


# -- linear algebra --------------------------------------------------------------


def echelon(rows: Sequence[Row], prime: int) -> tuple[Residues, ...]:
    """Reduced row echelon form without rows of zeros."""
    left = [[int(x) % prime for x in row] for row in rows]
    done: list[list[int]] = []
    for column in range(max(map(len, left), default=0)):
        pivot = next((row for row in left if row[column]), None)
        if pivot is None:
            continue
        left.remove(pivot)
        inverse = pow(pivot[column], -1, prime)
        pivot = [x * inverse % prime for x in pivot]
        left, done = (
            [
                [(x - row[column] * y) % prime for x, y in zip(row, pivot, strict=True)]
                for row in part
            ]
            for part in (left, done)
        )
        done.append(pivot)
    return tuple(map(tuple, done))


def solve(matrix: Sequence[Row], right: Sequence[int], prime: int) -> list[int]:
    """The solution of a consistent system with independent columns."""
    if not matrix or not matrix[0]:
        return []
    augmented = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    return [row[-1] for row in echelon(augmented, prime)]


def combination(weights: Sequence[int], rows: Sequence[Row], prime: int) -> Residues:
    """Σ weight·row; without rows, zeros as many as a screw or a vector needs."""
    width = len(rows[0]) if rows else SCREW_DIMENSION // 2
    return tuple(
        sum(w * row[i] for w, row in zip(weights, rows, strict=True)) % prime
        for i in range(width)
    )


def normal_part(
    space: Sequence[Residues], others: Sequence[Residues], prime: int
) -> tuple[Residues, ...]:
    """Echelon basis of the vectors of ``space`` normal to all ``others``."""
    if not others:
        return echelon(space, prime)
    if not space:
        return ()
    forms = [[dot(b, o) % prime for b in space] for o in others]
    weights = annihilator(forms, len(space), prime)
    return echelon([combination(w, space, prime) for w in weights], prime)
