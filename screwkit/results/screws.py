"""What `screws` answers: twist and wrench systems, each screw identified."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.mobility import MotionClass
from screwkit.results.shown import Shown


@dataclass(frozen=True)
class IdentifiedScrew:
    """A screw with its kind and line.

    Attributes:
        coordinates: Six strings (three in planar files), direction then moment; none
            where they are too long to be written, see ``description``.
        kind: ``force``, ``couple``, ``screw`` (wrenches) or ``rotation``,
            ``translation``, ``screw`` (twists).
        axis: Direction of the axis (of the couple or translation itself).
        point: A point of the axis; empty for couples and translations.
        pitch: ``"0"`` for forces and rotations, ``""`` where infinite.
        description: In words and the reader's own names; may be empty.
    """

    coordinates: tuple[str, ...]
    kind: str
    axis: tuple[str, ...]
    point: tuple[str, ...]
    pitch: str
    description: str = ""


@dataclass(frozen=True)
class LimbScrews:
    """Twist and wrench system of one limb, generic."""

    name: str
    joints: tuple[str, ...]
    twist_dimension: int
    twists: tuple[IdentifiedScrew, ...]
    wrench_dimension: int
    wrenches: tuple[IdentifiedScrew, ...]


@dataclass(frozen=True)
class PlatformScrews:
    """Freedoms of the platform and the constraint wrenches of all limbs together."""

    twist_dimension: int
    twists: tuple[IdentifiedScrew, ...]
    wrench_dimension: int
    wrenches: tuple[IdentifiedScrew, ...]


@dataclass(frozen=True)
class ActuationWrench:
    """The wrench that a locked freedom adds, modulo its limb's constraint wrenches.

    Attributes:
        screw: None where locking the freedom adds nothing: the other joints of the
            limb give all its freedoms.
    """

    joint: str
    freedom: int
    limb: str
    screw: IdentifiedScrew | None


@dataclass(frozen=True, repr=False)
class Screws(Shown):
    """The answer of ``screws``.

    Attributes:
        order: ``direction-moment`` or ``moment-direction``.
        frame: The link whose axes are used.
        point: The point about which moments are taken, ``origin``.
        generic: Whether the systems are given in the symbols; else at the values of
            the file.
    """

    case: str
    title: str
    order: str
    frame: str
    point: str
    limbs: tuple[LimbScrews, ...]
    platform: PlatformScrews
    actuation_wrenches: tuple[ActuationWrench, ...]
    generic: bool = True


@dataclass(frozen=True, repr=False)
class RelativeMotion(Shown):
    """The twist system of one body relative to another, and what it leaves to wrenches.

    Attributes:
        body: Whose motion it is.
        relative_to: The body at rest.
        order: ``direction-moment`` or ``moment-direction``.
        frame: The link whose axes are used.
        point: The point about which moments are taken, ``origin``.
        twists: A basis.
        wrenches: A basis of the wrenches that do no work on any of them.
        motion_class: Whatever the basis.
        generic: Whether the basis is one in the symbols; else it holds at the values of
            the file.
    """

    case: str
    title: str
    body: str
    relative_to: str
    order: str
    frame: str
    point: str
    twist_dimension: int
    twists: tuple[IdentifiedScrew, ...]
    wrench_dimension: int
    wrenches: tuple[IdentifiedScrew, ...]
    motion_class: MotionClass | None = None
    generic: bool = True
