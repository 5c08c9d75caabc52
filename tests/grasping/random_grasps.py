"""Random grasp matrices in small integers, with ranks lost on purpose."""

from __future__ import annotations

import random
from dataclasses import dataclass
from typing import Any

from flint import fmpq_mat
from hypothesis import strategies as st

from screwkit.grasping.exact_grasp import ExactGrasp

PRIME = 2**61 - 1
Column = list[int]


@dataclass(frozen=True)
class Matrices:
    """What an `ExactGrasp` reads of its matrices."""

    j: tuple[tuple[int, ...], ...]
    gt: tuple[tuple[int, ...], ...]
    actuated: tuple[str, ...]
    passive: tuple[str, ...]
    twist_size: int

    @property
    def freedoms(self) -> tuple[str, ...]:
        return (*self.actuated, *self.passive)

    @property
    def held(self) -> int:
        return len(self.j)


@dataclass(frozen=True)
class Modulus:
    """The ring, of which only the prime counts here."""

    prime: int = PRIME


@dataclass(frozen=True)
class Drawn:
    """Columns of J_a, J_p and Gᵀ as integers."""

    rows: int
    a: list[Column]
    p: list[Column]
    o: list[Column]

    def columns(self, parts: str) -> list[Column]:
        signs = {"a": (self.a, 1), "p": (self.p, 1), "o": (self.o, -1)}
        return [
            [sign * x for x in column]
            for part in parts
            for columns, sign in (signs[part],)
            for column in columns
        ]

    def rank(self, parts: str) -> int:
        """Over the rationals, by FLINT's elimination of fractions."""
        columns = self.columns(parts)
        return fmpq_mat(columns).rank() if columns and self.rows else 0

    def exact(self) -> ExactGrasp:
        joints: Any = tuple(zip(*self.a, *self.p, strict=True))
        twists: Any = tuple(zip(*self.o, strict=True))
        matrices: Any = Matrices(
            _residues(joints, self.rows),
            _residues(twists, self.rows),
            tuple(f"a{i}" for i in range(len(self.a))),
            tuple(f"p{i}" for i in range(len(self.p))),
            len(self.o),
        )
        ring: Any = Modulus()
        field: Any = None
        return ExactGrasp(matrices, ring, {}, field)


def _residues(rows: Any, count: int) -> tuple[tuple[int, ...], ...]:
    found = tuple(tuple(x % PRIME for x in row) for row in rows)
    return found or ((),) * count


def grasp(seed: int) -> Drawn:
    """Columns out of one small space, so that their spans overlap."""
    source = random.Random(seed)
    rows, twists = source.randint(1, 9), source.choice([3, 6])
    space = [
        [source.randint(-3, 3) for _ in range(rows)]
        for _ in range(source.randint(1, rows))
    ]

    def column() -> Column:
        shares = [source.choice([0, 0, 1, -1, 2]) for _ in space]
        return [
            sum(s * v[i] for s, v in zip(shares, space, strict=True))
            for i in range(rows)
        ]

    return Drawn(
        rows,
        [column() for _ in range(source.randint(0, 4))],
        [column() for _ in range(source.randint(0, 5))],
        [column() for _ in range(twists)],
    )


grasps = st.integers(0, 10**6).map(grasp)
