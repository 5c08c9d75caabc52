"""Texts of a file read as expressions, each fault at its own line and column.

Names that the file does not declare are reported all at once; what depends on
something already reported is passed over in silence.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from typing import Final

from screwkit.algebra.expression import ZERO, Expression, Number
from screwkit.algebra.names import RESERVED, did_you_mean, shown
from screwkit.algebra.parse import parse, parse_vector
from screwkit.algebra.tokens import names_in
from screwkit.algebra.vector_expression import VectorExpression
from screwkit.errors import ExpressionError
from screwkit.mechanism.angle_places import misplaced
from screwkit.mechanism.nodes import Faults, Node, Path, Place, key_place_of, place_of
from screwkit.mechanism.requirements import Requirement, requirements_of
from screwkit.mechanism.structure import subject

_SOME: Final = 8
"""How many names a message lists."""
_MOST_ASKED: Final = 50
"""How many names are looked for among all others: each takes a while."""
_UNITS: Final = {"x": "[1, 0, 0]", "y": "[0, 1, 0]", "z": "[0, 0, 1]"}
_NO_NUMBERS: Final = ("inf", "infinity", "nan")
_DEGREES: Final = ("deg", "degree", "degrees")
_FOR_NUMBERS: Final = "`parameters` or `variables`"
_FOR_VECTORS: Final = f"{_FOR_NUMBERS}, or as one of the `points` or `vectors`"
_NUMBER: Final = re.compile(
    r"(?P<above>-?[0-9]{1,15}(?:\.[0-9]{1,15})?)(?:/(?P<below>[0-9]{1,15}))?"
)
_FUNCTION: Final = re.compile(r"(?:sin|cos|tan|atan2)\s*\(")


def _may_be_anywhere(_question: str) -> str:
    return ""


@dataclass(frozen=True)
class Outside:
    """What is known beside a file while it is read.

    Attributes:
        replaced: Symbols that will get their values from outside: those of the file do
            not matter, and nothing that rests on them is a fault of the file.
        why_no_place: Why results have no such place as a claim names; empty if they do.
    """

    replaced: frozenset[str] = frozenset()
    why_no_place: Callable[[str], str] = _may_be_anywhere


@dataclass
class Reading:
    """A file while its texts are being read.

    Attributes:
        names: The declared symbols that expressions may use.
        joint_variables: Those of the joints, which no dimension depends on.
        why_constant: Why an expression cannot use one of them.
        vectors: The named points and vectors read so far.
        lost: Names whose declaration is at fault.
        planar: Whether points may have two components.
        required: What must hold at the values too, and where it is written.
        outside: What is known beside the file.
    """

    root: Node
    faults: Faults
    names: frozenset[str] = frozenset()
    joint_variables: frozenset[str] = frozenset()
    why_constant: str = ""
    vectors: dict[str, VectorExpression] = field(default_factory=dict)
    lost: frozenset[str] = frozenset()
    planar: bool = False
    required: list[tuple[Path, Requirement]] = field(default_factory=list)
    outside: Outside = Outside()
    _asked: int = 0
    _met: set[Requirement] = field(default_factory=set)
    _read: dict[tuple[str, frozenset[str]], Expression] = field(default_factory=dict)

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
        known = _number(text)
        if known is not None:
            return known
        allowed = self.names if names is None else frozenset(names)
        known = self._read.get((text, allowed))
        if known is not None:
            return known
        if not self._are_known(path, text, allowed):
            return None
        try:
            read = parse(text, allowed, vectors=self.vectors)
        except ExpressionError as error:
            self.fault(path, str(error), error.position)
            return None
        if not self._has_sense(path, read):
            return None
        self._read[text, allowed] = read
        return read

    def angle(self, path: Path, text: str) -> Expression | None:
        """The angle at ``path``, in radians; None after a fault."""
        read = self.scalar(path, text)
        return read if self._are_in_place(path, text, read, angle=True) else None

    def length(self, path: Path, text: str) -> Expression | None:
        """The number at ``path`` that is no angle; None after a fault."""
        read = self.scalar(path, text)
        return read if self._are_in_place(path, text, read, angle=False) else None

    def _are_in_place(
        self, path: Path, text: str, *read: Expression | None, angle: bool
    ) -> bool:
        """Report angles that have no exact sense, unless numbers may yet give them one.

        Named vectors were looked at where they are written.
        """
        if self.outside.replaced or not (angle or _FUNCTION.search(text)):
            return True
        for expression in read:
            words = "" if expression is None else misplaced(expression, angle=angle)
            if words:
                self.fault(path, words)
                return False
        return True

    def vector(
        self, path: Path, written: str | tuple[str, ...]
    ) -> VectorExpression | None:
        """The vector at ``path``, from coordinates or an expression."""
        if isinstance(written, str):
            if not self._are_known(path, written, self.names, vector=True):
                return None
            try:
                vector = parse_vector(written, self.names, vectors=self.vectors)
            except ExpressionError as error:
                self.fault(path, str(error), error.position)
                return None
            fine = self._has_sense(path, *vector)
            fine = fine and self._are_in_place(path, written, *vector, angle=False)
            return vector if fine else None
        if len(written) == 2 and not self.planar:
            self.fault(path, "a vector has three coordinates, but 2 were found")
            return None
        read = [self.length((*path, i), text) for i, text in enumerate(written)]
        x, y, z = [*read, ZERO] if len(read) == 2 else read
        return None if x is None or y is None or z is None else (x, y, z)

    def require(self, path: Path, requirement: Requirement) -> bool:
        """Report what fails for all values; the rest waits for those of the file."""
        if requirement.fails:
            self.fault(path, requirement.message())
            return False
        if requirement.symbols:
            self.required.append((path, requirement))
        return True

    def nearest(self, name: str, known: Iterable[str]) -> str:
        """The nearest known name in brackets; for the first faults of a file alone."""
        self._asked += 1
        return did_you_mean(name, known) if self._asked <= _MOST_ASKED else ""

    def unknown_link(self, name: str, links: Sequence[str]) -> str:
        """A body that is not listed, with the nearest that is, or with some of them."""
        return self._unknown("link", name, links)

    def unknown_joint(self, name: str, joints: Sequence[str]) -> str:
        """The same of a joint."""
        return self._unknown("joint", name, joints)

    def _unknown(self, noun: str, name: str, known: Sequence[str]) -> str:
        near = self.nearest(name, known)
        if not near and known:
            more = ", …" if len(known) > _SOME else ""
            near = f"; the {noun}s are {', '.join(known[:_SOME])}{more}"
        return f"unknown {noun} {shown(name)}{near}"

    def vouch(self, expressions: Iterable[Expression]) -> None:
        """Take these expressions as checked: they are built, and a fault is known."""
        self._met.update(r for e in expressions for r in requirements_of(e))

    def _has_sense(self, path: Path, *expressions: Expression) -> bool:
        """Require real values, once for what named vectors spread over the file."""
        fulfilled = True
        for expression in expressions:
            for requirement in requirements_of(expression):
                if requirement not in self._met:
                    self._met.add(requirement)
                    fulfilled = self.require(path, requirement) and fulfilled
        return fulfilled

    def _are_known(
        self, path: Path, text: str, allowed: frozenset[str], vector: bool = False
    ) -> bool:
        """Report unknown names; those called like functions the parser explains."""
        known = True
        for name, position in names_in(text):
            if name in RESERVED or name in allowed or name in self.vectors:
                continue
            if name in self.lost:
                known = False
            elif name in self.joint_variables:
                known = False
                words = f"{shown(name)} is a joint variable; {self.why_constant}"
                self.fault(path, words, position)
            elif not text[position + len(name) :].lstrip().startswith("("):
                known = False
                near = self.nearest(name, {*allowed, *self.vectors, *RESERVED})
                if text == name and name in _UNITS and vector:
                    near = f"; write {_UNITS[name]}"
                elif name.lower() in _NO_NUMBERS:
                    near = "; every number is finite"
                elif name.lower() in _DEGREES:
                    near = "; angles are in radians: 30 degrees are pi/6"
                elif not near:
                    sections = _FOR_VECTORS if vector else _FOR_NUMBERS
                    near = f"; it can be declared under {sections}"
                self.fault(path, f"unknown name {shown(name)}{near}", position)
        return known


@lru_cache(maxsize=4096)
def _number(text: str) -> Expression | None:
    """A plain number or fraction, which is most of what large files hold."""
    match = _NUMBER.fullmatch(text)
    if match is None:
        return None
    above, below = Fraction(match["above"]), int(match["below"] or 1)
    return Number(above / below if below != 1 else above) if below else None
