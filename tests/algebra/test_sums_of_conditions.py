"""Sums of multiples of conditions against identities derived by hand."""

from __future__ import annotations

from one_ring import in_one_ring

from screwkit.algebra.sums_of_conditions import (
    Combination,
    times_constants,
    without_symbols,
)
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def holds(
    ring: TrigonometricRing, found: Combination, conditions: list[Polynomial]
) -> bool:
    pairs = zip(found.times, conditions, strict=True)
    return bool(ring.normal(sum((t * c for t, c in pairs), ring.zero)) == found.value)


def test_minors_of_columns_that_depend_follow_from_the_others() -> None:
    """Columns (1, x_i, p_i): Σ ±M_i = 0 and Σ ±p_i M_i = 0 for minors M_i without i.

    So (p0 − p1)·M_1 is a sum of multiples of M_2 and M_3 with M_0 taken out, and no
    number times M_1 is one of M_2 and M_3.
    """
    columns = [("1", f"x{i}", f"p{i}") for i in range(4)]

    def minor(i: int) -> str:
        a, b, c = (own for k, own in enumerate(columns) if k != i)
        terms = [
            f"{u[0]}*({v[1]}*{w[2]} - {w[1]}*{v[2]})"
            for u, v, w in ((a, b, c), (b, c, a), (c, a, b))
        ]
        return " + ".join(terms)

    ring, minors = in_one_ring(*(minor(i) for i in range(4)))
    pitches = [
        index
        for name, index in zip(ring.symbols, ring.symbol_indices(), strict=True)
        if name.startswith("p")
    ]
    wanted, known = minors[1], minors[2:]
    assert times_constants(ring, wanted, known, pitches, 0) is None
    found = times_constants(ring, wanted, known, pitches, 1)
    assert found is not None
    assert holds(ring, found, known)
    names = dict(zip(ring.symbols, ring.symbol_indices(), strict=True))
    gens = ring.context.gens()
    factor = gens[names["p0"]] - gens[names["p1"]]
    assert divmod(found.value, factor * wanted)[1] == 0


def test_a_symbol_is_taken_out_of_a_condition_of_higher_degree() -> None:
    """On y·c = x·s: c²·(x² + y² − r²) = x² − r²·c², a product."""
    *texts, product = "x*sin(q) - y*cos(q)", "x^2 + y^2 - r^2", "x^2 - r^2*cos(q)^2"
    ring, (*conditions, wanted) = in_one_ring(*texts, product)
    found = [*without_symbols(ring, conditions)]
    assert all(holds(ring, own, conditions) for own in found)
    assert any(own.value in (wanted, -wanted) for own in found)
