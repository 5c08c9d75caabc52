"""The class of a screw system: what motion a body has, or what wrenches it bears.

A system is given by any basis, modulo two primes at a random posture.  Its kind, its
dimensions and whether it is closed under the Lie bracket are exact and the same modulo
both; its lines, planes and pitches are named where short numbers explain them.  A
closed system of twists is the algebra of a displacement group; that the body moves in
that group is a statement about finite motion and not made here.

References: [Herve1999], [Hunt1978], ch. 12.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from screwkit.algebra.modular import ResampleError
from screwkit.algebra.reconstruction import Reconstruction
from screwkit.kinematics.subspaces import Row
from screwkit.systems.class_phrases import Element, sentence_of
from screwkit.systems.class_words import SUBGROUPS, TWISTS, WORDS, WRENCHES
from screwkit.systems.exact_principal_screws import known_principal_screws
from screwkit.systems.principal_screws import PrincipalScrew
from screwkit.systems.screw_shapes import Shape, shape_of
from screwkit.systems.screw_structure import ScrewStructure

System: TypeAlias = tuple[Sequence[Row], int]
"""Screws modulo a prime."""


@dataclass(frozen=True)
class SystemClass:
    """What a system of twists, or of wrenches, consists of.

    Attributes:
        translations: Dimension n of the pure translations (of wrenches: couples).
        rotations: dimension − n.
        motion_type: nTmR; empty for wrenches.
        name: Short, ``Schönflies motion``.
        words: A sentence that begins with the name.
        subgroup: Whether the system is closed under the Lie bracket, hence the algebra
            of a displacement group; False for wrenches.
        within: Name of the smallest such group whose algebra holds the system; empty
            for wrenches.
        elements: The lines, planes and pitches of the sentence; those of the
            reciprocal system where the dimension is above three.
        principal: Principal screws; empty where the system has no short numbers.
    """

    dimension: int
    translations: int
    rotations: int
    motion_type: str
    name: str
    words: str
    subgroup: bool
    within: str
    elements: tuple[Element, ...]
    principal: tuple[PrincipalScrew, ...]


def classify(
    systems: Sequence[System], known: Reconstruction | None = None
) -> SystemClass:
    """The class of one system of twists, given modulo two primes.

    Args:
        systems: Rows (ω; v) that span it, dependent or not, with their prime; twice.
        known: The way back to exact numbers, for the same primes in this order;
            without it lines and planes stay unnamed.

    Raises:
        ResampleError: If the system is not of the same class modulo both primes.
        ValueError: If ``known`` belongs to other primes.
    """
    pair = _pair(systems, known)
    shape, elements = _shape(pair, known)
    words = WORDS[shape.kind, shape.reciprocal]
    hull = shape_of(pair[0].hull)
    translations, rotations = _dimensions(pair[0])
    return SystemClass(
        dimension=pair[0].dimension,
        translations=translations,
        rotations=rotations,
        motion_type=f"{translations}T{rotations}R",
        name=words.motion,
        words=sentence_of(words.motion, words.sentence, elements, TWISTS),
        subgroup=(shape.kind, shape.reciprocal) in SUBGROUPS,
        within=WORDS[hull.kind, hull.reciprocal].motion,
        elements=elements,
        principal=known_principal_screws(pair, known) if known else (),
    )


def classify_wrenches(
    systems: Sequence[System], known: Reconstruction | None = None
) -> SystemClass:
    """The class of one system of wrenches, rows (f; m); otherwise as `classify`.

    Raises:
        ResampleError: If the system is not of the same class modulo both primes.
        ValueError: If ``known`` belongs to other primes.
    """
    pair = _pair(systems, known)
    shape, elements = _shape(pair, known)
    words = WORDS[shape.kind, shape.reciprocal]
    couples, forces = _dimensions(pair[0])
    return SystemClass(
        dimension=pair[0].dimension,
        translations=couples,
        rotations=forces,
        motion_type="",
        name=words.wrenches,
        words=sentence_of(words.wrenches, words.sentence, elements, WRENCHES),
        subgroup=False,
        within="",
        elements=elements,
        principal=known_principal_screws(pair, known) if known else (),
    )


def _pair(
    systems: Sequence[System], known: Reconstruction | None
) -> tuple[ScrewStructure, ScrewStructure]:
    first, second = (ScrewStructure.spanned_by(rows, prime) for rows, prime in systems)
    if known and known.primes != (first.prime, second.prime):
        raise ValueError("the numbers and the systems belong to different primes")
    return first, second


def _dimensions(system: ScrewStructure) -> tuple[int, int]:
    """Of the pure moments, and of the rest."""
    return len(system.moments), system.dimension - len(system.moments)


def _shape(
    pair: tuple[ScrewStructure, ScrewStructure], known: Reconstruction | None
) -> tuple[Shape, tuple[Element, ...]]:
    """The common shape modulo both primes, and its elements.

    Raises:
        ResampleError: If there is no common shape.
    """
    shapes = first, second = shape_of(pair[0]), shape_of(pair[1])
    integers = [
        (
            shape.kind,
            shape.reciprocal,
            tuple(map(bool, shape.numbers.values())),
            _dimensions(system),
            _dimensions(system.hull),
        )
        for shape, system in zip(shapes, pair, strict=True)
    ]
    if integers[0] != integers[1]:
        raise ResampleError
    elements: list[Element] = []
    for name, vector in first.vectors.items():
        two = vector, second.vectors[name]
        elements.append(Element(name, two, known.direction(*two) if known else None))
    for name, point in first.points.items():
        two = point, second.points[name]
        elements.append(Element(name, two, known.numbers(*two) if known else None))
    for name, number in first.numbers.items():
        two = (number,), (second.numbers[name],)
        elements.append(Element(name, two, known.numbers(*two) if known else None))
    return first, tuple(elements)
