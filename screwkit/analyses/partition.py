"""The mobility partition in words: who can move without whom, block by block.

Dimensions come from an exact point, generic where the mechanism has symbols; the
vectors of a block are written as expressions where they are short, else at the values
of the file.

References: [BicchiMelchiorri] §3, [BicchiPrattichizzo] eqs. (2)-(5).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

from screwkit.algebra.polynomial_text import text
from screwkit.algebra.reconstruction import Reconstruction
from screwkit.analyses.block_words import meaning, motion_words
from screwkit.analyses.screw_texts import ScrewTexts, TextReader
from screwkit.grasping.exact_grasp import ExactGrasp, exact_grasps, reconstruction
from screwkit.grasping.partition import BLOCKS, Blocks, blocks_of
from screwkit.grasping.symbolic_blocks import (
    GraspFamily,
    Vector,
    any_is_short,
)
from screwkit.kinematics.network import Network
from screwkit.mechanism.model import Mechanism
from screwkit.results.partition import BlockMotion, Gamma, MotionBlock

TERMS: Final = 40
"""Terms of a vector up to which it is written in symbols."""


@dataclass(frozen=True)
class GraspPair:
    """A grasp at one exact point modulo two primes, with its partition.

    Attributes:
        grasps: At both.
        blocks: At both; those of the point of larger rank count.
    """

    grasps: tuple[ExactGrasp, ExactGrasp]
    blocks: tuple[Blocks, Blocks]

    @classmethod
    def of(cls, mechanism: Mechanism) -> GraspPair:
        """At random exact points, or at the numbers of the file.

        Raises:
            UndecidedError: If there is no exact point.
        """
        one, other = exact_grasps(mechanism)
        if other.ranks.apo > one.ranks.apo:
            one, other = other, one
        return cls((one, other), (blocks_of(one), blocks_of(other)))

    @cached_property
    def numbers(self) -> Reconstruction:
        """The way back from residues."""
        return reconstruction(self.grasps)


def gamma_of(blocks: Blocks) -> Gamma:
    """The seven dimensions."""
    return Gamma(*blocks.dimensions)


def motion_blocks(
    family: GraspFamily | None, at: GraspPair
) -> tuple[tuple[MotionBlock, ...], bool]:
    """The blocks that are not empty, and whether their vectors hold for all values.

    Args:
        family: For all values of the symbols, if the vectors are wanted so; used where
            the partition there is the same.
        at: Where the blocks are asked for and their motions are named.
    """
    vectors: dict[str, tuple[Vector | None, ...]] = {}
    ring = None
    if family is not None:
        alike = family.blocks.dimensions == at.blocks[0].dimensions
        if alike and any_is_short(family.blocks):
            ring, vectors = family.matrices[0], dict(family.vectors)
    found, symbolic = [], ring is not None
    for name in BLOCKS:
        own = []
        for number, pair in enumerate(
            zip(at.blocks[0].basis[name], at.blocks[1].basis[name], strict=True)
        ):
            written: tuple[str, ...] = ()
            vector = vectors.get(name, ())[number] if vectors else None
            if ring is not None and vector is not None and _is_short(vector):
                written = tuple(text(ring, value) for value in vector)
            if not written:
                symbolic = False
                written = _texts(at.numbers, pair)
            own.append(_motion(name, written, pair, at))
        if own:
            found.append(MotionBlock(name, len(own), meaning(name), tuple(own)))
    return tuple(found), symbolic


def generic_blocks(
    network: Network, generic: GraspPair
) -> tuple[tuple[MotionBlock, ...], bool]:
    """The blocks for generic values, their motions named at the file's where alike."""
    family = None
    if network.has_symbols:
        family = GraspFamily(network.mechanism, generic.grasps[0])
    at = generic
    if network.at_values is not None:
        there = GraspPair.of(network.at_values.mechanism)
        if there.blocks[0].dimensions == generic.blocks[0].dimensions:
            at = there
    return motion_blocks(family, at)


def _is_short(vector: Vector) -> bool:
    return sum(map(len, vector)) <= TERMS


def _texts(numbers: Reconstruction, pair: Sequence[Sequence[int]]) -> tuple[str, ...]:
    known = numbers.numbers(*pair)
    return () if known is None else tuple(number.text for number in known)


def _motion(
    block: str,
    written: Sequence[str],
    pair: tuple[Sequence[int], Sequence[int]],
    at: GraspPair,
) -> BlockMotion:
    grasp = at.grasps[0]
    freedoms = grasp.matrices.freedoms
    moving = [i for i, x in enumerate(pair[0][: len(freedoms)]) if x]
    split = grasp.actuated
    driving = _joints((freedoms[i] for i in moving if i < split), at)
    following = _joints((freedoms[i] for i in moving if i >= split), at)
    object_moves = any(pair[0][len(freedoms) :])
    screw = _object_screw(pair, at) if object_moves else None
    return BlockMotion(
        joints=tuple(freedoms[i] for i in moving),
        rates=tuple(written[i] for i in moving) if written else (),
        twist=tuple(written[len(freedoms) :]) if written and object_moves else (),
        words=motion_words(block, screw, driving, following),
    )


def _joints(labels: Iterable[str], at: GraspPair) -> list[str]:
    """The joints of some freedoms, each once."""
    joint_of = at.grasps[0].matrices.joint_of
    return list(dict.fromkeys(joint_of[label] for label in labels))


def _object_screw(
    pair: tuple[Sequence[int], Sequence[int]], at: GraspPair
) -> ScrewTexts:
    """The twist of the object about the base origin, read from residues."""
    whole = []
    for grasp, vector in zip(at.grasps, pair, strict=True):
        u = [int(x) for x in vector[len(grasp.matrices.freedoms) :]]
        if len(u) == 3:
            u = [0, 0, u[0], u[1], u[2], 0]
        x, y, z = (int(c) for c in grasp.matrices.reference_point)
        a, b, c = u[:3]
        shift = (b * z - c * y, c * x - a * z, a * y - b * x)
        moment = [(v - s) % grasp.prime for v, s in zip(u[3:], shift, strict=True)]
        whole.append([*u[:3], *moment])
    reader = TextReader(at.numbers)
    near = [
        tuple(
            [int(x) for x in grasp.matrices.rows[number].wrench.point]
            for grasp in at.grasps
        )
        for number in _first_rows(at.grasps[0])
    ]
    return reader.screw((whole[0], whole[1]), [(a, b) for a, b in near])


def _first_rows(grasp: ExactGrasp) -> list[int]:
    """The first row of each hold on the object."""
    seen: dict[str, int] = {}
    for number, row in enumerate(grasp.matrices.rows):
        if row.hold.on_object:
            seen.setdefault(row.hold.joint, number)
    return list(seen.values())
