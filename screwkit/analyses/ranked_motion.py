"""What schemes are ranked by: freedoms, loops and exact ranks of a mechanism.

Serial limbs are asked as limbs, all schemes at once; any other joint graph, limbs with
loops inside too, by the joint rates that close all its loops.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from screwkit.errors import UndecidedError
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.network import Network
from screwkit.kinematics.whole_graph import LockedRanks, ranks_of
from screwkit.loci.actuation import passive_joints
from screwkit.loci.passive import PassiveSystem
from screwkit.mechanism.graph import Step
from screwkit.mechanism.model import Mechanism
from screwkit.metrics.scheme_conditioning import Incidence, incidence


@dataclass(frozen=True)
class RankedMotion:
    """The motion of a mechanism, in general over its free symbols.

    Attributes:
        labels: The freedoms, in the order of the incidence.
        incidence: Its loops, and the way to its platform.
        mobility: Dimension of the motions.
        freedom: Dimension of the platform's twists.
        left: Of each scheme what moves with it locked: (mobility, platform freedom).
    """

    labels: tuple[str, ...]
    incidence: Incidence
    mobility: int
    freedom: int
    left: tuple[tuple[int, int], ...]


def ranked_motion(
    mechanism: Mechanism, schemes: Sequence[tuple[str, ...]]
) -> RankedMotion:
    """The motion of a mechanism whose loops tie no joint variables.

    Args:
        mechanism: With numbers for what is the same at all postures.
        schemes: Freedoms that are locked together.
    """
    assembly = Assembly(mechanism)
    try:
        assembly.refuse_other_loops()
    except UndecidedError:
        return _of_graph(mechanism, schemes)
    if assembly.has_blocks:
        return _of_graph(mechanism, schemes)
    return _of_limbs(assembly, schemes)


def _of_limbs(assembly: Assembly, schemes: Sequence[tuple[str, ...]]) -> RankedMotion:
    """Loops lead out by the first limb and back by each other."""
    system = PassiveSystem(assembly)
    whole = system.generic_state(assembly.joints)
    states = system.generic_states(
        [passive_joints(assembly, actuated) for actuated in schemes]
    )
    first, *others = (
        [int(joint in limb.joints) for joint in assembly.joints]
        for limb in assembly.limbs
    )
    loops = [[a - b for a, b in zip(first, own, strict=True)] for own in others]
    return RankedMotion(
        tuple(assembly.joints),
        incidence(loops, first),
        whole.mobility,
        whole.platform_freedom,
        tuple((state.mobility, state.platform_freedom) for state in states),
    )


def _of_graph(mechanism: Mechanism, schemes: Sequence[tuple[str, ...]]) -> RankedMotion:
    """Loops and way as the joint graph has them."""
    network = Network(mechanism)
    ranks = [LockedRanks(found) for found in network.motions]

    def left(locked: tuple[str, ...]) -> tuple[int, int]:
        state = max((one.state(locked) for one in ranks), key=ranks_of)
        return state.mobility, state.platform_freedom

    way: list[Step] = []
    link = mechanism.platform
    while link != mechanism.base:
        link, step = network.steps[link]
        way.append(step)
    loops = [_signs(network, loop) for loop in network.loops]
    return RankedMotion(
        network.labels,
        incidence(loops, _signs(network, way)),
        *left(()),
        tuple(left(actuated) for actuated in schemes),
    )


def _signs(network: Network, steps: Sequence[Step]) -> list[int]:
    signs = dict(steps)
    return [signs.get(network.joint_of[label], 0) for label in network.labels]
