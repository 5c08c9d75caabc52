"""Where wrenches of limbs that overlap become dependent, block by block.

Some wrenches lie in a few coordinates alone (the couples of robots that keep an axis
upright) and span these in general.  Where they do, the others are independent of them
and of each other exactly if they are so in the coordinates that are left.  So the rank
is lost where that of the first wrenches is, or that of the others without those
coordinates: short minors instead of long ones, and the others are vectors up to a
factor there, which is searched on its own.

The twists of a limb are taken where its own condition holds, also if that could not be
solved (`algebra.projections`); so its wrenches there are as short as they are.

References: [CoxLittleOShea] §9.1; [DulmageMendelsohn1958] (block triangles).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations

from screwkit.algebra.branches import Branch
from screwkit.algebra.factor_library import FactorLibrary
from screwkit.algebra.modular import rank
from screwkit.algebra.points import Point, residue
from screwkit.algebra.projections import normal_of, projection
from screwkit.algebra.search import Search
from screwkit.algebra.substitution import substituted
from screwkit.algebra.trigonometric import Polynomial, content
from screwkit.errors import TooLargeError
from screwkit.kinematics.limb_parts import (
    Parts,
    SideBySide,
    columns_of,
    mapped,
    motion_at,
)
from screwkit.loci.limb_extensors import Minor, primitive_extensor
from screwkit.loci.limb_systems import Extensor, UnclearError, limb_system
from screwkit.loci.rank_drop import extensors
from screwkit.loci.shorter_equations import differences
from screwkit.loci.wrench_sums import height_of, telling_minors, wrenches_overlap
from screwkit.loci.wrench_vectors import Vector, overlap_minors, spanning_wrenches

_DEAREST = 3_000_000  # products of terms in a minor of a block
_LONGEST = 4_000  # terms of all minors of a block

Minors = list[Polynomial]


def block_minors(
    branch: Branch,
    limbs: Sequence[Parts],
    height: int,
    search: Search,
    *,
    overlapping: bool = True,
) -> list[Minors] | None:
    """Lists of polynomials; where limbs become dependent, one list vanishes together.

    Args:
        branch: Where the limbs' wrenches are taken.
        limbs: Each of one rank where it is looked at.
        height: Coordinates of a twist.
        search: Factors that are known.
        overlapping: Only where some wrench is redundant; else `reciprocal_meets` is
            shorter as a rule.

    Returns:
        None where the wrenches are no such blocks, or too long.
    """
    if not branch.points:
        return None
    at = branch.points[0]
    if overlapping and not wrenches_overlap(limbs, height, *at):
        return None
    vectors: list[Vector] = []
    for limb in limbs:
        own = wrenches_on(branch, limb, height, at, search)
        if own is None:
            return None
        vectors += own
    first = _first_block(vectors, at)
    if not any(_places(vector) - first for vector in vectors):
        return None
    found = list(_alternatives(branch, vectors, at, search))
    return found if all(found) else None


def short_minors(
    branch: Branch, limbs: Sequence[Parts], library: FactorLibrary
) -> Sequence[Polynomial]:
    """That vanish where limbs become dependent, of those that keep their ranks.

    Of blocks, if there are any; none where all are too long.
    """
    search = Search(library)
    lists = block_minors(branch, limbs, height_of(limbs), search)
    if lists:
        return [minor for minors in lists for minor in minors]
    try:
        return telling_minors(branch, limbs, search, within=True) or ()
    except TooLargeError:
        return ()


def wrenches_on(
    branch: Branch, limb: Parts, height: int, at: tuple[Point, int], search: Search
) -> list[Vector] | None:
    """That span the wrenches of a limb wherever it has its rank on the branch.

    Elsewhere on it they are still reciprocal to the limb's twists.

    Args:
        branch: Where they are taken.
        limb: Its parts.
        height: Coordinates of a twist.
        at: An exact point of the branch, with its rank, and the prime.
        search: Known factors.

    Returns:
        None where the limb has no freedom, or the wrenches were not found.
    """
    size = motion_at(limb, height, *at).dimension
    if size == height:
        return []
    if not size:
        return None
    parts: Parts = mapped(limb, branch.column)
    for pending in branch.pending:
        parts = _on_condition(branch, parts, pending.value)
    point, prime = at
    for chart in _charts(branch, parts, height, size, search):
        if any(residue(value, point, prime) for value in chart.values()):
            found = spanning_wrenches(branch, chart, height, size, search.library)
            return [_shortest_on_conditions(branch, vector) for vector in found]
    return None


def _charts(
    branch: Branch, parts: Parts, height: int, size: int, search: Search
) -> Iterable[Extensor]:
    columns = [part for part in parts if not isinstance(part, SideBySide)]
    if len(columns) == len(parts):
        return extensors(branch, columns, size, search.library)
    try:
        return [limb_system(branch, parts, height, search.library).extensor]
    except UnclearError:
        return []


def _on_condition(branch: Branch, parts: Parts, condition: Polynomial) -> Parts:
    """Parts of a limb where a condition of their own unknowns holds."""
    degrees = [entry.degrees() for column in columns_of(parts) for entry in column]
    own = {k for d in degrees for k, degree in enumerate(d) if degree > 0}
    if any(d > 0 and k not in own for k, d in enumerate(condition.degrees())):
        return parts
    step = projection(branch.ring, condition, branch.dimensions)
    if step is None:
        return parts
    return mapped(parts, lambda column: substituted(branch.ring, column, step))


def _shortest_on_conditions(branch: Branch, vector: Vector) -> Vector:
    """The same vector where the pending conditions hold, in fewer terms.

    Taken to a condition its entries grow by multiples of that with the normal.
    """
    multiples = [
        branch.ring.normal(one * pending.value)
        for pending in branch.pending
        for one in (branch.ring.one, *normal_of(branch.ring, pending.value))
    ]
    return tuple(_shortest(branch, entry, multiples) for entry in vector)


def _shortest(branch: Branch, entry: Polynomial, zeros: Minors) -> Polynomial:
    best = entry
    while len(best) > 1:
        shorter = min(differences(branch, best, zeros), key=len, default=best)
        if len(shorter) == len(best):
            break
        best = shorter
    return best


def _alternatives(
    branch: Branch, vectors: Sequence[Vector], at: tuple[Point, int], search: Search
) -> Iterator[Minors]:
    """Minors of the first block, then of what is left, and so on."""
    left = list(vectors)
    while left:
        places = _first_block(left, at)
        rest = [v for v in left if _places(v) - places]
        own = [v for v in left if not _places(v) - places]
        across = [tuple(v[k] for k in sorted(places)) for v in own]
        minors = overlap_minors(branch, across, at, _DEAREST, _LONGEST)
        if not any(minor.is_constant() for minor in minors):
            yield minors
        if not rest:
            return
        others = sorted(set().union(*map(_places, rest)) - places)
        left = []
        for factors, vector in _directions(branch, rest, others, search):
            left.append(vector)
            squares = sum((f * f for f in factors), branch.ring.zero)
            if not branch.ring.normal(squares).is_constant():
                yield factors


def _places(vector: Vector) -> set[int]:
    return {k for k, entry in enumerate(vector) if entry != 0}


def _first_block(vectors: Sequence[Vector], at: tuple[Point, int]) -> set[int]:
    """The fewest coordinates that the vectors in them alone span at a point."""
    if not vectors:
        return set()
    point, prime = at
    rows = [[residue(entry, point, prime) for entry in v] for v in vectors]
    whole = sorted(set().union(*map(_places, vectors)))
    for size in range(1, len(whole)):
        for chosen in combinations(whole, size):
            inside = [
                row
                for row, v in zip(rows, vectors, strict=True)
                if _places(v) <= {*chosen}
            ]
            if len(inside) >= size and rank(inside, prime) == size:
                return {*chosen}
    return {*whole}


def _directions(
    branch: Branch, vectors: Sequence[Vector], places: Sequence[int], search: Search
) -> Iterator[tuple[Minors, Vector]]:
    """The vectors in some coordinates, each once, with the factors it comes with.

    Where all factors vanish the vectors do, and their direction does not.
    """
    found: dict[str, tuple[Minors, Vector]] = {}
    for vector in vectors:
        entries = {k: vector[k] for k in places if vector[k] != 0}
        parted = primitive_extensor(branch.ring, entries, search.library)
        scale = content(next(iter(parted.coordinates.values())))
        rest = tuple(
            parted.coordinates.get(k, branch.ring.zero) / scale for k in places
        )
        factor = Minor(branch.ring.one, parted.content).expanded(branch.ring)
        found.setdefault(str(rest), ([], rest))[0].append(factor)
    yield from found.values()
