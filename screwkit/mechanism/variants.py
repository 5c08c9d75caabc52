"""Variants of a mechanism: other values of its symbols, with claims of their own.

A variant changes numbers only, never topology or symbols: what holds for every value
holds for it, and what is special about its values shows beside that.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import symbols_of
from screwkit.algebra.names import shown
from screwkit.mechanism.claim_entries import read_claims
from screwkit.mechanism.model import Mechanism, Variant
from screwkit.mechanism.nodes import Path
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.schema import VariantEntry
from screwkit.mechanism.structure import Draft, subject
from screwkit.mechanism.symbols import (
    Declared,
    check_assumptions,
    closed_values_of,
)

_NAME: Final = re.compile(r"[A-Za-z0-9_-]{1,80}")


def read_variants(
    draft: Draft, declared: Declared, reading: Reading
) -> tuple[Variant, ...]:
    """The variants of a file, with closed values for all that changes."""
    found = []
    for name, entry in draft.entry.variants.items():
        path: Path = ("variants", name)
        if not _NAME.fullmatch(name):
            reading.fault_at_key(
                path,
                f"variants: {shown(name)} is no name: up to 80 letters, digits, _, -",
            )
        values = _values(name, entry, declared, reading)
        claims = read_claims(entry.expected, (*path, "expected"), reading)
        found.append(Variant(name, entry.title or name, values, claims))
    return tuple(found)


def _values(
    name: str, entry: VariantEntry, declared: Declared, reading: Reading
) -> dict[str, Expression]:
    own: dict[str, Expression] = {}
    known = {parameter.name for parameter in declared.parameters}
    for symbol, text in entry.values.items():
        path: Path = ("variants", name, "values", symbol)
        if symbol not in known:
            if symbol not in reading.lost:
                reading.fault_at_key(path, _stranger(symbol, known, reading))
            continue
        value = reading.scalar(path, text)
        if value is None:
            continue
        if used := sorted(symbols_of(value)):
            reading.fault(
                path, f"the value contains the symbol {used[0]!r}; a number is expected"
            )
        else:
            own[symbol] = value
    _check_changed(own, name, declared, reading)
    return own


def _stranger(symbol: str, known: set[str], reading: Reading) -> str:
    if symbol in reading.joint_variables:
        return (
            f"variants: {symbol!r} is a joint variable; a variant changes parameters "
            f"and variables of the file"
        )
    return f"variants: unknown symbol {shown(symbol)}{reading.nearest(symbol, known)}"


def _check_changed(
    own: dict[str, Expression], name: str, declared: Declared, reading: Reading
) -> None:
    """Check the variant's values, and those of parameters computed from them."""
    closed, _ = closed_values_of({**declared.written, **own})
    for parameter in declared.parameters:
        symbol = parameter.name
        path: Path = ("variants", name, "values")
        if symbol in own:
            path = (*path, symbol)
        elif closed.get(symbol) in {None, parameter.value}:
            continue
        check_assumptions(replace(parameter, value=closed[symbol]), path, reading)


def check_values(
    declared: Declared, variants: Sequence[Variant], reading: Reading
) -> None:
    """Report what fails at the values of the file, or of a variant alone."""
    own, _ = closed_values_of(declared.written)
    sound = []
    for path, requirement in reading.required:
        if requirement.fails_at(own):
            reading.fault(path, requirement.message(" at the values of the file"))
        else:
            sound.append((path, requirement, requirement.symbols))
    for variant in variants:
        holder: Path = ("variants", variant.name, "values")
        where = f" at the values of variant {variant.name!r}"
        values, _ = closed_values_of({**declared.written, **variant.values})
        changed = {name for name, value in values.items() if own.get(name) != value}
        for path, requirement, symbols in sound:
            if symbols & changed and requirement.fails_at(values):
                what = f"{subject(reading.root, path)}: {requirement.message(where)}"
                reading.faults.add(reading.place(holder), what)


def at_variant(mechanism: Mechanism, variant: Variant) -> Mechanism:
    """The mechanism at the values of one of its variants, with that one's claims.

    The value of a parameter that is computed from others follows.
    """
    written = {**mechanism.written, **variant.values}
    values, _ = closed_values_of(written)
    return replace(
        mechanism,
        title=": ".join(filter(None, (mechanism.title, variant.title))),
        parameters=tuple(
            replace(parameter, value=values.get(parameter.name, parameter.value))
            for parameter in mechanism.parameters
        ),
        claims=variant.claims,
        written=written,
    )
