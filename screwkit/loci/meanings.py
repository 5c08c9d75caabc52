"""What a locus means: a statement about the mechanism's own points and axes.

Statements are first tried at exact points of the locus, then compared with it as sets;
only an equivalent one is called its meaning.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

from screwkit.algebra.branches import Branch, restricted
from screwkit.algebra.cases import possible_factors
from screwkit.algebra.decomposition import common_zeros
from screwkit.algebra.factors import FactorLibrary
from screwkit.algebra.points import Point as ExactPoint
from screwkit.algebra.points import residue
from screwkit.algebra.polynomial_text import equation_text
from screwkit.algebra.search import Search
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing, primitive
from screwkit.kinematics.frames import FramedTwists
from screwkit.loci.features import Axis, Features, Point, Statement, statements
from screwkit.loci.pieces import Piece, pieces_of
from screwkit.screw.vector import Vector, cross, subtract

_GIVEN = "(given"
_LARGEST = 400  # terms of a statement that is compared with a locus


class Meanings:
    """The features of a mechanism in one frame, and what loci mean in them."""

    def __init__(
        self, framed: FramedTwists, root: Branch, library: FactorLibrary
    ) -> None:
        self._framed = framed
        self._root = root
        self._library = library
        self._found: dict[frozenset[str], str | None] = {}
        self._at: dict[tuple[int, ...], Features[Residue]] = {}

    @cached_property
    def features(self) -> Features[Polynomial]:
        """The features, exact."""
        return features_of(self._framed)

    @cached_property
    def _statements(self) -> tuple[Statement, ...]:
        """Those that do not hold everywhere."""
        generic = self._root.points[0]
        features = self._features_at(*generic)
        return tuple(
            statement
            for statement in statements(self.features)
            if any(v.value for v in statement.scalars(features))
        )

    def of(self, piece: Piece) -> str | None:
        """A sentence that holds exactly on the piece; None where none was found."""
        key = frozenset(_keys(piece))
        if key not in self._found:
            self._found[key] = self._search(piece)
        return self._found[key]

    def _search(self, piece: Piece) -> str | None:
        candidates = self._holding(piece.branches)
        for statement in candidates:
            if self._same_set(statement, piece):
                return statement.words
        return self._given(candidates, piece)

    def each_of(self, piece: Piece) -> str | None:
        """A sentence for the piece, or one for each of its equations that has one."""
        if len(piece.equations) == 1:
            return self.of(piece)
        sentences = []
        for equation in piece.equations:
            branches = restricted(self._root, equation)
            if not branches or branches[0].is_special:
                return None
            sentence = self._alone(Piece((equation,), tuple(branches)))
            if sentence is None:
                return None
            sentences.append(sentence)
        return "; ".join(sentences)

    def _alone(self, piece: Piece) -> str | None:
        """A sentence without proviso: others of the equations may contradict it."""
        sentence = self.of(piece)
        return None if sentence is None or _GIVEN in sentence else sentence

    def _holding(self, branches: Sequence[Branch]) -> list[Statement]:
        points = [point for branch in branches[:2] for point in branch.points]
        if not points:
            return []
        found = list(self._statements)
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
        return [primitive(v) for v in values if v != 0]

    def _same_set(self, statement: Statement, piece: Piece) -> bool:
        scalars = self._scalars(statement)
        if any(len(value) > _LARGEST for value in scalars):
            return False
        if len(scalars) == 1 and len(piece.equations) == 1:
            factors = possible_factors(self._root, scalars[0], self._library)
            return [f.key for f in factors] == [str(primitive(piece.equations[0]))]
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
        key = str(primitive(piece.equations[0]))
        for start in range(0, len(values), 3):
            part = values[start : start + 3]
            square = ring.normal(sum((v * v for v in part), ring.zero))
            if square == 0 or len(square) > _LARGEST:
                continue
            factors = possible_factors(self._root, square, self._library)
            if [f.key for f in factors] == [key]:
                return True
        return False

    def _given(self, candidates: Sequence[Statement], piece: Piece) -> str | None:
        """A statement that is the piece and one short condition more."""
        if len(piece.equations) != 1:
            return None
        key = str(primitive(piece.equations[0]))
        for statement in candidates:
            scalars = self._scalars(statement)
            if len(scalars) != 1 or len(scalars[0]) > _LARGEST:
                continue
            factors = possible_factors(self._root, scalars[0], self._library)
            others = [f.equations[0] for f in factors if f.key != key]
            if len(others) < len(factors) and all(len(p) <= 2 for p in others):
                ring = self._framed.ring
                given = " and ".join(f"{equation_text(ring, p)} ≠ 0" for p in others)
                return f"{statement.words} {_GIVEN} {given})"
        return None

    def _features_at(self, point: ExactPoint, prime: int) -> Features[Residue]:
        key = (*point, prime)
        if key not in self._at:
            self._at[key] = features_at(self.features, point, prime)
        return self._at[key]


def features_at(
    exact: Features[Polynomial], point: ExactPoint, prime: int
) -> Features[Residue]:
    """The features at an exact point."""

    def at(vector: Vector[Polynomial]) -> Vector[Residue]:
        x, y, z = (Residue(residue(v, point, prime), prime) for v in vector)
        return x, y, z

    return Features(
        tuple(
            Axis(a.joint, a.limb, at(a.direction), a.point and at(a.point))
            for a in exact.axes
        ),
        tuple(replace(p, position=at(p.position)) for p in exact.points),
        exact.planes,
    )


class Residue:
    """An integer mod p with the operations of a scalar."""

    __slots__ = ("prime", "value")

    def __init__(self, value: int, prime: int) -> None:
        self.value = value
        self.prime = prime

    def __add__(self, other: Residue) -> Residue:
        return Residue((self.value + other.value) % self.prime, self.prime)

    def __sub__(self, other: Residue) -> Residue:
        return Residue((self.value - other.value) % self.prime, self.prime)

    def __mul__(self, other: Residue) -> Residue:
        return Residue(self.value * other.value % self.prime, self.prime)

    def __neg__(self) -> Residue:
        return Residue(-self.value % self.prime, self.prime)


def _keys(piece: Piece) -> set[str]:
    return {str(primitive(equation)) for equation in piece.equations}


def _passes(
    ring: TrigonometricRing, axis: Axis[Polynomial], point: Vector[Polynomial]
) -> bool:
    """Whether an axis contains a point for every posture."""
    if axis.point is None:
        return False
    offset = cross(subtract(point, axis.point), axis.direction)
    return all(ring.normal(value) == 0 for value in offset)


def features_of(framed: FramedTwists) -> Features[Polynomial]:
    """Axes, and the points in which two or more of them meet for every posture."""
    ring = framed.ring
    axes = []
    centres = {label: joint for joint, labels in framed.balls for label in labels}
    balls: dict[str, Vector[Polynomial]] = {}
    for joint, column, point in zip(
        framed.joints, framed.columns, framed.points, strict=True
    ):
        if joint in centres:
            balls.setdefault(centres[joint], point)
            continue
        turning = any(value != 0 for value in column[:3])
        direction = column[:3] if turning else column[3:]
        axes.append(
            Axis(
                joint,
                framed.limb_of(joint),
                tuple(direction),
                point if turning else None,
            )
        )
    points: list[Point[Polynomial]] = []
    for joint, centre in balls.items():
        through = tuple(a.joint for a in axes if _passes(ring, a, centre))
        points.append(Point(through, (), centre, f"the centre of {joint}"))
    for axis in axes:
        if axis.point is None:
            continue
        through = tuple(
            other.joint for other in axes if _passes(ring, other, axis.point)
        )
        distinct = _distinct_directions(ring, axes, through)
        if distinct > 1 and not any(
            set(through) <= set(known.joints) for known in points
        ):
            # A centre stays: one axis through it, or none, does not fix it.
            points = [p for p in points if p.called or not set(p.joints) < set(through)]
            own = tuple(j for j in through if framed.limb_of(j) == axis.limb)
            points.append(Point(through, own, axis.point))
    planes = []
    for number, corner in enumerate(points):
        for i in range(len(corner.joints)):
            for j in range(i + 1, len(corner.joints)):
                a, b = corner.joints[i], corner.joints[j]
                if _distinct_directions(ring, axes, (a, b)) > 1:
                    planes.append((a, b, number))
    return Features(tuple(axes), tuple(points), tuple(planes))


def _distinct_directions(
    ring: object, axes: Sequence[Axis[Polynomial]], joints: Sequence[str]
) -> int:
    directions: list[Vector[Polynomial]] = []
    for axis in axes:
        if axis.joint not in joints:
            continue
        normal = ring.normal  # type: ignore[attr-defined]
        if all(
            any(normal(v) != 0 for v in cross(axis.direction, other))
            for other in directions
        ):
            directions.append(axis.direction)
    return len(directions)
