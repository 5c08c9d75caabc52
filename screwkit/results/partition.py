"""The mobility partition: how many parameters, and who can move without whom.

Twists are (ω; v) with v of the reference point; planar files have (ωz; vx, vy).
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Gamma:
    """Dimensions of the seven blocks of all motions.

    Attributes:
        a_r: Actuated joints move alone.
        p_r: Passive joints move alone.
        o_i: The object moves alone.
        po_i: Passive joints and the object, actuators locked.
        ap_c: Actuated and passive joints, the object at rest.
        ao_c: Actuated joints and the object, passive joints at rest.
        apo_c: What needs all three.

    References: [BicchiPrattichizzo] eq. (5).
    """

    a_r: int = 0
    p_r: int = 0
    o_i: int = 0
    po_i: int = 0
    ap_c: int = 0
    ao_c: int = 0
    apo_c: int = 0


@dataclass(frozen=True)
class BlockMotion:
    """One vector of a basis of a block.

    Attributes:
        joints: The freedoms that move.
        rates: Their rates, exact, along axes as long as the file writes them; empty
            where they are no short expressions.
        twist: Of the object, exact; empty where it rests or has no short expression.
        words: What moves, and how.
    """

    joints: tuple[str, ...]
    rates: tuple[str, ...]
    twist: tuple[str, ...]
    words: str


@dataclass(frozen=True)
class MotionBlock:
    """One block of the partition.

    Attributes:
        name: As in `Gamma`.
        meaning: In a sentence.
        motions: A basis.
    """

    name: str
    dimension: int
    meaning: str
    motions: tuple[BlockMotion, ...]


@dataclass(frozen=True)
class Partition:
    """How many parameters, and who can move without whom.

    Attributes:
        mobility: N_m, of all motions.
        connectivity: N_c, of the object.
        redundancy: N_r, with the object at rest.
        indeterminacy: N_i, of the object with all joints locked, actuated or not.
        gamma: Where a scheme parts the joints into actuated and passive ones.
        blocks: Those that are not empty.
        symbolic: Whether the vectors hold for all values of the symbols.

    References: [BicchiMelchiorri] §3.1, [BicchiPrattichizzo] eq. (5).
    """

    mobility: int
    connectivity: int
    redundancy: int
    indeterminacy: int
    gamma: Gamma | None = None
    blocks: tuple[MotionBlock, ...] = ()
    symbolic: bool = False
