"""Small exact screw systems for hypothesis: numbers, one length, two angles."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

from hypothesis import strategies as st

from screwkit.algebra.evaluation import evaluate
from screwkit.algebra.limits import RESULT_LIMITS
from screwkit.algebra.modular import ModularRing, Residue, rank
from screwkit.algebra.parse import parse
from screwkit.algebra.points import residue
from screwkit.algebra.survey import SurveyRing
from screwkit.algebra.trigonometric import Polynomial, TrigonometricRing
from screwkit.screw.displacement import Displacement, screw_about
from screwkit.screw.system import TwistSystem


def _ring() -> TrigonometricRing:
    seen = SurveyRing()
    seen.cosine_sine("q1")
    seen.cosine_sine("q2")
    seen.symbol("a")
    return TrigonometricRing(seen)


RING = _ring()

small = st.integers(-2, 2)
scalars = st.builds(
    lambda n, k, which: RING.rational(Fraction(n)) + RING.rational(Fraction(k)) * which,
    small,
    st.sampled_from([0, 0, 0, 1, -1]),
    st.sampled_from(
        [*RING.cosine_sine("q1"), *RING.cosine_sine("q2"), RING.symbol("a")]
    ),
)
columns = st.tuples(*[scalars] * 6)
twist_systems = st.lists(columns, max_size=5).map(
    lambda found: TwistSystem(RING, tuple(found), "base")
)


def _displacement(
    first: int, second: int, shift: Polynomial
) -> Displacement[Polynomial]:
    one = screw_about(2 * first, RING.cosine_sine("q1"), shift, RING)
    return one.then(screw_about(2 * second, RING.cosine_sine("q2"), shift, RING), RING)


displacements = st.builds(_displacement, st.integers(0, 1), st.integers(0, 1), scalars)


class Place(ModularRing):
    """An exact point of `RING` mod a prime, special where asked.

    Attributes:
        point: The residue of every generator of `RING`.
    """

    def __init__(
        self, seed: int, *, straight: bool = False, short: bool = False
    ) -> None:
        """Draw a point; both angles 0 where ``straight``, a = 0 where ``short``."""
        super().__init__(seed)
        self._straight, self._short = straight, short
        self.point = [0] * len(RING.names)
        self.point[RING.symbol_indices()[0]] = int(self.symbol("a"))
        for number, ((angle, _),) in enumerate(RING.basis):
            cosine, sine = self.cosine_sine(angle)
            self.point[RING.cosine_index(number)] = int(cosine)
            self.point[RING.sine_index(number)] = int(sine)

    def symbol(self, name: str) -> Residue:
        return self.zero if self._short else super().symbol(name)

    def cosine_sine(self, angle: str) -> tuple[Residue, Residue]:
        if self._straight:
            return self.one, self.zero
        return super().cosine_sine(angle)

    def value(self, polynomial: Polynomial) -> int:
        """A polynomial at the point."""
        return residue(polynomial, self.point, self.prime)

    def read(self, text: str) -> int:
        """A printed expression at the point."""
        return int(evaluate(parse(text, limits=RESULT_LIMITS), self))

    def rank(self, columns: Sequence[Sequence[Polynomial]]) -> int:
        """Rank of columns at the point."""
        return rank([[self.value(v) for v in column] for column in columns], self.prime)
