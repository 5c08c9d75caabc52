"""The product of the factors is the polynomial, and no factor splits."""

from collections import Counter

import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from screwkit.algebra.factors import FactorLibrary, factor
from screwkit.algebra.half_angle import HalfAngles
from screwkit.algebra.restrictions import Layout
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing


def _ring() -> TrigonometricRing:
    survey = SurveyRing()
    for angle in ("q1", "q2"):
        survey.cosine_sine(angle)
    for symbol in ("a", "b"):
        survey.symbol(symbol)
    return TrigonometricRing(survey)


RING = _ring()
LIBRARY = FactorLibrary(RING)

_letters = st.sampled_from([*RING.context.gens(), RING.one])
_monomials = st.tuples(_letters, _letters).map(lambda pair: pair[0] * pair[1])
_terms = st.tuples(st.integers(-3, 3), _monomials).map(lambda pair: pair[0] * pair[1])
polynomials = (
    st.lists(_terms, min_size=1, max_size=3)
    .map(lambda terms: RING.normal(sum(terms, RING.zero)))
    .filter(lambda value: value != 0)
)


@given(st.lists(polynomials, min_size=1, max_size=3))
@settings(max_examples=150)
def test_the_product_of_the_factors_is_the_polynomial(parts: list[Polynomial]) -> None:
    product = RING.one
    for part in parts:
        product = RING.normal(product * part)
    assert factor(RING, product).expand(RING) == product


@given(polynomials, polynomials)
@settings(max_examples=100)
def test_factors_of_a_product_are_those_of_its_parts(
    left: Polynomial, right: Polynomial
) -> None:
    parts = [factor(RING, p, LIBRARY) for p in (left, right)]
    pairs = [pair for part in parts for pair in part.factors]
    assume(all(one.form is None for one, _ in pairs))
    together: Counter[str] = Counter()
    for one, multiplicity in pairs:
        together[one.key] += multiplicity
    product = factor(RING, RING.normal(left * right), LIBRARY)
    assert {one.key: m for one, m in product.factors} == together


@given(polynomials, polynomials)
@settings(max_examples=60)
def test_no_factor_splits(left: Polynomial, right: Polynomial) -> None:
    halves = HalfAngles(RING, Layout.of(RING))
    for one, _ in factor(RING, RING.normal(left * right), LIBRARY).factors:
        assert one.certified
        form = one.form or halves.form(one.polynomial, halves.degrees(one.polynomial))
        _, pieces = sympy.factor_list(
            sympy.sympify(str(form.polynomial).replace("^", "**"))
        )
        seen = sum(int(multiplicity) for _, multiplicity in pieces)
        lost = sum(form.degrees.values()) - sum(
            int(d) for d in form.polynomial.degrees()[len(RING.names) :]
        )
        if form.odd:
            assert seen + lost == 1
        else:  # one piece, or an orbit of odd pieces under q → q + π
            assert seen + lost in (1, 2, 4)
            if seen + lost > 1:
                parts = halves.paired(halves.factor(form))
                assert len(parts) == 1
                assert parts[0][1] == 1


@given(polynomials)
@settings(max_examples=60)
def test_a_library_changes_nothing(value: Polynomial) -> None:
    assert factor(RING, value, LIBRARY) == factor(RING, value)
