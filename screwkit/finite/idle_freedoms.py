"""Freedoms that a body between two joints has for itself, and that can be left aside.

If a body has two joints only, each of which moves in a whole group, the displacements
common to both groups turn the body and nothing else: rods between ball joints spin,
pins in line with pins slip.  In suitable joint variables such a motion is a factor of
the closed postures, so that they may be studied with the freedom held, and one added.

References: [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from screwkit.algebra.elimination_modulo import eliminated
from screwkit.finite.lie_closure import ResidueScrew, Span, is_subalgebra
from screwkit.kinematics.network import Motion


@dataclass(frozen=True)
class IdleMotion:
    """What a body with two joints may do by itself.

    Attributes:
        body: Its name.
        joints: Its two joints; freedoms of the first are held.
        held: Their labels, one for each dimension.
    """

    body: str
    joints: tuple[str, str]
    held: tuple[str, ...]


def idle_freedoms(
    motion: Motion,
    apart_from: Collection[str] = (),
    shares: Mapping[str, float] | None = None,
) -> tuple[str, ...]:
    """Labels of freedoms to hold, one for each dimension of `idle_motions`."""
    found = idle_motions(motion, apart_from, shares)
    return tuple(label for idle in found for label in idle.held)


def idle_motions(
    motion: Motion,
    apart_from: Collection[str] = (),
    shares: Mapping[str, float] | None = None,
) -> tuple[IdleMotion, ...]:
    """The idle motions of bodies with two joints, and freedoms to hold for them.

    Near the posture a joint with the group G is the product of the held factors' rest
    and of the common group K: G = G′·K, since their screws are a basis of G's algebra.
    The factors of K then meet those of the other joint, which absorbs them.

    Args:
        motion: At the posture.
        apart_from: Bodies whose own motion is asked for, whose idle freedoms stay.
        shares: How much each freedom takes part in idle motions, where that is known:
            of the freedoms that may be held those with the largest shares are.
    """
    sizes = shares or {}
    network, posture = motion.network, motion.posture
    prime = posture.prime
    labels = {
        name: [x for x in own if x not in motion.locked and x in posture.twists]
        for name, own in network.labels_of.items()
    }
    contacts = {network.joint_of[label] for label in network.contact_labels}
    joints_at: dict[str, list[str]] = {}
    # By names, so that the order in a file does not matter.
    for joint in sorted(network.mechanism.joints, key=lambda joint: joint.name):
        for link in {joint.parent, joint.child}:
            joints_at.setdefault(link, []).append(joint.name)
    found: list[IdleMotion] = []
    for link in sorted(network.mechanism.links):
        names = joints_at.get(link, [])
        if len(names) != 2 or contacts & set(names) or link in apart_from:
            continue
        one, other = ([posture.twists[x] for x in labels[name]] for name in names)
        if not (_is_group(one, prime) and _is_group(other, prime)):
            continue
        common = _common(one, other, prime)
        span = Span(prime, common)
        first = names[0]
        ordered = sorted(labels[first], key=lambda label: sizes.get(label, 0.0))
        dropped = [label for label in ordered if not span.add(posture.twists[label])]
        if dropped:
            found.append(IdleMotion(link, (first, names[1]), tuple(dropped)))
        labels[first] = [x for x in labels[first] if x not in dropped]
    return tuple(found)


def _is_group(screws: Sequence[ResidueScrew], prime: int) -> bool:
    independent = len(Span(prime, screws)) == len(screws)
    return independent and is_subalgebra(screws, prime)


def _common(
    one: Sequence[ResidueScrew], other: Sequence[ResidueScrew], prime: int
) -> list[ResidueScrew]:
    """Basis of the intersection of two systems given by bases."""
    rows = [
        {
            k: sign * screw[i] % prime
            for k, (sign, screw) in enumerate(
                [*((1, s) for s in one), *((-1, s) for s in other)]
            )
            if screw[i] % prime
        }
        for i in range(6)
    ]
    vectors = eliminated(rows, len(one) + len(other), prime).null_vectors()
    return [
        tuple(
            sum(vector.get(k, 0) * screw[i] for k, screw in enumerate(one)) % prime
            for i in range(6)
        )
        for vector in vectors
    ]
