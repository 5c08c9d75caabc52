"""Equations reduced by each other: the same zeros in fewer words."""

from __future__ import annotations

import numpy as np
import pytest
from loci.numeric import Array, value
from one_ring import in_one_ring
from scipy.optimize import least_squares

import screwkit as sk
from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.expression_building import symbols_of
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.parse import parse
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.search import Search
from screwkit.loci.pieces import Piece, pieces_of
from screwkit.loci.reduced_equations import reduced
from screwkit.loci.wording import solved_equations

POSITIVE = Assumptions(frozenset("ab"))
LENGTHS = {"a": 1.3, "b": 0.7}


def pieces_where(*texts: str) -> tuple[Branch, FactorLibrary, list[Piece]]:
    """The zeros of some equations; a piece of one part is given by them as they are."""
    ring, polynomials = in_one_ring(*texts)
    equations = tuple(polynomials)
    root, library = Branch(ring, POSITIVE), FactorLibrary(ring)
    zeros = common_zeros(root, equations, Search(library))
    pieces = pieces_of(zeros.branches)
    if len(pieces) == 1:
        pieces = [Piece(equations, pieces[0].branches)]
    return root, library, pieces


def texts(piece: Piece) -> set[str]:
    ring = piece.branches[0].ring
    return {equation_text(ring, equation) for equation in piece.equations}


@pytest.mark.parametrize(
    ("written", "wanted"),
    [
        (
            ["sin(p)", "a*sin(p) - x*sin(p) + y*cos(p)"],
            {"sin(p)", "y"},
        ),
        (
            ["v", "u + 1", "s*(u^2 + v^2 + 1) + b*u^2 - b*v^2 - b"],
            {"v", "u + 1", "s"},
        ),
        (  # two equations that say one angle
            ["cos(p) - cos(q)", "sin(p) - sin(q)", "x - a*cos(p)"],
            {"cos(q - p) - 1", "a*cos(p) - x"},
        ),
        (["sin(p)", "cos(p) - 1"], {"cos(p) - 1"}),
        (["x", "x*y - z", "z"], {"x", "z"}),
        (  # multiples of what cannot be solved
            ["x^3 + y^3 - x*y", "sin(p)*(x^3 + y^3 - x*y)", "2*x*y - 2*x^3 - 2*y^3"],
            {"x^3 + y^3 - x*y"},
        ),
        (["x^2 + y^2 - a", "x*y - b"], {"x^2 + y^2 - a", "x*y - b"}),
        (  # p = q (mod π), and what the first and the last say then
            ["x*sin(p) - y*cos(p)", "sin(p - q)", "(a - x)*sin(q) + y*cos(q)"],
            {"sin(q)", "sin(p)", "y"},
        ),
    ],
)
def test_what_another_equation_says_already_is_left_out(
    written: list[str], wanted: set[str]
) -> None:
    root, library, (piece,) = pieces_where(*written)
    found = reduced(piece, root, library)
    assert texts(found) == wanted
    assert len(found.equations) == len(wanted)


SYSTEMS = [
    ["sin(p)", "a*sin(p) - x*sin(p) + y*cos(p)", "z*sin(q) - x*cos(q + p)"],
    ["a*cos(p) - 2*a*cos(q) - x", "a*sin(p) - 2*a*sin(q)", "sin(p - q)"],
    ["x*sin(p) - y*cos(p)", "sin(p - q)", "(a - x)*sin(q) + y*cos(q)"],
    ["cos(p) - cos(q)", "sin(p) - sin(q)", "a*cos(p) + x*sin(q) - y"],
    ["u - v", "x*(u^2 + v^2 + 1) - a*u*v", "y*(u + v) - b*x"],
]


@pytest.mark.parametrize("written", SYSTEMS)
def test_the_zeros_stay_the_same(written: list[str]) -> None:
    """Newton's steps lead to zeros of the one list; they are those of the other.

    Where an equation has double zeros they are met to the root of the residual only.
    """
    root, library, pieces = pieces_where(*written)
    source = np.random.default_rng(3)
    ring = root.ring
    angles = {name for form in ring.basis for name, _ in form}
    names = sorted({*ring.symbols, *angles} - LENGTHS.keys())
    for piece in pieces:
        before, after = texts(piece), texts(reduced(piece, root, library))
        for first, second in ((before, after), (after, before)):
            met = 0
            for _ in range(5):
                at = zero_near(first, names, source.uniform(0.4, 1.6, len(names)))
                if at is not None:
                    met += 1
                    assert max(abs(value(text, at)) for text in second) < 1e-4
            assert met


def zero_near(
    equations: set[str], names: list[str], start: Array
) -> dict[str, float] | None:
    def wrong(x: Array) -> Array:
        at = LENGTHS | dict(zip(names, x, strict=True))
        return np.array([value(text, at) for text in sorted(equations)])

    found = least_squares(wrong, start, xtol=1e-15, ftol=1e-15, gtol=1e-15)
    at = LENGTHS | dict(zip(names, map(float, found.x), strict=True))
    return at if max(abs(found.fun)) < 1e-10 else None


def test_no_two_equations_are_solved_for_variables_of_each_other() -> None:
    for piece in pieces_where("x*sin(p) - y*cos(p)", "a*x + y*z - b")[2]:
        solved = [s for s in solved_equations(piece) if s is not None]
        given = {
            s.variable: {n for v in s.values for n in symbols_of(parse(v))}
            for s in solved
        }
        for name in given:
            behind: set[str] = set()
            waiting = [name]
            while waiting:
                for inner in given.get(waiting.pop(), set()) - behind:
                    behind.add(inner)
                    waiting.append(inner)
            assert name not in behind


def test_nothing_is_solved_for_by_a_coefficient_that_vanishes_there() -> None:
    for piece in pieces_where("sin(p)", "x*sin(p) - y*cos(p)")[2]:
        ring = piece.branches[0].ring
        cosine, sine = ring.cosine_sine("p")
        whole = ring.normal(ring.symbol("x") * sine - ring.symbol("y") * cosine)
        (solved,) = solved_equations(Piece((whole,), piece.branches))
        assert solved is None or solved.variable != "x"


def test_conditions_of_a_case_read_short() -> None:
    """Of 3-CRR: two links along each other's guides, and the platform there."""
    constraint = sk.singularities(sk.load("3crr")).constraint
    assert {c.equations for c in constraint.components if len(c.equations) == 4} >= {
        ("sin(theta3)", "y", "cos(theta2)", "a - b - z")
    }
