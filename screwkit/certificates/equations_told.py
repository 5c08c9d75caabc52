"""What a certificate says of single equations: solved, met, a multiple, a square.

All polynomials are texts of the expression grammar.

References: docs/decisions/0019-certificates.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeAlias

Angles: TypeAlias = tuple[Mapping[str, int], ...]
"""Basis angles, each an integer combination of declared angles."""


@dataclass(frozen=True)
class Step:
    """An equation solved: the values of some generators by those that are left.

    Attributes:
        kind: ``angle``: P·sin φ + Q·cos φ = 0, one of two opposite values of φ;
            ``pair``: two equations linear in sin φ and cos φ; ``numbers``:
            a·sin φ + b·cos φ + c = 0 in rational numbers; ``symbol``: A·x + B = 0.
        angle: Number of the basis angle φ.
        symbol: Name of x.
        sine, cosine: Times ``over``; of ``angle`` and ``pair``.
        value: Of x, times ``over``.
        over: What the values are divided by; vanishes nowhere.
        numbers: (a, b, c) as texts.
        never: Where ``over`` may vanish though not together with ``value``: the steps
            that solve ``over`` = 0.
    """

    kind: str
    angle: int = -1
    symbol: str = ""
    sine: str = ""
    cosine: str = ""
    value: str = ""
    over: str = "1"
    numbers: tuple[str, ...] = ()
    never: tuple[Step, ...] = ()


@dataclass(frozen=True)
class Multiple:
    """Why an equation of a component holds at a node: it is a multiple of a condition.

    Attributes:
        equation: Number of the equation of the component.
        condition: Number of the unsolved condition on the way to the node.
        times: What the condition is multiplied with.
        over: By number of a solved step: powers of its divisor on the other side.
    """

    equation: int
    condition: int
    times: str
    over: Mapping[str, int]


@dataclass(frozen=True)
class Unsolved:
    """A condition that is met by a root: in a basis angle or in a symbol.

    Attributes:
        equation: Its left side.
        angle: Number of the basis angle, or −1.
        symbol: Name of the symbol, where there is no angle.
        degree: In the symbol, or in sine and cosine of the angle.
        together: Conditions that are linear in some symbols together: this one is met
            by its symbol and these, of first degree, by theirs, all at once.
        beside: A second condition that shares both unknowns; its own is another one.
        across: Degree of this condition in the unknown of the second one, and of the
            second one in the unknown of this.
    """

    equation: str
    angle: int = -1
    symbol: str = ""
    degree: int = 1
    together: tuple[Unsolved, ...] = ()
    beside: Unsolved | None = None
    across: tuple[int, ...] = ()


@dataclass(frozen=True)
class Square:
    """One of the squares whose sum a polynomial is.

    Attributes:
        weight: A number or a polynomial that is positive by the signs of its terms.
        base: Of the square.
    """

    weight: str
    base: str
