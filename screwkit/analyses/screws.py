"""What constrains and what moves: the screw systems of limbs and platform.

Every screw is exact, in the axes of the base and about its origin, and is said in
words where it lies on a line of the mechanism's own geometry.  Systems are generic;
where a limb is singular it has further wrenches (`singularities`).

References: [LongCaroKhalil2012] (24)-(32).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from screwkit.analyses.identified import ScrewWriter
from screwkit.conventions import SCREW_DIMENSION
from screwkit.kinematics.assembly import Assembly, SerialLimb
from screwkit.kinematics.frames import FramedTwists
from screwkit.kinematics.placement import joint_twists, placed_links
from screwkit.loci.reciprocals import Finder, FoundScrew, span_of
from screwkit.progress import Progress, silent
from screwkit.results.screws import (
    ActuationWrench,
    LimbScrews,
    PlatformScrews,
    Screws,
)
from screwkit.screw.nullspace import (
    Column,
    independent,
    moved,
    reciprocal_basis,
)


@dataclass(frozen=True)
class _Limb:
    """A limb with what was found about it."""

    limb: SerialLimb
    framed: FramedTwists
    finder: Finder
    rank: int
    constraints: tuple[FoundScrew, ...]


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
    writer = ScrewWriter(framed.ring, linear=order == "linear")
    limbs, answers = [], []
    wrenches: list[ActuationWrench] = []
    for limb in assembly.limbs:
        progress("screws", f"limb {limb.name}")
        found = _limb(assembly, limb)
        limbs.append(found)
        answers.append(_limb_screws(found, writer))
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


def constraint_wrenches(assembly: Assembly, limb: SerialLimb) -> tuple[Column, ...]:
    """The readable basis of what a limb can transmit with all joints passive."""
    return tuple(screw.column for screw in _limb(assembly, limb).constraints)


def _limb(assembly: Assembly, limb: SerialLimb) -> _Limb:
    framed = _part(assembly.base_twists, limb)
    finder = Finder(framed, assembly.mechanism.base)
    rank = len(independent(framed.ring, framed.columns))
    constraints = finder.basis(
        framed.columns,
        SCREW_DIMENSION - rank,
        lambda: _reciprocal(assembly, limb, limb.joints),
    )
    return _Limb(limb, framed, finder, rank, tuple(constraints))


def _part(framed: FramedTwists, limb: SerialLimb) -> FramedTwists:
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
    assembly: Assembly, limb: SerialLimb, joints: Sequence[str]
) -> list[FoundScrew]:
    """Reciprocals of some twists by minors in the short frame, moved to the base."""
    mechanism, ring = assembly.mechanism, assembly.base_twists.ring
    if mechanism.geometry != "mdh":
        framed = assembly.base_twists
        basis = reciprocal_basis(ring, [framed.column(name) for name in joints])
        return [FoundScrew(column) for column in basis.columns]
    origin = assembly.limb_twists[limb.name].origin
    twists = joint_twists(mechanism, ring, origin, limb.chain)
    columns = [
        tuple(ring.without_divisors(twists[name].coordinates)) for name in joints
    ]
    place = placed_links(mechanism, ring, mechanism.base, limb.chain)[origin]
    basis = reciprocal_basis(ring, columns)
    return [
        FoundScrew(moved(ring, place, column), elsewhere=column)
        for column in basis.columns
    ]


def _limb_screws(found: _Limb, writer: ScrewWriter) -> LimbScrews:
    return LimbScrews(
        name=found.limb.name,
        joints=found.limb.joints,
        twist_dimension=found.rank,
        twists=tuple(
            writer.joint_twist(found.finder.features, joint, column, point)
            for joint, column, point in zip(
                found.framed.joints,
                found.framed.columns,
                found.framed.points,
                strict=True,
            )
        ),
        wrench_dimension=SCREW_DIMENSION - found.rank,
        wrenches=tuple(writer.wrench(screw) for screw in found.constraints),
    )


def _actuation(
    assembly: Assembly, found: _Limb, writer: ScrewWriter
) -> list[ActuationWrench]:
    answers = []
    for joint in found.limb.joints:
        if assembly.variable_of(joint) is None:
            continue
        screw = _actuation_wrench(assembly, found, joint)
        answers.append(
            ActuationWrench(
                assembly.joint_of(joint).name,
                assembly.freedom_of(joint),
                found.limb.name,
                None if screw is None else writer.wrench(screw),
            )
        )
    return answers


def _actuation_wrench(
    assembly: Assembly, found: _Limb, joint: str
) -> FoundScrew | None:
    """What locking a joint adds to the constraints of its limb."""
    ring = found.framed.ring
    others = [name for name in found.limb.joints if name != joint]
    columns = [found.framed.column(name) for name in others]
    if len(independent(ring, columns)) == found.rank:
        return None
    basis = found.finder.basis(
        columns,
        len(found.constraints) + 1,
        lambda: _reciprocal(assembly, found.limb, others),
        found.constraints,
    )
    return basis[-1]


def _platform(
    assembly: Assembly, limbs: Sequence[_Limb], writer: ScrewWriter
) -> PlatformScrews:
    framed = replace(
        assembly.base_twists, limbs=tuple(limb.joints for limb in assembly.limbs)
    )
    ring = framed.ring
    wrenches = span_of(ring, [limb.constraints for limb in limbs])
    named = {
        called: screw
        for limb in limbs
        for called, screw in _forces(limb, several=len(limb.constraints) > 1).items()
    }
    finder = Finder(framed, assembly.mechanism.base, named, whole=True)
    columns = [screw.column for screw in wrenches]
    twists = finder.basis(
        columns,
        SCREW_DIMENSION - len(wrenches),
        lambda: [FoundScrew(c) for c in reciprocal_basis(ring, columns).columns],
    )
    return PlatformScrews(
        twist_dimension=len(twists),
        twists=tuple(writer.twist(screw) for screw in twists),
        wrench_dimension=len(wrenches),
        wrenches=tuple(writer.wrench(screw) for screw in wrenches),
    )


def _forces(found: _Limb, *, several: bool) -> dict[str, FoundScrew]:
    """The constraint forces of a limb by what they are called."""
    forces = [screw for screw in found.constraints if screw.how and not screw.is_free]
    name = f"of limb {found.limb.name}"
    if len(forces) == 1 and not several:
        return {f"the constraint force {name}": forces[0]}
    return {
        f"constraint force {number} {name}": force
        for number, force in enumerate(forces, 1)
    }
