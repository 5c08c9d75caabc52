"""Texts of a file read as expressions, each fault at its own line and column.

Names that the file does not declare are reported all at once; what depends on
something already reported is passed over in silence.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from screwkit.algebra.expression import ZERO, Expression
from screwkit.algebra.names import RESERVED, did_you_mean, shown
from screwkit.algebra.parse import parse, parse_vector
from screwkit.algebra.tokens import names_in
from screwkit.algebra.vector_expression import VectorExpression
from screwkit.errors import ExpressionError
from screwkit.mechanism.nodes import Faults, Node, Path, Place, key_place_of, place_of
from screwkit.mechanism.structure import subject


@dataclass
class Reading:
    """A file while its texts are being read.

    Attributes:
        names: The declared symbols.
        vectors: The named points and vectors read so far.
        lost: Names whose declaration is at fault.
        planar: Whether points may have two components.
    """

    root: Node
    faults: Faults
    names: frozenset[str] = frozenset()
    vectors: dict[str, VectorExpression] = field(default_factory=dict)
    lost: frozenset[str] = frozenset()
    planar: bool = False

    def fault(self, path: Path, message: str, offset: int | None = None) -> None:
        """Note a fault in what stands at ``path``."""
        text = f"{subject(self.root, path)}: {message}"
        self.faults.add(place_of(self.root, path, offset), text)

    def fault_at_key(self, path: Path, message: str) -> None:
        """Note a fault in the key that ends ``path``."""
        self.faults.add(key_place_of(self.root, path), message)

    def place(self, path: Path) -> Place:
        """Where ``path`` leads to."""
        return place_of(self.root, path)

    def scalar(
        self, path: Path, text: str, names: Iterable[str] | None = None
    ) -> Expression | None:
        """The expression at ``path``; None after a fault."""
        allowed = frozenset(self.names if names is None else names)
        if not self._are_known(path, text, allowed):
            return None
        try:
            return parse(text, allowed, vectors=self.vectors)
        except ExpressionError as error:
            self.fault(path, str(error), error.position)
            return None

    def vector(
        self, path: Path, written: str | tuple[str, ...]
    ) -> VectorExpression | None:
        """The vector at ``path``, from coordinates or an expression."""
        if isinstance(written, str):
            if not self._are_known(path, written, self.names):
                return None
            try:
                return parse_vector(written, self.names, vectors=self.vectors)
            except ExpressionError as error:
                self.fault(path, str(error), error.position)
                return None
        if len(written) == 2 and not self.planar:
            self.fault(path, "a vector has three coordinates, but 2 were found")
            return None
        read = [self.scalar((*path, i), text) for i, text in enumerate(written)]
        x, y, z = [*read, ZERO] if len(read) == 2 else read
        return None if x is None or y is None or z is None else (x, y, z)

    def _are_known(self, path: Path, text: str, allowed: frozenset[str]) -> bool:
        """Report unknown names; those called like functions the parser explains."""
        known = True
        for name, position in names_in(text):
            if name in RESERVED or name in allowed or name in self.vectors:
                continue
            if name in self.lost:
                known = False
            elif not text[position + len(name) :].lstrip().startswith("("):
                known = False
                near = did_you_mean(name, {*allowed, *self.vectors, *RESERVED})
                self.fault(path, f"unknown name {shown(name)}{near}", position)
        return known
