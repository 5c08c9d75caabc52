"""What parts of a certificate are about: a limb, loops of limbs, a joint graph."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cache

from screwkit.algebra.branches import Branch
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.certificates.floors import LimbPart
from screwkit.certificates.limb_systems import LimbSystem, Loci
from screwkit.certificates.loop_equations import LoopEquations
from screwkit.certificates.looped_limbs import led_columns
from screwkit.certificates.minor_choice import Matrix
from screwkit.certificates.texts import read
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.kinematics.frames import FramedTwists
from screwkit.kinematics.whole_graph import InPlace, WholeGraph
from screwkit.mechanism.model import Mechanism


@dataclass(frozen=True)
class Subject:
    """What a part is about.

    Attributes:
        mechanism: The whole.
        root: The configuration space of the ring of ``framed``.
        chain: The joints whose twists stand in ``framed``.
        form: Of the matrix, as in `Part`.
        limbs: Where the matrix is that of the loops that limbs close.
        parts: About these limbs.
    """

    mechanism: Mechanism
    root: Branch
    library: FactorLibrary
    framed: FramedTwists
    matrix: Matrix | LoopEquations
    chain: tuple[str, ...]
    form: str = ""
    limbs: tuple[LimbSystem, ...] = ()
    parts: tuple[LimbPart, ...] = ()


def of_limb(assembly: Assembly, limb: LimbChain) -> Subject:
    """Of a limb's own twists."""
    framed = assembly.limb_twists[limb.name]
    matrix = Matrix(
        (tuple(framed.column(joint) for joint in limb.joints),),
        (limb.joints,),
        tuple(range(6)),
        single=True,
    )
    return _subject(assembly, framed, matrix, limb.chain)


def of_loops(
    assembly: Assembly, locked: Sequence[str], limbs: Sequence[LimbPart]
) -> Subject:
    """Of the loops that limbs close.

    Args:
        assembly: Of the mechanism.
        locked: Freedoms that are held.
        limbs: The parts about its limbs.
    """
    left = [[j for j in limb.joints if j not in locked] for limb in assembly.limbs]
    matrix = Matrix(
        tuple(tuple(map(tuple, assembly.told(own))) for own in left),
        tuple(map(tuple, left)),
        assembly.telling,
        single=False,
    )
    chain = [name for limb in assembly.limbs for name in limb.chain]
    subject = _subject(assembly, assembly.common_twists, matrix, chain)
    systems = [
        _system(assembly, limb, locked, part)
        for limb, part in zip(assembly.limbs, limbs, strict=True)
    ]
    return replace(subject, limbs=tuple(systems), parts=tuple(limbs))


def _system(
    assembly: Assembly, limb: LimbChain, locked: Sequence[str], part: LimbPart
) -> LimbSystem:
    """A limb in the frame of all, with what its own part proves."""
    framed = assembly.common_twists
    labels = tuple(joint for joint in limb.joints if joint not in locked)
    is_whole = len(labels) == len(limb.joints)
    below = _below(part, framed.ring) if is_whole else _nothing
    columns = tuple(tuple(framed.column(joint)) for joint in labels)
    return LimbSystem(limb.name, labels, columns, below)


def _below(part: LimbPart, ring: TrigonometricRing) -> Callable[[int], Loci | None]:
    """Where a limb has a lower rank, in the ring of all."""

    @cache
    def below(rank: int) -> Loci | None:
        loci = part.below(rank)
        if loci is None:
            return None
        return tuple(
            tuple(evaluate(read(e), ring) for e in equations) for equations in loci
        )

    return below


def _nothing(rank: int) -> Loci | None:
    """Of limbs some of whose joints are locked."""
    return None


def _subject(
    assembly: Assembly, framed: FramedTwists, matrix: Matrix, chain: Sequence[str]
) -> Subject:
    root, library = assembly.root(framed.ring), assembly.library(framed.ring)
    return Subject(assembly.mechanism, root, library, framed, matrix, tuple(chain))


def of_graph(
    graph: WholeGraph,
    own: WholeGraph,
    matrix: LoopEquations,
    locked: Sequence[str] = (),
    limbs: Sequence[LimbPart] = (),
) -> Subject:
    """Of loop equations.

    Args:
        graph: Of the whole mechanism.
        own: Of it, or of the limb that is asked about.
        matrix: Of these loop equations.
        locked: Freedoms that are held.
        limbs: The parts about the limbs, where these may say something of the whole.
    """
    chain = tuple(joint.name for joint in own.mechanism.joints)
    systems = tuple(
        _looped(own, limb, locked, part)
        for limb, part in zip(own.limbs if limbs else (), limbs, strict=True)
    )
    return Subject(
        graph.mechanism,
        own.root,
        own.library,
        own.framed,
        matrix,
        chain,
        "loops",
        systems,
        tuple(limbs),
    )


def _looped(
    graph: WholeGraph, limb: WholeGraph, locked: Sequence[str], part: LimbPart
) -> LimbSystem:
    """A limb by its loop equations in the frame of all."""
    ring = graph.framed.ring
    placed = InPlace(limb.mechanism, graph.framed)
    labels, rows, height = placed.led_equations(locked)
    is_whole = len(labels) == len(placed.network.labels)
    below = _below(part, ring) if is_whole else _nothing
    columns = led_columns(rows, len(labels), height, ring.zero)
    return LimbSystem(part.name, labels, columns, below, height)


def are_all(graph: WholeGraph) -> bool:
    """Whether limbs, two at least, hold every joint of a mechanism."""
    limbs = graph.network.limbs
    joints = [name for limb in limbs for name in limb.joints]
    return len(limbs) > 1 and len(joints) == len(graph.mechanism.joints)
