"""Equations of components in place of half-angle factors that cannot be solved.

Such a factor has two equations, and its sheet is hard to follow.  Where it is part of
an equation of a component, the other factors of which are at hand too, the equation as
a whole is the case, which lies on the component.
"""

from __future__ import annotations

from collections.abc import Sequence

from screwkit.algebra.factors import Factor
from screwkit.algebra.trigonometric import primitive
from screwkit.certificates.conditions import Conditions, Place
from screwkit.certificates.steps import followed


def with_whole_equations(
    known: Conditions, place: Place, factors: Sequence[tuple[Factor, int]]
) -> list[tuple[Factor, int]]:
    """The factors of a minor, some of them put together again.

    Args:
        known: The components.
        place: Where the factors were found.
        factors: With their powers.
    """
    branch = place.branch
    powers = {own.key: power for own, power in factors}
    by_key = {own.key: own for own, _ in factors}
    hard = {
        own.key
        for own, _ in factors
        if len(own.equations) > 1 and known.steps(branch, own) is None
    }
    for equations in known.problem.components if hard else ():
        if len(equations) > 1:
            continue
        (value,), _ = followed(branch, equations)
        if value == 0 or value.is_constant():
            continue
        inside = {own.key: power for own, power in known.factors(branch, value)}
        if not any(key in hard and powers.get(key) for key in inside):
            continue
        if all(powers.get(key, 0) >= power for key, power in inside.items()):
            for key, power in inside.items():
                powers[key] -= power
            whole = Factor(f"whole {value}", (primitive(value),))
            by_key[whole.key] = whole
            powers[whole.key] = 1
    return [(by_key[key], power) for key, power in powers.items() if power]
