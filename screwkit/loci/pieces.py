"""Irreducible pieces of a locus, told apart and compared by exact points."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice

from screwkit.algebra.branches import Branch
from screwkit.algebra.points import Point, residue
from screwkit.algebra.proved_inside import left_over
from screwkit.algebra.trigonometric import Polynomial


@dataclass(frozen=True)
class Piece:
    """A component: the branches (sheets) that share its conditions.

    Attributes:
        equations: Polynomials that vanish exactly on the piece (together with those of
            pieces that contain it); each irreducible where the former ones vanish.
        branches: Its sheets; never empty.
    """

    equations: tuple[Polynomial, ...]
    branches: tuple[Branch, ...]

    @cached_property
    def by_text(self) -> Mapping[str, Polynomial]:
        """The equations."""
        return {str(equation): equation for equation in self.equations}

    @cached_property
    def texts(self) -> frozenset[str]:
        """Of the equations."""
        return frozenset(self.by_text)

    @property
    def codimension(self) -> int:
        """In the space of all free symbols."""
        return self.branches[0].codimension

    @property
    def is_exact(self) -> bool:
        """Whether each condition was solved with all its zeros, so that none is left.

        Else the equations may hold on sets of their own beside the piece.
        """
        return len(self.equations) < 2 or all(
            len(branch.pending) < 2 and not any(step.partial for step in branch.steps)
            for branch in self.branches
        )

    def contains(self, point: Point, prime: int) -> bool:
        """Whether an exact point lies on the piece."""
        return not any(residue(e, point, prime) for e in self.equations)


def pieces_of(branches: Iterable[Branch], *, surely: bool = False) -> list[Piece]:
    """Sheets of the same conditions gathered, and what lies inside another left out.

    Args:
        branches: Each irreducible.
        surely: Leave out only what lies in a piece whose equations are exact.
    """
    groups: dict[frozenset[str], list[Branch]] = {}
    for branch in branches:
        key = frozenset(str(condition) for condition in branch.conditions)
        groups.setdefault(key, []).append(branch)
    pieces = [piece for group in groups.values() for piece in _gathered(group)]
    return without_contained(pieces, surely=surely)


def _gathered(group: Sequence[Branch]) -> list[Piece]:
    """Branches of the same conditions, sheets told apart only where it matters."""
    by_sheets = {frozenset(str(p) for p in b.sheets): b for b in group}
    classes = {sheets: {sheets} for sheets in by_sheets}
    for first, second in sorted(_opposites(group)):
        merged: dict[frozenset[str], set[frozenset[str]]] = {}
        pairs = [
            (key, frozenset(key - {first} | {second}))
            for key in classes
            if first in key
        ]
        both = all(other in classes for _, other in pairs)
        if not both or not all(
            second not in key or frozenset(key - {second} | {first}) in classes
            for key in classes
        ):
            continue
        for key, members in classes.items():
            rest = frozenset(key - {first, second})
            merged.setdefault(rest, set()).update(members)
        classes = merged
    return [
        piece
        for key, members in classes.items()
        for piece in _of_sheets(
            key, [by_sheets[sheets] for sheets in sorted(members, key=sorted)]
        )
    ]


def _of_sheets(told: frozenset[str], sheets: Sequence[Branch]) -> list[Piece]:
    """One piece of several sheets; one each where they share no equations.

    Of sin p = sin q = 0 with cos(p − q) = 1 there are two sheets, and cos q = 1 holds
    on one of them.
    """
    equations = sheets[0].equations(told)
    places = [at for sheet in sheets for at in sheet.points]
    if any(residue(equation, *at) for equation in equations for at in places):
        own = (frozenset(str(p) for p in sheet.sheets) for sheet in sheets)
        return [
            Piece(sheet.equations(key), (sheet,))
            for key, sheet in zip(own, sheets, strict=True)
        ]
    return [Piece(equations, tuple(sheets))]


def _opposites(group: Sequence[Branch]) -> set[tuple[str, str]]:
    """The two sheets of each solved condition."""
    sheets: dict[str, set[str]] = {}
    for branch in group:
        for step in branch.steps:
            if step.sheet is not None:
                sheets.setdefault(str(step.condition), set()).add(str(step.sheet))
    pairs = (sorted(both) for both in sheets.values() if len(both) == 2)
    return {(first, second) for first, second in pairs}


def without_contained(pieces: Sequence[Piece], *, surely: bool = False) -> list[Piece]:
    """The pieces that lie in no other one; with ``surely`` in none that is exact.

    Of a piece some sheets of which do, the others stay.
    """
    kept: list[Piece] = []

    def trusted(found: Sequence[Piece]) -> list[Piece]:
        return [piece for piece in found if piece.is_exact or not surely]

    for piece in sorted(pieces, key=lambda piece: piece.codimension):
        if not _outside(piece, trusted(kept)):
            continue
        # Of one size the part may come before the whole.
        size, whole = piece.codimension, trusted([piece])
        kept = [
            left
            for known in kept
            for left in (
                _outside(known, whole) if known.codimension == size else [known]
            )
        ]
        kept += _outside(piece, trusted(kept))
    return kept


def _outside(piece: Piece, others: Sequence[Piece]) -> list[Piece]:
    """What is left of a piece without the sheets that lie in others."""
    left = [b for b in piece.branches if not any(is_part(b, piece, o) for o in others)]
    return sheets_of(piece, left)


def sheets_of(piece: Piece, left: Sequence[Branch]) -> list[Piece]:
    """Some sheets of a piece, as pieces with equations that leave out the others."""
    if len(left) == len(piece.branches):
        return [piece]
    as_given = piece.texts == set().union(
        *(part.texts for part in _gathered(piece.branches))
    )
    known = () if as_given else piece.equations
    return [
        replace(
            part,
            equations=(
                *known,
                *(e for e in part.equations if as_given or str(e) not in piece.texts),
            ),
        )
        for part in _gathered(left)
    ]


def is_part(branch: Branch, piece: Piece, other: Piece) -> bool:
    """Whether a sheet of a piece lies in another piece that is no smaller.

    Equations of a piece may hold on further sets of its size, unless they are exact; of
    two pieces of one size the one is in the other then only if sheets of that are in
    it.
    """
    if not lies_in(branch, other):
        return False
    if piece.codimension > other.codimension or other.is_exact:
        return True
    return any(lies_in(sheet, piece) for sheet in other.branches)


def alike(pieces: Iterable[Piece], kind: Callable[[Branch], object]) -> list[Piece]:
    """The pieces, none with sheets of two kinds.

    θ = 0 and θ = π may be sheets of one condition and nothing else be the same on them.

    Args:
        pieces: Of one or several sheets each.
        kind: Of a sheet; None where it is not known, so that no sheet is told by it.
    """
    found: list[Piece] = []
    for piece in pieces:
        kinds: list[tuple[object, list[Branch]]] = []
        for branch in piece.branches:
            own = kind(branch) if len(piece.branches) > 1 else None
            same = (g for k, g in kinds if own is None or k is None or k == own)
            group = next(same, None)
            if group is None:
                kinds.append((own, [branch]))
            else:
                group.append(branch)
        found += [part for _, sheets in kinds for part in sheets_of(piece, sheets)]
    return found


def told_apart(pieces: Sequence[Piece], known: Sequence[Polynomial]) -> list[Piece]:
    """The pieces, none with equations that hold on all of another one too.

    Where the equations of a piece do, a known condition that vanishes on the piece and
    not on the other is added to them.
    """
    found = []
    for piece in pieces:
        inside = [o for o in pieces if o is not piece and _inside(o, piece)]
        extra: list[Polynomial] = []
        for other in inside:
            if any(not _vanishes(e, other) for e in extra):
                continue
            telling = (
                f for f in known if _vanishes(f, piece) and not _vanishes(f, other)
            )
            extra += islice(telling, 1)
        found.append(replace(piece, equations=(*piece.equations, *extra)))
    return found


def _inside(inner: Piece, outer: Piece) -> bool:
    return any(lies_in(branch, outer) for branch in inner.branches)


def _vanishes(polynomial: Polynomial, piece: Piece) -> bool:
    """On all sheets of a piece, at their exact points."""
    return all(
        branch.points and not any(residue(polynomial, *at) for at in branch.points)
        for branch in piece.branches
    )


def lies_in(branch: Branch, piece: Piece) -> bool:
    """Whether a branch lies on a piece: by its conditions or by its exact points."""
    if piece.texts <= branch.texts:
        return True
    points = branch.points
    if not points:
        return False
    told = branch.zero_at_points  # pieces share equations
    for text, equation in piece.by_text.items():
        if text not in told:
            told[text] = not any(residue(equation, *point) for point in points)
        if not told[text]:
            return False
    return True


def has_equations_of(branch: Branch, piece: Piece) -> bool:
    """Whether the steps of a branch, and its conditions, say what a piece does.

    Then all of it lies there, whatever its pending conditions are.
    """
    told = branch.zero_by_steps
    for text, equation in piece.by_text.items():
        if text not in told:
            told[text] = text in branch.texts or branch.value(equation) == 0
        if not told[text]:
            return False
    return True


def surely_in(branch: Branch, piece: Piece) -> bool:
    """Whether all of a branch lies on a piece, with parts that its points do not show.

    Where several conditions are pending the points may lie on one part of it; then a
    proof is asked for.
    """
    if piece.texts <= branch.texts:
        return True
    if not lies_in(branch, piece):
        return False
    return len(branch.pending) < 2 or left_over(branch, [piece.equations]) == []
