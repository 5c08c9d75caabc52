"""What `sweep` answers: where an index is least and greatest, and where it is lost."""

from __future__ import annotations

from dataclasses import dataclass

from screwkit.results.shown import Shown


@dataclass(frozen=True)
class Extremum:
    """A point of the swept ranges, and the index there.

    Attributes:
        values: Of the varied symbols, in their order.
    """

    value: float
    values: tuple[float, ...]


@dataclass(frozen=True, repr=False)
class Sweep(Shown):
    """The answer.

    Attributes:
        index: What was evaluated.
        vary: The varied symbols.
        shape: Steps along each of them; one number for samples.
        ranges: (start, stop) of each.
        least, greatest: Among the finite values; None where there are none.
        best: The point to which the best one was refined; None where not asked for.
        singular: At how many points the value is infinite.
        undefined: At how many points there is no posture.
        file: Where all values were written; empty where nowhere.
        numbers: All values in the order of the grid, the last symbol fastest, where
            they are few; None stands for infinity and for no value.
    """

    case: str
    title: str
    index: str
    vary: tuple[str, ...]
    shape: tuple[int, ...]
    ranges: tuple[tuple[float, float], ...]
    least: Extremum | None
    greatest: Extremum | None
    best: Extremum | None
    singular: int
    undefined: int
    file: str = ""
    numbers: tuple[float | None, ...] = ()
