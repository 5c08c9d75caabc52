"""The literature that reports may cite, by the keys used throughout the package."""

from __future__ import annotations

import re
from typing import Final

from screwkit.reports.blocks import Citation, Entry, Span, Text, Words

_KNOWN: Final = {
    "Ball1900": "R. S. Ball, A Treatise on the Theory of Screws. Cambridge University "
    "Press, 1900.",
    "BicchiMelchiorri": "A. Bicchi, C. Melchiorri, D. Balluchi, On the mobility and "
    "manipulability of general multiple limb robots. IEEE Transactions on Robotics and "
    "Automation 11(2), 1995.",
    "BicchiPrattichizzo": "A. Bicchi, D. Prattichizzo, Manipulability of cooperating "
    "robots with unactuated joints and closed-chain mechanisms. IEEE Transactions on "
    "Robotics and Automation 16(4), 2000.",
    "ChiacchioEtAl1990": "P. Chiacchio, S. Chiaverini, L. Sciavicco, B. Siciliano, On "
    "the manipulability of dual cooperative robots. 1990; see also Global task space "
    "manipulability ellipsoids for multiple-arm systems. IEEE Transactions on Robotics "
    "and Automation 7(5), 1991.",
    "Gogu2007": "G. Gogu, Structural Synthesis of Parallel Robots, Part 1: "
    "Methodology. Springer, 2007.",
    "Hunt1978": "K. H. Hunt, Kinematic Geometry of Mechanisms. Oxford University "
    "Press, 1978.",
    "KhalilKleinfinger1986": "W. Khalil, J. F. Kleinfinger, A new geometric notation "
    "for open and closed-loop robots. IEEE International Conference on Robotics and "
    "Automation, 1986.",
    "LongCaroKhalil2012": "P. Long, S. Caro, W. Khalil, Kinematic analysis of lower "
    "mobility cooperative arms by screw theory. 9th International Conference on "
    "Informatics in Control, Automation and Robotics, Rome, 2012.",
    "Zlatanov2002": "D. Zlatanov, I. A. Bonev, C. M. Gosselin, Constraint "
    "singularities of parallel mechanisms. IEEE International Conference on Robotics "
    "and Automation, 2002.",
}
_POINTER = re.compile(r"\[?([A-Za-z]\w+)\]?[,:\s]*(.*)", re.DOTALL)


def cited(pointer: str) -> Text:
    """``LongCaroKhalil2012, (16)`` as a citation; an unknown key as plain text."""
    match = _POINTER.fullmatch(pointer.strip())
    if match is None or match[1] not in _KNOWN:
        return (Words(pointer),) if pointer else ()
    place = match[2].strip()
    if place.startswith("("):
        place = f"eq. {place}"
    return (Citation(match[1], place),)


def entries(keys: set[str]) -> tuple[Entry, ...]:
    """The entries of those keys, sorted."""
    return tuple(Entry(key, _KNOWN[key]) for key in sorted(keys & set(_KNOWN)))


def keys_in(spans: Text) -> set[str]:
    """The keys that a text cites."""

    def key(span: Span) -> str:
        return span.key if isinstance(span, Citation) else ""

    return {key(span) for span in spans} - {""}
