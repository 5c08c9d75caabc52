"""The grasp as a person meets it in Python: labelled matrices, symbolic and numeric.

Entries are exact polynomials in the symbols of the file; each matrix gives sympy, text,
or a function of arrays, and says what its rows and columns are.

References: [BicchiMelchiorri] eqs. (1)-(7), [BicchiPrattichizzo] eq. (1), Appendix A.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.border import columns_to_sympy
from screwkit.algebra.compiled import compile_polynomials
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.analyses.grasp_posture import with_scheme
from screwkit.grasping.full_matrices import FullMatrices, full_matrices
from screwkit.grasping.matrices import GraspMatrices
from screwkit.grasping.symbolic_blocks import polynomial_matrices
from screwkit.kinematics.assembly import assumptions_of
from screwkit.kinematics.exact_postures import at_zero
from screwkit.kinematics.placement import why_tied
from screwkit.mechanism.model import Mechanism
from screwkit.screw.system import ScrewFunction


@dataclass(frozen=True, eq=False)
class LabelledMatrix:
    """A matrix of exact entries that knows its rows and columns.

    Attributes:
        name: As the papers call it.
        rows, columns: Labels.
        entries: Polynomials, row by row.
    """

    name: str
    rows: tuple[str, ...]
    columns: tuple[str, ...]
    entries: tuple[tuple[Polynomial, ...], ...] = field(repr=False)
    ring: TrigonometricRing = field(repr=False)
    assumptions: Assumptions = field(default=Assumptions(), repr=False)

    @property
    def shape(self) -> tuple[int, int]:
        """Rows and columns."""
        return len(self.rows), len(self.columns)

    @property
    def texts(self) -> tuple[tuple[str, ...], ...]:
        """The entries in the expression grammar."""
        return tuple(tuple(text(self.ring, x) for x in row) for row in self.entries)

    @property
    def T(self) -> LabelledMatrix:  # noqa: N802 -- as in numpy and sympy
        """The transpose."""
        return LabelledMatrix(
            f"{self.name}ᵀ",
            self.columns,
            self.rows,
            tuple(zip(*self.entries, strict=True)),
            self.ring,
            self.assumptions,
        )

    def __matmul__(self, other: LabelledMatrix) -> LabelledMatrix:
        """The product, in normal form.

        Raises:
            ValueError: If the columns of one are not the rows of the other.
        """
        if self.columns != other.rows:
            raise ValueError(
                f"{self.name} has columns {', '.join(self.columns[:3])}, … and "
                f"{other.name} rows {', '.join(other.rows[:3])}, …"
            )
        ring, columns = self.ring, tuple(zip(*other.entries, strict=True))
        return LabelledMatrix(
            f"{self.name} {other.name}",
            self.rows,
            other.columns,
            tuple(
                tuple(_dot(ring, row, column) for column in columns)
                for row in self.entries
            ),
            ring,
            self.assumptions,
        )

    def to_sympy(self) -> Any:
        """A sympy matrix."""
        columns = tuple(zip(*self.entries, strict=True))
        return columns_to_sympy(self.ring, columns, len(self.rows), self.assumptions)

    def lambdify(self) -> ScrewFunction:
        """A function of symbols by name, over one posture or a batch of them."""
        return ScrewFunction(compile_polynomials(self.ring, self.entries))


def _dot(
    ring: TrigonometricRing, row: Sequence[Polynomial], column: Sequence[Polynomial]
) -> Polynomial:
    total = sum((a * b for a, b in zip(row, column, strict=True)), ring.zero)
    return ring.normal(total)


class GraspView:
    """The platform as a grasped object.

    Contact forces and velocities of contact frames are stacked [linear; angular]; the
    twist is (v; ω) where it stands beside G, and wrenches are (f; m).  Axes are those
    of the base, moments about the reference point, directions as the file writes them.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        """Take the posture of the file where loops tie joint variables together."""
        chosen, _ = with_scheme(mechanism)
        self._mechanism = at_zero(chosen) if why_tied(chosen) else chosen
        self._assumptions = assumptions_of(mechanism)

    def __repr__(self) -> str:
        names = ", ".join(hold.joint for hold in self._matrices[1].holds.contacts)
        return f"<grasp of {self._mechanism.platform!r} by {names}>"

    @cached_property
    def _matrices(self) -> tuple[TrigonometricRing, GraspMatrices[Polynomial]]:
        return polynomial_matrices(self._mechanism)

    @cached_property
    def _full(self) -> FullMatrices[Polynomial]:
        ring, matrices = self._matrices
        return full_matrices(self._mechanism, ring, matrices)

    @property
    def contacts(self) -> tuple[str, ...]:
        """Joints and contacts that hold the platform."""
        return tuple(hold.joint for hold in self._matrices[1].holds.contacts)

    @property
    def G(self) -> LabelledMatrix:  # noqa: N802 -- the papers' name
        """The grasp matrix, w = G f, of the components that contacts transmit."""
        matrices = self._matrices[1]
        size = matrices.twist_size
        order = [1, 2, 0] if size == 3 else [3, 4, 5, 0, 1, 2]
        rows = tuple(tuple(row[i] for row in matrices.gt) for i in order)
        return self._named("G", self._full.forces, self._row_labels, rows)

    @property
    def J(self) -> LabelledMatrix:  # noqa: N802
        """The hand Jacobian of all joints: J q̇ = Gᵀ u."""
        matrices = self._matrices[1]
        return self._named("J", self._row_labels, matrices.freedoms, matrices.j)

    @property
    def J_a(self) -> LabelledMatrix:  # noqa: N802
        """Its columns of actuated freedoms."""
        matrices = self._matrices[1]
        split = len(matrices.actuated)
        rows = tuple(row[:split] for row in matrices.j)
        return self._named("J_a", self._row_labels, matrices.actuated, rows)

    @property
    def J_p(self) -> LabelledMatrix:  # noqa: N802
        """Its columns of passive freedoms."""
        matrices = self._matrices[1]
        split = len(matrices.actuated)
        rows = tuple(row[split:] for row in matrices.j)
        return self._named("J_p", self._row_labels, matrices.passive, rows)

    @property
    def G_full(self) -> LabelledMatrix:  # noqa: N802
        """G of all components of all contacts."""
        full = self._full
        return self._named("G", full.forces, full.components, full.g)

    @property
    def D(self) -> LabelledMatrix:  # noqa: N802
        """Velocities of the contact frames on the links from the joint rates."""
        full = self._full
        return self._named("D", full.components, full.freedoms, full.d)

    @property
    def H(self) -> LabelledMatrix:  # noqa: N802
        """The selector of the components that contacts couple."""
        full = self._full
        return self._named("H", full.rows, full.components, full.h)

    @property
    def _row_labels(self) -> tuple[str, ...]:
        return tuple(row.label for row in self._matrices[1].rows)

    def _named(
        self,
        name: str,
        rows: Sequence[str],
        columns: Sequence[str],
        entries: Sequence[Sequence[Polynomial]],
    ) -> LabelledMatrix:
        return LabelledMatrix(
            name,
            tuple(rows),
            tuple(columns),
            tuple(tuple(row) for row in entries),
            self._matrices[0],
            self._assumptions,
        )
