"""A motion followed from its posture as power series: how far the loops stay closed.

As many loop equations as their rank define a smooth curve through the posture, whose
joint parameters are series modulo a prime.  The first order at which another equation
fails on the curve proves that the curve is no motion.  If none fails up to the number
of points in which the curve could meet the equation at all, all hold identically.

References: [Shafarevich2013] ch. 4 §1 (intersection numbers).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from screwkit.algebra.series_modulo import Series, SeriesRing, first_order
from screwkit.finite.chain_graph import ChainGraph, Cycle
from screwkit.finite.lie_closure import ResidueScrew, Span

_Dual: TypeAlias = tuple[Series, ...]
"""A dual quaternion: scalar and vector part, then the same of the dual part."""

_VECTOR = (1, 2, 3, 5, 6, 7)
"""Parts that vanish for the identity; to first order (ω; v)."""


@dataclass(frozen=True)
class Curve:
    """Loop equations chosen to define a curve of postures, and those left to check.

    Attributes:
        graph: A block.
        cycles: A basis of its loops.
        rows: Numbers of the equations that define the curve, six a loop.
        others: Numbers of the equations left.
        dependent: The parameters that ``rows`` determine.
        direction: The rate of every other parameter along the curve.
    """

    graph: ChainGraph
    cycles: tuple[Cycle, ...]
    rows: tuple[int, ...]
    others: tuple[int, ...]
    dependent: tuple[int, ...]
    direction: Mapping[int, int]

    def order_of_failure(self, highest: int) -> int | None:
        """The first order at which an equation left fails; None up to ``highest``."""
        for left, order in self._followed(highest):
            orders = [first_order(value) for value in left]
            found = min((k for k in orders if k is not None), default=None)
            if found is not None or order > highest:
                return found if found is not None and found <= highest else None
        return None

    def failing_by(self, order: int) -> list[int]:
        """The coefficients of the equations left at an order, where none is before."""
        *_, (left, _) = self._followed(order)
        return [int(value[order]) for value in left]

    def _followed(self, highest: int) -> Iterator[tuple[list[Series], int]]:
        """The equations left along the curve, cut off at orders that double."""
        prime = self.graph.prime
        jacobian = self._constant_jacobian()
        inverse = _inverse(jacobian, prime)
        ring = SeriesRing(prime, 2)
        zero = ring.series([])
        x = [zero] * self.graph.width
        for parameter, rate in self.direction.items():
            x[parameter] = ring.series([0, rate])
        y = [[ring.series([entry]) for entry in row] for row in inverse]
        while True:
            left = _Loops(self, ring, x).values(self.rows)
            for parameter, row in zip(self.dependent, y, strict=True):
                x[parameter] = x[parameter] - _dot(ring, row, left)
            loops = _Loops(self, ring, x)
            yield loops.values(self.others), ring.order
            if ring.order > highest:
                return
            # Newton: X ← X (2 − J X) keeps the inverse as long as the solution is.
            product = _product(ring, loops.jacobian(), y)
            for i, row in enumerate(product):
                for j, entry in enumerate(row):
                    row[j] = ring.series([2 * int(i == j)]) - entry
            y = _product(ring, y, product)
            ring = SeriesRing(prime, min(2 * ring.order, highest + 1))

    def _constant_jacobian(self) -> list[list[int]]:
        rows = self.graph.closure_rows(self.cycles)
        return [[rows[k].get(p, 0) for p in self.dependent] for k in self.rows]

    def bound(self) -> int | None:
        """Order beyond which no equation can fail; None where it is not known.

        Equations are linear in each parameter, so the curve is cut out in a product of
        projective lines, and Bézout's number of its points on one more equation is the
        permanent of the matrix that tells which parameters occur where.
        """
        graph = self.graph
        if graph.width > 12 or any(
            _is_helix(e.screw, graph.prime) for e in graph.edges
        ):
            return None
        occurs = [frozenset(p for p, _ in graph.word(c)) for c in self.cycles]
        supports = [occurs[k // 6] for k in self.rows]
        first, *rest = self.direction
        supports += [frozenset({first, p}) for p in rest]
        last = {occurs[k // 6] for k in self.others}
        return max((_permanent([*supports, s], graph.width) for s in last), default=0)


def curve(graph: ChainGraph, rates: Mapping[int, int] | None = None) -> Curve:
    """The curve through the posture in the direction of some rates.

    Args:
        graph: A block with at least one motion.
        rates: A generic combination of all rates where absent.
    """
    cycles = sorted(graph.simple_cycles(60), key=len)
    basis: list[Cycle] = []
    span = Span(graph.prime)
    for cycle in cycles:
        vector = [0] * len(graph.edges)
        for number, sign in cycle:
            vector[number] += sign
        if span.add(vector):
            basis.append(cycle)
    rows = graph.closure_rows(basis)
    dense = [[row.get(p, 0) for p in range(graph.width)] for row in rows]
    chosen, kept = Span(graph.prime), list[int]()
    for number, row in enumerate(dense):
        if any(row) and chosen.add(row):
            kept.append(number)
    columns, dependent = Span(graph.prime), list[int]()
    for parameter in range(graph.width):
        if columns.add([dense[k][parameter] for k in kept]):
            dependent.append(parameter)
    free = [p for p in range(graph.width) if p not in dependent]
    generic = {p: pow(3, 17 + 5 * k, graph.prime) for k, p in enumerate(free)}
    direction = generic if rates is None else {p: rates.get(p, 0) for p in free}
    others = tuple(k for k in range(len(rows)) if k not in kept)
    return Curve(graph, tuple(basis), tuple(kept), others, tuple(dependent), direction)


class _Loops:
    """Displacements of all loops along series of the parameters."""

    def __init__(self, at: Curve, ring: SeriesRing, x: Sequence[Series]) -> None:
        self.curve, self.ring = at, ring
        self._factors = []
        for cycle in at.cycles:
            word = at.graph.word(cycle)
            factors = [(p, _factor(ring, s, x[p], at.graph.prime)) for p, s in word]
            self._factors.append(factors)
        self._before = []
        for factors in self._factors:
            products = [_one(ring)]
            for _, factor in factors:
                products.append(factor.behind(products[-1]))
            self._before.append(products)

    def values(self, rows: Sequence[int]) -> list[Series]:
        """The equations of these numbers."""
        return [self._before[k // 6][-1][_VECTOR[k % 6]] for k in rows]

    def jacobian(self) -> list[list[Series]]:
        """Derivatives of the curve's equations in its dependent parameters."""
        at, ring = self.curve, self.ring
        needed = {k // 6 for k in at.rows}
        found: dict[tuple[int, int], _Dual] = {}
        for loop in needed:
            after = _one(ring)
            before = self._before[loop]
            for number in reversed(range(len(self._factors[loop]))):
                parameter, factor = self._factors[loop][number]
                if parameter in at.dependent:
                    part = factor.slope_behind(before[number])
                    entry = _times(ring, part, after)
                    known = found.get((loop, parameter))
                    if known is not None:
                        entry = tuple(a + b for a, b in zip(known, entry, strict=True))
                    found[loop, parameter] = entry
                after = factor.before(after)
        zero = (ring.series([]),) * 8
        return [
            [found.get((k // 6, p), zero)[_VECTOR[k % 6]] for p in at.dependent]
            for k in at.rows
        ]


@dataclass(frozen=True)
class _Turn:
    """1 + xX with a line X: eight products of series in place of 48.

    It is a rotation through 2 atan(x|ω|) or a translation by 2xv, without its length.
    """

    ring: SeriesRing
    line: ResidueScrew
    x: Series

    def behind(self, product: _Dual) -> _Dual:
        """A product with this factor after it."""
        return self._plus(product, self.slope_behind(product))

    def before(self, product: _Dual) -> _Dual:
        """A product with this factor ahead of it."""
        w, v = self.line[:3], self.line[3:]
        real, dual = product[:4], product[4:]
        sums = zip(_line_times(w, dual), _line_times(v, real), strict=True)
        return self._plus(product, (*_line_times(w, real), *(a + b for a, b in sums)))

    def slope_behind(self, product: _Dual) -> _Dual:
        """A product with the derivative in x after it."""
        w, v = self.line[:3], self.line[3:]
        real, dual = product[:4], product[4:]
        sums = zip(_times_line(dual, w), _times_line(real, v), strict=True)
        return (*_times_line(real, w), *(a + b for a, b in sums))

    def _plus(self, product: _Dual, change: _Dual) -> _Dual:
        times, x = self.ring.times, self.x
        pairs = zip(product, change, strict=True)
        return tuple(a + times(x, b) if b.length() else a for a, b in pairs)


@dataclass(frozen=True)
class _Helix:
    """A factor that advances as it turns, and its derivative in x."""

    ring: SeriesRing
    value: _Dual
    slope: _Dual

    def behind(self, product: _Dual) -> _Dual:
        """A product with this factor after it."""
        return _times(self.ring, product, self.value)

    def before(self, product: _Dual) -> _Dual:
        """A product with this factor ahead of it."""
        return _times(self.ring, self.value, product)

    def slope_behind(self, product: _Dual) -> _Dual:
        """A product with the derivative after it."""
        return _times(self.ring, product, self.slope)


def _times_line(q: Sequence[Series], w: Sequence[int]) -> tuple[Series, ...]:
    """The quaternion (a, b, c, d) times the vector w."""
    (a, b, c, d), (x, y, z) = q, w
    return (
        -(x * b + y * c + z * d),
        x * a + z * c - y * d,
        y * a + x * d - z * b,
        z * a + y * b - x * c,
    )


def _line_times(w: Sequence[int], q: Sequence[Series]) -> tuple[Series, ...]:
    """The vector w times the quaternion (a, b, c, d)."""
    (x, y, z), (a, b, c, d) = w, q
    return (
        -(x * b + y * c + z * d),
        x * a + y * d - z * c,
        y * a + z * b - x * d,
        z * a + x * c - y * b,
    )


def _factor(
    ring: SeriesRing, screw: ResidueScrew, x: Series, prime: int
) -> _Turn | _Helix:
    """1 + xX with the line X, with the advance of a helix."""
    w, v = screw[:3], screw[3:]
    square = sum(a * a for a in w) % prime
    pitch = 0
    if square:
        pitch = sum(a * b for a, b in zip(w, v, strict=True)) * pow(square, -1, prime)
    moment = [(b - pitch * a) % prime for a, b in zip(w, v, strict=True)]
    turn = _Turn(ring, (*w, *moment), x)
    if not pitch % prime:
        return turn
    advance = ring.scaled_arctangent(x, square)
    speed = ring.reciprocal(1 + square * ring.times(x, x))
    zero, one = ring.series([]), ring.series([1])
    along = [pitch * a % prime for a in w]
    shift = (one, zero, zero, zero, zero, *(a * advance for a in along))
    rate = (zero,) * 5 + tuple(a * speed for a in along)
    value, slope = turn.behind(_one(ring)), turn.slope_behind(_one(ring))
    return _Helix(
        ring,
        _times(ring, value, shift),
        tuple(
            a + b
            for a, b in zip(
                _times(ring, slope, shift), _times(ring, value, rate), strict=True
            )
        ),
    )


def _one(ring: SeriesRing) -> _Dual:
    return (ring.series([1]), *(ring.series([]) for _ in range(7)))


def _times(ring: SeriesRing, left: _Dual, right: _Dual) -> _Dual:
    real = _quaternion(ring, left[:4], right[:4])
    one = _quaternion(ring, left[:4], right[4:])
    two = _quaternion(ring, left[4:], right[:4])
    return (*real, *(a + b for a, b in zip(one, two, strict=True)))


def _quaternion(ring: SeriesRing, p: _Dual, q: _Dual) -> _Dual:
    (a, b, c, d), (e, f, g, h) = p, q
    t = ring.times
    return (
        t(a, e) - t(b, f) - t(c, g) - t(d, h),
        t(a, f) + t(b, e) + t(c, h) - t(d, g),
        t(a, g) - t(b, h) + t(c, e) + t(d, f),
        t(a, h) + t(b, g) - t(c, f) + t(d, e),
    )


def _dot(ring: SeriesRing, left: Sequence[Series], right: Sequence[Series]) -> Series:
    total = ring.series([])
    for a, b in zip(left, right, strict=True):
        if a.length() and b.length():
            total = total + ring.times(a, b)
    return total


def _product(
    ring: SeriesRing,
    left: Sequence[Sequence[Series]],
    right: Sequence[Sequence[Series]],
) -> list[list[Series]]:
    columns = list(zip(*right, strict=True))
    return [[_dot(ring, row, column) for column in columns] for row in left]


def _inverse(matrix: Sequence[Sequence[int]], prime: int) -> list[list[int]]:
    """Of a regular matrix of residues, by elimination."""
    size = len(matrix)
    rows = [[*row, *(int(i == j) for j in range(size))] for i, row in enumerate(matrix)]
    for column in range(size):
        pivot = next(i for i in range(column, size) if rows[i][column])
        rows[column], rows[pivot] = rows[pivot], rows[column]
        unit = pow(rows[column][column], -1, prime)
        rows[column] = [x * unit % prime for x in rows[column]]
        for i in range(size):
            factor = rows[i][column]
            if i != column and factor:
                rows[i] = [
                    (x - factor * y) % prime
                    for x, y in zip(rows[i], rows[column], strict=True)
                ]
    return [row[size:] for row in rows]


def _is_helix(screw: ResidueScrew, prime: int) -> bool:
    return sum(a * b for a, b in zip(screw[:3], screw[3:], strict=True)) % prime != 0


def _permanent(supports: Sequence[frozenset[int]], width: int) -> int:
    """Ways to give each equation a parameter of its own that occurs in it."""
    ways = {0: 1}
    for support in supports:
        grown: dict[int, int] = {}
        for used, count in ways.items():
            for parameter in support:
                if not used >> parameter & 1:
                    key = used | 1 << parameter
                    grown[key] = grown.get(key, 0) + count
        ways = grown
    return ways.get((1 << width) - 1, 0)
