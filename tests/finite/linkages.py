"""Linkages at one posture, written down joint by joint for tests of finite motion."""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.kinematics.network import Network
from screwkit.mechanism.files import mechanism_from_text

Vector = Sequence[object]
Z: Vector = (0, 0, 1)


def network(*joints: str, extra: str = "", platform: str = "") -> Network:
    """From joints as `hinge` and its like write them; the first link is the base."""
    links: dict[str, None] = {}
    for joint in joints:
        _, _, rest = joint.partition("parent: ")
        parent, _, rest = rest.partition(", child: ")
        links |= {parent: None, rest.partition(",")[0].rstrip("}"): None}
    base, *others = links
    text = (
        f"screwkit: 1\nname: linkage\ntitle: A linkage\ngeometry: posture\n"
        f"base: {base}\nplatform: {platform or others[-1]}\n"
        f"links: [{', '.join(links)}]\n{extra}joints:\n"
    )
    text += "".join(f"  - {{{joint}}}\n" for joint in joints)
    return Network(mechanism_from_text(text, "linkage.yaml"))


def hinge(name: str, parent: str, child: str, point: Vector, axis: Vector = Z) -> str:
    """A revolute joint."""
    return (
        f"name: {name}, type: revolute, parent: {parent}, child: {child}, "
        f"point: {_vector(point)}, axis: {_vector(axis)}"
    )


def slider(name: str, parent: str, child: str, axis: Vector) -> str:
    """A prismatic joint."""
    return (
        f"name: {name}, type: prismatic, parent: {parent}, child: {child}, "
        f"axis: {_vector(axis)}"
    )


def screw_joint(
    name: str, parent: str, child: str, point: Vector, axis: Vector, pitch: object
) -> str:
    """A helical joint."""
    return (
        f"name: {name}, type: helical, parent: {parent}, child: {child}, "
        f'point: {_vector(point)}, axis: {_vector(axis)}, pitch: "{pitch}"'
    )


def ball(name: str, parent: str, child: str, point: Vector) -> str:
    """A spherical joint."""
    return (
        f"name: {name}, type: spherical, parent: {parent}, child: {child}, "
        f"point: {_vector(point)}"
    )


def universal(
    name: str, parent: str, child: str, point: Vector, axes: tuple[Vector, Vector]
) -> str:
    """A universal joint."""
    return (
        f"name: {name}, type: universal, parent: {parent}, child: {child}, "
        f"point: {_vector(point)}, axes: [{_vector(axes[0])}, {_vector(axes[1])}]"
    )


def ring(places: Sequence[tuple[Vector, Vector]]) -> Network:
    """One loop of hinges, each given by a point and its axis."""
    count = len(places)
    return network(
        *(
            hinge(f"j{k}", f"b{k}", f"b{(k + 1) % count}", point, axis)
            for k, (point, axis) in enumerate(places)
        ),
        platform=f"b{count // 2}",
    )


def flat_ring(*points: tuple[object, object]) -> Network:
    """A planar loop of hinges."""
    return ring([((x, y, 0), Z) for x, y in points])


def frame(
    bars: Sequence[tuple[tuple[object, object], tuple[object, object]]],
) -> Network:
    """A body held in the plane by bars from the ground, hinged at both ends."""
    joints = []
    for k, (foot, head) in enumerate(bars):
        joints += [
            hinge(f"f{k}", "ground", f"bar{k}", (*foot, 0)),
            hinge(f"h{k}", f"bar{k}", "body", (*head, 0)),
        ]
    return network(*joints, platform="body")


def _vector(values: Vector) -> str:
    return "[" + ", ".join(f'"{value}"' for value in values) + "]"


def doubled_contacts(stages: int) -> Network:
    """Sliders at right angles with rods between them, each rod at its dead point.

    A slider that has gone t along its rail draws the next one back by 1 − √(1 − t²),
    t²/2 to first order; the last rod is pinned to the ground.
    """
    rails = [(1, 0, 0), (0, 1, 0)]
    joints = [slider("s0", "ground", "b0", rails[0])]
    corner = (0, 0, 0)
    for k in range(1, stages + 1):
        across = rails[k % 2]
        end = (corner[0] + across[0], corner[1] + across[1], 0)
        last = "ground" if k == stages else f"b{k}"
        joints += [
            hinge(f"u{k}", f"b{k - 1}", f"rod{k}", corner),
            hinge(f"v{k}", f"rod{k}", last, end),
        ]
        if k < stages:
            joints.append(slider(f"s{k}", "ground", f"b{k}", across))
        corner = end
    return network(*joints, platform="b0")
