"""The scalars kinematics may use, and all it may ask of them.

One text of the kinematics serves four purposes: integers mod p give ranks, exact
polynomials give conditions, numpy arrays give a million postures at once, floats give
one.  So the code above this line adds, subtracts and multiplies; it never compares,
and it asks the ring, not the value, what is zero.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Protocol, Self, TypeAlias, TypeVar

from screwkit.algebra.expression import Expression


class Scalar(Protocol):
    """What every number of every ring can do."""

    def __add__(self, other: Self, /) -> Self:
        """Sum."""
        ...

    def __sub__(self, other: Self, /) -> Self:
        """Difference."""
        ...

    def __mul__(self, other: Self, /) -> Self:
        """Product."""
        ...

    def __neg__(self) -> Self:
        """Negative."""
        ...


S = TypeVar("S", bound=Scalar)


Known: TypeAlias = dict[int, tuple[Expression, S]]
"""Values of expressions by their identity, with the expression that keeps it."""


class Ring(Protocol[S]):
    """Where scalars come from and how they are judged."""

    @property
    def known(self) -> Known[S] | None:
        """What was evaluated before; None where nothing is kept."""
        ...

    @property
    def plain(self) -> bool:
        """Whether every scalar is its own normal form."""
        ...

    @property
    def zero(self) -> S:
        """The scalar 0."""
        ...

    @property
    def one(self) -> S:
        """The scalar 1."""
        ...

    def rational(self, value: Fraction) -> S:
        """An exact rational."""
        ...

    def symbol(self, name: str) -> S:
        """A declared length, free symbol or joint variable as a number."""
        ...

    def cosine_sine(self, angle: str) -> tuple[S, S]:
        """(cos, sin) of a declared symbol."""
        ...

    def half_turns(self, count: Fraction) -> tuple[S, S]:
        """(cos, sin) of ``count``·π."""
        ...

    def radians(self, value: Fraction) -> tuple[S, S]:
        """(cos, sin) of a rational number of radians."""
        ...

    def square_root(self, radicand: Expression, value: S) -> S:
        """A square root of ``value``, which is what ``radicand`` evaluates to."""
        ...

    def inverse(self, divisor: Expression, value: S) -> S:
        """The inverse of ``value``, which is what ``divisor`` evaluates to."""
        ...

    def normal(self, value: S) -> S:
        """The normal form: equal scalars have equal normal forms in exact rings."""
        ...

    def is_zero(self, value: S) -> bool:
        """Whether a scalar in normal form is zero for every posture."""
        ...
