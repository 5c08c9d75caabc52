"""Sentences about a system, with its own lines, planes and pitches filled in.

What is not known exactly is left general: *an axis* instead of *the axis through …*.
How many screws of pitch 0 a general system has depends on signs, and is said only where
exact numbers prove them.

References: [Hunt1978], ch. 12.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from screwkit.algebra.algebraic_numbers import AlgebraicNumber
from screwkit.systems.screw_structure import Residues


@dataclass(frozen=True)
class Element:
    """A direction, point or pitch that a system singles out.

    Attributes:
        name: ``direction``, ``normal``, ``second`` (each up to a factor); ``point``,
            ``foot`` (the point of a plane nearest to the origin); ``pitch``,
            ``second_pitch``, ``pitches`` (the product of the principal ones).
        residues: Modulo the first prime and the second.
        numbers: The same exactly; None where no short numbers have these residues.
    """

    name: str
    residues: tuple[Residues, Residues]
    numbers: tuple[AlgebraicNumber, ...] | None

    @property
    def texts(self) -> tuple[str, ...] | None:
        """The numbers in the grammar."""
        if self.numbers is None:
            return None
        return tuple(number.text for number in self.numbers)

    @property
    def sign(self) -> int | None:
        """Of the first number; None where it is not known."""
        if not any(map(any, self.residues)):
            return 0
        return self.numbers[0].sign if self.numbers else None


def sentence_of(
    name: str,
    pattern: str,
    elements: Sequence[Element],
    vocabulary: Mapping[str, str],
) -> str:
    """The name, unless the pattern begins with it, and what is known filled in."""
    phrases = {**vocabulary, **_phrases(elements), **_realities(elements, vocabulary)}
    sentence = pattern.format(**phrases)
    return sentence if sentence.startswith(name) else f"{name}: {sentence}"


def _phrases(elements: Sequence[Element]) -> Mapping[str, str]:
    """Lines, planes and pitches in words, by the names that the patterns use."""
    known = {e.name: e.texts for e in elements if e.texts is not None}

    def vector(name: str) -> str:
        return f"[{', '.join(known[name])}]" if name in known else ""

    def line(noun: str, point: str, direction: str) -> str:
        through = f" through {vector(point)}" if point in known else ""
        along = f" along {vector(direction)}" if direction in known else ""
        article = "the" if through and along else _article(noun)
        return f"{article} {noun}{through}{along}"

    def along(name: str) -> str:
        return f"the direction {vector(name)}" if name in known else "one direction"

    def across(name: str) -> str:
        return f"normal to {vector(name) or 'one direction'}"

    def advance(name: str) -> str:
        return f"of pitch {known[name][0]}" if name in known else "of one pitch"

    flat = f"the plane {across('normal')}" if "normal" in known else "one plane"
    plane = flat.replace("the plane", "one plane")
    if "foot" in known:
        plane = flat.replace("the plane", f"the plane through {vector('foot')}")
    return {
        "axis": line("axis", "point", "direction"),
        "central": line("line", "point", "normal"),
        "direction": along("direction"),
        "normal": along("normal"),
        "second": along("second"),
        "across_normal": across("normal"),
        "across_second": across("second"),
        "point": f"the point {vector('point')}" if "point" in known else "one point",
        "flat": flat,
        "plane": plane,
        "pitch": advance("pitch"),
        "second_pitch": advance("second_pitch"),
    }


def _realities(
    elements: Sequence[Element], vocabulary: Mapping[str, str]
) -> Mapping[str, str]:
    """Which screws of pitch 0 a general system has, where the signs are known."""
    signs = {e.name: e.sign for e in elements}
    product = signs.get("pitches")
    if product is None:
        return dict.fromkeys(
            ("real", "real_directions", "held_real", "real_of_three"), ""
        )
    one, many = vocabulary["one"], vocabulary["many"]
    held_one, held_many = vocabulary["held_one"], vocabulary["held_many"]
    no = f"; no {many} are among them"
    # each by the sign of the product: 0, 1, and last −1
    real = f"; {one} is among them", no, f"; two {many} on skew axes are among them"
    directions = (
        f"; {many} of one direction are among them",
        no,
        f"; {many} of two directions are among them",
    )
    held = held_one, f"no {held_many}", f"two {held_many} on skew axes"
    return {
        "real": real[product],
        "real_directions": directions[product],
        "held_real": f"; the reciprocal system holds {held[product]}",
        "real_of_three": _of_three(signs, one, many),
    }


def _of_three(signs: Mapping[str, int | None], one: str, many: str) -> str:
    """The same for three principal pitches, by their symmetric functions."""
    product, pairs, total = (signs.get(n) for n in ("pitches", "pairs", "sum"))
    if product is None or pairs is None or total is None:
        return ""
    if product and not (pairs > 0 and product == total):
        return f"; {many} on the lines of a regulus are among them"
    if product:
        return f"; no {many} are among them"
    if pairs > 0:
        return f"; {one} is among them"
    return f"; two flat pencils of {many} are among them"


def _article(noun: str) -> str:
    return "an" if noun[0] in "aeiou" else "a"
