"""The wrenches that hold a locked platform as six lines, and their superbracket."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal


@dataclass(frozen=True)
class BracketPoint:
    """A point of the lines.

    Attributes:
        letter: What it is called in brackets.
        name: What it is: a point of the file, the centre of a joint, a direction.
        ideal: Whether it is a direction, a point at infinity.
    """

    letter: str
    name: str
    ideal: bool


@dataclass(frozen=True)
class BracketFactor:
    """A factor of the superbracket, as an expression of Grassmann–Cayley algebra.

    Attributes:
        expression: ``[abcd]``: four points in one plane; ``abc ∧ def ∧ gh``: two planes
            and a line meet in one point; ``abc ∧ def ∧ ghi ∧ jkl``: four planes do.
        words: The same as a sentence.
        holds: ``never``: it vanishes nowhere; ``exactly``: exactly on the components;
            ``wider``: on all of them and where another factor of it vanishes, such as
            where lines of one limb coincide; ``there``: on all of them, it was not
            decided whether elsewhere; ``elsewhere``: on none of the components.
        components: Numbers, from 0, of the actuation components on which it vanishes.
    """

    expression: str
    words: str
    holds: Literal["never", "exactly", "wider", "there", "elsewhere"]
    components: tuple[int, ...]


@dataclass(frozen=True)
class Superbracket:
    """Six lines and the condition that they are dependent.

    Attributes:
        points: Of the lines.
        lines: Pairs of letters, ``ab``, limb by limb.
        monomials: Bracket monomials, of 24, that do not vanish for every posture.
        factors: Their sum as a product; empty where no simple form was found.
        reason: Why there is no product; empty where there is one.
    """

    points: tuple[BracketPoint, ...]
    lines: tuple[str, ...]
    monomials: tuple[str, ...]
    factors: tuple[BracketFactor, ...]
    reason: str = ""
