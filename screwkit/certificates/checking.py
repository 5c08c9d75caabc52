"""Checks a certificate from the mechanism alone, with residues at random points.

Nothing here expands, factors or solves a polynomial.  An identity is checked by its
values: if it were false, values modulo a random 61-bit prime would agree with a
probability below degree/2⁶⁰ [Schwartz1980].  That the cases of a node cover it, and
that the sheets of a case are all solutions, is checked rule by rule.

References: [CoxLittleOShea] §9.1; docs/decisions/0019-certificates.md.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import replace

from screwkit.algebra.expression import Expression
from screwkit.algebra.expression_building import symbols_of
from screwkit.algebra.modular import ResampleError
from screwkit.certificates.claimed_loci import ClaimedLoci
from screwkit.certificates.closed_postures import ClosedPostures
from screwkit.certificates.coefficients import Coefficients
from screwkit.certificates.empty_nodes import EmptyNodes
from screwkit.certificates.findings import Findings, name_of
from screwkit.certificates.general_claims import GeneralClaims
from screwkit.certificates.graph_matrix import GraphMatrix
from screwkit.certificates.limb_claims import LimbClaims
from screwkit.certificates.multiples import follows
from screwkit.certificates.plain_texts import all_plain
from screwkit.certificates.postures import Postures, Way
from screwkit.certificates.products import Products, is_minor
from screwkit.certificates.real_postures import RealPostures
from screwkit.certificates.records import (
    Case,
    Certificate,
    Floor,
    Locus,
    Node,
    Part,
    Sheet,
)
from screwkit.certificates.scheme_claims import check_schemes
from screwkit.certificates.screw_matrix import ScrewMatrix
from screwkit.certificates.sheets import Sheets
from screwkit.certificates.signs import Signs, declared_signs
from screwkit.certificates.solutions import Solutions
from screwkit.certificates.texts import NoPostureError, RefusedError, read
from screwkit.certificates.towers import Towers
from screwkit.mechanism.graph import limbs
from screwkit.mechanism.model import Mechanism

ATTEMPTS = 8
"""Choices of postures before a part is given up."""


def check(
    certificate: Certificate, mechanism: Mechanism, seed: int
) -> tuple[Findings, ...]:
    """Check every part of a certificate.

    Args:
        certificate: What is claimed.
        mechanism: As read from its file.
        seed: Of the random postures; whoever wrote the certificate must not know it.

    Returns:
        What was seen of each part beyond what it claims.

    Raises:
        RefusedError: With what does not hold.
    """
    if not certificate.parts and not certificate.schemes and limbs(mechanism):
        raise RefusedError("it claims nothing")
    if certificate.schemes is not None:
        check_schemes(certificate.schemes, mechanism, f"{seed}/schemes")
    found = []
    for number, part in enumerate(certificate.parts):
        try:
            found.append(
                checked(mechanism, part, f"{seed}/{number}", certificate.parts)
            )
        except RefusedError as refusal:
            raise RefusedError(f"{name_of(part)}: {refusal}") from None
    return tuple(found)


def checked(
    mechanism: Mechanism, part: Part, seed: str, others: Sequence[Part] = ()
) -> Findings:
    """Check a part; again with other postures where one lacks a root.

    Args:
        mechanism: As read from its file.
        part: What is claimed.
        seed: Of the random postures.
        others: Parts about limbs, on whose proofs this one may rest; each is checked
            on its own.

    Raises:
        RefusedError: With what does not hold.
    """
    missing = RefusedError("roots or inverses in it do not exist at random postures")
    for attempt in range(ATTEMPTS):
        source = random.Random(f"{seed}/{attempt}")
        try:
            return PartCheck(mechanism, part, source, others).all()
        except ResampleError:
            continue
        except NoPostureError as refusal:  # nor, perhaps, modulo this prime alone
            missing = refusal
            continue
        except (LookupError, ArithmeticError, ValueError, RecursionError) as error:
            # Names, numbers or depths that the mechanism does not have.
            raise RefusedError(f"it does not fit the mechanism: {error!r}") from None
    raise missing


class PartCheck:
    """One part of a certificate under examination."""

    def __init__(
        self,
        mechanism: Mechanism,
        part: Part,
        source: random.Random,
        others: Sequence[Part] = (),
    ) -> None:
        self._part = part
        self._postures = Postures(mechanism, part, source)
        self._matrix: ScrewMatrix | GraphMatrix
        if part.form == "loops":
            self._matrix = GraphMatrix(self._postures)
        else:
            self._matrix = ScrewMatrix(self._postures)
        self._signs = Signs(*declared_signs(mechanism))
        self._dimensions = {p.name for p in mechanism.parameters if not p.free}
        self._sheets = Sheets(self._postures, source)
        self._empty = EmptyNodes(self._postures, self._matrix, self._signs)
        self.general = GeneralClaims(
            self._postures,
            self._matrix,
            self._sheets,
            self._dimensions,
            self._signs.nonzero,
        )
        self._limbs = LimbClaims(self._postures, self._matrix, others)
        self._products = Products(self._postures, self._matrix, self._limbs)
        self._solutions = Solutions(self._postures, self._signs)
        self._closed = ClosedPostures(mechanism, self._postures)
        known = Coefficients(self._postures, source)
        towers = Towers(self._postures, self._sheets, known)
        self.loci = ClaimedLoci(
            self._matrix, self._sheets, towers, self._closed, self.general
        )
        self._real = RealPostures(
            self._postures.declared,
            len(part.angles),
            [name for name in self._postures.symbols if name != "pi"],
            self._signs.positive,
            self._signs.nonzero,
        )
        self._finished: dict[int, Way] = {}
        self._met: set[int] = set()
        self._covered: Locus | None = None
        self._floor: Floor | None = None

    def all(self) -> Findings:
        """Check the part."""
        part = self._part
        if part.question not in ("limb", "constraint", "actuation"):
            raise RefusedError(f"{part.question!r} is no question")
        if part.question != "actuation" and (part.locked or part.idle):
            raise RefusedError("only actuation locks joints")
        all_plain(part, self._postures, self._signs)
        self._closed.demanded()
        loci = self.loci
        loci.generic()
        real = []
        for number, locus in enumerate((*part.components, *part.idle)):
            moves = number < len(part.components)
            try:
                self._cover(locus)
                loci.component(locus, moves=moves)
                if self._real.shown(locus) and self._is_everywhere():
                    real.append(locus.equations)
            except RefusedError as refusal:
                text = " = 0, ".join(locus.equations)
                raise type(refusal)(f"component {text} = 0: {refusal}") from None
        if part.proof is not None:
            loci.none_inside_another()
            self._node(part.proof, Way(conditions=self._closed.conditions))
        for floor in part.floors:
            self._of_floor(floor)
        return Findings(
            tuple(loci.irreducible),
            tuple(real),
            tuple(loci.sampled),
            tuple(self.general.sampled),
            tuple(loci.wider),
        )

    def _is_everywhere(self) -> bool:
        """Whether the geometry exists wherever angles and symbols have values."""
        never_zero = self._signs.never_zero
        if self._postures.tied:
            return False
        return self._postures.plain and all(map(never_zero, self._postures.divisors))

    def _cover(self, locus: Locus) -> None:
        """Meet all sheets of a component, by a tree of its own where there is one."""
        loci = self.loci
        if len(locus.equations) == 1:
            loci.equation(locus)
            if not self._postures.tied:
                return
        if locus.cover is None:
            loci.sampled[locus.equations] = None
            loci.unseen(locus)
            return
        self._covered = locus
        start = (*self._closed.conditions, *locus.equations)
        self._node(locus.cover, Way(conditions=start))
        loci.covered(locus, locus.cover)
        self._covered = None
        self._finished.clear()
        self._met.clear()

    def _of_floor(self, floor: Floor) -> None:
        """A limb keeps a rank off some loci."""
        if self._part.question != "limb" or floor.rank < 1:
            raise RefusedError("only limbs keep a rank")
        self._finished.clear()
        self._met.clear()
        self._floor = floor
        self._node(floor.proof, Way(conditions=self._closed.conditions))
        self._floor = None

    # -- the tree --------------------------------------------------------------------

    def _node(self, node: Node, way: Way) -> None:
        if node.number in self._met or node.number < 0:
            raise RefusedError(f"node {node.number} stands twice")
        self._met.add(node.number)
        try:
            self._examined(node, way)
        except RefusedError as refusal:
            if str(refusal).startswith("node "):
                raise
            raise type(refusal)(f"node {node.number}: {refusal}") from None
        self._finished[node.number] = way

    def _examined(self, node: Node, way: Way) -> None:
        if self._covered is not None and (
            node.columns or node.limbs or not self.loci.is_known(node.component)
        ):
            raise RefusedError("it says nothing about a component's own postures")
        if node.sheet and self._floor is not None:
            raise RefusedError("of a floor's loci no sheets are known")
        if node.sheet:
            if self._covered is None:
                self.loci.on_components(node, way)
            else:
                self.loci.sheet(self._covered, way, node)
            for case in node.cases:
                self._case(case, way)
        elif node.small:
            self.loci.small(self._covered, way)
        elif node.component >= 0:
            self._on_component(node, way)
        elif node.earlier >= 0:
            self._in_earlier(node, way)
        elif node.axis:
            self._empty.without_axis(node, way)
        elif node.vanishing:
            self._empty.vanishing(node.vanishing, way)
        elif node.special:
            self.general.special(node, way)
        elif node.impossible >= 0:
            self._empty.impossible(node, way)
        else:
            if node.limbs:
                self._limbs.check(node, way)
            self._products.check(node, way, self._size_of(node))
            if self._smaller_ones and is_minor(node) and self._floor is None:
                self.general.bounded(node, way, max(0, self.loci.freedom))
            for equations, fallen in self._limbs.fallen(node):
                conditions = (*way.conditions, *equations)
                self._node(fallen, replace(way, conditions=conditions))
            for case in node.cases:
                self._case(case, way)

    def _zero_on(self, expression: Expression, way: Way) -> bool:
        """Whether it vanishes by the solved steps of a way alone."""
        points = self._postures.several(way)
        return all(point.value(expression) == 0 for point in points)

    def _on_component(self, node: Node, way: Way) -> None:
        loci = [locus.equations for locus in self._part.components]
        if self._floor is not None:
            loci = [*self._floor.loci]
        try:
            equations = loci[node.component]
        except IndexError:
            raise RefusedError(f"there is no component {node.component}") from None
        multiples = {multiple.equation: multiple for multiple in node.multiples}
        for number, text in enumerate(equations):
            for point in self._postures.several(way):
                value = point.value(read(text))
                if not follows(value, multiples.get(number), way, point):
                    raise RefusedError(f"{text} does not vanish on it")

    def _in_earlier(self, node: Node, way: Way) -> None:
        earlier = self._finished.get(node.earlier)
        if earlier is None:
            raise RefusedError(f"node {node.earlier} was not finished before")
        for text in earlier.conditions:
            if not self._is_condition(text, way) and not self._zero_on(read(text), way):
                raise RefusedError(f"it is not in node {node.earlier}")
        for point in self._postures.several(way):
            if not all(
                self._solutions.satisfied(step, point) for step in earlier.steps
            ):
                raise RefusedError(f"it is not in node {node.earlier}")

    def _is_condition(self, text: str, way: Way) -> bool:
        """Whether an expression is a condition of a way, however that is written."""
        if text in way.conditions:
            return True
        points = self._postures.several(Way())
        own = [point.value(read(text)) for point in points]
        return any(
            [point.value(read(condition)) for point in points] == own
            for condition in way.conditions
        )

    def _size_of(self, node: Node) -> int:
        """What size a node's minor must have."""
        if self._floor is not None:
            return self._floor.rank
        return node.rank if self._smaller_ones else self._part.rank

    @property
    def _smaller_ones(self) -> bool:
        """Whether the locus is not simply where the rank of the matrix falls."""
        return self._part.question == "actuation" or self.loci.freedom >= 0

    # -- cases -----------------------------------------------------------------------

    def _case(self, case: Case, way: Way) -> None:
        texts = [read(text) for text in case.equations]
        if case.end == "positive":
            if len(texts) != 1 or not self._signs.never_zero(texts[0]):
                raise RefusedError(f"{case.equations[0]} may vanish")
        elif case.end == "special":
            if not any(self._is_of_dimensions(e) for e in texts):
                raise RefusedError(f"{case.equations[0]} is not of dimensions alone")
        elif case.end == "unreal":
            a, b, c = self._solutions.numbers(case, case.angle, case.numbers, way)
            if c * c <= a * a + b * b:
                raise RefusedError(f"{case.equations[0]} has real solutions")
        elif case.end == "elsewhere":
            self._solutions.elsewhere(case, way)
        elif case.end in ("divisor", "undefined"):
            self._solutions.divides(case, way)
        elif case.end:
            raise RefusedError(f"{case.end!r} is no reason")
        elif case.sheets:
            self._solutions.solved(case, [sheet.step for sheet in case.sheets], way)
            for sheet in case.sheets:
                self._sheet(sheet, way)
        elif case.kept is not None:
            if case.squares and self._covered is not None:
                raise RefusedError("at real postures alone no sheet is met")
            bases = self._solutions.squares(case, way)
            conditions = (*way.conditions, *case.equations, *bases)
            self._node(case.kept, replace(way, conditions=conditions))
        else:
            raise RefusedError(f"{case.equations[0]}: nothing is said of this case")

    def _is_of_dimensions(self, expression: Expression) -> bool:
        """Whether an expression holds for special dimensions alone, if for any."""
        point = next(self._postures.on(Way()))
        return symbols_of(expression) <= self._dimensions and bool(
            point.value(expression) != 0
        )

    def _sheet(self, sheet: Sheet, way: Way) -> None:
        self._node(sheet.node, replace(way, steps=(*way.steps, sheet.step)))
