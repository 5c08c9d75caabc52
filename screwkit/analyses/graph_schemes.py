"""Which joints may be actuated, for any joint graph: ranks first, then loci.

The joint rates that close all loops form a small space; a scheme is admissible where
those that leave its freedoms still leave the platform still.  That is decided for all
schemes at exact postures.

References: [LongCaroKhalil2012] §5.2.2.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Any

from screwkit.algebra.names import counted
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.trigonometric import primitive
from screwkit.analyses.graph_redundancy import graph_redundancy
from screwkit.analyses.own_branch import MOVES_ALL_ALONG, OwnBranch
from screwkit.analyses.scheme_lists import (
    NOTHING_DECLARED,
    Ranked,
    number_of_schemes,
    told_schemes,
)
from screwkit.analyses.whole_singularities import meanings_of
from screwkit.errors import UnknownNameError
from screwkit.kinematics.tied_graph import TiedGraph
from screwkit.kinematics.whole_graph import WholeGraph
from screwkit.loci.graph_loci import actuation_locus
from screwkit.loci.graph_witness import GraphWitnesses
from screwkit.loci.pieces import Piece
from screwkit.loci.tied_loci import tied_actuation_locus
from screwkit.loci.wording import equations_of
from screwkit.progress import Progress, silent
from screwkit.results.schemes import LocusFactor, Scheme, Schemes
from screwkit.results.undecided import Undecided

PER_LOCUS = 20_000
"""Terms that the locus of one scheme counts as."""


@dataclass
class _Loci:
    """The loci of schemes under way."""

    graph: WholeGraph
    left: int
    pieces: dict[str, Piece] = field(default_factory=dict)
    counts: Counter[str] = field(default_factory=Counter)

    def of(self, scheme: Scheme) -> Scheme:
        """The scheme with the equations on which it fails."""
        if not scheme.admissible or scheme.undecided:
            return scheme
        if self.left <= 0:
            return replace(scheme, undecided=True)
        self.left -= PER_LOCUS
        if isinstance(self.graph, TiedGraph):
            found = tied_actuation_locus(self.graph, scheme.actuated)
        else:
            found = actuation_locus(self.graph, scheme.actuated)
        moving = self._taken(found.pieces)
        idle = self._taken(found.others)
        texts = sorted([*moving, *idle], key=lambda text: (len(text), text))
        self.counts.update(texts)
        deeper = any(p.codimension > 1 for p in (*found.pieces, *found.others))
        return replace(
            scheme,
            locus=tuple(texts),
            multiplicities=(1,) * len(texts),
            idle=tuple(text for text in texts if text in idle),
            undecided=not found.hypersurfaces_known,
            deeper=deeper or bool(found.reason),
        )

    def _taken(self, pieces: Sequence[Piece]) -> list[str]:
        texts = []
        for piece in pieces:
            if piece.codimension == 1:
                text = _as_one(piece)
                self.pieces.setdefault(text, piece)
                texts.append(text)
        return texts

    def factors(self) -> tuple[LocusFactor, ...]:
        """All equations with their meanings, the commonest first."""
        meanings = meanings_of(self.graph) if self.counts else None
        return tuple(
            LocusFactor(
                text,
                meanings.each_of(self.pieces[text]) if meanings else None,
                sum(map(len, self.pieces[text].equations)),
                count,
            )
            for text, count in self.counts.most_common()
        )


def graph_schemes(
    graph: WholeGraph,
    size: int | None = None,
    candidates: Sequence[str] | None = None,
    balanced: bool = False,
    progress: Progress = silent,
    work: int = 1_000_000,
    finished: Callable[[str, Any], None] = lambda name, part: None,
    ranked: Ranked | None = None,
    add: bool = False,
) -> Schemes:
    """Answer ``schemes`` for any joint graph.

    Args:
        graph: The mechanism.
        size: Number of actuated freedoms; the platform's twist dimension by default.
        candidates: Freedoms that may be actuated; all by default.
        balanced: List only schemes with the same number from every limb.
        progress: Told about each stage.
        work: Terms that all loci together may take.
        finished: Given the answer without loci as soon as it is there.
        ranked: Orders the admissible schemes.
        add: Find what added actuators do to the declared scheme.

    Raises:
        UnknownNameError: If a candidate is no freedom that a motor can drive, or there
            are fewer of them than a scheme has.
        TooLargeError: If there are more schemes than can sensibly be listed.
    """
    number = graph.generic_state().platform_freedom if size is None else size
    chosen = _candidates(graph, candidates)
    if number > len(chosen):
        among = counted(len(chosen), "candidate")
        raise UnknownNameError(
            f"schemes of {counted(number, 'joint')} are asked for, but "
            f"{graph.mechanism.name} has {among}; give a smaller size (--size) or more "
            f"of them (--candidates)"
        )
    total = number_of_schemes(number, len(chosen))
    progress("schemes", f"{total} schemes of {number} joints")
    witnesses = GraphWitnesses(graph)
    own = OwnBranch(graph.network) if isinstance(graph, TiedGraph) else None
    listed = [
        _scheme(graph, actuated, witnesses, own)
        for actuated in combinations(chosen, number)
        if not balanced or _is_balanced(graph, actuated)
    ]
    limbs = len(graph.framed.limbs)
    known = told_schemes(graph.mechanism, number, limbs, listed)
    if ranked is not None:
        progress("ranking", f"{known.admissible} schemes")
        order = ranked([scheme.actuated for scheme in listed if scheme.admissible])
        known = replace(known, ranking=order)
    if add:
        progress("redundancy", "singularities of the declared scheme")
        declared = graph.mechanism.actuated
        known = replace(
            known,
            redundancy=graph_redundancy(graph, declared, chosen)
            if declared
            else Undecided(NOTHING_DECLARED),
        )
    early = replace(
        known,
        schemes=tuple(
            replace(s, undecided=s.undecided or s.admissible) for s in listed
        ),
        complete=False,
        reason="no locus yet",
    )
    finished("admissible", early)
    loci = _Loci(graph, work)
    done = []
    for count, scheme in enumerate(listed):
        if count % 10 == 0:
            progress("schemes", f"{count} of {len(listed)} schemes")
        done.append(loci.of(scheme))
    return replace(
        told_schemes(graph.mechanism, number, limbs, done),
        ranking=known.ranking,
        redundancy=known.redundancy,
        factors=loci.factors(),
        complete=not any(scheme.undecided for scheme in done),
        reason=_open(done, loci),
    )


def _as_one(piece: Piece) -> str:
    """One equation that says what those of the piece say together."""
    if len(piece.equations) == 1:
        return equations_of(piece)[0]
    ring = piece.branches[0].ring
    squares = sum((e * e for e in piece.equations), ring.zero)
    return equation_text(ring, primitive(ring.normal(squares)))


def _candidates(graph: WholeGraph, names: Sequence[str] | None) -> tuple[str, ...]:
    driven = tuple(
        x for x in graph.network.labels if x not in graph.network.contact_labels
    )
    if names is None:
        return driven
    for name in names:
        if name not in driven:
            known = ", ".join(driven)
            raise UnknownNameError(f"no freedom {name!r} to drive; there are {known}")
    return tuple(label for label in driven if label in set(names))


def _scheme(
    graph: WholeGraph,
    actuated: tuple[str, ...],
    witnesses: GraphWitnesses,
    own: OwnBranch | None,
) -> Scheme:
    """A scheme of which only the rank is known."""
    freedom = witnesses.state(actuated).platform_freedom
    still = bool(freedom and own is not None and own.is_still(actuated))
    freedom = 0 if still else freedom
    reason = witnesses.of(actuated) if freedom else None
    if own is not None and not freedom and not still:
        freedom = own.freedom_left(actuated)
        reason = MOVES_ALL_ALONG if freedom else None
    return Scheme(
        actuated,
        not freedom,
        len(graph.network.rows) - freedom,
        reason=reason,
        balanced=_is_balanced(graph, actuated),
        undecided=still,
    )


def _is_balanced(graph: WholeGraph, actuated: Sequence[str]) -> bool:
    limbs = graph.framed.limbs
    counts = {sum(label in actuated for label in limb) for limb in limbs}
    return len(counts) == 1 and sum(map(len, limbs)) >= len(actuated)


def _open(listed: Sequence[Scheme], loci: _Loci) -> str:
    """Why not every locus was found."""
    left = sum(scheme.undecided for scheme in listed)
    if not left:
        return ""
    schemes_left = f"{left} of {len(listed)} schemes"
    if loci.left > 0:
        return f"the loci of {schemes_left} could not be decided within the budget"
    return (
        f"the loci of {schemes_left} are left; ask for one of them with "
        f"singularities --actuated, or for more with --work"
    )
