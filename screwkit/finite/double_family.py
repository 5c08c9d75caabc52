"""One equation left that vanishes twice on a family of closed postures.

Where all rates are good to second order, and beyond first order one equation f = 0 is
left in the m rates, let F be a smooth family of dimension m − 1, given by w = 0, on
which the rank is that of the posture.  Then f vanishes on F with its first derivatives:
f = w² g.  Its first form, of degree k, is that of w squared times that of g.

* For k = 3 the form of g is linear, so that g = 0 is smooth too.
* For k = 4 it is quadratic.  If it takes both signs, then g = x² − y² + h(z) in
  suitable coordinates, and the zeros of g have dimension m − 1 wherever they are.

Every branch then has dimension m − 1.  Wren's platform on four equal legs is of this
kind: it translates, or it turns and may shift one way.

References: [GolubitskySchaeffer1985] §I.3, [ConnellyWhiteley1996].
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement

from screwkit.algebra.modular import annihilator
from screwkit.algebra.series_modulo import double_root
from screwkit.finite.chain_graph import ChainGraph
from screwkit.finite.closing_groups import Closing, smooth_subfamilies
from screwkit.finite.higher_order import Form
from screwkit.finite.loop_series import curve
from screwkit.finite.only_family import rank_on

LARGEST = 6
"""Dimension of the rates up to which forms of degree four are looked at."""


@dataclass(frozen=True)
class DoubleFamily:
    """A family on which the one equation left vanishes twice.

    Attributes:
        closing: The family.
        rest: The form of the other factor in the basis of the rates, up to a factor;
            None where it is linear.
    """

    closing: Closing
    rest: Form | None


def double_family(block: ChainGraph, order: int) -> DoubleFamily | None:
    """The family, if the one equation left vanishes twice on one.

    Args:
        block: With one equation beyond its rank.
        order: The first at which a generic motion fails.
    """
    mobility = block.mobility
    if order not in (3, 4) or not 1 < mobility <= LARGEST:
        return None
    form = _FirstForm(block, order)
    across = _twice(form)
    if across is None:
        return None
    rates = [
        form.rates(vector) for vector in annihilator([across], mobility, block.prime)
    ]
    for family in smooth_subfamilies(block, rates):
        if rank_on(block, family) == block.rank:
            rest = None if order == 3 else _rest(form, across)
            return DoubleFamily(family, rest)
    return None


class _FirstForm:
    """The form of the least degree of the equation left, by its values."""

    def __init__(self, block: ChainGraph, order: int) -> None:
        self.block, self.order = block, order
        self._source = random.Random(order)
        left = self._coefficients(self.vector())
        self._row = next(number for number, value in enumerate(left) if value)

    def vector(self) -> list[int]:
        """Random coordinates in the basis of the rates."""
        block = self.block
        return [self._source.randrange(1, block.prime) for _ in range(block.mobility)]

    def rates(self, vector: Sequence[int]) -> Mapping[int, int]:
        """The rates of these coordinates."""
        total: dict[int, int] = {}
        for factor, own in zip(vector, self.block.rates, strict=True):
            for parameter, rate in own.items():
                value = total.get(parameter, 0) + factor * rate
                total[parameter] = value % self.block.prime
        return {p: x for p, x in total.items() if x}

    def __call__(self, vector: Sequence[int]) -> int:
        """Its value."""
        return self._coefficients(vector)[self._row]

    def _coefficients(self, vector: Sequence[int]) -> list[int]:
        return curve(self.block, self.rates(vector)).failing_by(self.order)


def _twice(form: _FirstForm) -> list[int] | None:
    """The linear form whose square divides another, if just one does."""
    prime, mobility = form.block.prime, form.block.mobility
    zeros = []
    for _ in range(mobility):
        start, way = form.vector(), form.vector()
        values = [
            form([(x + k * y) % prime for x, y in zip(start, way, strict=True)])
            for k in range(form.order + 1)
        ]
        root = double_root(values, prime)
        if root is None:
            return None
        zeros.append([(x + root * y) % prime for x, y in zip(start, way, strict=True)])
    across = annihilator(zeros, mobility, prime)
    return list(across[0]) if len(across) == 1 else None


def _rest(form: _FirstForm, across: Sequence[int]) -> Form | None:
    """The quadratic form that is left of one of degree four."""
    prime, mobility = form.block.prime, form.block.mobility
    pairs = list(combinations_with_replacement(range(mobility), 2))
    rows = []
    for _ in range(len(pairs) + 2):
        at = form.vector()
        width = sum(x * y for x, y in zip(across, at, strict=True))
        value = form(at) * pow(width, -2, prime) % prime
        rows.append([*(at[i] * at[j] % prime for i, j in pairs), -value % prime])
    found = annihilator(rows, len(pairs) + 1, prime)
    if len(found) != 1 or not found[0][-1]:
        return None
    entries = dict(zip(pairs, found[0], strict=False))
    half = pow(2, -1, prime)
    return tuple(
        tuple(
            entries[min(i, j), max(i, j)] * (1 if i == j else half) % prime
            for j in range(mobility)
        )
        for i in range(mobility)
    )
