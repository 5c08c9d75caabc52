"""What a locus means: a statement about the mechanism's own points and axes.

Statements are first tried at exact points of the locus, then compared with it as sets;
only an equivalent one is called its meaning.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from itertools import islice

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.cases import possible_factors
from screwkit.algebra.constant_multiples import condition_key
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.points import Point as ExactPoint
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.common_lines import AxesPlane, limb_planes, with_common_line
from screwkit.loci.conjunctions import conjunction
from screwkit.loci.far_statements import far_statements
from screwkit.loci.features import FAR, LONG, Features, Statement, statements
from screwkit.loci.figures import GIVEN, Figures, figure_among
from screwkit.loci.local_conjunctions import up_to_others
from screwkit.loci.pieces import Piece, pieces_of
from screwkit.loci.placed_features import Residue, bands_of, features_at, features_of
from screwkit.loci.said_together import Conjunction, Said, is_met, where_else
from screwkit.loci.same_zeros import proviso, without_condition
from screwkit.loci.shared_figures import shared_figure

_OF_TWO = ("line", "on", "coincide", "parallel", "perpendicular", "meet")
_SHORT = 60  # terms of a statement that is looked at together with others
_DEPENDENT = 20  # figures of one kind that are looked at together
_LONG_LINES = 100  # terms of a minor of the lines of limbs
_LARGEST = 400  # terms of a statement that is compared with a locus


class Meanings:
    """The features of a mechanism in one frame, and what loci mean in them."""

    def __init__(
        self,
        framed: FramedTwists,
        root: Branch,
        library: FactorLibrary,
        figures: Sequence[Figures] = (),
        figures_on: Callable[[Piece, bool], Figures] | None = None,
        conditions: Sequence[Polynomial] = (),
        singular: Callable[[Branch], bool] | None = None,
    ) -> None:
        """What is looked at: axes and points, then figures of lines.

        ``figures_on`` gives lines that a limb resists along on a piece alone, rather
        such as are lost nowhere if that is asked; ``conditions`` are those of single
        limbs, each irreducible; ``singular`` tells whether all of a branch is, where
        all singular postures are known.
        """
        self._framed = framed
        self._root = root
        self._library = library
        self._figures = figures
        self._figures_on = figures_on
        self._conditions = conditions
        self._singular = singular
        self._found: dict[frozenset[str], str | None] = {}
        self._at: dict[tuple[int, ...], Features[Residue]] = {}

    @cached_property
    def features(self) -> Features[Polynomial]:
        """The features, exact."""
        return features_of(self._framed)

    @cached_property
    def _statements(self) -> tuple[Statement, ...]:
        return self._not_everywhere(statements(self.features))

    @cached_property
    def _bands(self) -> list[tuple[str, str]]:
        return bands_of(self._framed.ring, self.features)

    @cached_property
    def _far(self) -> tuple[Statement, ...]:
        return self._not_everywhere(far_statements(self.features, self._bands))

    @cached_property
    def _planes(self) -> list[AxesPlane]:
        return limb_planes(self._framed.ring, self.features, self._bands)

    def _not_everywhere(self, found: Iterable[Statement]) -> tuple[Statement, ...]:
        """Those that do not hold everywhere."""
        generic = self._root.points[0]
        features = self._features_at(*generic)
        return tuple(
            statement
            for statement in found
            if any(v.value for v in statement.scalars(features))
        )

    def of(self, piece: Piece) -> str | None:
        """A sentence that holds exactly on the piece; None where none was found."""
        key = frozenset(_keys(piece))
        if key not in self._found:
            self._found[key] = self._search(piece)
        return self._found[key]

    def _search(self, piece: Piece) -> str | None:
        candidates = self._holding(piece.branches, 2)
        same = (s for s in candidates if self._same_set(s, piece))
        statement = next(same, None)
        if statement is not None and statement.kind not in LONG:
            return statement.words
        figure = self._figure(piece)
        if figure is not None and GIVEN not in figure:
            return figure
        if statement is not None:
            return statement.words
        return self._given(candidates, piece) or figure

    def _figure(self, piece: Piece) -> str | None:
        """Of lines that become dependent; rather without a proviso."""
        return figure_among(self._figures, piece)

    def of_limb(self, piece: Piece, others: Sequence[Piece] = ()) -> str | None:
        """The same of a limb's twists; of six axes that they are dependent at least.

        ``others`` are all pieces of the limb.
        """
        found = self.of(piece) or self.each_of(piece, others, "the limb")
        return found or self.of_six_lines(piece, others, "the limb")

    def of_six_lines(
        self, piece: Piece, others: Sequence[Piece] = (), before: int | str = 0
    ) -> str | None:
        """Six lines of one linear complex, which says no more than dependent."""
        found = (figures.of(piece, 6, 6) for figures in self._figures)
        sentence = next((sentence for sentence in found if sentence), None)
        return sentence or self._shared(piece, others, before, (6, 6))

    def _shared(
        self,
        piece: Piece,
        others: Sequence[Piece],
        before: int | str,
        sizes: tuple[int, int] = (1, 5),
    ) -> str | None:
        if len(piece.equations) > 1:
            return None
        ring = self._framed.ring
        return shared_figure(ring, self._figures, piece, others, before, sizes)

    def each_of(
        self, piece: Piece, others: Sequence[Piece] = (), before: int | str = 0
    ) -> str | None:
        """A sentence for the piece, or for each of its equations, or several together.

        Args:
            piece: A component.
            others: All components in the order in which they are counted; a sentence
                that holds on several of them and nowhere else says so.
            before: Components that are counted before these; whose they are where that
                is not known.
        """
        if len(piece.equations) == 1:
            return self.of(piece) or self._shared(piece, others, before)
        # Whether a statement about axes is several equations at once takes long.
        whole = self._figure(piece)
        if whole is not None:
            return whole
        alone = self._each_alone(piece)
        if len(alone) > piece.codimension or not alone:
            alone = self._together(piece, others, before) or alone
        return "; ".join(alone) or None

    def _together(
        self, piece: Piece, others: Sequence[Piece], before: int | str
    ) -> list[str] | None:
        """Statements and figures that hold on the piece, as many as it takes."""
        if not all(branch.points for branch in piece.branches):
            return None
        given = self._root, self._library, others
        said = [*self._said_of(piece)]
        found = conjunction(piece, said, *given)
        if found is None and self._figures_on is not None:
            found = self._with_limbs_lines(piece, others)
        if found is None:
            more = [*said, *self._with_common_line(piece)]
            found = up_to_others(piece, more, *given, self._singular)
        if found is None:
            return None
        words = list(found.words)
        words[-1] += where_else(found, len(others), before)
        return words

    def _said_of(self, piece: Piece) -> Iterator[Said]:
        """Of axes and points, then of dependent lines, then of more than two."""
        holding = self._holding(piece.branches)
        short = [s for s in holding if s.kind in _OF_TWO]
        for statement in short:
            yield from self._said(statement)
        own = [] if self._figures_on is None else [self._figures_on(piece, False)]
        for figures in (*self._figures, *own):
            yield from _dependent(figures.holding(piece), _SHORT)
        for statement in holding:
            if statement.kind not in (*_OF_TWO, FAR):
                yield from self._said(statement)
        far = [s for s in holding if s.kind == FAR]
        for statement in [*far, *self._holding(piece.branches, among=self._far)]:
            yield from self._said(statement)

    def _with_common_line(self, piece: Piece) -> Iterator[Said]:
        given = self._framed.ring, self._planes, self._root, piece
        for words, minors in with_common_line(*given):
            if not any(len(minor) > _LONG_LINES for minor in minors):
                yield words, [primitive(minor) for minor in minors]

    def _with_limbs_lines(
        self, piece: Piece, others: Sequence[Piece]
    ) -> Conjunction | None:
        """Statements of single equations, and of lines that limbs resist along there.

        Where each equation has one, together they are the piece as it is written.
        """
        equations = piece.equations
        exact: dict[int, Said] = {}
        for number, equation in enumerate(equations):
            sentence = self._of_equation(equation)
            if sentence is not None:
                exact[number] = sentence, [equation]
        lines = self._lines_of_limbs(piece)
        ring = self._framed.ring
        wanted = {condition_key(ring, e): n for n, e in enumerate(equations)}
        for one in lines:
            number = wanted.get(self._condition(one) or "", -1)
            if number >= 0:
                exact.setdefault(number, one)
        named = [exact[number] for number in sorted(exact)]
        if len(named) == len(equations):
            return Conjunction(tuple(words for words, _ in named))
        given = {str(equation) for equation in equations}
        limbs = [
            (sentence, [condition])
            for condition in self._conditions
            if str(condition) not in given and is_met(("", [condition]), piece)
            for sentence in [self._of_equation(condition)]
            if sentence is not None
        ]
        said = [*named, *limbs, *self._with_common_line(piece), *lines]
        return up_to_others(
            piece, said, self._root, self._library, others, self._singular
        )

    def _lines_of_limbs(self, piece: Piece) -> list[Said]:
        if self._figures_on is None:
            return []
        figures = self._figures_on(piece, True)
        return [*_dependent(figures.holding(piece, 6), _LONG_LINES)]

    def _condition(self, said: Said) -> str | None:
        """The key of the one condition that a statement is; None of others."""
        _, values = said
        if len(values) != 1:
            return None
        factors = possible_factors(self._root, values[0], self._library)
        if len(factors) != 1 or len(factors[0].equations) != 1:
            return None
        return condition_key(self._framed.ring, factors[0].equations[0])

    def _said(self, statement: Statement) -> Iterator[Said]:
        scalars = self._scalars(statement)
        if scalars and not any(len(value) > _SHORT for value in scalars):
            yield statement.words, scalars

    def _each_alone(self, piece: Piece) -> list[str]:
        """A sentence for each of the equations; empty where one has none."""
        sentences: list[str] = []
        for equation in piece.equations:
            sentence = self._of_equation(equation)
            if sentence is None:
                return []
            sentences.append(sentence)
        return list(dict.fromkeys(sentences))

    def _of_equation(self, equation: Polynomial) -> str | None:
        """A sentence for an equation of a piece, for itself."""
        branches = restricted(self._root, equation)
        if not branches or branches[0].is_special:
            return None
        return self._alone(Piece((equation,), tuple(branches)))

    def _alone(self, piece: Piece) -> str | None:
        """A sentence without proviso: others of the equations may contradict it."""
        sentence = self.of(piece)
        return None if sentence is None or GIVEN in sentence else sentence

    def _holding(
        self,
        branches: Sequence[Branch],
        seen: int | None = None,
        among: Sequence[Statement] | None = None,
    ) -> list[Statement]:
        points = [point for branch in branches[:seen] for point in branch.points]
        if not points:
            return []
        found = [*(self._statements if among is None else among)]
        for point in points:
            features = self._features_at(*point)
            found = [
                statement
                for statement in found
                if not any(v.value for v in statement.scalars(features))
            ]
        return found

    def _scalars(self, statement: Statement) -> list[Polynomial]:
        ring = self._framed.ring
        values = [ring.normal(v) for v in statement.scalars(self.features)]
        cleared = [ring.without_divisors([v])[0] for v in values if v != 0]
        return [primitive(v) for v in cleared]

    def _same_set(self, statement: Statement, piece: Piece) -> bool:
        scalars = self._scalars(statement)
        if any(len(value) > _LARGEST for value in scalars):
            return False
        if len(scalars) == 1 and len(piece.equations) == 1:
            factors = possible_factors(self._root, scalars[0], self._library)
            ring = self._framed.ring
            key = condition_key(ring, piece.equations[0])
            return len(factors) == 1 and not without_condition(ring, factors, key)
        if len(piece.equations) == 1:
            return self._only_there(statement, piece)
        search = Search(self._library, budget=12)
        zeros = common_zeros(self._root, scalars, search)
        pieces = pieces_of(zeros.branches)
        return zeros.complete and len(pieces) == 1 and _keys(pieces[0]) == _keys(piece)

    def _only_there(self, statement: Statement, piece: Piece) -> bool:
        """Whether the statement holds nowhere else: by a sum of squares.

        A vector of real numbers vanishes exactly where the sum of its squares does.
        """
        ring = self._framed.ring
        values = [ring.normal(v) for v in statement.scalars(self.features)]
        key = condition_key(ring, piece.equations[0])
        for start in range(0, len(values), 3):
            part = values[start : start + 3]
            square = ring.normal(sum((v * v for v in part), ring.zero))
            if square == 0 or len(square) > _LARGEST:
                continue
            factors = possible_factors(self._root, square, self._library)
            if factors and not without_condition(ring, factors, key):
                return True
        return False

    def _given(self, candidates: Sequence[Statement], piece: Piece) -> str | None:
        """A statement that is the piece and one short condition more."""
        if len(piece.equations) != 1:
            return None
        ring = self._framed.ring
        key = condition_key(ring, piece.equations[0])
        for statement in candidates:
            scalars = self._scalars(statement)
            if len(scalars) != 1 or len(scalars[0]) > _LARGEST:
                continue
            factors = possible_factors(self._root, scalars[0], self._library)
            others = without_condition(ring, factors, key)
            given = proviso(ring, others) if len(others) < len(factors) else None
            if given is not None:
                return f"{statement.words} ({given})"
        return None

    def _features_at(self, point: ExactPoint, prime: int) -> Features[Residue]:
        key = (*point, prime)
        if key not in self._at:
            self._at[key] = features_at(self.features, point, prime)
        return self._at[key]


def _dependent(
    holding: Iterable[tuple[str, Sequence[Polynomial]]], longest: int
) -> Iterator[Said]:
    """Figures that hold on a piece with what vanishes there, long ones left out."""
    for words, minors in islice(holding, _DEPENDENT):
        values = [primitive(minor) for minor in minors if minor != 0]
        if values and not any(len(value) > longest for value in values):
            yield words, values


def _keys(piece: Piece) -> set[str]:
    return {str(primitive(equation)) for equation in piece.equations}
