"""The grasp at one exact point: residues of J and Gᵀ, and the ranks that count.

All dimensions of the partition, of the statics and of the indices are sums of seven
ranks, so that each is exact: at the values of the file, or generic where symbols are
left.

References: [BicchiPrattichizzo] eqs. (2)-(5), (15)-(19), [Schwartz1980].
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from operator import neg
from typing import Any

from screwkit.algebra.constants import ConstantField
from screwkit.algebra.modular import ModularRing, rank, residue_matrix
from screwkit.algebra.reconstruction import Reconstruction
from screwkit.algebra.residue_matrices import chosen_columns, null_rows
from screwkit.grasping.holds import holds_of
from screwkit.grasping.matrices import GraspMatrices, grasp_matrices, grasp_rows
from screwkit.kinematics.exact_postures import at_zero, exact_values, surveyed
from screwkit.kinematics.placement import why_tied
from screwkit.mechanism.model import Mechanism


@dataclass(frozen=True)
class Ranks:
    """Sizes and ranks of J_a, J_p and Gᵀ and of what is put together of them.

    Attributes:
        rows: Components of the contact forces.
        actuated, passive, twists: Columns of J_a, J_p and Gᵀ.
        a, p, o, ap, ao, po, apo: The ranks: a of J_a, p of J_p, o of Gᵀ.
        inside: Of the rows, those of closures inside limbs.
        inside_p, inside_ap: Ranks of J_p and of [J_a J_p] in these rows alone.
    """

    rows: int
    actuated: int
    passive: int
    twists: int
    a: int
    p: int
    o: int
    ap: int
    ao: int
    po: int
    apo: int
    inside: int = 0
    inside_p: int = 0
    inside_ap: int = 0

    def of(self, parts: str) -> int:
        """The rank of the columns of some parts, as in ``ap``."""
        return int(getattr(self, parts))

    def motions(self, parts: str) -> int:
        """Independent motions of actuated, passive joints and the object alone."""
        columns = {"a": self.actuated, "p": self.passive, "o": self.twists}
        return sum(columns[part] for part in parts) - self.of(parts)

    def unfelt(self, parts: str) -> int:
        """Independent contact forces that do no work on the motion of these parts."""
        return self.rows - self.of(parts)

    @property
    def redundancy(self) -> int:
        """Of R: actuated motions at which the object may rest."""
        return self.actuated - (self.ap - self.p)

    @property
    def indeterminacy(self) -> int:
        """Of I: motions of the object with the actuators locked."""
        return self.twists - (self.po - self.p)

    @property
    def coordinated(self) -> int:
        """Pairs of actuated rates and object twists modulo R and I."""
        return self.ap + self.po - self.apo - self.p

    @property
    def admissible(self) -> int:
        """Of K = ker J_pᵀ: contact forces without torque at passive joints."""
        return self.rows - self.p

    @property
    def static_indeterminacy(self) -> int:
        """Of X: contact forces that neither object nor actuators feel."""
        return self.rows - self.apo

    @property
    def structural(self) -> int:
        """Of S modulo X: wrenches balanced without torque."""
        return self.apo - self.ap

    @property
    def internal(self) -> int:
        """Of H modulo X: torques that leave the object in balance."""
        return self.apo - self.po

    @property
    def inner_torques(self) -> int:
        """Of the internal torques those that only load loops inside limbs."""
        return self.inside_ap - self.inside_p

    @property
    def contact_indeterminacy(self) -> int:
        """Of X as far as contacts with the object feel it."""
        return self.static_indeterminacy - (self.inside - self.inside_ap)


@dataclass(frozen=True)
class ExactGrasp:
    """J and Gᵀ modulo a prime.

    Attributes:
        matrices: With residues for entries.
        ring: For more values at the same point.
        constants: Residues of the generators of the geometry's constants.
        field: The field of the constants.
    """

    matrices: GraspMatrices[Any]
    ring: ModularRing
    constants: dict[str, int]
    field: ConstantField

    @property
    def prime(self) -> int:
        """The modulus."""
        return self.ring.prime

    @cached_property
    def j(self) -> list[list[int]]:
        """Rows of J, the actuated columns first."""
        return [[int(x) for x in row] for row in self.matrices.j]

    @cached_property
    def gt(self) -> list[list[int]]:
        """Rows of Gᵀ."""
        return [[int(x) for x in row] for row in self.matrices.gt]

    @property
    def actuated(self) -> int:
        """How many freedoms are actuated."""
        return len(self.matrices.actuated)

    @property
    def twists(self) -> int:
        """Coordinates of an object twist: six, or three in the plane."""
        return self.matrices.twist_size

    @cached_property
    def whole(self) -> list[list[int]]:
        """Rows of [J_a J_p −Gᵀ]."""
        pairs = zip(self.j, self.gt, strict=True)
        return [[*j, *(-x % self.prime if x else 0 for x in gt)] for j, gt in pairs]

    def places(self, parts: str) -> list[int]:
        """Where the columns of J_a (``a``), J_p (``p``) and −Gᵀ (``o``) stand."""
        split, moving = self.actuated, len(self.matrices.freedoms)
        places = {
            "a": range(split),
            "p": range(split, moving),
            "o": range(moving, moving + self.twists),
        }
        return [place for part in parts for place in places[part]]

    def part(self, parts: str) -> Any:
        """The columns of some parts, in FLINT's form."""
        return chosen_columns(self._matrix, self.places(parts), self.prime)

    @cached_property
    def _matrix(self) -> Any:
        pairs = zip(self.matrices.j, self.matrices.gt, strict=True)
        rows = [(*j, *map(neg, gt)) for j, gt in pairs]
        width = len(self.matrices.freedoms) + self.twists
        return residue_matrix(rows, width, self.prime)

    @cached_property
    def object_alone(self) -> int:
        """Motions of the object with all joints locked but contacts: N_i."""
        own = self.matrices
        places = [own.freedoms.index(label) for label in own.slipping]
        slipping = [[row[i] for i in places] for row in self.j]
        both = [[*row, *gt] for row, gt in zip(slipping, self.gt, strict=True)]
        taken = rank(both, self.prime) - rank(slipping, self.prime)
        return self.twists - taken

    def only(self, contacts: Collection[str], freedoms: Collection[str]) -> ExactGrasp:
        """The part of some contacts and of the freedoms that move them."""
        own = self.matrices
        rows = [i for i, row in enumerate(own.rows) if row.hold.joint in contacts]
        columns = [i for i, label in enumerate(own.freedoms) if label in freedoms]
        part = replace(
            own,
            rows=tuple(own.rows[i] for i in rows),
            actuated=tuple(x for x in own.actuated if x in freedoms),
            passive=tuple(x for x in own.passive if x in freedoms),
            j=tuple(tuple(own.j[i][k] for k in columns) for i in rows),
            gt=tuple(own.gt[i] for i in rows),
            squares=tuple(own.squares[i] for i in rows),
            strokes=tuple(own.strokes[i] for i in columns),
        )
        return replace(self, matrices=part)

    @cached_property
    def motions(self) -> Any:
        """A basis of all motions (q_a; q_p; u), one in each row, in FLINT's form."""
        return null_rows(self._matrix, self.prime)

    def resting(self, parts: str) -> Any:
        """The columns of `motions` in which these parts move."""
        return chosen_columns(self.motions, self.places(parts), self.prime)

    @cached_property
    def ranks(self) -> Ranks:
        """All of them, from one elimination: what moves alone is what others lack.

        The columns of some parts have as many relations as there are motions at which
        the other parts rest.
        """
        every = int(self.motions.nrows())

        def rank_of(parts: str) -> int:
            others = "".join(part for part in "apo" if part not in parts)
            moving = int(self.resting(others).rank()) if others else 0
            return len(self.places(parts)) - (every - moving)

        a, p, o, ap, ao, po, apo = map(
            rank_of, ("a", "p", "o", "ap", "ao", "po", "apo")
        )
        inside = self.j[self.matrices.held :]
        return Ranks(
            len(self.j),
            self.actuated,
            len(self.matrices.passive),
            self.twists,
            *(a, p, o, ap, ao, po, apo),
            len(inside),
            rank([row[self.actuated :] for row in inside], self.prime),
            rank(inside, self.prime),
        )


def exact_grasps(
    mechanism: Mechanism, seeds: Sequence[int] = (1, 2)
) -> tuple[ExactGrasp, ...]:
    """The grasp at points that are random where the mechanism has symbols.

    Where loops tie joint variables together the posture of the file is taken.

    Args:
        mechanism: Any.
        seeds: One for each point, and for its prime.

    Raises:
        UndecidedError: If no exact point was found, or a contact has no place.
    """
    if why_tied(mechanism):
        mechanism = at_zero(mechanism)

    holds = holds_of(mechanism)

    def matrices(ring: Any) -> GraspMatrices[Any]:
        return grasp_matrices(mechanism, ring, holds=holds)

    seen = surveyed(partial(grasp_rows, mechanism, holds=holds))
    points = [exact_values(matrices, seed, seen=seen) for seed in seeds]
    return tuple(
        ExactGrasp(found.value, found.ring, dict(found.constants), found.field)
        for found in points
    )


def reconstruction(grasps: Sequence[ExactGrasp]) -> Reconstruction:
    """The way back from residues at the same point modulo two primes."""
    one, other = grasps
    return Reconstruction(
        one.field, (one.prime, other.prime), (one.constants, other.constants)
    )
