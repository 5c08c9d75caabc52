"""Cases of a node with what follows on each."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

from screwkit.algebra.factors import Factor
from screwkit.algebra.polynomial_text import text
from screwkit.algebra.trigonometric import TrigonometricRing
from screwkit.certificates.conditions import Option, Place
from screwkit.certificates.equations_told import Square
from screwkit.certificates.offer_choice import OfferChoice
from screwkit.certificates.real_squares import SumOfSquares
from screwkit.certificates.records import Case, Node, Sheet
from screwkit.certificates.roots import NotProvedError
from screwkit.certificates.steps import followed, numbers_of, written_step
from screwkit.certificates.texts import read


@dataclass
class CaseNodes(OfferChoice, ABC):
    """Writes them.

    Attributes:
        count: Nodes so far.
    """

    count: int = field(default=0, kw_only=True)

    @abstractmethod
    def node(self, place: Place) -> Node:
        """The proof of one node and everything below it."""

    def cases(
        self,
        place: Place,
        factors: Sequence[tuple[Factor, int]],
        options: Sequence[Sequence[Option]],
    ) -> tuple[Case, ...]:
        """Every factor with what follows on it, simple ones first."""
        order = sorted(
            range(len(factors)),
            key=lambda i: (
                any(option.step is None for option in options[i]),
                len(factors[i][0].equations[0]),
            ),
        )
        paired = any(len(own.equations) > 1 for own, _ in factors)
        return tuple(
            self.case(place, *factors[i], options[i], paired=paired) for i in order
        )

    def case(
        self,
        place: Place,
        own: Factor,
        power: int,
        options: Sequence[Option],
        *,
        paired: bool,
    ) -> Case:
        """One factor with what follows on it."""
        branch = place.branch
        ring = branch.ring
        texts = tuple(text(ring, equation) for equation in own.equations)
        case = Case(texts, power)
        if not options:
            if self.positive(branch, own):
                return replace(case, end="positive")
            divisor = self.in_divisor(branch, own)
            if divisor is not None:
                return replace(case, end="divisor", divisor=divisor)
            divisor = self.undefined(branch, own)
            if divisor is not None:
                return replace(case, end="undefined", divisor=divisor)
            angle, numbers = numbers_of(ring, own.equations[0])
            end = "elsewhere" if self.elsewhere(branch, own) else "unreal"
            return replace(case, end=end, angle=angle, numbers=numbers)
        if self.is_of_dimensions(branch, own):
            return replace(case, end="special")
        if options[0].step is None:
            told = _with_squares(case, ring, options[0].squares)
            return replace(told, kept=self.node(options[0].place))
        sheets = list[Sheet]()
        for option in options:
            last = len(option.place.branch.steps) - 1
            step = written_step(option.place.branch, last)
            sheets.append(Sheet(step, self.on_sheet(option)))
        return replace(case, sheets=tuple(sheets))

    def on_sheet(self, option: Option) -> Node:
        """The node of one solution."""
        if option.impossible is None:
            return self.node(option.place)
        number = self.count
        self.count += 1
        index = option.place.number(option.impossible)
        branch = option.place.branch
        (value,), over = followed(branch, [option.place.conditions[index]])
        written = text(branch.ring, value)
        if not self.problem.signs.never_zero(read(written)):
            raise NotProvedError("a condition that vanishes nowhere was not proved so")
        return Node(number, impossible=index, impossible_value=written, over=over)


def _with_squares(
    case: Case, ring: TrigonometricRing, found: SumOfSquares | None
) -> Case:
    """A case that is kept with the sum of squares that it is."""
    if found is None:
        return case
    squares = (Square(text(ring, w), text(ring, base)) for w, base in found.squares)
    return replace(case, times=text(ring, found.times), squares=tuple(squares))
