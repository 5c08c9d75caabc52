"""Systems of twists, systems of wrenches, and reciprocity between them.

Twists form se(3), wrenches its dual.  The two are different types: a twist system has
no sum with a wrench system, and only `reciprocal` leads from one to the other.
Dimensions are generic over all symbols and exact.

References: [Hunt1978], [Ball1900]; [LongCaroKhalil2012] (26)-(32).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Self, final

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.batch import Array
from screwkit.algebra.border import columns_to_sympy, latex_of
from screwkit.algebra.compiled import Compiled, compile_polynomials
from screwkit.algebra.factors import factor
from screwkit.algebra.polynomial_text import equation_text, text
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.conventions import SCREW_DIMENSION
from screwkit.errors import FrameMismatchError
from screwkit.screw import nullspace
from screwkit.screw.displacement import Displacement
from screwkit.screw.nullspace import Basis, Column

FACTORED = 200  # terms of an assumption that is split into its factors


@dataclass(frozen=True)
class _Screw:
    """A screw up to a factor, in the axes and about the origin of a frame.

    Attributes:
        ring: Of the coordinates.
        column: (direction, moment), six polynomials.
        frame: Name of the link.
        assumptions: What is known of the symbols.
    """

    ring: TrigonometricRing = field(repr=False)
    column: Column = field(repr=False)
    frame: str
    assumptions: Assumptions = field(default=Assumptions(), repr=False)

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The six coordinates as text, direction before moment."""
        return tuple(text(self.ring, value) for value in self.column)

    def to_sympy(self) -> Any:
        """A 6×1 sympy matrix, direction over moment."""
        return columns_to_sympy(
            self.ring, [self.column], SCREW_DIMENSION, self.assumptions
        )


@final
@dataclass(frozen=True)
class Twist(_Screw):
    """Angular velocity ω, and the velocity v of the point now at the origin."""


@final
@dataclass(frozen=True)
class Wrench(_Screw):
    """Force f, and its moment m about the origin."""


def reciprocal_product(twist: Twist, wrench: Wrench) -> str:
    """The power f·v + m·ω of a wrench on a twist; ``"0"`` where they are reciprocal.

    Raises:
        FrameMismatchError: If they are expressed in different frames.
        ValueError: If they belong to different mechanisms.
    """
    _same_place(twist, wrench)
    value = nullspace.reciprocal_product(twist.ring, twist.column, wrench.column)
    return text(twist.ring, value)


@final
@dataclass(frozen=True)
class ScrewFunction:
    """A screw system as a function of joint variables and symbols.

    Attributes:
        compiled: The polynomials.
        fixed: Values given beforehand.
    """

    compiled: Compiled = field(repr=False)
    fixed: Mapping[str, float] = field(default_factory=dict)

    def __call__(self, **values: Array | float) -> Array:
        """The matrix at one posture or many.

        Args:
            **values: Joint variables and symbols by name; numbers, or arrays that
                broadcast to the batch.

        Returns:
            Shape batch + (6, n), direction over moment.

        Raises:
            UnknownNameError: If a needed name is missing.
        """
        return self.compiled({**self.fixed, **values})


@dataclass(frozen=True, eq=False)
class _System:
    """What systems of twists and of wrenches have in common.

    Attributes:
        ring: Of the coordinates.
        columns: A basis, or what else spans the system: (direction, moment) each.
        frame: Name of the link in whose axes and about whose origin they are given.
        assumptions: What is known of the symbols.
        assumed_nonzero: The columns span the system wherever none of these vanishes.
    """

    ring: TrigonometricRing = field(repr=False)
    columns: tuple[Column, ...] = field(repr=False)
    frame: str
    assumptions: Assumptions = field(default=Assumptions(), repr=False)
    assumed_nonzero: frozenset[str] = field(default=frozenset(), repr=False)

    def __repr__(self) -> str:
        count = len(self.columns)
        plural = "" if count == 1 else "s"
        return f"<{type(self).__name__} of {count} column{plural} in {self.frame!r}>"

    @cached_property
    def dimension(self) -> int:
        """Of the system, generic over all symbols."""
        return nullspace.generic_rank(self.ring, self.columns)

    def __len__(self) -> int:
        """Number of columns; `dimension` where they are independent."""
        return len(self.columns)

    def __eq__(self, other: object) -> bool:
        """Whether both are the same space; assumptions do not matter."""
        if not isinstance(other, _System) or type(other) is not type(self):
            return NotImplemented
        if self.ring is not other.ring or self.frame != other.frame:
            return False
        together = nullspace.generic_rank(self.ring, (*self.columns, *other.columns))
        return self.dimension == other.dimension == together

    def __hash__(self) -> int:
        return hash((type(self), id(self.ring), self.frame))

    def __contains__(self, screw: object) -> bool:
        """Whether a screw of the same kind and frame belongs to the system."""
        if not isinstance(screw, _Screw) or type(screw) is not self._kind:
            return False
        _same_place(self, screw)
        rank = nullspace.generic_rank(self.ring, (*self.columns, screw.column))
        return rank == self.dimension

    _kind = _Screw

    def __add__(self, other: Self) -> Self:
        """The smallest system that contains both.

        Raises:
            FrameMismatchError: If they are expressed in different frames.
            ValueError: If they belong to different mechanisms.
        """
        if type(other) is not type(self):
            return NotImplemented
        _same_place(self, other)
        basis = nullspace.basis_of(self.ring, (*self.columns, *other.columns))
        return self._spanned(basis, self.assumed_nonzero | other.assumed_nonzero)

    def _spanned(self, basis: Basis, known: frozenset[str]) -> Self:
        return type(self)(
            self.ring,
            basis.columns,
            self.frame,
            self.assumptions,
            known | conditions(self.ring, basis.pivot, self.assumptions),
        )

    def _reciprocal(self) -> tuple[tuple[Column, ...], frozenset[str]]:
        basis = nullspace.basis_of(self.ring, self.columns)
        dual = nullspace.reciprocal_basis(self.ring, basis.columns)
        return dual.columns, self.assumed_nonzero | conditions(
            self.ring, dual.pivot, self.assumptions
        )

    def expressed_in(
        self, frame: str, frame_from_here: Displacement[Polynomial]
    ) -> Self:
        """The same system in the axes and about the origin of another frame.

        Args:
            frame: Its name.
            frame_from_here: Maps coordinates of this system's frame to that one.
        """
        columns = tuple(
            nullspace.moved(self.ring, frame_from_here, column)
            for column in self.columns
        )
        return type(self)(
            self.ring, columns, frame, self.assumptions, self.assumed_nonzero
        )

    def to_sympy(self) -> Any:
        """The columns as a 6×n sympy matrix, direction over moment."""
        return columns_to_sympy(
            self.ring, self.columns, SCREW_DIMENSION, self.assumptions
        )

    def lambdify(self, values: Mapping[str, float] | None = None) -> ScrewFunction:
        """The columns as a numpy function, vectorised over postures.

        Args:
            values: Numbers for some of the symbols, once and for all.
        """
        rows = [[column[i] for column in self.columns] for i in range(SCREW_DIMENSION)]
        return ScrewFunction(compile_polynomials(self.ring, rows), dict(values or {}))

    def latex(self) -> str:
        """The columns as a LaTeX matrix."""
        return latex_of(self.to_sympy())


@final
@dataclass(frozen=True, eq=False, repr=False)
class TwistSystem(_System):
    """The instantaneous motions a body can have; a subspace of se(3)."""

    _kind = Twist

    def __getitem__(self, number: int) -> Twist:
        """One of the columns."""
        return Twist(self.ring, self.columns[number], self.frame, self.assumptions)

    def __iter__(self) -> Iterator[Twist]:
        """The columns as twists."""
        return (self[number] for number in range(len(self.columns)))

    def reciprocal(self) -> WrenchSystem:
        """The wrenches that do no work on any of these twists."""
        columns, known = self._reciprocal()
        return WrenchSystem(self.ring, columns, self.frame, self.assumptions, known)

    def __and__(self, other: TwistSystem) -> TwistSystem:
        """The motions common to both: of a body held by two limbs.

        Raises:
            FrameMismatchError: If they are expressed in different frames.
            ValueError: If they belong to different mechanisms.
        """
        if not isinstance(other, TwistSystem):
            return NotImplemented
        return (self.reciprocal() + other.reciprocal()).reciprocal()


@final
@dataclass(frozen=True, eq=False, repr=False)
class WrenchSystem(_System):
    """The wrenches that can act on a body; a subspace of the dual of se(3)."""

    _kind = Wrench

    def __getitem__(self, number: int) -> Wrench:
        """One of the columns."""
        return Wrench(self.ring, self.columns[number], self.frame, self.assumptions)

    def __iter__(self) -> Iterator[Wrench]:
        """The columns as wrenches."""
        return (self[number] for number in range(len(self.columns)))

    def reciprocal(self) -> TwistSystem:
        """The twists on which none of these wrenches does work."""
        columns, known = self._reciprocal()
        return TwistSystem(self.ring, columns, self.frame, self.assumptions, known)

    def __and__(self, other: WrenchSystem) -> WrenchSystem:
        """The wrenches that belong to both.

        Raises:
            FrameMismatchError: If they are expressed in different frames.
            ValueError: If they belong to different mechanisms.
        """
        if not isinstance(other, WrenchSystem):
            return NotImplemented
        return (self.reciprocal() + other.reciprocal()).reciprocal()


def conditions(
    ring: TrigonometricRing, pivot: Polynomial | None, assumptions: Assumptions
) -> frozenset[str]:
    """What must not vanish for a pivot not to, without what is known not to."""
    if pivot is None or pivot.is_constant():
        return frozenset()
    parts = [pivot]
    if len(pivot) <= FACTORED:
        parts = [
            equation
            for found, _ in factor(ring, pivot).factors
            for equation in found.equations
        ]
    return frozenset(
        equation_text(ring, part)
        for part in parts
        if not assumptions.is_nonzero(ring, part)
    )


def _same_place(left: _Screw | _System, right: _Screw | _System) -> None:
    if left.frame != right.frame:
        raise FrameMismatchError(left.frame, right.frame)
    if left.ring is not right.ring:
        raise ValueError("screws of different mechanisms cannot be combined")
