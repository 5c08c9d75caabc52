"""Where schemes fail: the common factors of a few minors, confirmed at exact points."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import islice

from screwkit.algebra.branches import restricted
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import Factor, Factored, factor
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.real_zeros import vanishing_together
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import primitive
from screwkit.kinematics.assembly import Assembly
from screwkit.loci.figures import Figures, figure_among
from screwkit.loci.hybrid_actuation import hybrid_actuation_locus
from screwkit.loci.limb_extensors import Content, Minor
from screwkit.loci.meanings import Meanings
from screwkit.loci.mechanism_figures import axes_of, figures_of
from screwkit.loci.passive import PassiveSystem, Ranks
from screwkit.loci.pieces import Piece
from screwkit.loci.witness import Witnesses
from screwkit.results.schemes import LocusFactor

_NAMED = 80  # terms; no statement of the catalogue is longer
_LOOKED_AT = 60  # minors of one scheme

_BY_WRENCHES = 40  # factors that are compared with the wrenches of their schemes

_REAL = 40  # case distinctions for the real zeros of a factor

STRATA = 100_000
"""Terms of minors that the strata of one scheme count as; they take as long."""


@dataclass(frozen=True)
class SchemeLocus:
    """What was found of a locus; see `Scheme`."""

    factors: tuple[tuple[Factor, int], ...]
    undecided: bool = False
    deeper: bool = False


@dataclass
class LociOfSchemes:
    """What the schemes of one mechanism share."""

    assembly: Assembly
    system: PassiveSystem
    left: int
    counts: Counter[str] = field(default_factory=Counter)
    seen: dict[str, Factor] = field(default_factory=dict)
    schemes: dict[str, Sequence[str]] = field(default_factory=dict)
    left_out: set[str] = field(default_factory=set)
    tables: dict[str, list[list[Ranks]]] = field(default_factory=dict)
    vanishing: dict[str, bool] = field(default_factory=dict)
    real: dict[str, list[list[Ranks]]] = field(default_factory=dict)
    factored: dict[str, Content] = field(default_factory=dict)
    figures: dict[Sequence[str], tuple[Figures, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        framed = self.assembly.common_twists
        self.ring = framed.ring
        self.root = self.assembly.root(framed.ring)
        self.witnesses = Witnesses(self.assembly, self.system)
        self.library = self.assembly.library(framed.ring)
        self.axes = {
            f.key
            for square in self.root.nonvanishing
            for f, _ in factor(self.ring, square, self.library).factors
        }

    def locus(self, passive: Sequence[str], mobility: int) -> SchemeLocus:
        """The factors on which the passive twists become dependent.

        Args:
            passive: The joints that are not locked.
            mobility: What they can move in general.
        """
        if self.assembly.has_blocks:
            return self._of_strata(passive)
        if len(self.assembly.limbs) < 2:
            return SchemeLocus(())
        minors = self._minors(passive)
        if not minors:
            return SchemeLocus((), undecided=True)
        whole = self.system.fills(passive) and len(minors) == 1
        seen: list[dict[str, tuple[Factor, int]]] = []
        common: dict[str, tuple[Factor, int]] = {}
        for minor in minors:
            own = self._factors(minor)
            shared = {
                key: (f, min(n, own[key][1]))
                for key, (f, n) in common.items()
                if key in own
            }
            common = shared if seen else own
            seen.append(own)
            if not common:
                break
        kept, undecided = {}, False
        for key, entry in common.items():
            falls = True if whole else self._falls(entry[0], passive, mobility)
            undecided = undecided or falls is None
            if falls:
                kept[key] = entry
        # Where one minor vanishes on nothing else, nothing else fails.
        all_of_it = any(own.keys() <= kept.keys() for own in seen)
        return SchemeLocus(tuple(kept.values()), undecided, not all_of_it)

    def _of_strata(self, passive: Sequence[str]) -> SchemeLocus:
        """Where limbs with loops inside lose their hold: pieces of one condition."""
        if self.left <= 0:
            return SchemeLocus((), undecided=True)
        self.left -= STRATA
        locked = [joint for joint in self.assembly.joints if joint not in passive]
        locus = hybrid_actuation_locus(self.assembly, locked)
        found: dict[str, tuple[Factor, int]] = {}
        for piece in locus.pieces:
            if piece.codimension == 1:
                parts = factor(self.ring, piece.equations[0], self.library).factors
                found |= {f.key: (f, 1) for f, _ in parts if self._can_vanish(f)}
        deeper = any(piece.codimension > 1 for piece in locus.pieces)
        return SchemeLocus(tuple(found.values()), not locus.complete, deeper)

    def _factors(self, minor: Minor) -> dict[str, tuple[Factor, int]]:
        """The factors of a minor that can vanish, with their multiplicities."""
        found: dict[str, tuple[Factor, int]] = {}
        text = str(primitive(minor.rest))
        if text not in self.factored:
            self.factored[text] = factor(self.ring, minor.rest, self.library).factors
        for f, n in (*minor.content, *self.factored[text]):
            if self._can_vanish(f):
                found[f.key] = (f, n + found[f.key][1] if f.key in found else n)
        return found

    def _minors(self, passive: Sequence[str]) -> list[Minor]:
        """Minors of the passive columns, shortest first, while there is work left."""
        if self.left <= 0:
            return []
        minors = list(islice(self.system.maximal_minors(passive), _LOOKED_AT))
        self.left -= sum(len(minor.rest) for minor in minors)
        return sorted(minors, key=lambda minor: len(minor.rest))

    def _can_vanish(self, f: Factor) -> bool:
        if f.key not in self.vanishing:
            self.vanishing[f.key] = self._may_vanish(f)
        return self.vanishing[f.key]

    def _may_vanish(self, f: Factor) -> bool:
        if f.key in self.axes:
            return False
        if not self.root.assumptions.is_nonzero(self.ring, f.equations[0]):
            return True
        self.left_out.add(equation_text(self.ring, f.equations[0]))
        return False

    def _falls(self, f: Factor, passive: Sequence[str], mobility: int) -> bool | None:
        """Whether more moves on a factor than in general; None if no point is known."""
        tables = self._tables_on(f)
        if not tables:
            return None
        rank = len(passive) - mobility
        return any(table.loop_rank(passive) < rank for own in tables for table in own)

    def _tables_on(self, f: Factor) -> list[list[Ranks]]:
        """Ranks at exact points on a factor, sheet by sheet; none if one has none."""
        if f.key not in self.tables:
            branches = restricted(self.root, f.equations[0], f.equations[1:])
            tables = [
                [self.system.table_at(*point) for point in branch.points]
                for branch in branches
            ]
            self.tables[f.key] = tables if all(tables) else []
        return self.tables[f.key]

    def text(self, f: Factor) -> str:
        """The factor as one equation; a half-angle factor as its square."""
        if len(f.equations) == 1:
            return equation_text(self.ring, f.equations[0])
        square = Factored(Fraction(1), ((f, 2),)).expand(self.ring)
        return equation_text(self.ring, primitive(square))

    def is_idle(self, f: Factor, passive: Sequence[str]) -> bool:
        """Whether the platform stays fixed on the factor: only limbs move.

        Then one limb's passive twists are dependent, which is a condition on that
        limb's joints alone.
        """
        if len(self._limbs_in(f)) > 1:
            return False
        pieces = self._real_tables_on(f) or self._tables_on(f)
        return bool(pieces) and all(
            any(table.state(passive).platform_freedom == 0 for table in tables)
            for tables in pieces
        )

    def _real_tables_on(self, f: Factor) -> list[list[Ranks]]:
        """Ranks where a factor that keeps its sign has real zeros, piece by piece.

        These are smaller than its zeros are, and more may move there.  None of another
        factor, or where they were not all found.
        """
        if f.key in self.real:
            return self.real[f.key]
        terms = None
        if len(f.equations) == 1:
            signs = self.root.assumptions
            terms = vanishing_together(self.ring, signs, f.equations[0])
        self.real[f.key] = []
        if terms is not None:
            zeros = common_zeros(self.root, terms, Search(self.library, budget=_REAL))
            if zeros.complete and all(branch.points for branch in zeros.branches):
                self.real[f.key] = [
                    [self.system.table_at(*point) for point in branch.points]
                    for branch in zeros.branches
                ]
        return self.real[f.key]

    def _limbs_in(self, f: Factor) -> set[int]:
        """Numbers of the limbs whose joint variables occur in a factor."""
        ring = self.ring
        names: set[str] = set()
        for equation in f.equations:
            for kind, number in unknowns(ring, equation):
                if kind == "x":
                    names.add(ring.symbols[number - ring.symbol_indices()[0]])
                else:
                    names.update(name for name, _ in ring.basis[number])
        assembly = self.assembly
        return {
            number
            for number, limb in enumerate(assembly.limbs)
            if any(assembly.variable_of(j) in names for j in limb.joints)
        }

    def factors(self) -> tuple[LocusFactor, ...]:
        """Every factor that occurred, with its meaning."""
        given = self.assembly.common_twists, self.root, self.library
        meanings = Meanings(*given, axes_of(*given))
        found = []
        left = _BY_WRENCHES
        for key, count in self.counts.most_common():
            f = self.seen[key]
            terms = len(f.equations[0])
            piece = self._piece(f) if terms <= _NAMED else None
            meaning = meanings.of(piece) if piece else None
            if piece and meaning is None and left:
                left -= 1
                meaning = figure_among(self._wrenches(self.schemes[key]), piece)
            found.append(LocusFactor(self.text(f), meaning, terms, count))
        return tuple(sorted(found, key=lambda f: (f.terms, f.equation)))

    def _piece(self, f: Factor) -> Piece | None:
        branches = restricted(self.root, f.equations[0], f.equations[1:])
        return Piece(f.equations, tuple(branches)) if branches else None

    def _wrenches(self, actuated: Sequence[str]) -> tuple[Figures, ...]:
        """What limbs transmit with these joints locked."""
        key = tuple(actuated)
        if key not in self.figures:
            self.figures[key] = figures_of(self.assembly, key)
        return self.figures[key]
