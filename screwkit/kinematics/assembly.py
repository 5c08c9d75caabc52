"""A mechanism with its limbs resolved and its twists at hand.

An `Assembly` owns what several questions share -- the twists of each limb in the frame
that keeps them short, those of all limbs in one frame, random exact postures -- and
computes each of them once, when first asked for.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

from screwkit.algebra.assumptions import Assumptions
from screwkit.algebra.branches import Branch
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.modular import rank
from screwkit.algebra.telling_coordinates import telling_coordinates
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.conventions import SCREW_DIMENSION
from screwkit.errors import UndecidedError
from screwkit.kinematics.exact_postures import at_zero, exact_posture
from screwkit.kinematics.frames import (
    FramedTwists,
    framed_twists,
    shortest_twists,
)
from screwkit.kinematics.placement import why_tied
from screwkit.kinematics.series_parallel import (
    Chain,
    chain_between,
    joints_of,
    loops_in,
)
from screwkit.kinematics.values import declared_values, with_values
from screwkit.mechanism.graph import Step, independent_loops
from screwkit.mechanism.graph import limbs as limbs_of
from screwkit.mechanism.joints import RIGID, freedom_labels
from screwkit.mechanism.model import Joint, Mechanism

T = TypeVar("T")


@dataclass(frozen=True)
class LimbChain:
    """A limb from base to platform.

    Attributes:
        joints: Its freedoms from base to platform: the name of a joint, or ``name:k``
            where it has several.
        signs: +1 where a joint points towards the platform, −1 where back; by freedom.
        chain: All its joints, fixed ones included.
        links: The links it passes, base first, as far as an mdh table places them.
        elements: Joints and blocks from base to platform; None for a serial chain,
            which is its joints.
        nested: False where the joints are no nesting of chains; then the limb's twists
            are known at numbers only.
    """

    name: str
    joints: tuple[str, ...]
    signs: tuple[int, ...]
    chain: tuple[str, ...]
    links: tuple[str, ...]
    elements: Chain | None = None
    nested: bool = True


class Assembly:
    """A mechanism, its serial limbs, and their twists on demand.

    Attributes:
        mechanism: As read.
        at_numbers: Whether the values of the file were put in, because limbs that are
            no nesting of chains have their screws at numbers only.
        limbs: In the order of the file.
        assumptions: The signs that the file declares.
    """

    def __init__(self, mechanism: Mechanism) -> None:
        """Resolve the limbs.

        Where loops tie joint variables together the posture of the file is taken.

        Raises:
            UndecidedError: If a limb is no serial chain, or is not placed by the table.
        """
        self.tied = why_tied(mechanism)
        self.mechanism = at_zero(mechanism) if self.tied else mechanism
        self.at_numbers = False
        try:
            self.limbs = _limb_chains(self.mechanism)
        except UndecidedError:
            values = declared_values(self.mechanism)
            if len(values) < len(self.mechanism.parameters) or not values:
                raise
            self.at_numbers = True
            self.mechanism = with_values(self.mechanism, values)
            self.limbs = _limb_chains(self.mechanism)
        self.assumptions = assumptions_of(mechanism)
        self._libraries: dict[TrigonometricRing, FactorLibrary] = {}
        self._roots: dict[TrigonometricRing, Branch] = {}

    @cached_property
    def at_values(self) -> Assembly | None:
        """The same mechanism with the file's values put in for its symbols."""
        values = declared_values(self.mechanism)
        return Assembly(with_values(self.mechanism, values)) if values else None

    @property
    def has_blocks(self) -> bool:
        """Whether a limb has loops inside."""
        return any(limb.elements is not None for limb in self.limbs)

    def refuse_other_loops(self) -> None:
        """For questions that take limbs as chains of joints and of nested chains.

        Raises:
            UndecidedError: If a limb is no such chain, or loops lie outside all limbs.
        """
        for limb in self.limbs:
            if not limb.nested:
                raise UndecidedError(
                    f"limb {limb.name!r} is no nesting of chains, which this question "
                    f"does not take apart yet; `mobility` and `screws` do"
                )
        loops = independent_loops(self.mechanism)
        closed = max(0, len(self.limbs) - 1)
        inside = sum(loops_in(limb.elements or ()) for limb in self.limbs)
        if loops != closed + inside:
            known = f"the limbs close {closed}"
            if inside:
                known += f" and hold {inside}"
            raise UndecidedError(
                f"the graph has {loops} independent loops, of which {known}; loops "
                f"outside limbs are not taken into account here yet"
            )
        if self.tied:
            raise UndecidedError(f"{self.tied}; this question takes them as free")

    @cached_property
    def joints(self) -> tuple[str, ...]:
        """The freedoms of all limbs, limb by limb."""
        return tuple(name for limb in self.limbs for name in limb.joints)

    @cached_property
    def limb_twists(self) -> Mapping[str, FramedTwists]:
        """Each limb's twists in the shortest frame, by limb name."""
        return {
            limb.name: shortest_twists(self.mechanism, limb.chain, limb.links)
            for limb in self.limbs
        }

    @cached_property
    def common_twists(self) -> FramedTwists:
        """The twists of all limbs in the one frame that keeps them shortest."""
        base = self.mechanism.base
        origins = [base] + [
            link for limb in self.limbs for link in limb.links[1:3] if link != base
        ]
        shortest = shortest_twists(self.mechanism, self._chains, origins)
        return replace(shortest, limbs=tuple(limb.joints for limb in self.limbs))

    @property
    def dimension(self) -> int:
        """Of all twists that the file speaks of: six, or three in the plane."""
        return 3 if self.mechanism.space == "planar" else SCREW_DIMENSION

    @cached_property
    def telling(self) -> tuple[int, ...]:
        """Coordinates of `common_twists` from which the others follow."""
        framed = self.common_twists
        return telling_coordinates(framed.column(joint) for joint in self.joints)

    def told(self, joints: Sequence[str]) -> list[list[Polynomial]]:
        """`common_twists` of some joints in those coordinates alone."""
        columns = (self.common_twists.column(joint) for joint in joints)
        return [[column[place] for place in self.telling] for column in columns]

    @cached_property
    def base_twists(self) -> FramedTwists:
        """The twists of all limbs in the base frame."""
        return framed_twists(self.mechanism, self._chains, self.mechanism.base)

    @cached_property
    def _chains(self) -> tuple[str, ...]:
        return tuple(name for limb in self.limbs for name in limb.chain)

    def random_twists(
        self, seed: int, bits: int = 61
    ) -> tuple[dict[str, list[int]], int]:
        """The twists of all limbs at a random exact posture, and the prime.

        Independent of the polynomials: the kinematics is run over residues.
        """
        posture = exact_posture(self.mechanism, seed, bits)
        found = {label: [*twist] for label, twist in posture.twists.items()}
        return found, posture.prime

    @cached_property
    def random_postures(self) -> tuple[tuple[dict[str, list[int]], int], ...]:
        """Two random exact postures modulo two primes."""
        return self.random_twists(1), self.random_twists(2)

    def generic_rank(self, joints: Sequence[str]) -> int:
        """Rank of the twists of some joints, generic over all symbols."""
        return max(
            rank([twists[name] for name in joints], prime)
            for twists, prime in self.random_postures
        )

    @cached_property
    def loop_rank(self) -> int:
        """Generic rank of the loop constraint matrix."""
        return self.loop_rank_of(self.joints)

    def loop_rank_of(self, joints: Sequence[str]) -> int:
        """Generic rank of these columns of the loop constraint matrix."""
        chosen = set(joints)
        return max(
            rank(
                loop_rows(
                    [[t[j] for j in limb.joints if j in chosen] for limb in self.limbs]
                ),
                prime,
            )
            for t, prime in self.random_postures
        )

    def root(self, ring: TrigonometricRing) -> Branch:
        """The whole configuration space of a ring of this mechanism."""
        if ring not in self._roots:
            self._roots[ring] = self._root(ring)
        return self._roots[ring]

    def _root(self, ring: TrigonometricRing) -> Branch:
        dimensions = {p.name for p in self.mechanism.parameters if not p.free}
        indices = tuple(
            index
            for index, name in zip(ring.symbol_indices(), ring.symbols, strict=True)
            if name in dimensions
        )
        return Branch(
            ring,
            self.assumptions,
            dimensions=indices,
            nonvanishing=self._axis_squares.get(ring, ()),
            directions=self._axis_directions.get(ring, ()),
        )

    @cached_property
    def _axis_squares(self) -> Mapping[TrigonometricRing, tuple[Polynomial, ...]]:
        """Squared lengths of axes by ring: nowhere zero, or the joint has no axis."""
        if self.mechanism.geometry == "mdh":
            return {}
        found: dict[TrigonometricRing, tuple[Polynomial, ...]] = {}
        for framed in (self.common_twists, *self.limb_twists.values()):
            squares = {str(s): s for s in map(framed.axis_square, framed.joints)}
            found[framed.ring] = tuple(
                square for square in squares.values() if not square.is_constant()
            )
        return found

    @cached_property
    def _axis_directions(
        self,
    ) -> Mapping[TrigonometricRing, tuple[tuple[Polynomial, ...], ...]]:
        """Directions of axes by ring, those that differ: their squares are above."""
        found = {}
        for framed in (self.common_twists, *self.limb_twists.values()):
            squares = [str(s) for s in self._axis_squares.get(framed.ring, ())]
            by_square = {
                str(framed.axis_square(joint)): framed.axis_direction(joint)
                for joint in framed.joints
            }
            found[framed.ring] = tuple(by_square[key] for key in squares)
        return found

    def library(self, ring: TrigonometricRing) -> FactorLibrary:
        """The factors met in a ring so far, kept for as long as the assembly."""
        if ring not in self._libraries:
            self._libraries[ring] = FactorLibrary(ring)
        return self._libraries[ring]

    @property
    def libraries(self) -> Mapping[TrigonometricRing, FactorLibrary]:
        """The factors met so far, by ring."""
        return self._libraries

    def joint_of(self, label: str) -> Joint:
        """The joint of a freedom."""
        return self.mechanism.joint(self._names[label])

    def variable_of(self, label: str) -> str | None:
        """The joint variable of a freedom; None for freedoms of contacts."""
        joint = self.joint_of(label)
        return joint.variables[self.freedom_of(label)] if joint.variables else None

    def freedom_of(self, label: str) -> int:
        """Which of its joint's freedoms it is, from 0."""
        return freedom_labels(self.joint_of(label), self.mechanism.space).index(label)

    @cached_property
    def _names(self) -> Mapping[str, str]:
        return {
            label: joint.name
            for joint in self.mechanism.joints
            for label in freedom_labels(joint, self.mechanism.space)
        }


def assumptions_of(mechanism: Mechanism) -> Assumptions:
    """The signs that a file declares for its symbols."""
    return Assumptions(
        positive=frozenset(p.name for p in mechanism.parameters if p.positive),
        nonzero=frozenset(
            p.name for p in mechanism.parameters if p.nonzero or p.positive
        ),
    )


def loop_rows(limbs: Sequence[Sequence[Sequence[T]]]) -> list[list[T]]:
    """Transposed loop constraint matrix of limbs given by their twists.

    Each limb after the first closes a loop with the first: [T1 −T2 0; T1 0 −T3].
    """
    if len(limbs) < 2:
        return []
    loops = len(limbs) - 1
    rows = [[*column] * loops for column in limbs[0]]
    for number, limb in enumerate(limbs[1:]):
        for column in limb:
            zero = [column[0] - column[0]] * len(column)  # type: ignore[operator]
            before, after = zero * number, zero * (loops - number - 1)
            rows.append([*before, *column, *after])
    return rows


def _limb_chains(mechanism: Mechanism) -> tuple[LimbChain, ...]:
    found = []
    for limb in limbs_of(mechanism):
        if limb.path is not None:
            found.append(_limb_chain(mechanism, limb.name, limb.path))
            continue
        names = frozenset(limb.joints)
        own = [joint for joint in mechanism.joints if joint.name in names]
        elements = chain_between(own, mechanism.base, mechanism.platform)
        if mechanism.geometry == "mdh" or (elements is None and mechanism.parameters):
            raise UndecidedError(
                f"limb {limb.name!r} is no nesting of chains; its screws are found at "
                f"numbers, not as expressions: --set all symbols"
            )
        nested = elements is not None
        elements = elements or tuple(joint.name for joint in own)
        chain = joints_of(elements)
        kept = frozenset(chain)
        inside = [joint for joint in own if joint.name in kept]
        labels = [x for j in inside for x in freedom_labels(j, mechanism.space)]
        found.append(
            LimbChain(
                limb.name,
                tuple(labels),
                (1,) * len(labels),
                chain,
                (mechanism.base,),
                elements,
                nested,
            )
        )
    return tuple(found)


def _limb_chain(mechanism: Mechanism, name: str, path: Sequence[Step]) -> LimbChain:
    links, at = [mechanism.base], mechanism.base
    labels: list[str] = []
    signs: list[int] = []
    chain: list[str] = []
    table = mechanism.geometry == "mdh"
    grasped = False
    for joint_name, sign in path:
        joint = mechanism.joint(joint_name)
        at = joint.child if sign > 0 else joint.parent
        if table and joint.mdh is None:
            grasped = True
            if joint.type in RIGID:
                continue
        elif grasped:
            raise UndecidedError(
                f"limb {name!r}: joint {joint_name!r} follows a joint without a row "
                f"of the table, so nothing places it"
            )
        elif table:
            links.append(at)
        chain.append(joint_name)
        own = freedom_labels(joint, mechanism.space)
        labels += own if sign > 0 else reversed(own)
        signs += [sign] * len(own)
    return LimbChain(name, tuple(labels), tuple(signs), tuple(chain), tuple(links))
