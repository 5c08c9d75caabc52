"""What contact forces do: the parts of eq. (19) at an exact point.

Contact forces that passive joints let through are parted into those that neither the
object nor the actuators feel, those that only one of them feels, and the rest.

References: [BicchiPrattichizzo] eqs. (15)-(19), with the corrected dimensions.
"""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.algebra.modular import echelon, independent, null_vectors
from screwkit.algebra.residue_matrices import Rows, product
from screwkit.grasping.exact_grasp import ExactGrasp


@dataclass(frozen=True)
class ContactForces:
    """Admissible contact forces in four parts, as residues, a vector in each row.

    Attributes:
        silent: X: that neither object nor actuators feel.
        quiet: S modulo X: that actuators do not feel.
        inner: H modulo X: that the object does not feel.
        others: A complement in K.
    """

    silent: Rows
    quiet: Rows
    inner: Rows
    others: Rows


@dataclass(frozen=True)
class StaticBases:
    """Reduced echelon bases, the same modulo each prime.

    Attributes:
        structural: Wrenches (f; m) that are balanced without torque.
        internal: Torques of the actuators that leave the object in balance.
    """

    structural: Rows
    internal: Rows


def contact_forces(grasp: ExactGrasp) -> ContactForces:
    """The four parts."""
    prime = grasp.prime

    def unfelt(parts: str, known: Rows) -> Rows:
        """What completes ``known`` to all forces that these parts do not feel."""
        if len(known) == grasp.ranks.unfelt(parts):
            return []
        vectors = null_vectors(grasp.part(parts).transpose())
        return _complement(known, vectors, prime) if known else vectors

    silent = unfelt("apo", [])
    quiet, inner = unfelt("ap", silent), unfelt("po", silent)
    return ContactForces(silent, quiet, inner, unfelt("p", [*silent, *quiet, *inner]))


def static_bases(grasp: ExactGrasp, forces: ContactForces) -> StaticBases:
    """Bases of the structural wrenches and of the internal torques."""
    return StaticBases(
        echelon(wrenches_of(grasp, forces.quiet), grasp.prime),
        echelon(torques_of(grasp, forces.inner), grasp.prime),
    )


def torques_of(grasp: ExactGrasp, forces: Rows) -> Rows:
    """Of the actuated joints, per unit of their own axes: −J_aᵀ f up to the sign."""
    split = grasp.actuated
    return product(forces, [row[:split] for row in grasp.j], grasp.prime)


def wrenches_of(grasp: ExactGrasp, forces: Rows) -> Rows:
    """On the object, (f; m)."""
    size = grasp.twists
    order = [1, 2, 0] if size == 3 else [3, 4, 5, 0, 1, 2]
    return product(forces, [[row[i] for i in order] for row in grasp.gt], grasp.prime)


def _complement(known: Rows, vectors: Rows, prime: int) -> Rows:
    """Vectors that complete a space to that of ``vectors``."""
    both = [*known, *vectors]
    return [both[i] for i in independent(both, prime) if i >= len(known)]
