"""An equation of a locus solved for one variable."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Solution:
    """An equation solved for one variable.

    Attributes:
        variable: A joint variable, a free symbol or a parameter.
        values: All branches; angles in (−π, π] where that can be decided.
        modulo: The shortest way to write the branches of an angle: ``pi`` when the
            values differ by π, else ``2*pi``; empty for lengths.
    """

    variable: str
    values: tuple[str, ...]
    modulo: str = ""
