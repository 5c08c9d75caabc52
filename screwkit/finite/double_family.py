"""Equations left that vanish twice on a family of closed postures.

Where all rates are good to second order, and beyond first order one equation f = 0 is
left in the m rates, let F be a smooth family of dimension m − 1, given by w = 0, on
which the rank is that of the posture.  Then f vanishes on F with its first derivatives:
f = w² g.  Its first form, of degree k, is that of w squared times that of g.

* For k = 3 the form of g is linear, so that g = 0 is smooth too.
* For k = 4 it is quadratic.  If it takes both signs, then g = x² − y² + h(z) in
  suitable coordinates, and the zeros of g have dimension m − 1 wherever they are.

Every branch then has dimension m − 1.  Wren's platform on four equal legs is of this
kind: it translates, or it turns and may shift one way.

Of two equations f = w² g for m = 3 both other factors must vanish beside F.  Let their
forms be binary, in u = (x, y), and map a circle around 0 twice around it.  For every
small z the map u ↦ g(u, z) then has the degree ±2, and a zero; complex zeros are no
more, because the forms have none in common but u = 0.  With z not in F these branches
of dimension 1 lie beside F.  Wren's platform on five legs turns so, and rises.

References: [GolubitskySchaeffer1985] §I.3, [ConnellyWhiteley1996].
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations_with_replacement
from typing import TypeAlias

from screwkit.algebra.modular import annihilator
from screwkit.algebra.series_modulo import double_root
from screwkit.finite.chain_graph import ChainGraph
from screwkit.finite.closing_groups import Closing, smooth_subfamilies
from screwkit.finite.higher_order import Form
from screwkit.finite.lie_closure import Span
from screwkit.finite.loop_series import curve
from screwkit.finite.only_family import rank_on

LARGEST = 6
"""Dimension of the rates up to which forms of degree four are looked at."""


Known: TypeAlias = dict[tuple[int, ...], list[int]]
"""Values of all equations left by the coordinates of rates: all forms share them."""


@dataclass(frozen=True)
class DoubleFamily:
    """A family on which the equations left vanish twice.

    Attributes:
        closing: The family.
        rest: The forms of the other factors in the basis of the rates, up to a factor
            each; empty where they are linear.
        crossed: Whether the forms depend on two linear ones alone, and the line on
            which these vanish is not in the family.
    """

    closing: Closing
    rest: tuple[Form, ...]
    crossed: bool = False


def double_family(block: ChainGraph, order: int, left: int) -> DoubleFamily | None:
    """The family, if the equations left vanish twice on one.

    Args:
        block: With one or two equations beyond its rank.
        order: The first at which a generic motion fails.
        left: How many equations there are beyond the rank.
    """
    mobility = block.mobility
    if order not in (3, 4) or not 1 < mobility <= LARGEST:
        return None
    if left != 1 and (left, order, mobility) != (2, 4, 3):
        return None
    forms = _first_forms(block, order)
    if len(forms) != left:
        return None
    found = [_twice(form) for form in forms]
    across = found[0]
    if across is None or any(other != across for other in found):
        return None
    form = forms[0]
    rates = [
        form.rates(vector) for vector in annihilator([across], mobility, block.prime)
    ]
    for family in smooth_subfamilies(block, rates):
        if rank_on(block, family) == block.rank:
            rest = [] if order == 3 else [_rest(form, across) for form in forms]
            known = tuple(each for each in rest if each is not None)
            crossed = len(known) == 2 and _crossed(known, across, block.prime)
            whole = len(known) == len(rest)
            return DoubleFamily(family, known if whole else (), crossed)
    return None


def _crossed(forms: Sequence[Form], across: Sequence[int], prime: int) -> bool:
    rows = [row for form in forms for row in form]
    lines = annihilator(rows, len(across), prime)
    if len(lines) != len(across) - 2:
        return False
    return any(
        sum(x * y for x, y in zip(across, line, strict=True)) % prime for line in lines
    )


def _first_forms(block: ChainGraph, order: int) -> list[_FirstForm]:
    """One for each equation whose form is independent of those before."""
    known: Known = {}
    probe = _FirstForm(block, order, 0, known)
    values = [probe.all(probe.vector()) for _ in range(block.mobility + 2)]
    span, chosen = Span(block.prime), list[int]()
    for number, column in enumerate(zip(*values, strict=True)):
        if span.add(column):
            chosen.append(number)
    return [_FirstForm(block, order, number, known) for number in chosen]


class _FirstForm:
    """The form of the least degree of one of the equations left, by its values."""

    def __init__(self, block: ChainGraph, order: int, row: int, known: Known) -> None:
        self.block, self.order, self._row = block, order, row
        self._known = known
        self._source = random.Random(order)

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
        return self.all(vector)[self._row]

    def all(self, vector: Sequence[int]) -> list[int]:
        """The values of all equations left."""
        key = tuple(vector)
        if key not in self._known:
            along = curve(self.block, self.rates(vector))
            self._known[key] = along.failing_by(self.order)
        return self._known[key]


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
    if len(across) != 1:
        return None
    unit = pow(next(x for x in across[0] if x), -1, prime)
    return [x * unit % prime for x in across[0]]


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
