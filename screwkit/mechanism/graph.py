"""The joint graph of a mechanism: components, loops and limbs.

Links are nodes, joints are edges, and several joints between two links are several
edges.  The only importer of networkx, which is loaded when it is first needed.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from screwkit.mechanism.joints import RIGID, variable_count
from screwkit.mechanism.model import Joint, Mechanism

if TYPE_CHECKING:
    import networkx as nx

Step: TypeAlias = tuple[str, int]
"""A joint and +1 where it is passed from parent to child, −1 where backwards."""


@dataclass(frozen=True)
class Limb:
    """What connects base and platform, seen as one part.

    Attributes:
        joints: All its joints, in the order of the file.
        links: Its links without base and platform, in the order of the file.
        path: From base to platform, where the limb is a serial chain; else None.
    """

    name: str
    joints: tuple[str, ...]
    links: tuple[str, ...]
    path: tuple[Step, ...] | None


@dataclass(frozen=True)
class Part:
    """A component, without base and platform, that does not connect the two.

    Attributes:
        touches: Those of base and platform that it hangs on; empty: on neither.
    """

    joints: tuple[str, ...]
    links: tuple[str, ...]
    touches: tuple[str, ...]


def joint_graph(mechanism: Mechanism) -> nx.MultiGraph[str]:
    """The graph with the links as nodes; the key of an edge is the joint's name."""
    import networkx as nx  # noqa: PLC0415

    graph: Any = nx.MultiGraph()
    graph.add_nodes_from(mechanism.links)
    for joint in mechanism.joints:
        graph.add_edge(joint.parent, joint.child, key=joint.name, joint=joint)
    return graph


def components(mechanism: Mechanism) -> tuple[tuple[str, ...], ...]:
    """The connected components, links in the order of the file, the base's first."""
    groups = _groups(mechanism.links, mechanism.joints)
    return tuple(sorted(groups, key=lambda links: mechanism.base not in links))


def independent_loops(mechanism: Mechanism) -> int:
    """Joints − links + components."""
    return (
        len(mechanism.joints)
        - len(mechanism.links)
        + len(_groups(mechanism.links, mechanism.joints))
    )


def spanning_tree(mechanism: Mechanism) -> tuple[str, ...]:
    """Joints of a spanning forest that keeps the distance to the base shortest."""
    reached = _reached(mechanism)
    kept = {steps[-1][0] for steps in reached.values() if steps}
    return tuple(joint.name for joint in mechanism.joints if joint.name in kept)


def fundamental_loops(mechanism: Mechanism) -> tuple[tuple[Step, ...], ...]:
    """One loop for every joint outside the spanning tree.

    Each goes from the tree's root towards the joint, over it and back; the way that
    both have in common is left out.  With the base in the component, a loop starts at
    the link on it that is nearest to the base.
    """
    reached = _reached(mechanism)
    tree = {steps[-1][0] for steps in reached.values() if steps}
    loops = []
    for joint in mechanism.joints:
        if joint.name in tree:
            continue
        out, back = reached[joint.parent], reached[joint.child]
        shared = 0
        while shared < min(len(out), len(back)) and out[shared] == back[shared]:
            shared += 1
        backwards = tuple((name, -sign) for name, sign in reversed(back[shared:]))
        loops.append((*out[shared:], (joint.name, 1), *backwards))
    return tuple(loops)


def limbs(mechanism: Mechanism) -> tuple[Limb, ...]:
    """The limbs, in the order of their first joints, with the names of the file."""
    found = []
    connecting = [part for part in _parts(mechanism) if len(part.touches) == 2]
    for number, part in enumerate(connecting, start=1):
        name = _name_of(part, mechanism) or f"limb_{number}"
        path = _serial_path(part, mechanism)
        found.append(Limb(name, part.joints, part.links, path))
    return tuple(found)


def other_parts(mechanism: Mechanism) -> tuple[Part, ...]:
    """What is no limb: trees hanging on base or platform alone, or on neither."""
    return tuple(part for part in _parts(mechanism) if len(part.touches) < 2)


def has_freedom(joint: Joint) -> bool:
    """Whether the joint is no rigid connection."""
    return joint.type not in RIGID


def actuable_freedoms(mechanism: Mechanism) -> tuple[str, ...]:
    """Every freedom a motor can drive, as `freedom_label` writes it."""
    labels = []
    for joint in mechanism.joints:
        count = variable_count(joint.type, mechanism.space)
        if count == 1:
            labels.append(joint.name)
        else:
            labels.extend(f"{joint.name}:{k}" for k in range(count))
    return tuple(labels)


def _parts(mechanism: Mechanism) -> tuple[Part, ...]:
    """The components without base and platform, each with its joints to both."""
    ends = (mechanism.base, mechanism.platform)
    inner = [link for link in mechanism.links if link not in ends]
    between = [j for j in mechanism.joints if not {j.parent, j.child} & set(ends)]
    parts: list[tuple[Sequence[Joint], tuple[str, ...]]] = []
    for links in _groups(inner, between):
        members = set(links)
        own = [j for j in mechanism.joints if {j.parent, j.child} & members]
        if own:
            parts.append((own, links))
    parts.extend(
        ([joint], ())
        for joint in mechanism.joints
        if {joint.parent, joint.child} <= set(ends)
    )
    order = {joint.name: i for i, joint in enumerate(mechanism.joints)}
    parts.sort(key=lambda part: order[part[0][0].name])
    return tuple(
        Part(
            tuple(joint.name for joint in own),
            links,
            tuple(e for e in dict.fromkeys(ends) if any(_has(j, e) for j in own)),
        )
        for own, links in parts
    )


def _has(joint: Joint, link: str) -> bool:
    return link in (joint.parent, joint.child)


def _name_of(part: Part, mechanism: Mechanism) -> str | None:
    """The name whose joints belong to the part."""
    for name, joints in mechanism.limb_names.items():
        if joints and set(joints) <= set(part.joints):
            return name
    return None


def _serial_path(part: Part, mechanism: Mechanism) -> tuple[Step, ...] | None:
    """The way from base to platform, if it uses every joint and never branches."""
    left = [joint for joint in mechanism.joints if joint.name in part.joints]
    here = mechanism.base
    visited = {here}
    path: list[Step] = []
    while left:
        onward = [joint for joint in left if _has(joint, here)]
        if len(onward) != 1 or here == mechanism.platform:
            return None
        joint = onward[0]
        left.remove(joint)
        path.append((joint.name, 1 if joint.parent == here else -1))
        here = joint.child if joint.parent == here else joint.parent
        if here in visited:
            return None
        visited.add(here)
    return tuple(path) if here == mechanism.platform else None


def _groups(
    links: Iterable[str], joints: Iterable[Joint]
) -> tuple[tuple[str, ...], ...]:
    """Connected links, by joining sets; cheap enough to need no library."""
    leader = {link: link for link in links}

    def find(link: str) -> str:
        while leader[link] != link:
            leader[link] = leader[leader[link]]
            link = leader[link]
        return link

    for joint in joints:
        leader[find(joint.parent)] = find(joint.child)
    groups: dict[str, list[str]] = {}
    for link in leader:
        groups.setdefault(find(link), []).append(link)
    return tuple(tuple(group) for group in groups.values())


def _reached(mechanism: Mechanism) -> dict[str, tuple[Step, ...]]:
    """For every link the way to it in a breadth-first forest rooted at the base."""
    import networkx as nx  # noqa: PLC0415

    graph = joint_graph(mechanism)
    reached: dict[str, tuple[Step, ...]] = {}
    for root in (mechanism.base, *mechanism.links):
        if root in reached:
            continue
        reached[root] = ()
        for here, there in nx.bfs_edges(graph, root):
            # Of several joints between two links the first of the file is the tree's.
            joint = next(iter(graph[here][there].values()))["joint"]
            sign = 1 if joint.parent == here else -1
            reached[there] = (*reached[here], (joint.name, sign))
    return reached
