"""Singular conditions numbered through, each written as shortly as it can be.

An equation that can be solved is shown solved; one that is a whole numbered condition
already is shown by its number.  Terminal and article number alike.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

from screwkit.algebra.names import counted
from screwkit.reports.blocks import (
    Condition,
    Math,
    Reference,
    Text,
    Words,
    joined,
    math,
    prose,
    words,
)
from screwkit.reports.phrases import platform_called
from screwkit.results.singularities import Component, Singularities
from screwkit.results.solution import Solution

_LETTERS = re.compile(r"[A-Za-z_]\w*")
_SHORT: Final = 36
_BEARABLE: Final = 90
_NOTHING: Final = 1e-9  # of a posture that Newton's steps led to


@dataclass(frozen=True, slots=True)
class Numbered:
    """A component with its number in the whole answer, from 1."""

    number: int
    component: Component

    @property
    def label(self) -> str:
        """What cross-references point to."""
        return f"condition:{self.number}"

    @property
    def reference(self) -> Reference:
        """A pointer to this condition."""
        return Reference(self.label, str(self.number))


@dataclass(frozen=True)
class Numbering:
    """All numbered conditions, grouped as the answer is.

    Attributes:
        single: The limbs' conditions of one equation, by that equation: what later
            conditions refer to by number.
        platform: What the platform is called.
    """

    limbs: tuple[tuple[Numbered, ...], ...]
    constraint: tuple[Numbered, ...]
    actuation: tuple[Numbered, ...]
    single: Mapping[str, Numbered]
    platform: str = "platform"


def numbered(answer: Singularities) -> Numbering:
    """Number the components: limbs, then constraint, then actuation.

    Within a list the numbers follow the codimension, so that what is met first in
    practice comes first; the entries keep the order of the components.
    """
    start = 1
    single: dict[str, Numbered] = {}

    def take(components: Sequence[Component]) -> tuple[Numbered, ...]:
        nonlocal start
        order = sorted(range(len(components)), key=lambda i: components[i].codimension)
        taken = {index: start + place for place, index in enumerate(order)}
        start += len(taken)
        return tuple(Numbered(taken[i], c) for i, c in enumerate(components))

    limbs = tuple(take(limb.components) for limb in answer.limb)
    for limb in limbs:
        for entry in limb:
            if len(entry.component.equations) == 1:
                single.setdefault(entry.component.equations[0], entry)
    constraint = take(answer.constraint.components)
    actuation = take(answer.actuation.components if answer.actuation else ())
    name = platform_called(answer.platform_name).removeprefix("the ")
    return Numbering(limbs, constraint, actuation, single, name)


def numbered_alone(components: Sequence[Component]) -> Numbering:
    """A numbering of one list, for a part of an answer; all under ``constraint``."""
    entries = tuple(Numbered(i + 1, c) for i, c in enumerate(components))
    single = {
        entry.component.equations[0]: entry
        for entry in reversed(entries)
        if len(entry.component.equations) == 1
    }
    return Numbering((), entries, entries, single)


def solution_text(solution: Solution) -> str:
    """A solution as relations of the grammar, as short as the branches allow.

    >>> solution_text(Solution("q4", ("0", "pi"), "pi"))
    'q4 = 0, pi'
    >>> solution_text(Solution("q3", ("pi/2", "-pi/2"), "pi"))
    'q3 = ±pi/2'
    >>> solution_text(Solution("q2", ("atan(-r3/d3)", "atan(-r3/d3) + pi"), "pi"))
    'q2 = atan(-r3/d3) (mod pi)'
    """
    values = solution.values
    if len(values) == 2 and values[0] == f"-{values[1]}":
        values = (values[1], values[0])
    if len(values) == 2 and values[1] == f"-{values[0]}":
        values = (f"±{values[0]}",)
    if solution.modulo == "pi" and not is_numeric(solution):
        return f"{solution.variable} = {values[0]} (mod pi)"
    text = f"{solution.variable} = {', '.join(values)}"
    if solution.modulo and not is_numeric(solution):
        text += f" (mod {solution.modulo})"
    return text


def is_numeric(solution: Solution) -> bool:
    """Whether all values are multiples of π and numbers."""
    return all(
        word == "pi" for value in solution.values for word in _LETTERS.findall(value)
    )


def matched(component: Component) -> tuple[tuple[str, Solution | None], ...]:
    """Each equation with the solution that solves it, where there is one."""
    if component.solved:
        return tuple(zip(component.equations, component.solved, strict=True))
    free = list(component.solutions)
    if len(free) == len(component.equations) and all(
        s.variable in _LETTERS.findall(e)
        for e, s in zip(component.equations, free, strict=True)
    ):
        return tuple(zip(component.equations, free, strict=True))
    pairs: dict[str, Solution | None] = dict.fromkeys(component.equations)
    for equation in sorted(
        component.equations, key=lambda e: len(set(_LETTERS.findall(e)))
    ):
        for solution in free:
            if solution.variable in _LETTERS.findall(equation):
                pairs[equation] = solution
                free.remove(solution)
                break
    return tuple((equation, pairs[equation]) for equation in component.equations)


def by_number(entries: Sequence[Numbered]) -> list[Numbered]:
    """The conditions in the order in which they are read."""
    return sorted(entries, key=lambda entry: entry.number)


def place(entry: Numbered, single: Mapping[str, Numbered]) -> tuple[Text, bool]:
    """Where a condition holds, and whether its sentence of geometry was used up."""
    component = entry.component
    pairs = matched(component)
    if len(pairs) == 1:
        equation, solution = pairs[0]
        if solution is not None and reads_well(solution, equation):
            return math(solution_text(solution)), False
        if component.geometry and len(equation) > _SHORT:
            return prose(component.geometry), True
        return math(f"{equation} = 0"), False
    references: list[Text] = []
    numeric: dict[str, list[str]] = {}
    others: list[Text] = []
    for equation, solution in pairs:
        known = single.get(equation)
        if solution is not None and is_numeric(solution):
            text = solution_text(solution)
            variable, _, values = text.partition(" = ")
            numeric.setdefault(values, []).append(variable)
        elif known is not None:
            references.append((known.reference,))
        elif solution is not None and reads_well(solution, equation):
            others.append(math(solution_text(solution)))
        else:
            others.append(math(f"{equation} = 0"))
    same = [
        math(f"{', '.join(variables)} = {values}")
        for values, variables in numeric.items()
    ]
    met, rest = joined(references, " and "), joined([*same, *others], "; ")
    return joined([met, rest], " with "), False


def reads_well(solution: Solution, equation: str) -> bool:
    """Whether a solution says more than its equation; long ones seldom do."""
    text = solution_text(solution)
    return is_numeric(solution) or len(text) <= max(_BEARABLE, len(equation) * 2 // 3)


def consequence(component: Component, platform: str) -> str:
    """What the platform and the mechanism can do there."""
    parts = []
    if component.platform_freedom is not None:
        parts.append(f"{platform} {counted(component.platform_freedom, 'freedom')}")
    if component.mobility is not None:
        parts.append(f"mobility {component.mobility}")
    return ", ".join(parts)


def at_closed_postures(component: Component) -> Text:
    """With which driven joint variables loops close there, and an example."""
    closing: Text = ()
    if component.closes:
        relations = [
            math(solution_text(c.solved) if c.solved else f"{c.equation} = 0")
            for c in component.closes
        ]
        closing = (
            Words("the loops close there with "),
            *joined(relations, " or "),
        )
    return joined([closing, prose(_example(component))], "; ")


def _example(component: Component) -> str:
    """A posture that was met there, or that none was."""
    if component.example is None:
        return ""
    if not component.example:
        return "no real posture was met there at the values of the file"
    at = ", ".join(f"{n} = {_rounded(value)}" for n, value in component.example)
    return f"for example at {at}"


def _rounded(value: float) -> str:
    """To four places, and nothing that is smaller than what a float leaves."""
    return "0" if abs(value) < _NOTHING else f"{value:.4g}"


def condition(entry: Numbered, numbering: Numbering) -> Condition:
    """A numbered entry of a listing."""
    component, single = entry.component, numbering.single
    where, used = place(entry, single)
    earlier = (
        single.get(component.equations[0]) if len(component.equations) == 1 else None
    )
    why: Text = ()
    if component.geometry and not used:
        why = prose(component.geometry)
    elif earlier is not None and earlier.number != entry.number:
        why = (Words("see "), earlier.reference)
    return Condition(
        number=str(entry.number),
        where=where,
        value=words(f"rank {component.rank}"),
        meaning=prose(consequence(component, numbering.platform)),
        details=equations(entry, where, earlier),
        why=joined([why, at_closed_postures(component)], "; "),
    )


def equations(
    entry: Numbered, where: Text, earlier: Numbered | None = None
) -> tuple[Text, ...]:
    """The equations behind a solved condition, unless they are plain to see."""
    component = entry.component
    if earlier is not None and earlier.number != entry.number:
        return ()
    if len(component.equations) != 1:
        return ()
    equation, solution = matched(component)[0]
    if solution is not None and (
        is_numeric(solution) or solution.variable == equation.strip()
    ):
        return ()
    written = Math(f"{equation} = 0")
    return () if where == (written,) else ((written,),)
