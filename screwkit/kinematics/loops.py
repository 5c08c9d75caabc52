"""Loop constraints: the matrix J_c with J_c q̇ = 0, over any ring.

A loop is a closed walk through joints, each with the sign in which it is passed; limbs
between base and platform give one loop fewer than there are limbs.  A loop contributes
six rows, the twist that its joints together give to the body walked back to, and that
twist must vanish.  Rows of a loop may be written in the frame of any link, because
J_c q̇ = 0 is not a matter of frame.

References: [LongCaroKhalil2012] eqs. (4)-(9), (17).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Generic, TypeAlias

import numpy as np

from screwkit.algebra.batch import Array, BatchRing
from screwkit.algebra.evaluation import cosine_sine, evaluate
from screwkit.algebra.names import did_you_mean
from screwkit.algebra.ring import Ring, S
from screwkit.conventions import SCREW_DIMENSION
from screwkit.errors import ExpressionError, UndecidedError, UnknownNameError
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.placement import GRASPS, MOVING, joint_twists
from screwkit.mechanism.model import Mechanism

Step: TypeAlias = tuple[str, int]
"""A joint and +1 where it is passed from parent to child, −1 where backwards."""

LimbPath: TypeAlias = Sequence[str | Step]
"""The joints of a serial limb from base to platform; a bare name is (name, +1).

Rigid joints may be listed, as ``path`` of `mechanism.graph.limbs` does; they are passed
over.
"""

Loop: TypeAlias = tuple[Step, ...]
"""A closed walk: its joints in order, with the sign in which each is passed."""

Posture: TypeAlias = Mapping[str, Array | float]
"""A value, or an array over the batch, by variable name; radians and file lengths."""


@dataclass(frozen=True)
class LoopMatrix(Generic[S]):
    """The loop constraint matrix J_c, labelled.

    Attributes:
        rows: (loop, component) of each row; components 0…5 are (ω; v).
        columns: (joint, freedom) of each column.
        entries: The matrix, row by row; ring zeros for joints not in a loop.
        loops: The closed walks, in the order of the row blocks.
        frames: The link in whose frame and about whose origin a loop is written.
    """

    rows: tuple[tuple[int, int], ...]
    columns: tuple[tuple[str, int], ...]
    entries: tuple[tuple[S, ...], ...]
    loops: tuple[Loop, ...]
    frames: tuple[str, ...]

    @property
    def joints(self) -> tuple[str, ...]:
        """The joint of each column."""
        return tuple(joint for joint, _ in self.columns)

    def column(self, loop: int, joint: str) -> tuple[S, ...]:
        """The six entries (ω; v) of a joint in the rows of one loop, sign included."""
        index = self.joints.index(joint)
        start = loop * SCREW_DIMENSION
        block = self.entries[start : start + SCREW_DIMENSION]
        return tuple(row[index] for row in block)


def limb_paths(
    mechanism: Mechanism, limbs: Sequence[LimbPath]
) -> tuple[tuple[Step, ...], ...]:
    """Limbs as their moving joints with signs, checked against the mechanism.

    Raises:
        UnknownNameError: If a name is no joint of the mechanism.
        UndecidedError: If a joint is neither revolute nor prismatic nor rigid.
        ValueError: If there are fewer than two limbs, a limb has no moving joint, a
            joint occurs twice, or a sign is not ±1.
    """
    known = {joint.name: joint for joint in mechanism.joints}
    paths: list[tuple[Step, ...]] = []
    for limb in limbs:
        steps = [(step, 1) if isinstance(step, str) else step for step in limb]
        for name, sign in steps:
            if name not in known:
                raise UnknownNameError(unknown_joint(name, tuple(known)))
            if known[name].type not in (*MOVING, *GRASPS):
                raise UndecidedError(
                    f"joint {name!r} is {known[name].type}; the numeric loop model "
                    f"takes revolute, prismatic and rigid joints"
                )
            if sign not in {1, -1}:
                raise ValueError("the sign of a joint is 1 or -1")
        paths.append(tuple(step for step in steps if known[step[0]].type in MOVING))
    names = [name for path in paths for name, _ in path]
    if len(paths) < 2 or not all(paths):
        raise ValueError("a loop needs two limbs or more, each with a moving joint")
    if len(set(names)) < len(names):
        raise ValueError("a joint belongs to one limb, once")
    return tuple(paths)


def unknown_joint(name: str, known: Sequence[str]) -> str:
    """What to say of a joint that is not there."""
    near = get_close_matches(name, known, n=1)
    hint = f"did you mean {near[0]!r}? " if near else ""
    return f"no joint {name!r} ({hint}joints: {', '.join(known)})"


def end_link(mechanism: Mechanism, path: Sequence[Step]) -> str:
    """The link a limb's last joint leads to: where it holds the platform."""
    name, sign = path[-1]
    joint = mechanism.joint(name)
    return joint.child if sign > 0 else joint.parent


def loops_of_limbs(
    paths: Sequence[Sequence[Step]], reference: int = 0
) -> tuple[Loop, ...]:
    """Loops out along the reference limb and back along each other limb."""
    out = tuple(paths[reference])
    return tuple(
        out + tuple((name, -sign) for name, sign in reversed(path))
        for index, path in enumerate(paths)
        if index != reference
    )


def loop_matrix(
    mechanism: Mechanism,
    ring: Ring[S],
    limbs: Sequence[LimbPath],
    *,
    reference: int = 0,
    frames: Sequence[str] | None = None,
) -> LoopMatrix[S]:
    """J_c of limbs between base and platform, [T1 −T2 0; T1 0 −T3].

    Args:
        mechanism: An ``mdh`` mechanism.
        ring: Where the entries live.
        limbs: See `LimbPath`.
        reference: The limb every other one is compared with.
        frames: A link for each loop; the base where absent.

    Returns:
        6·(limbs − 1) rows; columns limb by limb in the order of ``limbs``.

    Raises:
        UnknownNameError: If a name is no joint.
        UndecidedError: See `limb_paths` and `placement.joint_twists`.

    References: [LongCaroKhalil2012] eqs. (7), (9).
    """
    paths = limb_paths(mechanism, limbs)
    loops = loops_of_limbs(paths, reference)
    order = [name for path in paths for name, _ in path]
    return matrix_of_loops(mechanism, ring, loops, order, frames)


def matrix_of_loops(
    mechanism: Mechanism,
    ring: Ring[S],
    loops: Sequence[Loop],
    joints: Sequence[str],
    frames: Sequence[str] | None = None,
) -> LoopMatrix[S]:
    """J_c of any closed walks, whose joints give the columns in the order ``joints``.

    Raises:
        UndecidedError: If the table does not connect a joint with a frame.
    """
    frames = tuple(frames or (mechanism.base,) * len(loops))
    if len(frames) != len(loops):
        raise ValueError("one frame for each loop")
    twists = {frame: joint_twists(mechanism, ring, frame) for frame in set(frames)}
    entries: list[tuple[S, ...]] = []
    rows: list[tuple[int, int]] = []
    for number, (loop, frame) in enumerate(zip(loops, frames, strict=True)):
        signs = dict(loop)
        columns: list[tuple[S, ...]] = []
        for name in joints:
            if name not in signs:
                columns.append((ring.zero,) * SCREW_DIMENSION)
            elif name not in twists[frame]:
                raise UndecidedError(
                    f"the table does not connect joint {name!r} with {frame!r}"
                )
            else:
                columns.append(_signed(twists[frame][name], signs[name]))
        for component in range(SCREW_DIMENSION):
            rows.append((number, component))
            entries.append(tuple(column[component] for column in columns))
    return LoopMatrix(
        rows=tuple(rows),
        columns=tuple((name, 0) for name in joints),
        entries=tuple(entries),
        loops=tuple(loops),
        frames=frames,
    )


def _signed(twist: JointTwist[S], sign: int) -> tuple[S, ...]:
    return twist.coordinates if sign > 0 else tuple(-x for x in twist.coordinates)


def stacked(entries: Sequence[Sequence[Array]]) -> Array:
    """A matrix of arrays as one array of shape batch + (rows, columns)."""
    shapes = {e.shape for row in entries for e in row if isinstance(e, np.ndarray)}
    batch = np.broadcast_shapes(*shapes)
    if not batch:
        return np.array([[float(entry) for entry in row] for row in entries])
    matrix = np.empty((*batch, len(entries), len(entries[0])))
    for i, row in enumerate(entries):
        for j, entry in enumerate(row):
            matrix[..., i, j] = entry
    return matrix


def ring_at(mechanism: Mechanism, posture: Posture) -> BatchRing:
    """Arrays for every symbol: the values of the file, overruled by ``posture``.

    Raises:
        ExpressionError: If a parameter's value is neither a number nor an angle.
        UnknownNameError: If it needs a symbol that has no value, or ``posture`` names
            what is no symbol.
    """
    names = [p.name for p in mechanism.parameters] + [*mechanism.joint_variables]
    for name in posture:
        if name not in names:
            hint = did_you_mean(name, names)
            raise UnknownNameError(f"no symbol {name!r} in {mechanism.name}{hint}")
    values: dict[str, Array | float] = dict(posture)
    for parameter in mechanism.parameters:
        if parameter.value is None or parameter.name in posture:
            continue
        known = BatchRing(values)
        try:
            values[parameter.name] = evaluate(parameter.value, known)
        except ExpressionError:  # an inverse function: the parameter is an angle
            cosine, sine = cosine_sine(parameter.value, known)
            values[parameter.name] = np.arctan2(sine, cosine)
    return BatchRing(values)
