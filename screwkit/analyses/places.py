"""Where bodies are wanted, from texts or numbers to floats.

References: [MurrayLiSastry1994] §2.2 on rotation vectors.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite

from screwkit.algebra.batch import BatchRing
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.names import meant_or_all
from screwkit.algebra.parse import parse
from screwkit.errors import ExpressionError, UnknownNameError
from screwkit.mechanism.model import Mechanism

Given = float | str
"""A number, or an expression of constants."""


def place_of(mechanism: Mechanism, point: Sequence[Given]) -> tuple[float, ...]:
    """A point in base coordinates; none is none.

    Raises:
        ExpressionError: If there are not two or three numbers, as the space has axes.
    """
    if len(point) == 0:
        return ()
    axes = 2 if mechanism.space == "planar" else 3
    if len(point) != axes:
        raise ExpressionError(f"a point here has {axes} coordinates, not {len(point)}")
    return tuple(_number(value) for value in point)


def turns_of(
    mechanism: Mechanism, turned: Mapping[str, Given | Sequence[Given]]
) -> dict[str, tuple[float, float, float]]:
    """Rotation vectors by link; one number turns about z, in planar files.

    Raises:
        UnknownNameError: If a link is unknown.
        ExpressionError: If there are not one or three numbers, as the space turns.
    """
    found = {}
    for link, turn in turned.items():
        if link not in mechanism.links or link == mechanism.base:
            movable = [name for name in mechanism.links if name != mechanism.base]
            raise UnknownNameError(
                f"no movable link {link!r}{meant_or_all(link, movable)}"
            )
        parts = [turn] if isinstance(turn, str | float | int) else list(turn)
        if len(parts) == 1 and mechanism.space == "planar":
            found[link] = (0.0, 0.0, _number(parts[0]))
        elif len(parts) == 3 and mechanism.space != "planar":
            x, y, z = (_number(part) for part in parts)
            found[link] = (x, y, z)
        else:
            wanted = "an angle" if mechanism.space == "planar" else "a rotation vector"
            raise ExpressionError(
                f"link {link!r} is turned by {wanted}, not by {len(parts)} numbers"
            )
    return found


def _number(value: Given) -> float:
    if isinstance(value, str):
        value = float(evaluate(parse(value, ()), BatchRing({})))
    if not isfinite(value):
        raise ExpressionError(f"{value} is no finite number")
    return float(value)
