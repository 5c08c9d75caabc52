"""Which joints of a mechanism a part of a certificate speaks of."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.certificates.records import Part
from screwkit.certificates.texts import RefusedError
from screwkit.mechanism.graph import (
    Limb,
    holding_joints,
    independent_loops,
    limbs,
)
from screwkit.mechanism.joints import freedom_labels
from screwkit.mechanism.model import Mechanism
from screwkit.mechanism.parts import part_of


@dataclass(frozen=True)
class SpokenOf:
    """The joints of a part.

    Attributes:
        mechanism: The whole, or the limb of the part as a mechanism of its own.
        chain: The joints whose twists are needed.
        limbs: By limb that is a chain, its freedoms; none where the part is about loop
            equations of the joint graph.
    """

    mechanism: Mechanism
    chain: tuple[str, ...]
    limbs: tuple[tuple[str, ...], ...] = ()


def spoken_of(mechanism: Mechanism, part: Part) -> SpokenOf:
    """What a part speaks of.

    Raises:
        RefusedError: If the mechanism has nothing of the kind.
    """
    if part.form == "loops":
        return _of_loops(mechanism, part)
    if part.form:
        raise RefusedError(f"{part.form!r} is no form of a matrix")
    return _of_limbs(mechanism, part)


def _of_loops(mechanism: Mechanism, part: Part) -> SpokenOf:
    if mechanism.base != mechanism.platform and not holding_joints(mechanism):
        raise RefusedError("nothing connects the platform with the base")
    own = mechanism
    if part.question == "limb":
        ends = mechanism.base, mechanism.platform
        own = part_of(mechanism, _limb(mechanism, part).joints, ends)
    return SpokenOf(own, tuple(joint.name for joint in own.joints))


def _of_limbs(mechanism: Mechanism, part: Part) -> SpokenOf:
    chosen = limbs(mechanism)
    if part.question == "limb":
        chosen = (_limb(mechanism, part),)
    elif independent_loops(mechanism) != max(0, len(chosen) - 1):
        raise RefusedError("there are other loops than those that limbs close")
    joints = {joint.name: joint for joint in mechanism.joints}
    chain: list[str] = []
    found: list[tuple[str, ...]] = []
    for limb in chosen:
        if limb.path is None:
            raise RefusedError(f"limb {limb.name!r} is no serial chain")
        chain += [name for name, _ in limb.path]
        labels = [
            label
            for name, _ in limb.path
            for label in freedom_labels(joints[name], mechanism.space)
        ]
        found.append(tuple(labels))
    return SpokenOf(mechanism, tuple(chain), tuple(found))


def _limb(mechanism: Mechanism, part: Part) -> Limb:
    for limb in limbs(mechanism):
        if limb.name == part.limb:
            return limb
    raise RefusedError(f"there is no limb {part.limb!r}")
