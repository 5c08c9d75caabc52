"""Rods between two bodies whose lengths follow from those of other rods.

Let a rod join b of one body to a of another, and the first be moved by x ↦ R x + d.
The rod keeps its length where

    |d|² − 2 a·d + 2 b·Rᵀd − 2 a·(R − 1) b = 0,

which is linear in (1, a, b, a ⊗ b).  A rod whose values depend on those of others
between the same bodies keeps its length wherever they do, and may be left out.  Of
equal rods from one circle to another, as on Wren's platform, no more than five count.
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.finite.chain_graph import ChainGraph, with_parameters
from screwkit.finite.idle_freedoms import IdleMotion
from screwkit.finite.lie_closure import ResidueScrew, Span
from screwkit.kinematics.network import Motion
from screwkit.mechanism.model import JointType


def implied_rods(at: Motion, idle: Sequence[IdleMotion]) -> tuple[IdleMotion, ...]:
    """The rods between two ball joints that may be left out.

    Args:
        at: At an exact posture, each ball's axes at right angles to each other.
        idle: Its idle motions, those of rods among them; of rods with equal claims the
            first ones stay.
    """
    joints = {joint.name: joint for joint in at.network.mechanism.joints}
    spans: dict[tuple[str, str], Span] = {}
    found = []
    for rod in idle:
        ends: dict[str, Sequence[int]] = {}
        for joint in (joints[name] for name in rod.joints):
            labels = at.network.labels_of[joint.name]
            if joint.type is JointType.SPHERICAL and not at.locked & set(labels):
                (body,) = {joint.parent, joint.child} - {rod.body}
                screws = [at.posture.twists[label] for label in labels]
                ends[body] = _centre(screws, at.posture.prime)
        if len(ends) == 2:
            (one, a), (other, b) = sorted(ends.items())
            values = [1, *a, *b, *(x * y for x in a for y in b)]
            if not spans.setdefault((one, other), Span(at.posture.prime)).add(values):
                found.append(rod)
    return tuple(found)


def without_rods(
    at: Motion, graph: ChainGraph, rods: Sequence[IdleMotion]
) -> ChainGraph:
    """The graph without the joints of some rods."""
    joints = {name for rod in rods for name in rod.joints}
    names = {label for name in joints for label in at.network.labels_of[name]}
    if not names:
        return graph
    return with_parameters((e for e in graph.edges if e.name not in names), graph.prime)


def _centre(screws: Sequence[ResidueScrew], prime: int) -> Sequence[int]:
    """The point c with moments c × ω of three axes at right angles."""
    total = [0, 0, 0]
    for x, y, z, u, v, w in screws:
        scale = pow(2 * (x * x + y * y + z * z), -1, prime)
        for k, value in enumerate((y * w - z * v, z * u - x * w, x * v - y * u)):
            total[k] = (total[k] + scale * value) % prime
    return total
