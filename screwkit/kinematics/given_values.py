"""Values from outside, by ``--set`` and ``--at``, put into a mechanism that takes them.

What a file demands of its symbols -- positive, not zero, axes that do not vanish, roots
that are real -- holds for values from outside as well: they are refused in the words
of the file before anything is computed.  Values computed from others follow them.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Final

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import substitute, symbols_of
from screwkit.algebra.names import did_you_mean, shown
from screwkit.algebra.parse import parse
from screwkit.errors import ExpressionError, UnfitValueError, UnknownNameError
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.values import declared_values, given_before, with_values
from screwkit.mechanism.model import Demand, Mechanism, Parameter
from screwkit.mechanism.requirements import Requirement, requirements_of
from screwkit.mechanism.symbols import closed_values_of, depending_on
from screwkit.mechanism.vanishing import is_zero
from screwkit.mechanism.weight_checks import weight_fault

_SOME: Final = 12
"""How many names a message lists."""


@dataclass(frozen=True)
class _Given:
    """Values from outside.

    Attributes:
        option: How a person gives them, ``--set`` or ``--at``.
        texts: As given, by name.
        values: The same as expressions.
    """

    option: str
    texts: Mapping[str, object]
    values: Mapping[str, Expression]

    def words(self, names: Collection[str]) -> str:
        """These values as a person wrote them."""
        written = (f"{self.option} {name}={self.texts[name]}" for name in names)
        return " ".join(written)


def with_numbers(mechanism: Mechanism, values: Mapping[str, object]) -> Mechanism:
    """The mechanism with numbers in the place of some of its symbols.

    Args:
        mechanism: As read, or at a variant.
        values: Numbers, or texts of constant expressions, by name.

    Raises:
        UnknownNameError: If a name is no symbol of the file.
        ExpressionError: If a value is no constant expression.
        UnfitValueError: If a value contradicts what the file demands.
    """
    joints = set(mechanism.joint_variables)
    known = [parameter.name for parameter in mechanism.parameters]
    read = {}
    for name, value in values.items():
        if name in joints:
            raise UnknownNameError(
                f"--set {name}={value}: {name!r} is a joint variable; --set gives "
                f"values to dimensions, --at to joint variables"
            )
        if name not in known:
            raise _no_symbol(mechanism, "--set", name, value, known)
        read[name] = _read("--set", name, value, ())
    return _filled(mechanism, _Given("--set", values, read))


def placed_at(
    mechanism: Mechanism, values: Mapping[str, object]
) -> tuple[Mechanism, dict[str, Expression]]:
    """The mechanism at a posture, and the values to which it has still to be moved.

    Raises:
        UnknownNameError: If a name is neither a joint variable nor a symbol.
        ExpressionError: If a value is no expression in the symbols of the file.
        UnfitValueError: If a value contradicts what the file demands.
    """
    joints = mechanism.joint_variables
    symbols = [parameter.name for parameter in mechanism.parameters]
    free = tuple(name for name in symbols if name not in values)
    moves = mechanism.geometry == "posture" or bool(why_tied(mechanism))
    held: dict[str, Expression] = {}
    wanted: dict[str, Expression] = {}
    for name, value in values.items():
        if name not in joints and name not in symbols:
            raise _no_symbol(mechanism, "--at", name, value, [*joints, *symbols])
        read = _read("--at", name, value, free)
        (wanted if moves and name in joints else held)[name] = read
    return _filled(mechanism, _Given("--at", values, held)), wanted


def _no_symbol(
    mechanism: Mechanism, option: str, name: str, value: object, known: Collection[str]
) -> UnknownNameError:
    found = f"{option} {name}={value}: no symbol {shown(name)}"
    if name in given_before(mechanism):
        return UnknownNameError(
            f"{option} {name}={value}: {name!r} has been given a value already (--set)"
        )
    hint = did_you_mean(name, known)
    if not hint:
        more = ", …" if len(known) > _SOME else ""
        listed = ", ".join([*known][:_SOME])
        hint = f"; it has {listed}{more}" if known else "; it has no symbols"
    return UnknownNameError(f"{found} in {mechanism.name}{hint}")


def _read(
    option: str, name: str, value: object, symbols: Collection[str]
) -> Expression:
    allowed = "a number or an expression of constants is expected"
    if symbols:
        allowed = "a number or an expression in the symbols of the file is expected"
    try:
        return parse(str(value), symbols)
    except ExpressionError as error:
        message = f"{option} {name}={value}: {error}; {allowed}"
        raise ExpressionError(message) from None


def _filled(mechanism: Mechanism, given: _Given) -> Mechanism:
    """The values put in, once they are found to fit."""
    if not given.values:
        return mechanism
    written = {**declared_values(mechanism), **mechanism.written, **given.values}
    closed, _ = closed_values_of(written)
    needs = {name: symbols_of(value) for name, value in written.items()}
    changed = depending_on(frozenset(given.values), needs)
    filled = replace(
        mechanism,
        parameters=tuple(
            replace(p, value=closed.get(p.name)) if p.name in changed else p
            for p in mechanism.parameters
        ),
        written=written,
    )
    for words, names in _contradictions(filled, given, closed, changed):
        causes = sorted(
            _causes(names & changed, given, needs), key=[*given.values].index
        )
        raise UnfitValueError(f"{given.words(causes)}: {words}")
    return with_values(filled, given.values)


def _causes(
    names: Collection[str], given: _Given, needs: Mapping[str, frozenset[str]]
) -> set[str]:
    """The given values on which these names depend."""
    return {
        cause
        for cause in given.values
        if depending_on(frozenset({cause}), needs) & frozenset(names)
    }


def _contradictions(
    mechanism: Mechanism,
    given: _Given,
    closed: Mapping[str, Expression],
    changed: frozenset[str],
) -> Iterator[tuple[str, frozenset[str]]]:
    """What the file demands and these values do not fulfil, with the symbols in it."""
    for value in given.values.values():
        for requirement in requirements_of(value):
            if _fails(requirement, {}, closed):
                yield requirement.words, requirement.symbols
    for parameter in mechanism.parameters:
        if parameter.name in changed and (words := _unlike(parameter)):
            yield words, frozenset({parameter.name})
    for demand in mechanism.demands:
        if demand.requirement.symbols & changed:
            yield from _demanded(demand, given, closed)
    for key, rows in mechanism.weights.items():
        symbols = frozenset(name for row in rows for x in row for name in symbols_of(x))
        if symbols & changed and (fault := weight_fault(rows, closed)):
            yield f"weights, {key}: {fault[1]}", symbols


def _demanded(
    demand: Demand, given: _Given, closed: Mapping[str, Expression]
) -> Iterator[tuple[str, frozenset[str]]]:
    if _fails(demand.requirement, given.values, closed):
        words = f"{demand.where}: {demand.requirement.words}"
        yield words, demand.requirement.symbols


def _fails(
    requirement: Requirement,
    given: Mapping[str, Expression],
    closed: Mapping[str, Expression],
) -> bool:
    """For all values of the symbols that stay, or at those of the file."""
    try:
        entries = tuple(substitute(e, dict(given)) for e in requirement.entries)
    except ZeroDivisionError:
        return False  # a requirement of its own
    return replace(requirement, entries=entries).fails or requirement.fails_at(closed)


def _unlike(parameter: Parameter) -> str:
    """In which way a value is not what its symbol is declared to be; else empty."""
    if parameter.value is None:
        return ""
    value, vanishes = closed_value(parameter.value), is_zero(parameter.value)
    if value is None:
        return f"the value of {parameter.name!r} is no real number"
    if parameter.positive and (value <= 0 or vanishes):
        return f"{parameter.name!r} is declared positive, but the value is {value:g}"
    if parameter.nonzero and (value == 0 or vanishes):
        return f"{parameter.name!r} is declared nonzero, but the value is 0"
    return ""
