"""Exact polynomials of a `TrigonometricRing` as one fast numpy function.

The polynomials become straight-line code in which every common product is formed once;
it runs over the batch in chunks that stay in cache.  A `Compiled` holds plain terms, so
that it can be hashed and sent to another process; code is generated where it runs, from
identifiers of its own only: no name of a mechanism file enters it.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from hashlib import sha256
from typing import Any, Literal, TypeAlias

import numpy as np

from screwkit.algebra.angle_basis import AngleForm
from screwkit.algebra.batch import Array, BatchRing
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.expression import Expression
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing

Term: TypeAlias = tuple[tuple[int, ...], Fraction]
"""Exponents over the generators of a `Compiled`, and the coefficient."""

Nested: TypeAlias = Polynomial | Sequence[Any]
"""A polynomial, a row of them, a matrix of them, …"""

CHUNK = 2048
"""Postures at a time: temporaries of 16 kB stay in cache."""

TERMS_A_LINE = 16


@dataclass(frozen=True)
class Generator:
    """What a generator of the ring is as a number.

    Attributes:
        kind: ``sin`` or ``cos`` of a basis angle, a ``symbol``, the ``inverse`` or the
            ``root`` of an expression, or a ``constant``.
        angle: The basis angle, an integer combination of symbols and rationals.
        name: The symbol.
        of: The expression under the root or below the line.
        value: The constant.
    """

    kind: Literal["sin", "cos", "symbol", "inverse", "root", "constant"]
    angle: AngleForm = ()
    name: str = ""
    of: Expression | None = None
    value: float = 0.0

    def evaluated(self, ring: BatchRing) -> Array:
        """The number at the postures of ``ring``.

        Raises:
            UnknownNameError: If a symbol has no value.
        """
        if self.kind == "symbol":
            return ring.symbol(self.name)
        if self.kind == "constant":
            return np.asarray(self.value)
        if self.of is not None:
            inside = evaluate(self.of, ring)
            if self.kind == "root":
                return ring.square_root(self.of, inside)
            return ring.inverse(self.of, inside)
        total = np.asarray(0.0)
        for name, count in self.angle:
            total = total + count * _angle(name, ring)
        return np.asarray(np.sin(total) if self.kind == "sin" else np.cos(total))


@dataclass(frozen=True)
class Compiled:
    """Polynomials as a function of arrays; equal, hashed and pickled by their terms.

    Attributes:
        shape: The shape the polynomials were given in.
        generators: What the exponents of the terms refer to.
        polynomials: The terms of each polynomial, in row-major order.
    """

    shape: tuple[int, ...]
    generators: tuple[Generator, ...]
    polynomials: tuple[tuple[Term, ...], ...]

    def __call__(self, values: Mapping[str, Array | float]) -> Array:
        """The polynomials at one posture or many.

        Args:
            values: Joint variables and symbols by name; all given ones broadcast to the
                batch, whether the polynomials depend on them or not.

        Returns:
            Shape batch + `shape`; constants fill the batch like all others.

        Raises:
            UnknownNameError: If a needed name is missing.
        """
        ring = BatchRing(values)
        batch = np.broadcast_shapes(*(v.shape for v in ring.values.values()))
        size = math.prod(batch)
        inputs = [
            np.broadcast_to(value, batch).reshape(-1) if value.ndim else value
            for value in (generator.evaluated(ring) for generator in self.generators)
        ]
        result = np.empty((len(self.polynomials), size))
        for start in range(0, size, CHUNK):
            part = slice(start, min(start + CHUNK, size))
            chunk = [value[part] if value.ndim else value for value in inputs]
            self._function(chunk, result[:, part])
        return np.ascontiguousarray(result.T).reshape(batch + self.shape)

    def __getstate__(self) -> dict[str, Any]:
        """The terms alone; code is generated again where it is needed."""
        names = ("shape", "generators", "polynomials")
        return {name: self.__dict__[name] for name in names}

    @cached_property
    def source(self) -> str:
        """The generated code: a function ``fill(g, out)`` of chunks of the batch."""
        return "\n".join(("def fill(g, out):", *self._body(), "    return", ""))

    @cached_property
    def fingerprint(self) -> str:
        """A hash of what is computed, the same in every process."""
        text = f"{self.shape}\n{self.generators}\n{self.source}"
        return sha256(text.encode()).hexdigest()

    @cached_property
    def _function(self) -> Callable[[Sequence[Array], Array], None]:
        namespace: dict[str, Any] = {"__builtins__": {}}
        exec(compile(self.source, "<screwkit polynomials>", "exec"), namespace)
        function: Callable[[Sequence[Array], Array], None] = namespace["fill"]
        return function

    def _body(self) -> Iterator[str]:
        products: dict[tuple[int, ...], str] = {}
        for number in range(len(self.generators)):
            products[number,] = f"g{number}"
            yield f"    g{number} = g[{number}]"
        written: dict[tuple[Term, ...], int] = {}
        for place, terms in enumerate(self.polynomials):
            if terms in written:
                yield f"    out[{place}] = out[{written[terms]}]"
                continue
            written[terms] = place
            for exponents, _ in terms:
                yield from _formed(_factors(exponents), products)
            texts = [
                _term(products.get(_factors(exponents)), coefficient)
                for exponents, coefficient in terms
            ] or ["0.0"]
            yield f"    o = out[{place}]"
            for start in range(0, len(texts), TERMS_A_LINE):
                line = " + ".join(texts[start : start + TERMS_A_LINE])
                yield f"    o[:] = {line}" if start == 0 else f"    o += {line}"


def compile_polynomials(ring: TrigonometricRing, polynomials: Nested) -> Compiled:
    """Polynomials of ``ring``, in any nesting of lists and tuples, as a function.

    Square roots are taken ≥ 0; where a divisor of the geometry vanishes the values are
    infinite or nan.

    Raises:
        ValueError: If the nesting is ragged.
    """
    flat: list[Polynomial] = []
    shape = _flattened(polynomials, flat)
    tables = [
        {
            tuple(int(e) for e in exponents): Fraction(int(c.p), int(c.q))
            for exponents, c in polynomial.to_dict().items()
        }
        for polynomial in flat
    ]
    frequency = Counter(
        i
        for exponents in {key for table in tables for key in table}
        for i, exponent in enumerate(exponents)
        if exponent
    )
    # Frequent generators first: products are shared from their front.
    used = sorted(frequency, key=lambda i: (-frequency[i], i))
    known = _generators(ring)
    return Compiled(
        shape=shape,
        generators=tuple(known[ring.names[i]] for i in used),
        polynomials=tuple(
            tuple(
                sorted(
                    (tuple(exponents[i] for i in used), coefficient)
                    for exponents, coefficient in table.items()
                )
            )
            for table in tables
        ),
    )


def _generators(ring: TrigonometricRing) -> dict[str, Generator]:
    """Every generator of the ring by its internal name."""
    known: dict[str, Generator] = {}
    for i, form in enumerate(ring.basis):
        known[f"s{i}"] = Generator("sin", angle=tuple(form))
        known[f"c{i}"] = Generator("cos", angle=tuple(form))
    for i, name in enumerate(ring.symbols):
        known[f"x{i}"] = Generator("symbol", name=name)
    for extension in ring.extensions:
        kind: Literal["root", "inverse"] = (
            "root" if extension.kind == "root" else "inverse"
        )
        known[extension.name] = Generator(kind, of=extension.of)
    for name, text in ring.constant_generators.items():
        known[name] = Generator("constant", value=_constant(text))
    return known


def _constant(text: str) -> float:
    """The value of ``sqrt(3)`` or ``2*cos(pi/5)``, the texts of `ConstantField`."""
    number = int(text.rpartition("/")[2].rpartition("(")[2].rstrip(")"))
    return (
        math.sqrt(number) if text.startswith("sqrt") else 2 * math.cos(math.pi / number)
    )


def _angle(name: str, ring: BatchRing) -> Array:
    """A symbol, or a rational number of radians as `TrigonometricRing` writes it."""
    try:
        return np.asarray(float(Fraction(name)))
    except ValueError:
        return ring.symbol(name)


def _flattened(nested: Nested, flat: list[Polynomial]) -> tuple[int, ...]:
    if not isinstance(nested, list | tuple):
        flat.append(nested)
        return ()
    shapes = {_flattened(inner, flat) for inner in nested}
    if len(shapes) > 1:
        raise ValueError("rows of different length cannot be stacked")
    return (len(nested), *(shapes.pop() if shapes else ()))


def _factors(exponents: Sequence[int]) -> tuple[int, ...]:
    """The generators of a product, one by one."""
    return tuple(i for i, exponent in enumerate(exponents) for _ in range(exponent))


def _formed(
    factors: tuple[int, ...], products: dict[tuple[int, ...], str]
) -> Iterator[str]:
    """Code that forms a product from the longest front already formed."""
    for length in range(2, len(factors) + 1):
        front = factors[:length]
        if front not in products:
            name = f"m{len(products)}"
            yield f"    {name} = {products[front[:-1]]} * g{front[-1]}"
            products[front] = name


def _term(product: str | None, coefficient: Fraction) -> str:
    number = repr(float(coefficient))
    if product is None:
        return number
    if abs(coefficient) == 1:
        return product if coefficient > 0 else f"-{product}"
    return f"{number} * {product}"
