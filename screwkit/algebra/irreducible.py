"""Proofs that a trigonometric polynomial does not split, all modulo one prime.

Written in half-angle tangents and made homogeneous, a polynomial that is linear in a
symbol, or whose restriction to one angle is irreducible of full degree, is a factor
free of that variable times an irreducible one; that factor divides every coefficient
with respect to the variable, and is constant when restrictions of one coefficient and
of the polynomial to each other variable have no common root.
Only univariate polynomials over a prime field are met, and every step is a proof: what
is irreducible, or coprime, with its degree kept mod p, is so over the rationals.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from screwkit.algebra.restrictions import (
    Layout,
    Probe,
    Restrictions,
    Variable,
    coefficients,
)
from screwkit.algebra.trigonometric import Polynomial

ATTEMPTS = 8

_FACTORED = 2_000
"""Terms of polynomials in symbols alone that are factored at once."""


@dataclass(frozen=True)
class Shape:
    """What univariate restrictions say about the factors of a polynomial.

    Attributes:
        irreducible: Proved; False says nothing.
        settled: Proved, if the polynomial is irreducible when sines and cosines are
            taken for independent generators.
        free_of: Where a factor seems to be free of a variable: that variable.
        degrees: That factor's degree in tan(q/2), by angle, and by symbol; 0 where it
            is absent.
        rest_irreducible: Proved of the cofactor, if the factor has these degrees.
    """

    irreducible: bool
    settled: bool
    free_of: Variable = ()
    degrees: Mapping[Variable, int] = field(default_factory=dict)
    rest_irreducible: bool = False

    @property
    def size(self) -> tuple[bool, int]:
        """Small where the factor free of a variable is simple, and there is one."""
        present = [d * (4 - len(v)) for v, d in self.degrees.items() if d]
        return not present, sum(present)


_UNKNOWN = Shape(False, False)
_PROVED = Shape(True, True)


def is_irreducible(layout: Layout, polynomial: Polynomial) -> bool:
    """Whether a proof was found; see `shape`."""
    return shape(layout, polynomial).irreducible


def shape(
    layout: Layout,
    polynomial: Polynomial,
    seed: int = 1,
    probe: Probe | None = None,
    known: Restrictions | None = None,
) -> Shape:
    """Try to prove that a polynomial does not split.

    A pair of half-angle factors that q → q + π exchanges counts as irreducible.

    Args:
        layout: Of the ring.
        polynomial: In normal form.
        seed: Of the random points.
        probe: The first point.
        known: Restrictions at that point, up to numbers.
    """
    bounds = polynomial.degrees()
    variables = list(layout.variables(bounds))
    if not variables or any(bounds[i] for i in layout.extensions):
        return _UNKNOWN
    angles = [v for v in variables if len(v) == 2]
    linear = next((v for v in variables if len(v) == 1 and bounds[v[0]] == 1), None)
    unknown = _UNKNOWN
    if not angles and not layout.constants:
        unknown = Shape(False, True)  # nothing but generators occurs
        if linear is None or len(polynomial) <= _FACTORED:
            return unknown
    if len(variables) == 1 and len(polynomial) == 1 and polynomial.total_degree() == 1:
        return _PROVED  # sin q and cos q count as irreducible
    turning = [v for v in angles if _turns_sign(layout, polynomial, v)]
    for attempt in range(ATTEMPTS):
        if probe is None:
            probe, known = Probe(layout, seed + 1000 * attempt), None
        if known is None:
            known = probe.restrictions(polynomial)
        if known is not None:
            owned = [v for v in _ascending(known) if _is_irreducible(known[v])]
            owned = ([linear] if linear else []) + turning + owned
            found = _UNKNOWN
            if owned:
                found = _beside(layout, polynomial, probe, owned[0], known)
                if found == _UNKNOWN:
                    return unknown
                if found.settled:
                    return found
            if owned or not any(_is_squarefree(known[v]) for v in angles):
                return _simplest(layout, polynomial, (probe, known), owned, found)
        probe = None
    return unknown


def _simplest(
    layout: Layout,
    polynomial: Polynomial,
    line: tuple[Probe, Restrictions],
    owned: Sequence[Variable],
    first: Shape,
) -> Shape:
    """The simplest factor that is free of some variable."""
    best = first
    probe, known = line
    for variable in known:
        if variable == first.free_of:
            continue
        if best.degrees and sum(1 for d in best.degrees.values() if d) in (1, 2, 3):
            break
        found = _beside(layout, polynomial, probe, variable, known)
        if found.degrees and found.size < best.size:
            best = found
    return replace(
        best, irreducible=False, settled=False, rest_irreducible=best.free_of in owned
    )


def _ascending(known: Restrictions) -> list[Variable]:
    angles = [variable for variable in known if len(variable) == 2]
    return sorted(angles, key=lambda v: int(known[v].degree()))


def _is_irreducible(restricted: Any) -> bool:
    p = int(restricted.modulus())
    if restricted.degree() == 2:
        c, b, a = (int(restricted[i]) for i in range(3))
        return pow(b * b - 4 * a * c, (p - 1) // 2, p) == p - 1
    _, factors = restricted.factor()
    return len(factors) == 1 and factors[0][1] == 1


def _is_squarefree(restricted: Any) -> bool:
    return bool(restricted.gcd(restricted.derivative()).degree() == 0)


def _turns_sign(layout: Layout, polynomial: Polynomial, angle: Variable) -> bool:
    """Whether it is a·sin q + b·cos q, which splits, if at all, into a pair."""
    sine, cosine = (layout.names[i] for i in angle)
    bounds = polynomial.degrees()
    if bounds[angle[1]] > 1 or polynomial.subs({sine: 0, cosine: 0}) != 0:
        return False
    return not (
        bounds[angle[0]]
        and bounds[angle[1]]
        and polynomial.derivative(angle[0]).degrees()[angle[1]]
    )


def _beside(
    layout: Layout,
    polynomial: Polynomial,
    probe: Probe,
    variable: Variable,
    known: Restrictions,
) -> Shape:
    """Whether a factor is free of ``variable`` and contains another."""
    parts = coefficients(polynomial, variable).values()
    part = probe.restrictions(min(parts, key=len))
    if part is None:
        return _UNKNOWN
    shared = {
        v: int(restricted.gcd(part[v]).degree()) if v in part else 0
        for v, restricted in known.items()
        if v != variable
    }
    # Over the rationals a factor without sines and cosines in common with its
    # cofactor would show with the generators taken for independent.
    irreducible = not any(shared.values())
    hidden = any(d for v, d in shared.items() if len(v) == 2)
    settled = irreducible or not (hidden or layout.constants)
    return Shape(irreducible, settled, variable, shared)
