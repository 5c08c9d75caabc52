"""The kind of a system of screws, and the lines, planes and points it is made of.

Every decision is whether a residue is zero, so that it does not depend on a basis, a
frame or a unit.  Whether a general system contains rotations is a question of signs and
is not asked here.  A system of four or more dimensions has the kind of the system
reciprocal to it.

References: [Hunt1978], ch. 12; [GibsonHunt1990].
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import Enum, auto

from screwkit.conventions import DIRECTION
from screwkit.kinematics.subspaces import dimension
from screwkit.screw.vector import cross, dot, scaled
from screwkit.systems.screw_structure import (
    Residues,
    ScrewStructure,
    centre,
    foot,
    normal_part,
    pitch,
    product,
    solve,
)

SMALL = 3  # larger systems are described by what is reciprocal to them


class Kind(Enum):
    """The kinds of systems of at most three dimensions, in the words of twists."""

    NOTHING = auto()
    TRANSLATION = auto()
    TRANSLATIONS_OF_PLANE = auto()
    ALL_TRANSLATIONS = auto()
    ROTATION = auto()
    HELIX = auto()
    CYLINDER = auto()
    PARALLEL_LINES = auto()
    PARALLEL_HELICES = auto()
    OBLIQUE = auto()
    PLANAR = auto()
    PLANAR_HELICES = auto()
    LINES_AND_TRANSLATIONS = auto()
    FLAT_PENCIL = auto()
    HELICAL_PENCIL = auto()
    CYLINDROID = auto()
    FIELD = auto()
    HELICAL_FIELD = auto()
    CYLINDROID_AND_NORMAL = auto()
    PENCIL_AND_TRANSLATION = auto()
    CYLINDROID_AND_TRANSLATION = auto()
    BUNDLE = auto()
    HELICAL_BUNDLE = auto()
    PENCIL_AND_NORMAL = auto()
    OF_REVOLUTION = auto()
    GENERAL = auto()


@dataclass(frozen=True)
class Shape:
    """The kind of a system and its elements at one prime.

    Attributes:
        reciprocal: Whether kind and elements are those of the reciprocal system.
        vectors: Directions and normals, each up to a factor.
        points: Points, by name.
        numbers: Pitches; ``pitches`` is the product of the principal ones, ``pairs``
            the sum of their products in pairs, ``sum`` their sum.
    """

    kind: Kind
    reciprocal: bool = False
    vectors: Mapping[str, Residues] = field(default_factory=dict)
    points: Mapping[str, Residues] = field(default_factory=dict)
    numbers: Mapping[str, int] = field(default_factory=dict)


def shape_of(system: ScrewStructure) -> Shape:
    """Kind and elements of a system."""
    if system.dimension > SMALL:
        return replace(shape_of(system.reciprocal), reciprocal=True)
    match len(system.directions):
        case 0:
            return _no_direction(system)
        case 1:
            return _one_direction(system)
        case 2 if system.moments:
            return _two_directions_and_moment(system)
        case 2:
            return _two_screws(system)
    return _three_screws(system)


def _no_direction(system: ScrewStructure) -> Shape:
    p = system.prime
    match system.moments:
        case ():
            return Shape(Kind.NOTHING)
        case (moment,):
            return Shape(Kind.TRANSLATION, vectors={"direction": moment})
        case (a, b):
            normal = _normal(a, b, p)
            return Shape(Kind.TRANSLATIONS_OF_PLANE, vectors={"normal": normal})
    return Shape(Kind.ALL_TRANSLATIONS)


def _one_direction(system: ScrewStructure) -> Shape:
    p, moments = system.prime, system.moments
    (screw,) = system.pitched or system.free
    direction, point = screw[DIRECTION], foot(screw, p)
    across = normal_part(moments, [direction], p)
    vectors = {"direction": direction}
    numbers = {"pitch": pitch(screw, p)} if system.pitched else {}
    turns = not numbers.get("pitch")
    match len(moments), bool(system.pitched):
        case 0, _:
            kind = Kind.ROTATION if turns else Kind.HELIX
            return Shape(kind, False, vectors, {"point": point}, numbers)
        case 1, True:
            kind = Kind.PARALLEL_LINES if turns else Kind.PARALLEL_HELICES
            points = {"foot": _onto(moments[0], point, p)}
            return Shape(
                kind, False, {**vectors, "normal": moments[0]}, points, numbers
            )
        case 1, False:
            (moment,) = moments
            along = not any(_normal(direction, moment, p))
            kind = Kind.CYLINDER if along else Kind.OBLIQUE
            return Shape(kind, False, {**vectors, "second": moment}, {"point": point})
        case _, True:
            kind = Kind.PLANAR if turns else Kind.PLANAR_HELICES
            return Shape(kind, False, vectors, {}, numbers)
    second = _normal(moments[0], moments[1], p)
    vectors |= {"normal": across[0], "second": second}
    points = {"foot": _onto(across[0], point, p)}
    return Shape(Kind.LINES_AND_TRANSLATIONS, False, vectors, points)


def _two_screws(system: ScrewStructure) -> Shape:
    p, screws = system.prime, system.pitched
    a, b = system.directions
    vectors = {"normal": _normal(a, b, p)}
    points = {"point": centre(screws, p)}
    kinds = Kind.FLAT_PENCIL, Kind.HELICAL_PENCIL, Kind.CYLINDROID
    kind, numbers = _by_pitches(screws, kinds, p)
    return Shape(kind, False, vectors, points, numbers)


def _two_directions_and_moment(system: ScrewStructure) -> Shape:
    p, (moment,) = system.prime, system.moments
    a, b = system.directions
    vectors = {"normal": _normal(a, b, p), "second": moment}
    screws = (*system.pitched, *system.free)
    point = centre(screws, p)
    if not system.free:
        kinds = Kind.FIELD, Kind.HELICAL_FIELD, Kind.CYLINDROID_AND_NORMAL
        kind, numbers = _by_pitches(screws, kinds, p)
        return Shape(kind, False, vectors, {"foot": point}, numbers)
    of_line = pitch(system.pitched[0], p)
    if not of_line:
        kind = Kind.PENCIL_AND_TRANSLATION
        return Shape(kind, False, vectors, {"point": point})
    vectors["direction"] = system.pitched[0][DIRECTION]
    kind = Kind.CYLINDROID_AND_TRANSLATION
    return Shape(kind, False, vectors, {"point": point}, {"pitch": of_line})


def _by_pitches(
    screws: Sequence[Residues], kinds: tuple[Kind, Kind, Kind], prime: int
) -> tuple[Kind, Mapping[str, int]]:
    """All of pitch zero, all of one pitch, or neither."""
    a, b = screws
    aa, ab, bb = product(a, a), product(a, b), product(b, b)
    x, y = a[DIRECTION], b[DIRECTION]
    xx, xy, yy = dot(x, x), dot(x, y), dot(y, y)
    if not (aa % prime or ab % prime or bb % prime):
        return kinds[0], {}
    minors = aa * xy - ab * xx, aa * yy - bb * xx, ab * yy - bb * xy
    if not any(minor % prime for minor in minors):
        return kinds[1], {"pitch": pitch(a, prime)}
    below = pow(4 * (xx * yy - xy * xy), -1, prime)
    return kinds[2], {"pitches": (aa * bb - ab * ab) * below % prime}


def _three_screws(system: ScrewStructure) -> Shape:
    """By the minimal polynomial of the symmetric map from direction to moment."""
    p, screws = system.prime, system.pitched
    half = pow(2, -1, p)
    rows = [[product(a, b) * half % p for b in screws] for a in screws]
    squared = [[dot(a, b) % p for b in rows] for a in rows]
    points = {"point": centre(screws, p)}
    flat = [[x for row in matrix for x in row] for matrix in (_UNIT, rows, squared)]
    if not any(flat[1]):
        return Shape(Kind.BUNDLE, points=points)
    degree = dimension(flat[:2], p)
    if degree == 1:
        return Shape(Kind.HELICAL_BUNDLE, points=points, numbers={"pitch": rows[0][0]})
    trace = rows[0][0] + rows[1][1] + rows[2][2]
    if dimension(flat, p) == 3:
        pairs = half * (trace * trace - sum(squared[i][i] for i in range(3)))
        determinant = dot(rows[0], cross(rows[1], rows[2]))
        numbers = {"sum": trace % p, "pairs": pairs % p, "pitches": determinant % p}
        return Shape(Kind.GENERAL, points=points, numbers=numbers)
    _, total = solve(list(zip(flat[0], flat[1], strict=True)), flat[2], p)
    double, single = (trace - total) % p, (2 * total - trace) % p
    rest = [
        [(x - double * u) % p for x, u in zip(r, e, strict=True)]
        for r, e in zip(rows, _UNIT, strict=True)
    ]
    vectors = {"normal": next(tuple(row) for row in rest if any(row))}
    numbers = {"pitch": double, "second_pitch": single}
    kind = Kind.OF_REVOLUTION if double else Kind.PENCIL_AND_NORMAL
    return Shape(kind, False, vectors, points, numbers)


_UNIT = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def _normal(a: Residues, b: Residues, prime: int) -> Residues:
    return tuple(x % prime for x in cross(a, b))


def _onto(normal: Residues, point: Residues, prime: int) -> Residues:
    """The point nearest to the origin in the plane through ``point``."""
    weight = dot(normal, point) * pow(dot(normal, normal), -1, prime)
    return tuple(x % prime for x in scaled(weight, normal))
