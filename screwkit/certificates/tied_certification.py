"""Certificates where loops tie joint variables: what is proved at closed postures.

The matrices are written in all joint variables as if they were free.  The proof starts
with what closed loops demand as conditions that are not solved.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import TypeAlias

from screwkit.algebra.branches import Branch
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, differential
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.covered_components import with_covers
from screwkit.certificates.derivation import proof_of
from screwkit.certificates.equations_told import Unsolved
from screwkit.certificates.loop_equations import LoopEquations
from screwkit.certificates.minor_choice import Matrix
from screwkit.certificates.part_derivation import PartDerivation
from screwkit.certificates.records import (
    Certificate,
    Demand,
    Locus,
    Part,
    Reach,
    Source,
)
from screwkit.certificates.roots import NotProvedError, roots_of
from screwkit.certificates.seen_postures import SeenPostures
from screwkit.certificates.steps import written_step
from screwkit.certificates.subjects import Subject
from screwkit.certificates.texts import RefusedError
from screwkit.certificates.written import SCHEMA
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.tied_twists import (
    closing_demands,
    tied_demands,
    tied_twists,
)
from screwkit.progress import Progress, silent
from screwkit.results.singularities import Component, Singularities

Demands: TypeAlias = tuple[tuple[Polynomial, Demand], ...]
"""Polynomials with what the certificate says of them."""

_CHOICES = 6
"""Of these that can be met by roots."""

_ORDERS = 24
"""Choices of as many demands as are independent."""


def certified_tied(
    graph: TiedGraph,
    answer: Singularities,
    mechanism: Source,
    version: str,
    progress: Progress = silent,
) -> Certificate:
    """The certificate of an answer at closed postures.

    Limbs that are no chains are left out.

    Args:
        graph: Of the mechanism, whose loops tie joint variables.
        answer: Its limb, constraint and actuation singularities.
        mechanism: As it was read, to be carried along.
        version: Of the package.
        progress: Told about each part.
    """
    parts = []
    loops = ClosedLoops(graph)
    for limb, labels, own in zip(
        graph.network.limbs, graph.framed.limbs, answer.limb, strict=True
    ):
        if limb.path is None:
            continue
        progress("certificate", f"limb {own.limb}")
        columns = tuple(graph.framed.column(label) for label in labels)
        matrix = Matrix((columns,), (labels,), tuple(range(6)), single=True)
        parts.append(loops.derivation(matrix, "").limb(own))
    progress("certificate", "constraint")
    derivation = loops.derivation(LoopEquations.of(graph), "loops")
    parts.append(derivation.constraint(answer.constraint))
    actuation = answer.actuation
    if actuation is not None and actuation.admissible:
        progress("certificate", "actuation")
        matrix_left = LoopEquations.of(graph, actuation.actuated)
        derivation = loops.derivation(matrix_left, "loops")
        parts.append(derivation.actuation(actuation))
    return Certificate(SCHEMA, answer.case, version, mechanism, tuple(parts))


class ClosedLoops:
    """What the closed loops of a mechanism demand, and how closed postures are met.

    Args:
        graph: Of the mechanism.
    """

    def __init__(self, graph: TiedGraph) -> None:
        self._graph = graph
        self.ring = graph.framed.ring
        self.postures: tuple[tuple[Point, int], ...] = graph.closed.points

    def derivation(self, matrix: Matrix | LoopEquations, form: str) -> TiedDerivation:
        """Of the part about a matrix."""
        graph = self._graph
        chain = tuple(joint.name for joint in graph.mechanism.joints)
        subject = Subject(
            graph.mechanism,
            graph.root,
            graph.library,
            graph.framed,
            matrix,
            chain,
            form,
        )
        return TiedDerivation(subject, self)

    @cached_property
    def closing(self) -> Demands:
        """The closing equations, short ones first."""
        return self._sorted(closing_demands(self._graph.mechanism, self.ring))

    @cached_property
    def demands(self) -> Demands:
        """These and their short consequences in the same unknowns, short ones first."""
        ring = self.ring
        known = {u for own, _ in self.closing for u in unknowns(ring, own)}
        found = self._sorted(tied_demands(self._graph.mechanism, ring))
        return tuple(pair for pair in found if known >= {*unknowns(ring, pair[0])})

    def _sorted(self, values: Iterable[Polynomial]) -> Demands:
        ring = self.ring
        found: dict[str, tuple[Polynomial, Demand]] = {}
        for number, value in enumerate(values):
            (own,), scale = ring.cleared([value])
            if own == 0 or {str(own), str(-own)} & {*found}:
                continue
            demand = Demand(text(ring, own), number, text(ring, scale))
            found[str(own)] = own, demand
        return tuple(sorted(found.values(), key=lambda pair: len(pair[0])))

    def starts(self, matrix: Matrix | LoopEquations) -> list[Demands]:
        """With which demands a proof may start, few ones first.

        One that holds an unknown which neither the matrix nor another demand has often
        says no more than what that unknown is.
        """
        ring = self.ring
        told = {u for e in matrix.entries for u in unknowns(ring, e)}
        told |= {("x", index) for index in self._graph.root.dimensions}
        few = [pair for pair in self.demands if pair[0] in self.choices[0][0]]
        for _ in range(len(few)):
            for pair in few:
                others = {u for e, _ in few if e != pair[0] for u in unknowns(ring, e)}
                if not told | others >= {*unknowns(ring, pair[0])}:
                    few.remove(pair)
                    break
        found = list[Demands]()
        for start in ((), tuple(few), self.closing, self.demands):
            if start not in found:
                found.append(start)
        return found

    @cached_property
    def choices(
        self,
    ) -> tuple[tuple[tuple[Polynomial, ...], tuple[Unsolved, ...]], ...]:
        """Demands from which the others follow, and how they are met; several choices.

        Raises:
            NotProvedError: If no order was found in which they can be met.
        """
        equations = [own for own, _ in self.demands]
        equations.sort(key=lambda e: (len(unknowns(self.ring, e)), len(e)))
        source = random.Random(3)
        point, prime = self.postures[0]
        rows = [differential(self.ring, e, point, prime) for e in equations]
        order = [*range(len(equations))]
        found = list[tuple[tuple[Polynomial, ...], tuple[Unsolved, ...]]]()
        tried = set[tuple[int, ...]]()
        for _ in range(_ORDERS):
            chosen: list[int] = []
            for k in order:
                if rank([rows[i] for i in (*chosen, k)], prime) > len(chosen):
                    chosen.append(k)
            source.shuffle(order)
            if tuple(sorted(chosen)) in tried or len(found) == _CHOICES:
                continue
            tried.add(tuple(sorted(chosen)))
            kept = tuple(equations[k] for k in chosen)
            try:
                met = roots_of(self.ring, kept, self._graph.root.nonzero)
            except NotProvedError:
                continue
            found.append((kept, met))
        if not found:
            raise NotProvedError("no order was found in which loops can be closed")
        return tuple(found)


class TiedDerivation(PartDerivation):
    """A part about closed postures under way."""

    def __init__(self, subject: Subject, loops: ClosedLoops) -> None:
        super().__init__(subject)
        self._loops = loops

    @property
    def _postures(self) -> Sequence[tuple[Point, int]]:
        return self._loops.postures

    def _twists(self) -> Mapping[str, JointTwist[Polynomial]]:
        return tied_twists(self._subject.mechanism, self._ring, self._framed.origin)

    def _claims(
        self,
        question: str,
        components: Sequence[Component],
        idle: Sequence[Component],
        loci: Sequence[tuple[Polynomial, ...]],
        limb: str,
        locked: Sequence[str],
    ) -> Part:
        part = super()._claims(question, (), (), (), limb, locked)
        part = replace(part, closed=self._loops.choices[0][1])
        return replace(
            part,
            components=tuple(self._met(part, component) for component in components),
            idle=tuple(self._met(part, component) for component in idle),
        )

    def _met(self, part: Part, component: Component) -> Locus:
        """A component, with what is seen at closed postures on it."""
        seen = SeenPostures(self._subject.mechanism, part)
        for reach in self._reaches(component):
            try:
                return seen.locus(component.equations, reach)
            except RefusedError:
                continue
        raise NotProvedError("no exact closed posture on one of them was found")

    def _reaches(self, component: Component) -> Iterator[tuple[Reach, ...]]:
        """How closed postures may be met: all equations by roots, or some solved."""
        equations = self._polynomials(component)[: component.codimension]
        for kept, _ in self._loops.choices:
            try:
                roots = roots_of(self._ring, (*kept, *equations), self._root.nonzero)
            except NotProvedError:
                continue
            yield (Reach((), roots),)
        solved = self._branches(self._polynomials(component), component.codimension)
        for kept, _ in self._loops.choices:
            try:
                yield tuple(self._reach(branch, kept) for branch in solved)
            except NotProvedError:
                continue

    def _reach(self, branch: Branch, kept: Sequence[Polynomial]) -> Reach:
        left = [p.value for p in branch.pending]
        for value in (branch.value(equation) for equation in kept):
            if value != 0 and value not in left:
                left.append(value)
        steps = tuple(written_step(branch, n) for n in range(len(branch.steps)))
        return Reach(steps, roots_of(self._ring, left, branch.nonzero))

    def _proved(self, part: Part, loci: Sequence[tuple[Polynomial, ...]]) -> Part:
        """With the fewest demands from which everything was shown."""
        reason = NotProvedError("no loop was closed")
        best: Part | None = None
        for start in self._loops.starts(self._matrix):
            demands = tuple(own for own, _ in start)
            problem = replace(
                self._problem(loci, part.question),
                demands=demands,
                closed=tuple(self._postures),
            )
            try:
                proof = proof_of(problem, asks_limbs=False)
            except NotProvedError as error:
                reason = error
                continue
            met = replace(part, demands=tuple(demand for _, demand in start))
            bare = replace(problem, components=(), moving=False)
            met = with_covers(self._subject.mechanism, met, bare, self._read)
            found = self._examined(replace(met, proof=proof))
            if not found.reason:
                return found
            best = best or found
        if best is None:
            raise reason
        return best
