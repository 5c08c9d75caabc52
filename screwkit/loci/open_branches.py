"""What a search left open, in words."""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.branches import Branch


def undecided(branches: Sequence[Branch]) -> str:
    """That some pieces are left, in words."""
    count = len(branches)
    noun = "piece" if count == 1 else "pieces"
    least = min(branch.codimension for branch in branches)
    size = f", of codimension {least} or more," if least > 1 else ""
    return f"{count} {noun} of the locus{size} could not be decided within the budget"
