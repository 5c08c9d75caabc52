"""Why a choice of actuators never stops the platform of a joint graph.

What is said is what `witness` says of limbs: actuators that hold nothing or the same,
and the motion that is left, named by axes and points of the mechanism.  Where no limb
carries the platform alone the joints that move with it are named too.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import cached_property

from screwkit.algebra.modular import annihilator
from screwkit.algebra.names import counted
from screwkit.conventions import DIRECTION
from screwkit.kinematics.network import Motion
from screwkit.kinematics.subspaces import dimension
from screwkit.kinematics.whole_graph import (
    GraphState,
    LockedRanks,
    WholeGraph,
    ranks_of,
)
from screwkit.loci.features import Features, listed
from screwkit.loci.placed_features import Residue, features_at, features_of
from screwkit.loci.remaining_motion import motion_in_words
from screwkit.loci.wasted_actuators import HeldFreedoms, doing_too_little, too_few

_POINTS = 2  # postures at which the same has to be seen
_LISTED = 6  # joints that are named


class GraphWitnesses:
    """Why choices of actuators never stop the platform of one graph."""

    def __init__(self, graph: WholeGraph) -> None:
        self._graph = graph
        self._ranks = [LockedRanks(found) for found in graph.generic_motions]

    def state(self, locked: Sequence[str]) -> GraphState:
        """What moves in general with these freedoms locked."""
        states = [one.state(locked) for one in self._ranks]
        return max(states, key=ranks_of)

    def of(self, actuated: Sequence[str]) -> str:
        """A sentence that explains why the platform stays movable."""
        held = self._held
        if len(actuated) < held.platform:
            return too_few(len(actuated), held.platform)
        wasted = held.wasted_in(actuated)
        if wasted is not None and len(wasted.actuators) < 3:
            return doing_too_little(wasted, self._motion_type)
        text, named = self._left(actuated)
        if wasted is None or named or len(wasted.actuators) == len(actuated):
            return text
        return f"{doing_too_little(wasted, self._motion_type)}; {text}"

    @cached_property
    def _held(self) -> HeldFreedoms:
        return HeldFreedoms(lambda locked: self.state(locked).platform_freedom)

    @cached_property
    def _features(self) -> list[Features[Residue]]:
        """At the first exact postures."""
        exact = features_of(self._graph.framed)
        return [features_at(exact, *point) for point in self._graph.points[:_POINTS]]

    def _motions(self, locked: Collection[str]) -> list[Motion]:
        return [
            self._graph.motion_at(*point, locked)
            for point in self._graph.points[:_POINTS]
        ]

    def _motion_type(self, locked: Sequence[str]) -> str:
        types = {_type(found) for found in self._motions(locked)}
        if len(types) == 1:
            return types.pop()
        freedom = self.state(locked).platform_freedom
        return f"the same {counted(freedom, 'freedom')}"

    def _left(self, locked: Sequence[str]) -> tuple[str, bool]:
        """The motion that is left in words; whether they name something."""
        said = {
            (*_in_words(found, features), _moving_with_it(found))
            for found, features in zip(
                self._motions(locked), self._features, strict=True
            )
        }
        freedom = self.state(locked).platform_freedom
        if len(said) != 1:
            return f"the platform keeps {counted(freedom, 'freedom')}", False
        text, named, joints = said.pop()
        return text + _and_joints(joints), named


def _type(found: Motion) -> str:
    """The type of the platform's motion, nTmR."""
    twists = found.platform_twists
    turning = dimension([t[DIRECTION] for t in twists], found.posture.prime)
    return f"{len(twists) - turning}T{turning}R"


def _in_words(found: Motion, features: Features[Residue]) -> tuple[str, bool]:
    twists = found.platform_twists
    if len(twists) != 1:
        count = counted(len(twists), "freedom")
        return f"the platform keeps {count}: {_type(found)}", False
    motion = motion_in_words(twists[0], found.posture.prime, features)
    return motion.text, motion.named


def _moving_with_it(found: Motion) -> tuple[str, ...]:
    """Joints that move whenever the platform does, and never without it.

    A joint that idle motions turn too can be still while the platform moves.
    """
    network, prime = found.network, found.posture.prime
    platform, base = network.mechanism.platform, network.mechanism.base
    if not network.connected(platform, base):
        return ()
    twists = [twist[platform] for twist in found.all_twists]
    idle = annihilator([*zip(*twists, strict=True)], len(twists), prime)
    moving: dict[str, bool] = {}
    for label in network.labels:
        rates = [rate.get(label, 0) for rate in found.rates]
        if any(rates):
            joint = network.joint_of[label]
            alone = any(
                sum(x * y for x, y in zip(sums, rates, strict=True)) % prime
                for sums in idle
            )
            moving[joint] = moving.get(joint, False) or alone
    return tuple(joint for joint, alone in moving.items() if not alone)


def _and_joints(joints: Sequence[str]) -> str:
    if len(joints) < 2:
        return ""  # it carries the platform, and its axis was named
    names = list(joints)
    if len(names) > _LISTED:
        names[_LISTED - 1 :] = [f"{len(names) - _LISTED + 1} more"]
    return f"; joints {listed(names)} move"
