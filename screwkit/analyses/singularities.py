"""Where is it singular: limb, constraint and actuation singularities, kept apart.

References: [LongCaroKhalil2012] §5, [Zlatanov2002].
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, primitive
from screwkit.analyses.actuation_parts import actuation_parts, six_lines
from screwkit.analyses.hybrid_limbs import hybrid_limb, strata_of
from screwkit.analyses.one_component import (
    among,
    component_of,
    limb_component,
)
from screwkit.analyses.superbracket import superbracket
from screwkit.analyses.unexpanded import six_lines_in_words
from screwkit.analyses.whole_singularities import put_together
from screwkit.kinematics.assembly import Assembly, LimbChain
from screwkit.kinematics.joints_aside import freedoms_aside
from screwkit.kinematics.limb_parts import Parts
from screwkit.kinematics.loop_columns import loop_columns
from screwkit.kinematics.loop_state import LoopState
from screwkit.kinematics.told_parts import told_parts
from screwkit.loci.actuation import actuation_locus
from screwkit.loci.canonical import in_known_conditions
from screwkit.loci.exact_equations import (
    ExactPieces,
    Singularity,
    narrower,
    with_exact_equations,
)
from screwkit.loci.exact_rank_drop import rank_on
from screwkit.loci.hybrid_actuation import state_on
from screwkit.loci.lifting import with_sheets_together
from screwkit.loci.limb_drops import limb_drop, limb_pieces
from screwkit.loci.loop_drop import (
    loop_drop,
    loop_state,
    rank_is_lost,
)
from screwkit.loci.loop_drop_found import LoopDrop
from screwkit.loci.meanings import Meanings
from screwkit.loci.mechanism_figures import axes_of, figures_of, figures_on
from screwkit.loci.pieces import Piece, pieces_of, told_apart, without_contained
from screwkit.loci.rank_drop import RankDrop, generic_rank
from screwkit.loci.searching_again import searched_again
from screwkit.loci.strata import in_ring
from screwkit.loci.surely_singular import all_lost
from screwkit.loci.unhurried import Unhurried
from screwkit.loci.wording import equations_of
from screwkit.loci.wrench_blocks import short_minors
from screwkit.loci.wrench_sums import height_of
from screwkit.progress import Progress, silent
from screwkit.results.singularities import (
    ActuationSingularities,
    Component,
    ConstraintSingularities,
    Intersection,
    LimbSingularities,
    Singularities,
)

_UNFINISHED = (
    "the search for more had not ended; the equations may hold at regular postures too"
)


def singularities(
    assembly: Assembly,
    actuated: Sequence[str] | None = None,
    progress: Progress = silent,
    finished: Callable[[str, Any], None] = lambda name, part: None,
) -> Singularities:
    """Answer ``singularities``.

    Args:
        assembly: The mechanism.
        actuated: Names of the actuated joints; the declared ones by default.
        progress: Told about each stage.
        finished: Given each part as soon as it is there, by name.

    Raises:
        UndecidedError: See `Assembly.refuse_other_loops`.
    """
    assembly.refuse_other_loops()
    limbs = []
    for limb in assembly.limbs:
        progress(f"limb {limb.name}", f"{len(limb.joints)} twists")
        answer = hybrid_limb if limb.elements is not None else limb_singularities
        limbs.append(answer(assembly, limb))
        finished(f"limb {limb.name}", limbs[-1])
    scheme = tuple(assembly.mechanism.actuated if actuated is None else actuated)
    actuation = None
    if scheme:
        # Before the constraints, which take longer where arms have many strata.
        progress("actuation", f"{len(assembly.joints) - len(scheme)} passive joints")
        actuation = actuation_singularities(assembly, scheme)
        finished("actuation", actuation)
    progress("constraint", f"{len(assembly.joints)} columns")
    constraint = constraint_singularities(
        assembly,
        lambda part: finished("constraint", part),
        sum(len(limb.components) for limb in limbs),
    )
    finished("constraint", constraint)
    return put_together(
        assembly.mechanism,
        (limbs, constraint, actuation),
        assembly.assumptions,
        assembly.libraries,
    )


def limb_singularities(assembly: Assembly, limb: LimbChain) -> LimbSingularities:
    """Where the twists of one limb lose rank."""
    framed = assembly.limb_twists[limb.name]
    root, library = assembly.root(framed.ring), assembly.library(framed.ring)
    columns = [framed.column(joint) for joint in limb.joints]
    found = limb_pieces(assembly, limb, [root])
    pieces = _in_order(found.exact.pieces)
    (drop,) = found.last.drops
    meanings = Meanings(framed, root, library, axes_of(framed, root, library))
    components = [
        limb_component(
            piece,
            root,
            library,
            meanings,
            pieces,
            rank=rank_on(piece, columns),
            dimension=assembly.dimension,
        )
        for piece in pieces
    ]
    return LimbSingularities(
        limb=limb.name,
        joints=limb.joints,
        generic_rank=drop.rank,
        complete=found.complete,
        components=tuple(components),
        intersections=tuple(
            _intersections(pieces, columns, partial(limb_drop, assembly, limb))
        ),
        proof=_proof(len(drop.minors), drop.rank, pieces) if found.complete else "",
        reason=found.reason,
    )


def _proof(minors: int, rank: int, pieces: Sequence[Piece]) -> str:
    if not rank:
        return "it has no freedom to lose"
    if not pieces:
        if minors == 1:
            return f"the one minor of size {rank} vanishes at no posture"
        return f"the {minors} minors of size {rank} vanish together at no posture"
    subject = (
        f"the one minor of size {rank} vanishes"
        if minors == 1
        else f"the {minors} minors of size {rank} vanish"
    )
    where, one = "on each", "on one of them"
    if len(pieces) == 1:
        where = one = "there"
    return (
        f"{subject} {where}; every common zero lies {one}, by exhaustive case "
        f"distinction over the factors of the minors"
    )


def _in_order(pieces: Sequence[Piece]) -> list[Piece]:
    """Large ones and short equations first; ones of one shape beside each other."""

    def key(piece: Piece) -> tuple[int, int, list[int]]:
        sizes = sorted(map(len, piece.equations))
        return piece.codimension, sum(sizes), sizes

    return sorted(pieces, key=key)


def _intersections(
    pieces: Sequence[Piece],
    columns: Sequence[Sequence[Polynomial]],
    drop_on: Callable[[Branch], RankDrop],
) -> list[Intersection]:
    """Where two components meet, and where the rank falls further on them."""
    found: list[Intersection] = []
    keys = [{str(e) for e in piece.equations} for piece in pieces]
    for i, piece in enumerate(pieces[:-1]):  # nothing that comes later meets the last
        deeper = [
            lower
            for branch in piece.branches
            for lower in drop_on(branch).decomposition.branches
        ]
        for lower in _in_order(pieces_of(deeper)):
            members = tuple(n for n, other in enumerate(pieces) if _lies(lower, other))
            shown = {key for n in members for key in keys[n]}
            texts = zip(equations_of(lower), lower.equations, strict=True)
            extra = tuple(text for text, e in texts if str(e) not in shown)
            rank = generic_rank(lower.branches[0], columns)
            item = Intersection(members, extra, rank)
            if len(members) > 1 and i == members[0] and item not in found:
                found.append(item)
    return found


def _lies(inner: Piece, outer: Piece) -> bool:
    points = inner.branches[0].points
    return bool(points) and all(outer.contains(*point) for point in points)


def constraint_singularities(
    assembly: Assembly,
    so_far: Callable[[ConstraintSingularities], None] = lambda part: None,
    before: int = 0,
) -> ConstraintSingularities:
    """Where the loop constraint matrix loses rank.

    Args:
        assembly: The mechanism.
        so_far: Given what is known each time that pieces were found.
        before: Components that are counted before these; sentences count with them.
    """
    if len(assembly.limbs) < 2 and not assembly.has_blocks:
        return ConstraintSingularities(
            assembly.loop_rank, True, (), proof="there is no loop to constrain"
        )
    framed = assembly.common_twists
    root, library = assembly.root(framed.ring), assembly.library(framed.ring)
    limbs = [told_parts(assembly, limb) for limb in assembly.limbs]
    strata = [
        in_ring(
            strata_of(assembly, limb),
            assembly.limb_twists[limb.name].ring,
            framed.ring,
        )
        for limb in assembly.limbs
    ]
    known = [
        primitive(stratum.equations[0])
        for limb in strata
        for stratum in limb.strata
        if len(stratum.equations) == 1
    ]
    kind = partial(loop_state, limbs=limbs)

    def exactly(pieces: Sequence[Piece]) -> ExactPieces:
        own = [
            in_known_conditions(piece, root, known, Search(library))
            for piece in with_sheets_together(pieces, kind)
        ]
        exact = _exact(root, told_apart(own, known), limbs, library)
        return replace(exact, narrowed=narrower(exact.pieces, own))

    def described(
        pieces: Sequence[Piece], names: Meanings | None
    ) -> tuple[Component, ...]:
        ordered = _in_order(pieces)
        return tuple(
            _constraint_component(
                piece,
                root,
                library,
                among(ordered, piece, partial(names.each_of, before=before))
                if names
                else None,
                state_on(piece, limbs),
                assembly,
            )
            for piece in ordered
        )

    def early(pieces: Sequence[Piece], generic: LoopState) -> None:
        own = with_sheets_together(without_contained(pieces), kind)
        components = described(own, None)
        so_far(
            ConstraintSingularities(generic.loop, False, components, reason=_UNFINISHED)
        )

    found = searched_again(
        lambda given: loop_drop(
            root,
            limbs,
            strata,
            Search(library),
            given=given,
            early=Unhurried(early),
        ),
        exactly,
    )
    meanings = Meanings(
        framed,
        root,
        library,
        figures_of(assembly),
        figures_on(assembly),
        known,
        partial(all_lost, found.last.generic, limbs) if found.complete else None,
    )
    components = described(found.exact.pieces, meanings)
    return ConstraintSingularities(
        generic_rank=found.last.generic.loop,
        complete=found.complete,
        components=components,
        proof=_constraint_proof(found.last) if found.complete else "",
        reason=found.reason,
    )


def _exact(
    root: Branch,
    pieces: Sequence[Piece],
    limbs: Sequence[Parts],
    library: FactorLibrary,
) -> ExactPieces:
    """The pieces with equations at whose zeros the loops have lost rank."""
    generic = loop_state(root, limbs)

    def holds_on(branch: Branch) -> bool:
        state = loop_state(branch, limbs)
        if state is None or generic is None:
            return False
        return rank_is_lost(state, generic)

    columns = partial(loop_columns, limbs, height_of(limbs))
    minors = partial(short_minors, limbs=limbs, library=library)
    singular = Singularity(root, columns, holds_on, library, told_on=minors)
    return with_exact_equations(pieces, singular)


def _constraint_proof(drop: LoopDrop) -> str:
    if not drop.pieces:
        return "the limbs' constraint wrenches stay independent on every stratum"
    return (
        "every pattern of regular and singular limbs was searched: on each, the joint "
        "Plücker coordinates of the limbs' wrench systems vanish only there"
    )


def _constraint_component(
    piece: Piece,
    root: Branch,
    library: FactorLibrary,
    words: Callable[[Piece], str | None] | None,
    state: LoopState,
    assembly: Assembly,
) -> Component:
    return component_of(
        piece,
        root,
        library,
        words,
        rank=state.loop,
        wrench_dimension=assembly.dimension - state.platform_freedom,
        platform_freedom=state.platform_freedom,
        mobility=state.mobility + freedoms_aside(assembly),
    )


def actuation_singularities(
    assembly: Assembly, actuated: Sequence[str]
) -> ActuationSingularities:
    """Where, with these joints locked, the platform can move."""
    locus = actuation_locus(assembly, actuated)
    parts = actuation_parts(assembly, locus, actuated)
    moving = [(p, c) for p, c in parts if c.platform_freedom]
    pieces = [piece for piece, _ in moving]
    may_move = locus.admissible and bool(pieces or not locus.complete)
    bracket = superbracket(assembly, actuated, pieces) if may_move else None
    reason = locus.reason
    if bracket is not None and not locus.complete and not locus.pieces:
        told = six_lines_in_words(assembly, actuated, bracket)
        reason = "; ".join(filter(None, [reason, told]))
    return ActuationSingularities(
        actuated=tuple(actuated),
        admissible=locus.admissible,
        generic_rank=assembly.dimension - locus.platform_freedom,
        complete=locus.complete,
        components=tuple(
            c
            if c.geometry
            else replace(c, geometry=six_lines(n, pieces, locus, bracket))
            for n, (_, c) in enumerate(moving)
        ),
        idle=tuple(c for _, c in parts if not c.platform_freedom),
        witness=locus.witness,
        reason=reason,
        superbracket=bracket,
    )
