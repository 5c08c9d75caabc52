"""Which joints may be actuated: every scheme of a size, admissible or why not.

References: [LongCaroKhalil2012] §5.2.2.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import combinations, islice
from math import comb

from screwkit.algebra.branches import restricted
from screwkit.algebra.factors import Factor, Factored, factor
from screwkit.algebra.names import counted
from screwkit.algebra.points_on import unknowns
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.analyses.mirror_classes import mirror_classes, with_mirror
from screwkit.errors import TooLargeError, UnknownNameError
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.mirror import mirrored_joints
from screwkit.loci.actuation import passive_joints
from screwkit.loci.meanings import Meanings
from screwkit.loci.passive import PassiveState, PassiveSystem, RankTable
from screwkit.loci.pieces import Piece
from screwkit.loci.witness import Witnesses
from screwkit.progress import Progress, silent
from screwkit.results.schemes import (
    Balanced,
    LocusFactor,
    Refusal,
    Scheme,
    Schemes,
)

_NAMED = 80  # terms; no statement of the catalogue is longer
_LOOKED_AT = 60  # minors of one scheme
_REPORT = 50  # schemes between two words of progress
LARGEST = 20_000  # schemes; beyond, candidates have to be named
WORK = 1_000_000
"""Terms of determinants that are expanded for all loci together, shortest first."""


def schemes(
    assembly: Assembly,
    size: int | None = None,
    candidates: Sequence[str] | None = None,
    balanced: bool = False,
    progress: Progress = silent,
    work: int = WORK,
) -> Schemes:
    """Answer ``schemes``.

    Args:
        assembly: The mechanism.
        size: Number of actuated freedoms; the platform's twist dimension by default.
        candidates: Joints that may be actuated; all by default.
        balanced: List only schemes with the same number from every limb.
        progress: Told about each stage.
        work: Terms to expand for all loci together; those of the schemes that are left
            are undecided, and whether these are admissible is decided nevertheless.

    Raises:
        UnknownNameError: If a candidate is no joint of a limb, or there are fewer of
            them than a scheme has joints.
        TooLargeError: If there are more schemes than can sensibly be listed.
        UndecidedError: See `Assembly.refuse_blocks`.
    """
    assembly.refuse_blocks()
    system = PassiveSystem(assembly)
    wanted = system.generic_state(assembly.joints).platform_freedom
    number = wanted if size is None else size
    chosen = _candidates(assembly, candidates)
    if number > len(chosen) and (size is not None or candidates is not None):
        raise UnknownNameError(_too_few(assembly, chosen, number, size))
    total = comb(len(chosen), number)
    if total > LARGEST:
        raise TooLargeError(
            f"{total} schemes of {number} among {len(chosen)} joints are more than "
            f"{LARGEST}; name fewer with --candidates"
        )
    shared = _Work(assembly, system, work)
    progress("schemes", f"{total} schemes of {number} joints")
    wanted_schemes = [
        actuated
        for actuated in combinations(chosen, number)
        if not balanced or _is_balanced(assembly, actuated)
    ]
    states = system.generic_states(
        [passive_joints(assembly, actuated) for actuated in wanted_schemes]
    )
    asked = sorted(
        zip(wanted_schemes, states, strict=True),
        key=lambda item: system.size(passive_joints(assembly, item[0])),
    )
    by_actuated: dict[tuple[str, ...], Scheme] = {}
    for count, (actuated, state) in enumerate(asked):
        if count and count % _REPORT == 0:
            progress("schemes", f"{count} of {len(wanted_schemes)} schemes")
        by_actuated[actuated] = _scheme(shared, actuated, state)
    listed = [by_actuated[actuated] for actuated in wanted_schemes]
    progress("meanings", f"{len(shared.counts)} factors")
    pairs = mirrored_joints(assembly)
    listed = [with_mirror(scheme, pairs) for scheme in listed]
    admissible = [scheme for scheme in listed if scheme.admissible]
    even = [scheme for scheme in listed if scheme.balanced]
    divides = number % len(assembly.limbs) == 0 if assembly.limbs else False
    return Schemes(
        case=assembly.mechanism.name,
        title=assembly.mechanism.title,
        size=number,
        total=len(listed),
        admissible=len(admissible),
        balanced=Balanced(len(even), sum(s.admissible for s in even))
        if divides
        else None,
        schemes=tuple(listed),
        factors=shared.factors(),
        refusals=_refusals(listed),
        mirror=mirror_classes(listed, pairs),
        left_out=tuple(sorted(shared.left_out)),
        complete=not any(scheme.undecided for scheme in listed),
        reason=_open(listed, shared),
    )


@dataclass(frozen=True)
class _Locus:
    """What was found of a locus; see `Scheme`."""

    factors: tuple[tuple[Factor, int], ...]
    undecided: bool = False
    deeper: bool = False


@dataclass
class _Work:
    """What the schemes of one mechanism share."""

    assembly: Assembly
    system: PassiveSystem
    left: int
    counts: Counter[str] = field(default_factory=Counter)
    seen: dict[str, Factor] = field(default_factory=dict)
    left_out: set[str] = field(default_factory=set)
    tables: dict[str, list[RankTable]] = field(default_factory=dict)
    reasons: dict[frozenset[str], str] = field(default_factory=dict)

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

    def locus(self, passive: Sequence[str]) -> _Locus:
        """The factors on which the passive twists become dependent."""
        if len(self.assembly.limbs) < 2:
            return _Locus(())
        minors = self._minors(passive)
        if not minors:
            return _Locus((), undecided=True)
        whole = self.system.fills(passive) and len(minors) == 1
        seen: list[dict[str, tuple[Factor, int]]] = []
        common: dict[str, tuple[Factor, int]] = {}
        for minor in minors:
            factors = factor(self.ring, minor, self.library).factors
            own = {f.key: (f, n) for f, n in factors if self._can_vanish(f)}
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
            falls = True if whole else self._falls(entry[0], passive)
            undecided = undecided or falls is None
            if falls:
                kept[key] = entry
        # Where one minor vanishes on nothing else, nothing else fails.
        all_of_it = any(own.keys() <= kept.keys() for own in seen)
        return _Locus(tuple(kept.values()), undecided, not all_of_it)

    def _minors(self, passive: Sequence[str]) -> list[Polynomial]:
        """Minors of the passive columns, shortest first, while there is work left."""
        if self.left <= 0:
            return []
        minors = list(islice(self.system.maximal_minors(passive), _LOOKED_AT))
        self.left -= sum(map(len, minors))
        return sorted(minors, key=len)

    def _can_vanish(self, f: Factor) -> bool:
        if f.key in self.axes:
            return False
        if not self.root.assumptions.is_nonzero(self.ring, f.equations[0]):
            return True
        self.left_out.add(equation_text(self.ring, f.equations[0]))
        return False

    def _falls(self, f: Factor, passive: Sequence[str]) -> bool | None:
        """Whether more moves on a factor than in general; None if no point is known."""
        tables = self._tables_on(f)
        if not tables:
            return None
        general = self.system.generic_state(passive).mobility
        return any(table.state(passive).mobility > general for table in tables)

    def _tables_on(self, f: Factor) -> list[RankTable]:
        """Ranks at exact points on a factor."""
        if f.key not in self.tables:
            branches = restricted(self.root, f.equations[0], f.equations[1:])
            self.tables[f.key] = [
                self.system.table_at(*point)
                for branch in branches[:1]
                for point in branch.points
            ]
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
        tables = self._tables_on(f)
        return bool(tables) and any(
            table.state(passive).platform_freedom == 0 for table in tables
        )

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
        meanings = Meanings(self.assembly.common_twists, self.root, self.library)
        found = []
        for key, count in self.counts.most_common():
            f = self.seen[key]
            terms = len(f.equations[0])
            meaning = None
            if terms <= _NAMED:
                branches = restricted(self.root, f.equations[0], f.equations[1:])
                piece = Piece(f.equations, tuple(branches))
                meaning = meanings.of(piece) if branches else None
            found.append(LocusFactor(self.text(f), meaning, terms, count))
        return tuple(sorted(found, key=lambda f: (f.terms, f.equation)))


def _candidates(
    assembly: Assembly, candidates: Sequence[str] | None
) -> tuple[str, ...]:
    driven = tuple(j for j in assembly.joints if assembly.variable_of(j) is not None)
    if candidates is None:
        return driven
    for name in candidates:
        if name not in driven:
            known = ", ".join(driven)
            raise UnknownNameError(f"no joint {name!r} in a limb; there are {known}")
    return tuple(joint for joint in driven if joint in set(candidates))


def _too_few(
    assembly: Assembly, chosen: Sequence[str], number: int, size: int | None
) -> str:
    wanted = (
        f"the platform has {counted(number, 'freedom')}, and schemes have as many"
        if size is None
        else f"schemes of {counted(size, 'joint')} are asked for"
    )
    among = counted(len(chosen), "candidate")
    return (
        f"{wanted}, but {assembly.mechanism.name} has {among} ({', '.join(chosen)}); "
        f"give a smaller size (--size) or more of them (--candidates)"
    )


def _scheme(work: _Work, actuated: tuple[str, ...], state: PassiveState) -> Scheme:
    assembly = work.assembly
    passive = passive_joints(assembly, actuated)
    rank = assembly.dimension - state.platform_freedom
    balanced = _is_balanced(assembly, actuated)
    if state.platform_freedom:
        reason = work.witnesses.of(passive)
        return Scheme(actuated, False, rank, reason=reason, balanced=balanced)
    found = work.locus(passive)
    locus = sorted(
        found.factors, key=lambda item: (len(item[0].equations[0]), item[0].key)
    )
    texts, idle = [], []
    for f, _ in locus:
        work.counts[f.key] += 1
        work.seen[f.key] = f
        text = work.text(f)
        texts.append(text)
        if work.is_idle(f, passive):
            idle.append(text)
    return Scheme(
        actuated,
        True,
        rank,
        tuple(texts),
        tuple(n for _, n in locus),
        tuple(idle),
        None,
        balanced,
        found.undecided,
        found.deeper,
    )


def _open(listed: Sequence[Scheme], work: _Work) -> str:
    """Why not every locus was found."""
    left = sum(scheme.undecided for scheme in listed)
    if not left:
        return ""
    schemes_left = f"{left} of {len(listed)} schemes"
    if work.left > 0:
        return f"determinants of {schemes_left} are too long to expand"
    return (
        f"the loci of {schemes_left} are left, the longest ones; ask for one of them "
        f"with singularities --actuated, or for more with --work"
    )


def _is_balanced(assembly: Assembly, actuated: Sequence[str]) -> bool:
    counts = {sum(j in actuated for j in limb.joints) for limb in assembly.limbs}
    return len(counts) == 1


def _refusals(listed: Sequence[Scheme]) -> tuple[Refusal, ...]:
    groups: dict[str, list[Scheme]] = {}
    for scheme in listed:
        if scheme.reason is not None:
            groups.setdefault(scheme.reason, []).append(scheme)
    refusals = [
        Refusal(reason, len(group), group[0].actuated)
        for reason, group in groups.items()
    ]
    return tuple(sorted(refusals, key=lambda refusal: -refusal.schemes))
