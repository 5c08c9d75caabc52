"""A certificate: what is claimed about singular loci, and the tree that proves it.

The claim of a part is about one matrix of screws: its generic rank, and the components
on which it falls (for actuation: on which the platform moves).  The proof is a tree of
case distinctions.  A node stands for the postures that satisfy everything on the way to
it.  It says that a minor is a product there, so that the rank can fall only where a
factor vanishes; each factor is a case, which ends or leads to further nodes.

All polynomials are texts of the expression grammar.

References: docs/decisions/0019-certificates.md.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from screwkit.certificates.equations_told import (
    Angles,
    Multiple,
    Square,
    Step,
    Unsolved,
)


@dataclass(frozen=True)
class Sheet:
    """One solution of a case and what follows on it."""

    step: Step
    node: Node


@dataclass(frozen=True)
class Case:
    """One factor of a node's polynomial.

    Attributes:
        equations: The factor vanishes where all of them do: one polynomial, or two
            that are a half-angle form times the sine and the cosine of half an angle.
        power: Of the factor in the product; half-angle factors count squares.
        end: Why nothing follows: ``positive`` (the signs of its terms), ``unreal``
            (no real solution), ``special`` (it ties the dimensions of the mechanism to
            each other), ``divisor`` (it divides what a step has divided by),
            ``undefined`` (it divides what the geometry divides by),
            ``elsewhere`` (an angle that a step gives in numbers is not there); empty if
            something does.
        divisor: Of which step, or which one of the geometry, and what else is in it:
            `Multiple` with the number of that as its equation.
        numbers: (a, b, c) of an a·sin φ + b·cos φ + c = 0 that is unreal or elsewhere.
        angle: Its basis angle.
        sheets: What follows where the case is solved.
        kept: What follows where it is not, with the equation as a condition.
        times, squares: Of an equation that is kept: times this it is a sum of squares
            with positive weights, so that at real postures all of them are 0.
    """

    equations: tuple[str, ...]
    power: int
    end: str = ""
    numbers: tuple[str, ...] = ()
    angle: int = -1
    divisor: Multiple | None = None
    sheets: tuple[Sheet, ...] = ()
    kept: Node | None = None
    times: str = ""
    squares: tuple[Square, ...] = ()


@dataclass(frozen=True)
class OfLimb:
    """What a node says of one limb, where no case of the node holds.

    Attributes:
        limb: Its name.
        rank: Its twists have no less than this rank; of a limb with loops inside [P; C]
            has, see `limb_claims`.
        rows, columns: Coordinates and freedoms of a minor that shows it; empty where
            the limb's own part does, or a floor of that.
        fallen: In that case what follows where the rank is lower, locus by locus.
        wrenches: (f; m), reciprocal to its twists, at the origin of the part's frame;
            of a limb with loops inside reactions of these follow, six by six.
        work: Which reciprocal products are 0 as multiples of a condition, counted over
            the limb's freedoms that are not locked, wrench after wrench.
    """

    limb: str
    rank: int = 0
    rows: tuple[int, ...] = ()
    columns: tuple[str, ...] = ()
    fallen: tuple[Node, ...] = ()
    wrenches: tuple[tuple[str, ...], ...] = ()
    work: tuple[Multiple, ...] = ()


@dataclass(frozen=True)
class Node:
    """The postures on the way to it, and why the locus is no larger there.

    Attributes:
        number: In the order in which nodes are met.
        component: All of them lie on this component.
        multiples: Why, for equations that do not vanish by the solved steps alone.
        earlier: All of them belong to this node, which was finished before.
        axis: Nothing is there, because the axis of this freedom has no direction.
        vanishing: Nothing is there, because this symbol is 0, which is never 0.
        special: The dimensions of the mechanism are tied to each other there.
        sheet: It is a sheet of the component whose postures the tree covers.
        small: It has fewer dimensions than k equations leave, the component has k.
        roots: How its unsolved conditions are met, where postures on them are needed.
            Of a sheet: one after the other, each linear in an unknown that those before
            it lack; for each there is a case, that its coefficients vanish.
        impossible: A condition that cannot hold here, by the signs of its terms.
        impossible_value: What the condition is here, up to divisors of steps.
        rank: Of the matrix in general on the node.
        rows, columns: Of the minor that is a product: rows of the matrix from 0, and
            freedoms.
        limbs: Ranks and wrenches of limbs, instead of a minor of the matrix; ``rows``
            are then those of a minor of all these wrenches, which is a product together
            with the minors of the limbs.
        condition: The unsolved condition that is a product here, instead of a minor.
        combination: Multiples of unsolved conditions whose sum is a product here.
        over: By number of a solved step: powers of its divisor on the minor's side.
        cases: The factors of the product.
    """

    number: int
    component: int = -1
    multiples: tuple[Multiple, ...] = ()
    earlier: int = -1
    axis: str = ""
    vanishing: str = ""
    special: bool = False
    sheet: bool = False
    small: bool = False
    roots: tuple[Unsolved, ...] = ()
    impossible: int = -1
    impossible_value: str = ""
    rank: int = -1
    rows: tuple[int, ...] = ()
    columns: tuple[str, ...] = ()
    limbs: tuple[OfLimb, ...] = ()
    condition: int = -1
    combination: tuple[Multiple, ...] = ()
    over: Mapping[str, int] | None = None
    cases: tuple[Case, ...] = ()

    @property
    def below(self) -> list[Node]:
        """What follows at once."""
        kept = [case.kept for case in self.cases if case.kept is not None]
        sheets = [sheet.node for case in self.cases for sheet in case.sheets]
        return [*kept, *sheets, *(n for own in self.limbs for n in own.fallen)]

    @property
    def every(self) -> list[Node]:
        """The node itself and all that follow."""
        found = [self]
        for node in found:
            found += node.below
        return found


@dataclass(frozen=True)
class Reach:
    """How points of a component are found: solved steps, then roots in this order."""

    steps: tuple[Step, ...]
    roots: tuple[Unsolved, ...] = ()


@dataclass(frozen=True)
class Side:
    """A real posture in rational numbers.

    Attributes:
        tangents: Of half of each basis angle.
        symbols: Values by name.
    """

    tangents: tuple[str, ...]
    symbols: Mapping[str, str]


@dataclass(frozen=True)
class Locus:
    """A component.

    Attributes:
        equations: It is where all of them vanish.
        rank: Of the matrix, generic on the component.
        freedom: Of the platform there, with the actuated joints locked; −1 for limbs
            that are chains.
        reach: Its sheets.
        cover: Of several equations: a tree that starts with all of them as conditions
            and leads to its sheets.
        sides: Of one equation: two real postures at which it has different signs; where
            the first reach solves all: one, for what the steps leave free; or none.
    """

    equations: tuple[str, ...]
    rank: int
    freedom: int
    reach: tuple[Reach, ...]
    cover: Node | None = None
    sides: tuple[Side, ...] = ()


@dataclass(frozen=True)
class Floor:
    """What the rank of a limb is no less than, off some loci.

    Attributes:
        rank: That rank, less than in general.
        loci: The equations of each: what the rank is on it is not said.
        proof: By minors of the limb's twists, or of [P; C], of this size.
    """

    rank: int
    loci: tuple[tuple[str, ...], ...]
    proof: Node


@dataclass(frozen=True)
class Demand:
    """What closed loops demand where they tie joint variables.

    Attributes:
        equation: Vanishes at closed postures: a multiple of one of those that the
            loops of the mechanism give.
        number: Of that one.
        times: What it is multiplied with.
    """

    equation: str
    number: int
    times: str = "1"


@dataclass(frozen=True)
class Part:
    """What is claimed about one matrix.

    Attributes:
        question: ``limb``, ``constraint`` or ``actuation``.
        form: Which matrix it is: empty for the limbs' twists, limb by limb; ``loops``
            for the loop equations of the joint graph, see `graph_matrix`.
        limb: Name of the limb.
        locked: Freedoms that are held.
        origin: The link whose frame the twists are taken in.
        angles: The basis angles.
        scales: By freedom: what its twist is multiplied with to clear divisors.
        rank: Generic rank of the matrix.
        components: Where the rank falls; of ``actuation``: where the platform moves; of
            a limb by its loop equations: where it allows the platform less.
        idle: Of ``actuation``: where only limbs move.
        demands: Where loops tie joint variables: with these conditions the proof
            starts.
        closed: How closed postures are met in general.
        floors: Of a limb: what its rank is where it is lower; by loop equations also
            where it is less than in general.
        proof: That there is no other component; None if none was found.
        reason: Why there is no proof; or what is not shown besides.
    """

    question: str
    origin: str
    angles: Angles
    rank: int
    components: tuple[Locus, ...]
    form: str = ""
    limb: str = ""
    locked: tuple[str, ...] = ()
    scales: Mapping[str, str] | None = None
    idle: tuple[Locus, ...] = ()
    demands: tuple[Demand, ...] = ()
    closed: tuple[Unsolved, ...] = ()
    floors: tuple[Floor, ...] = ()
    proof: Node | None = None
    reason: str = ""


@dataclass(frozen=True)
class Source:
    """The mechanism as it was read.

    Attributes:
        text: Of the file.
        json: Whether the file is JSON, not YAML.
        variant: Of the file.
        set_values: Numbers that replace symbols.
        at: Values of joint variables.
        actuated: In place of the declared scheme.
    """

    text: str
    json: bool = False
    variant: str | None = None
    set_values: Mapping[str, str] | None = None
    at: Mapping[str, str] | None = None
    actuated: tuple[str, ...] | None = None


@dataclass(frozen=True)
class SchemeClaim:
    """What the platform can do with some freedoms locked, in general.

    Attributes:
        actuated: The freedoms.
        freedom: Dimension of the platform's twists; 0 where the scheme is admissible.
    """

    actuated: tuple[str, ...]
    freedom: int


@dataclass(frozen=True)
class SchemeClaims:
    """What is claimed about actuation schemes.

    Attributes:
        origin, angles, form: As of a part.
    """

    origin: str
    angles: Angles
    schemes: tuple[SchemeClaim, ...]
    form: str = ""


@dataclass(frozen=True)
class Certificate:
    """Claims about one mechanism, with their proofs.

    Attributes:
        parts: About its singularities.
        schemes: About its actuation schemes.
    """

    schema: str
    case: str
    version: str
    mechanism: Source
    parts: tuple[Part, ...]
    schemes: SchemeClaims | None = None
