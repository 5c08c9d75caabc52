"""Equations modulo a prime, a variable solved where its coefficient is not zero.

Of a·y + b = 0 follows y = −b/a, or a = b = 0: two systems, whose zeros together are the
same.  In the first one every equation is multiplied by powers of a.

References: [CoxLittleOShea] §3.1.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any, Final, TypeAlias

from screwkit.algebra.residue_systems import ResidueSystem, parted_by

_Residues: TypeAlias = Any  # flint.nmod_mpoly, which has no type stubs

LONGEST: Final = 4_000
"""Terms of what an equation becomes, at most."""

SYSTEMS: Final = 8
"""Into which one is taken apart, at most."""


def solved_parts(system: ResidueSystem) -> list[ResidueSystem]:
    """Systems with fewer variables whose zeros are those of one, as far as found."""
    return parted_by(_parted, system, SYSTEMS)


def _parted(system: ResidueSystem) -> list[ResidueSystem] | None:
    """Where a variable is solved, and where its coefficient is zero."""
    for _, number, variable in sorted(_linear_places(system)):
        equation = system.equations[number]
        below, rest = _parts(equation, variable)
        others = [e for k, e in enumerate(system.equations) if k != number]
        images = [_put_in(e, variable, below, -rest) for e in others]
        away = [_put_in(e, variable, below, -rest) for e in system.away]
        if max((len(e) for e in (*images, *away)), default=0) > LONGEST:
            continue
        solved = replace(
            system,
            equations=tuple(e for e in images if e != 0),
            away=(*away, below),
            solved=(*system.solved, (variable, equation)),
        )
        if below.is_constant():
            return [solved]
        again = tuple(e for e in (below, rest, *others) if e != 0)
        return [solved, replace(system, equations=again)]
    return None


def _linear_places(system: ResidueSystem) -> Iterator[tuple[tuple[int, int], int, int]]:
    """Equations by number and variables in which they are linear, short ones first."""
    pairs = {variable for pair in system.pairs for variable in pair}
    for number, equation in enumerate(system.equations):
        degrees = equation.degrees()
        for variable in system.left:
            if degrees[variable] == 1 and variable not in pairs:
                below, _ = _parts(equation, variable)
                yield (int(below.total_degree()), len(equation)), number, variable


def _parts(polynomial: _Residues, variable: int) -> tuple[_Residues, _Residues]:
    """Coefficient of a variable, and what does not contain it."""
    by = _by_power(polynomial, variable)
    zero = polynomial * 0
    return by.get(1, zero), by.get(0, zero)


def _by_power(polynomial: _Residues, variable: int) -> dict[int, _Residues]:
    terms: dict[int, dict[tuple[int, ...], int]] = {}
    for key, value in polynomial.to_dict().items():
        exponents = [int(power) for power in key]
        power, exponents[variable] = exponents[variable], 0
        terms.setdefault(power, {})[tuple(exponents)] = int(value)
    context = polynomial.context()
    return {power: context.from_dict(own) for power, own in terms.items()}


def _put_in(
    polynomial: _Residues, variable: int, below: _Residues, above: _Residues
) -> _Residues:
    """A polynomial with a fraction for a variable, times a power of what is below."""
    by = _by_power(polynomial, variable)
    highest = max(by, default=0)
    total = polynomial * 0
    for power, own in by.items():
        total += own * above**power * below ** (highest - power)
    return total
