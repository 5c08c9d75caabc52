"""Limbs with loops inside, read as chains of joints and of blocks.

A block is a part between two bodies that several chains connect side by side, such as a
parallelogram.  Bodies of a chain add their twists; chains side by side share what they
have in common.  Limbs that are no such nesting (a K33 inside, say) are left alone.

References: [Hunt1978], §13 (systems in series and in parallel).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from screwkit.algebra.common_factors import without_common_factors
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.errors import TooLargeError
from screwkit.mechanism.model import Joint
from screwkit.screw.nullspace import Column, reciprocal_basis


@dataclass(frozen=True)
class Block:
    """Chains side by side between the same two bodies."""

    branches: tuple[Chain, ...]

    @property
    def joints(self) -> tuple[str, ...]:
        """All its joints."""
        return tuple(name for chain in self.branches for name in joints_of(chain))


Element: TypeAlias = str | Block
"""A joint by its name, or a block."""

Chain: TypeAlias = tuple[Element, ...]


def joints_of(chain: Chain) -> tuple[str, ...]:
    """All joints of a chain, those inside blocks too."""
    return tuple(
        name
        for element in chain
        for name in ((element,) if isinstance(element, str) else element.joints)
    )


def loops_in(chain: Chain) -> int:
    """Independent loops inside a chain."""
    return sum(
        len(element.branches) - 1 + sum(map(loops_in, element.branches))
        for element in chain
        if not isinstance(element, str)
    )


@dataclass
class _Edge:
    ends: tuple[str, str]
    chain: Chain

    def from_end(self, end: str) -> Chain:
        return self.chain if self.ends[0] == end else _reversed(self.chain)

    def other(self, end: str) -> str:
        return self.ends[1] if self.ends[0] == end else self.ends[0]


def chain_between(joints: Sequence[Joint], start: str, end: str) -> Chain | None:
    """The joints between two bodies as one chain; None where they do not nest.

    Args:
        joints: Of a limb.
        start: A body; the chain begins here.
        end: Another one.

    Returns:
        Parts that hang on the limb without being between the two bodies are left out.
    """
    edges = [_Edge((joint.parent, joint.child), (joint.name,)) for joint in joints]
    while True:
        edges = _side_by_side([e for e in edges if e.ends[0] != e.ends[1]])
        meeting: dict[str, list[_Edge]] = {}
        for edge in edges:
            for body in edge.ends:
                meeting.setdefault(body, []).append(edge)
        inner = [b for b in meeting if b not in (start, end) and len(meeting[b]) <= 2]
        if not inner:
            break
        own = meeting[inner[0]]
        edges = [e for e in edges if e not in own]
        if len(own) == 2:
            before, after = own
            body = inner[0]
            chain = _reversed(before.from_end(body)) + after.from_end(body)
            edges.append(_Edge((before.other(body), after.other(body)), chain))
    if len(edges) != 1:
        return None
    return edges[0].from_end(start)


def _side_by_side(edges: Sequence[_Edge]) -> list[_Edge]:
    """Edges with the same two ends become one block."""
    groups: dict[frozenset[str], list[_Edge]] = {}
    for edge in edges:
        groups.setdefault(frozenset(edge.ends), []).append(edge)
    merged = []
    for group in groups.values():
        if len(group) == 1:
            merged.append(group[0])
            continue
        first = group[0].ends[0]
        branches = tuple(edge.from_end(first) for edge in group)
        merged.append(_Edge((first, group[0].ends[1]), (Block(branches),)))
    return merged


def _reversed(chain: Chain) -> Chain:
    return tuple(
        element
        if isinstance(element, str)
        else Block(tuple(_reversed(branch) for branch in element.branches))
        for element in reversed(chain)
    )


def element_columns(
    ring: TrigonometricRing,
    element: Element,
    columns: Mapping[str, Sequence[Column]],
    largest: int | None = None,
) -> tuple[Column, ...]:
    """What an element lets the bodies at its ends do relative to each other.

    Args:
        ring: Of the polynomials.
        element: A joint or a block.
        columns: The twists of every joint's freedoms, by joint.
        largest: Terms of all wrenches of a block together, beyond which it is refused.

    Returns:
        The joint's own twists; of a block, generically a basis of the twists that all
        its chains allow.

    Raises:
        TooLargeError: If a block's wrenches are too long to find its twists in symbols.
    """
    if isinstance(element, str):
        return tuple(columns[element])
    wrenches: list[Column] = []
    for branch in element.branches:
        spanned = [
            c
            for inner in branch
            for c in element_columns(ring, inner, columns, largest)
        ]
        wrenches += [
            without_common_factors(ring, c)
            for c in reciprocal_basis(ring, spanned).columns
        ]
    size = sum(len(entry) for column in wrenches for entry in column)
    if largest is not None and size > largest:
        raise TooLargeError(
            f"the wrenches of {', '.join(element.joints)} have {size} terms, too many "
            f"for a system in symbols"
        )
    return tuple(
        without_common_factors(ring, column)
        for column in reciprocal_basis(ring, wrenches).columns
    )
