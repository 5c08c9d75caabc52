"""The symbols a file declares: parameters, free variables, joint variables.

All of them share one name space.  Values of parameters may use other parameters; they
are resolved here to closed expressions.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from screwkit.algebra.closed_values import closed_value
from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import substitute, symbols_of
from screwkit.algebra.names import counted, is_symbol, shown, why_no_symbol
from screwkit.mechanism.joints import CATALOGUE, variable_count
from screwkit.mechanism.model import JointType, Parameter, Space
from screwkit.mechanism.nodes import Path, find
from screwkit.mechanism.ordering import in_order_of_need
from screwkit.mechanism.reading import Reading
from screwkit.mechanism.requirements import requirements_of
from screwkit.mechanism.schema import MechanismEntry, ParameterEntry, VariableEntry
from screwkit.mechanism.structure import Draft


@dataclass(frozen=True)
class Declared:
    """The parameters of a file, and their values as it writes them.

    Attributes:
        parameters: With closed values.
        written: The values by name, in which other parameters may occur.
    """

    parameters: tuple[Parameter, ...]
    written: Mapping[str, Expression]


def read_parameters(draft: Draft, reading: Reading) -> Declared:
    """The parameters, then the free variables, with closed values."""
    entries = dict(_parameter_entries(draft.entry, reading))
    raw: dict[str, Expression] = {}
    names = frozenset(entries)
    for name, (path, entry) in entries.items():
        if entry.value is not None:
            text_path = _value_path(path, reading)
            value = reading.scalar(text_path, entry.value, names)
            if value is not None and name not in reading.outside.replaced:
                raw[name] = value
    values = _closed(raw, entries, reading)
    found = []
    for name, (path, entry) in entries.items():
        parameter = Parameter(
            name,
            values.get(name),
            positive=entry.positive,
            nonzero=entry.nonzero or entry.positive,
            angle=isinstance(entry, VariableEntry) and entry.angle,
            free=isinstance(entry, VariableEntry),
        )
        check_assumptions(parameter, _value_path(path, reading), reading)
        found.append(parameter)
    return Declared(tuple(found), raw)


def _value_path(path: Path, reading: Reading) -> Path:
    longer = (*path, "value")
    return path if find(reading.root, longer) is None else longer


def _parameter_entries(
    entry: MechanismEntry, reading: Reading
) -> Iterator[tuple[str, tuple[Path, ParameterEntry]]]:
    seen: set[str] = set()
    for key, declared in (
        ("parameters", entry.parameters),
        ("variables", entry.variables),
    ):
        for name, parameter in declared.items():
            path = (key, name)
            if reason := why_no_symbol(name):
                reading.fault_at_key(path, f"{key}: {reason}")
            elif name in seen:
                reading.fault_at_key(
                    path, f"variables: {shown(name)} is a parameter already"
                )
            else:
                seen.add(name)
                yield name, (path, parameter)


def _closed(
    raw: dict[str, Expression],
    entries: dict[str, tuple[Path, ParameterEntry]],
    reading: Reading,
) -> dict[str, Expression]:
    """The values with parameters put in for their names; faults where none come out."""
    closed, divided = closed_values_of(raw)
    needs = {name: symbols_of(value) for name, value in raw.items()}
    waiting = depending_on(reading.outside.replaced, needs)
    for name, value in raw.items():
        if name in closed or name in divided or name in waiting:
            continue
        missing = sorted(symbols_of(value) - closed.keys())
        path = _value_path(entries[name][0], reading)
        if any(other in raw and other not in divided for other in missing):
            reading.fault(path, f"the value depends on itself through {missing[0]!r}")
        elif missing[0] not in raw:
            reading.fault(path, f"{missing[0]!r} has no value to compute this one from")
    return closed


def depending_on(
    names: frozenset[str], needs: Mapping[str, frozenset[str]]
) -> frozenset[str]:
    """The names whose values need one of ``names``, directly or through others."""
    found = names
    while more := {name for name, needed in needs.items() if needed & found} - found:
        found |= more
    return found


def closed_values_of(
    written: Mapping[str, Expression],
) -> tuple[dict[str, Expression], frozenset[str]]:
    """The values without symbols, and the names whose values divide by zero.

    `Requirement` reports these divisions, with all others at the values of the file.

    Values that depend on themselves or on a symbol without value are in neither.
    """
    closed: dict[str, Expression] = {}
    divided: set[str] = set()
    needs = {name: symbols_of(value) for name, value in written.items()}
    for name in in_order_of_need(needs):
        if needs[name] <= closed.keys():
            values = {used: closed[used] for used in needs[name]}
            try:
                closed[name] = substitute(written[name], values)
            except ZeroDivisionError:
                divided.add(name)
    return closed, frozenset(divided)


def check_assumptions(parameter: Parameter, path: Path, reading: Reading) -> None:
    """Report a value that contradicts what the parameter is declared to be."""
    if parameter.value is None:
        return
    value = closed_value(parameter.value)
    if value is None:
        if not any(r.fails for r in requirements_of(parameter.value)):
            reading.fault(path, "the value is no real number")
    elif parameter.positive and value <= 0:
        reading.fault(path, f"declared positive, but the value is {value:g}")
    elif parameter.nonzero and value == 0:
        reading.fault(path, "declared nonzero, but the value is 0")


def read_variables(
    draft: Draft, reading: Reading, taken: frozenset[str]
) -> tuple[tuple[str, ...], ...]:
    """The variables of every joint, in order; faults where names collide."""
    owners: dict[str, str] = {}
    found = []
    for entry, position in zip(draft.entry.joints, draft.positions, strict=True):
        names = _names_of(entry, position, draft.entry.space, reading)
        for name in names:
            path: Path = ("joints", position, "variable")
            declared = "declares" if entry.variable else "has by default"
            if name in taken:
                reading.fault(
                    path,
                    f"the joint {declared} the variable {name!r}, which stands "
                    f"among `parameters` or `variables`; give it another `variable`",
                )
            elif owners.get(name) == entry.name and not entry.variable:
                pass  # two joints of one name: that is the fault, reported as such
            elif name in owners:
                reading.fault(
                    path,
                    f"the joint {declared} the variable {name!r}, which belongs to "
                    f"joint {owners[name]!r}; give it another `variable`",
                )
            else:
                owners[name] = entry.name
        found.append(names)
    return tuple(found)


def _names_of(
    entry: Any, position: int, space: Space, reading: Reading
) -> tuple[str, ...]:
    joint_type = JointType(entry.type)
    try:
        count = variable_count(joint_type, space)
    except ValueError:
        count = 0  # reported with the geometry
    if entry.variable is None:
        return default_variables(entry.name, position, count)
    path: Path = ("joints", position, "variable")
    if len(entry.variable) != count:
        words = CATALOGUE[joint_type].words
        reading.fault(
            path,
            f"a {words} has {counted(count, 'variable')}, not {len(entry.variable)}",
        )
        return default_variables(entry.name, position, count)
    for name in entry.variable:
        if reason := why_no_symbol(name):
            reading.fault(path, reason)
    return tuple(entry.variable)


def default_variables(name: str, position: int, count: int) -> tuple[str, ...]:
    """``q<name>`` where that is a symbol, else ``q<position>``; ``_1`` … appended.

    >>> default_variables("2", 0, 1), default_variables("left wrist", 4, 2)
    (('q2',), ('q5_1', 'q5_2'))
    """
    stem = f"q{name}" if is_symbol(f"q{name}_9") else f"q{position + 1}"
    if count == 1:
        return (stem,)
    return tuple(f"{stem}_{k}" for k in range(1, count + 1))
