"""Screws that would be too long to expand: how many, of what kind, and how long.

The dimension of a system and the kinds of its screws are known at an exact point; what
is missing are the polynomials, and their size is known before they are multiplied out.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.analyses.identified import ScrewWriter, left_out
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.errors import TooLargeError
from screwkit.kinematics.subspaces import Row, dimension, reciprocal
from screwkit.loci.reciprocals import Finder, FoundScrew, span_of
from screwkit.results.screws import IdentifiedScrew
from screwkit.screw.nullspace import Column, residues, sample
from screwkit.screw.vector import dot

WRENCHES = "force", "couple"
TWISTS = "rotation", "translation"
"""What a screw is called that is a line, and one without direction."""
PRODUCTS = 2_000_000
"""Products of terms that the expansion of a system may take for one more screw."""


@dataclass(frozen=True)
class Found:
    """A system as far as it is written.

    Attributes:
        screws: Independent ones.
        missing: Residues of those that complete a basis.
        size: How long these would have been; empty where none is missing.
    """

    screws: tuple[FoundScrew, ...]
    missing: tuple[Row, ...] = ()
    size: str = ""

    def rows(self, ring: TrigonometricRing) -> list[Row]:
        """A basis at the sample point of the ring."""
        return [*(residues(ring, s.column) for s in self.screws), *self.missing]


def reciprocal_to(
    finder: Finder,
    columns: Sequence[Column],
    size: int,
    complete: Callable[[], Sequence[FoundScrew]],
    first: Sequence[FoundScrew] = (),
) -> Found:
    """Screws reciprocal to ``columns`` as far as they are short, see `Finder.basis`."""
    said: list[str] = []

    def bounded() -> Sequence[FoundScrew]:
        try:
            return complete()
        except TooLargeError as error:
            said.append(str(error))
            return ()

    chosen = finder.basis(columns, size, bounded, first)
    if len(chosen) == size:
        return Found(tuple(chosen))
    ring = finder.ring
    rows = reciprocal([residues(ring, c) for c in columns], sample(ring)[1])
    return Found(tuple(chosen), completed(ring, chosen, rows), "".join(said))


def completed(
    ring: TrigonometricRing, screws: Sequence[FoundScrew], rows: Sequence[Row]
) -> tuple[Row, ...]:
    """Those of the rows that complete the screws to a basis of all."""
    _, prime = sample(ring)
    known: list[Row] = [residues(ring, screw.column) for screw in screws]
    missing = []
    for row in rows:
        if dimension([*known, row], prime) > len(known):
            known.append(row)
            missing.append(row)
    return tuple(missing)


def together(ring: TrigonometricRing, systems: Sequence[Found]) -> Found:
    """The sum of several systems."""
    screws = tuple(span_of(ring, [system.screws for system in systems]))
    rows = [row for system in systems for row in system.missing]
    missing = completed(ring, screws, rows)
    sizes = [system.size for system in systems if system.missing]
    return Found(screws, missing, sizes[0] if missing else "")


def written(
    system: Found, writer: ScrewWriter, kinds: tuple[str, str]
) -> tuple[IdentifiedScrew, ...]:
    """The screws of a system, and how long those are that are not written.

    Args:
        system: Of wrenches or of twists.
        writer: Of the same ring.
        kinds: ``WRENCHES`` or ``TWISTS``.
    """
    write = writer.wrench if kinds == WRENCHES else writer.twist
    return (
        *map(write, system.screws),
        *(_unwritten(writer.ring, row, kinds, system.size) for row in system.missing),
    )


def _unwritten(
    ring: TrigonometricRing, row: Row, kinds: tuple[str, str], size: str
) -> IdentifiedScrew:
    """A screw of which the kind is known and the length."""
    _, prime = sample(ring)
    kind = "screw" if dot(row[DIRECTION], row[MOMENT]) % prime else kinds[0]
    if not any(row[DIRECTION]):
        kind = kinds[1]
    return left_out(kind, size)
