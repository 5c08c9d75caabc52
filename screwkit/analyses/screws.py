"""What constrains and what moves: the screw systems of limbs and platform.

Every screw is exact, in the axes of the base and about its origin, and is said in
words where it lies on a line of the mechanism's own geometry.  Systems are generic;
where a limb is singular it has further wrenches (`singularities`).

References: [LongCaroKhalil2012] (24)-(32).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.names import limb_called
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.analyses.identified import ScrewWriter
from screwkit.analyses.relative import twists_in_numbers
from screwkit.analyses.unwritten import (
    PRODUCTS,
    TWISTS,
    WRENCHES,
    Found,
    reciprocal_to,
    together,
    written,
)
from screwkit.conventions import SCREW_DIMENSION
from screwkit.errors import TooLargeError
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.kinematics.frames import FramedTwists
from screwkit.kinematics.network import Network, motion
from screwkit.kinematics.placement import joint_twists, placed_links
from screwkit.kinematics.series_parallel import element_columns
from screwkit.kinematics.subspaces import reciprocal
from screwkit.loci.reciprocals import Finder, FoundScrew
from screwkit.progress import Progress, silent
from screwkit.results.screws import (
    ActuationWrench,
    IdentifiedScrew,
    LimbScrews,
    PlatformScrews,
    Screws,
)
from screwkit.screw.nullspace import (
    Column,
    independent,
    moved,
    reciprocal_basis,
    residues,
    sample,
)


@dataclass(frozen=True)
class _Limb:
    """A limb with what was found about it.

    Attributes:
        framed: The twists of all its joints.
        columns: What spans its twist system: the twists of its joints and blocks.
    """

    limb: LimbChain
    framed: FramedTwists
    columns: tuple[Column, ...]
    finder: Finder
    rank: int
    system: Found

    @property
    def constraints(self) -> tuple[FoundScrew, ...]:
        """Its constraint wrenches, as far as they are written."""
        return self.system.screws


def screws(
    assembly: Assembly, order: str = "angular", progress: Progress = silent
) -> Screws:
    """Answer ``screws``.

    Args:
        assembly: The mechanism.
        order: ``angular``: (ω; v) and (f; m); ``linear``: (v; ω) and (m; f).
        progress: Told about each stage.

    Raises:
        ValueError: If the order is neither.
    """
    if order not in ("angular", "linear"):
        raise ValueError(f"order {order!r} is neither 'angular' nor 'linear'")
    framed = assembly.base_twists
    planar = assembly.mechanism.space == "planar"
    writer = ScrewWriter(framed.ring, linear=order == "linear", planar=planar)
    limbs, answers = [], []
    wrenches: list[ActuationWrench] = []
    for limb in assembly.limbs:
        progress("screws", f"limb {limb.name}")
        found = _limb(assembly, limb)
        limbs.append(found)
        answers.append(_limb_screws(assembly, found, writer))
        wrenches += _actuation(assembly, found, writer)
    progress("screws", "platform")
    return Screws(
        case=assembly.mechanism.name,
        title=assembly.mechanism.title,
        order="direction-moment" if order == "angular" else "moment-direction",
        frame=assembly.mechanism.base,
        point="origin",
        limbs=tuple(answers),
        platform=_platform(assembly, limbs, writer),
        actuation_wrenches=tuple(wrenches),
    )


def limb_twists(assembly: Assembly, limb: LimbChain) -> tuple[Column, ...]:
    """Columns that span what a limb allows the platform, in the base frame."""
    return _limb(assembly, limb).columns


def constraint_wrenches(assembly: Assembly, limb: LimbChain) -> tuple[Column, ...]:
    """The readable basis of what a limb can transmit with all joints passive.

    Raises:
        TooLargeError: If it is too long to be expanded.
    """
    found = _limb(assembly, limb)
    if found.system.missing:
        raise TooLargeError(
            f"the wrenches of {limb_called(limb.name)} are too long to be written "
            f"({found.system.size}); numbers for some symbols make them short"
        )
    return tuple(screw.column for screw in found.constraints)


def _limb(assembly: Assembly, limb: LimbChain) -> _Limb:
    framed = _part(assembly.base_twists, limb)
    finder = Finder(framed, assembly.mechanism.base)
    columns = _spanning(assembly, limb, framed)
    rank = len(independent(framed.ring, columns))
    system = reciprocal_to(
        finder,
        [*columns, *out_of_plane(assembly, twists=True)],
        assembly.dimension - rank,
        lambda: _reciprocal(assembly, limb, limb.joints),
    )
    return _Limb(limb, framed, columns, finder, rank, system)


def _spanning(
    assembly: Assembly,
    limb: LimbChain,
    framed: FramedTwists,
    locked: str = "",
) -> tuple[Column, ...]:
    """Columns that span what a limb allows the platform, with one freedom locked."""
    if limb.elements is None:
        return tuple(framed.column(name) for name in limb.joints if name != locked)
    if not limb.nested:
        return _in_numbers(assembly, limb, framed.ring, locked)
    columns: dict[str, list[Column]] = {name: [] for name in limb.chain}
    for label in limb.joints:
        if label != locked:
            columns.setdefault(assembly.joint_of(label).name, []).append(
                framed.column(label)
            )
    return tuple(
        column
        for element in limb.elements
        for column in element_columns(framed.ring, element, columns)
    )


def _in_numbers(
    assembly: Assembly, limb: LimbChain, ring: TrigonometricRing, locked: str
) -> tuple[Column, ...]:
    """The twists of a limb whose joints do not nest, from its closure equations."""
    mechanism = assembly.mechanism
    ends = mechanism.base, mechanism.platform
    part = Network(mechanism).part(limb.chain, ends)
    held = (locked,) if locked else ()
    motions = [motion(part, posture, held) for posture in part.postures]
    rows = twists_in_numbers((motions[0], motions[1]), ends[1], ends[0])
    return tuple(tuple(evaluate(entry, ring) for entry in row) for row in rows)


def out_of_plane(assembly: Assembly, *, twists: bool) -> tuple[Column, ...]:
    """The screws that a planar file does not speak of; none of a spatial one.

    Args:
        assembly: The mechanism.
        twists: Whether as twists (ωx, ωy, vz), or as wrenches (fz, mx, my).
    """
    if assembly.dimension == SCREW_DIMENSION:
        return ()
    ring = assembly.base_twists.ring
    places = (0, 1, 5) if twists else (2, 3, 4)
    return tuple(
        tuple(ring.one if i == place else ring.zero for i in range(SCREW_DIMENSION))
        for place in places
    )


def _part(framed: FramedTwists, limb: LimbChain) -> FramedTwists:
    """The twists of one limb, in the ring of all."""
    chosen = [framed.joints.index(name) for name in limb.joints]
    return replace(
        framed,
        joints=limb.joints,
        columns=tuple(framed.columns[i] for i in chosen),
        points=tuple(framed.points[i] for i in chosen),
        limbs=(),
    )


def _reciprocal(
    assembly: Assembly, limb: LimbChain, joints: Sequence[str]
) -> list[FoundScrew]:
    """Reciprocals of some twists by minors in the short frame, moved to the base."""
    mechanism, ring = assembly.mechanism, assembly.base_twists.ring
    if mechanism.geometry != "mdh":
        framed = assembly.base_twists
        locked = [name for name in limb.joints if name not in joints]
        columns = _spanning(assembly, limb, framed, *locked)
        outside = out_of_plane(assembly, twists=True)
        basis = reciprocal_basis(ring, [*columns, *outside], PRODUCTS)
        library = assembly.library(ring)
        return [
            FoundScrew(without_common_factors(ring, column, library))
            for column in basis.columns
        ]
    origin = assembly.limb_twists[limb.name].origin
    twists = joint_twists(mechanism, ring, origin, limb.chain)
    chosen = [tuple(ring.without_divisors(twists[x].coordinates)) for x in joints]
    place = placed_links(mechanism, ring, mechanism.base, limb.chain)[origin]
    basis = reciprocal_basis(ring, chosen, PRODUCTS)
    return [
        FoundScrew(moved(ring, place, column), elsewhere=column)
        for column in basis.columns
    ]


def _limb_screws(assembly: Assembly, found: _Limb, writer: ScrewWriter) -> LimbScrews:
    return LimbScrews(
        name=found.limb.name,
        joints=found.limb.joints,
        twist_dimension=found.rank,
        twists=_written_twists(assembly, found, writer),
        wrench_dimension=assembly.dimension - found.rank,
        wrenches=written(found.system, writer, WRENCHES),
    )


def _written_twists(
    assembly: Assembly, found: _Limb, writer: ScrewWriter
) -> tuple[IdentifiedScrew, ...]:
    """The twists of the joints; of a limb with blocks those that span its system."""
    framed = found.framed
    if found.limb.elements is not None and not found.system.missing:
        wrenches = [screw.column for screw in found.constraints]
        wrenches += out_of_plane(assembly, twists=False)
        named = found.finder.basis(
            wrenches,
            found.rank,
            lambda: [
                FoundScrew(found.columns[i])
                for i in independent(framed.ring, found.columns)
            ],
        )
        return tuple(writer.twist(screw) for screw in named)
    centres = {label: joint for joint, labels in framed.balls for label in labels}
    return tuple(
        writer.joint_twist(
            found.finder.features, joint, column, point, centres.get(joint, "")
        )
        for joint, column, point in zip(
            framed.joints, framed.columns, framed.points, strict=True
        )
    )


def _actuation(
    assembly: Assembly, found: _Limb, writer: ScrewWriter
) -> list[ActuationWrench]:
    answers = []
    for joint in found.limb.joints:
        if assembly.variable_of(joint) is None:
            continue
        added = _actuation_wrench(assembly, found, joint)
        answers.append(
            ActuationWrench(
                assembly.joint_of(joint).name,
                assembly.freedom_of(joint),
                found.limb.name,
                None if added is None else written(added, writer, WRENCHES)[-1],
            )
        )
    return answers


def _actuation_wrench(assembly: Assembly, found: _Limb, joint: str) -> Found | None:
    """What locking a joint adds to the constraints of its limb: the last screw."""
    ring = found.framed.ring
    others = [name for name in found.limb.joints if name != joint]
    columns = _spanning(assembly, found.limb, found.framed, joint)
    if len(independent(ring, columns)) == found.rank:
        return None
    return reciprocal_to(
        found.finder,
        [*columns, *out_of_plane(assembly, twists=True)],
        assembly.dimension - found.rank + 1,
        lambda: _reciprocal(assembly, found.limb, others),
        found.constraints,
    )


def _platform(
    assembly: Assembly, limbs: Sequence[_Limb], writer: ScrewWriter
) -> PlatformScrews:
    framed = replace(
        assembly.base_twists, limbs=tuple(limb.joints for limb in assembly.limbs)
    )
    ring = framed.ring
    if assembly.mechanism.base == assembly.mechanism.platform:
        return _at_rest(assembly, framed, writer)
    held = together(ring, [limb.system for limb in limbs])
    named = {
        called: screw
        for limb in limbs
        for called, screw in _forces(limb, several=len(limb.constraints) > 1).items()
    }
    finder = Finder(framed, assembly.mechanism.base, named, whole=True)
    outside = out_of_plane(assembly, twists=False)
    if held.missing:
        rows = [*held.rows(ring), *(residues(ring, column) for column in outside)]
        left = Found((), tuple(reciprocal(rows, sample(ring)[1])), held.size)
    else:
        columns = [*(screw.column for screw in held.screws), *outside]
        left = reciprocal_to(
            finder,
            columns,
            assembly.dimension - len(held.screws),
            lambda: [
                FoundScrew(column)
                for column in reciprocal_basis(ring, columns, PRODUCTS).columns
            ],
        )
    twists = written(left, writer, TWISTS)
    wrenches = written(held, writer, WRENCHES)
    return PlatformScrews(
        twist_dimension=len(twists),
        twists=twists,
        wrench_dimension=len(wrenches),
        wrenches=wrenches,
    )


def _at_rest(
    assembly: Assembly, framed: FramedTwists, writer: ScrewWriter
) -> PlatformScrews:
    """A platform that is the base itself takes up every wrench and has no twist."""
    columns = out_of_plane(assembly, twists=True)
    wrenches = Finder(framed, assembly.mechanism.base).basis(
        columns,
        assembly.dimension,
        lambda: [FoundScrew(c) for c in reciprocal_basis(framed.ring, columns).columns],
    )
    return PlatformScrews(
        twist_dimension=0,
        twists=(),
        wrench_dimension=len(wrenches),
        wrenches=tuple(writer.wrench(screw) for screw in wrenches),
    )


def _forces(found: _Limb, *, several: bool) -> dict[str, FoundScrew]:
    """The constraint forces of a limb by what they are called."""
    forces = [screw for screw in found.constraints if screw.how and not screw.is_free]
    name = f"of {limb_called(found.limb.name)}"
    if len(forces) == 1 and not several:
        return {_axis(forces[0]) or f"the constraint force {name}": forces[0]}
    return {
        _axis(force) or f"constraint force {number} {name}": force
        for number, force in enumerate(forces, 1)
    }


def _axis(force: FoundScrew) -> str:
    """The axis that a force lies on; empty for other lines."""
    return force.name if force.name.startswith("axis ") else ""
