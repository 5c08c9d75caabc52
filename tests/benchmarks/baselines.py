"""Other ways to the same determinants, each in a process that can be ended.

sympy's DomainMatrix over Q[s, c, parameters]: determinants as the last coefficient of
the characteristic polynomial (its fastest route), reduced by s² + c² = 1 and factored.
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
    context = multiprocessing.get_context("spawn")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=_work, args=(theirs, names, matrices, factor))
    process.start()
    done = ours.poll(timeout)
    seconds = float(ours.recv()) if done else timeout
    process.kill()
    process.join()
    return seconds, bool(done)


def best(action: Callable[[], object], repeats: int = 3) -> float:
    """The shortest of several runs, in seconds."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        action()
        times.append(time.perf_counter() - start)
    return min(times)
