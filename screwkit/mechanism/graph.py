"""The joint graph of a mechanism: components, loops and limbs.

Links are nodes, joints are edges, and several joints between two links are several
edges.  The only importer of networkx, which is loaded when it is first needed.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

from screwkit.mechanism.joints import RIGID, variable_count
from screwkit.mechanism.model import Joint, JointType, Mechanism

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
    kept = _forest(mechanism).joints
    return tuple(joint.name for joint in mechanism.joints if joint.name in kept)


def closing_tree(mechanism: Mechanism) -> tuple[str, ...]:
    """Joints of a spanning forest with few variables: those outside close the loops.

    What closes a loop at a spherical joint, a point in one place, is shorter than what
    does at a hinge, and free of the variables of both.  Where no forest has fewer
    variables than `spanning_tree` it is that one.
    """
    nearest = _forest(mechanism)
    counts: dict[bool, list[int]] = {True: [0], False: []}
    for joint in mechanism.joints:
        counts[joint.name in nearest.joints].append(_variables(joint, mechanism))
    if max(counts[True]) <= min(counts[False], default=max(counts[True])):
        return spanning_tree(mechanism)  # nothing to exchange, and nothing to import
    import networkx as nx  # noqa: PLC0415

    graph: Any = nx.MultiGraph()
    graph.add_nodes_from(mechanism.links)
    for joint in mechanism.joints:
        nearer = min(nearest.depth[joint.parent], nearest.depth[joint.child])
        other = joint.name not in nearest.joints
        size = 2 * len(mechanism.links)
        weight = (_variables(joint, mechanism) * 2 + other) * size + nearer
        graph.add_edge(joint.parent, joint.child, key=joint.name, weight=weight)
    kept = {name for _, _, name in nx.minimum_spanning_edges(graph, data=False)}
    fewer, usual = (
        sum(_variables(j, mechanism) for j in mechanism.joints if j.name in names)
        for names in (kept, nearest.joints)
    )
    if fewer >= usual:
        return spanning_tree(mechanism)
    return tuple(joint.name for joint in mechanism.joints if joint.name in kept)


def _variables(joint: Joint, mechanism: Mechanism) -> int:
    """Of a joint; a helical one counts as none: no polynomials close a loop there."""
    if joint.type is JointType.HELICAL:
        return 0
    return variable_count(joint.type, mechanism.space)


def fundamental_loops(mechanism: Mechanism) -> tuple[tuple[Step, ...], ...]:
    """One loop for every joint outside the spanning tree.

    Each goes from the tree's root towards the joint, over it and back; the way that
    both have in common is left out.  With the base in the component, a loop starts at
    the link on it that is nearest to the base.
    """
    forest = _forest(mechanism)
    loops = []
    for joint in mechanism.joints:
        if joint.name in forest.joints:
            continue
        out, back = forest.ways_from_meeting(joint.parent, joint.child)
        backwards = ((name, -sign) for name, sign in reversed(back))
        loops.append((*out, (joint.name, 1), *backwards))
    return tuple(loops)


def limbs(mechanism: Mechanism) -> tuple[Limb, ...]:
    """The limbs, in the order of their first joints, with the names of the file."""
    connecting = [part for part in _parts(mechanism) if len(part.touches) == 2]
    names = _names_of(connecting, mechanism)
    return tuple(
        Limb(
            names.get(number, f"limb_{number + 1}"),
            part.joints,
            part.links,
            _serial_path(part, mechanism),
        )
        for number, part in enumerate(connecting)
    )


def other_parts(mechanism: Mechanism) -> tuple[Part, ...]:
    """What is no limb: trees hanging on base or platform alone, or on neither."""
    return tuple(part for part in _parts(mechanism) if len(part.touches) < 2)


def holding_joints(mechanism: Mechanism) -> tuple[str, ...]:
    """Joints and contacts by which bodies that hang on the base touch the platform."""
    base, platform = mechanism.base, mechanism.platform
    if base == platform:
        return ()
    others = [joint for joint in mechanism.joints if not _touches(joint, platform)]
    links = [link for link in mechanism.links if link != platform]
    near = next(group for group in _groups(links, others) if base in group)
    return tuple(
        joint.name
        for joint in mechanism.joints
        if _touches(joint, platform) and {joint.parent, joint.child} & set(near)
    )


def _touches(joint: Joint, link: str) -> bool:
    return link in (joint.parent, joint.child)


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
    groups = _groups(inner, between)
    group_of = {link: i for i, links in enumerate(groups) for link in links}
    # Parts in the order of their first joints; a joint between the ends is one alone.
    owned: dict[int | str, list[Joint]] = {}
    for joint in mechanism.joints:
        inside = joint.child if joint.parent in ends else joint.parent
        owned.setdefault(group_of.get(inside, joint.name), []).append(joint)
    return tuple(
        Part(
            tuple(joint.name for joint in joints),
            groups[key] if isinstance(key, int) else (),
            tuple(e for e in dict.fromkeys(ends) if any(_has(j, e) for j in joints)),
        )
        for key, joints in owned.items()
    )


def _has(joint: Joint, link: str) -> bool:
    return link in (joint.parent, joint.child)


def _names_of(parts: Sequence[Part], mechanism: Mechanism) -> dict[int, str]:
    """By position, the first name in the file all of whose joints belong to a part."""
    part_of = {name: i for i, part in enumerate(parts) for name in part.joints}
    names: dict[int, str] = {}
    for name, joints in mechanism.limb_names.items():
        owners = {part_of.get(joint) for joint in joints}
        if len(owners) == 1 and (owner := owners.pop()) is not None:
            names.setdefault(owner, name)
    return names


def _serial_path(part: Part, mechanism: Mechanism) -> tuple[Step, ...] | None:
    """The way from base to platform, if it uses every joint and never branches."""
    at: dict[str, list[Joint]] = {}
    for name in part.joints:
        joint = mechanism.joint(name)
        at.setdefault(joint.parent, []).append(joint)
        at.setdefault(joint.child, []).append(joint)
    here, last = mechanism.base, ""
    visited = {here}
    path: list[Step] = []
    while len(path) < len(part.joints):
        onward = [joint for joint in at[here] if joint.name != last]
        if len(onward) != 1 or here == mechanism.platform:
            return None
        joint, last = onward[0], onward[0].name
        path.append((last, 1 if joint.parent == here else -1))
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


@dataclass(frozen=True)
class _Forest:
    """A breadth-first forest: for every link the step that leads to it.

    Attributes:
        above: The link before it, and the step; roots have neither.
        depth: Steps from the root.
        joints: Names of the joints that the forest uses.
    """

    above: Mapping[str, tuple[str, Step]]
    depth: Mapping[str, int]
    joints: frozenset[str]

    def ways_from_meeting(self, left: str, right: str) -> tuple[list[Step], list[Step]]:
        """The ways down to two links from the deepest link above both."""
        ways: tuple[list[Step], list[Step]] = ([], [])
        ends = [left, right]
        while ends[0] != ends[1]:
            side = 0 if self.depth[ends[0]] >= self.depth[ends[1]] else 1
            ends[side], step = self.above[ends[side]]
            ways[side].append(step)
        return ways[0][::-1], ways[1][::-1]


def _forest(mechanism: Mechanism) -> _Forest:
    """Rooted at the base, then at the first link of each other component."""
    # Of several joints between two links the first of the file is the tree's.
    beside: dict[str, dict[str, Joint]] = {link: {} for link in mechanism.links}
    for joint in mechanism.joints:
        beside[joint.parent].setdefault(joint.child, joint)
        beside[joint.child].setdefault(joint.parent, joint)
    above: dict[str, tuple[str, Step]] = {}
    depth: dict[str, int] = {}
    for root in (mechanism.base, *mechanism.links):
        if root in depth:
            continue
        depth[root] = 0
        queue = deque([root])
        while queue:
            here = queue.popleft()
            for there, joint in beside[here].items():
                if there not in depth:
                    sign = 1 if joint.parent == here else -1
                    above[there] = (here, (joint.name, sign))
                    depth[there] = depth[here] + 1
                    queue.append(there)
    used = frozenset(name for _, (name, _) in above.values())
    return _Forest(above, depth, used)
