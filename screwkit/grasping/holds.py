"""Where the object is held, and which joints move each place.

The platform is the object.  Without it the joint graph falls apart into limbs; a tree
grows in each of them from the base, or from the object where nothing leads to the base
(from a body of its own where nothing leads to either), and every joint outside the
trees compares the velocities of two bodies: with the object's it is a *contact*, with
another body's a *closure* inside a limb.  A joint that moves stands in its tree with
its own freedoms and is rigid behind them; a contact of the file holds by its selector.

References: [BicchiMelchiorri] §2, [BicchiPrattichizzo] §II and Appendix A.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

from screwkit.mechanism.graph import Step
from screwkit.mechanism.joints import CATALOGUE, RIGID
from screwkit.mechanism.model import Joint, Mechanism


@dataclass(frozen=True)
class Hold:
    """One place where velocities are compared.

    Attributes:
        joint: Name of the joint or contact.
        selective: Whether it holds by its own selector; otherwise it is rigid, behind
            its own freedoms if it has any.
        on_object: Whether the object is one of the two bodies.
        steps: The joints whose motion moves the other body relative to the base, with
            +1 where a joint is passed from parent to child; of a closure all joints
            around it.
    """

    joint: str
    selective: bool
    on_object: bool
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class Holds:
    """All holds of a mechanism.

    Attributes:
        contacts: On the object, in the order of the file.
        closures: Inside limbs, and inside what hangs on nothing, in the order of the
            file.
        passing: Contacts of the file that stand in a tree, because nothing else carries
            the body behind them; their freedoms are passive joints.
        free: Bodies that nothing connects with base or object.
    """

    contacts: tuple[Hold, ...]
    closures: tuple[Hold, ...]
    passing: tuple[str, ...]
    free: tuple[str, ...]

    @property
    def all(self) -> tuple[Hold, ...]:
        """Contacts, then closures: the order of the rows."""
        return (*self.contacts, *self.closures)


def holds_of(mechanism: Mechanism) -> Holds:
    """How the platform of a mechanism is held."""
    return _Grown(mechanism).holds()


@dataclass
class _Grown:
    """The trees, while they grow."""

    mechanism: Mechanism
    before: dict[str, tuple[str, Step]] = field(default_factory=dict)
    root: dict[str, str] = field(default_factory=dict)
    used: set[str] = field(default_factory=set)

    def holds(self) -> Holds:
        base, platform = self.mechanism.base, self.mechanism.platform
        self.root[base] = base
        if platform == base:
            self.grow([base], without="")
        else:
            # Joints that move carry bodies better than contacts, which only touch.
            self.grow([base], without=platform)
            self.root.setdefault(platform, platform)
            self.grow([platform], without=base)
        free = tuple(x for x in self.mechanism.links if x not in self.root)
        for link in free:  # what hangs on nothing keeps its own loops closed
            if link not in self.root:
                self.root[link] = link
                self.grow([link], without="")
        contacts: list[Hold] = []
        closures: list[Hold] = []
        for joint in self.mechanism.joints:
            if joint.name in self.used:
                continue
            hold = self.hold(joint)
            (contacts if hold.on_object else closures).append(hold)
        passing = tuple(
            joint.name
            for joint in self.mechanism.joints
            if joint.name in self.used and _touches(joint)
        )
        return Holds(tuple(contacts), tuple(closures), passing, free)

    def grow(self, start: Sequence[str], without: str) -> None:
        """Reach bodies from ``start``: through joints first, through contacts last."""
        touching = _touching(self.mechanism.joints)
        waiting = deque(start)
        postponed: deque[tuple[str, Joint]] = deque()
        while waiting or postponed:
            if waiting:
                here = waiting.popleft()
                for joint in touching.get(here, ()):
                    if _touches(joint):
                        postponed.append((here, joint))
                    else:
                        self.reach(here, joint, without, waiting)
            else:
                here, joint = postponed.popleft()
                self.reach(here, joint, without, waiting)

    def reach(self, here: str, joint: Joint, without: str, waiting: deque[str]) -> None:
        there = joint.child if joint.parent == here else joint.parent
        if there == without or there in self.root:
            return
        sign = 1 if joint.parent == here else -1
        self.before[there] = here, (joint.name, sign)
        self.root[there] = self.root[here]
        self.used.add(joint.name)
        waiting.append(there)

    def hold(self, joint: Joint) -> Hold:
        selective = _touches(joint)
        moving = not selective and joint.type not in RIGID
        platform = self.mechanism.platform
        ends = joint.parent, joint.child
        on_object = platform in ends and platform != self.mechanism.base
        if on_object:
            other = ends[0] if ends[1] == platform else ends[1]
            on_object = self.root[other] != platform
        if on_object:
            sign = 1 if joint.parent == other else -1
            own = ((joint.name, sign),) if moving else ()
            return Hold(joint.name, selective, True, (*self.way_to(other), *own))
        out, back = self.way_to(ends[0]), self.way_to(ends[1])
        own = ((joint.name, 1),) if moving else ()
        return Hold(joint.name, selective, False, _around(out, own, back))

    def way_to(self, link: str) -> tuple[Step, ...]:
        """The joints from the root of its tree to a body."""
        steps = []
        while link in self.before:
            link, step = self.before[link]
            steps.append(step)
        return tuple(reversed(steps))


def _touches(joint: Joint) -> bool:
    """Whether it is a contact that leaves freedoms."""
    return CATALOGUE[joint.type].contact and joint.type not in RIGID


def _around(
    out: Sequence[Step], own: Sequence[Step], back: Sequence[Step]
) -> tuple[Step, ...]:
    """Out to one body, over the joint, and back from the other; what is common left."""
    common = 0
    for one, other in zip(out, back, strict=False):
        if one != other:
            break
        common += 1
    turned = ((name, -sign) for name, sign in reversed(back[common:]))
    return (*out[common:], *own, *turned)


def _touching(joints: Iterable[Joint]) -> Mapping[str, Sequence[Joint]]:
    found: dict[str, list[Joint]] = {}
    for joint in joints:
        for link in dict.fromkeys((joint.parent, joint.child)):
            found.setdefault(link, []).append(joint)
    return found
