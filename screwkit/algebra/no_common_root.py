"""Conditions in one unknown that have no common root.

References: [CoxLittleOShea] §1.5 (greatest common divisors).
"""

from __future__ import annotations

from collections.abc import Iterable

from screwkit.algebra.substitution import Substitution
from screwkit.algebra.trigonometric import Polynomial


def have_no_common_root(
    polynomials: Iterable[Polynomial], steps: Iterable[Substitution]
) -> bool:
    """Whether some polynomials, each in one generator alone, never vanish together.

    Args:
        polynomials: That vanish.
        steps: That solve conditions; some leave a relation in one generator.
    """
    relations = (step.relation[2] for step in steps if step.relation is not None)
    shared: dict[int, Polynomial] = {}
    for polynomial in (*polynomials, *relations):
        places = [i for i, degree in enumerate(polynomial.degrees()) if degree > 0]
        if len(places) == 1:
            known = shared.get(places[0])
            own = polynomial if known is None else known.gcd(polynomial)
            if own.is_constant():
                return True
            shared[places[0]] = own
    return False
