"""Screws as a person reads them: kind, axis, a point of it, pitch and words.

A screw (f; m) is a couple or translation where f = 0, else it has the pitch
(f·m)/(f·f) and passes through (f×m)/(f·f); a force or rotation is one of pitch 0.

References: [LongCaroKhalil2012] (24), (25); [Hunt1978].
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from screwkit.algebra.constant_multiples import is_number, shortest_multiple, sign
from screwkit.algebra.expression_building import quotient
from screwkit.algebra.polynomial_text import text, to_expression
from screwkit.algebra.text import expression_text
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.conventions import DIRECTION, MOMENT
from screwkit.loci.features import Features
from screwkit.loci.reciprocals import FoundScrew
from screwkit.results.screws import IdentifiedScrew
from screwkit.screw.nullspace import Column, has_pitch, shortened
from screwkit.screw.vector import Vector, cross, dot, normal

WRITTEN = 20_000  # terms of a screw that is written out
EXPANDED = 300  # terms of a screw whose foot is worked out


class ScrewWriter:
    """Writes screws of one ring."""

    def __init__(
        self, ring: TrigonometricRing, *, linear: bool, planar: bool = False
    ) -> None:
        """Remember how coordinates are written.

        Args:
            ring: Of the screws.
            linear: Moment first.
            planar: Twists as (ωz; vx, vy), wrenches as (fx, fy; mz).
        """
        self.ring = ring
        self._linear = linear
        self._planar = planar

    def _scaled(self, screw: FoundScrew) -> FoundScrew:
        """The shortest multiple whose first coordinate is not written with a minus."""
        if _terms(screw.column) > EXPANDED:
            return screw
        column = shortest_multiple(self.ring, screw.column)
        first = next(value for value in column if value != 0)
        if is_number(self.ring, first):
            turned = sign(self.ring, first) < 0
        else:
            turned = text(self.ring, first).startswith("-")
        return replace(screw, column=tuple(-x for x in column) if turned else column)

    def wrench(self, screw: FoundScrew) -> IdentifiedScrew:
        """A wrench: force, couple or screw."""
        words = ""
        if screw.how:
            words = f"{'couple' if screw.is_free else 'force'} {screw.how}"
        return self._identified(self._scaled(screw), ("force", "couple"), words)

    def twist(self, screw: FoundScrew) -> IdentifiedScrew:
        """A twist: rotation, translation or screw."""
        words = ""
        if screw.how:
            words = (
                f"translation {screw.how}"
                if screw.is_free
                else f"rotation about {screw.name}"
            )
        return self._identified(self._scaled(screw), ("rotation", "translation"), words)

    def joint_twist(
        self,
        features: Features[Polynomial],
        joint: str,
        column: Column,
        point: Vector[Polynomial],
        centre: str = "",
    ) -> IdentifiedScrew:
        """The twist of a freedom, with the shortest point of its axis.

        Args:
            features: Of its limb.
            joint: The freedom's label.
            column: The twist.
            point: A point of its axis.
            centre: The joint whose centre that is, where it turns about it every way.

        The sign stays: it is that of the joint variable.
        """
        if _terms(column) <= EXPANDED:
            column = shortest_multiple(self.ring, column)
        if centre:
            letter = next(x for x, value in zip("xyz", column, strict=False) if value)
            words = f"rotation about the centre of {centre}, along {letter}"
            found = FoundScrew(column, point=point)
            return self._identified(found, ("rotation", "translation"), words)
        words = f"axis {joint}"
        if all(value == 0 for value in column[DIRECTION]):
            words = f"translation along {words}"
            return self._identified(
                FoundScrew(column), ("rotation", "translation"), words
            )
        named = [known for known in features.points if joint in known.joints]
        # A point that is named by the axis itself tells nothing of it.
        telling = [x for x in named if joint not in x.name.replace(",", "").split()]
        if telling:
            words += f", through {telling[0].name}"
        shortest = min((point, *(known.position for known in named)), key=_terms)
        return self._identified(
            FoundScrew(column, point=shortest),
            ("rotation", "translation"),
            f"rotation about {words}",
        )

    def _identified(
        self, screw: FoundScrew, kinds: tuple[str, str], words: str
    ) -> IdentifiedScrew:
        direction, moment = screw.column[DIRECTION], screw.column[MOMENT]
        if _terms(screw.column) > WRITTEN:
            return self._unwritten(screw, kinds)
        coordinates = self._texts(direction), self._texts(moment)
        if self._planar:
            twist = kinds[0] == "rotation"
            coordinates = (
                coordinates[0][2:] if twist else coordinates[0][:2],
                coordinates[1][:2] if twist else coordinates[1][2:],
            )
        if self._linear:
            coordinates = coordinates[1], coordinates[0]
        written = (*coordinates[0], *coordinates[1])
        if screw.is_free:
            return IdentifiedScrew(
                written, kinds[1], self._texts(moment), (), "", words
            )
        turned = has_pitch(self.ring, screw.column)
        pitch = self._pitch(screw.elsewhere or screw.column) if turned else "0"
        kind = "screw" if turned else kinds[0]
        return IdentifiedScrew(
            written, kind, self._texts(direction), self._point(screw), pitch, words
        )

    def _unwritten(self, screw: FoundScrew, kinds: tuple[str, str]) -> IdentifiedScrew:
        """A screw too long to be read by anybody: its kind and its length."""
        kind = kinds[0]
        if screw.is_free:
            kind = kinds[1]
        elif has_pitch(self.ring, screw.column):
            kind = "screw"
        return left_out(kind, f"{_terms(screw.column)} terms")

    def _pitch(self, column: Column) -> str:
        direction, moment = column[DIRECTION], column[MOMENT]
        if _terms(column) > EXPANDED:
            return self._unexpanded_pitch(column)
        above = self.ring.normal(dot(direction, moment))
        below = self.ring.normal(dot(direction, direction))
        return self._ratio_of_screw(column, (above,), below)[0]

    def _point(self, screw: FoundScrew) -> tuple[str, ...]:
        """The known point, or the shortest of four.

        They are the foot of the perpendicular from the origin, and where the axis
        meets the coordinate planes.
        """
        if screw.point is not None:
            return self._texts(screw.point)
        direction, moment = screw.column[DIRECTION], screw.column[MOMENT]
        ring = self.ring
        if _terms(screw.column) > EXPANDED:
            return self._foot(screw.column)
        square = ring.normal(dot(direction, direction))
        places = [(normal(ring, cross(direction, moment)), square)]
        if ring.normal(dot(direction, moment)) == 0:
            # m = p × f with p_i = 0: the other two coordinates are m_j / f_i.
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                if direction[i] != 0:
                    place = [ring.zero] * 3
                    place[j], place[k] = -moment[k], moment[j]
                    places.append(((place[0], place[1], place[2]), direction[i]))
        above, below = min(places, key=lambda place: _terms((*place[0], place[1])))
        return self._ratio_of_screw(screw.column, above, below)

    def _ratio_of_screw(
        self, column: Column, above: Sequence[Polynomial], below: Polynomial
    ) -> tuple[str, ...]:
        """Pitch (one value above) or foot (three), unexpanded where that is shorter."""
        if _terms((*above, below)) <= 2 * _terms(column):
            return tuple(self.ratio(value, below) for value in above)
        if len(above) == 3:
            return self._foot(column)
        return (self._unexpanded_pitch(column),)

    def _unexpanded_pitch(self, column: Column) -> str:
        """(f·m)/(f·f), not expanded."""
        f, m = self._halves(column)
        pairs = zip(f, m, strict=True)
        product = " + ".join(f"{a}*{b}" for a, b in pairs if "0" not in (a, b))
        return f"({product})/({_square(f)})"

    def _foot(self, column: Column) -> tuple[str, ...]:
        """(f×m)/(f·f), not expanded."""
        f, m = self._halves(column)
        return tuple(
            f"({f[j]}*{m[k]} - {f[k]}*{m[j]})/({_square(f)})"
            for j, k in ((1, 2), (2, 0), (0, 1))
        )

    def _halves(self, column: Column) -> tuple[list[str], list[str]]:
        return (
            [_bracketed(written) for written in self._texts(column[DIRECTION])],
            [_bracketed(written) for written in self._texts(column[MOMENT])],
        )

    def ratio(self, above: Polynomial, below: Polynomial) -> str:
        """A quotient without common factors."""
        if above == 0:
            return "0"
        above, below = shortened(self.ring, (above, below))
        if text(self.ring, below).startswith("-"):
            above, below = -above, -below
        written = quotient(
            to_expression(self.ring, above), to_expression(self.ring, below)
        )
        return expression_text(written)

    def _texts(self, values: Sequence[Polynomial]) -> tuple[str, ...]:
        return tuple(text(self.ring, value) for value in values)


def left_out(kind: str, size: str) -> IdentifiedScrew:
    """What is said in place of a screw that is too long to be read by anybody."""
    words = f"{kind} too long to be written ({size}); --set gives numbers"
    return IdentifiedScrew((), kind, (), (), "", words)


def _square(vector: Sequence[str]) -> str:
    return " + ".join(f"{value}^2" for value in vector if value != "0")


def _bracketed(written: str) -> str:
    return written if written.isalnum() else f"({written})"


def _terms(values: Sequence[Polynomial]) -> int:
    return sum(len(value) for value in values)
