"""Minors of sparse matrices as products: the product is the minor, up to a number."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence

import pytest
from flint import nmod_mat

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.factors import FactorLibrary, factor
from screwkit.algebra.parse import parse
from screwkit.algebra.points import residue
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.certificates import sparse_determinant
from screwkit.certificates.conditions import Conditions, Place, Problem
from screwkit.certificates.loop_equations import LoopEquations
from screwkit.certificates.short_minors import short_minors
from screwkit.certificates.signs import Signs
from screwkit.certificates.sparse_determinant import determinant
from screwkit.certificates.whole_equations import with_whole_equations

TEXTS = ("cos(a)", "sin(a)", "cos(b)", "sin(b)", "x", "y", "p", "r", "sqrt(3)")


def space() -> tuple[Branch, list[Polynomial]]:
    seen = SurveyRing()
    for text in TEXTS:
        evaluate(parse(text), seen)
    ring = TrigonometricRing(seen)
    positive = frozenset({"p", "r"})
    branch = Branch(ring, Assumptions(positive=positive, nonzero=positive))
    return branch, [ring.normal(evaluate(parse(text), ring)) for text in TEXTS]


def entry(source: random.Random, given: Sequence[Polynomial]) -> Polynomial:
    terms = source.sample(given, source.choice((1, 1, 2)))
    value = sum((source.choice((-2, 1, 3)) * term for term in terms), 0 * given[0])
    return value * source.choice(given) if source.random() < 0.3 else value


def sparse(
    branch: Branch, given: Sequence[Polynomial], size: int, seed: int
) -> list[dict[int, Polynomial]]:
    """A matrix with a diagonal, so that its determinant is not zero in general."""
    source = random.Random(seed)
    rows = []
    for line in range(size):
        columns = {line, *source.sample(range(size), 2)}
        row = {c: branch.ring.normal(entry(source, given)) for c in sorted(columns)}
        rows.append(row)
    return rows


def minor_at(
    rows: Sequence[Mapping[int, Polynomial]],
    columns: Sequence[int],
    at: tuple[Sequence[int], int],
) -> int:
    entries = [residue(row[c], *at) if c in row else 0 for row in rows for c in columns]
    return int(nmod_mat(len(rows), len(rows), entries, at[1]).det())


def product_at(
    parts: Sequence[tuple[Polynomial, int]], at: tuple[Sequence[int], int]
) -> int:
    value, prime = 1, at[1]
    for part, power in parts:
        value = value * pow(residue(part, *at), power, prime) % prime
    return value


def keep_their_ratio(
    branch: Branch,
    rows: Sequence[Mapping[int, Polynomial]],
    columns: Sequence[int],
    parts: Sequence[tuple[Polynomial, int]],
) -> None:
    """The minor and the product keep their ratio at three points of one prime."""
    source, prime = random.Random(1), 0
    found: list[tuple[int, int]] = []
    while len(found) < 3:
        at = branch.point(source)
        assert at is not None
        prime = prime or at[1]
        if at[1] == prime:
            found.append((minor_at(rows, columns, at), product_at(parts, at)))
    assert all(one and other for one, other in found)
    first, second = found[0]
    assert all((one * second - other * first) % prime == 0 for one, other in found)


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("short", [0, 5_000])
def test_the_product_is_the_determinant(
    seed: int, short: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """By flint's determinant of residues; with nothing expanded at once, too."""
    monkeypatch.setattr(sparse_determinant, "_SHORT", short)
    monkeypatch.setattr(sparse_determinant, "_WORTH", 4)
    branch, given = space()
    rows = sparse(branch, given, 5, seed)
    parts = determinant(branch.ring, rows)
    if parts is None:
        assert minor_at(rows, range(5), branch.points[0]) == 0
        return
    keep_their_ratio(branch, rows, range(5), parts)


def test_a_matrix_without_a_determinant_has_no_product() -> None:
    branch, (ca, sa, *_) = space()
    rows = [{0: ca, 1: sa}, {0: ca * 2, 1: sa * 2}]
    assert determinant(branch.ring, rows) is None


@pytest.mark.parametrize("seed", range(6))
def test_pivots_that_vanish_nowhere_count_as_often_as_they_are_in_a_minor(
    seed: int,
) -> None:
    """Positive symbols clear rows; a row that is not in a minor does not count."""
    branch, given = space()
    p, r = given[6], given[7]
    rows = sparse(branch, given, 6, seed)
    for line in range(6):
        rows[line][line] = p * r if line % 2 else p
    # Rows that depend on the others, which no minor of full rank holds together.
    rows.append({c: 2 * value for c, value in rows[0].items()})
    offered = list(short_minors(branch, rows, *branch.points[0], random.Random(seed)))
    assert offered
    for minor in offered:
        chosen = [rows[k] for k in minor.rows]
        assert len(minor.rows) == len(minor.columns) == 6
        keep_their_ratio(branch, chosen, minor.columns, minor.parts)


# -- half-angle factors --------------------------------------------------------------

# (x·sin a/2·cos b/2 − y·cos a/2·sin b/2) · sin a/2 · cos b/2, four times.
WHOLE = "x*(1 - cos(a))*(1 + cos(b)) - y*sin(a)*sin(b)"


def conditions(text: str) -> tuple[Conditions, Place, Polynomial]:
    branch, _ = space()
    ring = branch.ring
    value = ring.normal(evaluate(parse(text), ring))
    matrix = LoopEquations((), {}, {}, asks_held=False)
    problem = Problem(
        branch, matrix, ((value,),), False, FactorLibrary(ring), Signs((), ()), {}, {}
    )
    return Conditions(problem), Place(branch), value


def test_an_equation_of_a_component_stands_for_its_half_angle_factors() -> None:
    known, place, value = conditions(WHOLE)
    factors = [*factor(place.branch.ring, value, known.problem.library).factors]
    hard = [own for own, _ in factors if known.steps(place.branch, own) is None]
    assert len(factors) == 3
    assert [len(own.equations) for own in hard] == [2]
    ((whole, power),) = with_whole_equations(known, place, factors)
    assert power == 1
    assert whole.equations == (primitive(value),)
    # One factor more stays, one less leaves everything as it was.
    more = [(own, n + (own is not hard[0])) for own, n in factors]
    assert len(with_whole_equations(known, place, more)) == 3
    assert with_whole_equations(known, place, factors[1:]) == factors[1:]


def test_a_quotient_may_hold_a_square_root_below_the_line() -> None:
    """x·cos a + y over √3 times itself is √3/3."""
    known, place, value = conditions("x*cos(a) + y*sin(b)")
    ring = place.branch.ring
    root = ring.normal(evaluate(parse("sqrt(3)"), ring))
    found = known.quotient(value, ring.normal(root * value))
    assert found is not None
    assert ring.normal(found * root) == ring.one
    assert known.quotient(value, ring.normal(root * value + ring.one)) is None
