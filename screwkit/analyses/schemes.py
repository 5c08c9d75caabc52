"""Which joints may be actuated: every scheme of a size, admissible or why not.

References: [LongCaroKhalil2012] §5.2.2.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import combinations
from typing import Any

from screwkit.algebra.names import counted
from screwkit.analyses.mirror_classes import mirror_classes, with_mirror
from screwkit.analyses.redundancy import redundancy
from screwkit.analyses.scheme_lists import (
    NOTHING_DECLARED,
    Ranked,
    number_of_schemes,
    told_schemes,
)
from screwkit.analyses.scheme_loci import LociOfSchemes
from screwkit.errors import UnknownNameError
from screwkit.kinematics.assembly import Assembly
from screwkit.kinematics.loop_state import LoopState
from screwkit.kinematics.mirror import mirrored_joints
from screwkit.loci.actuation import passive_joints
from screwkit.loci.passive import PassiveSystem
from screwkit.progress import Progress, silent
from screwkit.results.schemes import (
    Redundancy,
    Scheme,
    Schemes,
)
from screwkit.results.undecided import Undecided

_REPORT = 50  # schemes between two words of progress
WORK = 1_000_000
"""Terms of determinants that are expanded for all loci together, shortest first."""


def schemes(
    assembly: Assembly,
    size: int | None = None,
    candidates: Sequence[str] | None = None,
    balanced: bool = False,
    progress: Progress = silent,
    work: int = WORK,
    finished: Callable[[str, Any], None] = lambda name, part: None,
    ranked: Ranked | None = None,
    add: bool = False,
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
        finished: Given the answer without loci as soon as it is there.
        ranked: Orders the admissible schemes.
        add: Find what added actuators do to the declared scheme.

    Raises:
        UnknownNameError: If a candidate is no joint of a limb, or there are fewer of
            them than a scheme has joints.
        TooLargeError: If there are more schemes than can sensibly be listed.
        UndecidedError: See `Assembly.refuse_other_loops`.
    """
    assembly.refuse_other_loops()
    system = PassiveSystem(assembly)
    wanted = system.generic_state(assembly.joints).platform_freedom
    number = wanted if size is None else size
    chosen = _candidates(assembly, candidates)
    if number > len(chosen) and (size is not None or candidates is not None):
        raise UnknownNameError(_too_few(assembly, chosen, number, size))
    total = number_of_schemes(number, len(chosen))
    shared = LociOfSchemes(assembly, system, work)
    progress("schemes", f"{total} schemes of {number} joints")
    wanted_schemes = [
        actuated
        for actuated in combinations(chosen, number)
        if not balanced or _is_balanced(assembly, actuated)
    ]
    states = system.generic_states(
        [passive_joints(assembly, actuated) for actuated in wanted_schemes]
    )
    pairs = mirrored_joints(assembly)
    ranks = [
        _by_rank(assembly, *item) for item in zip(wanted_schemes, states, strict=True)
    ]
    known = _answer(assembly, number, [with_mirror(s, pairs) for s in ranks], pairs)
    if ranked is not None:
        progress("ranking", f"{known.admissible} schemes")
        order = ranked([scheme.actuated for scheme in ranks if scheme.admissible])
        known = replace(known, ranking=order)
    if add:
        progress("redundancy", "singularities of the declared scheme")
        known = replace(known, redundancy=_redundancy(assembly, chosen))
    finished("admissible", replace(known, complete=False, reason="no locus yet"))
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
    listed = [with_mirror(scheme, pairs) for scheme in listed]
    return replace(
        _answer(assembly, number, listed, pairs),
        ranking=known.ranking,
        redundancy=known.redundancy,
        factors=shared.factors(),
        left_out=tuple(sorted(shared.left_out)),
        complete=not any(scheme.undecided for scheme in listed),
        reason=_open(listed, shared),
    )


def _redundancy(
    assembly: Assembly, candidates: Sequence[str]
) -> Redundancy | Undecided:
    scheme = assembly.mechanism.actuated
    if not scheme:
        return Undecided(NOTHING_DECLARED)
    return redundancy(assembly, scheme, candidates)


def _answer(
    assembly: Assembly,
    size: int,
    listed: Sequence[Scheme],
    pairs: Sequence[tuple[str, str]],
) -> Schemes:
    """The schemes and their numbers, before anything is said of loci."""
    told = told_schemes(assembly.mechanism, size, len(assembly.limbs), listed)
    return replace(told, mirror=mirror_classes(listed, pairs))


def _by_rank(assembly: Assembly, actuated: tuple[str, ...], state: LoopState) -> Scheme:
    """A scheme of which only the rank is known."""
    return Scheme(
        actuated,
        not state.platform_freedom,
        assembly.dimension - state.platform_freedom,
        balanced=_is_balanced(assembly, actuated),
        undecided=not state.platform_freedom,
    )


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


def _scheme(work: LociOfSchemes, actuated: tuple[str, ...], state: LoopState) -> Scheme:
    assembly = work.assembly
    passive = passive_joints(assembly, actuated)
    rank = assembly.dimension - state.platform_freedom
    balanced = _is_balanced(assembly, actuated)
    if state.platform_freedom:
        reason = work.witnesses.of(passive)
        return Scheme(actuated, False, rank, reason=reason, balanced=balanced)
    found = work.locus(passive, state.mobility)
    locus = sorted(
        found.factors, key=lambda item: (len(item[0].equations[0]), item[0].key)
    )
    texts, idle = [], []
    for f, _ in locus:
        work.counts[f.key] += 1
        work.seen[f.key] = f
        work.schemes.setdefault(f.key, actuated)
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


def _open(listed: Sequence[Scheme], work: LociOfSchemes) -> str:
    """Why not every locus was found."""
    left = sum(scheme.undecided for scheme in listed)
    if not left:
        return ""
    schemes_left = f"{left} of {len(listed)} schemes"
    if work.left > 0:
        return f"determinants of {schemes_left} are too long to expand"
    which = "" if work.assembly.has_blocks else ", the longest ones"
    return (
        f"the loci of {schemes_left} are left{which}; ask for one of them with "
        f"singularities --actuated, or for more with --work"
    )


def _is_balanced(assembly: Assembly, actuated: Sequence[str]) -> bool:
    counts = {sum(j in actuated for j in limb.joints) for limb in assembly.limbs}
    return len(counts) == 1
