"""Pieces of a locus as text: equations of the grammar, and what solves them."""

from __future__ import annotations

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.solve import Solved, solutions
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.loci.pieces import Piece
from screwkit.results.singularities import Solution


def equations_of(piece: Piece) -> tuple[str, ...]:
    """The equations of a piece, each as the left side of ``… = 0``."""
    ring = piece.branches[0].ring
    return tuple(equation_text(ring, equation) for equation in piece.equations)


def solved_equations(piece: Piece) -> tuple[Solution, ...]:
    """For each equation its simplest solution, where it has one."""
    branch = piece.branches[0]
    found = []
    for equation in piece.equations:
        solved = _solved(branch.ring, equation, branch.assumptions)
        found += [Solution(s.variable, s.values, s.modulo) for s in solved[:2]]
    return tuple(found)


def conditions_of(piece: Piece) -> tuple[str, ...]:
    """Readable conditions: ``q6 = q1 (mod pi)``; the equation where unsolved."""
    branch = piece.branches[0]
    written = []
    for equation in piece.equations:
        solved = _solved(branch.ring, equation, branch.assumptions)
        if solved:
            written.append(solution_text(solved[0]))
        else:
            written.append(f"{equation_text(branch.ring, equation)} = 0")
    return tuple(written)


def solution_text(solved: Solved | Solution) -> str:
    """``q4 = 0, pi`` or ``q2 = atan(-r3/d3) (mod pi)``."""
    if solved.modulo == "pi" and len(solved.values) == 2 and solved.values[0] != "0":
        return f"{solved.variable} = {solved.values[0]} (mod pi)"
    return f"{solved.variable} = {', '.join(solved.values)}"


def _solved(
    ring: TrigonometricRing, equation: Polynomial, assumptions: Assumptions
) -> tuple[Solved, ...]:
    from screwkit.algebra.factors import Factor  # noqa: PLC0415

    return solutions(ring, Factor(str(equation), (equation,)), assumptions)
