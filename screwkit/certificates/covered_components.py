"""Components with trees to all of their sheets, where these are found and hold."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import TypeAlias

from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.checking import checked
from screwkit.certificates.conditions import Problem
from screwkit.certificates.covers import cover_of
from screwkit.certificates.records import Locus, Part
from screwkit.certificates.sheet_trials import SheetTrials
from screwkit.certificates.texts import RefusedError
from screwkit.mechanism.model import Mechanism

_Read: TypeAlias = Callable[[Sequence[str]], tuple[Polynomial, ...]]


def with_covers(
    mechanism: Mechanism, part: Part, problem: Problem, read: _Read
) -> Part:
    """A part with trees for components of which one equation does not tell enough.

    Args:
        mechanism: As read.
        part: What is claimed.
        problem: Of the part, without components.
        read: Equations as polynomials.
    """
    count = len(part.components)
    found: list[Locus] = []
    for locus in (*part.components, *part.idle):
        # a tree may refer to components that stand before
        known = found[:count]
        own = locus
        if len(locus.equations) > 1 or part.closed:
            own = _with_cover(mechanism, part, problem, read, locus, known)
        found.append(own)
    return replace(part, components=tuple(found[:count]), idle=tuple(found[count:]))


def _with_cover(
    mechanism: Mechanism,
    part: Part,
    problem: Problem,
    read: _Read,
    locus: Locus,
    known: Sequence[Locus],
) -> Locus:
    before = tuple(read(own.equations) for own in known)
    alone = replace(part, components=(*known, locus), idle=(), proof=None)
    with suppress(RefusedError):
        trials = SheetTrials(mechanism, alone, locus)
        there = replace(problem, components=before)
        cover = cover_of(there, read(locus.equations), trials)
        if cover is not None:
            found = replace(locus, cover=cover)
            checked(mechanism, replace(alone, components=(*known, found)), "written")
            return found
    return locus
