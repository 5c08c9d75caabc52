"""Sentences about redundant constraints and remaining freedoms, in the file's names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from screwkit.algebra.names import limb_called
from screwkit.analyses.screw_texts import ScrewTexts

MANY = 8
"""Names up to which a sentence lists them all."""

_WRENCHES = {"free": "couple", "line": "force", "screw": "wrench"}


def wrench_words(text: ScrewTexts) -> str:
    """A wrench with what is known of its place.

    >>> wrench_words(ScrewTexts("line", ("0", "0", "1"), ("1", "2", "0"), "0"))
    'a force along [0, 0, 1] through [1, 2, 0]'
    >>> wrench_words(ScrewTexts("free"))
    'a couple'
    >>> wrench_words(ScrewTexts("line", pitch="0", through=("S1", "S2")))
    'a force along the line through S1 and S2'
    """
    words = f"a {_WRENCHES[text.kind]}"
    if text.direction:
        relation = "about" if text.kind == "free" else "along"
        words += f" {relation} {bracketed(text.direction)}"
        words += _through(text)
    elif len(text.through) > 1:
        words += f" along the line through {listed(text.through)}"
    else:
        words += _through(text)
    if text.kind == "screw" and text.pitch:
        words += f" of pitch {text.pitch}"
    return words


def added_words(joint: str, kind: str, axis: Sequence[str]) -> str:
    """A freedom that a joint might be given.

    >>> added_words("B", "rotation", ("0", "0", "1"))
    'a rotation about [0, 0, 1] at joint B'
    """
    relation = "about" if kind == "rotation" else "along"
    place = f" {relation} {bracketed(axis)}" if axis else ""
    return f"a {kind}{place} at joint {joint}"


def loop_words(text: ScrewTexts, joints: Sequence[str], limb: str = "") -> str:
    """What goes around one loop.

    >>> loop_words(ScrewTexts("free", ("1", "0", "0")), "ABCD")
    'a couple about [1, 0, 0] carried around the loop A B C D'
    """
    inside = f" inside {limb_called(limb)}" if limb else ""
    loop = " ".join(joints)
    return f"{wrench_words(text)} carried around the loop {loop}{inside}"


def limbs_words(exerted: Mapping[str, ScrewTexts]) -> str:
    """What several limbs exert on the platform, dependent on each other.

    >>> couple = ScrewTexts("free", ("0", "0", "1"))
    >>> limbs_words({"left": couple, "right": couple})
    'limbs left and right both carry a couple about [0, 0, 1]'
    >>> limbs_words({"a": couple, "b": couple, "c": ScrewTexts("free")})
    'the couples of limbs a, b and c depend on each other'
    """
    texts = list(exerted.values())
    if all(name.lower().startswith("limb") for name in exerted):
        names = listed([limb_called(name) for name in exerted])
    else:
        names = f"limbs {listed(tuple(exerted))}"
    if len(texts) == 2 and texts[0] == texts[1]:
        return f"{names} both carry {wrench_words(texts[0])}"
    what = plural_words([text.kind for text in texts])
    directions = {text.direction for text in texts}
    place = ""
    if len(directions) == 1 and () not in directions:
        relation = "about" if what == "couples" else "along"
        place = f" {relation} {bracketed(directions.pop())}"
    return f"the {what} of {names}{place} depend on each other"


def joints_words(kinds: Sequence[str], joints: Sequence[str], limb: str = "") -> str:
    """What joints transmit that belong to no two limbs.

    >>> joints_words(["free", "line"], ["A", "B", "C"], "left")
    'the wrenches at joints A, B and C inside limb left depend on each other'
    """
    inside = f" inside {limb_called(limb)}" if limb else ""
    place = f"joints {listed(joints)}"
    if len(joints) > MANY:
        place = f"{len(joints)} joints"
    return f"the {plural_words(kinds)} at {place}{inside} depend on each other"


def plural_words(kinds: Sequence[str]) -> str:
    """Couples, forces, or wrenches where there are several kinds."""
    return f"{_WRENCHES[kinds[0]]}s" if len(set(kinds)) == 1 else "wrenches"


def platform_words(text: ScrewTexts, joints: Sequence[str], of: int) -> str:
    """A freedom of the platform.

    Args:
        text: Its twist.
        joints: Those that move with it.
        of: How many joints there are.

    >>> platform_words(ScrewTexts("free", ("0", "0", "1")), "AB", 2)
    'the platform translates along [0, 0, 1]; all joints move'
    """
    return f"the platform {screw_moves(text)}; {_moving_joints(joints, of)}"


def idle_words(
    text: ScrewTexts | None,
    joints: Sequence[str],
    bodies: Sequence[str],
    through: Sequence[str],
    rests: str = ", the platform rests",
    *,
    leg: bool = True,
) -> str:
    """A freedom at which the platform rests.

    Args:
        text: The twist of the bodies, if they move as one.
        joints: Those that move.
        bodies: Those that move.
        through: Joints whose points lie apart on the axis of a rotation.
        rests: What to add where it does not go without saying.
        leg: Whether the bodies lie between two others, not beside a single one.

    >>> spin = ScrewTexts("line", ("0", "0", "1"), ("0", "0", "0"), "0")
    >>> idle_words(spin, ["S1", "S2"], ["rod"], ["S1", "S2"])
    'leg spin: S1 and S2 turn together, rod spins about its own axis'
    >>> idle_words(spin, ["high", "low"], ["door"], ["high", "low"], leg=False)
    'high and low turn together: door rotates about the line through high and low'
    >>> idle_words(None, ["A", "B", "C"], ["crank", "rod"], [])
    'A, B and C move together: crank and rod move, the platform rests'
    """
    one = len(bodies) == 1
    moving = listed(bodies)
    together = "turns" if len(joints) == 1 else "turn together"
    if not bodies:
        return f"the freedoms of {listed(joints)} cancel: no body moves"
    if text is not None and text.kind == "line" and len(through) > 1:
        line = f"the line through {listed(through)}"
        if not leg:
            rotates = "rotates" if one else "rotate"
            return f"{listed(joints)} {together}: {moving} {rotates} about {line}"
        axis = "its own axis" if one else line
        spins = "spins" if one else "spin"
        return f"leg spin: {listed(joints)} {together}, {moving} {spins} about {axis}"
    how = "" if len(joints) == 1 else " together"
    moves = "moves" if len(joints) == 1 else "move"
    if text is None or not text.direction:
        bodies_move = "moves" if one else "move"
        return f"{listed(joints)} {moves}{how}: {moving} {bodies_move}{rests}"
    does = screw_moves(text) if one else screw_moves(text).replace("s ", " ", 1)
    return f"{listed(joints)} {moves}{how}: {moving} {does}"


def listed(names: Sequence[str]) -> str:
    """Names as a sentence has them.

    >>> listed("A"), listed("AB"), listed("ABC")
    ('A', 'A and B', 'A, B and C')
    """
    *before, last = names
    return f"{', '.join(before)} and {last}" if before else last


def bracketed(texts: Sequence[str]) -> str:
    """Coordinates in brackets."""
    return f"[{', '.join(texts)}]"


def screw_moves(text: ScrewTexts) -> str:
    """What a body with that twist does: ``translates along [0, 0, 1]``."""
    along = f" along {bracketed(text.direction)}" if text.direction else ""
    if text.kind == "free":
        return f"translates{along}"
    does = "rotates" if text.kind == "line" else "screws"
    pitch = f" with pitch {text.pitch}" if text.kind == "screw" and text.pitch else ""
    if not text.direction and len(text.through) > 1:
        return f"{does} about the line through {listed(text.through)}{pitch}"
    through = _through(text)
    if not through + along:
        return f"{does}{pitch}"
    article = "the" if through and along else "a"
    return f"{does} about {article} line{through}{along}{pitch}"


def _through(text: ScrewTexts) -> str:
    """A point of the axis: its coordinates, or else a joint that is there."""
    if text.point:
        return f" through {bracketed(text.point)}"
    return f" through joint {text.through[0]}" if text.through else ""


def _moving_joints(joints: Sequence[str], of: int) -> str:
    if len(joints) == of:
        return "all joints move" if of > 1 else f"joint {joints[0]} moves"
    if len(joints) == 1:
        return f"joint {joints[0]} moves"
    if len(joints) <= MANY:
        return f"joints {listed(joints)} move"
    return f"{len(joints)} of {of} joints move"
