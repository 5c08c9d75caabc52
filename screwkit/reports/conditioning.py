"""How schemes are ranked, in numbers and in words: index, length, postures."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi

from screwkit.algebra.names import counted
from screwkit.reports.blocks import Text, Words, joined, math, words
from screwkit.reports.decimals import decimal
from screwkit.results.schemes import Ranking, SampledRange
from screwkit.results.undecided import Undecided


def conditioning_texts(ranking: Ranking) -> Mapping[tuple[str, ...], tuple[Text, Text]]:
    """Median and worst value of each scheme."""
    return {
        one.actuated: (words(decimal(one.median, 3)), words(decimal(one.worst, 3)))
        for one in ranking.schemes
    }


def ranking_remarks(ranking: Ranking | Undecided | None) -> list[Text]:
    """What the numbers are: the index, the length in it, and the postures."""
    if ranking is None:
        return []
    if isinstance(ranking, Undecided):
        return [words(f"not ranked: {ranking.reason}")]
    units = f" {ranking.units}" if ranking.units else ""
    source = (
        "as given"
        if ranking.length_given
        else "the root mean square distance of the turning axes from the reference "
        "point"
    )
    return [
        words(
            "ranked by the least singular value over the largest of the map from "
            "the platform's twists (ω; v/L) to the actuated rates, slides over L: "
            "1 where all directions are driven equally, 0 where the scheme fails or "
            "the platform loses a freedom"
        ),
        words(f"L = {decimal(ranking.length, 4)}{units}, {source}"),
        _postures(ranking),
    ]


def _postures(ranking: Ranking) -> Text:
    """Which postures the numbers are taken over."""
    if not ranking.ranges:
        return words("at the one posture of the file")
    circle = [one.symbol for one in ranking.ranges if _whole_circle(one)]
    parts: list[Text] = []
    if circle:
        names = joined([math(name) for name in circle])
        parts.append((*names, Words(" from the whole circle")))
    for one in ranking.ranges:
        if not _whole_circle(one):
            ends = f" from {decimal(one.start, 4)} to {decimal(one.stop, 4)}"
            parts.append((*math(one.symbol), Words(ends)))
    head = f"median and worst over {counted(ranking.postures, 'closed posture')}"
    if ranking.undefined:
        head += f" ({ranking.undefined} more that were drawn do not exist)"
    tail = f"; random numbers of seed {ranking.seed}"
    return (Words(f"{head}: "), *joined(parts), Words(tail))


def _whole_circle(one: SampledRange) -> bool:
    return one.angle and (one.start, one.stop) == (-pi, pi)
