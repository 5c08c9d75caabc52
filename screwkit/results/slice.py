"""A slice of a singular locus: two symbols vary, all others have their values."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SlicedComponent:
    """A component of the singular loci of the slice.

    Attributes:
        parts: Whose locus it belongs to: ``limb right``, ``constraint``, ``actuation``
            or ``idle``.
        equations: Of the component, in the two symbols.
        geometry: What happens there in words; empty where no sentence was found.
        segments: Of which its curve consists in the picture.
        note: Why there is no curve; empty where there is one.
    """

    parts: tuple[str, ...]
    equations: tuple[str, ...]
    geometry: str
    segments: int
    note: str = ""


@dataclass(frozen=True)
class SingularSlice:
    """What was drawn.

    Attributes:
        symbols: Along and across.
        ranges: (from, to) of each.
        shape: Values of each on the grid.
        units: Of each; empty where it has none, or none is known.
        fixed: The other symbols at their values, ``name = text`` each.
        remark: What holds in the whole slice, or is open; else empty.
        file: Where the picture was written; empty where nowhere.
    """

    symbols: tuple[str, str]
    ranges: tuple[tuple[float, float], tuple[float, float]]
    shape: tuple[int, int]
    units: tuple[str, str]
    fixed: tuple[str, ...]
    components: tuple[SlicedComponent, ...]
    remark: str = ""
    file: str = ""
