"""What a search left open, in words."""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.branches import Branch
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

_NAMED = 3  # places that are written
_LONGEST = 160  # characters of one of them


def undecided(branches: Sequence[Branch]) -> str:
    """That some pieces are left, in words."""
    count = len(branches)
    noun = "piece" if count == 1 else "pieces"
    least = min(branch.codimension for branch in branches)
    size = f", of codimension {least} or more," if least > 1 else ""
    return f"{count} {noun} of the locus{size} could not be decided within the budget"


def lying_where(ring: TrigonometricRing, places: Sequence[Sequence[Polynomial]]) -> str:
    """Where pieces that are left lie, in words; empty where that says nothing.

    Args:
        ring: Of the equations.
        places: Equations that hold on some of the pieces, place by place; none where no
            limb is singular.
    """
    written = [
        " and ".join(f"{_text(ring, e)} = 0" for e in equations)
        if equations
        else "no limb is singular"
        for equations in places
    ]
    short = [one for one in written if len(one) <= _LONGEST][:_NAMED]
    if not short:
        return ""
    more = len(written) - len(short)
    others = f", or where {more} other sets of conditions hold" if more else ""
    if more == 1:
        others = ", or where one other set of conditions holds"
    return f"they lie where {', or where '.join(short)}{others}"


def _text(ring: TrigonometricRing, equation: Polynomial) -> str:
    """Up to its sign."""
    found = text(ring, equation)
    return text(ring, -equation) if found.startswith("-") else found
