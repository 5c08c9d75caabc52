"""Pieces of a locus as text: equations of the grammar, and what solves them."""

from __future__ import annotations

import re
from typing import Final

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.factors import Factor
from screwkit.algebra.points import residue
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.solve import Solved, solutions
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.loci.pieces import Piece
from screwkit.results.solution import Solution

_NAME: Final = re.compile(r"[^\W\d]\w*")


def equations_of(piece: Piece) -> tuple[str, ...]:
    """The equations of a piece, each as the left side of ``… = 0``."""
    ring = piece.branches[0].ring
    return tuple(equation_text(ring, equation) for equation in piece.equations)


def solved_equations(piece: Piece) -> tuple[Solution | None, ...]:
    """For each equation its simplest solution, no variable twice; None without one.

    A condition on the posture is not solved for a dimension, nor for a symbol that it
    leaves free there; and no two are solved for a variable of each other.
    """
    equations = piece.equations
    offers = [_offers(piece, i) for i in range(len(equations))]
    behind: dict[str, set[str]] = {}  # what each solved variable is given by
    found: dict[int, Solution] = {}
    # Equations that can be solved for few variables choose first.
    for i in sorted(
        range(len(equations)), key=lambda i: (len(offers[i]), len(equations[i]))
    ):
        for offer in offers[i]:
            names = set(_NAME.findall(" ".join(offer.values)))
            names |= {inner for name in names for inner in behind.get(name, ())}
            if offer.variable in behind or offer.variable in names:
                continue
            behind[offer.variable] = names
            for known in behind.values():
                if offer.variable in known:
                    known.update(names)
            found[i] = offer
            break
    return tuple(found.get(i) for i in range(len(equations)))


def _offers(piece: Piece, number: int) -> list[Solution]:
    """What an equation is solved for, simplest first."""
    branch = piece.branches[0]
    equation = piece.equations[number]
    barred = _dimensions(branch, equation)
    return [
        Solution(s.variable, s.values, s.modulo)
        for s in _solved(branch.ring, equation, branch.assumptions)
        if s.variable not in barred
        and (s.modulo or not _divides_by_zero(piece, number, s.variable))
    ]


def _divides_by_zero(piece: Piece, number: int, variable: str) -> bool:
    """Whether a symbol's coefficient in an equation is zero on all of the piece."""
    ring = piece.branches[0].ring
    index = ring.symbol_indices().start + ring.symbols.index(variable)
    slope = piece.equations[number].derivative(index)
    points = [at for branch in piece.branches for at in branch.points]
    return bool(points) and not any(residue(slope, *at) for at in points)


def _dimensions(branch: Branch, equation: Polynomial) -> set[str]:
    """Names of the mechanism's dimensions; none where they alone are tied."""
    ring = branch.ring
    if not any(
        kind != "x" or i not in branch.dimensions
        for kind, i in unknowns(ring, equation)
    ):
        return set()
    first = ring.symbol_indices().start
    return {ring.symbols[i - first] for i in branch.dimensions}


def all_solutions(piece: Piece) -> tuple[Solution, ...]:
    """Every short solution of every equation."""
    branch = piece.branches[0]
    return tuple(
        Solution(s.variable, s.values, s.modulo)
        for equation in piece.equations
        for s in _solved(branch.ring, equation, branch.assumptions)
    )


def conditions_of(piece: Piece) -> tuple[str, ...]:
    """Readable conditions: ``q6 = q1 (mod pi)``; the equation where unsolved."""
    ring = piece.branches[0].ring
    return tuple(
        f"{equation_text(ring, equation)} = 0"
        if solved is None
        else solution_text(solved)
        for equation, solved in zip(
            piece.equations, solved_equations(piece), strict=True
        )
    )


def solution_text(solved: Solved | Solution) -> str:
    """``q4 = 0, pi`` or ``q2 = atan(-r3/d3) (mod pi)``."""
    if solved.modulo == "pi" and len(solved.values) == 2 and solved.values[0] != "0":
        return f"{solved.variable} = {solved.values[0]} (mod pi)"
    return f"{solved.variable} = {', '.join(solved.values)}"


def _solved(
    ring: TrigonometricRing, equation: Polynomial, assumptions: Assumptions
) -> tuple[Solved, ...]:
    return solutions(ring, Factor(str(equation), (equation,)), assumptions)
