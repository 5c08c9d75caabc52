"""Sentences about the blocks of the partition, in the file's names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Final

from screwkit.analyses.naming_words import MANY, listed, screw_moves
from screwkit.analyses.rounded_screws import rounded
from screwkit.analyses.screw_texts import ScrewTexts

_MEANING: Final[Mapping[str, str]] = {
    "a_r": "actuated joints move alone, everything else at rest",
    "p_r": "passive joints move alone: idle freedoms",
    "o_i": "the platform moves although all joints are locked",
    "po_i": "the platform moves with passive joints although the actuators are locked",
    "ap_c": "actuated and passive joints move together, the platform at rest",
    "ao_c": "actuated joints move the platform, passive joints at rest",
    "apo_c": "actuated joints move the platform, passive joints follow",
}


def meaning(block: str) -> str:
    """What a block of the partition is, in a sentence.

    >>> meaning("o_i")
    'the platform moves although all joints are locked'
    """
    return _MEANING[block]


def motion_words(
    block: str,
    screw: ScrewTexts | None,
    actuated: Sequence[str],
    passive: Sequence[str],
) -> str:
    """One vector of a block.

    Args:
        block: Its name.
        screw: The object's twist; None where it rests.
        actuated: Actuated freedoms that move.
        passive: Passive ones that move.

    >>> up = ScrewTexts("free", ("0", "0", "1"))
    >>> motion_words("apo_c", up, ["1", "5"], ["2"])
    'the platform translates along [0, 0, 1]; 1 and 5 drive it, 2 follows'
    >>> motion_words("ao_c", up, ["1"], [])
    'the platform translates along [0, 0, 1]; 1 drives it'
    >>> motion_words("p_r", None, [], ["S1", "S2"])
    'S1 and S2 move together'
    >>> motion_words("po_i", up, [], ["2"])
    'the platform translates along [0, 0, 1]; 2 moves with it'
    >>> far = ScrewTexts("free", ("12345", "-23456", "0"))
    >>> motion_words("o_i", far, [], [])
    'the platform translates along [0.5263, -1, 0] (rounded)'
    >>> spin = ScrewTexts("line", ("1", "0", "0"), ("0", "1", "0"))
    >>> motion_words("o_i", spin, [], [])
    'the platform rotates about the line through [0, 1, 0] along [1, 0, 0]'
    """
    joints = [*actuated, *passive]
    if screw is None:
        alone = "moves" if len(joints) == 1 else "move together"
        return f"{_names(joints)} {alone}"
    short = rounded(screw)
    said = "" if short == screw else " (rounded)"
    parts = [f"the platform {screw_moves(short)}{said}"]
    if actuated:
        following = f", {_names(passive)} {_verb(passive, 'follow')}" if passive else ""
        parts.append(f"{_names(actuated)} {_verb(actuated, 'drive')} it{following}")
    elif passive:
        parts.append(f"{_names(passive)} {_verb(passive, 'move')} with it")
    return "; ".join(parts)


def _verb(names: Sequence[str], verb: str) -> str:
    return f"{verb}s" if len(names) == 1 else verb


def _names(names: Sequence[str]) -> str:
    return listed(names) if len(names) <= MANY else f"{len(names)} joints"
