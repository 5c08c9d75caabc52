"""Other ways to the same determinants, each in a process that can be ended.

sympy's DomainMatrix over Q[s, c, parameters]: determinants as the last coefficient of
the characteristic polynomial (its fastest route), reduced by s² + c² = 1 and factored.
Whole limbs start from the table, as a user of sympy would: nothing is reduced before
the determinants.  Single determinants get our own twists, already in normal form, which
favours sympy about tenfold.
"""

from __future__ import annotations

import multiprocessing
import time
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

Terms = dict[tuple[int, ...], Fraction]


def as_terms(polynomial: Any) -> Terms:
    """Plain terms of a FLINT polynomial."""
    return {
        tuple(int(e) for e in exponents): Fraction(int(c.p), int(c.q))
        for exponents, c in polynomial.to_dict().items()
    }


def _work(pipe: Any, names: Sequence[str], matrices: Any, factor: bool) -> None:
    from sympy import QQ, ring
    from sympy.polys.matrices import DomainMatrix

    field, *_ = ring(names, QQ)
    gens = dict(zip(names, field.gens, strict=True))
    relations = [
        gens[f"s{name[1:]}"] ** 2 + gen**2 - 1
        for name, gen in gens.items()
        if name.startswith("c")
    ]
    built = [
        [[field.from_dict({e: QQ(c.numerator, c.denominator) for e, c in x.items()})
          for x in row] for row in matrix]
        for matrix in matrices
    ]  # fmt: skip
    start = time.perf_counter()
    for rows in built:
        matrix = DomainMatrix(rows, (len(rows), len(rows)), field.to_domain())
        value = matrix.charpoly()[-1]
        value = value.rem(relations) if relations else value
        if factor and value:
            value.factor_list()
    pipe.send(time.perf_counter() - start)


def domain_matrix_seconds(
    names: Sequence[str],
    matrices: Sequence[Sequence[Sequence[Terms]]],
    *,
    factor: bool,
    timeout: float,
) -> tuple[float, bool]:
    """Seconds that sympy takes, and whether it finished; else the timeout."""
    return _timed(_work, (names, matrices, factor), timeout)


def _limb(pipe: Any, rows: Sequence[Sequence[str]]) -> None:
    from itertools import combinations

    import sympy as sp
    from sympy.polys.matrices import DomainMatrix

    start = time.perf_counter()
    at, columns, relations = sp.eye(4), [], []
    for number, (alpha_text, *cells, offset_text) in enumerate(rows):
        b, d, r = (sp.sympify(x) for x in cells)
        alpha, offset = sp.sympify(alpha_text), sp.sympify(offset_text)
        c, s = sp.symbols(f"c_{number} s_{number}")
        relations.append((c, s))
        c, s = (
            c * sp.cos(offset) - s * sp.sin(offset),
            s * sp.cos(offset) + c * sp.sin(offset),
        )
        ca, sa = sp.cos(alpha), sp.sin(alpha)
        step = [
            [c, -s, 0, d],
            [ca * s, ca * c, -sa, -r * sa],
            [sa * s, sa * c, ca, r * ca + b],
            [0, 0, 0, 1],
        ]
        at = (at * sp.Matrix(step)).applyfunc(sp.expand)
        axis, point = at[:3, 2], at[:3, 3]
        columns.append([*axis, *point.cross(axis)])
    twists = DomainMatrix.from_Matrix(sp.Matrix(columns).applyfunc(sp.expand))
    domain = twists.domain
    circle = [
        domain.ring.from_expr(c**2 + s**2 - 1)
        for c, s in relations
        if {c, s} <= set(domain.symbols)
    ]
    width = min(6, len(columns))
    for chosen in combinations(range(len(columns)), width):
        for coordinates in combinations(range(6), width):
            value = twists.extract(list(chosen), list(coordinates)).charpoly()[-1]
            value = value.rem(circle)
            if value:
                value.factor_list()
    pipe.send(time.perf_counter() - start)


def limb_route_seconds(
    rows: Sequence[Sequence[str]], timeout: float
) -> tuple[float, bool]:
    """A limb from its table to factored minors in sympy alone, and whether it ended.

    Args:
        rows: alpha, b, d, r and offset of each revolute joint, base first.
        timeout: Seconds after which it is given up.
    """
    return _timed(_limb, (rows,), timeout)


def _timed(
    work: Callable[..., None], arguments: tuple[Any, ...], timeout: float
) -> tuple[float, bool]:
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=work, args=(theirs, *arguments))
    process.start()
    done = ours.poll(timeout)
    seconds = float(ours.recv()) if done else timeout
    process.kill()
    process.join()
    return seconds, bool(done)


def best(
    action: Callable[[], object],
    repeats: int = 3,
    clock: Callable[[], float] = time.perf_counter,
) -> float:
    """The shortest of several runs, in seconds of a clock."""
    times = []
    for _ in range(repeats):
        start = clock()
        action()
        times.append(clock() - start)
    return min(times)


def say(text: str) -> None:
    """Print a figure, set apart from the dots of the tests."""
    print(f"\n    {text}")
