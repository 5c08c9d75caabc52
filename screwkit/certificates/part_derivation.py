"""One part of a certificate: claims about a list, with a proof that nothing is missing.

The list is read from the text of an answer; everything else is derived anew.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace

from screwkit.algebra.angle_basis import inverse_forms
from screwkit.algebra.branches import Branch
from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.names import counted
from screwkit.algebra.points import Point, residue
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.search import Search, imposed
from screwkit.algebra.trigonometric import Polynomial
from screwkit.certificates.checking import checked
from screwkit.certificates.conditions import Problem
from screwkit.certificates.covered_components import with_covers
from screwkit.certificates.derivation import proof_of
from screwkit.certificates.floors import LimbPart
from screwkit.certificates.real_postures import RealPostures, sides_of
from screwkit.certificates.records import (
    Locus,
    Part,
)
from screwkit.certificates.roots import NotProvedError
from screwkit.certificates.sheet_trials import SheetTrials
from screwkit.certificates.signs import Signs
from screwkit.certificates.steps import reach_of
from screwkit.certificates.subjects import (
    Subject,
)
from screwkit.certificates.texts import RefusedError, read
from screwkit.errors import ExpressionError
from screwkit.kinematics.freedoms import JointTwist
from screwkit.kinematics.placement import joint_twists
from screwkit.results.singularities import (
    ActuationSingularities,
    Component,
    ConstraintSingularities,
    LimbSingularities,
)

MOST = 60
"""Components of a list for which proofs are looked for."""


class PartDerivation:
    """One part under way."""

    def __init__(self, subject: Subject) -> None:
        self._subject = subject
        self._framed, self._matrix = subject.framed, subject.matrix
        self._ring = subject.framed.ring
        self._root = replace(subject.root, thorough=True)
        self._library = subject.library
        declared = subject.root.assumptions
        self._signs = Signs(declared.positive, declared.positive | declared.nonzero)
        basis = self._ring.basis
        self._real = RealPostures(
            {name: dict(own) for name, own in inverse_forms(basis).items()},
            len(basis),
            [name for name in self._ring.symbols if name != "pi"],
            self._signs.positive,
            self._signs.nonzero,
        )

    def limb(self, own: LimbSingularities) -> Part:
        """The part about a limb."""
        return self._part("limb", own.components, complete=own.complete, limb=own.limb)

    def with_floors(self, part: Part) -> LimbPart:
        """The part about a limb, of which it may be asked what rank it keeps where."""
        return LimbPart(part, self._problem((), part.question))

    def constraint(self, own: ConstraintSingularities) -> Part:
        """The part about the constraints of the loops."""
        return self._part("constraint", own.components, complete=own.complete)

    def actuation(self, own: ActuationSingularities) -> Part:
        """The part about a scheme."""
        return self._part(
            "actuation",
            own.components,
            own.idle,
            complete=own.complete,
            locked=own.actuated,
        )

    def _part(
        self,
        question: str,
        components: Sequence[Component],
        idle: Sequence[Component] = (),
        *,
        complete: bool,
        limb: str = "",
        locked: Sequence[str] = (),
    ) -> Part:
        """The claims with their proof, or with the reason why there is none."""
        if len(components) > MOST:
            part = self._claims(question, (), (), (), limb, locked)
            many = f"of more than {MOST} components none is listed"
            return replace(part, reason=f"{many}; there are {len(components)}")
        try:
            loci = [self._polynomials(component) for component in components]
            part = self._claims(question, components, idle, loci, limb, locked)
        except (NotProvedError, ExpressionError) as error:
            part = self._claims(question, (), (), (), limb, locked)
            return replace(part, reason=f"no component is listed: {error}")
        if not complete:
            return self._held(part, "the answer says that its list may have gaps")
        try:
            return self._proved(part, loci)
        except (NotProvedError, RefusedError) as error:
            return self._held(part, str(error))

    def _proved(self, part: Part, loci: Sequence[tuple[Polynomial, ...]]) -> Part:
        """The part with a proof that the checker takes.

        Raises:
            NotProvedError: If none was found.
            RefusedError: If the checker does not take it.
        """
        limbs = bool(self._subject.limbs)
        if limbs:
            with suppress(NotProvedError, RefusedError):
                return self._by_search(part, loci, asks_limbs=True)
        with suppress(NotProvedError, RefusedError):
            return self._by_search(part, loci)
        with suppress(NotProvedError, RefusedError):
            return self._by_search(part, loci, late=True)
        with suppress(NotProvedError, RefusedError):
            return self._by_search(part, loci, asks_limbs=limbs, patient=True)
        return self._by_search(part, loci, late=True, sheets=True)

    def _by_search(
        self,
        part: Part,
        loci: Sequence[tuple[Polynomial, ...]],
        *,
        asks_limbs: bool = False,
        late: bool = False,
        patient: bool = False,
        sheets: bool = False,
    ) -> Part:
        problem = self._problem(loci, part.question)
        bare = replace(part, proof=None)
        trials = SheetTrials(self._subject.mechanism, bare) if sheets else None
        proof = proof_of(
            problem, asks_limbs=asks_limbs, late=late, patient=patient, trials=trials
        )
        return self._examined(replace(part, proof=proof))

    def _examined(self, part: Part) -> Part:
        """The part, if the checker takes it, with what it was not shown."""
        parts = tuple(limb.told for limb in self._subject.parts)
        found = checked(self._subject.mechanism, part, "written", parts)
        left = len(found.sampled_components)
        if not left:
            return part
        whose = counted(left, "component")
        reason = f"not shown that the equations of {whose} hold at singular postures"
        return replace(part, reason=f"{reason} alone")

    def _held(self, part: Part, reason: str) -> Part:
        """The claims without a proof, if they hold; else without components."""
        try:
            checked(self._subject.mechanism, part, "written")
        except RefusedError as error:
            reason = f"no component is listed: {error}"
            return replace(part, components=(), idle=(), reason=reason)
        return replace(part, reason=reason)

    def _claims(
        self,
        question: str,
        components: Sequence[Component],
        idle: Sequence[Component],
        loci: Sequence[tuple[Polynomial, ...]],
        limb: str,
        locked: Sequence[str],
    ) -> Part:
        part = Part(
            question=question,
            origin=self._framed.origin,
            angles=tuple(dict(form) for form in self._ring.basis),
            rank=max(self._matrix.rank_at(*at) for at in self._postures),
            components=tuple(
                self._locus(c, own) for c, own in zip(components, loci, strict=True)
            ),
            form=self._subject.form,
            limb=limb,
            locked=tuple(locked),
            scales=self._scales() or None,
            idle=tuple(self._locus(c, self._polynomials(c)) for c in idle),
        )
        return self._covered(part)

    def _problem(
        self, loci: Iterable[tuple[Polynomial, ...]], question: str
    ) -> Problem:
        squares = {
            joint: self._framed.axis_square(joint) for joint in self._framed.joints
        }
        return Problem(
            self._root,
            self._matrix,
            tuple(loci),
            question == "actuation",
            self._library,
            self._signs,
            {j: square for j, square in squares.items() if not square.is_constant()},
            {joint: self._direction(joint) for joint in self._framed.joints},
            self._least(question),
            limbs=self._subject.limbs,
        )

    def _direction(self, joint: str) -> tuple[Polynomial, ...]:
        """Of a rotation, or else of a translation."""
        column = tuple(self._framed.column(joint))
        return column[:3] if any(x != 0 for x in column[:3]) else column[3:]

    def _least(self, question: str) -> int:
        """What a limb by its loop equations allows in general; −1 elsewhere."""
        if question != "limb" or not self._subject.form:
            return -1
        return max(self._matrix.freedom_at(*at) for at in self._postures)

    @property
    def _postures(self) -> Sequence[tuple[Point, int]]:
        """Exact ones, in general."""
        return self._root.points

    def _polynomials(self, component: Component) -> tuple[Polynomial, ...]:
        return self._read(component.equations)

    def _locus(self, component: Component, equations: tuple[Polynomial, ...]) -> Locus:
        branches = self._branches(equations, component.codimension)
        if not branches:
            raise NotProvedError("no exact posture on one of them was found")
        points = [at for branch in branches for at in branch.points]
        freedom = -1
        if not self._matrix.single:
            freedom = min(self._matrix.freedom_at(*at) for at in points)
        locus = Locus(
            component.equations,
            max(self._matrix.rank_at(*at) for at in points),
            freedom,
            tuple(reach_of(branch) for branch in branches),
        )
        return sides_of(self._real, locus, random.Random(11))

    def _covered(self, part: Part) -> Part:
        """With trees to all sheets of components, where they are found."""
        problem = self._problem((), "constraint")
        return with_covers(self._subject.mechanism, part, problem, self._read)

    def _read(self, equations: Sequence[str]) -> tuple[Polynomial, ...]:
        return tuple(evaluate(read(e), self._ring) for e in equations)

    def _branches(
        self, equations: tuple[Polynomial, ...], codimension: int
    ) -> list[Branch]:
        """The sheets of a component, those of special dimensions left out."""
        # A pair in half angles may stand first, and be a single condition.
        return self._sheets(equations, codimension) or self._sheets(
            sorted(equations, key=len), codimension
        )

    def _sheets(
        self, equations: Sequence[Polynomial], codimension: int
    ) -> list[Branch]:
        """As many equations imposed, in this order, as the codimension says."""
        search = Search(self._library)
        branches = [self._root]
        for equation in equations:
            # Equations beyond the codimension only tell the component from other zeros.
            branches = [
                b
                for a in branches
                for b in (
                    imposed(a, equation, search) if a.codimension < codimension else [a]
                )
            ]
        found = [
            branch
            for branch in branches
            if branch.points
            and not branch.is_special
            and all(residue(e, *at) == 0 for at in branch.points for e in equations)
        ]
        least = min((branch.codimension for branch in found), default=0)
        return [branch for branch in found if branch.codimension == least]

    def _twists(self) -> Mapping[str, JointTwist[Polynomial]]:
        return joint_twists(
            self._subject.mechanism,
            self._ring,
            self._framed.origin,
            self._subject.chain,
        )

    def _scales(self) -> dict[str, str]:
        """What the columns were multiplied with to clear divisors."""
        ring = self._ring
        if not ring.divisors_of:
            return {}
        twists = self._twists()
        found = {}
        for label in self._framed.joints:
            scale = ring.cleared(twists[label].coordinates)[1]
            if not scale.is_constant():
                found[label] = text(ring, scale)
        return found
