"""Random platforms of special geometry, and the same ones written down otherwise.

Limbs of few joints with parallel, concurrent and equal axes, most of them images of one
another, are where motions beyond counting are found.  A copy stands in another rational
frame, at another scale, with joints turned round and in another order: nothing that is
said of its finite motion may differ.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from finite.frames import Frame, Vector
from finite.linkages import ball, hinge, screw_joint, slider, universal

from screwkit.kinematics.network import Network
from screwkit.mechanism.files import mechanism_from_text

AXES = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
SLANTED = ((1, 1, 0), (0, 1, 1), (1, 0, 1), (1, -1, 0), (1, 2, 2), (2, -1, 2))
CHAINS = (
    *("RSR", "RPS", "SS", "RRS", "PRS", "RUU", "UPU", "US", "RRR", "RRRR", "PRRR"),
    *("SPR", "UU", "CRR", "RC", "RRC", "PSS", "PUU", "HRR", "RRRRR", "PPR", "CC"),
    *("PU", "SR", "URS", "SPS", "UPS", "RUR", "PRP", "RRPR", "HP", "CS", "PS", "SSP"),
)
Point = tuple[Fraction, ...]


@dataclass(frozen=True)
class Placed:
    """A joint at the posture."""

    name: str
    kind: str
    parent: str
    child: str
    point: Point
    axes: tuple[Point, ...]
    pitch: Fraction = Fraction(1)

    def text(self) -> str:
        """As a file writes it."""
        ends = self.name, self.parent, self.child
        if self.kind == "R":
            return hinge(*ends, self.point, self.axes[0])
        if self.kind == "P":
            return slider(*ends, self.axes[0])
        if self.kind == "H":
            return screw_joint(*ends, self.point, self.axes[0], self.pitch)
        if self.kind == "U":
            return universal(*ends, self.point, (self.axes[0], self.axes[1]))
        if self.kind == "S":
            return ball(*ends, self.point)
        return hinge(*ends, self.point, self.axes[0]).replace("revolute", "cylindrical")


def random_platform(seed: int) -> tuple[Placed, ...]:
    """Two to four limbs between a base and a platform."""
    source = random.Random(seed)
    count = source.choice((2, 2, 3, 3, 3, 4))
    first = _chain(source)
    chains = [first]
    while len(chains) < count:
        if source.random() < 0.3:
            chains.append(_chain(source))
        else:
            chains.append(_image(source, source.choice(chains)))
    joints = []
    for limb, chain in enumerate(chains):
        bodies = ["base", *(f"l{limb}_{k}" for k in range(1, len(chain))), "platform"]
        joints += [
            replace(j, name=f"j{limb}_{k}", parent=bodies[k], child=bodies[k + 1])
            for k, j in enumerate(chain)
        ]
    return tuple(joints)


def written(joints: Sequence[Placed]) -> Network:
    """Read from a file with these joints."""
    links = dict.fromkeys(x for j in joints for x in (j.parent, j.child))
    text = (
        f"screwkit: 1\nname: drawn\ntitle: Drawn\ngeometry: posture\nbase: base\n"
        f"platform: platform\nlinks: [{', '.join(links)}]\njoints:\n"
    )
    text += "".join(f"  - {{{joint.text()}}}\n" for joint in joints)
    return Network(mechanism_from_text(text, "drawn.yaml"))


def copied(joints: Sequence[Placed], seed: int) -> tuple[Placed, ...]:
    """The same mechanism in another frame, its joints turned round and mixed."""
    source = random.Random(seed)
    x, y, z = (source.randint(-5, 5) for _ in range(3))
    frame = Frame(
        (source.randint(1, 9), x, y, z),
        [Fraction(source.randint(-40, 40), source.randint(1, 7)) for _ in range(3)],
        Fraction(source.randint(1, 9), source.randint(1, 9)),
    )
    found = []
    for joint in source.sample(joints, len(joints)):
        axes = tuple(frame.direction(axis) for axis in joint.axes)
        moved = replace(
            joint,
            point=frame.point(joint.point),
            axes=axes,
            pitch=frame.scale * joint.pitch,
        )
        if source.random() < 0.5:
            moved = replace(
                moved, parent=joint.child, child=joint.parent, axes=axes[::-1]
            )
        found.append(moved)
    return tuple(found)


def _chain(source: random.Random) -> tuple[Placed, ...]:
    kinds = source.choice(CHAINS)
    style = source.choice(("parallel", "concurrent", "upright", "mixed", "mixed"))
    common = source.choice((*AXES, *AXES, *SLANTED))
    centre = _exact([source.randint(-1, 1) for _ in range(3)])
    found = []
    for kind in kinds:
        point = _exact([source.randint(-2, 2) for _ in range(3)])
        if style == "parallel":
            axis = _exact(common)
        elif style == "concurrent" and point != centre:
            axis = tuple(x - y for x, y in zip(point, centre, strict=True))
        elif style == "upright":
            axis = _exact(source.choice(AXES))
        else:
            axis = _exact(source.choice((*AXES, common, common, *SLANTED)))
        other = _exact(source.choice(AXES))
        while not any(_cross(axis, other)):
            other = _exact(source.choice(AXES))
        if source.random() < 0.7:
            other = _cross(axis, other)
        pair = (axis, other) if source.random() < 0.5 else (other, axis)
        axes = {"U": pair, "S": ()}.get(kind, (axis,))
        found.append(Placed("", kind, "", "", point, axes))
    return tuple(found)


def _image(source: random.Random, chain: tuple[Placed, ...]) -> tuple[Placed, ...]:
    """The chain shifted, turned by quarters or mirrored."""
    shift = [source.randint(-2, 2) for _ in range(3)]
    kind = source.choice(("shift", "shift", "quarter", "half", "mirror"))
    k = source.randrange(3)
    i, j = (k + 1) % 3, (k + 2) % 3
    mirrored = kind == "mirror"

    def turned(v: Sequence[Fraction]) -> Point:
        w = list(v)
        if kind == "quarter":
            w[i], w[j] = -v[j], v[i]
        elif kind == "half":
            w[i], w[j] = -v[i], -v[j]
        elif mirrored:
            w[k] = -v[k]
        return tuple(w)

    stays = source.random() < 0.6 and kind != "shift"
    moved = (lambda v: v) if stays else _shifted(shift)
    return tuple(
        replace(
            joint,
            point=moved(turned(joint.point)),
            axes=tuple(turned(axis) for axis in joint.axes),
            pitch=-joint.pitch if mirrored else joint.pitch,
        )
        for joint in chain
    )


def _shifted(by: Sequence[int]) -> Callable[[Point], Point]:
    return lambda v: tuple(x + y for x, y in zip(v, by, strict=True))


def _exact(values: Sequence[int]) -> Point:
    return tuple(Fraction(x) for x in values)


def _cross(a: Vector, b: Vector) -> Vector:
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
